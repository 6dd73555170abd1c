//! Raster nodes that draw: depth, hardware queries, sample counts, entity ids, shaded colour. Each is one node over one draw source.

use std::sync::Arc;

use antumbra_graph::{
    AccessError, Bind, BodyError, Buffer, Graph, Host, HostBuilder, HostRef, RasterBuilder,
    RasterContext, Texture,
};

use crate::list::DrawList;
use crate::pipeline::{ENVIRONMENT_GROUP, PassPipelines, PipelineKind};
use crate::record::{Recorder, begin};
use crate::scene::SceneFrame;
use crate::view::ViewFrame;

/// What every drawing node of a view reads.
#[derive(Debug, Clone, Copy)]
pub struct ViewInputs {
    /// The scene.
    pub scene: Host<SceneFrame>,
    /// The camera.
    pub view: Host<ViewFrame>,
    /// [`GpuView`](crate::GpuView), uploaded.
    pub uniform: Buffer,
    /// [`GpuLights`](crate::GpuLights), uploaded.
    pub lights: Buffer,
}

/// The image of a view: shaded passes draw into these textures and return their next versions.
#[derive(Debug, Clone, Copy)]
pub struct Targets {
    /// Colour.
    pub colour: Texture,
    /// Depth, reversed: 0 is infinitely far.
    pub depth: Texture,
}

/// A [`Targets`] whose pass may write entity ids beside the colour.
#[derive(Debug, Clone, Copy)]
pub struct IdentifiedTargets {
    /// Colour and depth.
    pub targets: Targets,
    /// Entity ids ([`IDENTITY_FORMAT`](crate::IDENTITY_FORMAT)); `Some` exactly where the pipelines are [identified](PipelineKind::identified).
    pub ids: Option<Texture>,
}

/// What a shaded pass with hardware queries returns.
#[derive(Debug, Clone, Copy)]
pub struct QueriedTargets {
    /// Colour and depth.
    pub targets: Targets,
    /// The queries' results, a u64 each.
    pub answers: Buffer,
}

/// The image of an entity-id pass.
#[derive(Debug, Clone, Copy)]
pub struct IdTargets {
    /// Slot + 1 a pixel, 0 where nothing is drawn; [`IDENTITY_FORMAT`](crate::IDENTITY_FORMAT).
    pub ids: Texture,
    /// Depth, reversed.
    pub depth: Texture,
}

/// Sums over visible transparent fragments, a u32 each.
#[derive(Debug, Clone, Copy)]
pub struct Signatures {
    /// Hashed entity ids, added up by pixel, row by row.
    pub by_pixel: Buffer,
    /// Fragments by slot.
    pub by_slot: Buffer,
}

/// How the fragments of a counting pass are held against a finished depth.
#[derive(Debug, Clone, Copy)]
pub enum DepthTest {
    /// By the depth test itself, forced early. Needs [`wgpu::Features::SHADER_EARLY_DEPTH_TEST`].
    Early {
        /// The finished depth.
        depth: Texture,
    },
    /// By a comparison in the shader.
    InShader {
        /// The finished depth.
        depth: Texture,
        /// A depth texture of the same size that is written but never read: a pass needs an attachment, and not every device
        /// lets one texture be attached and sampled at once.
        scratch: Texture,
    },
}

impl DepthTest {
    /// Declares the textures on a node.
    pub(crate) fn declare(self, node: &mut RasterBuilder<'_>) {
        match self {
            Self::Early { depth } => {
                node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
                    .depth_read(depth);
            }
            Self::InShader { depth, scratch } => {
                node.sample(depth).depth(scratch);
            }
        }
    }

    /// The depth as a shader binding, where the shader reads it.
    pub(crate) fn bind(self, binding: u32) -> Option<Bind> {
        match self {
            Self::Early { .. } => None,
            Self::InShader { depth, .. } => Some(Bind::Texture(binding, depth)),
        }
    }
}

/// A draw source on the host: a draw list, with its slots on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct ListDraws {
    /// The list.
    pub list: Host<DrawList>,
    /// [`DrawList::slots`], uploaded.
    pub slots: Buffer,
}

impl ListDraws {
    /// Declares on a host node that it writes the list and uploads the slots. Returns the versions it writes.
    pub fn written_by(self, node: &mut HostBuilder<'_>) -> Self {
        Self {
            list: node.write(self.list),
            slots: node.upload(self.slots),
        }
    }
}

/// A draw source on the GPU: indirect draws over the slots that a compute node kept of a list. One draw a run of the list.
#[derive(Debug, Clone, Copy)]
pub struct IndirectDraws {
    /// The list that was chosen from. It says which pipeline each draw takes.
    pub layout: Host<DrawList>,
    /// The kept slots, at the places of their runs.
    pub slots: Buffer,
    /// The indexed indirect draws.
    pub draws: Buffer,
}

impl IndirectDraws {
    /// The list that was chosen from.
    fn as_list(self) -> ListDraws {
        ListDraws {
            list: self.layout,
            slots: self.slots,
        }
    }
}

/// A drawing node's name, timing group and pipelines.
#[derive(Debug, Clone)]
pub struct PassSpec {
    /// The node's name.
    pub name: String,
    /// The label under which its time is summed: `cull` or `draw`.
    pub group: &'static str,
    /// Its pipelines.
    pub pipelines: Arc<PassPipelines>,
}

/// Writes the depth of a list.
pub fn depth_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    depth: Texture,
) -> Texture {
    let mut node = node(g, spec, inputs, source);
    let depth = node.depth(depth);
    draw(&mut node, spec, inputs, source);
    depth
}

/// Writes the entity ids and the depth of a list.
pub fn identity_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    targets: IdTargets,
) -> IdTargets {
    let mut node = node(g, spec, inputs, source);
    let out = IdTargets {
        ids: node.colour(targets.ids),
        depth: node.depth(targets.depth),
    };
    draw(&mut node, spec, inputs, source);
    out
}

/// Shades a list. Blended classes test the depth and do not write it.
pub fn shaded_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    targets: Targets,
) -> Targets {
    let mut node = node(g, spec, inputs, source);
    node.storage_read(inputs.lights);
    let out = attach(&mut node, targets);
    draw(&mut node, spec, inputs, source);
    out
}

/// Shades indirect draws, with entity ids beside the colour where `targets` has them.
pub fn shaded_indirect_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: IndirectDraws,
    IdentifiedTargets { targets, ids }: IdentifiedTargets,
) -> IdentifiedTargets {
    let mut node = node(g, spec, inputs, source.as_list());
    node.storage_read(inputs.lights).indirect(source.draws);
    // Without the feature, a draw whose first instance is not 0 draws nothing, and no error is reported.
    node.requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    let colour = node.colour(targets.colour);
    let ids = ids.map(|ids| node.colour(ids));
    let depth = node.depth(targets.depth);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let layout = ctx.get(source.layout)?;
        let draws = ctx.buffer(source.draws)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        Recorder::new(&scene, &pipelines).indirect(ctx.pass(), layout.runs(), draws, 0);
        Ok(())
    });
    IdentifiedTargets {
        targets: Targets { colour, depth },
        ids,
    }
}

/// Draws a list with one hardware query for each of its [queries](DrawList::query_count), in the list's order, against a depth
/// that it does not write. The results are u64: zero, or something else.
pub fn query_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    depth: Texture,
    answers: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, source);
    node.depth_read(depth);
    draw_queried(&mut node, spec, inputs, source, answers)
}

/// Shades a list with one hardware query for each of its [queries](DrawList::query_count): whether any sample passed while it
/// was drawn. The results are u64: zero, or something else.
pub fn shaded_query_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    targets: Targets,
    answers: Buffer,
) -> QueriedTargets {
    let mut node = node(g, spec, inputs, source);
    node.storage_read(inputs.lights);
    QueriedTargets {
        targets: attach(&mut node, targets),
        answers: draw_queried(&mut node, spec, inputs, source, answers),
    }
}

/// Counts the samples of a list that pass against a finished depth, by slot. The pipelines are [`PipelineKind::CountAtomic`] for
/// [`DepthTest::Early`] and [`PipelineKind::CountCompare`] for [`DepthTest::InShader`]. Ties pass.
pub fn count_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    test: DepthTest,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, source);
    test.declare(&mut node);
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        bind_counts(ctx, &pipelines, test, counted)?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
    counted
}

/// [`count_pass`] over indirect draws.
pub fn count_indirect_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: IndirectDraws,
    test: DepthTest,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, source.as_list());
    node.indirect(source.draws)
        .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    test.declare(&mut node);
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let layout = ctx.get(source.layout)?;
        let draws = ctx.buffer(source.draws)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        bind_counts(ctx, &pipelines, test, counted)?;
        Recorder::new(&scene, &pipelines).indirect(ctx.pass(), layout.runs(), draws, 0);
        Ok(())
    });
    counted
}

/// Adds up the hashed ids of a list's visible transparent fragments, by pixel, and their number by slot, against an opaque depth.
/// `scratch` as in [`DepthTest::InShader`].
pub fn signature_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    depth: Texture,
    scratch: Texture,
    sums: Signatures,
) -> Signatures {
    let mut node = node(g, spec, inputs, source);
    node.sample(depth).depth(scratch);
    let sums = Signatures {
        by_pixel: node.storage_write(sums.by_pixel),
        by_slot: node.storage_write(sums.by_slot),
    };
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        let binds = [
            Bind::Buffer(0, sums.by_pixel),
            Bind::Buffer(1, sums.by_slot),
            Bind::Texture(2, depth),
        ];
        group(ctx, &pipelines, 3, &binds)?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
    sums
}

fn node<'g>(
    g: &'g mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
) -> RasterBuilder<'g> {
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(source.list)
        .vertex(source.slots)
        .uniform(inputs.uniform)
        // The node's body reports a value that cannot be read.
        .only_if(move |host| host.get(source.list).map_or(true, |list| !list.is_empty()));
    node
}

fn attach(node: &mut RasterBuilder<'_>, targets: Targets) -> Targets {
    Targets {
        colour: node.colour(targets.colour),
        depth: node.depth(targets.depth),
    }
}

/// Draws a list, each of its queries within a hardware query.
fn draw_queried(
    node: &mut RasterBuilder<'_>,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    answers: Buffer,
) -> Buffer {
    let answers = node.queries(answers, move |host| {
        host.get(source.list).map_or(0, |list| list.query_count())
    });
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        let mut recorder = Recorder::new(&scene, &pipelines);
        let mut runs = list.runs();
        for number in ctx.query_range() {
            let entries = list.query_entries(number);
            while let Some((run, rest)) = runs.split_first()
                && run.first + run.count <= entries.start
            {
                runs = rest;
            }
            ctx.query(number, |pass| {
                for run in runs.iter().take_while(|run| run.first < entries.end) {
                    let first = run.first.max(entries.start);
                    recorder.run(pass, run, first..(run.first + run.count).min(entries.end));
                }
            })?;
        }
        Ok(())
    });
    answers
}

fn draw(node: &mut RasterBuilder<'_>, spec: &PassSpec, inputs: ViewInputs, source: ListDraws) {
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots)?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
}

/// Binds the counting pipelines' own group: the counts and, where the shader compares, the depth.
fn bind_counts(
    ctx: &mut RasterContext<'_>,
    pipelines: &PassPipelines,
    test: DepthTest,
    counts: Buffer,
) -> Result<(), AccessError> {
    let binds: Vec<Bind> = std::iter::once(Bind::Buffer(0, counts))
        .chain(test.bind(1))
        .collect();
    group(ctx, pipelines, 1, &binds)
}

/// Binds what all pipelines of a pass share, with `slots` as the instances' vertex buffer. Returns the scene.
pub(crate) fn bind<'a>(
    ctx: &mut RasterContext<'a>,
    inputs: ViewInputs,
    pipelines: &PassPipelines,
    slots: Buffer,
) -> Result<HostRef<'a, SceneFrame>, BodyError> {
    let scene = ctx.get(inputs.scene)?;
    let slots = ctx.buffer(slots)?;
    let shaded = matches!(pipelines.kind(), PipelineKind::Shaded { .. });
    let materials = pipelines.kind().has_materials();
    group(
        ctx,
        pipelines,
        0,
        &[
            Bind::Buffer(0, inputs.uniform),
            Bind::external(1, scene.instances.clone()),
        ],
    )?;
    if shaded {
        group(
            ctx,
            pipelines,
            1,
            &[
                Bind::external(0, scene.materials.clone()),
                Bind::Buffer(1, inputs.lights),
            ],
        )?;
    } else if materials {
        group(
            ctx,
            pipelines,
            1,
            &[Bind::external(0, scene.materials.clone())],
        )?;
        // Pipelines without a mask share the layout, and all groups of a layout must be bound.
        if let Some(white) = scene.textures.first() {
            ctx.pass().set_bind_group(2, white, &[]);
        }
    }
    if shaded && let Some(environment) = &scene.environment {
        ctx.pass()
            .set_bind_group(ENVIRONMENT_GROUP, environment, &[]);
    }
    begin(ctx.pass(), &scene, pipelines, slots);
    Ok(scene)
}

/// Binds one group, where the pipelines have it.
pub(crate) fn group(
    ctx: &mut RasterContext<'_>,
    pipelines: &PassPipelines,
    number: u32,
    binds: &[Bind],
) -> Result<(), AccessError> {
    if let Some(layout) = pipelines.layout(number as usize) {
        let group = ctx.bind_group(number, layout, binds)?;
        ctx.pass().set_bind_group(number, &group, &[]);
    }
    Ok(())
}
