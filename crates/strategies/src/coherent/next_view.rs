//! A view after the first, on the host: draws what the first view shows, and tests all other entities. It needs neither an order nor a fraction, and
//! no query for what it draws at first.
//!
//! Mansa et al. 2007, section 3.2.

use antumbra_graph::Host;

use super::memory::{Answers, QuerySubject, Visibility};
use super::queried_list::{ListSource, QueriedList, Sharing, submit_unqueried};
use super::settings::CoherentSettings;
use super::single_view::{DrawnAnswers, ViewState};
use crate::transparent::{submit_transparent, transparent_list};
use antumbra_cull::order::by_nearest_corner;
use antumbra_cull::{CULL, CountLayout, FrameGraph, Verdict, Verdicts, ViewNodes};

/// Declares a view after `first` that waits twice: for the answers about what the first view drew, which serve both views, and for the answers
/// of its own tests. With [`DrawnAnswers::ReadElsewhere`] an earlier view has read the former, and they are in the memory.
pub(super) fn same_frame(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    settings: CoherentSettings,
    first: &mut ViewState,
    drawn_answers: DrawnAnswers,
) -> Host<Verdicts> {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let lent = g.unsubmitted(&view.named("seen by the other eye"));
    let tests = QueriedList::declare(g, view, "not seen by the other eye");
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("reuse"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    let drawn: Vec<QueriedList> = match drawn_answers {
        DrawnAnswers::ReadHere => [Some(first.drawn), first.found]
            .into_iter()
            .flatten()
            .collect(),
        DrawnAnswers::ReadElsewhere => Vec::new(),
    };
    for list in &drawn {
        list.read_back(&mut node);
    }
    let memory = node.write(first.memory);
    first.memory = memory;
    let verdicts = node.write(verdicts);
    let lent = lent.written_by(&mut node);
    let tests = tests.written_by(&mut node);
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        for list in &drawn {
            let queried = ctx.get(list.queried)?;
            let answers = Answers {
                queried: &queried,
                bytes: ctx.bytes(list.answers)?,
                subject: QuerySubject::DrawnMeshes,
            };
            memory.take(table, queried.stamp.cuts, answers);
        }
        let mut verdicts = ctx.get_mut(verdicts)?;
        verdicts.reset_outside(table);
        for slot in candidates.inside() {
            let verdict = match candidates.is_exempt(*slot) {
                true => Verdict::Untested,
                // Until its test says otherwise.
                false => Verdict::Occluded,
            };
            verdicts.set(*slot, verdict);
        }
        let opaque = |slot: &u32| !table.is_transparent(*slot);
        let mut lent_slots: Vec<u32> = candidates
            .testable()
            .filter(|slot| memory.visibility(*slot) == Visibility::Visible && opaque(slot))
            .collect();
        by_nearest_corner(&mut lent_slots, table, &frame);
        for slot in &lent_slots {
            verdicts.set(*slot, Verdict::Visible);
        }
        let exempt = candidates.exempt().iter().copied().filter(opaque);
        submit_unqueried(ctx, lent, table, exempt.chain(lent_slots))?;
        let tested = candidates
            .testable()
            .filter(|slot| !verdicts.get(*slot).draws());
        let source = ListSource {
            table,
            view: &frame,
            stamp: candidates.stamp(),
        };
        let sharing = Sharing {
            most: settings.together,
            allowed: |slot| memory.may_share_query_of_next_view(slot),
        };
        tests.submit_tests(ctx, source, tested, sharing)?;
        Ok(())
    });
    g.shade_list(view, "shade what the other eye sees", lent);
    let tests = tests.test(g, view, "test what the other eye does not see");

    let found = g.unsubmitted(&view.named("found visible"));
    let transparent = transparent_list(g, view);
    let mut node = g.graph().host_node(view.named("collect"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    tests.read_back(&mut node);
    let memory = node.write(memory);
    first.memory = memory;
    let verdicts = node.write(verdicts);
    let found = found.written_by(&mut node);
    let transparent = transparent.map(|list| list.written_by(&mut node));
    node.run(move |ctx| {
        let (scene, frame, queried) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(tests.queried)?,
        );
        let table = &scene.table;
        let (mut memory, mut verdicts) = (ctx.get_mut(memory)?, ctx.get_mut(verdicts)?);
        let mut found_slots = Vec::new();
        let bytes = ctx.bytes(tests.answers)?;
        for (slot, _, seen) in CountLayout::ByQuery.answers(&queried, bytes) {
            memory.take_next_view_test(slot, seen);
            if seen {
                verdicts.set(slot, Verdict::Visible);
                found_slots.push(slot);
            }
        }
        verdicts.add_tested(queried.queries());
        found_slots.retain(|slot| !table.is_transparent(*slot));
        by_nearest_corner(&mut found_slots, table, &frame);
        submit_unqueried(ctx, found, table, found_slots.into_iter())?;
        submit_transparent(ctx, transparent, table, &frame, &verdicts)
    });
    g.shade_list(view, "shade found visible", found);
    if let Some(transparent) = transparent {
        g.shade_list(view, "transparent", transparent);
    }
    verdicts
}
