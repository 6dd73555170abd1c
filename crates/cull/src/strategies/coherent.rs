//! Coherence from frame to frame and from eye to eye: what was visible is drawn first and hides the rest.
//!
//! Mansa, Amundarain, Garcia-Alonso, Matey, *Occlusion Culling for Stereoscopic Display of Complex Mechanical Sets*, 2007: OCF for one eye, scOCF for
//! two. The scenes it is for are whole in the frustum and not densely occluded, so there is no hierarchy to walk and nothing to prepare.

mod asking;
mod fraction;
mod memory;
mod nearness;
mod next_eye;
mod one_eye;
mod settings;

use fraction::Share;
use one_eye::Eye;

use crate::frame_graph::FrameGraph;
use crate::setting::{Latency, Setting, SettingError};
use crate::strategy::{DeclareError, Strategy, VisibleSet};
use crate::view_nodes::ViewNodes;

/// What both strategies can be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coherence {
    /// When the answers of the tests are used.
    pub latency: Latency,
    /// The part of the occluded that is tested a frame: above 0, at most 1. Below 1 what appears may be late.
    pub fraction: f64,
    /// How many entities may be late on average: the fraction grows as far as that needs. 0: it is fixed.
    pub late: f64,
    /// How far the camera moves before the visible are sorted anew, as a part of its distance to the one in the middle of their list.
    pub resort: f64,
    /// Up to how many of the occluded are asked about together, by one query: where it finds a sample, all of them are drawn and asked about alone next
    /// time. 1: each alone, as in the paper.
    pub together: u32,
}

impl Default for Coherence {
    fn default() -> Self {
        Self {
            latency: Latency::FrameLate,
            fraction: 1.0,
            late: 0.0,
            resort: 0.01,
            together: 8,
        }
    }
}

impl Coherence {
    fn share(self) -> Share {
        Share {
            least: self.fraction,
            late: self.late,
        }
    }

    fn conservative(self) -> bool {
        self.latency != Latency::FrameLate && self.fraction >= 1.0
    }
}

/// The strategy `coherent`: each view on its own (OCF).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Coherent {
    /// Its settings.
    pub coherence: Coherence,
}

/// The strategy `stereo-coherent`: the first view as `coherent` does it, the others from what the first one saw (scOCF).
#[derive(Debug, Clone, Copy, Default)]
pub struct StereoCoherent {
    /// Its settings.
    pub coherence: Coherence,
    first: Option<Eye>,
}

impl StereoCoherent {
    /// With these settings.
    pub fn new(coherence: Coherence) -> Self {
        Self {
            coherence,
            first: None,
        }
    }
}

impl Strategy for Coherent {
    fn name(&self) -> &str {
        "coherent"
    }

    fn summary(&self) -> &str {
        "draws last frame's visible first, each with a query, and tests a fraction of the rest (Mansa et al. 2006)"
    }

    fn conservative(&self) -> bool {
        self.coherence.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.coherence.latency)
    }

    fn settings(&self) -> Vec<Setting> {
        self.coherence.settings()
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), SettingError> {
        self.coherence.set_of("coherent", key, value)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let eye = match self.coherence.latency {
            Latency::FrameLate => one_eye::frame_late(g, view, self.coherence, None),
            _ => one_eye::same_frame(g, view, self.coherence, true),
        };
        Ok(VisibleSet::drawn(eye.verdicts))
    }
}

impl Strategy for StereoCoherent {
    fn name(&self) -> &str {
        "stereo-coherent"
    }

    fn summary(&self) -> &str {
        "as coherent for the left eye; the right one draws what the left saw and tests what it did not (Mansa et al. 2007)"
    }

    fn conservative(&self) -> bool {
        self.coherence.conservative()
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.coherence.latency)
    }

    fn settings(&self) -> Vec<Setting> {
        self.coherence.settings()
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), SettingError> {
        self.coherence.set_of("stereo-coherent", key, value)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let how = self.coherence;
        let verdicts = match (self.first.as_mut(), view.index()) {
            (Some(first), index) if index > 0 => match how.latency {
                Latency::FrameLate => {
                    one_eye::frame_late(g, view, how, Some(first.verdicts)).verdicts
                }
                _ => next_eye::same_frame(g, view, how, first, index == 1),
            },
            _ => {
                let eye = match how.latency {
                    Latency::FrameLate => one_eye::frame_late(g, view, how, None),
                    // Its answers are the next eye's to collect, where there is one.
                    _ => one_eye::same_frame(g, view, how, view.is_last()),
                };
                self.first = Some(eye);
                eye.verdicts
            }
        };
        Ok(VisibleSet::drawn(verdicts))
    }
}
