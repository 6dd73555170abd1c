//! Leaves out of the patches' entities what cannot show: a compute node holds the box of each against the finished depth of the pixels it
//! covers, and writes the draws of the rest.

use antumbra_draw::INDIRECT_DRAW_BYTES;
use antumbra_draw::patches::{GpuPatchEntry, PatchDraws, PatchList};
use antumbra_graph::{Bind, Buffer, BufferDesc, Host, Texture};
use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use super::AUDIT;
use super::nodes::Looked;
use crate::adaptive_threshold::AdaptiveThreshold;
use crate::frame_graph::FrameGraph;
use crate::view_nodes::ViewNodes;

/// Mirrors `Settings` of `cull_patches.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuSettings {
    count: u32,
    threshold: u32,
    padding_a: u32,
    padding_b: u32,
}

assert_layout!(GpuSettings, "cull_patches", "Settings", { count, threshold, padding_a, padding_b });

impl GpuSettings {
    /// For so many entries; who has more visible samples than the threshold is drawn already.
    pub fn new(count: usize, threshold: u32) -> Self {
        Self {
            count: count as u32,
            threshold,
            padding_a: 0,
            padding_b: 0,
        }
    }
}

/// Bytes of an entry, and of what is kept of it.
pub(super) const ENTRY_BYTES: u64 = size_of::<GpuPatchEntry>() as u64;
const KEPT_BYTES: u64 = 8;
/// Entries a workgroup.
const LANES: u32 = 64;
/// The most entries that one row of workgroups holds.
pub(super) const MOST_ENTRIES: u64 = 65_535 * LANES as u64;

/// What the host has listed, on the GPU.
#[derive(Debug, Clone, Copy)]
pub(super) struct Listed {
    pub looked: Host<Looked>,
    pub list: Host<PatchList>,
    pub settings: Buffer,
    pub entries: Buffer,
    /// Draws of no instance yet.
    pub draws: Buffer,
    /// Visible samples by slot, or words of zero.
    pub counts: Buffer,
    /// The threshold they are held against, where it is not that of the settings.
    pub adapted: Option<AdaptiveThreshold>,
}

/// Bytes of the draws of so many entries.
pub(super) fn draw_bytes(entries: u64) -> u64 {
    entries * INDIRECT_DRAW_BYTES
}

impl FrameGraph<'_> {
    /// Keeps what may show, and notes how many indices that is in what is kept of each patch.
    pub(super) fn sift(
        &mut self,
        view: &ViewNodes,
        listed: Listed,
        (depth, shown): (Texture, Buffer),
        entries: u64,
    ) -> (PatchDraws, Buffer) {
        let pipeline = self.compute_pipeline(&jobs::cull_patches::JOB, "cull_patches");
        let kept = self.graph().buffer(
            view.named("audit: kept"),
            BufferDesc::new(entries * KEPT_BYTES),
        );
        let mut node = self.graph().compute(view.named("audit: sift"));
        node.group(AUDIT)
            .read(listed.looked)
            .read(listed.list)
            .storage_read(listed.settings)
            .storage_read(listed.entries)
            .storage_read(listed.counts)
            .sample(depth);
        let adapted = listed.adapted.map(|adapted| adapted.buffer);
        if let Some(adapted) = adapted {
            node.storage_read(adapted);
        }
        node.only_if(move |host| {
            // A value that cannot be read is the body's to complain of.
            let something = host.get(listed.list).map_or(true, |list| !list.is_empty());
            // What a adapted threshold left out is noted though there is nothing to sift.
            let notes = host
                .get(listed.looked)
                .map_or(true, |looked| looked.at_all());
            something || adapted.is_some() && notes
        });
        let kept = node.storage_write(kept);
        let draws = node.storage_write(listed.draws);
        let shown = node.storage_write(shown);
        node.run(move |ctx| {
            let entries = ctx.get(listed.list)?.entries().len() as u32;
            let binds = [
                Bind::Buffer(0, listed.settings),
                Bind::Buffer(1, listed.entries),
                Bind::Buffer(2, listed.counts),
                Bind::Texture(3, depth),
                Bind::Buffer(4, kept),
                Bind::Buffer(5, draws),
                Bind::Buffer(6, shown),
                Bind::Buffer(7, adapted.unwrap_or(listed.settings)),
            ];
            pipeline.dispatch(ctx, &binds, [entries.div_ceil(LANES).max(1), 1])
        });
        let sifted = PatchDraws {
            list: listed.list,
            kept,
            draws,
        };
        (sifted, shown)
    }
}
