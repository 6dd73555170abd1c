//! The oracle: renders which entity owns each sample, with a graph of its own that no strategy takes part in.
//!
//! Solid entities are drawn into an entity-id buffer in canonical order (by batch, then by slot). With several samples a pixel, each sample has a pass
//! of its own: integers cannot be resolved, and not every device can read the samples of what it has drawn. Transparent entities own no sample: each
//! pixel gets the order-independent sum of the mixed ids of its visible transparent fragments, and each slot gets their number.
//! (Item buffers: Weghorst, Hooper and Greenberg, *Improved Computational Methods for Ray Tracing*, 1984.)

mod differences;
mod id_buffer;
mod owners;
mod padded_rows;

pub use differences::Differences;
pub use id_buffer::{IdBuffer, TransparentSums};

use std::sync::Arc;

use antumbra_cull::{
    Alpha, Candidates, Counting, DEPTH_FORMAT, DepthTest, DrawList, Gpu, GpuView, ListDraws,
    MeshDetail, SceneFrame, SceneLayout, SceneTable, StageError, StageScene, Verdicts, ViewFrame,
    ViewInputs, read_back,
};
use antumbra_draw::passes::{self, PassSpec, Signatures};
use antumbra_draw::{PassPipelines, PipelineKind};
use antumbra_graph::{BufferDesc, Clear, Graph, Host, Plan, Texture, TextureDesc};
use antumbra_scene::Camera;

use owners::Owners;

/// The shape of an image.
#[derive(Debug, Clone, Copy)]
struct Image {
    /// Width and height in pixels.
    size: [u32; 2],
    /// Samples a pixel.
    samples: u32,
}

/// Which entities the oracle draws.
#[derive(Debug, Clone, Copy)]
pub enum EntitySet<'a> {
    /// All entities in the frustum: the reference.
    InFrustum,
    /// The entities in these slots, given in any order; free slots are skipped.
    Slots(&'a [u32]),
    /// The entities that these verdicts draw, at their levels of detail: what a strategy drew, in the reference's order.
    Drawn(&'a Verdicts),
    /// The same, drawn after the entities in the slots `under`: where depths are equal, what the verdicts draw is in front.
    DrawnOver {
        /// What is drawn last.
        verdicts: &'a Verdicts,
        /// What is drawn first, at full detail.
        under: &'a [u32],
    },
}

/// Renders which entity owns each sample. Compiles its plan at the first call of [`Self::render`], and again when the scene's layout
/// changes.
pub struct Oracle {
    gpu: Gpu,
    image: Image,
    built: Option<Built>,
    /// The plan that draws some entities before all others.
    layered: Option<Built>,
}

struct Built {
    layout: SceneLayout,
    plan: Plan,
    scene: Host<SceneFrame>,
    view: Host<ViewFrame>,
    entities: Host<OwnedSet>,
    owners: Owners,
    sums: Option<Signatures>,
}

/// An [`EntitySet`] without borrows, as the graph needs it.
enum OwnedSet {
    InFrustum,
    Listed {
        slots: Vec<u32>,
        /// The levels of detail; level 0 for a slot without a verdict.
        levels: Verdicts,
        /// Drawn before, at full detail. A plan without layers has none.
        under: Vec<u32>,
    },
}

/// Whether a plan draws some entities before all others.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Layers {
    One,
    Two,
}

/// Whether entities are solid or blended.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Blending {
    Solid,
    Transparent,
}

/// The draw lists that the oracle fills.
#[derive(Clone, Copy)]
struct Lists {
    under: Option<ListDraws>,
    solid: ListDraws,
    transparent: Option<ListDraws>,
}

impl std::fmt::Debug for Oracle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Oracle")
            .field("image", &self.image)
            .finish_non_exhaustive()
    }
}

impl Oracle {
    /// An oracle on the scene's device, for images of `size` pixels (width, height; each at least 1) with one sample each.
    pub fn new(scene: &dyn StageScene, size: [u32; 2]) -> Self {
        Self {
            gpu: scene.gpu().clone(),
            image: Image { size, samples: 1 },
            built: None,
            layered: None,
        }
    }

    /// For images with several samples a pixel: 4, or what else the device has. A scene with transparent entities then needs a device that counts by
    /// [`Counting::Atomics`] or [`Counting::Compare`] with as many.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Self {
        let image = Image {
            samples,
            ..self.image
        };
        Self {
            image,
            built: None,
            layered: None,
            ..self
        }
    }

    /// Width and height of the images in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.image.size
    }

    /// The samples a pixel of the images.
    pub fn samples(&self) -> u32 {
        self.image.samples
    }

    /// Renders `entities` from `camera` and waits for the result. The scene must be on the oracle's device and
    /// synced.
    ///
    /// # Errors
    /// As for [`Self::render_async`]; [`StageError::Device`] in a browser.
    pub fn render(
        &mut self,
        scene: &dyn StageScene,
        camera: &Camera,
        entities: EntitySet<'_>,
    ) -> Result<IdBuffer, StageError> {
        let gpu = self.gpu.clone();
        gpu.block_on(
            "`Oracle::render`",
            "`Oracle::render_async`",
            self.render_async(scene, camera, entities),
        )
    }

    /// [`Self::render`], to be awaited.
    ///
    /// # Errors
    /// [`StageError::Camera`] for an invalid camera, [`StageError::Device`] for samples and [`StageError::Compile`] for a size that the device cannot draw,
    /// [`StageError::Execute`] or [`StageError::Device`] when the device fails.
    pub async fn render_async(
        &mut self,
        scene: &dyn StageScene,
        camera: &Camera,
        entities: EntitySet<'_>,
    ) -> Result<IdBuffer, StageError> {
        camera.validate().map_err(|error| StageError::Camera {
            view: "oracle".to_owned(),
            error,
        })?;
        self.gpu.check_samples(self.image.samples)?;
        let layout = scene.layout();
        let (kept, layers) = match entities {
            EntitySet::DrawnOver { .. } => (&mut self.layered, Layers::Two),
            _ => (&mut self.built, Layers::One),
        };
        let current = kept
            .take()
            .filter(|built| built.layout == layout)
            .map_or_else(|| build(&self.gpu, self.image, layout, layers), Ok)?;
        let built = kept.insert(current);
        let drawn = |verdicts: &Verdicts, under: &[u32]| OwnedSet::Listed {
            slots: verdicts.drawn().collect(),
            levels: verdicts.clone(),
            under: under.to_vec(),
        };
        let entities = match entities {
            EntitySet::InFrustum => OwnedSet::InFrustum,
            EntitySet::Slots(slots) => OwnedSet::Listed {
                slots: slots.to_vec(),
                levels: Verdicts::default(),
                under: Vec::new(),
            },
            EntitySet::Drawn(verdicts) => drawn(verdicts, &[]),
            EntitySet::DrawnOver { verdicts, under } => drawn(verdicts, under),
        };
        let plan = &mut built.plan;
        plan.set(built.scene, scene.frame())?;
        plan.set(built.view, ViewFrame::new(*camera, self.image.size, 0))?;
        plan.set(built.entities, entities)?;
        plan.execute(&self.gpu.device, &self.gpu.queue)?;
        self.gpu.check()?;
        read(&self.gpu, built).await
    }
}

fn build(
    gpu: &Gpu,
    image: Image,
    layout: SceneLayout,
    layers: Layers,
) -> Result<Built, StageError> {
    let mut graph = Graph::new("oracle");
    let g = &mut graph;
    let scene = g.import_host::<SceneFrame>("scene");
    let view = g.import_host::<ViewFrame>("camera");
    let entities = g.import_host::<OwnedSet>("entities");
    let (inputs, lists) = submit(g, &layout, layers, scene, view, entities);
    let solid = |kind| pass_spec(gpu, &layout, kind, image.samples);
    let drawn = [lists.under, Some(lists.solid)];
    let drawn = drawn.into_iter().flatten().collect::<Vec<_>>();
    let owners = Owners::draw(g, image, inputs, &drawn, solid);
    let sums = lists
        .transparent
        .map(|list| sum_transparent(g, gpu, &layout, inputs, list, owners.depth, image));
    owners.output(g);
    if let Some(sums) = sums {
        g.output(sums.by_pixel);
        g.output(sums.by_slot);
    }
    let plan = graph
        .compile(&gpu.compile_options())
        .map_err(|errors| StageError::Compile {
            strategy: "oracle".to_owned(),
            errors,
        })?;
    Ok(Built {
        layout,
        plan,
        scene,
        view,
        entities,
        owners,
        sums,
    })
}

/// Uploads the camera and the slots to draw.
fn submit(
    g: &mut Graph,
    layout: &SceneLayout,
    layers: Layers,
    scene: Host<SceneFrame>,
    view: Host<ViewFrame>,
    entities: Host<OwnedSet>,
) -> (ViewInputs, Lists) {
    let uniform = g.buffer("view", BufferDesc::new(size_of::<GpuView>() as u64));
    let slots = u64::from(layout.slots.max(1)) * 4;
    let mut list = |name: &str| ListDraws {
        list: g.host::<DrawList>(name),
        slots: g.buffer(format!("{name}: slots"), BufferDesc::new(slots)),
    };
    let under = (layers == Layers::Two).then(|| list("under"));
    let solid = list("solid");
    let transparent = layout.transparent.then(|| list("transparent"));
    let mut node = g.host_node("submit");
    node.read(scene).read(view).read(entities);
    let uniform = node.upload(uniform);
    let under = under.map(|draws| draws.written_by(&mut node));
    let solid = solid.written_by(&mut node);
    let transparent = transparent.map(|draws| draws.written_by(&mut node));
    let mut candidates = Candidates::default();
    node.run(move |ctx| {
        let (scene, frame) = (ctx.get(scene)?, ctx.get(view)?);
        let table = &scene.table;
        ctx.upload(uniform, 0, bytemuck::bytes_of(&frame.uniform()))?;
        let entities = ctx.get(entities)?;
        let full_detail = Verdicts::default();
        let (slots, verdicts, first) = match &*entities {
            OwnedSet::InFrustum => {
                candidates.find(table, &frame);
                (candidates.inside(), &full_detail, &[][..])
            }
            OwnedSet::Listed {
                slots,
                levels,
                under,
            } => (slots.as_slice(), levels, under.as_slice()),
        };
        if let Some(under) = under {
            let mut list = ctx.get_mut(under.list)?;
            list.fill(
                table,
                live(table, first, Blending::Solid),
                MeshDetail::Level(0),
            );
            ctx.upload(under.slots, 0, bytemuck::cast_slice(list.slots()))?;
        }
        let chosen = |blending: Blending| {
            live(table, slots, blending).map(|slot| (slot, verdicts.level(slot)))
        };
        let levels = verdicts.levels();
        let mut list = ctx.get_mut(solid.list)?;
        list.fill_levels(table, chosen(Blending::Solid), levels);
        ctx.upload(solid.slots, 0, bytemuck::cast_slice(list.slots()))?;
        if let Some(transparent) = transparent {
            let mut list = ctx.get_mut(transparent.list)?;
            list.fill_levels(table, chosen(Blending::Transparent), levels);
            ctx.upload(transparent.slots, 0, bytemuck::cast_slice(list.slots()))?;
        }
        Ok(())
    });
    let inputs = ViewInputs {
        scene,
        view,
        uniform,
    };
    let lists = Lists {
        under,
        solid,
        transparent,
    };
    (inputs, lists)
}

/// Those of the slots that hold an entity of this blending.
fn live<'a>(
    table: &'a SceneTable,
    slots: &'a [u32],
    blending: Blending,
) -> impl Iterator<Item = u32> + Clone + 'a {
    let transparent = blending == Blending::Transparent;
    let occupied = slots
        .iter()
        .copied()
        .filter(|slot| table.occupant(*slot).is_some());
    occupied.filter(move |slot| table.is_transparent(*slot) == transparent)
}

/// A pass with pipelines of a kind, for the classes that it draws.
fn pass_spec(gpu: &Gpu, layout: &SceneLayout, kind: PipelineKind, samples: u32) -> PassSpec {
    let transparent = matches!(kind, PipelineKind::Signature | PipelineKind::SignatureEarly);
    let name = match (transparent, kind) {
        (true, _) => "signatures".to_owned(),
        (_, PipelineKind::SampleIdentity { sample }) => format!("entity ids of sample {sample}"),
        _ => "entity ids".to_owned(),
    };
    let classes = layout
        .classes()
        .filter(|class| (class.alpha() == Alpha::Blend) == transparent);
    PassSpec {
        name,
        group: "oracle",
        pipelines: Arc::new(PassPipelines::new(gpu, kind, samples, classes)),
    }
}

/// Sums the transparent fragments that pass the depth test against the solid entities.
fn sum_transparent(
    g: &mut Graph,
    gpu: &Gpu,
    layout: &SceneLayout,
    inputs: ViewInputs,
    draws: ListDraws,
    depth: Texture,
    image: Image,
) -> Signatures {
    let [width, height] = image.size;
    let pixels = u64::from(width) * u64::from(height) * 4;
    let slots = u64::from(layout.slots.max(1)) * 4;
    let sums = Signatures {
        by_pixel: g.buffer("signatures", BufferDesc::new(pixels).zeroed()),
        by_slot: g.buffer("samples", BufferDesc::new(slots).zeroed()),
    };
    let early = image.samples > 1 && Counting::Atomics.lacking(gpu, image.samples).is_none();
    let (kind, test) = match early {
        true => (PipelineKind::SignatureEarly, DepthTest::Early { depth }),
        false => {
            let scratch = TextureDesc::new(width, height, DEPTH_FORMAT).samples(image.samples);
            let scratch = scratch.cleared(Clear::Depth(0.0));
            let scratch = g.texture("scratch depth", scratch);
            (
                PipelineKind::Signature,
                DepthTest::InShader { depth, scratch },
            )
        }
    };
    let spec = pass_spec(gpu, layout, kind, image.samples);
    passes::signature_pass(g, &spec, inputs, draws, test, sums)
}

/// Reads what a frame has drawn, in one go.
async fn read(gpu: &Gpu, built: &Built) -> Result<IdBuffer, StageError> {
    let none = || StageError::Input("an oracle that returned no image".to_owned());
    let [width, height] = built.owners.image.size.map(u64::from);
    let slots = u64::from(built.layout.slots.max(1));
    let sums = built.sums.map(|sums| {
        [
            (sums.by_pixel, width * height * 4),
            (sums.by_slot, slots * 4),
        ]
    });
    let drawn = built.owners.copies().chain(sums.into_iter().flatten());
    // A plan's buffers may be larger than what was asked for.
    let slices = drawn
        .map(|(buffer, bytes)| Some(built.plan.buffer(buffer)?.slice(..bytes)))
        .collect::<Option<Vec<_>>>();
    let bytes = read_back::slices_async(gpu, &slices.ok_or_else(none)?).await?;
    let mut image = IdBuffer::default();
    let rest = built.owners.read(&bytes, &mut image);
    if built.sums.is_some() {
        let by_pixel = (width * height * 4) as usize;
        let (signatures, samples) = rest.split_at_checked(by_pixel).ok_or_else(none)?;
        image.transparent = Some(TransparentSums {
            signatures: bytemuck::pod_collect_to_vec(signatures),
            samples: bytemuck::pod_collect_to_vec(samples),
        });
    }
    Ok(image)
}
