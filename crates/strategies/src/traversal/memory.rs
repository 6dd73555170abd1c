//! Query answers that stay valid for later frames while the camera is slow.

use antumbra_cull::{SceneTable, Tree};

use super::eye_path::EyePath;
use super::settings::AnswerLifetime;
use crate::occupancy::Screen;

/// The last answer about a node.
#[derive(Debug, Clone, Copy, Default)]
struct NodeAnswer {
    visible: bool,
    /// The frame of the answer; 0: there is none.
    frame: u64,
    /// The last frame in which it is valid.
    valid_until: u64,
    /// The length of the eye's path at the answer, in metres.
    travelled: f64,
}

/// What the answers belong to. An answer about another tree, or from before a camera cut, is dropped. An answer "occluded" is dropped
/// when any entity has moved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct AnswerOrigin {
    generation: u64,
    cuts: u64,
    epoch: u64,
}

/// The last answers, by node.
#[derive(Debug, Clone, Default)]
pub(crate) struct NodeMemory {
    answers: Vec<NodeAnswer>,
    frame: u64,
    path: EyePath,
    origin: Option<AnswerOrigin>,
}

impl NodeMemory {
    /// Starts a frame and drops the answers that no longer hold. `cuts`: camera cuts of the view so far.
    pub fn begin(&mut self, tree: &Tree, table: &SceneTable, cuts: u64, screen: &Screen) {
        self.frame += 1;
        let now = AnswerOrigin {
            generation: tree.generation(),
            cuts,
            epoch: table.epoch(),
        };
        let before = self.origin.replace(now).unwrap_or_default();
        if (before.generation, before.cuts) != (now.generation, now.cuts) {
            self.answers.clear();
            self.path.restart();
        } else if before.epoch != now.epoch {
            for answer in self.answers.iter_mut().filter(|answer| !answer.visible) {
                answer.valid_until = 0;
            }
        }
        self.path.advance(screen.eye());
    }

    /// Whether a node was visible, by an answer of an earlier frame that is still valid. `distance_squared`: from the eye to the node, in
    /// square metres.
    pub fn valid(
        &self,
        node: u32,
        distance_squared: f32,
        lifetime: AnswerLifetime,
    ) -> Option<bool> {
        let answer = self.answers.get(node as usize)?;
        let slow = lifetime.is_slow(self.path.length() - answer.travelled, distance_squared);
        let valid = answer.valid_until >= self.frame && answer.frame < self.frame && slow;
        valid.then_some(answer.visible)
    }

    /// Whether the last answer, at most two frames old, found the node occluded.
    pub fn was_hidden(&self, node: u32) -> bool {
        let answer = self.answers.get(node as usize);
        answer.is_some_and(|answer| {
            answer.frame > 0 && !answer.visible && answer.frame + 2 >= self.frame
        })
    }

    /// Whether the last answer found the node visible.
    pub fn was_visible(&self, node: u32) -> bool {
        let answer = self.answers.get(node as usize);
        answer.is_some_and(|answer| answer.frame > 0 && answer.visible)
    }

    /// Stores an answer of this frame.
    pub fn store(&mut self, node: u32, visible: bool, lifetime: AnswerLifetime) {
        let frames = u64::from(if visible {
            lifetime.visible
        } else {
            lifetime.occluded
        });
        let at = node as usize;
        if self.answers.len() <= at {
            self.answers.resize(at + 1, NodeAnswer::default());
        }
        // Lifetimes are spread, so that the nodes of one batch do not all need a query in the same frame again.
        let spread = (u64::from(node).wrapping_mul(0x9E37_79B9) >> 7) % (frames / 2 + 1);
        self.answers[at] = NodeAnswer {
            visible,
            frame: self.frame,
            valid_until: self.frame + frames - spread.min(frames),
            travelled: self.path.length(),
        };
    }
}
