//! Which occluded entities a frame tests: a fraction of them, in an order that reaches every one within 1/fraction frames.
//!
//! The fraction is that of Mansa et al. 2007, section 3.1. Beyond the paper, the entities whose last answers are oldest go first and, among
//! those, the entities nearest to something visible on the screen.

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

impl TestPicker {
    /// The slots to test in this frame, ascending.
    pub fn pick(
        &mut self,
        memory: &mut Memory,
        table: &SceneTable,
        view: &ViewFrame,
        rule: FractionRule,
    ) -> &[u32] {
        let all = memory.occluded().len();
        let fraction = memory.fraction.now(rule);
        let tested = ((all as f64 * fraction).ceil() as usize).min(all);
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
