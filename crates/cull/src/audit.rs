//! The audit: randomly sampled frames draw some of the entities they culled against their own finished depth, in a few randomly sampled patches of the image, and count
//! the pixels in which any of them would have shown. A frame or two later that is an unbiased estimate of the wrong pixels of every frame.
//!
//! A patch is a cluster of a stratified sample (Cochran, *Sampling Techniques*, 3rd edition, 1977, chapters 5 and 9), and is weighted by the inverse of its probability
//! of being sampled (Horvitz and Thompson, *A Generalization of Sampling Without Replacement From a Finite Universe*, 1952). `docs/audit.md` has the derivation.

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

/// The group label of the audit's nodes.
pub const AUDIT: &str = "audit";

/// How a stage audits itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AuditOptions {
    /// Triangles that the audit may draw, as a part of those that the view draws, on average over frames; above 0, at most 1. A sampled frame draws at least one patch of
    /// each kind.
    pub share: f64,
    /// The part of the frames that is sampled, at random; 0.001 to 1. An audit has a fixed cost, its passes and their set-up, which only sampled frames pay; they get a
    /// larger part of `share` in return.
    pub frame_share: f64,
    /// Seeds the sampling. The same seed and frames give the same patches.
    pub seed: u64,
    /// Draws every patch of every frame, whatever `share` says: an exact count in place of an estimate. For tests and offline images.
    pub census: bool,
}

impl AuditOptions {
    /// `frame_share`, clamped to its range.
    fn frame_share_in_range(&self) -> f64 {
        match self.census {
            true => 1.0,
            // NaN counts as the least.
            false if self.frame_share.is_nan() => LEAST_FRAME_SHARE,
            false => self.frame_share.clamp(LEAST_FRAME_SHARE, 1.0),
        }
    }
}

/// An audit samples at least one frame in a thousand.
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
    /// The frame it is about, as the stage counts them ([`StageReport::frame`](crate::StageReport::frame)).
    pub frame: u64,
    /// The number of camera cuts of the view by then.
    pub cuts: u64,
    /// Patches that were sampled.
    pub patches: u32,
    /// Whether the frame was sampled, and the part of the frames that is.
    sampled: bool,
    frame_share: f64,
    /// Pixels of the view.
    pixels: f64,
    /// The most pixels that a wholly wrong patch stands for; 0 when all patches were sampled.
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
    /// In how many patches that were sampled independently.
    pub hits: f64,
}

impl FrameAudit {
    /// The frame's wrong pixels, in percent of the view's.
    pub fn wrong_pixels_percent(&self) -> Estimate {
        Estimate::of(std::iter::once(self))
    }

    /// Whether anything would have shown in a patch that was sampled: the frame has wrong pixels for certain.
    pub fn found_any(&self) -> bool {
        !self.hits.is_empty()
    }

    /// What the frame left out by its own count ([`Verdicts::left_out_percent`](crate::Verdicts::left_out_percent)); where that is counted on the GPU it is
    /// known of sampled frames alone.
    pub fn left_out_percent(&self) -> Option<f64> {
        self.left_out
    }

    /// A made-up result for tests: hits in percent of the image, uncertain or not.
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

    /// What a wholly wrong patch stands for, in percent of the image; 0 when all patches were sampled.
    pub(crate) fn heaviest_percent(&self) -> f64 {
        self.heaviest / self.pixels.max(1.0) * 100.0
    }

    /// Wrong pixels on uncertain patches, and what the frame meant to leave out, both in percent of the image and for this frame alone, not for the frames it stands for.
    /// `None` for a frame that was not sampled, or whose own count is unknown.
    pub(crate) fn meant(&self) -> Option<[f64; 2]> {
        let [_, uncertain] = self.by_kind();
        let left_out = self.left_out.filter(|_| self.sampled)?;
        Some([uncertain.percent * self.frame_share, left_out])
    }

    /// What was found on plain patches, and on uncertain ones.
    pub(crate) fn by_kind(&self) -> [Found; 2] {
        let mut kinds = [Found::default(); 2];
        for hit in &self.hits {
            let [plain, uncertain] = &mut kinds;
            let kind = if hit.uncertain { uncertain } else { plain };
            kind.percent += hit.pixels / self.pixels * 100.0;
            // Where whole frames are sampled, all hits of a frame are found or missed together.
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

/// What earlier frames taught about patches, by kind.
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
    /// The number of frames that are remembered.
    pub const REMEMBERED: usize = 4096;

    /// The latest frame whose result is in.
    pub fn latest(&self) -> Option<&FrameAudit> {
        self.frames.back()
    }

    /// The remembered frames, oldest first.
    pub fn frames(&self) -> impl DoubleEndedIterator<Item = &FrameAudit> + ExactSizeIterator {
        self.frames.iter()
    }

    /// The number of frames whose results are in, remembered or not.
    pub fn audited(&self) -> u64 {
        self.audited
    }

    /// The mean of the wrong pixels over the latest `frames` frames, in percent of a view's pixels; over all remembered frames where they are fewer.
    pub fn over(&self, frames: usize) -> Estimate {
        Estimate::of(self.frames.iter().rev().take(frames))
    }

    /// The mean over all remembered frames of several views.
    pub fn over_all(audits: &[&Self]) -> Estimate {
        Estimate::of(audits.iter().flat_map(|audit| &audit.frames))
    }

    /// What its frames taught about patches.
    pub(crate) fn experience(&self) -> &Experience {
        &self.experience
    }

    /// Replaces what it has learned.
    pub(crate) fn learn(&mut self, experience: Experience) {
        self.experience = experience;
    }

    /// Adds a frame, and forgets the oldest if there are too many.
    pub(crate) fn take(&mut self, frame: FrameAudit) {
        if self.frames.len() == Self::REMEMBERED {
            self.frames.pop_front();
        }
        self.audited += 1;
        self.frames.push_back(frame);
    }
}
