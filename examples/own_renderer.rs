//! A renderer of one's own: the stage decides what is drawn, and this program draws it, in one flat colour an entity. Every strategy works with it, also those that
//! draw some, test, and draw the rest. The passes that test (depth, ids, counts, queries) are still the built-in renderer's.
//!
//! It is for opaque, closed triangle meshes. A renderer for other entities goes by each batch's `PipelineClass` (topology, winding, sides, alpha), as the tests do.
//!
//! ```text
//! cargo run --release --example own_renderer --features demo-scenes
//! ```

use std::collections::HashMap;
use std::error::Error;
use std::ops::Range;
use std::sync::Arc;

use antumbra::cull::{
    AdapterChoice, DEPTH_FORMAT, DrawSource, Gpu, IDENTITY_FORMAT, Pass, Renderer, Run, SceneFrame,
    ShadeTargets, Stage, StageOptions, Targets, TestRenderer, ViewInput, ViewInputs, ViewSpec,
    WithRenderer, read_back,
};
use antumbra::demo_scenes::{GridOptions, grid};
use antumbra::draw::{BuiltinRenderer, GpuScene, SceneBuffers};
use antumbra::graph::{Bind, BodyError, Buffer, HostRef, RasterContext};
use antumbra::scene::{Camera, Projection};
use antumbra::shaders::Job;
use antumbra::strategies::registry;
use glam::DVec3;

/// The position function is shared with the tests' passes: only then do equal surfaces have equal depths.
const SHADER: &str = "//!import position
//!import packed_id
struct Varying {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) slot: u32,
}

@vertex
fn vertex(@location(0) local: vec3<f32>, @location(1) slot: u32) -> Varying {
    return Varying(clip_position(relative_position(instances[slot], local)), slot);
}

fn colour(slot: u32) -> vec4<f32> {
    let hash = (slot + 1u) * 2654435769u;
    return vec4<f32>(vec3<f32>((vec3<u32>(hash) >> vec3<u32>(8u, 16u, 24u)) & vec3<u32>(255u)) / 255.0, 1.0);
}

@fragment
fn flat(in: Varying) -> @location(0) vec4<f32> {
    return colour(in.slot);
}

struct Identified {
    @location(0) colour: vec4<f32>,
    @location(1) id: vec2<u32>,
}

@fragment
fn flat_with_id(in: Varying) -> Identified {
    return Identified(colour(in.slot), packed_id(in.slot + 1u));
}
";

/// What pipelines draw into.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct FlatTargets {
    colour: wgpu::TextureFormat,
    /// Samples a pixel.
    samples: u32,
    /// Whether there are entity ids beside the colour.
    with_ids: bool,
}

/// Draws triangles in one colour an entity.
struct Flat {
    gpu: Gpu,
    shader: Arc<Job>,
    /// A plan that is declared anew compiles nothing that exists.
    pipelines: HashMap<FlatTargets, Arc<FlatPipeline>>,
    tests: BuiltinRenderer,
}

impl Flat {
    fn new(gpu: &Gpu, shader: &Arc<Job>) -> Self {
        Self {
            gpu: gpu.clone(),
            shader: Arc::clone(shader),
            pipelines: HashMap::new(),
            tests: BuiltinRenderer::new(gpu),
        }
    }
}

impl Renderer for Flat {
    fn shade(&mut self, pass: Pass<'_>, source: DrawSource, into: ShadeTargets) -> ShadeTargets {
        let drawn = FlatTargets {
            colour: pass.colour_format,
            samples: pass.samples,
            with_ids: into.ids.is_some(),
        };
        let made = self.pipelines.entry(drawn);
        let pipeline =
            made.or_insert_with(|| Arc::new(FlatPipeline::new(&self.gpu, &self.shader, drawn)));
        let pipeline = Arc::clone(pipeline);
        let inputs = pass.inputs;
        let list = source.as_list();
        let mut node = pass.graph.raster(pass.name);
        node.group(pass.group)
            .read(inputs.scene)
            .read(list.list)
            .vertex(list.slots)
            .uniform(inputs.uniform);
        if let DrawSource::Indirect(indirect) = source {
            // Without the feature, a draw whose first instance is not 0 draws nothing.
            node.indirect(indirect.draws)
                .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
        }
        let targets = Targets {
            colour: node.colour(into.targets.colour),
            depth: node.depth(into.targets.depth),
        };
        let ids = into.ids.map(|ids| node.colour(ids));
        let queries = into.queries.map(|results| {
            node.queries(results, move |host| {
                host.get(list.list).map_or(0, |list| list.query_count())
            })
        });
        node.run(move |ctx| {
            let scene = bind(ctx, inputs, &pipeline, list.slots)?;
            let list = ctx.get(list.list)?;
            let all = 0..list.slots().len() as u32;
            match source {
                DrawSource::Indirect(indirect) => {
                    let draws = ctx.buffer(indirect.draws)?;
                    let bytes = antumbra::cull::INDIRECT_DRAW_BYTES;
                    for number in 0..list.runs().len() as u64 {
                        ctx.pass().draw_indexed_indirect(draws, number * bytes);
                    }
                }
                DrawSource::List(_) if queries.is_some() => {
                    for number in ctx.query_range() {
                        let entries = list.query_entries(number);
                        ctx.query(number, |pass| draw(pass, &scene, list.runs(), entries))?;
                    }
                }
                DrawSource::List(_) => draw(ctx.pass(), &scene, list.runs(), all),
            }
            Ok(())
        });
        ShadeTargets {
            targets,
            ids,
            queries,
        }
    }

    fn tests(&mut self) -> &mut dyn TestRenderer {
        &mut self.tests
    }
}

/// Draws these entries of a list.
fn draw(pass: &mut wgpu::RenderPass<'_>, scene: &SceneFrame, runs: &[Run], entries: Range<u32>) {
    for run in runs {
        let first = run.first.max(entries.start);
        let end = (run.first + run.count).min(entries.end);
        let Some(batch) = scene.table.batches().get(run.batch as usize) else {
            continue;
        };
        let range = scene.table.range(batch.mesh, run.detail);
        if first < end {
            let indices = range.first_index..range.first_index + range.index_count;
            pass.draw_indexed(indices, range.base_vertex, first..end);
        }
    }
}

/// Binds the pipeline and the scene's buffers.
fn bind<'a>(
    ctx: &mut RasterContext<'a>,
    inputs: ViewInputs,
    pipeline: &FlatPipeline,
    slots: Buffer,
) -> Result<HostRef<'a, SceneFrame>, BodyError> {
    let scene = ctx.get(inputs.scene)?;
    let missing = || BodyError::msg("a scene without the built-in buffers");
    let buffers = scene.data::<SceneBuffers>().ok_or_else(missing)?;
    let slots = ctx.buffer(slots)?;
    let binds = [
        Bind::Buffer(0, inputs.uniform),
        Bind::external(1, buffers.instances.clone()),
    ];
    let group = ctx.bind_group(0, &pipeline.layout, &binds)?;
    let pass = ctx.pass();
    pass.set_pipeline(&pipeline.pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
    pass.set_vertex_buffer(0, buffers.positions.slice(..));
    pass.set_vertex_buffer(1, slots.slice(..));
    Ok(scene)
}

struct FlatPipeline {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl FlatPipeline {
    fn new(gpu: &Gpu, job: &Job, drawn: FlatTargets) -> Self {
        let FlatTargets {
            colour,
            samples,
            with_ids,
        } = drawn;
        let device = &gpu.device;
        let module = antumbra::shaders::module(device, job);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("flat"),
            entries: &job.layout_entries(0),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("flat"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let targets = [Some(colour.into()), Some(IDENTITY_FORMAT.into())];
        let vertex = |stride, step_mode, attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: stride,
                step_mode,
                attributes,
            })
        };
        let (position, slot) = (
            wgpu::vertex_attr_array![0 => Float32x3],
            wgpu::vertex_attr_array![1 => Uint32],
        );
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("flat"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[
                    vertex(12, wgpu::VertexStepMode::Vertex, &position),
                    vertex(4, wgpu::VertexStepMode::Instance, &slot),
                ],
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(if with_ids { "flat_with_id" } else { "flat" }),
                compilation_options: Default::default(),
                targets: &targets[..if with_ids { 2 } else { 1 }],
            }),
            // Both sides of every triangle, whatever its winding.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                // Reversed depth; equal depths are visible.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, layout }
    }
}

/// Draws a grid under several strategies, and prints what each drew.
pub fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    for strategy in ["frustum", "three-pass", "coherent", "occupancy-map"] {
        let outcome = run(&gpu, strategy, 20)?;
        println!(
            "{strategy}: {} of {} entities drawn, {} pixels differ from drawing all",
            outcome.drawn, outcome.entities, outcome.different_pixels
        );
    }
    Ok(())
}

/// What a run found in its last frame.
#[derive(Debug)]
pub struct Outcome {
    /// The entities that were drawn.
    pub drawn: usize,
    /// All entities.
    pub entities: usize,
    /// Pixels that are not as if everything had been drawn.
    pub different_pixels: usize,
}

/// Plays frames of a slow flight around a grid of balls, and compares the last with the same frame without culling.
pub fn run(gpu: &Gpu, strategy: &str, frames: u32) -> Result<Outcome, Box<dyn Error>> {
    let mut host = grid(GridOptions {
        per_side: 8,
        ..GridOptions::default()
    })?;
    host.ensure_proxies(&Default::default());
    let shader = Arc::new(Job::from_wgsl("flat", SHADER)?);
    let scene = WithRenderer::new(GpuScene::new(gpu, &mut host)?, move |scene| {
        Box::new(Flat::new(scene.gpu(), &shader))
    });
    let stage = |strategy: &str| -> Result<Stage, Box<dyn Error>> {
        let views = vec![ViewSpec::main(320, 240)];
        let strategy = registry().parse(strategy)?;
        Ok(Stage::new(
            &scene,
            strategy,
            views,
            StageOptions::default(),
        )?)
    };
    let (mut all, mut culled) = (stage("none")?, stage(strategy)?);
    let projection = Projection::Perspective {
        fov_y: 0.9,
        near: 0.05,
    };
    for frame in 0..frames {
        let angle = f64::from(frame) * 0.002;
        let eye = DVec3::new(angle.cos(), 0.4, angle.sin()) * 14.0;
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
        for stage in [&mut all, &mut culled] {
            stage.frame(&scene, &[ViewInput::new(camera)])?;
            gpu.wait()?;
        }
    }
    let pixels = |stage: &Stage| -> Result<Vec<u8>, Box<dyn Error>> {
        let image = stage.colour(0).ok_or("a stage without an image")?;
        Ok(read_back::texture(gpu, image)?)
    };
    let (expected, found) = (pixels(&all)?, pixels(&culled)?);
    let pairs = expected.chunks(4).zip(found.chunks(4));
    Ok(Outcome {
        drawn: culled.verdicts(0, &scene)?.drawn().count(),
        entities: host.drawable_count(),
        different_pixels: pairs.filter(|(one, other)| one != other).count(),
    })
}
