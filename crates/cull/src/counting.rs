//! Counting visible samples, in four ways that agree with each other.
//!
//! - Hardware queries answer *any sample* or *none*. Each query costs a draw.
//! - Fragment atomics count under a forced early depth test (Vulkan and OpenGL alone).
//! - A depth comparison in the shader counts wherever fragment shaders may write memory.
//! - An entity-id buffer and a histogram count the samples that each entity owns. This needs one geometry pass where the others need two
//!   (after the item buffers of Weghorst, Hooper and Greenberg, *Improved Computational Methods for Ray Tracing*, 1984).

use std::fmt;
use std::str::FromStr;

use antumbra_graph::{Bind, Buffer, BufferDesc, Host, Texture};
use antumbra_shaders::jobs;

use crate::candidates::Queried;
use crate::compute_pipeline::rows_of;
use crate::count_layout::CountLayout;
use crate::device::Gpu;
use crate::draw_source::ListDraws;
use crate::frame_graph::{CULL, FrameGraph};
use crate::proxies::Proxies;
use crate::renderer::{DepthTest, IdTargets};
use crate::self_test::Capability;
use crate::view_nodes::ViewNodes;

/// A way of counting visible samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
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

    /// The faster of the two ways in which fragments count themselves that this device supports; [`Self::Compare`] where it supports neither.
    pub fn by_fragments(gpu: &Gpu, samples: u32) -> Self {
        match Self::Atomics.lacking(gpu, samples) {
            None => Self::Atomics,
            Some(_) => Self::Compare,
        }
    }

    /// What the device lacks for it, with so many samples a pixel; `None` where it is supported.
    pub fn lacking(self, gpu: &Gpu, samples: u32) -> Option<&'static str> {
        let many = samples > 1;
        let flags = gpu.downlevel.flags;
        let writable = flags.contains(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE);
        let compute = flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS);
        let by_sample = flags.contains(wgpu::DownlevelFlags::MULTISAMPLED_SHADING);
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
            Self::Atomics | Self::Compare if many && !by_sample => {
                Some("shaders that run once a sample")
            }
            Self::Identity if !compute => Some("compute shaders"),
            Self::Compare | Self::Identity if many && !gpu.reads_drawn_samples() => {
                Some("shaders that read the samples of what was drawn")
            }
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

/// The ways in which fragments count themselves.
const BY_FRAGMENTS: [Counting; 2] = [Counting::Atomics, Counting::Compare];

/// Counts on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct Counts {
    /// The counts.
    pub buffer: Buffer,
    /// How the buffer is laid out.
    pub layout: CountLayout,
    /// The entities they belong to.
    pub queried: Host<Queried>,
}

impl FrameGraph<'_> {
    /// Draws the occluders' depth and counts the occludees' visible samples in an image of `size` pixels.
    /// [`Counting::Identity`] takes occluders and occludees of the same detail. A way that the driver's self-test found wrong is replaced by fragments that count themselves, in a way that
    /// it found right.
    pub fn count_samples(
        &mut self,
        view: &ViewNodes,
        proxies: Proxies,
        way: Counting,
        size: [u32; 2],
    ) -> Counts {
        let way = self.believed(way, &BY_FRAGMENTS);
        let depth = self.depth_texture(view.named("occluder depth"), size);
        if way == Counting::Identity {
            return self.count_identities(view, proxies, depth, size);
        }
        let depth = self.draw_depth(view, "occluder depth", proxies.occluders, depth);
        if way == Counting::Queries {
            let bytes = self.slot_bytes() * 2;
            let answers = self
                .graph()
                .buffer(view.named("query results"), BufferDesc::new(bytes));
            let buffer = self.query(view, "queries", proxies.occludees, depth, answers);
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

    /// A buffer with one count a slot, zeroed at the start of the frame.
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
        let test = self.depth_test(way, depth, view.named("scratch depth"), size);
        self.count(view, "count samples", what.into(), test, counts)
    }

    /// How fragments are tested against a finished depth of `size` pixels: early for [`Counting::Atomics`], otherwise in the shader, with a scratch depth
    /// buffer named `scratch`. Where the driver's self-test found one of the two wrong and the other right, it is the other.
    pub fn depth_test(
        &mut self,
        way: Counting,
        depth: Texture,
        scratch: String,
        size: [u32; 2],
    ) -> DepthTest {
        let way = match way {
            Counting::Atomics => Counting::Atomics,
            _ => Counting::Compare,
        };
        let way = self.believed(way, &BY_FRAGMENTS);
        self.relies_on(Capability::of(way));
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
        let ids = self.id_texture(view.named("entity ids"), size);
        let targets = IdTargets { ids, depth };
        let targets = self.draw_ids(view, "entity ids", proxies.occluders, targets);
        let IdTargets { ids, depth } = targets;
        let counts = self.sample_counts(view);
        let mut counts = self.histogram(view, ids, size, counts);
        if let Some(others) = proxies.others {
            let way = Counting::by_fragments(self.gpu(), self.samples());
            counts = self.count_against(view, others, way, depth, size, counts);
        }
        Counts {
            buffer: counts,
            layout: CountLayout::BySlot,
            queried: proxies.queried,
        }
    }

    /// Counts the samples of an entity-id texture that each slot owns, and adds them to `counts`.
    pub fn histogram(
        &mut self,
        view: &ViewNodes,
        ids: Texture,
        [width, height]: [u32; 2],
        counts: Buffer,
    ) -> Buffer {
        self.relies_on(Capability::IdHistogram);
        let samples = self.samples();
        let job = match samples {
            1 => &jobs::histogram_one::JOB,
            _ => &jobs::histogram_many::JOB,
        };
        let pipeline = self.compute_pipeline(job, "count");
        let mut node = self.graph().compute(view.named("histogram"));
        node.group(CULL).sample(ids);
        let counts = node.storage_write(counts);
        // As in the shader: a thread takes sixteen pixels of a row, a workgroup has sixty-four threads.
        let groups = (width.div_ceil(16) * height).div_ceil(64);
        node.run(move |ctx| {
            let binds = [Bind::Texture(0, ids), Bind::Buffer(1, counts)];
            let [wide, rows] = rows_of(groups);
            pipeline.dispatch_layers(ctx, &binds, [wide, rows, samples])
        });
        counts
    }
}
