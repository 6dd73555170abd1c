//! The estimated error of a step: a rate of hits of a mean weight, from few hits (the Gamma posterior of a Poisson rate).

/// Wrong pixels in percent of the image, from a prior and from the audit's results.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Belief {
    /// Percent, added up over frames.
    found: f64,
    frames: f64,
    hits: f64,
}

/// The weight of the prior, in hits.
const PRIOR_HITS: f64 = 1.5;
/// The factor by which a frame's weight decays a frame: about 4,000 frames are remembered.
const FADES: f64 = 1.0 - 1.0 / 4_000.0;
/// The same for a step that is not in use: about 800 frames, since the view may have changed.
const FORGETS: f64 = 1.0 - 1.0 / 800.0;

impl Belief {
    /// Adds a frame.
    pub fn note(&mut self, percent: f64, hits: f64) {
        self.keep(FADES);
        self.found += percent;
        self.frames += 1.0;
        self.hits += hits;
    }

    /// Passes a frame that says nothing about this step.
    pub fn fade(&mut self) {
        self.keep(FORGETS);
    }

    fn keep(&mut self, part: f64) {
        self.found *= part;
        self.frames *= part;
        self.hits *= part;
    }

    /// The mean, in percent. `a_hit` is what one hit stands for in a frame, `prior` the assumed mean before any result.
    pub fn mean(&self, a_hit: f64, prior: f64) -> f64 {
        let hits = PRIOR_HITS * a_hit;
        // The frames in which the prior's rate brings the prior's hits.
        let frames = hits / prior.max(1e-9);
        (hits + self.found) / (frames + self.frames)
    }

    /// The mean plus this many standard deviations.
    pub fn careful(&self, a_hit: f64, prior: f64, deviations: f64) -> f64 {
        self.mean(a_hit, prior) * (1.0 + deviations / (PRIOR_HITS + self.hits).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_belief_starts_at_its_prior_and_ends_at_what_is_found() {
        let mut belief = Belief::default();
        assert!((belief.mean(0.4, 0.05) - 0.05).abs() < 1e-12);
        for frame in 0..3_000 {
            let hit = f64::from(u8::from(frame % 20 == 0));
            belief.note(0.4 * hit, hit);
        }
        assert!((belief.mean(0.4, 0.05) - 0.02).abs() < 0.002, "{belief:?}");
        assert!(belief.careful(0.4, 0.05, 1.0) > belief.mean(0.4, 0.05));
    }

    #[test]
    fn frames_without_a_hit_lower_it() {
        let mut belief = Belief::default();
        for _ in 0..100 {
            belief.note(0.0, 0.0);
        }
        assert!(belief.mean(0.4, 0.05) < 0.01, "{belief:?}");
    }
}
