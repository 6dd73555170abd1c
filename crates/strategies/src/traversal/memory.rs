//! What is remembered of nodes from frame to frame: verdicts that stay valid while the camera is slow.

use antumbra_draw::SceneTable;

use crate::occupancy::Screen;
use antumbra_cull::Tree;

/// How long verdicts stay valid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnswerLifetime {
    /// Frames for which what a query found visible is drawn without another.
    pub visible: u32,
    /// Frames for which what a query found occluded is left out without another: aggressive.
    pub occluded: u32,
    /// What counts as slow: the way the eye has come since, as a part of the distance to the node.
    pub slow: f64,
}

/// A node's last answer.
#[derive(Debug, Clone, Copy, Default)]
struct Note {
    visible: bool,
    /// The frame of the answer; frame 0 is before any.
    asked: u64,
    /// The last frame it is valid in.
    until: u64,
    /// How far the eye had come.
    travelled: f64,
}

/// Answers by node.
#[derive(Debug, Clone, Default)]
pub(crate) struct Memory {
    notes: Vec<Note>,
    frame: u64,
    travelled: f64,
    last_eye: Option<glam::DVec3>,
    seen_of: Option<(u64, u64, u64)>,
}

impl Memory {
    /// Begins a frame: forgets what another tree or camera cut was about, and what is occluded where anything has moved.
    pub fn begin(&mut self, tree: &Tree, table: &SceneTable, cuts: u64, screen: &Screen) {
        self.frame += 1;
        let now = (tree.generation(), cuts, table.epoch());
        let before = self.seen_of.replace(now).unwrap_or_default();
        if (before.0, before.1) != (now.0, now.1) {
            self.notes.clear();
            self.last_eye = None;
        } else if before.2 != now.2 {
            for note in self.notes.iter_mut().filter(|note| !note.visible) {
                note.until = 0;
            }
        }
        self.travelled += self.last_eye.map_or(0.0, |eye| eye.distance(screen.eye()));
        self.last_eye = Some(screen.eye());
    }

    /// The answer about a node that is still valid: `nearness` is the square of its distance.
    pub fn valid(&self, node: u32, nearness: f32, how: AnswerLifetime) -> Option<bool> {
        let note = self.notes.get(node as usize)?;
        let come = self.travelled - note.travelled;
        let slow = come * come <= f64::from(nearness) * how.slow * how.slow;
        (note.until >= self.frame && note.asked < self.frame && slow).then_some(note.visible)
    }

    /// Whether a node was hidden when it was last met, a frame or two ago.
    pub fn was_hidden(&self, node: u32) -> bool {
        let note = self.notes.get(node as usize);
        note.is_some_and(|note| note.asked > 0 && !note.visible && note.asked + 2 >= self.frame)
    }

    /// Whether a node was visible when it was last asked about.
    pub fn was_visible(&self, node: u32) -> bool {
        let note = self.notes.get(node as usize);
        note.is_some_and(|note| note.asked > 0 && note.visible)
    }

    /// Takes an answer.
    pub fn note(&mut self, node: u32, visible: bool, how: AnswerLifetime) {
        let frames = u64::from(if visible { how.visible } else { how.occluded });
        let at = node as usize;
        if self.notes.len() <= at {
            self.notes.resize(at + 1, Note::default());
        }
        // Spread, so that not all that was asked about together is asked about together again.
        let spread = (u64::from(node).wrapping_mul(0x9E37_79B9) >> 7) % (frames / 2 + 1);
        self.notes[at] = Note {
            visible,
            asked: self.frame,
            until: self.frame + frames - spread.min(frames),
            travelled: self.travelled,
        };
    }
}
