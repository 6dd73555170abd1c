//! The knobs that both coherent strategies have.

use super::Coherence;
use antumbra_cull::{LATENCY_RANGE, Setting, SettingError, parse};

const FRACTION_RANGE: &str = "a number above 0 and at most 1";
const LATE_RANGE: &str = "a number from 0 (a fixed fraction) to 1000000";
const RESORT_RANGE: &str = "a number from 0 to 10";
const TOGETHER_RANGE: &str = "a whole number from 1 (each alone) to 256";

impl Coherence {
    pub(super) fn settings(&self) -> Vec<Setting> {
        let setting = |key, value, range, meaning| Setting {
            key,
            value,
            range,
            meaning,
        };
        vec![
            setting(
                "latency",
                self.latency.to_string(),
                LATENCY_RANGE,
                "when the answers are used",
            ),
            setting(
                "fraction",
                self.fraction.to_string(),
                FRACTION_RANGE,
                "part of the occluded that is tested a frame; the rest stays occluded",
            ),
            setting(
                "late",
                self.late.to_string(),
                LATE_RANGE,
                "entities that may appear late, on average: the fraction grows as far as that needs; 0: it is fixed",
            ),
            setting(
                "resort",
                self.resort.to_string(),
                RESORT_RANGE,
                "camera motion that sorts the visible anew, as a part of the distance to the one in their middle",
            ),
            setting(
                "together",
                self.together.to_string(),
                TOGETHER_RANGE,
                "up to how many of those that stay occluded one query asks about",
            ),
        ]
    }

    /// Turns one of them; false for a key that is none.
    pub(super) fn set(&mut self, key: &str, value: &str) -> Result<bool, SettingError> {
        match key {
            "latency" => self.latency = parse(key, value, LATENCY_RANGE, |_| true)?,
            "fraction" => {
                self.fraction = parse(key, value, FRACTION_RANGE, |part| {
                    *part > 0.0 && *part <= 1.0
                })?;
            }
            "late" => {
                self.late = parse(key, value, LATE_RANGE, |late| {
                    (0.0..=1_000_000.0).contains(late)
                })?;
            }
            "resort" => {
                self.resort = parse(key, value, RESORT_RANGE, |part| (0.0..=10.0).contains(part))?;
            }
            "together" => {
                self.together = parse(key, value, TOGETHER_RANGE, |together| {
                    (1..=256).contains(together)
                })?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// [`Self::set`], where an unknown key is an error.
    pub(super) fn set_of(
        &mut self,
        strategy: &str,
        key: &str,
        value: &str,
    ) -> Result<(), SettingError> {
        if self.set(key, value)? {
            return Ok(());
        }
        Err(SettingError::Unknown {
            strategy: strategy.to_owned(),
            key: key.to_owned(),
            known: self.settings().iter().map(|setting| setting.key).collect(),
        })
    }
}
