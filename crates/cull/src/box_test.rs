//! Tests the boxes of all entities against a pyramid of what a view has drawn so far: a step for strategies that draw what was visible first, and then what
//! they find. Nothing is read back, and nothing by entity is done on the host while the scene stands still.

use antumbra_graph::{Bind, Buffer, BufferDesc, Host, Texture};
use antumbra_scene::Topology;
use antumbra_shaders::jobs;

use crate::compute_pipeline::rows_of;
use crate::entities::SceneTable;
use crate::frame_graph::{CULL, FrameGraph, Shared};
use crate::judge::{
    AT_MIDDLES, Eye, GpuJudgedView, HostDepth, JudgedInstance, Part, PyramidNodes, depth_pyramid,
};
use crate::renderer::DEPTH_FORMAT;
use crate::view_nodes::ViewNodes;

/// What a test of boxes has found, a u32 a slot: 1 or 0.
#[derive(Debug, Clone, Copy)]
pub struct BoxTest {
    /// Visible by its box. So are entities across the near plane, those that are not tested, and lines and points, which cover pixels outside their boxes.
    pub found: Buffer,
    /// Those of them that are not drawn yet: they are transparent, or were not seen.
    pub rest: Buffer,
    /// All that is drawn with them: what was seen and is not transparent, and what was found.
    pub drawn: Buffer,
}

/// What is known of the boxes on the device.
#[derive(Debug, Clone, Copy, Default)]
struct HeldBoxes {
    /// The epoch whose boxes the device has said to have.
    epoch: Option<u64>,
}

impl FrameGraph<'_> {
    /// Tests the boxes of all entities against the view's depth so far. A box is hidden if its nearest point is behind the farthest sample of every pixel that it may touch;
    /// equal depths are visible. `seen`: a u32 a slot, not 0 where an entity is drawn already unless it is transparent; `found`: where the answers are written, such as [`Self::sample_counts`].
    ///
    /// Needs a device that [reads the samples of what was drawn](crate::Gpu::reads_drawn_samples), where there are several a pixel.
    pub fn test_boxes(&mut self, view: &ViewNodes, seen: Buffer, found: Buffer) -> BoxTest {
        let host = HostDepth {
            format: DEPTH_FORMAT,
            samples: self.samples(),
            ..HostDepth::default()
        };
        let boxes = self.slot_boxes(view);
        let depth = view.targets.depth;
        let (size, inputs) = (view.size(), view.inputs());
        let PyramidNodes { layout, texels } = self.pyramid(view, depth, host);
        let uniform = BufferDesc::new(size_of::<GpuJudgedView>() as u64);
        let uniform = self.graph().buffer(view.named("box test: view"), uniform);
        let mut node = self.graph().host_node(view.named("upload view of boxes"));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let uniform = node.upload(uniform);
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let eye = Eye::of(&frame.camera, size);
            let flags = if host.samples == 1 { AT_MIDDLES } else { 0 };
            let made = GpuJudgedView::new(&eye, size, host, scene.table.slots(), flags);
            Ok(ctx.upload(uniform, 0, bytemuck::bytes_of(&made))?)
        });
        let job = match host.samples {
            1 => &jobs::test_slots_one::JOB,
            _ => &jobs::test_slots_many::JOB,
        };
        let pipeline = self.compute_pipeline(job, "test_slots");
        let bytes = self.slot_bytes();
        let mut words = |name: &str| {
            let name = view.named(name);
            self.graph().buffer(name, BufferDesc::new(bytes).zeroed())
        };
        let (rest, drawn) = (words("found besides"), words("drawn"));
        let mut node = self.graph().compute(view.named("test boxes"));
        node.group(CULL)
            .read(inputs.scene)
            .storage_read(uniform)
            .storage_read(boxes)
            .storage_read(seen)
            .storage_read(layout)
            .storage_read(texels)
            .sample(depth);
        let [found, rest, drawn] = [found, rest, drawn].map(|words| node.storage_write(words));
        node.run(move |ctx| {
            let slots = ctx.get(inputs.scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, uniform),
                Bind::Buffer(1, boxes),
                Bind::Buffer(2, seen),
                Bind::Buffer(3, found),
                Bind::Buffer(4, rest),
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
                Bind::Texture(7, depth),
                Bind::Buffer(8, drawn),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        BoxTest { found, rest, drawn }
    }

    fn pyramid(&mut self, view: &ViewNodes, depth: Texture, host: HostDepth) -> PyramidNodes {
        let Shared { gpu, pipelines, .. } = &mut *self.shared;
        let prefix = view.named("");
        depth_pyramid(
            self.graph,
            gpu,
            pipelines,
            &prefix,
            (depth, host),
            view.size(),
        )
    }

    /// Bytes of [`Self::slot_boxes`].
    pub fn slot_box_bytes(&self) -> u64 {
        u64::from(self.scene_layout().slots.max(1)) * size_of::<JudgedInstance>() as u64
    }

    /// The boxes of all slots on the device, [`JudgedInstance`]s in one buffer for all views. They are uploaded when the scene has changed, and until the device has said that it has them: a host may drop
    /// the encoder with an upload.
    pub fn slot_boxes(&mut self, view: &ViewNodes) -> Buffer {
        if let Some(made) = self.shared.boxes {
            return made;
        }
        let scene = view.inputs().scene;
        let bytes = self.slot_box_bytes();
        let boxes = self.graph().buffer("boxes", BufferDesc::new(bytes));
        let epoch = self.graph().buffer("epoch of boxes", BufferDesc::new(8));
        let held: Host<HeldBoxes> = self.graph().host("held boxes");
        let mut node = self.graph().host_node("upload boxes");
        node.group(CULL).read(scene);
        let said = node.read_previous(epoch, held);
        let held = node.updates(held);
        let (boxes, epoch) = (node.updates(boxes), node.updates(epoch));
        let mut records = Vec::new();
        let mut is_new = true;
        node.run(move |ctx| {
            let mut held = ctx.get_mut(held)?;
            if std::mem::take(&mut is_new) {
                // What was said of an earlier plan's buffer is not about this one.
                *held = HeldBoxes::default();
            }
            if let Some(late) = ctx.late(said)
                && let Some(bytes) = late.bytes.first_chunk()
            {
                held.epoch = Some(u64::from_le_bytes(*bytes));
            }
            let table = &ctx.get(scene)?.table;
            if held.epoch != Some(table.epoch()) {
                records.clear();
                records.extend((0..table.slots()).map(|slot| record_of(table, slot)));
                ctx.upload(boxes, 0, bytemuck::cast_slice(&records))?;
                ctx.upload(epoch, 0, &table.epoch().to_le_bytes())?;
            }
            Ok(())
        });
        self.shared.boxes = Some(boxes);
        boxes
    }
}

/// A slot's box as the device tests it.
fn record_of(table: &SceneTable, slot: u32) -> JudgedInstance {
    if table.occupant(slot).is_none() {
        return JudgedInstance::default();
    }
    let triangles = table.class_of(slot).topology() == Topology::Triangles;
    // What is not transparent is drawn before the test.
    let part = match (
        triangles && table.is_tested(slot),
        table.is_transparent(slot),
    ) {
        (true, false) => Part::Both,
        (true, true) => Part::Occludee,
        (false, false) => Part::Occluder,
        (false, true) => Part::Exempt,
    };
    JudgedInstance::oriented(&table.oriented(slot), part)
}
