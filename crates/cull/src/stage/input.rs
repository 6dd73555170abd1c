//! What a stage is given in each frame: a camera a view and, in a host's frame, the targets.

use std::sync::Arc;

use antumbra_scene::Camera;

/// One view's part of a frame.
#[derive(Debug, Clone)]
pub struct ViewInput<'a> {
    /// The camera.
    pub camera: Camera,
    /// Whether the camera jumped since the last frame: earlier answers are then not used.
    pub cut: bool,
    /// The slots that own a pixel of the reference, ascending, for a strategy that [needs them](crate::Strategy::needs_reference).
    pub reference: Option<Arc<Vec<u32>>>,
    /// In [`Mode::Embedded`](antumbra_graph::Mode::Embedded): the targets. Their contents are kept and drawn over.
    pub targets: Option<ImportedTargets<'a>>,
}

impl ViewInput<'_> {
    /// A camera without a cut, reference or targets.
    pub fn new(camera: Camera) -> Self {
        Self {
            camera,
            cut: false,
            reference: None,
            targets: None,
        }
    }
}

/// The host's textures, of the view's size and the stage's samples, usable as render attachments. Depth is [`DEPTH_FORMAT`](crate::DEPTH_FORMAT), reversed. Where an audit or the
/// strategy reads it in a shader, it needs the usage `TEXTURE_BINDING` too; a frame without it is refused.
#[derive(Debug, Clone, Copy)]
pub struct ImportedTargets<'a> {
    /// Colour, of the stage's format.
    pub colour: &'a wgpu::Texture,
    /// Depth.
    pub depth: &'a wgpu::Texture,
}
