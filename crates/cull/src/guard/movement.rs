//! Which entities have moved, and when.

use crate::entities::SceneTable;

/// The frame of each slot's last change: its entity was added, removed, moved or replaced.
#[derive(Debug, Default)]
pub(super) struct Movement {
    /// By slot; 0: never, as far as is known.
    changed: Vec<u64>,
    /// All slots may have changed in this frame.
    all: u64,
    epoch: Option<u64>,
    frame: u64,
}

impl Movement {
    /// Starts a frame.
    pub fn follow(&mut self, table: &SceneTable) {
        self.frame += 1;
        self.changed.resize(table.slots() as usize, self.frame);
        let before = self.epoch.replace(table.epoch());
        if before == self.epoch {
            return;
        }
        match before.and_then(|before| table.changed_since(before)) {
            None => self.all = self.frame,
            Some(slots) => {
                for slot in slots {
                    if let Some(changed) = self.changed.get_mut(*slot as usize) {
                        *changed = self.frame;
                    }
                }
            }
        }
    }

    /// The number of the frame, from 1.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Whether a slot may have changed after a frame.
    pub fn has_moved(&self, slot: u32, after: u64) -> bool {
        let changed = self
            .changed
            .get(slot as usize)
            .copied()
            .unwrap_or(self.frame);
        changed.max(self.all) > after
    }

    /// Whether a slot may have changed in the last `frames` frames, this one included.
    pub fn has_moved_within(&self, slot: u32, frames: u64) -> bool {
        self.has_moved(slot, self.frame.saturating_sub(frames))
    }
}
