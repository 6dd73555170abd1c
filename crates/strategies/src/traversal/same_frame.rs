//! The walk as nodes of the graph: a loop whose turns draw what is known to be visible, ask about those who wait, and wait for the answers.

use antumbra_draw::boxes::{BoxPassSpec, box_query_pass};
use antumbra_draw::passes::{self, ListDraws};
use antumbra_draw::{DrawList, MeshDetail, SceneTable};
use antumbra_graph::{BufferDesc, Host};
use antumbra_scene::hierarchy::HierarchyShape;

use super::inputs::TraversalInputs;
use super::one_frame::{DrawOrder, QueryMode, Traversal, TraversalSettings};
use crate::sketch::Sketch;
use antumbra_cull::order::back_to_front;
use antumbra_cull::{CULL, DRAW, FrameGraph, Verdicts, ViewNodes, VisibleSet};

/// What goes from turn to turn.
#[derive(Clone, Copy)]
struct Ends {
    walk: Host<Traversal>,
    verdicts: Host<Verdicts>,
}

/// Declares a walk that waits for each portion of answers.
pub fn same_frame(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    shape: HierarchyShape,
    how: TraversalSettings,
) -> VisibleSet {
    let looking = TraversalInputs::new(g, view, shape, how);
    let mut ends = begin(g, view, looking);
    g.host_loop(view.named("walk"), |g| turn(g, view, looking, &mut ends));
    let Ends { walk, verdicts } = ends;
    if g.scene_layout().transparent {
        let name = view.named("visible transparent set");
        let list = g.unsubmitted(&name);
        let list = submit_transparent(g, view, verdicts, list);
        g.shade_list(view, "transparent", list);
    }
    if how.sketch {
        let sketch = hand_over(g, view, walk);
        g.show(view, Sketch::NAME, sketch);
    }
    VisibleSet::drawn(verdicts)
}

/// Goes to the roots.
fn begin(g: &mut FrameGraph<'_>, view: &ViewNodes, looking: TraversalInputs) -> Ends {
    let walk = g.graph().host::<Traversal>(view.named("walk"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("begin at the roots"));
    looking.declare(&mut node);
    let ends = Ends {
        walk: node.updates(walk),
        verdicts: node.write(verdicts),
    };
    node.run(move |ctx| {
        let (mut walk, mut verdicts) = (ctx.get_mut(ends.walk)?, ctx.get_mut(ends.verdicts)?);
        looking.look(ctx, |sight, frame| {
            verdicts.reset_outside(sight.table);
            walk.begin(sight, &looking.how, frame.cuts, &mut verdicts);
            Ok(())
        })
    });
    ends
}

/// One turn: goes on to the next questions, draws what was found on the way, asks, waits.
fn turn(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    looking: TraversalInputs,
    ends: &mut Ends,
) -> Host<bool> {
    let TraversalInputs { inputs, how, .. } = looking;
    let most = match how.asking {
        QueryMode::Single => 1,
        QueryMode::Batches => questions(g),
    };
    let draw = g.unsubmitted(&view.named("to draw"));
    let ask = g.unsubmitted_boxes(&view.named("to ask about"), most);
    let Ends { walk, verdicts } = *ends;
    let mut node = g.graph().host_node(view.named("go on"));
    looking.declare(&mut node);
    let (walk, verdicts) = (node.write(walk), node.write(verdicts));
    let draw = draw.written_by(&mut node);
    let ask = ask.written_by(&mut node);
    node.run(move |ctx| {
        let (mut walk, mut boxes) = (ctx.get_mut(walk)?, ctx.get_mut(ask.list)?);
        let (mut list, mut verdicts) = (ctx.get_mut(draw.list)?, ctx.get_mut(verdicts)?);
        looking.look(ctx, |sight, _| {
            walk.advance(sight, &how, &mut verdicts, &mut boxes);
            fill(&mut list, sight.table, walk.found(), how.order);
            walk.found().clear();
            Ok(())
        })?;
        ctx.upload(draw.slots, 0, bytemuck::cast_slice(list.slots()))?;
        ctx.upload(ask.buffer, 0, bytemuck::cast_slice(boxes.boxes()))?;
        Ok(())
    });
    let kind = g.shaded_kind();
    let drawing = g.pass(view.named("draw the visible"), DRAW, kind);
    view.targets = passes::shaded_pass(g.graph(), &drawing, inputs, draw, view.targets);
    let depth = view.targets.depth;
    let answers = g
        .graph()
        .buffer(view.named("answers"), BufferDesc::new(most * 8));
    let spec = BoxPassSpec {
        name: view.named("ask about those who wait"),
        group: CULL,
        pipeline: g.box_pipeline(),
    };
    let answers = box_query_pass(g.graph(), spec, inputs, ask, depth, answers);
    let done = g.graph().host::<bool>(view.named("done"));
    let mut node = g.graph().host_node(view.named("wait"));
    looking.declare(&mut node);
    node.read(ask.list).read_back(answers).bytes(move |host| {
        host.get(ask.list)
            .map_or(0, |boxes| u64::from(boxes.query_count()) * 8)
    });
    let (walk, verdicts, done) = (node.write(walk), node.write(verdicts), node.write(done));
    node.run(move |ctx| {
        let answers = ctx.bytes(answers)?.as_chunks::<8>().0.iter();
        // Zero, or anything else: some drivers count.
        let visible = answers.map(|answer| *answer != [0; 8]);
        let (mut walk, mut verdicts) = (ctx.get_mut(walk)?, ctx.get_mut(verdicts)?);
        looking.look(ctx, |sight, _| {
            walk.answer(sight, &how, &mut verdicts, visible);
            Ok(())
        })?;
        *ctx.get_mut(done)? = walk.is_over();
        Ok(())
    });
    *ends = Ends { walk, verdicts };
    done
}

/// More questions than a frame's tree has nodes are never asked: a hierarchy has less than two nodes a leaf.
pub(super) fn questions(g: &FrameGraph<'_>) -> u64 {
    u64::from(g.scene_layout().slots.max(1)) * 2
}

/// Puts what was found into a list.
pub(super) fn fill(list: &mut DrawList, table: &SceneTable, found: &mut [u32], order: DrawOrder) {
    match order {
        DrawOrder::State => {
            found.sort_unstable();
            list.fill(table, found.iter().copied(), MeshDetail::Level(0));
        }
        DrawOrder::Depth => {
            list.clear();
            for slot in found {
                list.push(table, *slot, MeshDetail::Level(0));
            }
        }
    }
}

/// Transparent entities hide nothing, so they wait until all that is solid is drawn.
pub(crate) fn submit_transparent(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    verdicts: Host<Verdicts>,
    list: ListDraws,
) -> ListDraws {
    let inputs = view.inputs();
    let mut node = g.graph().host_node(view.named("order the transparent"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(verdicts);
    let list = list.written_by(&mut node);
    node.run(move |ctx| {
        let (scene, frame, verdicts) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(verdicts)?,
        );
        let table = &scene.table;
        let mut transparent = ctx.get_mut(list.list)?;
        let drawn = verdicts.drawn().filter(|slot| table.is_transparent(*slot));
        back_to_front(&mut transparent, table, &frame, drawn.map(|slot| (slot, 0)));
        ctx.upload(list.slots, 0, bytemuck::cast_slice(transparent.slots()))?;
        Ok(())
    });
    list
}

/// Takes the sketch out of a finished walk.
fn hand_over(g: &mut FrameGraph<'_>, view: &ViewNodes, walk: Host<Traversal>) -> Host<Sketch> {
    let sketch = g.graph().host::<Sketch>(view.named("sketch"));
    let mut node = g.graph().host_node(view.named("sketch the walk"));
    node.group(CULL).read(walk);
    let sketch = node.write(sketch);
    node.run(move |ctx| {
        ctx.get_mut(sketch)?.clone_from(&ctx.get(walk)?.sketch);
        Ok(())
    });
    sketch
}
