//! Drops entities of the patches that cannot show: a compute node tests the box of each against the finished depth of the pixels that it covers, and
//! writes the draws of the rest.

use antumbra_graph::{Bind, Buffer, BufferDesc, Host, Texture};
use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use super::AUDIT;
use super::audited_frame::AuditedFrame;
use crate::adaptive_threshold::AdaptiveThreshold;
use crate::draw_source::INDIRECT_DRAW_BYTES;
use crate::draw_source::patches::{GpuPatchEntry, PatchDraws, PatchList};
use crate::frame_graph::FrameGraph;
use crate::view_nodes::ViewNodes;

/// Mirrors `Settings` of `cull_patches.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuSettings {
    count: u32,
    threshold: u32,
    padding_a: u32,
    samples: u32,
}

assert_layout!(GpuSettings, "cull_patches_one", "Settings", { count, threshold, padding_a, samples });

impl GpuSettings {
    /// For `count` entries and so many samples a pixel. An entity with more visible samples than the threshold is drawn already.
    pub fn new(count: usize, threshold: u32, samples: u32) -> Self {
        Self {
            count: count as u32,
            threshold,
            padding_a: 0,
            samples,
        }
    }
}

/// Bytes of an entry, and of a kept entry.
pub(super) const ENTRY_BYTES: u64 = size_of::<GpuPatchEntry>() as u64;
const KEPT_BYTES: u64 = 8;
/// Entries a workgroup.
const LANES: u32 = 64;
/// The most entries that one row of workgroups holds.
pub(super) const MOST_ENTRIES: u64 = 65_535 * LANES as u64;

/// What the host lists for the patches, on the GPU.
#[derive(Debug, Clone, Copy)]
pub(super) struct PatchBuffers {
    pub frame: Host<AuditedFrame>,
    pub list: Host<PatchList>,
    pub settings: Buffer,
    pub entries: Buffer,
    /// Draws with no instances yet.
    pub draws: Buffer,
    /// Visible samples by slot, or zeroes.
    pub counts: Buffer,
    /// The threshold for them, where it is found on the GPU.
    pub adapted: Option<AdaptiveThreshold>,
}

/// What is left after the test.
pub(super) struct DepthCulled {
    /// The draws of the kept entries.
    pub draws: PatchDraws,
    /// The marks, with the indices of each patch added.
    pub shown: Buffer,
}

/// Bytes of the draws of this many entries.
pub(super) fn draw_bytes(entries: u64) -> u64 {
    entries * INDIRECT_DRAW_BYTES
}

impl FrameGraph<'_> {
    /// Keeps the entries that may show, and adds up the indices of each patch.
    pub(super) fn depth_cull(
        &mut self,
        view: &ViewNodes,
        buffers: PatchBuffers,
        depth: Texture,
        shown: Buffer,
        entries: u64,
    ) -> DepthCulled {
        let job = match self.samples() {
            1 => &jobs::cull_patches_one::JOB,
            _ => &jobs::cull_patches_many::JOB,
        };
        let pipeline = self.compute_pipeline(job, "cull_patches");
        let kept = self.graph().buffer(
            view.named("audit: kept"),
            BufferDesc::new(entries * KEPT_BYTES),
        );
        let mut node = self
            .graph()
            .compute(view.named("audit: test against depth"));
        node.group(AUDIT)
            .read(buffers.frame)
            .read(buffers.list)
            .storage_read(buffers.settings)
            .storage_read(buffers.entries)
            .storage_read(buffers.counts)
            .sample(depth);
        let adapted = buffers.adapted.map(|adapted| adapted.buffer);
        if let Some(adapted) = adapted {
            node.storage_read(adapted);
        }
        node.only_if(move |host| {
            // The body reports a value that cannot be read.
            let something = host.get(buffers.list).map_or(true, |list| !list.is_empty());
            // What an adaptive threshold left out is noted even without entries.
            let notes = host
                .get(buffers.frame)
                .map_or(true, |frame| frame.is_sampled());
            something || adapted.is_some() && notes
        });
        let kept = node.storage_write(kept);
        let draws = node.storage_write(buffers.draws);
        let shown = node.storage_write(shown);
        node.run(move |ctx| {
            let entries = ctx.get(buffers.list)?.entries().len() as u32;
            let binds = [
                Bind::Buffer(0, buffers.settings),
                Bind::Buffer(1, buffers.entries),
                Bind::Buffer(2, buffers.counts),
                Bind::Texture(3, depth),
                Bind::Buffer(4, kept),
                Bind::Buffer(5, draws),
                Bind::Buffer(6, shown),
                Bind::Buffer(7, adapted.unwrap_or(buffers.settings)),
            ];
            pipeline.dispatch(ctx, &binds, [entries.div_ceil(LANES).max(1), 1])
        });
        DepthCulled {
            draws: PatchDraws {
                list: buffers.list,
                kept,
                draws,
            },
            shown,
        }
    }
}
