//! The audit: frames, chosen by lot, draw some of what they culled against their own finished depth, in a few small patches of the image chosen by lot, and
//! count the pixels in which anything of it would have shown. A frame late that is an unbiased estimate of every frame's wrong pixels.
//!
//! A patch is a cluster of a stratified sample (Cochran, *Sampling Techniques*, 3rd edition, 1977, chapters 5 and 9), and each drawn patch
//! stands for as many as its chance of being drawn says (Horvitz and Thompson, *A Generalization of Sampling Without Replacement From a Finite
//! Universe*, 1952). `docs/audit.md` has the derivation.

mod audited_frame;
mod chooser;
mod depth_cull;
mod interval;
mod nodes;
mod patch_frustum;
mod sample_plan;
mod screen_box;
mod strata;
mod uncertain;

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

pub use interval::Estimate;
use sample_plan::Costs;
use strata::Moments;

/// The label of what the audit costs.
pub const AUDIT: &str = "audit";

/// How a stage audits itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AuditOptions {
    /// The part of the triangles a view draws that the audit may draw again, on average over frames; above 0, at most 1. A frame that is
    /// looked at looks at a patch of each kind whatever that pays for.
    pub share: f64,
    /// The part of the frames that are looked at, by lot; 0.001 to 1. What an audit takes however little it looks at, two passes and their
    /// turns, is paid that seldom, and the frames that are looked at get as much more of `share`.
    pub frame_share: f64,
    /// Seeds the plan. The same seed and frames give the same patches.
    pub seed: u64,
    /// Draws every patch of every frame, whatever `share` says: no estimate but the count itself. For tests, and for images nobody waits for.
    pub census: bool,
}

impl AuditOptions {
    /// The part of the frames that are looked at, within its range whatever was asked for.
    fn frame_share_in_range(&self) -> f64 {
        match self.census {
            true => 1.0,
            // What is no number is looked at as seldom as can be.
            false if self.frame_share.is_nan() => LEAST_FRAME_SHARE,
            false => self.frame_share.clamp(LEAST_FRAME_SHARE, 1.0),
        }
    }
}

/// No audit looks at fewer frames than one in a thousand.
const LEAST_FRAME_SHARE: f64 = 1e-3;

impl Default for AuditOptions {
    fn default() -> Self {
        Self {
            share: 0.08,
            frame_share: 0.25,
            seed: 0,
            census: false,
        }
    }
}

/// What the audit found in one frame of one view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrameAudit {
    /// The frame it is about, as the plan counts them.
    pub frame: u64,
    /// How often the view's camera had been cut by then.
    pub cuts: u64,
    /// Patches that were looked at.
    pub patches: u32,
    /// Whether its lot was to be looked at, and how large a part of the frames that is.
    sampled: bool,
    frame_share: f64,
    /// Pixels of the view.
    pixels: f64,
    /// The most pixels that one pixel looked at stands for, times those of a patch; 0 when all were looked at.
    heaviest: f64,
    /// Each patch in which something would have shown.
    hits: Vec<Hit>,
    /// What the frame left out by its own count, in percent of the image.
    left_out: Option<f64>,
}

/// A patch in which something would have shown.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Hit {
    /// The pixels that it stands for.
    pixels: f64,
    /// Whether an entity below the threshold lies on it.
    uncertain: bool,
}

/// What was found in the patches of one kind.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Found {
    /// Percent of the view's pixels.
    pub percent: f64,
    /// In how many patches that were drawn by plan of their own.
    pub hits: f64,
}

impl FrameAudit {
    /// The frame's wrong pixels, in percent of the view's.
    pub fn wrong_pixels_percent(&self) -> Estimate {
        Estimate::of(std::iter::once(self))
    }

    /// What the frame left out by its own count ([`Verdicts::left_out_percent`](crate::Verdicts::left_out_percent)); where that is counted on the GPU it is
    /// known of frames that were looked at.
    pub fn left_out_percent(&self) -> Option<f64> {
        self.left_out
    }

    /// What an audit might have found: hits in percent of the image, uncertain or not.
    #[cfg(test)]
    pub(crate) fn made_up(
        frame: u64,
        heaviest: f64,
        hits: impl Iterator<Item = (f64, bool)>,
        left_out: Option<f64>,
    ) -> Self {
        let hits = hits.map(|(pixels, uncertain)| Hit { pixels, uncertain });
        Self {
            frame,
            heaviest,
            pixels: 100.0,
            hits: hits.collect(),
            left_out,
            sampled: true,
            frame_share: 1.0,
            ..Self::default()
        }
    }

    /// What a patch stands for that is wrong all over, in percent of the image; 0 where all were looked at.
    pub(crate) fn heaviest_percent(&self) -> f64 {
        self.heaviest / self.pixels.max(1.0) * 100.0
    }

    /// What was found wrong in percent of the image where something below the threshold lies, and what the frame meant to leave out; taken for itself, not for
    /// the frames beside it that nobody looked at. `None` where it is one of these, or nothing is known of what was meant.
    pub(crate) fn meant(&self) -> Option<[f64; 2]> {
        let [_, uncertain] = self.by_kind();
        let left_out = self.left_out.filter(|_| self.sampled)?;
        Some([uncertain.percent * self.frame_share, left_out])
    }

    /// What was found where nothing below the threshold lies, and where something does.
    pub(crate) fn by_kind(&self) -> [Found; 2] {
        let mut kinds = [Found::default(); 2];
        for hit in &self.hits {
            let [plain, uncertain] = &mut kinds;
            let kind = if hit.uncertain { uncertain } else { plain };
            kind.percent += hit.pixels / self.pixels * 100.0;
            // Where a lot decides about whole frames, all that is found in one is found together.
            kind.hits = if self.frame_share < 1.0 {
                1.0
            } else {
                kind.hits + 1.0
            };
        }
        kinds
    }
}

/// What the audit of a view has found so far.
#[derive(Debug, Clone, Default)]
pub struct Audit {
    frames: VecDeque<FrameAudit>,
    experience: Experience,
    audited: u64,
}

/// What earlier frames taught of patches, by kind.
#[derive(Debug, Clone, Default)]
pub(crate) struct Experience {
    moments: Moments,
    costs: Costs,
}

/// Hands experience to the audit of a plan, before its next frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct Lessons(Arc<Mutex<Option<Experience>>>);

impl Lessons {
    /// Leaves experience to be taken.
    pub fn teach(&self, experience: Experience) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(experience);
    }

    fn take(&self) -> Option<Experience> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Audit {
    /// Frames that are remembered.
    pub const REMEMBERED: usize = 4096;

    /// What is known of the latest frame whose answer has come.
    pub fn latest(&self) -> Option<&FrameAudit> {
        self.frames.back()
    }

    /// What is remembered, oldest first.
    pub fn frames(&self) -> impl DoubleEndedIterator<Item = &FrameAudit> + ExactSizeIterator {
        self.frames.iter()
    }

    /// Frames whose answers have come, remembered or not.
    pub fn audited(&self) -> u64 {
        self.audited
    }

    /// The mean of the wrong pixels over the latest so many frames, in percent of a view's; over all that are remembered where they are fewer.
    pub fn over(&self, frames: usize) -> Estimate {
        Estimate::of(self.frames.iter().rev().take(frames))
    }

    /// The mean over all that several views remember.
    pub fn over_all(audits: &[&Self]) -> Estimate {
        Estimate::of(audits.iter().flat_map(|audit| &audit.frames))
    }

    /// What its frames taught of patches.
    pub(crate) fn experience(&self) -> &Experience {
        &self.experience
    }

    /// Goes on from what others taught.
    pub(crate) fn learn(&mut self, experience: Experience) {
        self.experience = experience;
    }

    /// Takes a frame in, forgetting the oldest where there are enough.
    pub(crate) fn take(&mut self, frame: FrameAudit) {
        if self.frames.len() == Self::REMEMBERED {
            self.frames.pop_front();
        }
        self.audited += 1;
        self.frames.push_back(frame);
    }
}
