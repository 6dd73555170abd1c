//! How wrong a frame was: what a camera had culled, and its own test then found not to be hidden, is drawn against that frame's depth.
//!
//! It takes some frames: in one the depth is copied; when the answers about it arrive, there are suspects, which are drawn in the next; and their count comes back later still.

mod counter;

pub(crate) use counter::Counter;

use antumbra::cull::Gpu;
use bevy::prelude::*;

use crate::dial::Margin;
use crate::meshes::Placed;
use crate::settings::Audit;

/// What the render world has to do for an audit in a frame.
pub(crate) enum Order {
    Nothing,
    /// Copy this frame's depth.
    Copy(Gpu),
    /// Draw these against the copy, with the matrix of its frame.
    Count(Vec<Placed>, Mat4),
}

/// How far a camera's audit is.
#[derive(Default)]
pub(crate) struct Auditing {
    step: Step,
    /// Frames since the last audit began.
    since: u32,
}

#[derive(Default)]
enum Step {
    #[default]
    Idle,
    /// The depth of this frame was copied.
    Copied(Audited),
    /// What was found not to be hidden.
    Suspects(Audited),
    /// Their pixels are being counted.
    Counting { margin: Option<Margin> },
}

/// A frame that is audited.
pub(crate) struct Audited {
    /// The judge's number of it.
    pub frame: u64,
    pub clip_from_world: Mat4,
    /// What its answers were asked with, where the camera moved then and since.
    pub margin: Option<Margin>,
    /// What was culled; later, what should not have been.
    pub culled: Vec<Entity>,
}

/// An audit that takes more frames than this has been lost.
const PATIENCE: u32 = 32;

impl Auditing {
    /// Counts a frame. Returns whether one is to be audited now.
    pub fn is_due(&mut self, audit: Audit) -> bool {
        self.since = self.since.saturating_add(1);
        let Audit::Every(frames) = audit else {
            self.step = Step::Idle;
            return false;
        };
        if self.since > PATIENCE.max(frames) {
            self.step = Step::Idle;
        }
        matches!(self.step, Step::Idle) && self.since >= frames.max(1)
    }

    /// Begins with a frame.
    pub fn begin(&mut self, audited: Audited) {
        self.since = 0;
        self.step = Step::Copied(audited);
    }

    /// Keeps of what was culled what was not hidden, by the answers about a frame.
    pub fn note_answers(&mut self, frame: u64, is_hidden: impl Fn(Entity) -> bool) {
        self.step = match std::mem::take(&mut self.step) {
            Step::Copied(mut audited) if audited.frame == frame => {
                audited.culled.retain(|entity| !is_hidden(*entity));
                Step::Suspects(audited)
            }
            // The answers about it will not come any more.
            Step::Copied(audited) if audited.frame < frame => Step::Idle,
            step => step,
        };
    }

    /// What is to be counted, if the suspects are known.
    pub fn take_suspects(&mut self) -> Option<Audited> {
        match std::mem::take(&mut self.step) {
            Step::Suspects(audited) => {
                let margin = audited.margin;
                self.step = Step::Counting { margin };
                Some(audited)
            }
            step => {
                self.step = step;
                None
            }
        }
    }

    /// Passes a frame over in which nothing was culled.
    pub fn pass(&mut self) {
        self.since = 0;
    }

    /// Ends with a count. Returns [`Audited::margin`]; `None` where no audit was under way.
    pub fn end(&mut self) -> Option<Option<Margin>> {
        match std::mem::take(&mut self.step) {
            Step::Counting { margin } => Some(margin),
            step => {
                self.step = step;
                None
            }
        }
    }
}
