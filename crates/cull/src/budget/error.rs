//! Keeps the mean of the wrong pixels within a budget: the fastest step whose estimated error fits, with the dial at what is left of the budget. What a frame leaves out by
//! its own count is known at once; all other errors, and the error of that count, come from the audit.

use super::BudgetState;
use super::belief::Belief;
use crate::audit::FrameAudit;
use crate::tuning::Step;

/// Chooses steps by error.
#[derive(Debug)]
pub(super) struct ErrorController {
    budget: f64,
    steps: Vec<Known>,
    at: BudgetState,
    /// The first frame whose results belong to the present step.
    since: u64,
    /// Consecutive frames in which another step looked better.
    patience: u32,
    /// The unused part of the budget, in percent summed over frames; negative: overdrawn. An estimate of the audit, with this variance.
    saved: f64,
    variance: f64,
    /// Wrong pixels found on uncertain patches, and what frames meant to leave out.
    uncertain: [f64; 2],
    /// What a frame may leave out by its own count, on average, in percent.
    share: f64,
    /// The parts of their shares that frames did not leave out, because nothing was small enough, summed up; negative: what they left out beyond their shares.
    unspent: f64,
    /// What a wholly wrong patch stands for, in percent of the image, and the usual wrong part of a hit patch.
    patch: f64,
    taint: f64,
    frames: u64,
}

/// What is known about a step.
#[derive(Debug)]
struct Known {
    has_dial: bool,
    /// The unintended error.
    base: Belief,
}

/// The assumed error of the second step, as a part of the budget. The first step is conservative by contract; of the second one nothing is known.
const PRIOR: f64 = 0.35;
/// The factor by which an untried step is assumed to err more than the one before.
const WORSENS: f64 = 2.0;
/// An error of this many budgets is corrected without patience.
const URGENT: f64 = 4.0;
/// Standard deviations above the mean that must still fit.
const CAREFUL: f64 = 0.5;
/// The part of the budget that the controller aims to use.
const MEANT: f64 = 0.85;
/// Consecutive frames in which another step must look better: after a change everything is drawn for a frame or two.
const PATIENCE: u32 = 8;
/// The assumed wrong part of a hit patch before there was any hit.
const TAINT: f64 = 0.05;
/// This many hits may come at any moment: savings and debts count beyond their worth, and beyond a standard deviation.
const SURELY: f64 = 2.0;
/// Frames over which savings and debts are evened out.
const HORIZON: f64 = 200.0;
/// Frames until results belong to a new step.
const SETTLES: u64 = 4;
/// The factor by which a frame's weight decays a frame, for what was meant to be left out and what it came to, and for the variance of what is found.
const FADES: f64 = 1.0 - 1.0 / 1_000.0;
/// The weight of the prior that counts are right, in hits.
const BELIEF: f64 = 3.0;
/// A frame's unused share is spent over about this many frames, and no frame leaves out more than this many times its share. An entity costs the same in every frame, so the
/// same count should be too small in every frame: frames with many small entities use what frames with few have left over.
const SPREAD: f64 = 16.0;
const BURST: f64 = 3.0;

impl ErrorController {
    /// For these steps, at least one.
    pub fn new(budget: f64, steps: &[Step]) -> Self {
        let known = |step: &Step| Known {
            has_dial: step.dial.is_some(),
            base: Belief::default(),
        };
        let mut controller = Self {
            budget,
            steps: steps.iter().map(known).collect(),
            at: BudgetState::default(),
            since: 0,
            patience: 0,
            saved: 0.0,
            variance: 0.0,
            uncertain: [0.0; 2],
            share: 0.0,
            unspent: 0.0,
            patch: 100.0,
            taint: TAINT,
            frames: 0,
        };
        controller.stand(controller.best().0);
        controller
    }

    /// The present step and dial.
    pub fn state(&self) -> BudgetState {
        self.at
    }

    /// Adds the audit's result for a frame; `now` is the frame that is drawn next. Returns the step and dial from now on.
    pub fn note(&mut self, found: &FrameAudit, now: u64) -> BudgetState {
        let [plain, uncertain] = found.by_kind();
        self.saved += self.budget - plain.percent - uncertain.percent;
        // Savings and debts are limited.
        let most = self.budget * HORIZON;
        self.saved = self.saved.clamp(-4.0 * most, most);
        // The variance of rare independent hits is the sum of their squares (Poisson).
        self.variance = self.variance * FADES + (plain.percent + uncertain.percent).powi(2);
        let hits = plain.hits + uncertain.hits;
        let patch = found.heaviest_percent();
        self.patch = match self.frames {
            0 => patch,
            _ => self.patch + (patch - self.patch) * 0.05,
        };
        if hits > 0.0 && patch > 0.0 {
            let each = (plain.percent + uncertain.percent) / hits / patch;
            self.taint += (each.min(1.0) - self.taint) * 0.1;
        }
        let current = found.frame >= self.since;
        for (number, step) in self.steps.iter_mut().enumerate() {
            match number == self.at.step && current {
                true => step.base.note(plain.percent, plain.hits),
                false => step.base.fade(),
            }
        }
        if current && let Some(both) = found.meant() {
            for (sum, more) in self.uncertain.iter_mut().zip(both) {
                *sum = *sum * FADES + more;
            }
        }
        if current && let Some(left_out) = found.left_out_percent() {
            self.unspent += self.share - left_out;
        }
        self.frames += 1;
        let (best, urgent) = self.best();
        if best.step == self.at.step {
            self.patience = 0;
            self.stand(best);
        } else {
            self.patience += 1;
            if urgent || self.patience >= PATIENCE {
                self.patience = 0;
                self.unspent = 0.0;
                self.stand(best);
                self.since = now + SETTLES;
            }
        }
        self.at
    }

    /// Goes to a step, with the dial raised by what earlier frames did not spend.
    fn stand(&mut self, at: BudgetState) {
        self.share = at.allow;
        let most = SPREAD * self.share;
        self.unspent = self.unspent.clamp(-most, (BURST - 1.0) * most);
        self.at = BudgetState {
            allow: self.share + self.unspent / SPREAD,
            ..at
        };
    }

    /// The wrong pixels that a frame may have now, in percent.
    fn allowed(&self) -> f64 {
        // With rare and heavy hits, a run of frames without one has saved nothing yet, and a single one has overdrawn nothing.
        let chance = (SURELY * self.a_hit()).max(self.variance.sqrt());
        let surely = self.saved - self.saved.clamp(-chance, chance);
        self.budget * MEANT + (surely / HORIZON).clamp(-self.budget, 0.1 * self.budget)
    }

    /// What a hit stands for, in percent of the image.
    fn a_hit(&self) -> f64 {
        (self.patch * self.taint).max(1e-6)
    }

    /// The fastest step that fits by estimate, up to the one after the present step; and whether the present step is far from fitting.
    fn best(&self) -> (BudgetState, bool) {
        let mut best = BudgetState::default();
        if self.budget <= 0.0 {
            return (best, false);
        }
        let allowed = self.allowed();
        let a_hit = self.a_hit();
        let mut prior = self.budget * PRIOR;
        let mut urgent = false;
        let reach = self.at.step + 1;
        for (step, known) in self.steps.iter().enumerate().take(reach + 1).skip(1) {
            let careful = known.base.careful(a_hit, prior, CAREFUL);
            let mean = known.base.mean(a_hit, prior);
            if careful <= allowed {
                let allow = match known.has_dial {
                    true => self.left(allowed - mean),
                    false => 0.0,
                };
                best = BudgetState { step, allow };
            }
            urgent |= step == self.at.step && careful > URGENT * self.budget;
            prior = prior.max(WORSENS * mean);
        }
        (best, urgent)
    }

    /// What a frame may leave out by its own count, corrected by the audit's estimate of that count's error.
    fn left(&self, percent: f64) -> f64 {
        let [found, meant] = self.uncertain;
        let believed = BELIEF * self.a_hit();
        percent.max(0.0) / ((found + believed) / (meant + believed)).clamp(0.25, 8.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    /// A world in which each step has an error of its own, what is left out comes out so many times as wrong as counted, and the audit finds
    /// `a_hit` percent at a time. Gives the mean error, and for how many of the frames each step was stood on.
    fn live(
        budget: f64,
        errors: &[f64],
        (dial, times): (bool, f64),
        a_hit: f64,
        seed: u64,
        frames: u64,
    ) -> (f64, Vec<u32>) {
        let mut steps = vec![Step::default(); errors.len()];
        if dial && let Some(last) = steps.last_mut() {
            last.dial = Some("allow");
        }
        let mut controller = ErrorController::new(budget, &steps);
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut stood = vec![0; errors.len()];
        let mut wrong = 0.0;
        for frame in 0..frames {
            let at = controller.state();
            stood[at.step] += 1;
            let (base, meant) = (errors[at.step], at.allow);
            wrong += base + meant * times;
            let mut hit = |percent: f64, uncertain| {
                random
                    .random_bool((percent / a_hit).min(1.0))
                    .then_some((a_hit, uncertain))
            };
            let hits = [hit(base, false), hit(meant * times, true)];
            let found =
                FrameAudit::made_up(frame, a_hit * 20.0, hits.into_iter().flatten(), Some(meant));
            controller.note(&found, frame + 1);
        }
        (wrong / frames as f64, stood)
    }

    #[test]
    fn the_mean_stays_under_the_budget_and_the_best_step_is_found() {
        let errors = [0.0, 0.001, 0.004, 0.012, 0.08, 0.4, 2.0];
        let (wrong, stood) = live(0.02, &errors, (false, 1.0), 0.4, 9, 6_000);
        assert!(wrong <= 0.02, "{wrong} %, {stood:?}");
        assert!(stood[3] > 3_000, "{wrong} %, {stood:?}");
    }

    #[test]
    fn where_no_step_fits_it_stays_with_the_conservative_one() {
        let (wrong, stood) = live(0.02, &[0.0, 0.5, 1.0], (false, 1.0), 0.4, 9, 6_000);
        assert!(wrong <= 0.02 && stood[0] > 5_000, "{wrong} %, {stood:?}");
    }

    #[test]
    fn a_dial_uses_what_is_left_however_wrong_its_count() {
        for times in [0.5, 1.0, 3.0] {
            let (wrong, stood) = live(0.1, &[0.0, 0.01], (true, times), 0.4, 9, 6_000);
            assert!(
                (0.05..=0.1).contains(&wrong),
                "{times}: {wrong} %, {stood:?}"
            );
        }
    }

    #[test]
    fn a_budget_of_nothing_never_leaves_the_first_step() {
        let (wrong, stood) = live(0.0, &[0.0, 0.0], (true, 1.0), 0.4, 9, 6_000);
        assert_eq!((wrong, stood), (0.0, vec![6_000, 0]));
    }

    #[test]
    fn one_heavy_hit_does_not_drive_it_to_the_exact_step() {
        let mut controller = ErrorController::new(0.1, &vec![Step::default(); 3]);
        let mut heavy = 0;
        for frame in 0..600 {
            // Two hundredths on average on the second step; on the third nothing, and once a quarter of the image.
            let percent = match controller.state().step {
                2 if frame > 100 && heavy == 0 => 26.0,
                1 if frame % 12 == 6 => 0.25,
                _ => 0.0,
            };
            heavy += u32::from(percent > 1.0);
            let hits = (percent > 0.0).then_some((percent, false)).into_iter();
            controller.note(&FrameAudit::made_up(frame, 10.0, hits, None), frame + 1);
            let step = controller.state().step;
            assert!(frame < 20 || step > 0, "{frame}: {controller:?}");
        }
        assert_eq!(heavy, 1);
    }

    #[test]
    fn what_frames_do_not_leave_out_later_ones_may() {
        let steps = [Step::default(), Step::default().with_dial("allow")];
        let mut controller = ErrorController::new(0.1, &steps);
        let (mut meant, mut most, mut shares) = (0.0, 0.0f64, 0.0);
        let frames = 4_000;
        for frame in 0..frames {
            // Twenty frames with hardly anything that is small, and twenty with much.
            let room = if frame / 20 % 2 == 0 { 0.001 } else { 1.0 };
            let left_out = controller.state().allow.min(room);
            meant += left_out;
            shares += controller.share;
            most = most.max(left_out / controller.share.max(1e-9));
            let found =
                FrameAudit::made_up(frame, 0.4, [(left_out, true)].into_iter(), Some(left_out));
            controller.note(&found, frame + 1);
        }
        assert!(meant > 0.8 * shares, "{meant} of {shares}");
        assert!(
            meant < 0.1 * frames as f64 && most <= BURST,
            "{meant}, {most}"
        );
    }

    #[test]
    fn whatever_the_lots_the_mean_stays_near_or_under_the_budget() {
        let ladder = [0.0, 0.02, 0.03, 0.05, 0.08, 0.15, 0.4];
        for (errors, dial) in [
            (&ladder[..], (false, 1.0)),
            (&ladder[..3], (true, 1.0)),
            (&ladder[..3], (true, 2.0)),
        ] {
            // From a hit worth four frames' budgets to one worth three hundred.
            for a_hit in [0.4, 2.0, 10.0, 30.0] {
                let (mut mean, mut exact) = (0.0, 0.0);
                for seed in 0..20 {
                    let (wrong, stood) = live(0.1, errors, dial, a_hit, seed, 2_000);
                    assert!(wrong <= 0.135, "{a_hit}, seed {seed}: {wrong} %, {stood:?}");
                    mean += wrong / 20.0;
                    exact += f64::from(stood[0]) / 2_000.0 / 20.0;
                }
                assert!(mean <= 0.1, "{a_hit}: {mean} %");
                // It does not flee to the exact step from every hit.
                assert!(exact < 0.25, "{a_hit}: {exact} of the frames exact");
            }
        }
    }
}
