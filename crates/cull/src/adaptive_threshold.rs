//! The threshold of a visible set that is chosen on the GPU: as high as an allowance permits, found from this frame's own counts, which stay on the GPU.

use antumbra_graph::{Bind, Buffer, BufferDesc, Host};
use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use crate::candidates::Candidates;
use crate::frame_graph::{CULL, FrameGraph};
use crate::sample_rule::Selection;
use crate::view_nodes::ViewNodes;

/// A frame's threshold on the GPU.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AdaptiveThreshold {
    /// [`GpuThreshold`].
    pub buffer: Buffer,
    /// What the frame may leave out.
    pub allowed: Host<Allowed>,
}

/// Visible samples that a frame may leave out, and samples of the image they are counted in.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Allowed {
    pub samples: u64,
    pub image_samples: u32,
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
    /// Finds each frame's threshold from its counts, which are by slot: the rule's own, or a higher one that keeps within the allowance.
    pub(crate) fn adaptive_threshold(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        counts: Buffer,
        selection: Selection,
    ) -> AdaptiveThreshold {
        let pipeline = self.compute_pipeline(&jobs::adapt_threshold::JOB, "adapt_threshold");
        let bytes = self.slot_bytes();
        let mut buffer = |name: &str, bytes| {
            let name = view.named(name);
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let tested = buffer("tested slots", bytes);
        let settings = buffer("allowance", size_of::<GpuSettings>() as u64);
        let threshold = buffer("threshold", size_of::<GpuThreshold>() as u64);
        let allowed = self.graph().host::<Allowed>(view.named("allowed"));
        let mut node = self.graph().host_node(view.named("submit tested slots"));
        node.group(CULL).read(candidates);
        let allowed = node.write(allowed);
        let (tested, settings) = (node.upload(tested), node.upload(settings));
        node.run(move |ctx| {
            let candidates = ctx.get(candidates)?;
            let inside = candidates.inside().iter().copied();
            let slots: Vec<u32> = inside.filter(|slot| !candidates.is_exempt(*slot)).collect();
            let now = Allowed {
                samples: selection.allowance.samples(),
                image_samples: selection.allowance.image_samples,
            };
            let numbers = GpuSettings {
                count: slots.len() as u32,
                allowed: now.samples.try_into().unwrap_or(u32::MAX),
                least: selection.rule.threshold,
                padding: 0,
            };
            ctx.upload(tested, 0, bytemuck::cast_slice(&slots))?;
            ctx.upload(settings, 0, bytemuck::bytes_of(&numbers))?;
            *ctx.get_mut(allowed)? = now;
            Ok(())
        });
        let mut node = self.graph().compute(view.named("adapt threshold"));
        node.group(CULL)
            .storage_read(settings)
            .storage_read(tested)
            .storage_read(counts);
        let threshold = node.storage_write(threshold);
        node.run(move |ctx| {
            let binds = [
                Bind::Buffer(0, settings),
                Bind::Buffer(1, tested),
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
