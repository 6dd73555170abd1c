//! What a stage is built from: its views and its options.

use antumbra_graph::{LateResults, Mode};

use super::distrust::DistrustOptions;
use super::error::StageError;
use crate::audit::AuditOptions;
use crate::budget::Budget;
use crate::device::Gpu;

/// A view of a stage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ViewSpec {
    /// Its name: `main`, `left`, `right`.
    pub name: String,
    /// Width and height of its image in pixels.
    pub size: [u32; 2],
}

impl ViewSpec {
    /// The view of a stage that has only one.
    pub fn main(width: u32, height: u32) -> Self {
        Self {
            name: "main".to_owned(),
            size: [width, height],
        }
    }

    /// Refuses a view without pixels, and one that is larger than the device's textures.
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), StageError> {
        let most = gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = self.size;
        match self.size.iter().any(|side| *side == 0 || *side > most) {
            true => Err(StageError::Input(format!(
                "view '{}' of {width} x {height} pixels: each side must be 1 to {most}",
                self.name
            ))),
            false => Ok(()),
        }
    }
}

/// What a stage makes of what a strategy chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum StageOutput {
    /// An image: the renderer shades it.
    #[default]
    Image,
    /// What is drawn, for a host that draws by itself ([`Stage::draws`](crate::Stage::draws)), and verdicts. Nothing is shaded, and no targets are needed; strategies that draw some, test, and draw the rest draw depth and ids alone.
    Answers,
}

/// How a stage is built.
#[derive(Debug, Clone)]
pub struct StageOptions {
    /// Whether it submits on its own, or records into a host's encoder.
    pub mode: Mode,
    /// An image, or answers only.
    pub output: StageOutput,
    /// The format of the colour targets.
    pub colour_format: wgpu::TextureFormat,
    /// Samples a pixel: 1, 4, or what else the device has. An entity is visible if it owns a *sample*, and tests count samples. A stage that draws on its own
    /// resolves its colour; imported targets have as many samples, and their owner resolves them.
    pub samples: u32,
    /// The clear colour; unused where targets are imported.
    pub background: wgpu::Color,
    /// Whether GPU time is measured per pass, on devices with timestamps.
    pub timing: bool,
    /// Frames that the host has in flight, at least 1: so many are recorded before the first of them is done. Rings of read-backs have two slots more, and strategies keep late answers until newer ones can be there.
    pub frames_in_flight: u32,
    /// Which late answers a frame uses: the newest, or, for measurements, those of the frame that lies `frames_in_flight` before.
    pub late_results: LateResults,
    /// How frames audit themselves; `None`: they do not, and the plan has no such nodes.
    pub audit: Option<AuditOptions>,
    /// The budget that replaces settings. A budget of wrong pixels turns the audit on, with [`AuditOptions::default`] unless `audit` says otherwise.
    pub budget: Option<Budget>,
    /// What is done to find out whether the driver can be believed.
    pub distrust: DistrustOptions,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            mode: Mode::Owned,
            output: StageOutput::Image,
            colour_format: wgpu::TextureFormat::Rgba8UnormSrgb,
            samples: 1,
            background: wgpu::Color {
                r: 0.02,
                g: 0.025,
                b: 0.035,
                a: 1.0,
            },
            timing: false,
            frames_in_flight: 2,
            late_results: LateResults::Newest,
            audit: None,
            budget: None,
            distrust: DistrustOptions::default(),
        }
    }
}
