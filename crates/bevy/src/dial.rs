//! The pixels by which what is hidden must be so, as a budget of wrong pixels sets them.

use crate::settings::Budget;

/// Pixels, and whether they keep the budget.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dial {
    pixels: f32,
}

/// By how many pixels what is hidden must be so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Margin {
    /// On all sides.
    pub sides: f32,
    /// On the side that is uncovered when the camera goes on as it does.
    pub ahead: f32,
}

/// Of what a budget allows, more than the first part in a frame asks for more pixels, and less than the second for fewer. What is between is kept, so that the mean of frames, of which some
/// are worse than others, stays below what is allowed.
const ENOUGH: [f32; 2] = [0.5, 0.125];

/// So much of what a budget asks for ahead of the camera is asked for on all sides: cameras turn aside, and occluders move.
const ASIDE: f32 = 0.125;

impl Default for Dial {
    fn default() -> Self {
        Self {
            pixels: Budget::FIRST_SHIFT,
        }
    }
}

impl Dial {
    /// What to test with. While the camera is at rest, nothing is uncovered, and `least` is enough.
    pub fn margin(&self, budget: Budget, is_at_rest: bool, least: f32) -> Margin {
        // Written so that what is not a number is the least.
        let bounded = |pixels: f32| match pixels > least {
            true => pixels.min(Budget::MOST_SHIFT),
            false => least,
        };
        match budget {
            Budget::Shift(pixels) => Margin {
                sides: bounded(pixels),
                ahead: 0.0,
            },
            Budget::WrongPixels(_) if is_at_rest => Margin {
                sides: least,
                ahead: 0.0,
            },
            Budget::WrongPixels(_) => Margin {
                sides: bounded((self.pixels * ASIDE).max(1.0)),
                ahead: bounded(self.pixels),
            },
        }
    }

    /// Whether nothing may be culled while the camera moves, for even the most pixels were too few.
    pub fn is_past_its_end(&self, budget: Budget) -> bool {
        matches!(budget, Budget::WrongPixels(_)) && self.pixels > Budget::MOST_SHIFT
    }

    /// Turns by the wrong pixels, in percent, of a frame in motion. Past the end nothing is culled and nothing is wrong, so that it comes back in time.
    pub fn note_wrong(&mut self, budget: Budget, wrong: f32) {
        let Budget::WrongPixels(allowed) = budget else {
            return;
        };
        let [most, least] = ENOUGH.map(|part| part * allowed);
        if wrong > most {
            self.pixels = (self.pixels * 2.0).min(Budget::MOST_SHIFT * 2.0);
        } else if wrong < least {
            self.pixels = (self.pixels * 0.9).max(1.0);
        }
    }
}

impl Margin {
    /// The more of the two.
    pub fn most(&self) -> f32 {
        self.sides.max(self.ahead)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BUDGET: Budget = Budget::WrongPixels(0.02);

    fn ahead(dial: Dial) -> f32 {
        dial.margin(BUDGET, false, 0.0).ahead
    }

    #[test]
    fn it_grows_with_wrong_pixels_and_falls_without() {
        let mut dial = Dial::default();
        dial.note_wrong(BUDGET, 0.011);
        assert_eq!(ahead(dial), 2.0 * Budget::FIRST_SHIFT);
        assert_eq!(
            dial.margin(BUDGET, false, 0.0).sides,
            2.0 * Budget::FIRST_SHIFT * ASIDE
        );
        assert_eq!(dial.margin(BUDGET, true, 0.0).most(), 0.0);
        assert_eq!(dial.margin(BUDGET, true, 1.0).most(), 1.0);
        for _ in 0..100 {
            dial.note_wrong(BUDGET, 0.001);
        }
        assert_eq!(ahead(dial), 1.0);
        // Between an eighth of what is allowed and half of it, it stays.
        dial.note_wrong(BUDGET, 0.005);
        assert_eq!(ahead(dial), 1.0);
    }

    #[test]
    fn past_its_end_it_comes_back() {
        let mut dial = Dial::default();
        for _ in 0..20 {
            dial.note_wrong(BUDGET, 5.0);
        }
        assert!(dial.is_past_its_end(BUDGET));
        assert_eq!(ahead(dial), Budget::MOST_SHIFT);
        let steps = (0..20).take_while(|_| {
            dial.note_wrong(BUDGET, 0.0);
            dial.is_past_its_end(BUDGET)
        });
        assert_eq!(steps.count(), 6);
    }

    #[test]
    fn fixed_pixels_stay_what_they_are() {
        let mut dial = Dial::default();
        dial.note_wrong(Budget::Shift(3.0), 5.0);
        assert_eq!(dial, Dial::default());
        for is_at_rest in [false, true] {
            let sides = |pixels| dial.margin(Budget::Shift(pixels), is_at_rest, 1.0).sides;
            assert_eq!(sides(3.0), 3.0);
            assert_eq!(sides(f32::NAN), 1.0);
            assert_eq!(sides(1e9), Budget::MOST_SHIFT);
        }
        assert!(!dial.is_past_its_end(Budget::Shift(1e9)));
    }
}
