//! Keeps frame times within a budget: one step or dial value towards speed while frames take too long, and back while there is room.

use super::BudgetState;
use crate::tuning::Step;

/// Chooses steps by time.
#[derive(Debug)]
pub(super) struct TimeController {
    budget: f64,
    /// All steps and dial values, from the most accurate to the fastest, each with its last known time.
    stands: Vec<(BudgetState, Option<f64>)>,
    at: usize,
    mean: Option<f64>,
    frames: u32,
}

/// The values of a dial, in percent.
const DIAL: [f64; 9] = [0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0];
/// Frames after a change that are ignored: at first everything is drawn.
const SETTLES: u32 = 4;
/// Frames that are averaged before a change.
const AVERAGES: u32 = 8;
/// It becomes more accurate only while a frame takes less than this part of the budget.
const ROOM: f64 = 0.85;
/// How many values it moves at once where a frame takes less than 0.5 or more than 1.5 budgets.
const FAR: usize = 3;
/// The factor by which a known time decays a frame, so that a value that was too slow is tried again later.
const FORGETS: f64 = 0.999;

impl TimeController {
    /// For these steps, at least one. It starts in the middle.
    pub fn new(budget: f64, steps: &[Step]) -> Self {
        let mut stands = Vec::new();
        for (step, known) in steps.iter().enumerate() {
            let dial = if known.dial.is_some() {
                &DIAL
            } else {
                &DIAL[..1]
            };
            stands.extend(dial.iter().map(|allow| {
                (
                    BudgetState {
                        step,
                        allow: *allow,
                    },
                    None,
                )
            }));
        }
        Self {
            budget,
            at: stands.len() / 2,
            stands,
            mean: None,
            frames: 0,
        }
    }

    /// The present step and dial.
    pub fn state(&self) -> BudgetState {
        self.stands
            .get(self.at)
            .map(|stand| stand.0)
            .unwrap_or_default()
    }

    /// Leaves the next frames out of the mean, as after a change of step.
    pub fn settle(&mut self) {
        (self.mean, self.frames) = (None, 0);
    }

    /// Forgets all times.
    pub fn forget(&mut self) {
        self.settle();
        for (_, known) in &mut self.stands {
            *known = None;
        }
    }

    /// Adds a frame's time in milliseconds. Returns the step and dial from now on.
    pub fn note(&mut self, time: f64) -> BudgetState {
        for (_, known) in &mut self.stands {
            if let Some(known) = known {
                *known *= FORGETS;
            }
        }
        self.frames += 1;
        if self.frames <= SETTLES || !time.is_finite() {
            return self.state();
        }
        let mean = self
            .mean
            .map_or(time, |mean| mean + (time - mean) / f64::from(AVERAGES));
        self.mean = Some(mean);
        if let Some((_, known)) = self.stands.get_mut(self.at) {
            *known = Some(mean);
        }
        if self.frames < SETTLES + AVERAGES {
            return self.state();
        }
        let fits = |at: usize| {
            let known = self.stands.get(at).and_then(|stand| stand.1);
            known.is_none_or(|time| time <= self.budget)
        };
        // Far from the budget it moves further at a time.
        let far = match mean / self.budget {
            part if (0.5..1.5).contains(&part) => 1,
            _ => FAR,
        };
        let last = self.stands.len().saturating_sub(1);
        let back = (self.at.saturating_sub(far)..self.at).find(|at| fits(*at));
        let next = match back {
            _ if mean > self.budget => (self.at + far).min(last),
            Some(back) if mean < self.budget * ROOM => back,
            _ => self.at,
        };
        if next != self.at {
            (self.at, self.mean, self.frames) = (next, None, 0);
        }
        self.state()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six steps, each a fifth faster than the one before.
    fn stands_after(budget: f64, frames: u32) -> f64 {
        let steps = vec![Step::default(); 6];
        let mut controller = TimeController::new(budget, &steps);
        let mut time = 0.0;
        for _ in 0..frames {
            time = 20.0 * 0.8f64.powi(controller.state().step as i32);
            controller.note(time);
        }
        time
    }

    #[test]
    fn a_new_plan_moves_no_step() {
        let steps = vec![Step::default(); 6];
        let mut controller = TimeController::new(16.6, &steps);
        for _ in 0..400 {
            controller.note(14.0 * 0.8f64.powi(controller.state().step as i32));
        }
        let before = controller.state();
        controller.settle();
        controller.note(150.0);
        for _ in 0..60 {
            controller.note(14.0 * 0.8f64.powi(before.step as i32));
        }
        assert_eq!(controller.state(), before);
    }

    #[test]
    fn times_of_a_large_image_are_forgotten_with_it() {
        let steps = vec![Step::default(); 6];
        let mut controller = TimeController::new(16.6, &steps);
        for _ in 0..400 {
            controller.note(60.0);
        }
        assert_eq!(controller.state().step, 5);
        controller.forget();
        // Every step of the small image is fast: it goes back to the most accurate at once.
        for _ in 0..200 {
            controller.note(1.0);
        }
        assert_eq!(controller.state().step, 0);
    }

    #[test]
    fn it_finds_the_slowest_step_that_fits() {
        for (budget, expected) in [(25.0, 20.0), (16.5, 16.0), (11.0, 10.24), (7.0, 6.5536)] {
            let time = stands_after(budget, 400);
            assert!((time - expected).abs() < 1e-9, "{budget}: {time}");
        }
        // Nothing is as fast as that: it stays at the fastest.
        assert!((stands_after(1.0, 400) - 6.5536).abs() < 1e-9);
    }
}
