//! The oracle: which entity owns each pixel, drawn by a graph of its own that no strategy has a hand in.
//!
//! What is solid goes into an entity-id buffer in canonical order (batch, then slot). What is blended has no owner a pixel: there the
//! order-independent sum of the visible entities' mixed ids stands for it, and a count an entity. (Item buffers: Weghorst, Hooper and
//! Greenberg, *Improved Computational Methods for Ray Tracing*, 1984.)

mod id_buffer;

pub use id_buffer::{IdBuffer, TransparentSums};

use std::sync::Arc;

use antumbra_draw::passes::{self, IdTargets, ListDraws, PassSpec, Signatures, ViewInputs};
use antumbra_draw::{
    Alpha, DEPTH_FORMAT, DrawList, Gpu, GpuLights, GpuScene, GpuView, IDENTITY_FORMAT,
    PassPipelines, PipelineKind, SceneFrame, SceneLayout, SceneTable, ViewFrame,
};
use antumbra_graph::{
    Buffer, BufferDesc, Clear, CompileOptions, Graph, Host, Plan, Texture, TextureDesc,
};
use antumbra_scene::Camera;

use antumbra_cull::{Candidates, StageError, Verdicts};
use id_buffer::Padded;

/// What the oracle is to draw.
#[derive(Debug, Clone, Copy)]
pub enum EntitySet<'a> {
    /// Everything in the frustum: the reference.
    InFrustum,
    /// These slots, in any order; those that are free are left out.
    Slots(&'a [u32]),
    /// What these verdicts draw, at their levels of detail: what a strategy drew, in the reference's order.
    Drawn(&'a Verdicts),
}

/// Says who owns each pixel. One plan for as long as the scene's layout holds; made at the first look.
pub struct Oracle {
    gpu: Gpu,
    size: [u32; 2],
    built: Option<Built>,
}

struct Built {
    layout: SceneLayout,
    plan: Plan,
    scene: Host<SceneFrame>,
    view: Host<ViewFrame>,
    wanted: Host<Wanted>,
    image: Host<IdBuffer>,
}

/// [`EntitySet`], as it travels into the graph.
enum Wanted {
    Frustum,
    Slots(Vec<u32>, Verdicts),
}

/// The lists under declaration.
#[derive(Clone, Copy)]
struct Lists {
    solid: ListDraws,
    blended: Option<ListDraws>,
}

impl std::fmt::Debug for Oracle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Oracle")
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

impl Oracle {
    /// An oracle for images of `size` pixels (width, height; each at least 1) on the scene's device.
    pub fn new(scene: &GpuScene, size: [u32; 2]) -> Self {
        Self {
            gpu: scene.gpu().clone(),
            size,
            built: None,
        }
    }

    /// Width and height of its images in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Draws `members` as `camera` sees them and waits for the answer. The scene must be on the oracle's device and
    /// [synced](GpuScene::sync).
    ///
    /// # Errors
    /// [`StageError::Camera`] for one that cannot see, [`StageError::Compile`] for a size the device cannot draw,
    /// [`StageError::Execute`] or [`StageError::Device`] when the device fails.
    pub fn render(
        &mut self,
        scene: &GpuScene,
        camera: &Camera,
        members: EntitySet<'_>,
    ) -> Result<IdBuffer, StageError> {
        camera.validate().map_err(|error| StageError::Camera {
            view: "oracle".to_owned(),
            error,
        })?;
        let layout = scene.layout();
        let current = self
            .built
            .take()
            .filter(|built| built.layout == layout)
            .map_or_else(|| build(&self.gpu, self.size, layout), Ok)?;
        let built = self.built.insert(current);
        let wanted = match members {
            EntitySet::InFrustum => Wanted::Frustum,
            EntitySet::Slots(slots) => Wanted::Slots(slots.to_vec(), Verdicts::default()),
            EntitySet::Drawn(verdicts) => {
                Wanted::Slots(verdicts.drawn().collect(), verdicts.clone())
            }
        };
        let plan = &mut built.plan;
        plan.set(built.scene, scene.frame())?;
        plan.set(built.view, ViewFrame::new(*camera, self.size, 0))?;
        plan.set(built.wanted, wanted)?;
        plan.execute(&self.gpu.device, &self.gpu.queue)?;
        self.gpu.check()?;
        let image = plan.get(built.image).cloned();
        image.ok_or_else(|| StageError::Input("an oracle that drew nothing".to_owned()))
    }
}

fn build(gpu: &Gpu, size: [u32; 2], layout: SceneLayout) -> Result<Built, StageError> {
    let mut graph = Graph::new("oracle");
    let g = &mut graph;
    let scene = g.import_host::<SceneFrame>("scene");
    let view = g.import_host::<ViewFrame>("camera");
    let wanted = g.import_host::<Wanted>("members");
    let (inputs, lists) = submit(g, &layout, scene, view, wanted);
    let [width, height] = size;
    let texture = |format| TextureDesc::new(width, height, format);
    let ids = g.texture(
        "entity ids",
        texture(IDENTITY_FORMAT).cleared(Clear::Colour(wgpu::Color::TRANSPARENT)),
    );
    let depth = g.texture("depth", texture(DEPTH_FORMAT).cleared(Clear::Depth(0.0)));
    let spec = spec(gpu, &layout, PipelineKind::Identity);
    let targets = IdTargets { ids, depth };
    let IdTargets { ids, depth } = passes::identity_pass(g, &spec, inputs, lists.solid, targets);
    let padded = Padded::of(size);
    let copied = copy_ids(g, ids, padded);
    let sums = lists
        .blended
        .map(|list| sign(g, gpu, &layout, inputs, list, depth, size));
    let image = read(g, copied, padded, sums);
    g.output(image);
    let plan = graph
        .compile(&CompileOptions::owned(&gpu.device))
        .map_err(|errors| StageError::Compile {
            strategy: "oracle".to_owned(),
            errors,
        })?;
    Ok(Built {
        layout,
        plan,
        scene,
        view,
        wanted,
        image,
    })
}

/// Chooses what is drawn and uploads it, with the camera.
fn submit(
    g: &mut Graph,
    layout: &SceneLayout,
    scene: Host<SceneFrame>,
    view: Host<ViewFrame>,
    wanted: Host<Wanted>,
) -> (ViewInputs, Lists) {
    let uniform = g.buffer("view", BufferDesc::new(size_of::<GpuView>() as u64));
    let lights = g.buffer("lights", BufferDesc::new(size_of::<GpuLights>() as u64));
    let slots = u64::from(layout.slots.max(1)) * 4;
    let mut list = |name: &str| ListDraws {
        list: g.host::<DrawList>(name),
        slots: g.buffer(format!("{name}: slots"), BufferDesc::new(slots)),
    };
    let solid = list("solid");
    let blended = layout.transparent.then(|| list("blended"));
    let mut node = g.host_node("submit");
    node.read(scene).read(view).read(wanted);
    let uniform = node.upload(uniform);
    let solid = solid.written_by(&mut node);
    let blended = blended.map(|list| list.written_by(&mut node));
    let mut candidates = Candidates::default();
    node.run(move |ctx| {
        let (scene, frame) = (ctx.get(scene)?, ctx.get(view)?);
        let table = &scene.table;
        ctx.upload(uniform, 0, bytemuck::bytes_of(&frame.uniform()))?;
        let wanted = ctx.get(wanted)?;
        let in_full = Verdicts::default();
        let (members, verdicts) = match &*wanted {
            Wanted::Frustum => {
                candidates.find(table, &frame);
                (candidates.inside(), &in_full)
            }
            Wanted::Slots(slots, verdicts) => (slots.as_slice(), verdicts),
        };
        let of = |transparent: bool| {
            chosen(table, members, transparent).map(|slot| (slot, verdicts.level(slot)))
        };
        let levels = verdicts.levels();
        let mut list = ctx.get_mut(solid.list)?;
        list.fill_levels(table, of(false), levels);
        ctx.upload(solid.slots, 0, bytemuck::cast_slice(list.slots()))?;
        if let Some(blended) = blended {
            let mut list = ctx.get_mut(blended.list)?;
            list.fill_levels(table, of(true), levels);
            ctx.upload(blended.slots, 0, bytemuck::cast_slice(list.slots()))?;
        }
        Ok(())
    });
    let inputs = ViewInputs {
        scene,
        view,
        uniform,
        lights,
    };
    (inputs, Lists { solid, blended })
}

fn chosen<'a>(
    table: &'a SceneTable,
    members: &'a [u32],
    transparent: bool,
) -> impl Iterator<Item = u32> + Clone + 'a {
    let live = members
        .iter()
        .copied()
        .filter(|slot| table.occupant(*slot).is_some());
    live.filter(move |slot| table.is_transparent(*slot) == transparent)
}

fn spec(gpu: &Gpu, layout: &SceneLayout, kind: PipelineKind) -> PassSpec {
    let blends = kind == PipelineKind::Signature;
    let classes = layout
        .classes()
        .filter(|class| (class.alpha() == Alpha::Blend) == blends);
    PassSpec {
        name: if blends { "signatures" } else { "entity ids" }.to_owned(),
        group: "oracle",
        pipelines: Arc::new(PassPipelines::new(gpu, kind, classes)),
    }
}

fn copy_ids(g: &mut Graph, ids: Texture, padded: Padded) -> Buffer {
    let buffer = g.buffer("copied ids", BufferDesc::new(padded.bytes()));
    let mut node = g.copy("copy ids");
    node.copy_src(ids);
    let buffer = node.copy_dst(buffer);
    node.run(move |ctx| {
        let (from, to) = (ctx.texture(ids)?.clone(), ctx.buffer(buffer)?.clone());
        ctx.encoder().copy_texture_to_buffer(
            from.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &to,
                layout: padded.layout(),
            },
            padded.extent(),
        );
        Ok(())
    });
    buffer
}

/// Adds up what is blended, against the depth of what is solid.
fn sign(
    g: &mut Graph,
    gpu: &Gpu,
    layout: &SceneLayout,
    inputs: ViewInputs,
    what: ListDraws,
    depth: Texture,
    [width, height]: [u32; 2],
) -> Signatures {
    let pixels = u64::from(width) * u64::from(height) * 4;
    let slots = u64::from(layout.slots.max(1)) * 4;
    let sums = Signatures {
        by_pixel: g.buffer("signatures", BufferDesc::new(pixels).zeroed()),
        by_slot: g.buffer("samples", BufferDesc::new(slots).zeroed()),
    };
    let scratch = g.texture(
        "scratch depth",
        TextureDesc::new(width, height, DEPTH_FORMAT).cleared(Clear::Depth(0.0)),
    );
    let spec = spec(gpu, layout, PipelineKind::Signature);
    passes::signature_pass(g, &spec, inputs, what, depth, scratch, sums)
}

/// Waits for it all and puts it into an image: the one sync point.
fn read(g: &mut Graph, ids: Buffer, padded: Padded, sums: Option<Signatures>) -> Host<IdBuffer> {
    let image = g.host::<IdBuffer>("image");
    let mut node = g.host_node("read");
    node.read_back(ids);
    if let Some(sums) = sums {
        node.read_back(sums.by_pixel).read_back(sums.by_slot);
    }
    let image = node.write(image);
    node.run(move |ctx| {
        let mut image = ctx.get_mut(image)?;
        padded.unpack(ctx.bytes(ids)?, &mut image);
        image.transparent = match sums {
            Some(sums) => Some(TransparentSums {
                signatures: bytemuck::pod_collect_to_vec(ctx.bytes(sums.by_pixel)?),
                samples: bytemuck::pod_collect_to_vec(ctx.bytes(sums.by_slot)?),
            }),
            None => None,
        };
        Ok(())
    });
    image
}
