//! The second eye: draws what the first one saw and tests all else. It needs neither order nor fraction, and no query for what it draws.
//!
//! Mansa et al. 2007, section 3.2.

use antumbra_graph::Host;

use super::CoherentSettings;
use super::memory::Known;
use super::queried_list::{Asking, submit_unasked};
use super::single_view::{Eye, blended_list, submit_blended};
use antumbra_cull::order::by_nearest_corner;
use antumbra_cull::{CULL, CountLayout, FrameGraph, Verdict, Verdicts, ViewNodes};

/// An eye after `first`, waiting for its answers: those about what it drew, which it collects for both, and then its own.
/// `collects`: whether they are still to be fetched; a third eye finds them in the memory.
pub(super) fn same_frame(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    how: CoherentSettings,
    first: &mut Eye,
    collects: bool,
) -> Host<Verdicts> {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let seen = g.unsubmitted(&view.named("seen by the other eye"));
    let tests = Asking::declare(g, view, "not seen by the other eye");
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("reuse"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    let answered: Vec<Asking> = [Some(first.drawn), first.found]
        .into_iter()
        .flatten()
        .filter(|_| collects)
        .collect();
    for asking in &answered {
        asking.read_back(&mut node);
    }
    let memory = node.write(first.memory);
    first.memory = memory;
    let verdicts = node.write(verdicts);
    let seen = seen.written_by(&mut node);
    let tests = tests.written_by(&mut node);
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        for asking in &answered {
            let asked = ctx.get(asking.asked)?;
            let answers = (&*asked, CountLayout::ByQuery, ctx.bytes(asking.answers)?);
            let cuts = asked.stamp.cuts;
            memory.take(table, cuts, answers, true);
        }
        let mut verdicts = ctx.get_mut(verdicts)?;
        verdicts.reset_outside(table);
        for slot in candidates.inside() {
            let verdict = match candidates.is_exempt(*slot) {
                true => Verdict::Untested,
                // To be said by its test.
                false => Verdict::Occluded,
            };
            verdicts.set(*slot, verdict);
        }
        let solid = |slot: &u32| !table.is_transparent(*slot);
        let mut lent: Vec<u32> = candidates
            .testable()
            .filter(|slot| memory.known(*slot) == Known::Visible && solid(slot))
            .collect();
        by_nearest_corner(&mut lent, table, &frame);
        for slot in &lent {
            verdicts.set(*slot, Verdict::Visible);
        }
        let exempt = candidates.exempt().iter().copied().filter(solid);
        submit_unasked(ctx, seen, table, exempt.chain(lent))?;
        let asked = candidates
            .testable()
            .filter(|slot| !verdicts.get(*slot).draws());
        let together = (how.together, |slot| memory.settled_there(slot));
        let what = (&**table, &*frame);
        tests.submit_tests(ctx, what, candidates.stamp(), asked, together)?;
        Ok(())
    });
    g.shade_list(view, "shade what the other eye sees", seen);
    let tests = tests.test(g, view, "test what the other eye does not see");

    let found = g.unsubmitted(&view.named("found visible"));
    let blended = blended_list(g, view);
    let mut node = g.graph().host_node(view.named("collect"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    tests.read_back(&mut node);
    let memory = node.write(memory);
    first.memory = memory;
    let verdicts = node.write(verdicts);
    let found = found.written_by(&mut node);
    let blended = blended.map(|list| list.written_by(&mut node));
    node.run(move |ctx| {
        let (scene, frame, asked) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(tests.asked)?,
        );
        let table = &scene.table;
        let (mut memory, mut verdicts) = (ctx.get_mut(memory)?, ctx.get_mut(verdicts)?);
        let mut new = Vec::new();
        for (slot, _, seen) in CountLayout::ByQuery.answers(&asked, ctx.bytes(tests.answers)?) {
            memory.was_tested_there(slot, seen);
            if seen {
                verdicts.set(slot, Verdict::Visible);
                new.push(slot);
            }
        }
        verdicts.add_tested(asked.queries());
        new.retain(|slot| !table.is_transparent(*slot));
        by_nearest_corner(&mut new, table, &frame);
        submit_unasked(ctx, found, table, new.into_iter())?;
        submit_blended(ctx, blended, table, &frame, &verdicts)
    });
    g.shade_list(view, "shade found visible", found);
    if let Some(blended) = blended {
        g.shade_list(view, "transparent", blended);
    }
    verdicts
}
