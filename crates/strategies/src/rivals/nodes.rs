//! The nodes of a rival's tests.

use antumbra_cull::{CULL, FrameGraph, ResidentScene, ViewNodes, rows_of};
use antumbra_graph::{Bind, Buffer, BufferDesc};
use antumbra_shaders::Job;

use super::eye;
use super::pyramid::Pyramid;
use super::{Design, FirstPhase, Frame, Seen};

/// What a rival's tests read, in a view.
pub(super) struct Nodes {
    test: &'static Job,
    eye: Buffer,
    /// The boxes of all slots.
    boxes: Buffer,
    /// Those of the previous frame, where a test asks for them.
    previous_boxes: Option<Buffer>,
    pyramid: Pyramid,
}

impl Nodes {
    pub fn new(g: &mut FrameGraph<'_>, view: &ViewNodes, design: &Design) -> Self {
        let boxes = g.resident_scene(view).boxes;
        let looks_back = matches!(
            design.first,
            FirstPhase::Tested {
                boxes: Frame::Previous,
                ..
            }
        );
        Self {
            test: design.test,
            eye: eye::upload(g, view),
            boxes,
            previous_boxes: looks_back.then(|| keep(g, view, boxes).previous()),
            pyramid: Pyramid::new(g, view, design.pyramid),
        }
    }

    /// Tests all slots against the previous frame's pyramid. In the first frame it is empty, and hides nothing. Returns a u32 a slot: 1 where it is visible.
    pub fn test_first(
        &self,
        g: &mut FrameGraph<'_>,
        view: &ViewNodes,
        eye: Frame,
        boxes: Frame,
    ) -> Buffer {
        let eye = match eye {
            Frame::Previous => self.eye.previous(),
            Frame::This => self.eye,
        };
        let boxes = match (boxes, self.previous_boxes) {
            (Frame::Previous, Some(previous)) => previous,
            _ => self.boxes,
        };
        let (scene, layout) = (view.inputs().scene, self.pyramid.layout);
        let texels = self.pyramid.kept.previous();
        let found = BufferDesc::new(g.slot_bytes()).zeroed();
        let found = g.graph().buffer(view.named("first found"), found);
        let pipeline = g.compute_pipeline(self.test, "first");
        let mut node = g.graph().compute(view.named("test first"));
        node.group(CULL)
            .read(scene)
            .storage_read(eye)
            .storage_read(boxes)
            .storage_read(layout)
            .storage_read(texels);
        let found = node.storage_write(found);
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, eye),
                Bind::Buffer(1, boxes),
                Bind::Buffer(3, found),
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        found
    }

    /// Makes the pyramid that the next frame's first test reads, of what is drawn so far.
    pub fn keep_pyramid(&self, g: &mut FrameGraph<'_>, view: &ViewNodes) {
        self.pyramid.keep(g, view);
    }

    /// Tests the slots against a pyramid of what is drawn so far. `first`: what the first phase drew; `found`: where the answers are written. Also returns what is visible and not drawn yet.
    pub fn test_rest(
        &self,
        g: &mut FrameGraph<'_>,
        view: &ViewNodes,
        first: Buffer,
        found: Buffer,
    ) -> (Seen, Buffer) {
        let texels = self.pyramid.make(g, view);
        let (scene, layout) = (view.inputs().scene, self.pyramid.layout);
        let (eye, boxes) = (self.eye, self.boxes);
        let words = BufferDesc::new(g.slot_bytes()).zeroed();
        let besides = g.graph().buffer(view.named("found besides"), words);
        let drawn = g.graph().buffer(view.named("drawn"), words);
        let pipeline = g.compute_pipeline(self.test, "rest");
        let mut node = g.graph().compute(view.named("test rest"));
        node.group(CULL)
            .read(scene)
            .storage_read(eye)
            .storage_read(boxes)
            .storage_read(first)
            .storage_read(layout)
            .storage_read(texels);
        let [found, besides, drawn] =
            [found, besides, drawn].map(|words| node.storage_write(words));
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, eye),
                Bind::Buffer(1, boxes),
                Bind::Buffer(2, first),
                Bind::Buffer(3, found),
                Bind::Buffer(4, besides),
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
                Bind::Buffer(8, drawn),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        (Seen { found, drawn }, besides)
    }
}

/// Keeps a copy of the boxes for the next frame.
fn keep(g: &mut FrameGraph<'_>, view: &ViewNodes, boxes: Buffer) -> Buffer {
    let bytes = ResidentScene::box_bytes(g);
    let kept = BufferDesc::new(bytes);
    let kept = g.graph().buffer(view.named("kept boxes"), kept);
    let mut node = g.graph().copy(view.named("keep boxes"));
    node.group(CULL).copy_src(boxes);
    let kept = node.copy_dst(kept);
    node.run(move |ctx| {
        let (from, to) = (ctx.buffer(boxes)?, ctx.buffer(kept)?);
        ctx.encoder().copy_buffer_to_buffer(from, 0, to, 0, bytes);
        Ok(())
    });
    kept
}
