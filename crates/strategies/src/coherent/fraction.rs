//! The fraction of the occluded entities that a frame tests.
//!
//! The fixed fraction is that of Mansa et al. 2007, section 3.1. Beyond the paper, it can follow the rate at which entities appear.

/// The settings of the fraction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FractionRule {
    /// The least fraction: above 0, at most 1.
    pub least: f64,
    /// Entities that may be late on average; 0: the fraction stays at `least`.
    pub late: f64,
}

/// A fraction that follows the rate at which entities appear.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct AdaptiveFraction {
    /// Entities that appear a frame, smoothed.
    appearing: f64,
    /// Occluded entities tested in the last frame.
    pub tested: usize,
}

/// The weight of the newest frame in the smoothed rate.
const WEIGHT: f64 = 0.25;

impl AdaptiveFraction {
    /// The fraction to test now.
    ///
    /// At a fraction f an entity that appears is noticed after (1/f - 1)/2 frames on average. With a entities appearing a frame, a/2 (1/f - 1) are
    /// late at any time. Solved for f, this gives the fraction at which [`FractionRule::late`] entities are late.
    pub fn now(&self, rule: FractionRule) -> f64 {
        if rule.late <= 0.0 {
            return rule.least;
        }
        let needed = self.appearing / (self.appearing + 2.0 * rule.late);
        needed.clamp(rule.least, 1.0)
    }

    /// Takes the result of a frame's tests: the number of entities that had appeared.
    pub fn update(&mut self, appeared: u32) {
        if self.tested == 0 {
            return;
        }
        // With a fraction below 1 the tests of a frame find what has appeared in several frames: on average as many as appear a frame.
        let found = f64::from(appeared);
        // A rise counts at once, a fall slowly: a late entity costs pixels, an early test costs a query.
        self.appearing = found.max(self.appearing + WEIGHT * (found - self.appearing));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_fraction_without_tolerance_stays_and_with_one_follows_what_appears() {
        let fixed = FractionRule {
            least: 0.5,
            late: 0.0,
        };
        let adaptive = FractionRule {
            least: 0.1,
            late: 1.0,
        };
        let mut fraction = AdaptiveFraction {
            tested: 10,
            ..AdaptiveFraction::default()
        };
        assert_eq!(fraction.now(fixed), 0.5);
        assert_eq!(fraction.now(adaptive), 0.1, "nothing appears");
        fraction.update(18);
        assert_eq!(fraction.now(adaptive), 18.0 / 20.0);
        assert_eq!(fraction.now(fixed), 0.5);
        for _ in 0..40 {
            fraction.update(0);
        }
        assert_eq!(fraction.now(adaptive), 0.1, "nothing appears any more");
    }
}
