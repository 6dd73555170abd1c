//! Keeps the time of a frame under a budget: a step, or a turn of the dial, towards speed while frames take too long, and back while they leave room.

use super::BudgetState;
use crate::tuning::Step;

/// Chooses steps by time.
#[derive(Debug)]
pub(super) struct TimeKeeper {
    budget: f64,
    /// All it may stand at, from the most accurate to the fastest, with the last time known of each.
    stands: Vec<(BudgetState, Option<f64>)>,
    at: usize,
    mean: Option<f64>,
    frames: u32,
}

/// What a dial may stand at, in percent.
const DIAL: [f64; 9] = [0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0];
/// Frames after a change before anything is judged: at first all is drawn.
const SETTLES: u32 = 4;
/// Frames that are averaged before it moves.
const AVERAGES: u32 = 8;
/// It goes back to what is more accurate only where a frame takes less than this part of the budget.
const ROOM: f64 = 0.85;
/// How many stands it goes at once where a frame takes less than half or more than one and a half of the budget.
const FAR: usize = 3;
/// What an old time is worth beside the budget, a frame later: what was too slow is tried again some day.
const FORGETS: f64 = 0.999;

impl TimeKeeper {
    /// For these steps, of which there is one at least; it starts in the middle.
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

    /// Where it stands.
    pub fn state(&self) -> BudgetState {
        self.stands
            .get(self.at)
            .map(|stand| stand.0)
            .unwrap_or_default()
    }

    /// Takes in a frame's milliseconds, and says where to stand from now on.
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
        // Far off, it goes further at a time.
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
        let mut keeper = TimeKeeper::new(budget, &steps);
        let mut time = 0.0;
        for _ in 0..frames {
            time = 20.0 * 0.8f64.powi(keeper.state().step as i32);
            keeper.note(time);
        }
        time
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
