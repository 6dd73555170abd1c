//! Raster nodes that draw: depth, hardware queries, sample counts, entity ids, shaded colour, audited patches. Each is one node over one draw
//! source.

use std::sync::Arc;

use antumbra_cull::patches::{PATCH_SIDE, PatchDraws};
use antumbra_cull::{
    DepthTest, DrawSource, IdTargets, ListDraws, SceneFrame, ShadeTargets, Targets, ViewInputs,
};
use antumbra_graph::{
    AccessError, Bind, BodyError, Buffer, Graph, HostRef, RasterBuilder, RasterContext, Texture,
};

use crate::pipeline::{ENVIRONMENT_GROUP, PassPipelines};
use crate::record::{Recorder, begin};
use crate::scene::SceneBuffers;

/// Sums over visible transparent fragments, a u32 each.
#[derive(Debug, Clone, Copy)]
pub struct Signatures {
    /// Hashed entity ids, added up by pixel, row by row.
    pub by_pixel: Buffer,
    /// Fragments by slot.
    pub by_slot: Buffer,
}

/// A drawing node's name, timing group and pipelines.
#[derive(Debug, Clone)]
pub struct PassSpec {
    /// The node's name.
    pub name: String,
    /// The label under which its time is summed: `cull`, `draw` or `audit`.
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
    let mut node = node(g, spec, inputs, source.into());
    let depth = node.depth(depth);
    draw(&mut node, spec, inputs, None, source.into());
    depth
}

/// Writes the entity ids and the depth of a list. The pipelines are [`PipelineKind::Identity`](crate::PipelineKind::Identity).
pub fn identity_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    targets: IdTargets,
) -> IdTargets {
    let mut node = node(g, spec, inputs, source.into());
    let out = IdTargets {
        ids: node.colour(targets.ids),
        depth: node.depth(targets.depth),
    };
    draw(&mut node, spec, inputs, None, source.into());
    out
}

/// Shades a source, lit by `lights`, which is uploaded [`GpuLights`](crate::GpuLights). Blended classes test the depth and do not write it. The pipelines are [identified](crate::PipelineKind::identified) exactly where `into` has ids.
pub fn shaded_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    lights: Buffer,
    source: DrawSource,
    into: ShadeTargets,
) -> ShadeTargets {
    let mut node = node(g, spec, inputs, source);
    node.storage_read(lights);
    let lights = Some(lights);
    let colour = node.colour(into.targets.colour);
    let ids = into.ids.map(|ids| node.colour(ids));
    let depth = node.depth(into.targets.depth);
    let queries = match (source, into.queries) {
        (DrawSource::List(list), Some(results)) => {
            Some(draw_queried(&mut node, spec, inputs, lights, list, results))
        }
        (_, queries) => {
            draw(&mut node, spec, inputs, lights, source);
            queries
        }
    };
    ShadeTargets {
        targets: Targets { colour, depth },
        ids,
        queries,
    }
}

/// Draws what a shading pass would, for a stage without an image: the colour is left alone. The pipelines are [`PipelineKind::Hide`](crate::PipelineKind::Hide).
pub fn hide_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: DrawSource,
    into: ShadeTargets,
) -> ShadeTargets {
    let mut node = node(g, spec, inputs, source);
    let ids = into.ids.map(|ids| node.colour(ids));
    let depth = node.depth(into.targets.depth);
    let queries = match (source, into.queries) {
        (DrawSource::List(list), Some(results)) => {
            Some(draw_queried(&mut node, spec, inputs, None, list, results))
        }
        (_, queries) => {
            draw(&mut node, spec, inputs, None, source);
            queries
        }
    };
    ShadeTargets {
        targets: Targets {
            colour: into.targets.colour,
            depth,
        },
        ids,
        queries,
    }
}

/// Draws a list with one hardware query for each of its [queries](antumbra_cull::DrawList::query_count), in the list's order, against a depth
/// that it does not write. The results are u64: zero, or something else.
pub fn query_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    depth: Texture,
    answers: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, source.into());
    node.depth_read(depth);
    draw_queried(&mut node, spec, inputs, None, source, answers)
}

/// Counts the samples of a source that pass against a finished depth, by slot. The pipelines are [`PipelineKind::CountAtomic`](crate::PipelineKind::CountAtomic) for
/// [`DepthTest::Early`] and [`PipelineKind::CountCompare`](crate::PipelineKind::CountCompare) for [`DepthTest::InShader`]. Ties pass.
pub fn count_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: DrawSource,
    test: DepthTest,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, source);
    test.declare(&mut node);
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let scene = bind(ctx, inputs, &pipelines, source.as_list().slots, None)?;
        bind_counts(ctx, &pipelines, test, counted)?;
        record(ctx, &scene, &pipelines, source)
    });
    counted
}

/// Writes the entity ids and the depth of one of a pixel's samples, and resolves the ids into `resolved`: the bytes of slot + 1, divided by the number of samples. Returns
/// the resolved ids and the depth. The pipelines are [`PipelineKind::SampleIdentity`](crate::PipelineKind::SampleIdentity).
pub fn sample_identity_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    drawn: IdTargets,
    resolved: Texture,
) -> IdTargets {
    let mut node = node(g, spec, inputs, source.into());
    node.colour(drawn.ids);
    let out = IdTargets {
        ids: node.resolve(resolved),
        depth: node.depth(drawn.depth),
    };
    draw(&mut node, spec, inputs, None, source.into());
    out
}

/// Adds up the hashed ids of a list's visible transparent fragments, by pixel, and their number by slot, against an opaque depth. The pipelines are
/// [`PipelineKind::SignatureEarly`](crate::PipelineKind::SignatureEarly) for [`DepthTest::Early`] and [`PipelineKind::Signature`](crate::PipelineKind::Signature) for
/// [`DepthTest::InShader`].
pub fn signature_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: ListDraws,
    test: DepthTest,
    sums: Signatures,
) -> Signatures {
    let mut node = node(g, spec, inputs, source.into());
    test.declare(&mut node);
    let sums = Signatures {
        by_pixel: node.storage_write(sums.by_pixel),
        by_slot: node.storage_write(sums.by_slot),
    };
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let scene = bind(ctx, inputs, &pipelines, source.slots, None)?;
        let sums = [
            Bind::Buffer(0, sums.by_pixel),
            Bind::Buffer(1, sums.by_slot),
        ];
        let binds: Vec<Bind> = sums.into_iter().chain(test.bind(2)).collect();
        group(ctx, &pipelines, 3, &binds)?;
        record(ctx, &scene, &pipelines, source.into())
    });
    sums
}

/// Draws kept entries into their patches and marks the pixels in which any of them is in front of a finished depth. `shown` has
/// [`PATCH_BYTES`](antumbra_cull::patches::PATCH_BYTES) for each patch; the marks must be zero before. The pipelines are [`PipelineKind::PatchEarly`](crate::PipelineKind::PatchEarly) for [`DepthTest::Early`] and
/// [`PipelineKind::PatchCompare`](crate::PipelineKind::PatchCompare) for [`DepthTest::InShader`].
pub fn patch_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: PatchDraws,
    test: DepthTest,
    shown: Buffer,
) -> Buffer {
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(inputs.view)
        .read(source.list)
        .vertex(source.kept)
        .indirect(source.draws)
        .uniform(inputs.uniform)
        .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE)
        // The node's body reports a value that cannot be read.
        .only_if(move |host| host.get(source.list).map_or(true, |list| !list.is_empty()));
    test.declare(&mut node);
    let marked = node.storage_write(shown);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let [width, height] = ctx.get(inputs.view)?.size;
        let draws = ctx.buffer(source.draws)?;
        let scene = bind(ctx, inputs, &pipelines, source.kept, None)?;
        let mut binds = vec![Bind::Buffer(0, marked)];
        binds.extend(test.bind(1));
        group(ctx, &pipelines, 3, &binds)?;
        let mut recorder = Recorder::new(&scene, buffers_of(&scene)?, &pipelines);
        for patch in list.patches() {
            let [x, y] = patch.corner;
            let side = |from: u32, end: u32| PATCH_SIDE.min(end.saturating_sub(from));
            let (wide, high) = (side(x, width), side(y, height));
            let runs = list.runs().get(patch.runs.clone()).unwrap_or_default();
            if runs.is_empty() || wide == 0 || high == 0 {
                continue;
            }
            ctx.pass().set_scissor_rect(x, y, wide, high);
            recorder.indirect(ctx.pass(), runs, draws, patch.runs.start);
        }
        Ok(())
    });
    marked
}

/// A node that reads a source. Without the feature, an indirect draw whose first instance is not 0 draws nothing, and no error is reported.
fn node<'g>(
    g: &'g mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    source: DrawSource,
) -> RasterBuilder<'g> {
    let list = source.as_list();
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(list.list)
        .vertex(list.slots)
        .uniform(inputs.uniform)
        // The node's body reports a value that cannot be read.
        .only_if(move |host| host.get(list.list).map_or(true, |list| !list.is_empty()));
    if let DrawSource::Indirect(indirect) = source {
        node.indirect(indirect.draws)
            .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    }
    node
}

/// Draws a list, each of its queries within a hardware query.
fn draw_queried(
    node: &mut RasterBuilder<'_>,
    spec: &PassSpec,
    inputs: ViewInputs,
    lights: Option<Buffer>,
    source: ListDraws,
    answers: Buffer,
) -> Buffer {
    let answers = node.queries(answers, move |host| {
        host.get(source.list).map_or(0, |list| list.query_count())
    });
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(source.list)?;
        let scene = bind(ctx, inputs, &pipelines, source.slots, lights)?;
        let mut recorder = Recorder::new(&scene, buffers_of(&scene)?, &pipelines);
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

fn draw(
    node: &mut RasterBuilder<'_>,
    spec: &PassSpec,
    inputs: ViewInputs,
    lights: Option<Buffer>,
    source: DrawSource,
) {
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let scene = bind(ctx, inputs, &pipelines, source.as_list().slots, lights)?;
        record(ctx, &scene, &pipelines, source)
    });
}

/// Records a source into a pass that is bound.
fn record(
    ctx: &mut RasterContext<'_>,
    scene: &SceneFrame,
    pipelines: &PassPipelines,
    source: DrawSource,
) -> Result<(), BodyError> {
    let mut recorder = Recorder::new(scene, buffers_of(scene)?, pipelines);
    let list = ctx.get(source.as_list().list)?;
    match source {
        DrawSource::List(_) => recorder.list(ctx.pass(), &list),
        DrawSource::Indirect(indirect) => {
            let draws = ctx.buffer(indirect.draws)?;
            recorder.indirect(ctx.pass(), list.runs(), draws, 0);
        }
    }
    Ok(())
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

/// What the passes read of a scene.
pub(crate) fn buffers_of(scene: &SceneFrame) -> Result<&SceneBuffers, BodyError> {
    scene.data::<SceneBuffers>().ok_or_else(|| {
        BodyError::msg("the built-in renderer draws scenes of `GpuScene` alone: use the renderer of the scene at hand")
    })
}

/// Binds what all pipelines of a pass share, with `slots` as the instances' vertex buffer, and `lights` for shading.
fn bind<'a>(
    ctx: &mut RasterContext<'a>,
    inputs: ViewInputs,
    pipelines: &PassPipelines,
    slots: Buffer,
    lights: Option<Buffer>,
) -> Result<HostRef<'a, SceneFrame>, BodyError> {
    let scene = ctx.get(inputs.scene)?;
    let buffers = buffers_of(&scene)?;
    let slots = ctx.buffer(slots)?;
    let binds = [
        Bind::Buffer(0, inputs.uniform),
        Bind::external(1, buffers.instances.clone()),
    ];
    group(ctx, pipelines, 0, &binds)?;
    let materials = || Bind::external(0, buffers.materials.clone());
    if let Some(lights) = lights {
        let binds = [materials(), Bind::Buffer(1, lights)];
        group(ctx, pipelines, 1, &binds)?;
        if let Some(environment) = &buffers.environment {
            ctx.pass()
                .set_bind_group(ENVIRONMENT_GROUP, environment, &[]);
        }
    } else if pipelines.kind().has_materials() {
        group(ctx, pipelines, 1, &[materials()])?;
        // Pipelines without a mask share the layout, and all groups of a layout must be bound.
        if let Some(white) = buffers.textures.first() {
            ctx.pass().set_bind_group(2, white, &[]);
        }
    }
    begin(ctx.pass(), buffers, pipelines, slots);
    Ok(scene)
}

/// Binds one group, where the pipelines have it.
fn group(
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
