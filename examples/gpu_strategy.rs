//! A strategy on the GPU, from outside. It draws what was visible in the last frame, makes a depth pyramid of that, tests the boxes of all candidates against the pyramid, and draws
//! what the test finds. The host waits for nothing.
//!
//! Pyramid and test: Greene, Kass and Miller, *Hierarchical Z-Buffer Visibility*, 1993. Two passes that the GPU decides: Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015.
//!
//! ```text
//! cargo run --release --example gpu_strategy --features measure,demo-scenes
//! ```

use std::error::Error;
use std::sync::Arc;

use antumbra::cull::boxes::{BoxContents, Widening};
use antumbra::cull::indirect::{IndirectLayout, LayoutSize, SampleBounds};
use antumbra::cull::order::back_to_front;
use antumbra::cull::{
    AdapterChoice, CULL, Candidates, CountLayout, Counts, DeclareError, FrameGraph, FrustumOnly,
    Gpu, Ideal, Latency, MeshDetail, Queried, Strategy, ViewNodes, VisibleSet, rows_of,
};
use antumbra::graph::{Bind, Buffer, BufferDesc, Host, Texture, TextureDesc};
use antumbra::measure::compare::{CompareOptions, Comparison, Contender, compare};
use antumbra::measure::{path::CameraPath, table::Table};
use antumbra::scene::Topology;
use antumbra::shaders::{Job, ShaderError};

/// Two passes and a depth pyramid.
#[derive(Clone)]
pub struct MipPyramid {
    shader: Job,
}

impl MipPyramid {
    /// Reads the shader: an error in it is reported here, with its line, and not by a device.
    pub fn new() -> Result<Self, ShaderError> {
        let shader = Job::from_wgsl("gpu_strategy", include_str!("gpu_strategy.wgsl"))?;
        Ok(Self { shader })
    }
}

#[rustfmt::skip]
impl Strategy for MipPyramid {
    fn name(&self) -> &str { "mip-pyramid" }
    fn summary(&self) -> &str { "draws what was visible, then tests boxes against a depth pyramid of it" }
    fn conservative(&self) -> bool { true }
    fn latency(&self) -> Option<Latency> { Some(Latency::OnGpu) }
    fn declare(&mut self, g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Result<VisibleSet, DeclareError> {
        if g.samples() > 1 && !g.gpu().reads_drawn_samples() {
            return Err(DeclareError::Device {
                strategy: self.name().to_owned(),
                lacking: "shaders that read the samples of what was drawn".to_owned(),
                instead: "draw one sample a pixel".to_owned(),
            });
        }
        let candidates = g.in_frustum(view);
        let counts = g.sample_counts(view);
        let before = counts.previous();

        let first = opaque(g, view, "visible before", candidates, Phase::First);
        let first = g.compact(view, "visible before", first, before);
        g.shade_indirect(view, "shade visible before", first);

        let pyramid = self.pyramid(g, view);
        let tests = list_tests(g, view, candidates);
        let counts = self.test(g, view, tests, pyramid, counts);

        let second = opaque(g, view, "found visible", candidates, Phase::Second);
        let second = g.compact(view, "found visible", second, counts);
        g.shade_indirect(view, "shade found visible", second);
        if g.scene_layout().transparent {
            let blended = transparent(g, view, candidates);
            let blended = g.compact(view, "visible transparent set", blended, counts);
            g.shade_indirect(view, "transparent", blended);
        }
        let counts = Counts { buffer: counts, layout: CountLayout::BySlot, queried: tests.queried };
        Ok(VisibleSet::on_gpu(candidates, counts, 0))
    }
}

/// The passes over opaque entities. Each number is a count that is too low for the pass: see the constants in the shader.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// What was visible in the last frame, and what no test may cull.
    First = 1,
    /// What this frame's test has found.
    Second = 2,
}

/// Lays out opaque candidates for a pass.
#[rustfmt::skip]
fn opaque(g: &mut FrameGraph<'_>, view: &ViewNodes, name: &str, candidates: Host<Candidates>, phase: Phase) -> IndirectLayout {
    let size = LayoutSize { runs: g.scene_layout().batches, entries_a_slot: 1 };
    g.lay_out(view, name, size, |node| { node.read(candidates); }, move |ctx, table, _, laid| {
        let candidates = ctx.get(candidates)?;
        let wanted = |slot: &u32| !table.is_transparent(*slot) && (phase == Phase::First || !candidates.is_exempt(*slot));
        let members = candidates.inside().iter().copied().filter(wanted);
        laid.list.fill(table, members, MeshDetail::Level(0));
        let bounds = SampleBounds { over: phase as u32, ..SampleBounds::SEEN };
        laid.bound(table, |_| bounds, |slot| candidates.is_exempt(slot));
        Ok(())
    })
}

/// Lays out transparent candidates, back to front: each may be a run of its own.
#[rustfmt::skip]
fn transparent(g: &mut FrameGraph<'_>, view: &ViewNodes, candidates: Host<Candidates>) -> IndirectLayout {
    let size = LayoutSize { runs: g.scene_layout().slots.max(1), entries_a_slot: 1 };
    g.lay_out(view, "transparent candidates", size, |node| { node.read(candidates); }, move |ctx, table, frame, laid| {
        let candidates = ctx.get(candidates)?;
        let members = candidates.inside().iter().copied().filter(|slot| table.is_transparent(*slot));
        back_to_front(laid.list, table, frame, members.map(|slot| (slot, 0)));
        laid.bound(table, |_| SampleBounds::SEEN, |slot| candidates.is_exempt(slot));
        Ok(())
    })
}

/// What is tested in a frame.
#[derive(Clone, Copy)]
struct Tests {
    queried: Host<Queried>,
    /// Their number, then the slot of each.
    slots: Buffer,
    /// The box of each, as [`Widening::oriented`] makes it.
    boxes: Buffer,
}

/// A box around everything, which is visible: where f32 cannot hold an entity's own.
const EVERYTHING: [f32; 12] = [
    0.0, 0.0, 0.0, 1e18, 0.0, 0.0, 0.0, 1e18, 0.0, 0.0, 0.0, 1e18,
];

/// Uploads the boxes of all candidates that may be tested. For an example this is fast enough; `FrameGraph::test_boxes` keeps them on the device and uploads what moves.
#[rustfmt::skip]
fn list_tests(g: &mut FrameGraph<'_>, view: &ViewNodes, candidates: Host<Candidates>) -> Tests {
    let (inputs, bytes) = (view.inputs(), g.slot_bytes());
    let queried = g.graph().host::<Queried>(view.named("tested entities"));
    let slots = g.graph().buffer(view.named("tested slots"), BufferDesc::new(4 + bytes));
    let boxes = g.graph().buffer(view.named("tested boxes"), BufferDesc::new(12 * bytes));
    let mut node = g.graph().host_node(view.named("list tests"));
    node.group(CULL).read(inputs.scene).read(inputs.view).read(candidates);
    let tests = Tests { queried: node.write(queried), slots: node.upload(slots), boxes: node.upload(boxes) };
    node.run(move |ctx| {
        let (scene, frame, candidates) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?, ctx.get(candidates)?);
        let table = &scene.table;
        // Rasterisers move vertices, and lines and points cover pixels that they do not touch.
        let [triangles, others] = [BoxContents::Triangles, BoxContents::AnyTopology].map(|what| Widening::new(&frame, what));
        let slots: Vec<u32> = candidates.testable().collect();
        let boxes: Vec<[f32; 12]> = slots.iter().map(|slot| {
            let widening = if table.class_of(*slot).topology() == Topology::Triangles { &triangles } else { &others };
            widening.oriented(&table.oriented(*slot)).map_or(EVERYTHING, bytemuck::cast)
        }).collect();
        ctx.upload(tests.slots, 0, bytemuck::bytes_of(&(slots.len() as u32)))?;
        ctx.upload(tests.slots, 4, bytemuck::cast_slice(&slots))?;
        ctx.upload(tests.boxes, 0, bytemuck::cast_slice(&boxes))?;
        *ctx.get_mut(tests.queried)? = Queried { stamp: candidates.stamp(), slots: Arc::new(slots), ends: Arc::default() };
        Ok(())
    });
    tests
}

#[rustfmt::skip]
impl MipPyramid {
    /// Makes the mips of the depth so far, each from the one before: a texel is the farthest depth of all that it stands for.
    fn pyramid(&self, g: &mut FrameGraph<'_>, view: &ViewNodes) -> Texture {
        let [width, height] = view.size().map(|side| (side / 2).max(1));
        let levels = width.max(height).ilog2() + 1;
        let desc = TextureDesc::new(width, height, antumbra::wgpu::TextureFormat::R32Float).mips(levels);
        let mut pyramid = g.graph().texture(view.named("depth pyramid"), desc);
        for level in 0..levels {
            let depth = view.targets.depth;
            let (entry, source) = match (level, g.samples()) {
                (0, 1) => ("reduce_depth", Bind::Texture(1, depth)),
                (0, _) => ("reduce_samples", Bind::Texture(2, depth)),
                _ => ("reduce", Bind::Mip(3, pyramid, level - 1)),
            };
            let pipeline = g.compute_pipeline(&self.shader, entry);
            let mut node = g.graph().compute(view.named(&format!("depth pyramid {level}")));
            node.group(CULL);
            match level {
                0 => node.sample(depth),
                _ => node.storage_texture_read(pyramid),
            };
            let next = node.storage_texture_write(pyramid);
            let groups = [width, height].map(|side| (side >> level).max(1).div_ceil(8));
            node.run(move |ctx| pipeline.dispatch(ctx, &[source.clone(), Bind::Mip(4, next, level)], groups));
            pyramid = next;
        }
        pyramid
    }

    /// Tests the boxes, and writes a count by slot.
    fn test(&self, g: &mut FrameGraph<'_>, view: &ViewNodes, tests: Tests, pyramid: Texture, counts: Buffer) -> Buffer {
        let (before, uniform) = (counts.previous(), view.inputs().uniform);
        let pipeline = g.compute_pipeline(&self.shader, "test");
        let mut node = g.graph().compute(view.named("test boxes"));
        node.group(CULL).read(tests.queried).uniform(uniform).sample(pyramid);
        node.storage_read(tests.slots).storage_read(tests.boxes).storage_read(before);
        let counts = node.storage_write(counts);
        node.run(move |ctx| {
            let binds = [
                Bind::Buffer(0, uniform), Bind::Buffer(5, tests.slots), Bind::Buffer(6, tests.boxes),
                Bind::Texture(7, pyramid), Bind::Buffer(8, before), Bind::Buffer(9, counts),
            ];
            // A workgroup a box.
            let groups = ctx.get(tests.queried)?.slots.len() as u32;
            pipeline.dispatch(ctx, &binds, rows_of(groups))
        });
        counts
    }
}

/// Compares it with drawing what is in the frustum, and with drawing what is visible, on the built-in grid of `per_side`³ spheres.
#[rustfmt::skip]
pub fn run(gpu: &Gpu, per_side: u32, poses: usize, options: &CompareOptions) -> Result<Comparison, Box<dyn Error>> {
    let strategy = MipPyramid::new()?;
    let mut scene = antumbra::demo_scenes::by_name("grid", Some(per_side))?;
    scene.update();
    let aspect = f64::from(options.size[0]) / f64::from(options.size[1]);
    let path = CameraPath::orbit_around(&scene.bounds().ok_or("an empty scene")?, aspect, poses)?;
    let contenders = [
        Contender::new("", || Box::new(FrustumOnly)),
        Contender::new("", || Box::new(Ideal)),
        Contender::new("", move || Box::new(strategy.clone())),
    ];
    Ok(compare(gpu, &mut scene, &path, &contenders, options, &mut |_| ())?)
}

/// Prints the table of a comparison.
#[rustfmt::skip]
pub fn main() -> Result<(), Box<dyn Error>> {
    let options = CompareOptions { size: [640, 480], ..CompareOptions::default() };
    let comparison = run(&Gpu::open(&AdapterChoice::Auto)?, 14, 30, &options)?;
    print!("{}", Table::new(&comparison.report).terminal(false));
    Ok(())
}
