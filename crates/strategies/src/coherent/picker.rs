//! Which occluded entities a frame tests: a fraction of them, in an order that reaches every one within 1/fraction frames.
//!
//! The fraction is that of Mansa et al. 2007, section 3.1. Beyond the paper, the entities whose last answers are oldest go first and, among
//! those, the entities nearest to something visible on the screen. Where answers belong to the frame of their tests, whoever has waited for
//! 1/fraction frames is tested, even where the fraction of those that are left is less.

use antumbra_cull::{SceneTable, ViewFrame};

use super::fraction::FractionRule;
use super::memory::Memory;
use super::screen_distance::ScreenDistance;

/// Picks the occluded entities of each frame. It is kept for its memory alone: no frame depends on the one before.
#[derive(Debug, Default)]
pub(super) struct TestPicker {
    distance: ScreenDistance,
    picked: Vec<u32>,
}

/// Whether an entity may wait longer than 1/fraction frames, where many were found meanwhile and the fraction is of fewer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Patience {
    /// No: an answer belongs to the frame of its test.
    Ends,
    /// Yes: answers are late, and seem older than they are.
    Endless,
}

impl TestPicker {
    /// The slots to test in this frame, ascending.
    pub fn pick(
        &mut self,
        memory: &mut Memory,
        table: &SceneTable,
        view: &ViewFrame,
        rule: FractionRule,
        patience: Patience,
    ) -> &[u32] {
        let all = memory.occluded().len();
        let fraction = memory.fraction.now(rule);
        let waited = match patience {
            Patience::Ends => {
                let frames = (1.0 / rule.least).ceil() as u64;
                let due = |slot: &&u32| memory.age(**slot) >= frames;
                memory.occluded().iter().filter(due).count()
            }
            Patience::Endless => 0,
        };
        let tested = ((all as f64 * fraction).ceil() as usize)
            .max(waited)
            .min(all);
        self.picked.clear();
        if tested == all {
            self.picked.extend_from_slice(memory.occluded());
        } else {
            self.distance.update(table, view, memory.visible());
            let mut order: Vec<(u64, u32, u32)> = memory
                .occluded()
                .iter()
                .map(|slot| {
                    let steps = self.distance.steps(&table.bounds(*slot), view);
                    (memory.answered(*slot), steps, *slot)
                })
                .collect();
            if let Some(last) = tested.checked_sub(1) {
                order.select_nth_unstable(last);
            }
            let first = order.iter().take(tested);
            self.picked.extend(first.map(|(.., slot)| *slot));
            self.picked.sort_unstable();
        }
        memory.fraction.tested = tested;
        &self.picked
    }
}
