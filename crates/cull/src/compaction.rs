//! Stream compaction: keeps the entries of a layout that have enough visible samples, in order, and writes the indirect draw of each run.
//!
//! Reduce, then scan (Blelloch, *Prefix Sums and Their Applications*, 1990): three dispatches, however many entries there are, and no workgroup waits for another.

use antumbra_graph::{Bind, Buffer, BufferDesc};
use antumbra_shaders::jobs;

use crate::adaptive_threshold::AdaptiveThreshold;
use crate::compute_pipeline::rows_of;
use crate::draw_source::{INDIRECT_DRAW_BYTES, IndirectDraws};
use crate::frame_graph::{CULL, FrameGraph};
use crate::indirect::IndirectLayout;
use crate::self_test::Capability;
use crate::view_nodes::ViewNodes;

/// Entries that a thread decides on, as in `compact.wgsl`.
pub(crate) const ENTRIES_A_THREAD: u32 = 8;
/// Threads of a workgroup, likewise.
pub(crate) const THREADS: u32 = 64;
/// Entries of a block: what a workgroup decides on.
pub(crate) const BLOCK: u32 = ENTRIES_A_THREAD * THREADS;

/// What the three dispatches hand to each other.
#[derive(Debug, Clone, Copy)]
struct Marked {
    marks: Buffer,
    blocks: Buffer,
}

impl FrameGraph<'_> {
    /// Adds compute nodes that keep the entries of a layout whose counts of visible samples (a u32 a slot) are within their run's bounds, and write one indirect draw a
    /// run. A run that keeps nothing draws zero instances.
    pub fn compact(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        counts: Buffer,
    ) -> IndirectDraws {
        self.compact_above(view, name, layout, counts, None)
    }

    /// The same, with a threshold that the GPU found for this frame in addition to the runs' bounds.
    pub(crate) fn compact_above(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        counts: Buffer,
        adapted: Option<AdaptiveThreshold>,
    ) -> IndirectDraws {
        self.relies_on(Capability::Compaction);
        let marked = self.mark(view, name, layout, counts, adapted);
        let marked = self.scan(view, name, layout, marked);
        self.gather(view, name, layout, marked)
    }

    /// Which entries are kept, and how many of each block.
    fn mark(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        counts: Buffer,
        adapted: Option<AdaptiveThreshold>,
    ) -> Marked {
        let pipeline = self.compute_pipeline(&jobs::compact::JOB, "mark");
        let entries = layout.entry_bytes / 4;
        let mut words = |part: &str, entries_a_word: u32| {
            let bytes = entries.div_ceil(u64::from(entries_a_word)).max(1) * 4;
            let name = view.named(&format!("{name}: {part}"));
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let (marks, blocks) = (words("marks", ENTRIES_A_THREAD), words("blocks", BLOCK));
        let mut node = self.graph().compute(view.named(&format!("mark {name}")));
        node.group(CULL)
            .read(layout.list)
            .storage_read(layout.settings)
            .storage_read(layout.runs)
            .storage_read(layout.entries)
            .storage_read(counts);
        // Without an adaptive threshold the binding is filled by another buffer, whose word there is 0.
        let adapted = adapted.map_or(layout.settings, |adapted| adapted.buffer);
        if adapted != layout.settings {
            node.storage_read(adapted);
        }
        let marked = Marked {
            marks: node.storage_write(marks),
            blocks: node.storage_write(blocks),
        };
        node.run(move |ctx| {
            let entries = ctx.get(layout.list)?.slots().len() as u32;
            if entries == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, layout.settings),
                Bind::Buffer(1, layout.runs),
                Bind::Buffer(2, layout.entries),
                Bind::Buffer(3, counts),
                Bind::Buffer(6, adapted),
                Bind::Buffer(7, marked.marks),
                Bind::Buffer(8, marked.blocks),
            ];
            pipeline.dispatch(ctx, &binds, rows_of(entries.div_ceil(BLOCK)))
        });
        marked
    }

    /// How many entries are kept before each block.
    fn scan(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        marked: Marked,
    ) -> Marked {
        let pipeline = self.compute_pipeline(&jobs::compact::JOB, "scan");
        let mut node = self.graph().compute(view.named(&format!("scan {name}")));
        node.group(CULL)
            .read(layout.list)
            .storage_read(layout.settings);
        let blocks = node.storage_write(marked.blocks);
        node.run(move |ctx| {
            if ctx.get(layout.list)?.is_empty() {
                return Ok(());
            }
            let binds = [Bind::Buffer(0, layout.settings), Bind::Buffer(8, blocks)];
            pipeline.dispatch(ctx, &binds, [1, 1])
        });
        Marked { blocks, ..marked }
    }

    /// Puts what is kept in its place, and writes the draws.
    fn gather(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        Marked { marks, blocks }: Marked,
    ) -> IndirectDraws {
        let pipeline = self.compute_pipeline(&jobs::compact::JOB, "gather");
        let mut buffer = |part: &str, bytes| {
            let name = view.named(&format!("{name}: {part}"));
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let slots = buffer("kept slots", layout.entry_bytes);
        let draws = u64::from(layout.most_runs) * INDIRECT_DRAW_BYTES;
        let draws = buffer("draws", draws);
        let mut node = self.graph().compute(view.named(&format!("compact {name}")));
        node.group(CULL)
            .read(layout.list)
            .storage_read(layout.settings)
            .storage_read(layout.runs)
            .storage_read(layout.entries)
            .storage_read(marks)
            .storage_read(blocks);
        let (slots, draws) = (node.storage_write(slots), node.storage_write(draws));
        node.run(move |ctx| {
            let list = ctx.get(layout.list)?;
            let (runs, entries) = (list.runs().len() as u32, list.slots().len() as u32);
            if runs == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, layout.settings),
                Bind::Buffer(1, layout.runs),
                Bind::Buffer(2, layout.entries),
                Bind::Buffer(4, slots),
                Bind::Buffer(5, draws),
                Bind::Buffer(7, marks),
                Bind::Buffer(8, blocks),
            ];
            let threads = entries.div_ceil(ENTRIES_A_THREAD).max(runs);
            pipeline.dispatch(ctx, &binds, rows_of(threads.div_ceil(THREADS)))
        });
        IndirectDraws {
            layout: layout.list,
            slots,
            draws,
        }
    }
}
