//! The on-gpu way: a compute node keeps the visible of each batch and writes its indirect draw. Neither stall nor delay.

use antumbra_draw::passes::{self, IdentifiedTargets, IndirectDraws};
use antumbra_draw::{
    DrawList, INDIRECT_DRAW_BYTES, MeshDetail, PipelineKind, Run, SceneTable, ViewFrame,
};
use antumbra_graph::{
    Bind, BodyError, Buffer, BufferDesc, Host, HostBuilder, HostContext, Texture,
};
use antumbra_shaders::{assert_layout, jobs};
use bytemuck::{Pod, Zeroable};

use crate::adaptive_threshold::AdaptiveThreshold;
use crate::candidates::{Candidates, Queried};
use crate::counting::Counts;
use crate::frame_graph::{CULL, DRAW, FrameGraph};
use crate::order::back_to_front;
use crate::samples::{Allowance, CountLayout, SampleRule};
use crate::strategy::{VerdictSource, VisibleSet};
use crate::view_nodes::ViewNodes;

/// Mirrors `Batch` of `compact.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuRun {
    first: u32,
    count: u32,
    index_count: u32,
    first_index: u32,
    base_vertex: i32,
    over: u32,
    most: u32,
    hidden: u32,
}

/// Mirrors `Settings` of `compact.wgsl` and `scatter.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuSettings {
    count: u32,
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

assert_layout!(GpuRun, "compact", "Batch", { first, count, index_count, first_index, base_vertex, over, most, hidden });
assert_layout!(GpuSettings, "compact", "Settings", { count, padding_a, padding_b, padding_c });

/// Marks a candidate that is drawn whatever its count.
const FORCED: u32 = 0x8000_0000;
/// Marks a candidate that is not drawn whatever its count: it is in another run.
const BARRED: u32 = 0x4000_0000;

impl GpuSettings {
    fn counting(count: usize) -> Self {
        Self {
            count: count as u32,
            padding_a: 0,
            padding_b: 0,
            padding_c: 0,
        }
    }
}

/// The visible samples that keep an entity in a run: more than `over`, at most `most`; or, where it is to be hidden, none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleBounds {
    /// More than this.
    pub over: u32,
    /// At most this.
    pub most: u32,
    /// None at all, whatever the other two say.
    pub hidden: bool,
}

impl SampleBounds {
    /// Any sample.
    pub const SEEN: Self = Self {
        over: 0,
        most: u32::MAX,
        hidden: false,
    };
    /// No sample.
    pub const HIDDEN: Self = Self {
        hidden: true,
        ..Self::SEEN
    };
}

/// Candidates laid out for the compaction.
#[derive(Debug, Clone, Copy)]
pub struct IndirectLayout {
    list: Host<DrawList>,
    entries: Buffer,
    runs: Buffer,
    settings: Buffer,
    /// Runs there is room for.
    most: u32,
    /// Bytes of `entries`, and of what is kept of them.
    entry_bytes: u64,
}

/// What a layout is made of: the list, its entries with their marks, its runs with their bounds.
pub struct LayoutEntries<'a> {
    /// The list to fill.
    pub list: &'a mut DrawList,
    entries: Vec<u32>,
    runs: Vec<GpuRun>,
}

impl LayoutEntries<'_> {
    /// Once the list is filled: gives each run its bounds, and marks what is drawn whatever its count.
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
    pub(crate) fn visible_on_gpu(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        (rule, within): (SampleRule, Allowance),
    ) -> VisibleSet {
        let by_slot = match counts.layout {
            CountLayout::BySlot => counts.buffer,
            CountLayout::ByQuery => self.scatter(view, counts),
        };
        let adapted = within
            .allows()
            .then(|| self.adaptive_threshold(view, candidates, by_slot, (rule, within)));
        let among = (candidates, counts.queried);
        let solid = self.layout(view, "candidates", among, rule, false);
        let solid = self.compact_above(view, "visible set", solid, by_slot, adapted);
        self.shade_indirect(view, "shaded", solid);
        if self.scene_layout().transparent {
            let blended = self.layout(view, "transparent candidates", among, rule, true);
            let name = "visible transparent set";
            let blended = self.compact_above(view, name, blended, by_slot, adapted);
            self.shade_indirect(view, "transparent", blended);
        }
        VerdictSource::Gpu {
            candidates,
            asked: counts.queried,
            counts: by_slot,
            layout: CountLayout::BySlot,
            rule,
            adapted,
        }
        .into()
    }

    /// Lays the full meshes of the candidates out: the list, and for the GPU its entries and runs.
    fn layout(
        &mut self,
        view: &ViewNodes,
        name: &str,
        (candidates, asked): (Host<Candidates>, Host<Queried>),
        rule: SampleRule,
        transparent: bool,
    ) -> IndirectLayout {
        // Back to front, neighbours seldom share a batch: as many runs as slots at worst.
        let levels = if rule.coarser > 0 && !transparent {
            SampleRule::LEVELS
        } else {
            1
        };
        let most = if transparent {
            self.scene_layout().slots.max(1)
        } else {
            self.scene_layout().batches * u32::from(levels)
        };
        self.lay_out(
            view,
            name,
            (most, u64::from(levels)),
            |node| {
                node.read(candidates).read(asked);
            },
            move |ctx, table, frame, laid| {
                let candidates = ctx.get(candidates)?;
                let unasked = unasked(&candidates, &*ctx.get(asked)?);
                let members = candidates
                    .inside()
                    .iter()
                    .copied()
                    .filter(|slot| table.is_transparent(*slot) == transparent);
                if transparent {
                    let draw = members.map(|slot| (slot, 0));
                    back_to_front(laid.list, table, frame, draw);
                } else if levels > 1 {
                    // Each level of a batch is a run of its own, with all that may come to it; the counts decide to which.
                    let every = members.flat_map(|slot| {
                        let own = table.levels_of(slot).min(levels);
                        (0..own).map(move |level| (slot, level))
                    });
                    laid.list.fill_levels(table, every, levels);
                } else {
                    laid.list.fill(table, members, MeshDetail::Level(0));
                }
                let forced =
                    |slot: u32| candidates.is_exempt(slot) || unasked.binary_search(&slot).is_ok();
                laid.bound(table, |run| earns(table, run, rule, levels), forced);
                Ok(())
            },
        )
    }

    /// A host node that lays a list out for the compaction: up to `most` runs, and as many entries as slots times `times`.
    pub fn lay_out(
        &mut self,
        view: &ViewNodes,
        name: &str,
        (most, times): (u32, u64),
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
        let list = self.graph().host::<DrawList>(view.named(name));
        let entry_bytes = self.slot_bytes() * times;
        let entries = self.graph().buffer(
            view.named(&format!("{name}: slots")),
            BufferDesc::new(entry_bytes),
        );
        let run_bytes = u64::from(most) * size_of::<GpuRun>() as u64;
        let runs = self.graph().buffer(
            view.named(&format!("{name}: runs")),
            BufferDesc::new(run_bytes),
        );
        let settings = self.graph().buffer(
            view.named(&format!("{name}: settings")),
            BufferDesc::new(size_of::<GpuSettings>() as u64),
        );
        let mut node = self
            .graph()
            .host_node(view.named(&format!("lay out {name}")));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        reads(&mut node);
        let layout = IndirectLayout {
            list: node.write(list),
            entries: node.upload(entries),
            runs: node.upload(runs),
            settings: node.upload(settings),
            most,
            entry_bytes,
        };
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let mut list = ctx.get_mut(layout.list)?;
            let mut laid = LayoutEntries {
                list: &mut list,
                entries: Vec::new(),
                runs: Vec::new(),
            };
            fill(ctx, &scene.table, &frame, &mut laid)?;
            let LayoutEntries { entries, runs, .. } = laid;
            let settings = GpuSettings::counting(runs.len());
            ctx.upload(layout.entries, 0, bytemuck::cast_slice(&entries))?;
            ctx.upload(layout.runs, 0, bytemuck::cast_slice(&runs))?;
            ctx.upload(layout.settings, 0, bytemuck::bytes_of(&settings))?;
            Ok(())
        });
        layout
    }

    /// Keeps of a layout what its counts of visible samples, a u32 a slot, earn, and writes an indirect draw a run.
    pub fn compact(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        counts: Buffer,
    ) -> IndirectDraws {
        self.compact_above(view, name, layout, counts, None)
    }

    /// The same with a threshold that the GPU found this frame, beyond the runs' bounds.
    fn compact_above(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: IndirectLayout,
        counts: Buffer,
        adapted: Option<AdaptiveThreshold>,
    ) -> IndirectDraws {
        let pipeline = self.compute_pipeline(&jobs::compact::JOB, "compact");
        let slots = self.graph().buffer(
            view.named(&format!("{name}: kept slots")),
            BufferDesc::new(layout.entry_bytes),
        );
        let draws = self.graph().buffer(
            view.named(&format!("{name}: draws")),
            BufferDesc::new(u64::from(layout.most) * INDIRECT_DRAW_BYTES),
        );
        let mut node = self.graph().compute(view.named(&format!("compact {name}")));
        node.group(CULL)
            .read(layout.list)
            .storage_read(layout.settings);
        node.storage_read(layout.runs)
            .storage_read(layout.entries)
            .storage_read(counts);
        // Words that hold no threshold.
        let adapted = adapted.map_or(layout.settings, |adapted| adapted.buffer);
        if adapted != layout.settings {
            node.storage_read(adapted);
        }
        let (slots, draws) = (node.storage_write(slots), node.storage_write(draws));
        node.run(move |ctx| {
            let runs = ctx.get(layout.list)?.runs().len() as u32;
            if runs == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, layout.settings),
                Bind::Buffer(1, layout.runs),
                Bind::Buffer(2, layout.entries),
                Bind::Buffer(3, counts),
                Bind::Buffer(4, slots),
                Bind::Buffer(5, draws),
                Bind::Buffer(6, adapted),
            ];
            // A workgroup a run, in rows of at most what a dimension may have.
            let wide = runs.min(65_535);
            pipeline.dispatch(ctx, &binds, [wide, runs.div_ceil(wide)])
        });
        IndirectDraws {
            layout: layout.list,
            slots,
            draws,
        }
    }

    /// Shades what was kept.
    pub fn shade_indirect(&mut self, view: &mut ViewNodes, name: &str, what: IndirectDraws) {
        self.shade_kept(view, name, what, self.shaded_kind(), None);
    }

    /// Shades what was kept, with the entities' ids beside the colour.
    pub fn shade_identified(
        &mut self,
        view: &mut ViewNodes,
        name: &str,
        what: IndirectDraws,
        ids: Texture,
    ) -> Texture {
        let kind = self.shaded_kind().identified();
        self.shade_kept(view, name, what, kind, Some(ids))
            .unwrap_or(ids)
    }

    fn shade_kept(
        &mut self,
        view: &mut ViewNodes,
        name: &str,
        what: IndirectDraws,
        kind: PipelineKind,
        ids: Option<Texture>,
    ) -> Option<Texture> {
        let spec = self.pass(view.named(name), DRAW, kind);
        let targets = IdentifiedTargets {
            targets: view.targets,
            ids,
        };
        let out = passes::shaded_indirect_pass(self.graph(), &spec, view.inputs(), what, targets);
        view.targets = out.targets;
        out.ids
    }

    /// Brings the answers of hardware queries into the order of slots.
    fn scatter(&mut self, view: &ViewNodes, counts: Counts) -> Buffer {
        let pipeline = self.compute_pipeline(&jobs::scatter::JOB, "scatter");
        let bytes = self.slot_bytes();
        let asked = self
            .graph()
            .buffer(view.named("asked slots"), BufferDesc::new(bytes));
        let settings = self.graph().buffer(
            view.named("asked: settings"),
            BufferDesc::new(size_of::<GpuSettings>() as u64),
        );
        let mut node = self.graph().host_node(view.named("submit asked"));
        node.group(CULL).read(counts.queried);
        let (asked, settings) = (node.upload(asked), node.upload(settings));
        node.run(move |ctx| {
            let slots = ctx.get(counts.queried)?;
            let number = GpuSettings::counting(slots.slots.len());
            ctx.upload(asked, 0, bytemuck::cast_slice(&slots.slots))?;
            ctx.upload(settings, 0, bytemuck::bytes_of(&number))?;
            Ok(())
        });
        let by_slot = self.sample_counts(view);
        let mut node = self.graph().compute(view.named("scatter answers"));
        node.group(CULL)
            .read(counts.queried)
            .storage_read(settings)
            .storage_read(asked)
            .storage_read(counts.buffer);
        let by_slot = node.storage_write(by_slot);
        node.run(move |ctx| {
            let groups = (ctx.get(counts.queried)?.slots.len() as u32).div_ceil(64);
            if groups == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, settings),
                Bind::Buffer(1, asked),
                Bind::Buffer(2, counts.buffer),
                Bind::Buffer(3, by_slot),
            ];
            pipeline.dispatch(ctx, &binds, [groups, 1])
        });
        by_slot
    }
}

/// Candidates nobody asked about, ascending: they are drawn. Most strategies ask about all.
pub(crate) fn unasked(candidates: &Candidates, asked: &Queried) -> Vec<u32> {
    if asked.slots.len() >= candidates.inside().len() {
        return Vec::new();
    }
    let mut known = asked.slots.to_vec();
    known.sort_unstable();
    let inside = candidates.inside().iter().copied();
    inside
        .filter(|slot| known.binary_search(slot).is_err())
        .collect()
}

/// The visible samples that bring an entity into a run of a list of so many levels.
fn earns(table: &SceneTable, run: &Run, rule: SampleRule, levels: u8) -> SampleBounds {
    let MeshDetail::Level(level) = run.detail else {
        return SampleBounds {
            over: rule.threshold,
            ..SampleBounds::SEEN
        };
    };
    let has_coarser = level + 1 < table.batch_levels(run.batch).min(levels);
    let over = if has_coarser { rule.most(level + 1) } else { 0 };
    SampleBounds {
        over: over.max(rule.threshold),
        most: rule.most(level),
        hidden: false,
    }
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
