//! The view as rivals read it: with its rotation and its projection apart, since some of them test in view space.

use antumbra_cull::{CULL, FrameGraph, SplitPoint, ViewFrame, ViewNodes};
use antumbra_graph::{Buffer, BufferDesc};
use antumbra_scene::Projection;
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

/// Mirrors `RivalView` of `shared/rival.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuRivalView {
    clip_from_relative: [f32; 16],
    view_from_relative: [f32; 16],
    clip_from_view: [f32; 16],
    eye_high: [f32; 3],
    pixels_wide: f32,
    eye_low: [f32; 3],
    pixels_high: f32,
    count: u32,
    on_axis: u32,
    padding_a: u32,
    padding_b: u32,
}

assert_layout!(GpuRivalView, "rival_bevy", "RivalView", { clip_from_relative, view_from_relative, clip_from_view, eye_high, pixels_wide, eye_low, pixels_high, count, on_axis, padding_a, padding_b });

impl GpuRivalView {
    fn new(frame: &ViewFrame, slots: u32) -> Self {
        let SplitPoint { high, low } = SplitPoint::new(frame.camera.position);
        let on_axis = matches!(frame.camera.projection, Projection::Perspective { .. });
        let projection = frame.camera.projection_matrix(frame.aspect());
        Self {
            clip_from_relative: frame.clip_from_relative().to_cols_array(),
            view_from_relative: frame.camera.view_rotation().to_cols_array(),
            clip_from_view: projection.to_cols_array(),
            eye_high: high,
            pixels_wide: frame.size[0] as f32,
            eye_low: low,
            pixels_high: frame.size[1] as f32,
            count: slots,
            on_axis: u32::from(on_axis),
            padding_a: 0,
            padding_b: 0,
        }
    }
}

/// Uploads the view.
pub(super) fn upload(g: &mut FrameGraph<'_>, view: &ViewNodes) -> Buffer {
    let inputs = view.inputs();
    let desc = BufferDesc::new(size_of::<GpuRivalView>() as u64);
    let eye = g.graph().buffer(view.named("eye"), desc);
    let mut node = g.graph().host_node(view.named("upload eye"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    let eye = node.upload(eye);
    node.run(move |ctx| {
        let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
        let made = GpuRivalView::new(&frame, scene.table.slots());
        Ok(ctx.upload(eye, 0, bytemuck::bytes_of(&made))?)
    });
    eye
}
