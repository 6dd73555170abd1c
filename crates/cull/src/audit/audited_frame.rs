//! What the audit knows of a frame when it draws its patches, and what it learns when their marks come back, a frame or two later.

use std::sync::Arc;

use super::sample_plan::SamplePlan;
use super::strata::UNCERTAIN;
use super::{Audit, Experience, FrameAudit, Hit};
use crate::draw_source::patches::{MARK_BYTES, PATCH_BYTES, PATCH_SIDE};

/// An audited frame; travels with its marks.
#[derive(Debug, Clone, Default)]
pub(super) struct AuditedFrame {
    pub plan: Arc<SamplePlan>,
    /// The cost of finding and listing the entities of each patch, in triangles.
    pub work: Arc<Vec<f64>>,
    pub cuts: u64,
    /// What the frame left out by its own count, in percent of the image, where the host knows it.
    pub left_out: Option<f64>,
    /// Samples of the image that is counted in, where the threshold is adapted on the GPU, which then says what was left out.
    pub counted: Option<u32>,
    /// Pixels of the view.
    pub pixels: f64,
    pub census: bool,
    pub frame_share: f64,
    /// There was no room for all entries: the frame says nothing.
    pub spilled: bool,
}

impl AuditedFrame {
    /// Whether the frame is sampled.
    pub fn is_sampled(&self) -> bool {
        self.plan.sampled
    }

    /// Adds what the marks of the frame say to an audit.
    pub fn take_marks(&self, audit: &mut Audit, frame: u64, bytes: &[u8]) {
        if self.spilled {
            return;
        }
        let side = f64::from(PATCH_SIDE);
        let pixels_a_patch = side * side;
        let Experience { costs, moments } = &mut audit.experience;
        if self.plan.sampled {
            moments.fade();
            costs.fade();
        }
        let mut hits = Vec::new();
        let kept = bytes.chunks_exact(PATCH_BYTES as usize);
        let drawn = self.plan.drawn.iter().zip(self.work.iter());
        for (((_, kind), work), kept) in drawn.zip(kept) {
            let (marks, indices) = kept.split_at(MARK_BYTES as usize);
            let indices: u32 = bytemuck::pod_read_unaligned(indices);
            costs.note(*kind, work + f64::from(indices) / 3.0);
            let shown: u32 = marks.iter().map(|byte| byte.count_ones()).sum();
            moments.note(*kind, f64::from(shown) / pixels_a_patch);
            if shown > 0 {
                let weight = self.plan.weights.get(*kind).copied().unwrap_or(0.0);
                hits.push(Hit {
                    pixels: f64::from(shown) * weight,
                    uncertain: *kind == UNCERTAIN,
                });
            }
        }
        let left_out = match (self.counted, bytes.last_chunk()) {
            (Some(_), _) if !self.plan.sampled => None,
            (Some(all), Some(samples)) => {
                Some(f64::from(u32::from_le_bytes(*samples)) / f64::from(all.max(1)) * 100.0)
            }
            _ => self.left_out,
        };
        let heaviest = match self.census {
            true => 0.0,
            false => self.plan.heaviest() * pixels_a_patch,
        };
        audit.take(FrameAudit {
            frame,
            cuts: self.cuts,
            patches: self.plan.drawn.len() as u32,
            sampled: self.plan.sampled,
            frame_share: self.frame_share,
            pixels: self.pixels,
            heaviest,
            hits,
            left_out,
        });
    }
}
