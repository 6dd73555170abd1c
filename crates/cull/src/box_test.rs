//! Tests the boxes of all entities against a pyramid of what a view has drawn so far: the steps of strategies that draw what was visible first, and then what
//! they find. Nothing is read back, and nothing by entity is done on the host while the scene stands still.

use antumbra_graph::{Bind, Buffer, BufferDesc};
use antumbra_shaders::jobs;

use crate::compute_pipeline::rows_of;
use crate::frame_graph::{CULL, FrameGraph, Shared};
use crate::judge::{
    AT_MIDDLES, BOXES_ALONE, CULL_UNKNOWN, Eye, FORGET, FRAME_LATE, GpuJudgedView, HostDepth,
    ONE_LOOK, PyramidNodes, WHOLE_BOXES, declare_pyramid, fill_pyramid,
};
use crate::renderer::DEPTH_FORMAT;
use crate::resident_scene::ResidentScene;
use crate::self_test::Capability;
use crate::view_nodes::ViewNodes;

/// What is drawn before the test of what nothing is known of: new entities, those that come into the frustum, and all after a camera cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum UnknownEntities {
    /// What is large on the screen. The rest waits for the test, which finds it in the same frame.
    #[default]
    Wait,
    /// All. Nothing is drawn after the test.
    Drawn,
    /// Nothing, and nothing is drawn after the test: they appear a frame late.
    Culled,
}

/// The shapes that are tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TestShape {
    /// Each entity's box, where its mesh is round the ellipsoid around it, and the boxes around parts of its mesh.
    #[default]
    Parts,
    /// Its box and its ellipsoid.
    Ellipsoid,
    /// Its box alone.
    Box,
}

/// How closely the depth is inspected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TestDetail {
    /// Down to the pixel, with the shape's own depth there.
    #[default]
    Pixel,
    /// At most 4 x 4 texels of the pyramid.
    Pyramid,
}

impl TestDetail {
    pub(crate) fn flag(self) -> u32 {
        match self {
            Self::Pixel => 0,
            Self::Pyramid => ONE_LOOK | WHOLE_BOXES,
        }
    }
}

/// How boxes are tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct TestRules {
    /// What is done with what nothing is known of.
    pub unknown: UnknownEntities,
    /// Which shapes are tested.
    pub shape: TestShape,
    /// How closely.
    pub detail: TestDetail,
}

impl TestRules {
    fn flags(self) -> u32 {
        let unknown = match self.unknown {
            UnknownEntities::Wait => 0,
            UnknownEntities::Drawn => FRAME_LATE,
            UnknownEntities::Culled => FRAME_LATE | CULL_UNKNOWN,
        };
        let shape = match self.shape {
            TestShape::Parts => 0,
            TestShape::Ellipsoid => WHOLE_BOXES,
            TestShape::Box => WHOLE_BOXES | BOXES_ALONE,
        };
        unknown | shape | self.detail.flag()
    }
}

/// The boxes of all slots, and a view that they are tested for.
#[derive(Debug, Clone, Copy)]
pub struct ViewBoxes {
    boxes: Buffer,
    /// The boxes of the parts of all meshes.
    parts: Buffer,
    /// [`GpuJudgedView`].
    uniform: Buffer,
    /// Not written yet.
    pyramid: PyramidNodes,
}

/// What a test of boxes has found, a u32 a slot.
#[derive(Debug, Clone, Copy)]
pub struct BoxTest {
    /// What [`FrameGraph::first_by_boxes`] goes by in the next frame.
    pub states: Buffer,
    /// 1 for what is visible by its box and was not drawn first. So are transparent entities, those across the near plane, those that are not tested, and lines and points, which cover
    /// pixels outside of their boxes.
    pub rest: Buffer,
    /// 1 for all that is drawn: what was drawn first, and what was found.
    pub drawn: Buffer,
    pyramid: PyramidNodes,
}

impl FrameGraph<'_> {
    /// The boxes of all entities, for a view.
    pub fn view_boxes(&mut self, view: &ViewNodes, rules: TestRules) -> ViewBoxes {
        let ResidentScene { boxes, parts, .. } = self.resident_scene(view);
        let (size, inputs, host) = (view.size(), view.inputs(), self.own_depth());
        let uniform = BufferDesc::new(size_of::<GpuJudgedView>() as u64);
        let uniform = self.graph().buffer(view.named("view of boxes"), uniform);
        let mut node = self.graph().host_node(view.named("upload view of boxes"));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let uniform = node.upload(uniform);
        let mut cuts = None;
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let eye = Eye::of(&frame.camera, size);
            let mut flags = rules.flags();
            if host.samples == 1 {
                flags |= AT_MIDDLES;
            }
            if cuts.replace(frame.cuts) != Some(frame.cuts) {
                flags |= FORGET;
            }
            let made = GpuJudgedView::new(&eye, size, host, scene.table.slots(), flags);
            Ok(ctx.upload(uniform, 0, bytemuck::bytes_of(&made))?)
        });
        ViewBoxes {
            boxes,
            parts,
            uniform,
            pyramid: declare_pyramid(self.graph, &view.named(""), host, size),
        }
    }

    /// Tests the boxes of all entities against the last frame's pyramid, from the last frame's view: [states](BoxTest::states) for [`Self::first_by_boxes`] that know of movement, and no
    /// more than the finest level of the pyramid does.
    pub fn recall_by_pyramid(&mut self, view: &ViewNodes, of: ViewBoxes) -> Buffer {
        let pipeline = self.compute_pipeline(&jobs::recall_slots::JOB, "recall_slots");
        let scene = view.inputs().scene;
        let recalled = BufferDesc::new(self.slot_bytes()).zeroed();
        let recalled = self.graph().buffer(view.named("recalled"), recalled);
        let (uniform, texels) = (of.uniform.previous(), of.pyramid.texels.previous());
        let mut node = self.graph().compute(view.named("recall"));
        node.group(CULL)
            .read(scene)
            .uniform(uniform)
            .storage_read(of.boxes)
            .storage_read(of.parts)
            .storage_read(of.pyramid.layout)
            .storage_read(texels);
        let recalled = node.storage_write(recalled);
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, uniform),
                Bind::Buffer(1, of.boxes),
                Bind::Buffer(2, recalled),
                Bind::Buffer(5, of.pyramid.layout),
                Bind::Buffer(6, texels),
                Bind::Buffer(9, of.parts),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        recalled
    }

    /// What a view draws before the test, a u32 a slot, 1 or 0: opaque entities in its frustum that were visible by `states`, the [states](BoxTest::states) of the last frame, that no test
    /// may cull, or that nothing is known of and that are large on the screen. Any choice is right. This one hides much and costs little.
    pub fn first_by_boxes(
        &mut self,
        view: &ViewNodes,
        ViewBoxes { boxes, uniform, .. }: ViewBoxes,
        states: Buffer,
    ) -> Buffer {
        let pipeline = self.compute_pipeline(&jobs::first_slots::JOB, "first_slots");
        let scene = view.inputs().scene;
        let first = BufferDesc::new(self.slot_bytes()).zeroed();
        let first = self.graph().buffer(view.named("drawn first"), first);
        let mut node = self.graph().compute(view.named("choose first"));
        node.group(CULL)
            .read(scene)
            .uniform(uniform)
            .storage_read(boxes)
            .storage_read(states);
        let first = node.storage_write(first);
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, uniform),
                Bind::Buffer(1, boxes),
                Bind::Buffer(2, states),
                Bind::Buffer(3, first),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        first
    }

    /// Tests the boxes of all entities against the view's depth so far. A box is hidden if in every pixel that it may touch its nearest point there is behind the farthest sample;
    /// equal depths are visible. `first`: a u32 a slot, not 0 for what is drawn already; `states`: where the next frame's knowledge is written, such as [`Self::sample_counts`].
    ///
    /// Needs a device that [reads the samples of what was drawn](crate::Gpu::reads_drawn_samples), where there are several a pixel.
    pub fn test_boxes(
        &mut self,
        view: &ViewNodes,
        of: ViewBoxes,
        first: Buffer,
        states: Buffer,
    ) -> BoxTest {
        self.relies_on(Capability::DepthPyramid);
        self.relies_on(Capability::BoxTest);
        let host = self.own_depth();
        let depth = view.targets.depth;
        let scene = view.inputs().scene;
        let ViewBoxes {
            boxes,
            parts,
            uniform,
            ..
        } = of;
        let Shared { gpu, pipelines, .. } = &mut *self.shared;
        let PyramidNodes { layout, texels } = fill_pyramid(
            self.graph,
            gpu,
            pipelines,
            &view.named(""),
            (depth, host),
            view.size(),
            of.pyramid,
        );
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
            .read(scene)
            .uniform(uniform)
            .storage_read(boxes)
            .storage_read(parts)
            .storage_read(first)
            .storage_read(layout)
            .storage_read(texels)
            .sample(depth);
        let [states, rest, drawn] = [states, rest, drawn].map(|words| node.storage_write(words));
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, uniform),
                Bind::Buffer(1, boxes),
                Bind::Buffer(2, first),
                Bind::Buffer(3, states),
                Bind::Buffer(4, rest),
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
                Bind::Texture(7, depth),
                Bind::Buffer(8, drawn),
                Bind::Buffer(9, parts),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        BoxTest {
            states,
            rest,
            drawn,
            pyramid: PyramidNodes { layout, texels },
        }
    }

    /// Tests what was drawn once more, against the complete depth: what comes first in the next frame is then what shows in this one. Any answer is right. `states`: those that
    /// [`Self::test_boxes`] has written.
    pub fn test_drawn(&mut self, view: &ViewNodes, of: ViewBoxes, tested: BoxTest) -> Buffer {
        let host = self.own_depth();
        let depth = view.targets.depth;
        let scene = view.inputs().scene;
        // The pyramid of the depth so far still holds: nothing has become farther. What it does not decide, the complete depth does, pixel by pixel.
        let PyramidNodes { layout, texels } = tested.pyramid;
        let job = match host.samples {
            1 => &jobs::retest_slots_one::JOB,
            _ => &jobs::retest_slots_many::JOB,
        };
        let pipeline = self.compute_pipeline(job, "retest_slots");
        let ViewBoxes {
            boxes,
            parts,
            uniform,
            ..
        } = of;
        let mut node = self.graph().compute(view.named("test what was drawn"));
        node.group(CULL)
            .read(scene)
            .uniform(uniform)
            .storage_read(boxes)
            .storage_read(parts)
            .storage_read(tested.drawn)
            .storage_read(layout)
            .storage_read(texels)
            .sample(depth);
        let states = node.storage_write(tested.states);
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            let binds = [
                Bind::Buffer(0, uniform),
                Bind::Buffer(1, boxes),
                Bind::Buffer(2, tested.drawn),
                Bind::Buffer(3, states),
                Bind::Buffer(5, layout),
                Bind::Buffer(6, texels),
                Bind::Texture(7, depth),
                Bind::Buffer(9, parts),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        states
    }

    /// The depth that the stage draws, as a host would declare it.
    fn own_depth(&self) -> HostDepth {
        HostDepth {
            format: DEPTH_FORMAT,
            samples: self.samples(),
            ..HostDepth::default()
        }
    }
}
