//! Whose turn it is to be tested, where nobody on the host knows who is occluded: each slot once in 1/fraction frames, spread evenly, and
//! whatever nothing can be known of in every frame.

use antumbra_draw::SceneTable;
use antumbra_scene::EntityKey;

use antumbra_cull::Candidates;

/// The turns of a view.
#[derive(Debug, Default)]
pub(super) struct Turns {
    of: Vec<Place>,
    frame: u64,
    cuts: u64,
}

#[derive(Debug, Clone, Copy, Default)]
struct Place {
    key: Option<EntityKey>,
    inside: u64,
    /// It came into the frustum or into its slot with this frame.
    new: bool,
}

impl Turns {
    /// Begins a frame.
    pub fn begin(&mut self, table: &SceneTable, candidates: &Candidates) {
        let cuts = candidates.stamp().cuts;
        let jumped = cuts != self.cuts;
        self.cuts = cuts;
        self.frame += 1;
        self.of.resize_with(table.slots() as usize, Place::default);
        for slot in candidates.inside() {
            let key = table.occupant(*slot).map(|occupant| occupant.key);
            if let Some(place) = self.of.get_mut(*slot as usize) {
                let new = jumped || place.key != key || place.inside + 1 != self.frame;
                *place = Place {
                    key,
                    inside: self.frame,
                    new,
                };
            }
        }
    }

    /// Whether a slot in the frustum is tested in this frame.
    pub fn is_due(&self, slot: u32, fraction: f64) -> bool {
        let new = self.of.get(slot as usize).is_none_or(|place| place.new);
        if new || fraction >= 1.0 {
            return true;
        }
        // Multiples of the golden ratio lie evenly between 0 and 1.
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let phase = (f64::from(slot) * GOLDEN).fract();
        let turns = |frames: u64| (frames as f64 * fraction + phase).floor();
        turns(self.frame) > turns(self.frame - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everyone_has_a_turn_within_the_frames_of_the_fraction_and_as_many_a_frame() {
        for (fraction, frames) in [(0.5, 2), (0.25, 4), (0.3, 4), (0.9, 2)] {
            let mut turns = Turns {
                of: vec![Place::default(); 1000],
                ..Turns::default()
            };
            for start in 1..6 {
                let mut had = vec![false; 1000];
                for frame in start..start + frames {
                    turns.frame = frame;
                    let due: Vec<u32> = (0..1000)
                        .filter(|slot| turns.is_due(*slot, fraction))
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
