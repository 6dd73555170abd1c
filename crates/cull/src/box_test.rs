//! Tests the boxes of all entities against a pyramid of what a view has drawn so far: the steps of strategies that draw what was visible first, and then what
//! they find. Nothing is read back, and nothing by entity is done on the host while the scene stands still.

use antumbra_graph::{Bind, Buffer, BufferDesc, Texture};
use antumbra_shaders::{Job, jobs};

use crate::compute_pipeline::rows_of;
use crate::frame_graph::{CULL, FrameGraph};
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
    /// Each entity's box, where its mesh is round the ellipsoid around it, and, where the depth is inspected down to the pixel, the boxes around parts of its mesh.
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
            Self::Pyramid => ONE_LOOK,
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
        let parts = match self.detail {
            TestDetail::Pixel => 0,
            // What a few texels let through is visible at once.
            TestDetail::Pyramid => WHOLE_BOXES,
        };
        unknown | shape | self.detail.flag() | parts
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
    /// What [`FrameGraph::first_by_boxes`] goes by in the next frame. With [`UnknownEntities::Wait`], what was drawn first counts as visible until [`FrameGraph::test_drawn`] has looked.
    pub states: Buffer,
    /// 1 for what is visible by its box and was not drawn first. So are transparent entities, those across the near plane, those that are not tested, and lines and points, which cover
    /// pixels outside of their boxes.
    pub rest: Buffer,
    /// 1 for all that is drawn: what was drawn first, and what was found.
    pub drawn: Buffer,
    pyramid: PyramidNodes,
}

/// A kernel with a thread for each slot, in workgroups of 64.
struct SlotKernel {
    name: &'static str,
    job: &'static Job,
    entry: &'static str,
    /// [`GpuJudgedView`].
    eye: Buffer,
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
        let recalled = BufferDesc::new(self.slot_bytes()).zeroed();
        let recalled = self.graph().buffer(view.named("recalled"), recalled);
        let kernel = SlotKernel {
            name: "recall",
            job: &jobs::recall_slots::JOB,
            entry: "recall_slots",
            eye: of.uniform.previous(),
        };
        let reads = [
            (1, of.boxes),
            (5, of.pyramid.layout),
            (6, of.pyramid.texels.previous()),
            (9, of.parts),
        ];
        let [recalled] = self.by_slot(view, kernel, &reads, None, [(2, recalled)]);
        recalled
    }

    /// What a view draws before the test, a u32 a slot, 1 or 0: opaque entities in its frustum that were visible by `states`, the [states](BoxTest::states) of the last frame, that no test
    /// may cull, or that nothing is known of and that are large on the screen. Any choice is right. This one hides much and costs little.
    pub fn first_by_boxes(&mut self, view: &ViewNodes, of: ViewBoxes, states: Buffer) -> Buffer {
        let first = BufferDesc::new(self.slot_bytes()).zeroed();
        let first = self.graph().buffer(view.named("drawn first"), first);
        let kernel = SlotKernel {
            name: "choose first",
            job: &jobs::first_slots::JOB,
            entry: "first_slots",
            eye: of.uniform,
        };
        let reads = [(1, of.boxes), (2, states)];
        let [first] = self.by_slot(view, kernel, &reads, None, [(3, first)]);
        first
    }

    /// Tests boxes against the view's depth so far: those of entities that were not drawn first or, where nothing is drawn after the test, of all. A box is hidden if in every pixel that it
    /// may touch its nearest point there is behind the farthest sample; equal depths are visible. `first`: a u32 a slot, not 0 for what is drawn already; `states`: where the next frame's
    /// knowledge is written, such as [`Self::sample_counts`]. When what was found is drawn, [`Self::test_drawn`] completes them: without it, what was drawn once comes first for as long as it
    /// is in the frustum.
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
        let pyramid = fill_pyramid(
            self.graph,
            &self.shared.gpu,
            &view.named(""),
            (depth, host),
            view.size(),
            of.pyramid,
        );
        let bytes = self.slot_bytes();
        let mut words = |name: &str| {
            let name = view.named(name);
            self.graph().buffer(name, BufferDesc::new(bytes).zeroed())
        };
        let (rest, drawn) = (words("found besides"), words("drawn"));
        let kernel = SlotKernel {
            name: "test boxes",
            job: match host.samples {
                1 => &jobs::test_slots_one::JOB,
                _ => &jobs::test_slots_many::JOB,
            },
            entry: "test_slots",
            eye: of.uniform,
        };
        let reads = [
            (1, of.boxes),
            (2, first),
            (5, pyramid.layout),
            (6, pyramid.texels),
            (9, of.parts),
        ];
        let writes = [(3, states), (4, rest), (8, drawn)];
        let [states, rest, drawn] = self.by_slot(view, kernel, &reads, Some(depth), writes);
        BoxTest {
            states,
            rest,
            drawn,
            pyramid,
        }
    }

    /// Tests what was drawn once more, against the complete depth: what comes first in the next frame is then what shows in this one. Any answer is right. Returns the
    /// [states](BoxTest::states) of `tested`, with these answers.
    pub fn test_drawn(&mut self, view: &ViewNodes, of: ViewBoxes, tested: BoxTest) -> Buffer {
        let kernel = SlotKernel {
            name: "test what was drawn",
            job: match self.own_depth().samples {
                1 => &jobs::retest_slots_one::JOB,
                _ => &jobs::retest_slots_many::JOB,
            },
            entry: "retest_slots",
            eye: of.uniform,
        };
        // The pyramid of the depth so far still holds: nothing has become farther. What it does not decide, the complete depth does, unless a few texels are all that is inspected.
        let reads = [
            (1, of.boxes),
            (2, tested.drawn),
            (5, tested.pyramid.layout),
            (6, tested.pyramid.texels),
            (9, of.parts),
        ];
        let depth = Some(view.targets.depth);
        let [states] = self.by_slot(view, kernel, &reads, depth, [(3, tested.states)]);
        states
    }

    /// Adds the node of a kernel with a thread for each slot. What it reads and writes comes with the numbers of its bindings. Returns the next versions of what it writes.
    fn by_slot<const WRITES: usize>(
        &mut self,
        view: &ViewNodes,
        kernel: SlotKernel,
        reads: &[(u32, Buffer)],
        depth: Option<Texture>,
        writes: [(u32, Buffer); WRITES],
    ) -> [Buffer; WRITES] {
        let SlotKernel {
            name,
            job,
            entry,
            eye,
        } = kernel;
        let pipeline = self.compute_pipeline(job, entry);
        let scene = view.inputs().scene;
        let mut node = self.graph().compute(view.named(name));
        node.group(CULL).read(scene).uniform(eye);
        let mut binds = vec![Bind::Buffer(0, eye)];
        for (at, buffer) in reads {
            node.storage_read(*buffer);
            binds.push(Bind::Buffer(*at, *buffer));
        }
        if let Some(depth) = depth {
            node.sample(depth);
            binds.push(Bind::Texture(7, depth));
        }
        let written = writes.map(|(at, buffer)| {
            let buffer = node.storage_write(buffer);
            binds.push(Bind::Buffer(at, buffer));
            buffer
        });
        node.run(move |ctx| {
            let slots = ctx.get(scene)?.table.slots();
            pipeline.dispatch(ctx, &binds, rows_of(slots.div_ceil(64)))
        });
        written
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
