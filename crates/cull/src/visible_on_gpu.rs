//! From counts to a visible set on the GPU: compute nodes keep the visible entities of each batch and write its indirect draws. Neither a stall nor a delay.

use antumbra_graph::{Bind, Buffer, BufferDesc, Host};
use antumbra_shaders::jobs;

use crate::candidates::{Candidates, Queried};
use crate::count_layout::CountLayout;
use crate::counting::Counts;
use crate::draw_source::Run;
use crate::entities::{MeshDetail, SceneTable};
use crate::frame_graph::{CULL, FrameGraph};
use crate::indirect::{GpuSettings, IndirectLayout, LayoutSize, SampleBounds, untested};
use crate::order::back_to_front;
use crate::sample_rule::{SampleRule, Selection};
use crate::strategy::{SetVerdicts, VerdictSource, VisibleSet};
use crate::view_nodes::ViewNodes;

/// Candidates, and those of them that were tested.
#[derive(Debug, Clone, Copy)]
struct Tested {
    candidates: Host<Candidates>,
    queried: Host<Queried>,
}

/// Which of the entities a layout is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Solid,
    /// Blended entities, back to front.
    Blended,
}

impl FrameGraph<'_> {
    /// Shades what a compute node selects by this frame's counts.
    pub(crate) fn visible_on_gpu(
        &mut self,
        view: &mut ViewNodes,
        candidates: Host<Candidates>,
        counts: Counts,
        selection: Selection,
    ) -> VisibleSet {
        let by_slot = match counts.layout {
            CountLayout::BySlot => counts.buffer,
            CountLayout::ByQuery => self.scatter(view, counts),
        };
        let rule = selection.rule;
        let adapted = selection
            .allowance
            .allows()
            .then(|| self.adaptive_threshold(view, candidates, by_slot, selection));
        let tested = Tested {
            candidates,
            queried: counts.queried,
        };
        let solid = self.layout(view, "candidates", tested, rule, Part::Solid);
        let solid = self.compact_above(view, "visible set", solid, by_slot, adapted);
        self.shade_indirect(view, "shaded", solid);
        if self.scene_layout().transparent {
            let blended = self.layout(view, "transparent candidates", tested, rule, Part::Blended);
            let name = "visible transparent set";
            let blended = self.compact_above(view, name, blended, by_slot, adapted);
            self.shade_indirect(view, "transparent", blended);
        }
        VerdictSource::Gpu {
            candidates,
            queried: counts.queried,
            counts: by_slot,
            layout: CountLayout::BySlot,
            rule,
            adapted,
        }
        .into()
    }

    /// What a set's verdicts follow from, on the host as far as an audit needs it there.
    pub(crate) fn said_of(&mut self, view: &mut ViewNodes, set: &VisibleSet) -> VerdictSource {
        match set.verdicts {
            SetVerdicts::FromNodes(source) => source,
            SetVerdicts::DrawnBySlot(drawn) => {
                let candidates = self.in_frustum(view);
                let counts = self.all_queried(view, candidates, drawn);
                VerdictSource::by_counts(candidates, counts, 0.into())
            }
        }
    }

    /// Counts by slot of all candidates: what was tested is all of them.
    pub fn all_queried(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        counts: Buffer,
    ) -> Counts {
        let queried = self.graph().host::<Queried>(view.named("queried slots"));
        let mut node = self.graph().host_node(view.named("list queried slots"));
        node.group(CULL).read(candidates);
        let queried = node.write(queried);
        node.run(move |ctx| {
            *ctx.get_mut(queried)? = Queried::all(&*ctx.get(candidates)?);
            Ok(())
        });
        Counts {
            buffer: counts,
            layout: CountLayout::BySlot,
            queried,
        }
    }

    /// Lays out the full meshes of the candidates.
    fn layout(
        &mut self,
        view: &ViewNodes,
        name: &str,
        Tested {
            candidates,
            queried,
        }: Tested,
        rule: SampleRule,
        part: Part,
    ) -> IndirectLayout {
        let blended = part == Part::Blended;
        let levels = match rule.coarser > 0 && !blended {
            true => SampleRule::LEVELS,
            false => 1,
        };
        let runs = match part {
            Part::Solid => self.scene_layout().batches * u32::from(levels),
            // Back to front, neighbours seldom share a batch: as many runs as slots at worst.
            Part::Blended => self.scene_layout().slots.max(1),
        };
        let size = LayoutSize {
            runs,
            entries_a_slot: u64::from(levels),
        };
        self.lay_out(
            view,
            name,
            size,
            |node| {
                node.read(candidates).read(queried);
            },
            move |ctx, table, frame, laid| {
                let candidates = ctx.get(candidates)?;
                let untested = untested(&candidates, &*ctx.get(queried)?);
                let members = candidates
                    .inside()
                    .iter()
                    .copied()
                    .filter(|slot| table.is_transparent(*slot) == blended);
                if blended {
                    let draw = members.map(|slot| (slot, 0));
                    back_to_front(laid.list, table, frame, draw);
                } else if levels > 1 {
                    // Each level of a batch is a run of its own that holds every entity of the batch; the counts decide which run keeps an entity.
                    let every = members.flat_map(|slot| {
                        let own = table.levels_of(slot).min(levels);
                        (0..own).map(move |level| (slot, level))
                    });
                    laid.list.fill_levels(table, every, levels);
                } else {
                    laid.list.fill(table, members, MeshDetail::Level(0));
                }
                let forced =
                    |slot: u32| candidates.is_exempt(slot) || untested.binary_search(&slot).is_ok();
                laid.bound(table, |run| kept_by(table, run, rule, levels), forced);
                Ok(())
            },
        )
    }

    /// Copies the answers of hardware queries into a buffer by slot.
    fn scatter(&mut self, view: &ViewNodes, counts: Counts) -> Buffer {
        let pipeline = self.compute_pipeline(&jobs::scatter::JOB, "scatter");
        let bytes = self.slot_bytes();
        let queried = self
            .graph()
            .buffer(view.named("queried slots"), BufferDesc::new(bytes));
        let settings = self.graph().buffer(
            view.named("queried slots: settings"),
            BufferDesc::new(size_of::<GpuSettings>() as u64),
        );
        let mut node = self.graph().host_node(view.named("submit queried slots"));
        node.group(CULL).read(counts.queried);
        let (queried, settings) = (node.upload(queried), node.upload(settings));
        node.run(move |ctx| {
            let slots = ctx.get(counts.queried)?;
            let number = GpuSettings::counting(slots.slots.len());
            ctx.upload(queried, 0, bytemuck::cast_slice(&slots.slots))?;
            ctx.upload(settings, 0, bytemuck::bytes_of(&number))?;
            Ok(())
        });
        let by_slot = self.sample_counts(view);
        let mut node = self.graph().compute(view.named("scatter query results"));
        node.group(CULL)
            .read(counts.queried)
            .storage_read(settings)
            .storage_read(queried)
            .storage_read(counts.buffer);
        let by_slot = node.storage_write(by_slot);
        node.run(move |ctx| {
            let groups = (ctx.get(counts.queried)?.slots.len() as u32).div_ceil(64);
            if groups == 0 {
                return Ok(());
            }
            let binds = [
                Bind::Buffer(0, settings),
                Bind::Buffer(1, queried),
                Bind::Buffer(2, counts.buffer),
                Bind::Buffer(3, by_slot),
            ];
            pipeline.dispatch(ctx, &binds, [groups, 1])
        });
        by_slot
    }
}

/// The visible samples with which a run of a list keeps an entity; `levels` is the number of levels of detail in the list.
fn kept_by(table: &SceneTable, run: &Run, rule: SampleRule, levels: u8) -> SampleBounds {
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
