//! The same without the host: compute nodes keep, of all candidates, what owned a pixel last frame, then what their tests find.
//!
//! Beyond Mansa et al. 2007, whose host waits for every answer. Who owns a pixel is read off entity ids written beside the colour, which is exact where
//! a query around a mesh depends on the order of drawing. (Drawing last frame's visible first on the GPU alone: Haar and Aaltonen, *GPU-Driven
//! Rendering Pipelines*, 2015.)

use std::sync::Arc;

use antumbra_draw::passes::{self, DepthTest, IndirectDraws};
use antumbra_draw::{IDENTITY_FORMAT, MeshDetail, PipelineKind};
use antumbra_graph::{Bind, Buffer, Clear, Host, TextureDesc};
use antumbra_shaders::jobs;

use super::CoherentSettings;
use super::schedule::Turns;
use antumbra_cull::indirect::{IndirectLayout, LayoutSize, SampleBounds};
use antumbra_cull::order::back_to_front;
use antumbra_cull::{
    CULL, Candidates, CountLayout, Counting, Counts, FrameGraph, Queried, ViewNodes, VisibleSet,
    query_detail,
};

/// An eye, and how many pixels each slot owns in it: last frame for the first eye, this frame for those after it.
pub(super) struct Eye {
    pub set: VisibleSet,
    pub owned: Buffer,
}

/// The first eye.
pub(super) fn first(g: &mut FrameGraph<'_>, view: &mut ViewNodes, how: CoherentSettings) -> Eye {
    let candidates = g.in_frustum(view);
    let [width, height] = view.size();
    let blank = Clear::Colour(wgpu::Color::TRANSPARENT);
    let ids = g.graph().texture(
        view.named("entity ids"),
        TextureDesc::new(width, height, IDENTITY_FORMAT).cleared(blank),
    );
    let owned = g.sample_counts(view);
    let seen = owned.previous();
    let all = solid(g, view, "last visible", candidates, true);
    let last = g.compact(view, "last visible", all, seen);
    let ids = g.shade_identified(view, "shade last visible", last, ids);
    let found = test(g, view, candidates, how, seen);
    let rest = solid(g, view, "found visible", candidates, false);
    let new = g.compact(view, "found visible", rest, found);
    let ids = g.shade_identified(view, "shade found visible", new, ids);
    shade_blended(g, view, candidates, found);
    let owned = g.histogram(view, ids, [width, height], owned);
    Eye {
        set: verdicts(g, view, candidates, seen, found),
        owned,
    }
}

/// An eye after it: draws what owns a pixel in the first one and tests all else.
pub(super) fn next(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    how: CoherentSettings,
    owned: Buffer,
) -> VisibleSet {
    let candidates = g.in_frustum(view);
    let all = solid(g, view, "seen by the other eye", candidates, true);
    let lent = g.compact(view, "seen by the other eye", all, owned);
    g.shade_indirect(view, "shade what the other eye sees", lent);
    let found = test(g, view, candidates, how, owned);
    let rest = solid(g, view, "found visible", candidates, false);
    let new = g.compact(view, "found visible", rest, found);
    g.shade_indirect(view, "shade found visible", new);
    shade_blended(g, view, candidates, found);
    verdicts(g, view, candidates, owned, found)
}

/// Lays the full meshes of the solid candidates out, to be kept with any sample; `exempt`: those that no test may judge are among them, and drawn.
fn solid(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    name: &str,
    candidates: Host<Candidates>,
    exempt: bool,
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
                !table.is_transparent(*slot) && (exempt || !candidates.is_exempt(*slot))
            };
            let members = candidates.inside().iter().copied().filter(wanted);
            laid.list.fill(table, members, MeshDetail::Level(0));
            laid.bound(
                table,
                |_| SampleBounds::SEEN,
                |slot| candidates.is_exempt(slot),
            );
            Ok(())
        },
    )
}

/// Counts the samples of the stand-ins of what was not seen, against what was drawn.
fn test(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
    how: CoherentSettings,
    seen: Buffer,
) -> Buffer {
    // Each batch by boxes, by meshes, or both.
    let most = g.scene_layout().batches * 2;
    let mut turns = Turns::default();
    let layout = g.lay_out(
        view,
        "last occluded",
        LayoutSize {
            runs: most,
            entries_a_slot: 1,
        },
        |node| {
            node.read(candidates);
        },
        move |ctx, table, frame, laid| {
            let candidates = ctx.get(candidates)?;
            turns.begin(table, &candidates);
            let due = |slot: &u32| turns.is_due(*slot, how.fraction) || table.is_transparent(*slot);
            let mut tests: Vec<(u32, bool, u32)> = candidates
                .testable()
                .filter(due)
                .map(|slot| {
                    let boxed = query_detail(table, frame, slot) == MeshDetail::Box;
                    (table.batch_of(slot), boxed, slot)
                })
                .collect();
            tests.sort_unstable();
            laid.list.clear();
            for (_, boxed, slot) in tests {
                let detail = match boxed {
                    true => MeshDetail::Box,
                    false => MeshDetail::Level(0),
                };
                laid.list.push(table, slot, detail);
            }
            laid.bound(table, |_| SampleBounds::HIDDEN, |_| false);
            Ok(())
        },
    );
    let tests = g.compact(view, "last occluded", layout, seen);
    count(g, view, tests)
}

/// Counts the visible samples of what was kept.
fn count(g: &mut FrameGraph<'_>, view: &ViewNodes, what: IndirectDraws) -> Buffer {
    let (inputs, depth) = (view.inputs(), view.targets.depth);
    let way = Counting::by_fragments(g.gpu());
    let test = g.depth_test(way, depth, view.named("scratch depth"), view.size());
    let kind = match test {
        DepthTest::Early { .. } => PipelineKind::CountAtomic,
        DepthTest::InShader { .. } => PipelineKind::CountCompare,
    };
    let counts = g.sample_counts(view);
    let spec = g.pass(view.named("test last occluded"), CULL, kind);
    passes::count_indirect_pass(g.graph(), &spec, inputs, what, test, counts)
}

/// Shades what is blended and was found visible.
fn shade_blended(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    candidates: Host<Candidates>,
    found: Buffer,
) {
    if !g.scene_layout().transparent {
        return;
    }
    let most = g.scene_layout().slots.max(1);
    let name = "transparent candidates";
    let layout = g.lay_out(
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
            let blended = |slot: &u32| table.is_transparent(*slot);
            let members = candidates.inside().iter().copied().filter(blended);
            back_to_front(laid.list, table, frame, members.map(|slot| (slot, 0)));
            laid.bound(
                table,
                |_| SampleBounds::SEEN,
                |slot| candidates.is_exempt(slot),
            );
            Ok(())
        },
    );
    let kept = g.compact(view, "visible transparent set", layout, found);
    g.shade_indirect(view, "transparent", kept);
}

/// What was drawn, for whoever measures: what was seen, and what was found.
fn verdicts(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
    seen: Buffer,
    found: Buffer,
) -> VisibleSet {
    let asked = g.graph().host::<Queried>(view.named("asked"));
    let mut node = g.graph().host_node(view.named("note asked"));
    node.group(CULL).read(candidates);
    let asked = node.write(asked);
    node.run(move |ctx| {
        let candidates = ctx.get(candidates)?;
        *ctx.get_mut(asked)? = Queried {
            stamp: candidates.stamp(),
            slots: Arc::new(candidates.inside().to_vec()),
            ends: Arc::default(),
        };
        Ok(())
    });
    let counts = Counts {
        buffer: join(g, view, seen, found),
        layout: CountLayout::BySlot,
        queried: asked,
    };
    VisibleSet::on_gpu(candidates, counts, 0)
}

/// The larger of two counts a slot.
fn join(g: &mut FrameGraph<'_>, view: &ViewNodes, one: Buffer, other: Buffer) -> Buffer {
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
        // In rows of at most what a dimension may have.
        let wide = groups.min(65_535);
        pipeline.dispatch(ctx, &binds, [wide, groups.div_ceil(wide)])
    });
    joined
}
