//! Plans of the steps that a budget has left. A step that the budget comes back to has its plan at once, with the memory of its nodes.

use super::built::Built;

/// The number of plans that are kept beside the present one. A controller moves between neighbouring steps, and each plan holds textures and buffers of its own.
const MOST: usize = 3;

/// The kept plans; each knows its step.
#[derive(Default)]
pub(super) struct KeptPlans(Vec<Built>);

impl KeptPlans {
    /// Keeps a plan. The one that has been kept longest is dropped if there are too many.
    pub fn keep(&mut self, plan: Built) {
        if self.0.len() == MOST {
            self.0.remove(0);
        }
        self.0.push(plan);
    }

    /// Takes back the plan of a step.
    pub fn take(&mut self, step: usize) -> Option<Built> {
        let at = self.0.iter().position(|kept| kept.step == step)?;
        Some(self.0.remove(at))
    }

    /// Drops them all: they were made for another scene or layout.
    pub fn clear(&mut self) {
        self.0.clear();
    }
}
