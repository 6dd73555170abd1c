//! Which of the occluded are tested in a frame: a fraction of them, in an order that reaches every one within 1/fraction frames.
//!
//! The fraction is Mansa et al.'s (2007, section 3.1). Beyond the paper, those go first that were answered longest ago and, of those,
//! the nearest to something visible on the screen; and the fraction may follow how fast entities appear.

use antumbra_draw::{SceneTable, ViewFrame};

use super::memory::Memory;
use super::screen_distance::Nearness;

/// How much of the occluded is tested a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Share {
    /// The least part of the occluded that is tested: above 0, at most 1.
    pub least: f64,
    /// How many entities may be late on average; 0 keeps the fraction at its least.
    pub late: f64,
}

/// A fraction that follows what it finds.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Fraction {
    /// Entities that appear a frame, smoothed.
    appearing: f64,
    /// How many of the occluded were picked last.
    tested: usize,
}

/// How much a new frame's number weighs against those before.
const WEIGHT: f64 = 0.25;

impl Fraction {
    /// The fraction to test now.
    ///
    /// At a fraction f an entity that appears is noticed after (1/f - 1)/2 frames on average. With a entities appearing a frame, a/2 (1/f - 1) are
    /// late at any time; f follows from how many may be.
    pub fn now(&self, share: Share) -> f64 {
        if share.late <= 0.0 {
            return share.least;
        }
        let needed = self.appearing / (self.appearing + 2.0 * share.late);
        needed.clamp(share.least, 1.0)
    }

    /// Learns that so many of the scheduled ones had appeared.
    pub fn learn(&mut self, appeared: u32) {
        if self.tested == 0 {
            return;
        }
        // At f below 1 a frame's tests find what has appeared in several; on average as many as appear.
        let found = f64::from(appeared);
        // Growth is believed at once, decline slowly: being late costs pixels, being early a few queries.
        self.appearing = found.max(self.appearing + WEIGHT * (found - self.appearing));
    }

    /// Picks the occluded to test in this frame; `picked` gets their slots, ascending.
    pub fn pick(
        memory: &mut Memory,
        table: &SceneTable,
        view: &ViewFrame,
        share: Share,
        nearness: &mut Nearness,
        picked: &mut Vec<u32>,
    ) {
        let of = memory.occluded().len();
        let fraction = memory.fraction.now(share);
        let tested = ((of as f64 * fraction).ceil() as usize).min(of);
        picked.clear();
        if tested == of {
            picked.extend_from_slice(memory.occluded());
        } else {
            nearness.see(table, view, memory.visible());
            let mut order: Vec<(u64, u32, u32)> = memory
                .occluded()
                .iter()
                .map(|slot| {
                    let steps = nearness.steps(&table.bounds(*slot), view);
                    (memory.answered(*slot), steps, *slot)
                })
                .collect();
            if let Some(last) = tested.checked_sub(1) {
                order.select_nth_unstable(last);
            }
            picked.extend(order.iter().take(tested).map(|(.., slot)| *slot));
            picked.sort_unstable();
        }
        memory.fraction.tested = tested;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_fraction_without_tolerance_stays_and_with_one_follows_what_appears() {
        let fixed = Share {
            least: 0.5,
            late: 0.0,
        };
        let adaptive = Share {
            least: 0.1,
            late: 1.0,
        };
        let mut fraction = Fraction {
            tested: 10,
            ..Fraction::default()
        };
        assert_eq!(fraction.now(fixed), 0.5);
        assert_eq!(fraction.now(adaptive), 0.1, "nothing appears");
        fraction.learn(18);
        assert_eq!(fraction.now(adaptive), 18.0 / 20.0);
        assert_eq!(fraction.now(fixed), 0.5);
        for _ in 0..40 {
            fraction.learn(0);
        }
        assert_eq!(fraction.now(adaptive), 0.1, "nothing appears any more");
    }
}
