//! The knobs of the strategies with occupancy maps.

use antumbra_scene::hierarchy::Shape;

use super::Occupancy;
use antumbra_cull::{Latency, Setting, SettingError, Strategy, parse};

const LATENCY_RANGE: &str = "frame-late or same-frame";
const TREE_RANGE: &str = "groups, boxes or divided";
const BLOCK_RANGE: &str = "a whole number from 1 to 256";
const GRAIN_RANGE: &str = "a whole number from 0 to 4294967295";
const SMALL_RANGE: &str = "a number from 0 (nothing is dropped) to 64";
const SEEN_RANGE: &str = "a number from 0 (as in the paper) to 1";
const TOGETHER_RANGE: &str = "a whole number from 1 (each alone) to 256";
const FRAMES_RANGE: &str = "a whole number from 0 to 1000";
const SLOW_RANGE: &str = "a number from 0 to 10";
const BOOL_RANGE: &str = "true or false";
const ORDER_RANGE: &str = "state or depth";

/// Knobs that say nothing to a walk that asks about one node at a time.
pub(super) const OF_BATCHES: [&str; 3] = ["least-seen", "together", "worth"];

/// The setting `latency`.
pub(super) fn latency(latency: Latency) -> Setting {
    Setting {
        key: "latency",
        value: latency.to_string(),
        range: LATENCY_RANGE,
        meaning: "when the answers are used",
    }
}

/// Reads it.
pub(super) fn parse_latency(value: &str) -> Result<Latency, SettingError> {
    parse("latency", value, LATENCY_RANGE, |latency| {
        *latency != Latency::OnGpu
    })
}

/// That a strategy has no such knob.
pub(super) fn unknown(strategy: &dyn Strategy, key: &str) -> SettingError {
    SettingError::Unknown {
        strategy: strategy.name().to_owned(),
        key: key.to_owned(),
        known: strategy
            .settings()
            .iter()
            .map(|setting| setting.key)
            .collect(),
    }
}

impl Occupancy {
    pub(super) fn settings(&self) -> Vec<Setting> {
        let order = if self.by_depth { "depth" } else { "state" };
        let all: [(_, String, _, _); 12] = [
            (
                "tree",
                self.tree.to_string(),
                TREE_RANGE,
                "the scene's groups, boxes over boxes, or groups with the wide ones divided",
            ),
            (
                "block",
                self.block.to_string(),
                BLOCK_RANGE,
                "pixels along a side of a block of the map",
            ),
            (
                "grain",
                self.grain.to_string(),
                GRAIN_RANGE,
                "triangles below a node that is not opened",
            ),
            (
                "small",
                self.small.to_string(),
                SMALL_RANGE,
                "pixels in width and height below which a sub-tree is dropped (aggressive)",
            ),
            (
                "least-seen",
                self.least_seen.to_string(),
                SEEN_RANGE,
                "part of a batch that must come out visible for the next one to be organised as well",
            ),
            (
                "together",
                self.together.to_string(),
                TOGETHER_RANGE,
                "up to how many neighbours in the tree that were hidden a frame ago one query asks about",
            ),
            (
                "worth",
                self.worth.to_string(),
                GRAIN_RANGE,
                "triangles that a wait must be able to save, beside 190 a query; where it cannot, those who wait are drawn",
            ),
            (
                "visible-for",
                self.visible_for.to_string(),
                FRAMES_RANGE,
                "frames for which what was found visible is drawn without another query",
            ),
            (
                "occluded-for",
                self.occluded_for.to_string(),
                FRAMES_RANGE,
                "frames for which what was found occluded is left out without another query (aggressive)",
            ),
            (
                "slow",
                self.slow.to_string(),
                SLOW_RANGE,
                "the way the eye may have come since an answer that stays valid, as a part of its distance to the node",
            ),
            (
                "order",
                order.to_owned(),
                ORDER_RANGE,
                "whether a batch is drawn by pipeline, texture and mesh, or near ones first",
            ),
            (
                "sketch",
                self.sketch.to_string(),
                BOOL_RANGE,
                "whether a sketch of the walk is left for whoever debugs it",
            ),
        ];
        all.into_iter()
            .map(|(key, value, range, meaning)| Setting {
                key,
                value,
                range,
                meaning,
            })
            .collect()
    }

    /// Turns one of them; false for a key that is none.
    pub(super) fn set(&mut self, key: &str, value: &str) -> Result<bool, SettingError> {
        let frames = || parse(key, value, FRAMES_RANGE, |frames| *frames <= 1000);
        match key {
            "tree" => self.tree = parse::<Shape>(key, value, TREE_RANGE, |_| true)?,
            "block" => {
                self.block = parse(key, value, BLOCK_RANGE, |block| (1..=256).contains(block))?;
            }
            "grain" => self.grain = parse(key, value, GRAIN_RANGE, |_| true)?,
            "small" => {
                self.small = parse(key, value, SMALL_RANGE, |small| {
                    (0.0..=64.0).contains(small)
                })?;
            }
            "least-seen" => {
                self.least_seen = parse(key, value, SEEN_RANGE, |seen| (0.0..=1.0).contains(seen))?;
            }
            "together" => {
                self.together = parse(key, value, TOGETHER_RANGE, |together| {
                    (1..=256).contains(together)
                })?;
            }
            "worth" => self.worth = parse(key, value, GRAIN_RANGE, |_| true)?,
            "visible-for" => self.visible_for = frames()?,
            "occluded-for" => self.occluded_for = frames()?,
            "slow" => {
                self.slow = parse(key, value, SLOW_RANGE, |slow| (0.0..=10.0).contains(slow))?
            }
            "order" => {
                let order: String = parse(key, value, ORDER_RANGE, |order: &String| {
                    ["state", "depth"].contains(&order.as_str())
                })?;
                self.by_depth = order == "depth";
            }
            "sketch" => self.sketch = parse(key, value, BOOL_RANGE, |_| true)?,
            _ => return Ok(false),
        }
        Ok(true)
    }
}
