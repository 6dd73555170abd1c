//! Counting visible samples: four ways to the same answer.
//!
//! Hardware queries answer *any*, nothing more, and each costs its draw. Fragment atomics count under a forced early depth test. The
//! comparing pass counts wherever fragment shaders may write memory. An entity-id buffer and a histogram count what owns each pixel, and
//! need one geometry pass where the others need two. (A counter an entity from one pass of ids: after the item buffers of
//! Weghorst, Hooper and Greenberg, *Improved Computational Methods for Ray Tracing*, 1984.)

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use antumbra_draw::passes::{self, DepthTest, IdTargets, ListDraws};
use antumbra_draw::{Gpu, IDENTITY_FORMAT, MeshDetail, PipelineKind, SceneTable, ViewFrame};
use antumbra_graph::{Bind, Buffer, BufferDesc, Clear, Host, Texture, TextureDesc};
use antumbra_shaders::jobs;

use crate::candidates::{Candidates, Queried};
use crate::frame_graph::{CULL, FrameGraph};
use crate::order::front_to_back;
use crate::samples::CountLayout;
use crate::view_nodes::ViewNodes;

/// A way of counting visible samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Counting {
    /// A hardware occlusion query an entity: any sample, or none.
    Queries,
    /// Fragment atomics under a forced early depth test.
    Atomics,
    /// A depth compare in the fragment shader.
    Compare,
    /// An entity-id buffer and a compute histogram.
    Identity,
}

impl Counting {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Queries, Self::Atomics, Self::Compare, Self::Identity];

    /// Its word on the command line and in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Queries => "queries",
            Self::Atomics => "atomics",
            Self::Compare => "compare",
            Self::Identity => "identity",
        }
    }

    /// The faster of the two ways in which fragments count themselves, where the device has it.
    pub fn by_fragments(gpu: &Gpu) -> Self {
        match Self::Atomics.lacking(gpu) {
            None => Self::Atomics,
            Some(_) => Self::Compare,
        }
    }

    /// What the device lacks for it, in words.
    pub fn lacking(self, gpu: &Gpu) -> Option<&'static str> {
        let writable = gpu
            .downlevel
            .flags
            .contains(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE);
        let compute = gpu
            .downlevel
            .flags
            .contains(wgpu::DownlevelFlags::COMPUTE_SHADERS);
        match self {
            Self::Queries => None,
            Self::Atomics
                if !gpu
                    .device
                    .features()
                    .contains(wgpu::Features::SHADER_EARLY_DEPTH_TEST) =>
            {
                Some("a forced early depth test")
            }
            Self::Atomics | Self::Compare if !writable => {
                Some("storage writes in fragment shaders")
            }
            Self::Identity if !compute => Some("compute shaders"),
            _ => None,
        }
    }
}

impl fmt::Display for Counting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Counting {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        Self::ALL
            .into_iter()
            .find(|way| way.word() == text)
            .ok_or(())
    }
}

/// The stand-ins of a view's candidates, on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct Proxies {
    /// What may hide others: opaque triangles.
    pub occluders: ListDraws,
    /// What is tested and hides nothing; `None` where the scene has no such entity and both are drawn alike.
    pub others: Option<ListDraws>,
    /// Everything that is tested.
    pub occludees: ListDraws,
    /// What is tested, for whoever reads the answer.
    pub queried: Host<Queried>,
}

/// Where proxies do not stand in for their meshes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProxyLimits {
    /// Nearer by than where they deviate from them by so many pixels of the view's image.
    pub deviation: f64,
    /// Whether what the near plane cuts hides others, as what it is. Not where answers are used a frame late: the eye may have passed through it by then,
    /// and all that it hid is in sight.
    pub cut_hide: bool,
}

impl Default for ProxyLimits {
    /// Everywhere but where the near plane cuts them, and there nothing is hidden.
    fn default() -> Self {
        Self {
            deviation: f64::INFINITY,
            cut_hide: false,
        }
    }
}

/// Which of two details is the full mesh.
const CLOSE: usize = 1;

/// Whether an entity's stand-in may be off by more than so many pixels.
fn deviates(table: &SceneTable, view: &ViewFrame, slot: u32, pixels: f64) -> bool {
    let metres = f64::from(table.deviation(slot));
    // Most strategies take stand-ins as they are, and ask no further.
    metres > 0.0 && pixels.is_finite() && view.pixels_at_most(metres, &table.bounds(slot)) > pixels
}

/// Counts on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct Counts {
    /// The counts.
    pub buffer: Buffer,
    /// How they lie in it.
    pub layout: CountLayout,
    /// What they are about.
    pub queried: Host<Queried>,
}

impl FrameGraph<'_> {
    /// Submits the candidates' stand-ins as occluders and as occludees.
    pub fn proxies(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        occluder: MeshDetail,
        occludee: MeshDetail,
    ) -> Proxies {
        self.proxies_of(view, (candidates, occluder), (candidates, occludee))
    }

    /// Submits stand-ins of some candidates as occluders and of others as occludees. Of the former, only what hides is drawn; each
    /// of them is among the latter.
    pub fn proxies_of(
        &mut self,
        view: &ViewNodes,
        hiding: (Host<Candidates>, MeshDetail),
        candidates: (Host<Candidates>, MeshDetail),
    ) -> Proxies {
        self.proxies_within(view, hiding, candidates, ProxyLimits::default())
    }

    /// The same, with the full mesh in place of a [`MeshDetail::Proxy`] that is too close to stand in.
    pub fn proxies_within(
        &mut self,
        view: &ViewNodes,
        (hiding, occluder): (Host<Candidates>, MeshDetail),
        (candidates, occludee): (Host<Candidates>, MeshDetail),
        close: ProxyLimits,
    ) -> Proxies {
        let inputs = view.inputs();
        let all_hide =
            hiding == candidates && self.scene_layout().classes().all(|class| class.occludes());
        let apart = occluder != occludee || !all_hide;
        let occluders = self.unsubmitted(&view.named("occluders"));
        let others = apart.then(|| self.unsubmitted(&view.named("other occludees")));
        let occludees = apart.then(|| self.unsubmitted(&view.named("occludees")));
        let queried = self.graph().host::<Queried>(view.named("queried"));
        let mut node = self.graph().host_node(view.named("submit proxies"));
        node.group(CULL).read(inputs.scene).read(candidates);
        if hiding != candidates {
            node.read(hiding);
        }
        let occluders = occluders.written_by(&mut node);
        let others = others.map(|list| list.written_by(&mut node));
        let all = occludees.map(|list| list.written_by(&mut node));
        let queried = node.write(queried);
        node.read(inputs.view);
        // Near ones first spares the far ones' fragments. Full meshes keep the canonical order: there, ties must fall as in the reference.
        let sorts = occluder == MeshDetail::Proxy;
        // What is asked about as a box stays one, however close it is.
        let closest = match occludee {
            MeshDetail::Proxy => MeshDetail::Level(0),
            other => other,
        };
        let mut order = Vec::new();
        node.run(move |ctx| {
            let (scene, candidates) = (ctx.get(inputs.scene)?, ctx.get(candidates)?);
            let hiding = ctx.get(hiding)?;
            let table = &scene.table;
            let inside = || candidates.inside().iter().copied();
            let hides = |slot: &u32| table.is_occluder(*slot);
            let mut occluder_list = ctx.get_mut(occluders.list)?;
            let frame = ctx.get(inputs.view)?;
            // Whoever stands between a mesh and its stand-in sees through the one and is blinded by the other: close by, nothing stands in.
            let blinds = |slot: &u32| sorts && !close.cut_hide && hiding.is_near(*slot);
            let closely = |slot: u32| match hiding.is_near(slot) {
                true => CLOSE,
                false => usize::from(deviates(table, &frame, slot, close.deviation)),
            };
            let in_detail = |slot: u32| (slot, closely(slot));
            let hiders = hiding.inside().iter().copied().filter(hides);
            let hiders = hiders.filter(|slot| !blinds(slot));
            if sorts {
                front_to_back(&mut order, table, &frame, hiders);
                let sorted = order.iter().map(|entry| in_detail(*entry as u32));
                occluder_list.fill_mixed(table, sorted, &[occluder, MeshDetail::Level(0)]);
            } else {
                occluder_list.fill(table, hiders, occluder);
            }
            ctx.upload(
                occluders.slots,
                0,
                bytemuck::cast_slice(occluder_list.slots()),
            )?;
            let mut tested = Arc::new(occluder_list.slots().to_vec());
            if let (Some(others), Some(all)) = (others, all) {
                let mut list = ctx.get_mut(others.list)?;
                let rest =
                    inside().filter(|slot| !hides(slot) || blinds(slot) || !hiding.contains(*slot));
                list.fill_mixed(table, rest.map(in_detail), &[occludee, closest]);
                ctx.upload(others.slots, 0, bytemuck::cast_slice(list.slots()))?;
                let mut list = ctx.get_mut(all.list)?;
                list.fill_mixed(table, inside().map(in_detail), &[occludee, closest]);
                ctx.upload(all.slots, 0, bytemuck::cast_slice(list.slots()))?;
                tested = Arc::new(list.slots().to_vec());
            }
            *ctx.get_mut(queried)? = Queried {
                stamp: candidates.stamp(),
                slots: tested,
                ends: Arc::default(),
            };
            Ok(())
        });
        Proxies {
            occluders,
            others,
            occludees: all.unwrap_or(occluders),
            queried,
        }
    }

    /// Draws the occluders' depth and counts the occludees' visible samples in an image of `size` pixels.
    /// [`Counting::Identity`] takes occluders and occludees of the same detail.
    pub fn count_samples(
        &mut self,
        view: &ViewNodes,
        proxies: Proxies,
        way: Counting,
        size: [u32; 2],
    ) -> Counts {
        let inputs = view.inputs();
        let depth = self.depth_texture(view.named("occluder depth"), size);
        if way == Counting::Identity {
            return self.count_identities(view, proxies, depth, size);
        }
        let spec = self.pass(view.named("occluder depth"), CULL, PipelineKind::Depth);
        let depth = passes::depth_pass(self.graph(), &spec, inputs, proxies.occluders, depth);
        if way == Counting::Queries {
            let bytes = self.slot_bytes() * 2;
            let answers = self
                .graph()
                .buffer(view.named("query answers"), BufferDesc::new(bytes));
            let spec = self.pass(view.named("queries"), CULL, PipelineKind::Query);
            let buffer = passes::query_pass(
                self.graph(),
                &spec,
                inputs,
                proxies.occludees,
                depth,
                answers,
            );
            return Counts {
                buffer,
                layout: CountLayout::ByQuery,
                queried: proxies.queried,
            };
        }
        let counts = self.sample_counts(view);
        let buffer = self.count_against(view, proxies.occludees, way, depth, size, counts);
        Counts {
            buffer,
            layout: CountLayout::BySlot,
            queried: proxies.queried,
        }
    }

    /// A count a slot, zero at the start of the frame.
    pub fn sample_counts(&mut self, view: &ViewNodes) -> Buffer {
        let bytes = self.slot_bytes();
        self.graph().buffer(
            view.named("visible samples"),
            BufferDesc::new(bytes).zeroed(),
        )
    }

    fn count_against(
        &mut self,
        view: &ViewNodes,
        what: ListDraws,
        way: Counting,
        depth: Texture,
        size: [u32; 2],
        counts: Buffer,
    ) -> Buffer {
        let inputs = view.inputs();
        let test = self.depth_test(way, depth, view.named("scratch depth"), size);
        let kind = match test {
            DepthTest::Early { .. } => PipelineKind::CountAtomic,
            DepthTest::InShader { .. } => PipelineKind::CountCompare,
        };
        let spec = self.pass(view.named("count samples"), CULL, kind);
        passes::count_pass(self.graph(), &spec, inputs, what, test, counts)
    }

    /// How fragments are held against a finished depth of some size: early for [`Counting::Atomics`], else in the shader, with a scratch depth of
    /// that name.
    pub fn depth_test(
        &mut self,
        way: Counting,
        depth: Texture,
        scratch: String,
        size: [u32; 2],
    ) -> DepthTest {
        match way {
            Counting::Atomics => DepthTest::Early { depth },
            _ => DepthTest::InShader {
                depth,
                scratch: self.depth_texture(scratch, size),
            },
        }
    }

    fn count_identities(
        &mut self,
        view: &ViewNodes,
        proxies: Proxies,
        depth: Texture,
        size: [u32; 2],
    ) -> Counts {
        let [width, height] = size;
        let blank = Clear::Colour(wgpu::Color::TRANSPARENT);
        let ids = self.graph().texture(
            view.named("entity ids"),
            TextureDesc::new(width, height, IDENTITY_FORMAT).cleared(blank),
        );
        let spec = self.pass(view.named("entity ids"), CULL, PipelineKind::Identity);
        let targets = IdTargets { ids, depth };
        let inputs = view.inputs();
        let IdTargets { ids, depth } =
            passes::identity_pass(self.graph(), &spec, inputs, proxies.occluders, targets);
        let counts = self.sample_counts(view);
        let mut counts = self.histogram(view, ids, size, counts);
        if let Some(others) = proxies.others {
            let way = Counting::by_fragments(self.gpu());
            counts = self.count_against(view, others, way, depth, size, counts);
        }
        Counts {
            buffer: counts,
            layout: CountLayout::BySlot,
            queried: proxies.queried,
        }
    }

    /// Adds up how many pixels of an entity-id texture each slot owns.
    pub fn histogram(
        &mut self,
        view: &ViewNodes,
        ids: Texture,
        [width, height]: [u32; 2],
        counts: Buffer,
    ) -> Buffer {
        let pipeline = self.compute_pipeline(&jobs::histogram::JOB, "count");
        let mut node = self.graph().compute(view.named("histogram"));
        node.group(CULL).sample(ids);
        let counts = node.storage_write(counts);
        // As the shader has it: a thread a run of sixteen pixels, sixty-four threads a group.
        let groups = (width.div_ceil(16) * height).div_ceil(64);
        node.run(move |ctx| {
            let binds = [Bind::Texture(0, ids), Bind::Buffer(1, counts)];
            pipeline.dispatch(ctx, &binds, [groups, 1])
        });
        counts
    }
}
