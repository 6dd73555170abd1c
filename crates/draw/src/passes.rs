//! Graph nodes that draw: depth, queries, counts, entity ids, shaded colour. Each is one raster node over a submitted list.

use std::sync::Arc;

use antumbra_graph::{
    AccessError, Bind, BodyError, Buffer, Graph, Host, HostRef, RasterContext, Texture,
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

/// A draw list whose slots are on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct Submitted {
    /// The list.
    pub list: Host<DrawList>,
    /// Its slots.
    pub ids: Buffer,
}

/// A draw list of which a compute node kept some: as many indirect draws as the list has runs.
#[derive(Debug, Clone, Copy)]
pub struct Indirect {
    /// The list that was chosen from; says which pipeline each draw takes.
    pub layout: Host<DrawList>,
    /// The slots kept, at the places of their runs.
    pub ids: Buffer,
    /// The draws.
    pub draws: Buffer,
}

impl Indirect {
    /// What was chosen from.
    fn submitted(self) -> Submitted {
        Submitted {
            list: self.layout,
            ids: self.ids,
        }
    }
}

/// What a drawing node is called, summed under, and draws with.
#[derive(Debug, Clone)]
pub struct PassSpec {
    /// Its name.
    pub name: String,
    /// The label of its time: `cull` or `draw`.
    pub group: &'static str,
    /// Its pipelines.
    pub pipelines: Arc<PassPipelines>,
}

/// Writes the depth of a list.
pub fn depth_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    depth: Texture,
) -> Texture {
    let mut node = node(g, spec, inputs, what);
    let depth = node.depth(depth);
    draw(&mut node, spec, inputs, what);
    depth
}

/// Writes the entity ids and the depth of a list.
pub fn identity_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    ids: Texture,
    depth: Texture,
) -> (Texture, Texture) {
    let mut node = node(g, spec, inputs, what);
    let out = (node.colour(ids), node.depth(depth));
    draw(&mut node, spec, inputs, what);
    out
}

/// Shades a list; blended classes test the depth and leave it alone.
pub fn shaded_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    colour: Texture,
    depth: Texture,
) -> (Texture, Texture) {
    let mut node = node(g, spec, inputs, what);
    node.storage_read(inputs.lights);
    let out = (node.colour(colour), node.depth(depth));
    draw(&mut node, spec, inputs, what);
    out
}

/// Shades what a compute node kept of a list. `ids` takes the entities' ids, where the pipelines [identify](PipelineKind::Shaded) them.
pub fn shaded_indirect_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Indirect,
    (colour, depth): (Texture, Texture),
    ids: Option<Texture>,
) -> (Texture, Texture, Option<Texture>) {
    let mut node = node(g, spec, inputs, what.submitted());
    node.storage_read(inputs.lights).indirect(what.draws);
    // Without it draws that begin at another instance than the first draw nothing, and nobody is told.
    node.requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    let colour = node.colour(colour);
    let ids = ids.map(|ids| node.colour(ids));
    let depth = node.depth(depth);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let layout = ctx.get(what.layout)?;
        let draws = ctx.buffer(what.draws)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        Recorder::new(&scene, &pipelines).indirect(ctx.pass(), layout.runs(), draws, 0);
        Ok(())
    });
    (colour, depth, ids)
}

/// Asks one hardware query a [question](DrawList::questions) of a list, in the list's order, against a depth that stays as it is.
/// The answers are u64: zero, or something else.
pub fn query_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    depth: Texture,
    answers: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, what);
    node.depth_read(depth);
    ask(&mut node, spec, inputs, what, answers)
}

/// Shades a list with a hardware query a question, in the list's order: whether any sample of it passed while it was drawn.
/// The answers are u64: zero, or something else.
pub fn shaded_query_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    (colour, depth): (Texture, Texture),
    answers: Buffer,
) -> (Texture, Texture, Buffer) {
    let mut node = node(g, spec, inputs, what);
    node.storage_read(inputs.lights);
    let (colour, depth) = (node.colour(colour), node.depth(depth));
    (colour, depth, ask(&mut node, spec, inputs, what, answers))
}

/// Counts the samples of a list that pass against a depth, by slot, with fragment atomics.
pub fn count_atomic_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    depth: Texture,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, what);
    node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
        .depth_read(depth);
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        group(ctx, &pipelines, 1, &[Bind::Buffer(0, counted)])?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
    counted
}

/// Counts the samples of a list that lie at or before a depth, by slot, comparing in the shader. `scratch` is a depth
/// texture of the same size that nobody looks at: a pass needs an attachment, and not every device lets one be read too.
pub fn count_compare_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    depth: Texture,
    scratch: Texture,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, what);
    node.sample(depth).depth(scratch);
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        group(
            ctx,
            &pipelines,
            1,
            &[Bind::Buffer(0, counted), Bind::Texture(1, depth)],
        )?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
    counted
}

/// Counts the samples of what a compute node kept of a list, by slot, that lie at or before a depth. With a `scratch` depth it
/// [compares](count_compare_pass), without one it counts [atomically](count_atomic_pass).
pub fn count_indirect_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Indirect,
    depth: Texture,
    scratch: Option<Texture>,
    counts: Buffer,
) -> Buffer {
    let mut node = node(g, spec, inputs, what.submitted());
    node.indirect(what.draws)
        .requires(wgpu::Features::INDIRECT_FIRST_INSTANCE);
    match scratch {
        Some(scratch) => {
            node.sample(depth).depth(scratch);
        }
        None => {
            node.requires(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
                .depth_read(depth);
        }
    }
    let counted = node.storage_write(counts);
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let layout = ctx.get(what.layout)?;
        let draws = ctx.buffer(what.draws)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        let texture = scratch.map(|_| Bind::Texture(1, depth));
        let binds: Vec<Bind> = std::iter::once(Bind::Buffer(0, counted))
            .chain(texture)
            .collect();
        group(ctx, &pipelines, 1, &binds)?;
        Recorder::new(&scene, &pipelines).indirect(ctx.pass(), layout.runs(), draws, 0);
        Ok(())
    });
    counted
}

/// Adds up the ids of a list's visible transparent fragments, by pixel and by slot, against an opaque depth.
pub fn signature_pass(
    g: &mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    depth: Texture,
    scratch: Texture,
    [signatures, samples]: [Buffer; 2],
) -> [Buffer; 2] {
    let mut node = node(g, spec, inputs, what);
    node.sample(depth).depth(scratch);
    let [signatures, samples] = [node.storage_write(signatures), node.storage_write(samples)];
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        group(
            ctx,
            &pipelines,
            3,
            &[
                Bind::Buffer(0, signatures),
                Bind::Buffer(1, samples),
                Bind::Texture(2, depth),
            ],
        )?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
    [signatures, samples]
}

fn node<'g>(
    g: &'g mut Graph,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
) -> antumbra_graph::RasterBuilder<'g> {
    let mut node = g.raster(spec.name.clone());
    node.group(spec.group)
        .read(inputs.scene)
        .read(what.list)
        .vertex(what.ids)
        .uniform(inputs.uniform)
        // A value that cannot be read is the body's to complain of.
        .only_if(move |host| host.get(what.list).map_or(true, |list| !list.is_empty()));
    node
}

/// Draws a list with a query around each question.
fn ask(
    node: &mut antumbra_graph::RasterBuilder<'_>,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
    answers: Buffer,
) -> Buffer {
    let answers = node.queries(answers, move |host| {
        host.get(what.list).map_or(0, |list| list.questions())
    });
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        let mut recorder = Recorder::new(&scene, &pipelines);
        let mut runs = list.runs();
        for number in ctx.query_range() {
            let entries = list.question(number);
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
    node: &mut antumbra_graph::RasterBuilder<'_>,
    spec: &PassSpec,
    inputs: ViewInputs,
    what: Submitted,
) {
    let pipelines = Arc::clone(&spec.pipelines);
    node.run(move |ctx| {
        let list = ctx.get(what.list)?;
        let scene = bind(ctx, inputs, &pipelines, what.ids)?;
        Recorder::new(&scene, &pipelines).list(ctx.pass(), &list);
        Ok(())
    });
}

/// Binds what all pipelines of a pass share and hands out the scene.
pub fn bind<'a>(
    ctx: &mut RasterContext<'a>,
    inputs: ViewInputs,
    pipelines: &PassPipelines,
    ids: Buffer,
) -> Result<HostRef<'a, SceneFrame>, BodyError> {
    let scene = ctx.get(inputs.scene)?;
    let ids = ctx.buffer(ids)?;
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
        // Pipelines without a mask share the layout, and a layout's groups must all be bound.
        if let Some(white) = scene.textures.first() {
            ctx.pass().set_bind_group(2, white, &[]);
        }
    }
    if shaded && let Some(environment) = &scene.environment {
        ctx.pass()
            .set_bind_group(ENVIRONMENT_GROUP, environment, &[]);
    }
    begin(ctx.pass(), &scene, ids, materials);
    Ok(scene)
}

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
