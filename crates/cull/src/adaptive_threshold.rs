//! A threshold for sets that are chosen on the GPU, as high as an allowance lets it be: by this frame's own counts, which no host has seen.

use antumbra_graph::{Bind, Buffer, BufferDesc, Host};
use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use crate::candidates::Candidates;
use crate::frame_graph::{CULL, FrameGraph};
use crate::samples::{Allowance, SampleRule};
use crate::view_nodes::ViewNodes;

/// A frame's threshold, on the GPU.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AdaptiveThreshold {
    /// [`GpuThreshold`].
    pub buffer: Buffer,
    /// What the frame was allowed.
    pub allowed: Host<Allowed>,
}

/// Visible samples that a frame may leave out, and pixels of the image they are counted in.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Allowed {
    pub samples: u64,
    pub pixels: u32,
}

/// Mirrors `AdaptedThreshold` of `shared/threshold.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct GpuThreshold {
    padding_a: u32,
    pub threshold: u32,
    left_out: u32,
    padding_b: u32,
}

/// Mirrors `Settings` of `adapt_threshold.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuSettings {
    count: u32,
    allowed: u32,
    least: u32,
    padding: u32,
}

assert_layout!(GpuThreshold, "adapt_threshold", "AdaptedThreshold", { padding_a, threshold, left_out, padding_b });
assert_layout!(GpuSettings, "adapt_threshold", "Settings", { count, allowed, least, padding });

impl FrameGraph<'_> {
    /// Finds each frame's threshold from its counts, by slot: the rule's, or as high a one as an allowance lets it be.
    pub(crate) fn adaptive_threshold(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        counts: Buffer,
        (rule, within): (SampleRule, Allowance),
    ) -> AdaptiveThreshold {
        let pipeline = self.compute_pipeline(&jobs::adapt_threshold::JOB, "adapt_threshold");
        let bytes = self.slot_bytes();
        let mut buffer = |name: &str, bytes| {
            let name = view.named(name);
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let judged = buffer("judged slots", bytes);
        let settings = buffer("allowance", size_of::<GpuSettings>() as u64);
        let threshold = buffer("threshold", size_of::<GpuThreshold>() as u64);
        let allowed = self.graph().host::<Allowed>(view.named("allowed"));
        let mut node = self.graph().host_node(view.named("submit judged"));
        node.group(CULL).read(candidates);
        let allowed = node.write(allowed);
        let (judged, settings) = (node.upload(judged), node.upload(settings));
        node.run(move |ctx| {
            let candidates = ctx.get(candidates)?;
            let inside = candidates.inside().iter().copied();
            let slots: Vec<u32> = inside.filter(|slot| !candidates.is_exempt(*slot)).collect();
            let now = Allowed {
                samples: within.samples(),
                pixels: within.pixels,
            };
            let numbers = GpuSettings {
                count: slots.len() as u32,
                allowed: now.samples.try_into().unwrap_or(u32::MAX),
                least: rule.threshold,
                padding: 0,
            };
            ctx.upload(judged, 0, bytemuck::cast_slice(&slots))?;
            ctx.upload(settings, 0, bytemuck::bytes_of(&numbers))?;
            *ctx.get_mut(allowed)? = now;
            Ok(())
        });
        let mut node = self.graph().compute(view.named("turn threshold"));
        node.group(CULL)
            .storage_read(settings)
            .storage_read(judged)
            .storage_read(counts);
        let threshold = node.storage_write(threshold);
        node.run(move |ctx| {
            let binds = [
                Bind::Buffer(0, settings),
                Bind::Buffer(1, judged),
                Bind::Buffer(2, counts),
                Bind::Buffer(3, threshold),
            ];
            pipeline.dispatch(ctx, &binds, [1, 1])
        });
        AdaptiveThreshold {
            buffer: threshold,
            allowed,
        }
    }
}
