//! The on-gpu way: a compute node keeps the visible of each batch and writes its indirect draw. Neither stall nor delay.

use antumbra_draw::passes::{self, Indirect, Submitted};
use antumbra_draw::{Detail, DrawList, INDIRECT_DRAW_BYTES, SceneTable};
use antumbra_graph::{Bind, Buffer, BufferDesc, Host};
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};

use crate::candidates::{Asked, Candidates};
use crate::counting::{ComputePipeline, Counts};
use crate::frame_graph::{CULL, DRAW, FrameGraph};
use crate::order::back_to_front;
use crate::samples::CountLayout;
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
    padding_a: u32,
    padding_b: u32,
    padding_c: u32,
}

/// Mirrors `Settings` of `compact.wgsl` and `scatter.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct GpuSettings {
    threshold: u32,
    batches: u32,
    padding_a: u32,
    padding_b: u32,
}

assert_layout!(GpuRun, "compact", "Batch", { first, count, index_count, first_index, base_vertex, padding_a, padding_b, padding_c });
assert_layout!(GpuSettings, "compact", "Settings", { threshold, batches, padding_a, padding_b });

/// Marks a candidate that is drawn whatever its count.
const FORCED: u32 = 0x8000_0000;

/// Candidates laid out for the compaction.
#[derive(Debug, Clone, Copy)]
struct Layout {
    list: Host<DrawList>,
    entries: Buffer,
    runs: Buffer,
    settings: Buffer,
    /// Runs there is room for.
    most: u32,
}

impl FrameGraph<'_> {
    pub(crate) fn visible_on_gpu(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        threshold: u32,
    ) -> VisibleSet {
        let by_slot = match counts.layout {
            CountLayout::BySlot => counts.buffer,
            CountLayout::ByQuery => self.scatter(view, counts),
        };
        let among = (candidates, counts.asked);
        let solid = self.layout(view, "candidates", among, threshold, false);
        let solid = self.compact(view, "visible set", solid, by_slot);
        self.shade_indirect(view, "shaded", solid);
        if self.topology().transparent {
            let blended = self.layout(view, "transparent candidates", among, threshold, true);
            let blended = self.compact(view, "visible transparent set", blended, by_slot);
            self.shade_indirect(view, "transparent", blended);
        }
        VisibleSet {
            verdicts: VerdictSource::Gpu {
                candidates,
                asked: counts.asked,
                counts: by_slot,
                layout: CountLayout::BySlot,
                threshold,
            },
        }
    }

    /// Lays the full meshes of the candidates out: the list, and for the GPU its entries and runs.
    fn layout(
        &mut self,
        view: &ViewNodes,
        name: &str,
        (candidates, asked): (Host<Candidates>, Host<Asked>),
        threshold: u32,
        transparent: bool,
    ) -> Layout {
        let inputs = view.inputs();
        let Submitted { list, ids: entries } = self.unsubmitted(&view.named(name));
        // Back to front, neighbours seldom share a batch: as many runs as slots at worst.
        let most = if transparent {
            self.topology().slots.max(1)
        } else {
            self.topology().batches
        };
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
        node.group(CULL)
            .read(inputs.scene)
            .read(inputs.view)
            .read(candidates)
            .read(asked);
        let layout = Layout {
            list: node.write(list),
            entries: node.upload(entries),
            runs: node.upload(runs),
            settings: node.upload(settings),
            most,
        };
        node.run(move |ctx| {
            let (scene, candidates) = (ctx.get(inputs.scene)?, ctx.get(candidates)?);
            let table = &scene.table;
            let unasked = unasked(&candidates, &*ctx.get(asked)?);
            let members = candidates
                .inside()
                .iter()
                .copied()
                .filter(|slot| table.is_transparent(*slot) == transparent);
            let mut list = ctx.get_mut(layout.list)?;
            if transparent {
                back_to_front(&mut list, table, &*ctx.get(inputs.view)?, members);
            } else {
                list.fill(table, members, Detail::Level(0));
            }
            let entries: Vec<u32> = list
                .ids()
                .iter()
                .map(|slot| {
                    if candidates.is_near(*slot) || unasked.binary_search(slot).is_ok() {
                        slot | FORCED
                    } else {
                        *slot
                    }
                })
                .collect();
            let runs: Vec<GpuRun> = list.runs().iter().map(|run| gpu_run(table, run)).collect();
            let settings = GpuSettings {
                threshold,
                batches: runs.len() as u32,
                padding_a: 0,
                padding_b: 0,
            };
            ctx.upload(layout.entries, 0, bytemuck::cast_slice(&entries))?;
            ctx.upload(layout.runs, 0, bytemuck::cast_slice(&runs))?;
            ctx.upload(layout.settings, 0, bytemuck::bytes_of(&settings))?;
            Ok(())
        });
        layout
    }

    fn compact(
        &mut self,
        view: &ViewNodes,
        name: &str,
        layout: Layout,
        counts: Buffer,
    ) -> Indirect {
        let pipeline =
            ComputePipeline::new(self.gpu(), &antumbra_shaders::jobs::compact::JOB, "compact");
        let bytes = self.slot_bytes();
        let ids = self.graph().buffer(
            view.named(&format!("{name}: kept slots")),
            BufferDesc::new(bytes),
        );
        let draws = self.graph().buffer(
            view.named(&format!("{name}: draws")),
            BufferDesc::new(u64::from(layout.most) * INDIRECT_DRAW_BYTES),
        );
        let mut node = self.graph().compute(view.named(&format!("compact {name}")));
        node.group(CULL).read(layout.list).uniform(layout.settings);
        node.storage_read(layout.runs)
            .storage_read(layout.entries)
            .storage_read(counts);
        let (ids, draws) = (node.storage_write(ids), node.storage_write(draws));
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
                Bind::Buffer(4, ids),
                Bind::Buffer(5, draws),
            ];
            let group = ctx.bind_group(0, &pipeline.layout, &binds)?;
            let pass = ctx.pass();
            pass.set_pipeline(&pipeline.pipeline);
            pass.set_bind_group(0, &group, &[]);
            // A workgroup a run, in rows of at most what a dimension may have.
            let wide = runs.min(65_535);
            pass.dispatch_workgroups(wide, runs.div_ceil(wide), 1);
            Ok(())
        });
        Indirect {
            layout: layout.list,
            ids,
            draws,
        }
    }

    fn shade_indirect(&mut self, view: &mut ViewNodes, name: &str, what: Indirect) {
        let kind = self.shaded_kind();
        let spec = self.pass(view.named(name), DRAW, kind);
        let (targets, inputs) = (view.targets, view.inputs());
        let (colour, depth) = passes::shaded_indirect_pass(
            self.graph(),
            &spec,
            inputs,
            what,
            targets.colour,
            targets.depth,
        );
        view.targets.colour = colour;
        view.targets.depth = depth;
    }

    /// Brings the answers of hardware queries into the order of slots.
    fn scatter(&mut self, view: &ViewNodes, counts: Counts) -> Buffer {
        let pipeline =
            ComputePipeline::new(self.gpu(), &antumbra_shaders::jobs::scatter::JOB, "scatter");
        let bytes = self.slot_bytes();
        let asked = self
            .graph()
            .buffer(view.named("asked slots"), BufferDesc::new(bytes));
        let settings = self.graph().buffer(
            view.named("asked: settings"),
            BufferDesc::new(size_of::<GpuSettings>() as u64),
        );
        let mut node = self.graph().host_node(view.named("submit asked"));
        node.group(CULL).read(counts.asked);
        let (asked, settings) = (node.upload(asked), node.upload(settings));
        node.run(move |ctx| {
            let slots = ctx.get(counts.asked)?;
            // The first word is the number of queries in this shader's settings.
            let number = GpuSettings {
                threshold: slots.slots.len() as u32,
                batches: 0,
                padding_a: 0,
                padding_b: 0,
            };
            ctx.upload(asked, 0, bytemuck::cast_slice(&slots.slots))?;
            ctx.upload(settings, 0, bytemuck::bytes_of(&number))?;
            Ok(())
        });
        let by_slot = self.sample_counts(view);
        let mut node = self.graph().compute(view.named("scatter answers"));
        node.group(CULL)
            .read(counts.asked)
            .uniform(settings)
            .storage_read(asked)
            .storage_read(counts.buffer);
        let by_slot = node.storage_write(by_slot);
        node.run(move |ctx| {
            let groups = (ctx.get(counts.asked)?.slots.len() as u32).div_ceil(64);
            if groups == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, settings),
                Bind::Buffer(1, asked),
                Bind::Buffer(2, counts.buffer),
                Bind::Buffer(3, by_slot),
            ];
            let group = ctx.bind_group(0, &pipeline.layout, &binds)?;
            let pass = ctx.pass();
            pass.set_pipeline(&pipeline.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(groups, 1, 1);
            Ok(())
        });
        by_slot
    }
}

/// Candidates nobody asked about, ascending: they are drawn. Most strategies ask about all.
fn unasked(candidates: &Candidates, asked: &Asked) -> Vec<u32> {
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

fn gpu_run(table: &SceneTable, run: &antumbra_draw::Run) -> GpuRun {
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
        padding_a: 0,
        padding_b: 0,
        padding_c: 0,
    }
}
