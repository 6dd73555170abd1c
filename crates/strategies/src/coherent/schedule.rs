//! Which candidates are tested in a frame where the host does not know which of them are occluded. Each slot is tested once in 1/fraction
//! frames, spread evenly over the frames. A slot without any earlier answer is tested at once.

use antumbra_cull::{Candidates, SceneTable};
use antumbra_scene::EntityKey;

/// The schedule of a view's tests.
#[derive(Debug, Default)]
pub(super) struct TestSchedule {
    slots: Vec<SlotState>,
    frame: u64,
    cuts: u64,
}

#[derive(Debug, Clone, Copy, Default)]
struct SlotState {
    entity: Option<EntityKey>,
    /// The last frame in which the slot was in the frustum.
    last_inside: u64,
    /// The slot's entity entered the frustum or the scene in this frame, or the camera was cut.
    new: bool,
}

impl TestSchedule {
    /// Starts a frame.
    pub fn begin(&mut self, table: &SceneTable, candidates: &Candidates) {
        let cuts = candidates.stamp().cuts;
        let cut = cuts != self.cuts;
        self.cuts = cuts;
        self.frame += 1;
        self.slots
            .resize_with(table.slots() as usize, SlotState::default);
        for slot in candidates.inside() {
            let entity = table.occupant(*slot).map(|occupant| occupant.key);
            if let Some(state) = self.slots.get_mut(*slot as usize) {
                let new = cut || state.entity != entity || state.last_inside + 1 != self.frame;
                *state = SlotState {
                    entity,
                    last_inside: self.frame,
                    new,
                };
            }
        }
    }

    /// Whether a slot in the frustum is tested in this frame.
    pub fn is_due(&self, slot: u32, fraction: f64) -> bool {
        let new = self.slots.get(slot as usize).is_none_or(|state| state.new);
        if new || fraction >= 1.0 {
            return true;
        }
        // Multiples of the golden ratio are spread evenly between 0 and 1.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let phase = (f64::from(slot) * GOLDEN).fract();
        let tests_until = |frame: u64| (frame as f64 * fraction + phase).floor();
        tests_until(self.frame) > tests_until(self.frame - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everyone_has_a_turn_within_the_frames_of_the_fraction_and_as_many_a_frame() {
        for (fraction, frames) in [(0.5, 2), (0.25, 4), (0.3, 4), (0.9, 2)] {
            let mut schedule = TestSchedule {
                slots: vec![SlotState::default(); 1000],
                ..TestSchedule::default()
            };
            for start in 1..6 {
                let mut had = vec![false; 1000];
                for frame in start..start + frames {
                    schedule.frame = frame;
                    let due: Vec<u32> = (0..1000)
                        .filter(|slot| schedule.is_due(*slot, fraction))
                        .collect();
                    let share = due.len() as f64 / 1000.0;
                    assert!((share - fraction).abs() < 0.02, "{share} of {fraction}");
                    for slot in due {
                        had[slot as usize] = true;
                    }
                }
                assert!(had.iter().all(|had| *had), "{fraction} from {start}");
            }
        }
    }
}
