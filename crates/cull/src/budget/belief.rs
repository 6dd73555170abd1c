//! What is believed of the error of a step: a rate of hits, each of a mean weight, from few of them (the Gamma posterior of a Poisson rate).

/// Wrong pixels in percent of the image, from a prior and from what the audit has found.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Belief {
    /// Percent, added up over frames.
    found: f64,
    frames: f64,
    hits: f64,
}

/// The prior counts as so many hits.
const PRIOR_HITS: f64 = 1.5;
/// What a frame is worth to a belief a frame later: about 4,000 frames are remembered,
const FADES: f64 = 1.0 - 1.0 / 4_000.0;
/// and of a step that is not stood on about 800, for what was seen of it then may be gone.
const FORGETS: f64 = 1.0 - 1.0 / 800.0;

impl Belief {
    /// Takes in a frame.
    pub fn note(&mut self, percent: f64, hits: f64) {
        self.keep(FADES);
        self.found += percent;
        self.frames += 1.0;
        self.hits += hits;
    }

    /// Lets a frame pass that says nothing about it.
    pub fn fade(&mut self) {
        self.keep(FORGETS);
    }

    fn keep(&mut self, part: f64) {
        self.found *= part;
        self.frames *= part;
        self.hits *= part;
    }

    /// The mean, in percent; `a_hit` is what one hit stands for in a frame, `prior` what was believed before anything was found.
    pub fn mean(&self, a_hit: f64, prior: f64) -> f64 {
        let hits = PRIOR_HITS * a_hit;
        // As many frames as bring the prior's hits at the prior's rate.
        let frames = hits / prior.max(1e-9);
        (hits + self.found) / (frames + self.frames)
    }

    /// The mean and so many standard deviations.
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
