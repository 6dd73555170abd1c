//! A view that is judged for: its name, its size and its depth.

use super::depth::HostDepth;
use super::error::JudgeError;
use super::pyramid::GpuPyramid;
use crate::device::Gpu;

/// A view of a [`Judge`](super::Judge).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JudgeView {
    /// Its name, for errors and for the names of passes.
    pub name: String,
    /// Width and height of its depth in pixels. All of the texture is the view.
    pub size: [u32; 2],
    /// The depth textures that it is judged by.
    pub depth: HostDepth,
}

impl JudgeView {
    /// The view of a judge that has only one.
    pub fn main(width: u32, height: u32, depth: HostDepth) -> Self {
        Self {
            name: "main".to_owned(),
            size: [width, height],
            depth,
        }
    }

    /// Refuses a view without pixels, one that is larger than the device's textures, and a depth that cannot be judged by.
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), JudgeError> {
        let most = gpu.device.limits().max_texture_dimension_2d.min(1 << 15);
        let [width, height] = self.size;
        let why = if self.size.iter().any(|side| *side == 0 || *side > most) {
            Some(format!(
                "it has {width} x {height} pixels, and each side must be 1 to {most}"
            ))
        } else if self.depth.samples > 1 && !gpu.reads_drawn_samples() {
            Some(format!(
                "its depth has {} samples a pixel, and wgpu's OpenGL backend cannot read such textures: write the farthest sample of each pixel into a depth of one sample, or take another backend",
                self.depth.samples
            ))
        } else {
            let bytes = GpuPyramid::new(self.size, self.depth).texels() * 4;
            let binding = gpu.device.limits().max_storage_buffer_binding_size;
            match self.depth.fault() {
                None if bytes > binding => Some(format!(
                    "its pyramid needs {bytes} bytes, and this device's buffers end at {binding}: ask the device for more, or judge a smaller depth"
                )),
                fault => fault,
            }
        };
        match why {
            Some(why) => Err(JudgeError::View {
                view: self.name.clone(),
                why,
            }),
            None => Ok(()),
        }
    }
}
