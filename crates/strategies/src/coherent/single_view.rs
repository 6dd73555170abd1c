//! A view on its own, with answers on the host. It draws the entities visible in the last frame first, each with a query, and then tests a
//! fraction of the occluded entities against their depth.
//!
//! Mansa, Amundarain, Elizalde, Garcia-Alonso, Matey, *Towards Adaptive Occlusion Culling Using Camera Coherence*, 2006 (OCF), as described in
//! *Occlusion Culling for Stereoscopic Display of Complex Mechanical Sets*, 2007, section 3.1. The paper waits for the answers of the tests within
//! the frame, as [`same_frame`] does. [`frame_late`] uses them in the next frame and never waits.

use antumbra_cull::{
    CULL, Candidates, FrameGraph, MeshDetail, Queried, SceneTable, Verdict, Verdicts, ViewFrame,
    ViewNodes,
};
use antumbra_graph::{Host, HostBuilder, HostContext, ReadBack};

use super::memory::{AfterCut, Answers, Memory, QuerySubject, Visibility};
use super::picker::{Patience, TestPicker};
use super::queried_list::{ListSource, QueriedList, Sharing, submit_unqueried};
use super::settings::CoherentSettings;
use crate::transparent::{submit_transparent, transparent_list};
use antumbra_cull::order::by_nearest_corner;

/// What a view hands to the views after it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewState {
    pub memory: Host<Memory>,
    /// The entities visible in the last frame, drawn first.
    pub drawn: QueriedList,
    /// The entities that the tests of this frame found, drawn next; `None` where answers are used in the next frame.
    pub found: Option<QueriedList>,
    pub verdicts: Host<Verdicts>,
}

/// Where the answers about the drawn meshes of a stereo pair's first view are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DrawnAnswers {
    /// By the view that is declared.
    ReadHere,
    /// By another view.
    ReadElsewhere,
}

/// Two lists whose answers are read in a later frame.
#[derive(Debug, Clone, Copy)]
struct LateAnswers {
    drawn: ReadBack<Queried>,
    second: ReadBack<Queried>,
    second_subject: QuerySubject,
}

/// Declares a view that waits for the answers of its tests. [`DrawnAnswers::ReadHere`]: it reads the answers about what it drew itself, in
/// the next frame.
pub(super) fn same_frame(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    settings: CoherentSettings,
    drawn_answers: DrawnAnswers,
) -> ViewState {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let memory = g.graph().host::<Memory>(view.named("memory"));
    let (drawn, tests, found) = (
        QueriedList::declare(g, view, "last visible"),
        QueriedList::declare(g, view, "last occluded"),
        QueriedList::declare(g, view, "found visible"),
    );
    let mut node = g.graph().host_node(view.named("read history"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    let late = match drawn_answers {
        DrawnAnswers::ReadHere => Some(LateAnswers {
            drawn: read_late(&mut node, drawn),
            second: read_late(&mut node, found),
            second_subject: QuerySubject::DrawnMeshes,
        }),
        DrawnAnswers::ReadElsewhere => None,
    };
    let memory = node.updates(memory);
    let (drawn, tests) = (drawn.written_by(&mut node), tests.written_by(&mut node));
    let mut picker = TestPicker::default();
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        take_late(ctx, late, table, &frame, &mut memory);
        memory.begin(table, &candidates, AfterCut::KeepVisible);
        memory.sort(table, &frame, settings.resort);
        let picked = picker.pick(
            &mut memory,
            table,
            &frame,
            settings.fraction_rule(),
            Patience::Ends,
        );
        let opaque = |slot: &u32| !table.is_transparent(*slot);
        let mut first: Vec<u32> = Vec::new();
        let mut tested: Vec<u32> = Vec::new();
        if memory.visible().is_empty() {
            // Nothing can be hidden behind an empty depth buffer: all opaque entities without an answer are drawn.
            first.extend(memory.unknown().iter().copied().filter(opaque));
            by_nearest_corner(&mut first, table, &frame);
        } else {
            tested.extend(memory.unknown().iter().chain(memory.transparent()));
        }
        tested.extend_from_slice(picked);
        let exempt = candidates.exempt().iter().copied().filter(opaque);
        let first = exempt.chain(first).chain(memory.visible().iter().copied());
        let source = ListSource {
            table,
            view: &frame,
            stamp: candidates.stamp(),
        };
        drawn.submit(ctx, source, first)?;
        let sharing = Sharing {
            most: settings.together,
            allowed: |slot| memory.may_share_query(slot),
        };
        tests.submit_tests(ctx, source, tested.into_iter(), sharing)?;
        Ok(())
    });
    let drawn = drawn.shade(g, view, "shade last visible");
    let tests = tests.test(g, view, "test last occluded");

    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let transparent = transparent_list(g, view);
    let mut node = g.graph().host_node(view.named("collect"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates).read(drawn.queried);
    tests.read_back(&mut node);
    let memory = node.write(memory);
    let verdicts = node.write(verdicts);
    let found = found.written_by(&mut node);
    let transparent = transparent.map(|list| list.written_by(&mut node));
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        let queried = ctx.get(tests.queried)?;
        let answers = Answers {
            queried: &queried,
            bytes: ctx.bytes(tests.answers)?,
            subject: QuerySubject::Tests,
        };
        let appeared = memory.take(table, frame.cuts, answers);
        memory.fraction.update(appeared);
        let seen = |slot: &u32| {
            memory.visibility(*slot) == Visibility::Visible && !table.is_transparent(*slot)
        };
        let mut found_slots: Vec<u32> = queried.slots.iter().copied().filter(seen).collect();
        by_nearest_corner(&mut found_slots, table, &frame);
        let source = ListSource {
            table,
            view: &frame,
            stamp: candidates.stamp(),
        };
        found.submit(ctx, source, found_slots.iter().copied())?;
        let mut verdicts = ctx.get_mut(verdicts)?;
        judge(&memory, table, &candidates, &mut verdicts);
        let drawn_queries = ctx.get(drawn.queried)?.queries();
        verdicts.add_tested(drawn_queries + queried.queries() + found_slots.len() as u32);
        submit_transparent(ctx, transparent, table, &frame, &verdicts)
    });
    let found = found.shade(g, view, "shade found visible");
    if let Some(transparent) = transparent {
        g.shade_list(view, "transparent", transparent);
    }
    ViewState {
        memory,
        drawn,
        found: Some(found),
        verdicts,
    }
}

/// Declares a view that uses all answers in the next frame. `lent`: the verdicts of an earlier view. What that view draws is drawn here without a
/// query, and this view queries only the other entities.
pub(super) fn frame_late(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    settings: CoherentSettings,
    lent: Option<Host<Verdicts>>,
) -> ViewState {
    let inputs = view.inputs();
    let candidates = g.in_frustum(view);
    let memory = g.graph().host::<Memory>(view.named("memory"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let (drawn, tests) = (
        QueriedList::declare(g, view, "last visible"),
        QueriedList::declare(g, view, "last occluded"),
    );
    let lent_list = lent.map(|_| g.unsubmitted(&view.named("seen by the other eye")));
    let mut guard = g.begin_guard(view, settings.guard);
    let revived = guard.map(|_| g.unsubmitted(&view.named("unconfirmed")));
    let transparent = transparent_list(g, view);
    let mut node = g.graph().host_node(view.named("read history"));
    node.group(CULL).read(inputs.scene).read(inputs.view);
    node.read(candidates);
    if let Some(lent) = lent {
        node.read(lent);
    }
    let late = LateAnswers {
        drawn: read_late(&mut node, drawn),
        second: read_late(&mut node, tests),
        second_subject: QuerySubject::Tests,
    };
    let memory = node.updates(memory);
    let verdicts = node.write(verdicts);
    let (drawn, tests) = (drawn.written_by(&mut node), tests.written_by(&mut node));
    let lent_list = lent_list.map(|list| list.written_by(&mut node));
    let revived = revived.map(|list| list.written_by(&mut node));
    let guarded = guard.as_mut().map(|guard| guard.updated_by(&mut node));
    let transparent = transparent.map(|list| list.written_by(&mut node));
    let mut picker = TestPicker::default();
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let table = &scene.table;
        let mut memory = ctx.get_mut(memory)?;
        let appeared = take_late(ctx, Some(late), table, &frame, &mut memory);
        memory.fraction.update(appeared);
        memory.begin(table, &candidates, AfterCut::Forget);
        memory.sort(table, &frame, settings.resort);
        let picked = picker.pick(
            &mut memory,
            table,
            &frame,
            settings.fraction_rule(),
            Patience::Endless,
        );
        let mut verdicts = ctx.get_mut(verdicts)?;
        judge(&memory, table, &candidates, &mut verdicts);
        let opaque = |slot: &u32| !table.is_transparent(*slot);
        if let (Some(guard), Some(revived)) = (guarded, revived) {
            let mut guard = ctx.get_mut(guard)?;
            let inside = candidates.inside().iter().copied();
            let unconfirmed = guard.confirm(table, inside, &mut verdicts).iter().copied();
            submit_unqueried(ctx, revived, table, unconfirmed.filter(opaque))?;
        }
        let mut new: Vec<u32> = memory.unknown().iter().copied().filter(opaque).collect();
        by_nearest_corner(&mut new, table, &frame);
        let exempt = candidates.exempt().iter().copied().filter(opaque);
        let own: Vec<u32> = exempt
            .chain(new)
            .chain(memory.visible().iter().copied())
            .collect();
        let mut tested: Vec<u32> = picked.to_vec();
        let unknown = memory.unknown().iter().copied();
        tested.extend(unknown.filter(|slot| table.is_transparent(*slot)));
        tested.extend(memory.transparent());
        let mut lent_slots = Vec::new();
        if let (Some(lent), Some(lent_list)) = (lent, lent_list) {
            let lent = ctx.get(lent)?;
            let mut list = ctx.get_mut(lent_list.list)?;
            let lends = |slot: &u32| lent.get(*slot).draws() && opaque(slot);
            lent_slots.extend(candidates.inside().iter().copied().filter(lends));
            list.fill(table, lent_slots.iter().copied(), MeshDetail::Level(0));
            ctx.upload(lent_list.slots, 0, bytemuck::cast_slice(list.slots()))?;
        }
        let is_lent = |slot: &u32| lent_slots.binary_search(slot).is_ok();
        tested.retain(|slot| !is_lent(slot));
        for slot in &lent_slots {
            // Drawing it without a query says nothing about this view. Once the other view no longer draws it, it is queried here.
            memory.forget(*slot);
            if !verdicts.get(*slot).draws() {
                verdicts.set(*slot, Verdict::Visible);
            }
        }
        let own = own.iter().copied().filter(|slot| !is_lent(slot));
        let source = ListSource {
            table,
            view: &frame,
            stamp: candidates.stamp(),
        };
        let drawn_queries = drawn.submit(ctx, source, own)?;
        let sharing = Sharing {
            most: settings.together,
            allowed: |slot| memory.may_share_query(slot),
        };
        let test_queries = tests.submit_tests(ctx, source, tested.into_iter(), sharing)?;
        verdicts.add_tested(drawn_queries + test_queries);
        submit_transparent(ctx, transparent, table, &frame, &verdicts)
    });
    if let Some(lent_list) = lent_list {
        g.shade_list(view, "shade what the other eye sees", lent_list);
    }
    if let Some(revived) = revived {
        g.shade_list(view, "shade unconfirmed", revived);
    }
    let drawn = drawn.shade(g, view, "shade last visible");
    // No node of this frame reads the answers.
    let _ = tests.test(g, view, "test last occluded");
    g.end_guard(view, guard);
    if let Some(transparent) = transparent {
        g.shade_list(view, "transparent", transparent);
    }
    ViewState {
        memory,
        drawn,
        found: None,
        verdicts,
    }
}

/// Declares on a host node that it reads a list's answers in a later frame.
fn read_late(node: &mut HostBuilder<'_>, list: QueriedList) -> ReadBack<Queried> {
    node.read_previous(list.answers, list.queried)
}

/// Takes the answers that have arrived. Returns the number of tests that found a sample of occluded entities.
fn take_late(
    ctx: &HostContext<'_>,
    late: Option<LateAnswers>,
    table: &SceneTable,
    view: &ViewFrame,
    memory: &mut Memory,
) -> u32 {
    let mut appeared = 0;
    let Some(late) = late else {
        return appeared;
    };
    let lists = [
        (late.drawn, QuerySubject::DrawnMeshes),
        (late.second, late.second_subject),
    ];
    for (answers, subject) in lists {
        if let Some(late) = ctx.late(answers) {
            let answers = Answers {
                queried: late.tag,
                bytes: late.bytes,
                subject,
            };
            let found = memory.take(table, view.cuts, answers);
            if subject == QuerySubject::Tests {
                appeared += found;
            }
        }
    }
    appeared
}

/// Gives every candidate the verdict that follows from the memory.
fn judge(memory: &Memory, table: &SceneTable, candidates: &Candidates, verdicts: &mut Verdicts) {
    verdicts.reset_outside(table);
    for slot in candidates.inside() {
        let visibility = memory.visibility(*slot);
        let verdict = match visibility {
            _ if candidates.is_exempt(*slot) => {
                if !table.is_tested(*slot) && visibility != Visibility::Unknown {
                    verdicts.note(*slot, visibility == Visibility::Visible);
                }
                Verdict::Untested
            }
            Visibility::Unknown => Verdict::New,
            Visibility::Visible => Verdict::Visible,
            Visibility::Occluded => Verdict::Occluded,
        };
        verdicts.set(*slot, verdict);
    }
}
