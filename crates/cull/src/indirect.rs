//! Indirect draws: a host node lays candidates out in runs, one a batch, and compute nodes keep those with enough visible samples and write the draw of each
//! run.
//!
//! A strategy of its own uses three steps: [`FrameGraph::lay_out`], [`FrameGraph::compact`] with counts of visible samples by slot, and
//! [`FrameGraph::shade_indirect`].

use antumbra_graph::{BodyError, Buffer, BufferDesc, Host, HostBuilder, HostContext, Texture};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use crate::candidates::{Candidates, Queried};
use crate::draw_source::{DrawList, IndirectDraws, Run};
use crate::entities::{MeshDetail, SceneTable};
use crate::frame_graph::{CULL, FrameGraph};
use crate::renderer::ShadeTargets;
use crate::view::ViewFrame;
use crate::view_nodes::ViewNodes;

/// Mirrors `Batch` of `compact.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct GpuRun {
    pub first: u32,
    pub count: u32,
    pub index_count: u32,
    pub first_index: u32,
    pub base_vertex: i32,
    pub over: u32,
    pub most: u32,
    pub hidden: u32,
}

/// Mirrors `Settings` of `compact.wgsl` and `scatter.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct GpuSettings {
    count: u32,
    padding_a: u32,
    padding_b: u32,
    entries: u32,
}

assert_layout!(GpuRun, "compact", "Batch", { first, count, index_count, first_index, base_vertex, over, most, hidden });
assert_layout!(GpuSettings, "compact", "Settings", { count, padding_a, padding_b, entries });

/// Marks an entry that is kept whatever its count.
pub(crate) const FORCED: u32 = 0x8000_0000;
/// Marks an entry that is never kept: another run keeps the entity.
pub(crate) const BARRED: u32 = 0x4000_0000;

impl GpuSettings {
    pub fn counting(count: usize) -> Self {
        Self::of(count, 0)
    }

    /// So many runs with so many entries.
    pub fn of(count: usize, entries: usize) -> Self {
        Self {
            count: count as u32,
            padding_a: 0,
            padding_b: 0,
            entries: entries as u32,
        }
    }
}

/// The visible samples with which a run keeps an entity: more than `over` and at most `most`, or none at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleBounds {
    /// More than this.
    pub over: u32,
    /// At most this.
    pub most: u32,
    /// Keeps entities without visible samples instead.
    pub hidden: bool,
}

impl SampleBounds {
    /// At least one sample.
    pub const SEEN: Self = Self {
        over: 0,
        most: u32::MAX,
        hidden: false,
    };
    /// No sample at all.
    pub const HIDDEN: Self = Self {
        hidden: true,
        ..Self::SEEN
    };
}

/// How large a layout may get.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LayoutSize {
    /// The most runs: batches for a list in canonical order, slots for one in an order of its own.
    pub runs: u32,
    /// The most entries a slot.
    pub entries_a_slot: u64,
}

/// Candidates that are laid out for [`FrameGraph::compact`].
#[derive(Debug, Clone, Copy)]
pub struct IndirectLayout {
    pub(crate) list: Host<DrawList>,
    pub(crate) entries: Buffer,
    pub(crate) runs: Buffer,
    pub(crate) settings: Buffer,
    /// The number of runs there is room for.
    pub(crate) most_runs: u32,
    /// Bytes of `entries`, and of what is kept of them.
    pub(crate) entry_bytes: u64,
}

/// A layout that is being filled: the list, and for the GPU its entries with their marks and its runs with their bounds.
pub struct LayoutEntries<'a> {
    /// The list to fill.
    pub list: &'a mut DrawList,
    entries: Vec<u32>,
    runs: Vec<GpuRun>,
}

impl<'a> LayoutEntries<'a> {
    pub(crate) fn new(list: &'a mut DrawList) -> Self {
        Self {
            list,
            entries: Vec::new(),
            runs: Vec::new(),
        }
    }

    /// Uploads what was laid out.
    pub(crate) fn upload(
        self,
        ctx: &mut HostContext<'_>,
        layout: IndirectLayout,
    ) -> Result<(), BodyError> {
        let settings = GpuSettings::of(self.runs.len(), self.entries.len());
        ctx.upload(layout.entries, 0, bytemuck::cast_slice(&self.entries))?;
        ctx.upload(layout.runs, 0, bytemuck::cast_slice(&self.runs))?;
        ctx.upload(layout.settings, 0, bytemuck::bytes_of(&settings))?;
        Ok(())
    }
    /// Call this once the list is filled: gives each run its bounds, and marks the entities that are drawn whatever their count (`forced`).
    pub fn bound(
        &mut self,
        table: &SceneTable,
        bounds: impl Fn(&Run) -> SampleBounds,
        forced: impl Fn(u32) -> bool,
    ) {
        self.entries.extend_from_slice(self.list.slots());
        for run in self.list.runs() {
            self.runs.push(gpu_run(table, run, bounds(run)));
            let mark = match run.detail {
                MeshDetail::Level(0) => FORCED,
                _ => BARRED,
            };
            let part = run.first as usize..(run.first + run.count) as usize;
            for entry in self.entries.get_mut(part).unwrap_or_default() {
                if forced(*entry) {
                    *entry |= mark;
                }
            }
        }
    }
}

impl FrameGraph<'_> {
    /// Adds a host node that lays out candidates. `reads` declares what else the node reads; `fill` fills the list and then calls [`LayoutEntries::bound`].
    pub fn lay_out(
        &mut self,
        view: &ViewNodes,
        name: &str,
        size: LayoutSize,
        reads: impl FnOnce(&mut HostBuilder<'_>),
        mut fill: impl FnMut(
            &HostContext<'_>,
            &SceneTable,
            &ViewFrame,
            &mut LayoutEntries<'_>,
        ) -> Result<(), BodyError>
        + Send
        + 'static,
    ) -> IndirectLayout {
        let inputs = view.inputs();
        let undeclared = self.layout_buffers(&view.named(name), size);
        let mut node = self
            .graph()
            .host_node(view.named(&format!("lay out {name}")));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        reads(&mut node);
        let layout = IndirectLayout {
            list: node.write(undeclared.list),
            entries: node.upload(undeclared.entries),
            runs: node.upload(undeclared.runs),
            settings: node.upload(undeclared.settings),
            ..undeclared
        };
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let mut list = ctx.get_mut(layout.list)?;
            let mut laid = LayoutEntries::new(&mut list);
            fill(ctx, &scene.table, &frame, &mut laid)?;
            laid.upload(ctx, layout)
        });
        layout
    }

    /// The list and buffers of a layout, which no node writes yet.
    pub(crate) fn layout_buffers(&mut self, name: &str, size: LayoutSize) -> IndirectLayout {
        let entry_bytes = self.slot_bytes() * size.entries_a_slot;
        let run_bytes = u64::from(size.runs) * size_of::<GpuRun>() as u64;
        let mut buffer = |part: &str, bytes| {
            let name = format!("{name}: {part}");
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        IndirectLayout {
            entries: buffer("slots", entry_bytes),
            runs: buffer("runs", run_bytes),
            settings: buffer("settings", size_of::<GpuSettings>() as u64),
            list: self.graph().host::<DrawList>(name),
            most_runs: size.runs,
            entry_bytes,
        }
    }

    /// Shades the kept entities.
    pub fn shade_indirect(&mut self, view: &mut ViewNodes, name: &str, what: IndirectDraws) {
        self.shade_source(view, name, what.into(), ShadeTargets::from(view.targets));
    }

    /// Shades the kept entities, and writes their ids to a second target.
    pub fn shade_identified(
        &mut self,
        view: &mut ViewNodes,
        name: &str,
        what: IndirectDraws,
        ids: Texture,
    ) -> Texture {
        let into = ShadeTargets {
            ids: Some(ids),
            ..view.targets.into()
        };
        let out = self.shade_source(view, name, what.into(), into);
        out.ids.unwrap_or(ids)
    }
}

/// Candidates that were not tested, ascending: they are drawn. Most strategies test all.
pub(crate) fn untested(candidates: &Candidates, queried: &Queried) -> Vec<u32> {
    if queried.slots.len() >= candidates.inside().len() {
        return Vec::new();
    }
    let mut known = queried.slots.to_vec();
    known.sort_unstable();
    let inside = candidates.inside().iter().copied();
    inside
        .filter(|slot| known.binary_search(slot).is_err())
        .collect()
}

fn gpu_run(table: &SceneTable, run: &Run, bounds: SampleBounds) -> GpuRun {
    let range = table
        .batches()
        .get(run.batch as usize)
        .map(|batch| table.range(batch.mesh, run.detail))
        .unwrap_or_default();
    GpuRun {
        first: run.first,
        count: run.count,
        index_count: range.index_count,
        first_index: range.first_index,
        base_vertex: range.base_vertex,
        over: bounds.over,
        most: bounds.most,
        hidden: u32::from(bounds.hidden),
    }
}
