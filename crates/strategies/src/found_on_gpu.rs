//! The steps of strategies that draw on the GPU alone what was visible first, and then what they find: the layouts of both parts, what is blended, and the verdicts.
//! Counts are a u32 a slot; not 0 is visible.
//!
//! (Drawing the last frame's visible set first: Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015.)

use antumbra_cull::indirect::{IndirectLayout, LayoutSize, SampleBounds};
use antumbra_cull::order::back_to_front;
use antumbra_cull::{CULL, Candidates, FrameGraph, MeshDetail, ViewNodes, VisibleSet, rows_of};
use antumbra_graph::{Bind, Buffer, Host};
use antumbra_shaders::jobs;

/// What a layout does with the candidates that no test may cull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ExemptEntities {
    /// They are laid out, and drawn whatever their counts.
    Included,
    /// They are not laid out: an earlier pass has drawn them.
    LeftOut,
    /// They are laid out as all others: the counts say whether they are drawn.
    Counted,
}

/// Lays out the full meshes of the opaque candidates. The compaction keeps those with any sample.
pub(crate) fn opaque(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    name: &str,
    candidates: Host<Candidates>,
    exempt: ExemptEntities,
) -> IndirectLayout {
    let most = g.scene_layout().batches;
    g.lay_out(
        view,
        name,
        LayoutSize {
            runs: most,
            entries_a_slot: 1,
        },
        |node| {
            node.read(candidates);
        },
        move |ctx, table, _, laid| {
            let candidates = ctx.get(candidates)?;
            let wanted = |slot: &u32| {
                !table.is_transparent(*slot)
                    && (exempt != ExemptEntities::LeftOut || !candidates.is_exempt(*slot))
            };
            let members = candidates.inside().iter().copied().filter(wanted);
            laid.list.fill(table, members, MeshDetail::Level(0));
            laid.bound(
                table,
                |_| SampleBounds::SEEN,
                |slot| exempt == ExemptEntities::Included && candidates.is_exempt(slot),
            );
            Ok(())
        },
    )
}

/// Shades the transparent entities with samples in `found`, and those that no test may cull.
pub(crate) fn shade_found_transparent(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    candidates: Host<Candidates>,
    found: Buffer,
) {
    if g.scene_layout().transparent {
        let layout = transparent(g, view, candidates);
        let kept = g.compact(view, "visible transparent set", layout, found);
        g.shade_indirect(view, "transparent", kept);
    }
}

/// Lays out the transparent candidates, back to front. The compaction keeps those with any sample, and those that no test may cull.
pub(crate) fn transparent(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
) -> IndirectLayout {
    let most = g.scene_layout().slots.max(1);
    let name = "transparent candidates";
    g.lay_out(
        view,
        name,
        LayoutSize {
            runs: most,
            entries_a_slot: 1,
        },
        |node| {
            node.read(candidates);
        },
        move |ctx, table, frame, laid| {
            let candidates = ctx.get(candidates)?;
            let transparent = |slot: &u32| table.is_transparent(*slot);
            let members = candidates.inside().iter().copied().filter(transparent);
            back_to_front(laid.list, table, frame, members.map(|slot| (slot, 0)));
            laid.bound(
                table,
                |_| SampleBounds::SEEN,
                |slot| candidates.is_exempt(slot),
            );
            Ok(())
        },
    )
}

/// The verdicts for measurements: an entity is drawn if it has samples in `drawn`.
pub(crate) fn verdicts(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
    drawn: Buffer,
) -> VisibleSet {
    let counts = g.all_queried(view, candidates, drawn);
    VisibleSet::on_gpu(candidates, counts, 0)
}

/// The larger of two counts, a slot.
pub(crate) fn larger_counts(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    one: Buffer,
    other: Buffer,
) -> Buffer {
    let pipeline = g.compute_pipeline(&jobs::max_counts::JOB, "max_counts");
    let groups = g.scene_layout().slots.div_ceil(64).max(1);
    let joined = g.sample_counts(view);
    let mut node = g.graph().compute(view.named("join counts"));
    node.group(CULL).storage_read(one).storage_read(other);
    let joined = node.storage_write(joined);
    node.run(move |ctx| {
        let binds = [
            Bind::Buffer(0, one),
            Bind::Buffer(1, other),
            Bind::Buffer(2, joined),
        ];
        pipeline.dispatch(ctx, &binds, rows_of(groups))
    });
    joined
}
