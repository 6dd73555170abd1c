//! Coherent culling without the host. Compute nodes first keep the candidates that owned a pixel in the last frame, then those that the tests
//! of this frame find visible.
//!
//! This goes beyond Mansa et al. 2007, where the host waits for every answer. The owner of a pixel is read from entity ids written beside the colour. That is
//! exact, while the answer of a query around a mesh depends on the drawing order. (Drawing the last frame's visible set first, on the GPU alone:
//! Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015.)

use antumbra_cull::indirect::{LayoutSize, SampleBounds};
use antumbra_cull::{
    Candidates, Counting, FrameGraph, IndirectDraws, StageOutput, ViewNodes, VisibleSet,
};
use antumbra_graph::{Buffer, Host};

use super::entity_test::{fill_with_tests, sorted_tests};
use super::schedule::TestSchedule;
use super::settings::CoherentSettings;
use crate::found_on_gpu::{
    ExemptEntities, larger_counts, opaque, shade_found_transparent, verdicts,
};

/// The first view of a stereo pair, or the only view.
pub(super) struct FirstOnGpu {
    pub set: VisibleSet,
    /// The pixels that each slot owns in this frame, a u32 a slot.
    pub owned: Buffer,
}

/// Declares the first view.
pub(super) fn first(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    settings: CoherentSettings,
) -> FirstOnGpu {
    let candidates = g.in_frustum(view);
    let ids = g.id_texture(view.named("entity ids"), view.size());
    let owned = g.sample_counts(view);
    let seen = owned.previous();
    let all = opaque(
        g,
        view,
        "last visible",
        candidates,
        ExemptEntities::Included,
    );
    let last = g.compact(view, "last visible", all, seen);
    let ids = g.shade_identified(view, "shade last visible", last, ids);
    let found = test(g, view, candidates, settings, seen);
    let rest = opaque(
        g,
        view,
        "found visible",
        candidates,
        ExemptEntities::LeftOut,
    );
    let new = g.compact(view, "found visible", rest, found);
    let ids = g.shade_identified(view, "shade found visible", new, ids);
    shade_found_transparent(g, view, candidates, found);
    let owned = g.histogram(view, ids, view.size(), owned);
    FirstOnGpu {
        set: drawn_of(g, view, candidates, seen, found),
        owned,
    }
}

/// Declares a further view: draws the entities that own a pixel in the first view and tests all others. `owned`: their pixels in the first
/// view, a u32 a slot.
pub(super) fn next(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    settings: CoherentSettings,
    owned: Buffer,
) -> VisibleSet {
    let candidates = g.in_frustum(view);
    let all = opaque(
        g,
        view,
        "seen by the other eye",
        candidates,
        ExemptEntities::Included,
    );
    let lent = g.compact(view, "seen by the other eye", all, owned);
    g.shade_indirect(view, "shade what the other eye sees", lent);
    let found = test(g, view, candidates, settings, owned);
    let rest = opaque(
        g,
        view,
        "found visible",
        candidates,
        ExemptEntities::LeftOut,
    );
    let new = g.compact(view, "found visible", rest, found);
    g.shade_indirect(view, "shade found visible", new);
    shade_found_transparent(g, view, candidates, found);
    drawn_of(g, view, candidates, owned, found)
}

/// Tests the entities without a sample in `seen`: counts the visible samples of their test geometry against the depth so far.
fn test(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
    settings: CoherentSettings,
    seen: Buffer,
) -> Buffer {
    // A batch may be tested by boxes, by meshes, or by both.
    let most = g.scene_layout().batches * 2;
    let mut schedule = TestSchedule::default();
    let output = g.output();
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
            schedule.begin(table, &candidates);
            // What is never drawn with an id owns no pixel, so that only a test says whether it is seen.
            let owns_none = |slot: u32| match output {
                StageOutput::Image => table.is_transparent(slot),
                StageOutput::Answers => !table.is_occluder(slot),
            };
            let due = |slot: &u32| schedule.is_due(*slot, settings.fraction) || owns_none(*slot);
            let due = candidates.testable().filter(due);
            let tests = sorted_tests(table, frame, due, |_| false);
            fill_with_tests(laid.list, table, &tests);
            laid.bound(table, |_| SampleBounds::HIDDEN, |_| false);
            Ok(())
        },
    );
    let tests = g.compact(view, "last occluded", layout, seen);
    count(g, view, tests)
}

/// Counts the visible samples of indirect draws, a u32 a slot.
fn count(g: &mut FrameGraph<'_>, view: &ViewNodes, what: IndirectDraws) -> Buffer {
    let (size, depth) = (view.size(), view.targets.depth);
    let way = Counting::by_fragments(g.gpu(), g.samples());
    let test = g.depth_test(way, depth, view.named("scratch depth"), size);
    let counts = g.sample_counts(view);
    g.count(view, "test last occluded", what.into(), test, counts)
}

/// The verdicts: what was seen is drawn, and what was found.
fn drawn_of(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
    seen: Buffer,
    found: Buffer,
) -> VisibleSet {
    let drawn = larger_counts(g, view, seen, found);
    verdicts(g, view, candidates, drawn)
}
