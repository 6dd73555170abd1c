//! One eye: last frame's visible first, each with a query; then a fraction of the occluded against what that left in the depth buffer.
//!
//! Mansa, Amundarain, Elizalde, Garcia-Alonso, Matey, *Towards Adaptive Occlusion Culling Using Camera CoherentSettings*, 2006, as *Occlusion
//! Culling for Stereoscopic Display of Complex Mechanical Sets*, 2007, section 3.1, tells it (OCF). The paper waits for the tests' answers within the
//! frame; the frame-late form uses them in the next one and waits for nothing.

use antumbra_draw::passes::ListDraws;
use antumbra_draw::{MeshDetail, SceneTable, ViewFrame};
use antumbra_graph::{BodyError, Host, HostBuilder, HostContext, ReadBack};

use super::CoherentSettings;
use super::fraction::Fraction;
use super::memory::{Known, Memory};
use super::queried_list::Asking;
use super::screen_distance::Nearness;
use antumbra_cull::order::{back_to_front, by_nearest_corner};
use antumbra_cull::{
    CULL, Candidates, CountLayout, FrameGraph, Queried, Verdict, Verdicts, ViewNodes,
};

/// What another eye may go on from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Eye {
    pub memory: Host<Memory>,
    /// What was visible last, drawn first.
    pub drawn: Asking,
    /// What the tests of this frame found, drawn next; none where answers come late.
    pub found: Option<Asking>,
    pub verdicts: Host<Verdicts>,
}

/// Answers that come a frame late.
#[derive(Debug, Clone, Copy)]
struct Late {
    drawn: ReadBack<Queried>,
    second: ReadBack<Queried>,
    /// Whether the second are those of tests, not of what was drawn.
    tests: bool,
}

/// One eye that waits for the answers of its tests. `collects`: it fetches the answers about what it drew itself, in the next frame; otherwise
/// the next eye does.
pub(super) fn same_frame(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    how: CoherentSettings,
    collects: bool,
) -> Eye {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let memory = g.graph().host::<Memory>(view.named("memory"));
    let (drawn, tests, found) = (
        Asking::declare(g, view, "last visible"),
        Asking::declare(g, view, "last occluded"),
        Asking::declare(g, view, "found visible"),
    );
    let mut node = g.graph().host_node(view.named("recall"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    let late = collects.then(|| collect(&mut node, drawn, found, false));
    let memory = node.updates(memory);
    let (drawn, tests) = (drawn.written_by(&mut node), tests.written_by(&mut node));
    let (mut nearness, mut picked) = (Nearness::default(), Vec::new());
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        take_late(ctx, late, table, &frame, &mut memory);
        memory.begin(table, &candidates, true);
        memory.sort(table, &frame, how.resort);
        Fraction::pick(
            &mut memory,
            table,
            &frame,
            how.share(),
            &mut nearness,
            &mut picked,
        );
        // Against an empty depth buffer nothing is hidden: where nobody is known to be visible, all that is unknown is drawn.
        let begins = memory.visible().is_empty();
        let mut first: Vec<u32> = Vec::new();
        let mut asked: Vec<u32> = Vec::new();
        if begins {
            let solid = memory.unknown().iter().copied();
            first.extend(solid.filter(|slot| !table.is_transparent(*slot)));
            by_nearest_corner(&mut first, table, &frame);
            asked.extend_from_slice(&picked);
        } else {
            asked.extend(
                memory
                    .unknown()
                    .iter()
                    .chain(memory.blended())
                    .chain(&picked),
            );
        }
        let solid = |slot: &u32| !table.is_transparent(*slot);
        let exempt = candidates.exempt().iter().copied().filter(solid);
        let first = exempt.chain(first).chain(memory.visible().iter().copied());
        drawn.submit(ctx, table, candidates.stamp(), first)?;
        let together = (how.together, |slot| memory.settled(slot));
        let what = (&**table, &*frame);
        tests.submit_tests(ctx, what, candidates.stamp(), asked.into_iter(), together)?;
        Ok(())
    });
    let drawn = drawn.shade(g, view, "shade last visible");
    let tests = tests.test(g, view, "test last occluded");

    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let blended = blended_list(g, view);
    let mut node = g.graph().host_node(view.named("collect"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates).read(drawn.asked);
    tests.read_back(&mut node);
    let memory = node.write(memory);
    let verdicts = node.write(verdicts);
    let found = found.written_by(&mut node);
    let blended = blended.map(|list| list.written_by(&mut node));
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        let asked = ctx.get(tests.asked)?;
        let answers = (&*asked, CountLayout::ByQuery, ctx.bytes(tests.answers)?);
        let appeared = memory.take(table, frame.cuts, answers, false);
        memory.fraction.learn(appeared);
        let seen =
            |slot: &u32| memory.known(*slot) == Known::Visible && !table.is_transparent(*slot);
        let mut new: Vec<u32> = asked.slots.iter().copied().filter(seen).collect();
        by_nearest_corner(&mut new, table, &frame);
        found.submit(ctx, table, candidates.stamp(), new.iter().copied())?;
        let mut verdicts = ctx.get_mut(verdicts)?;
        judge(&memory, table, &candidates, &mut verdicts);
        let about_drawn = ctx.get(drawn.asked)?.queries();
        verdicts.add_tested(about_drawn + asked.queries() + new.len() as u32);
        submit_blended(ctx, blended, table, &frame, &verdicts)
    });
    let found = found.shade(g, view, "shade found visible");
    if let Some(blended) = blended {
        g.shade_list(view, "transparent", blended);
    }
    Eye {
        memory,
        drawn,
        found: Some(found),
        verdicts,
    }
}

/// One eye that uses all answers a frame late. With `lent` an eye before it says what it draws: that is drawn without a question, and what
/// is left is all this one asks about.
pub(super) fn frame_late(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    how: CoherentSettings,
    lent: Option<Host<Verdicts>>,
) -> Eye {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let memory = g.graph().host::<Memory>(view.named("memory"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let (drawn, tests) = (
        Asking::declare(g, view, "last visible"),
        Asking::declare(g, view, "last occluded"),
    );
    let borrowed = lent.map(|_| g.unsubmitted(&view.named("seen by the other eye")));
    let blended = blended_list(g, view);
    let mut node = g.graph().host_node(view.named("recall"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    if let Some(lent) = lent {
        node.read(lent);
    }
    let late = Some(collect(&mut node, drawn, tests, true));
    let memory = node.updates(memory);
    let verdicts = node.write(verdicts);
    let (drawn, tests) = (drawn.written_by(&mut node), tests.written_by(&mut node));
    let borrowed = borrowed.map(|list| list.written_by(&mut node));
    let blended = blended.map(|list| list.written_by(&mut node));
    let (mut nearness, mut picked) = (Nearness::default(), Vec::new());
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        let appeared = take_late(ctx, late, table, &frame, &mut memory);
        memory.fraction.learn(appeared);
        memory.begin(table, &candidates, false);
        memory.sort(table, &frame, how.resort);
        Fraction::pick(
            &mut memory,
            table,
            &frame,
            how.share(),
            &mut nearness,
            &mut picked,
        );
        let mut verdicts = ctx.get_mut(verdicts)?;
        judge(&memory, table, &candidates, &mut verdicts);
        let solid = |slot: &u32| !table.is_transparent(*slot);
        let mut new: Vec<u32> = memory.unknown().iter().copied().filter(solid).collect();
        by_nearest_corner(&mut new, table, &frame);
        let exempt = candidates.exempt().iter().copied().filter(solid);
        let own: Vec<u32> = exempt
            .chain(new)
            .chain(memory.visible().iter().copied())
            .collect();
        let mut asked: Vec<u32> = picked.clone();
        let transparent = |slot: &u32| table.is_transparent(*slot);
        asked.extend(memory.unknown().iter().copied().filter(transparent));
        asked.extend(memory.blended());
        let mut borrowed_slots = Vec::new();
        if let (Some(lent), Some(borrowed)) = (lent, borrowed) {
            let lent = ctx.get(lent)?;
            let mut list = ctx.get_mut(borrowed.list)?;
            let lends = |slot: &u32| lent.get(*slot).draws() && solid(slot);
            borrowed_slots.extend(candidates.inside().iter().copied().filter(lends));
            list.fill(table, borrowed_slots.iter().copied(), MeshDetail::Level(0));
            ctx.upload(borrowed.slots, 0, bytemuck::cast_slice(list.slots()))?;
        }
        let is_lent = |slot: &u32| borrowed_slots.binary_search(slot).is_ok();
        asked.retain(|slot| !is_lent(slot));
        for slot in &borrowed_slots {
            // What is drawn for the other eye's sake tells nothing about this one: should that eye lose it, it is asked about here.
            memory.forget(*slot);
            if !verdicts.get(*slot).draws() {
                verdicts.set(*slot, Verdict::Visible);
            }
        }
        let own = own.iter().copied().filter(|slot| !is_lent(slot));
        let about_drawn = drawn.submit(ctx, table, candidates.stamp(), own)?;
        let together = (how.together, |slot| memory.settled(slot));
        let what = (&**table, &*frame);
        let about_rest =
            tests.submit_tests(ctx, what, candidates.stamp(), asked.into_iter(), together)?;
        verdicts.add_tested(about_drawn + about_rest);
        submit_blended(ctx, blended, table, &frame, &verdicts)
    });
    if let Some(borrowed) = borrowed {
        g.shade_list(view, "shade what the other eye sees", borrowed);
    }
    let drawn = drawn.shade(g, view, "shade last visible");
    let _ = tests.test(g, view, "test last occluded");
    if let Some(blended) = blended {
        g.shade_list(view, "transparent", blended);
    }
    Eye {
        memory,
        drawn,
        found: None,
        verdicts,
    }
}

/// Declares that the answers of two lists are read a frame late.
fn collect(node: &mut HostBuilder<'_>, drawn: Asking, second: Asking, tests: bool) -> Late {
    Late {
        drawn: node.read_previous(drawn.answers, drawn.asked),
        second: node.read_previous(second.answers, second.asked),
        tests,
    }
}

/// Takes in what has arrived, and says how many of the tested had appeared.
fn take_late(
    ctx: &HostContext<'_>,
    late: Option<Late>,
    table: &SceneTable,
    view: &ViewFrame,
    memory: &mut Memory,
) -> u32 {
    let mut appeared = 0;
    let Some(late) = late else {
        return appeared;
    };
    for (answers, drawn) in [(late.drawn, true), (late.second, !late.tests)] {
        if let Some(late) = ctx.late(answers) {
            let answers = (late.tag, CountLayout::ByQuery, late.bytes);
            let some = memory.take(table, view.cuts, answers, drawn);
            appeared += if drawn { 0 } else { some };
        }
    }
    appeared
}

/// Verdicts from what is known.
fn judge(memory: &Memory, table: &SceneTable, candidates: &Candidates, verdicts: &mut Verdicts) {
    verdicts.reset_outside(table);
    for slot in candidates.inside() {
        let known = memory.known(*slot);
        let verdict = match known {
            _ if candidates.is_exempt(*slot) => {
                if !table.is_tested(*slot) && known != Known::Nothing {
                    verdicts.note(*slot, known == Known::Visible);
                }
                Verdict::Untested
            }
            Known::Nothing => Verdict::New,
            Known::Visible => Verdict::Visible,
            Known::Occluded => Verdict::Occluded,
        };
        verdicts.set(*slot, verdict);
    }
}

/// The list of what is blended, where the scene has any.
pub(super) fn blended_list(g: &mut FrameGraph<'_>, view: &ViewNodes) -> Option<ListDraws> {
    let name = view.named("visible transparent set");
    g.scene_layout().transparent.then(|| g.unsubmitted(&name))
}

/// Fills the list of what is blended and drawn.
pub(super) fn submit_blended(
    ctx: &mut HostContext<'_>,
    blended: Option<ListDraws>,
    table: &SceneTable,
    view: &ViewFrame,
    verdicts: &Verdicts,
) -> Result<(), BodyError> {
    let Some(blended) = blended else {
        return Ok(());
    };
    let mut list = ctx.get_mut(blended.list)?;
    let drawn = verdicts.drawn().filter(|slot| table.is_transparent(*slot));
    back_to_front(&mut list, table, view, drawn.map(|slot| (slot, 0)));
    ctx.upload(blended.slots, 0, bytemuck::cast_slice(list.slots()))?;
    Ok(())
}
