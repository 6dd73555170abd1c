//! The late traversal as nodes of the graph: one pass of queries a frame, whose answers a later frame reads without a wait.

use antumbra_cull::boxes::{BoxPassSpec, box_query_pass};
use antumbra_graph::BufferDesc;
use antumbra_scene::hierarchy::HierarchyShape;

use super::inputs::TraversalInputs;
use super::late::{LateTraversal, QueriedNodes};
use super::same_frame::{fill, max_queries};
use super::settings::TraversalSettings;
use crate::query_results::query_results;
use crate::sketch::Sketch;
use crate::transparent::shade_transparent;
use antumbra_cull::{CULL, FrameGraph, Verdicts, ViewNodes, VisibleSet};

/// Declares a traversal that never waits.
pub fn frame_late(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    shape: HierarchyShape,
    settings: TraversalSettings,
) -> VisibleSet {
    let settings = TraversalSettings {
        in_flight: g.frames_in_flight(),
        ..settings
    };
    let inputs = TraversalInputs::new(g, view, shape, settings);
    let most = max_queries(g);
    let traversal = g.graph().host::<LateTraversal>(view.named("traversal"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let queried = g.graph().host::<QueriedNodes>(view.named("queried nodes"));
    let sketch = settings
        .sketch
        .then(|| g.graph().host::<Sketch>(view.named("sketch")));
    let visible = g.unsubmitted(&view.named("visible set"));
    let query_boxes = g.unsubmitted_boxes(&view.named("boxes to query"), most);
    let answers = g
        .graph()
        .buffer(view.named("query results"), BufferDesc::new(most * 8));
    let mut guard = g.begin_guard(view, settings.guard);
    let mut node = g.graph().host_node(view.named("traverse tree"));
    inputs.read_by(&mut node);
    let late = node.read_previous(answers, queried);
    let traversal = node.updates(traversal);
    let (verdicts, queried) = (node.write(verdicts), node.write(queried));
    node.bytes(move |host| {
        host.get(queried)
            .map_or(0, |queried| queried.ends.len() as u64 * 8)
    });
    let guarded = guard.as_mut().map(|guard| guard.updated_by(&mut node));
    let visible = visible.written_by(&mut node);
    let query_boxes = query_boxes.written_by(&mut node);
    let sketch = sketch.map(|sketch| node.write(sketch));
    node.run(move |ctx| {
        let (mut traversal, mut verdicts) = (ctx.get_mut(traversal)?, ctx.get_mut(verdicts)?);
        let (mut list, mut boxes) = (ctx.get_mut(visible.list)?, ctx.get_mut(query_boxes.list)?);
        inputs.with_context(ctx, |context, frame| {
            verdicts.reset_outside(context.table);
            traversal.begin(context, frame.cuts);
            if let Some(late) = ctx.late(late) {
                traversal.take(context, &settings, late.tag, query_results(late.bytes));
            }
            traversal.traverse(context, &settings, &mut verdicts, &mut boxes);
            if let Some(guard) = guarded {
                let mut guard = ctx.get_mut(guard)?;
                let revived = guard.confirm(context.table, 0..context.table.slots(), &mut verdicts);
                let opaque = |slot: &u32| !context.table.is_transparent(*slot);
                traversal
                    .found()
                    .extend(revived.iter().copied().filter(opaque));
            }
            fill(&mut list, context.table, traversal.found(), settings.order);
            Ok(())
        })?;
        *ctx.get_mut(queried)? = traversal.queried();
        ctx.upload(visible.slots, 0, bytemuck::cast_slice(list.slots()))?;
        ctx.upload(query_boxes.buffer, 0, bytemuck::cast_slice(boxes.boxes()))?;
        if let Some(sketch) = sketch {
            ctx.get_mut(sketch)?.clone_from(&traversal.sketch);
        }
        Ok(())
    });
    g.shade_list(view, "shaded", visible);
    let spec = BoxPassSpec {
        name: view.named("query for the next frame"),
        group: CULL,
        pipeline: g.box_pipeline(),
    };
    let depth = view.targets.depth;
    box_query_pass(g.graph(), spec, inputs.view, query_boxes, depth, answers);
    shade_transparent(g, view, verdicts);
    g.end_guard(view, guard);
    if let Some(sketch) = sketch {
        g.show(view, Sketch::NAME, sketch);
    }
    VisibleSet::drawn(verdicts)
}
