//! The late walk as nodes of the graph: one batch of questions a frame, whose answers the next frame's walk goes by.

use antumbra_draw::boxes::{BoxPassSpec, box_query_pass};
use antumbra_graph::BufferDesc;
use antumbra_scene::hierarchy::HierarchyShape;

use super::inputs::TraversalInputs;
use super::late::{LateTraversal, QueriedNodes};
use super::one_frame::TraversalSettings;
use super::same_frame::{fill, questions, submit_transparent};
use crate::sketch::Sketch;
use antumbra_cull::{CULL, FrameGraph, Verdicts, ViewNodes, VisibleSet};

/// Declares a walk that waits for nothing.
pub fn frame_late(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    shape: HierarchyShape,
    how: TraversalSettings,
) -> VisibleSet {
    let looking = TraversalInputs::new(g, view, shape, how);
    let inputs = looking.inputs;
    let most = questions(g);
    let walk = g.graph().host::<LateTraversal>(view.named("walk"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let asked = g.graph().host::<QueriedNodes>(view.named("asked"));
    let sketch = how
        .sketch
        .then(|| g.graph().host::<Sketch>(view.named("sketch")));
    let draw = g.unsubmitted(&view.named("visible set"));
    let ask = g.unsubmitted_boxes(&view.named("to ask about"), most);
    let answers = g
        .graph()
        .buffer(view.named("answers"), BufferDesc::new(most * 8));
    let mut node = g.graph().host_node(view.named("walk the tree"));
    looking.declare(&mut node);
    let late = node.read_previous(answers, asked);
    let walk = node.updates(walk);
    let (verdicts, asked) = (node.write(verdicts), node.write(asked));
    node.bytes(move |host| {
        host.get(asked)
            .map_or(0, |asked| asked.ends.len() as u64 * 8)
    });
    let draw = draw.written_by(&mut node);
    let ask = ask.written_by(&mut node);
    let sketch = sketch.map(|sketch| node.write(sketch));
    node.run(move |ctx| {
        let (mut walk, mut verdicts) = (ctx.get_mut(walk)?, ctx.get_mut(verdicts)?);
        let (mut list, mut boxes) = (ctx.get_mut(draw.list)?, ctx.get_mut(ask.list)?);
        looking.look(ctx, |sight, frame| {
            verdicts.reset_outside(sight.table);
            walk.begin(sight, frame.cuts);
            if let Some(late) = ctx.late(late) {
                // Zero, or anything else: some drivers count.
                let answers = late.bytes.as_chunks::<8>().0.iter();
                let visible = answers.map(|answer| *answer != [0; 8]);
                walk.take(sight, &how, late.tag, visible);
            }
            walk.walk(sight, &how, &mut verdicts, &mut boxes);
            fill(&mut list, sight.table, walk.found(), how.order);
            Ok(())
        })?;
        *ctx.get_mut(asked)? = walk.asked(&boxes);
        ctx.upload(draw.slots, 0, bytemuck::cast_slice(list.slots()))?;
        ctx.upload(ask.buffer, 0, bytemuck::cast_slice(boxes.boxes()))?;
        if let Some(sketch) = sketch {
            ctx.get_mut(sketch)?.clone_from(&walk.sketch);
        }
        Ok(())
    });
    g.shade_list(view, "shaded", draw);
    let spec = BoxPassSpec {
        name: view.named("ask for the next frame"),
        group: CULL,
        pipeline: g.box_pipeline(),
    };
    let depth = view.targets.depth;
    box_query_pass(g.graph(), spec, inputs, ask, depth, answers);
    if g.scene_layout().transparent {
        let list = g.unsubmitted(&view.named("visible transparent set"));
        let list = submit_transparent(g, view, verdicts, list);
        g.shade_list(view, "transparent", list);
    }
    if let Some(sketch) = sketch {
        g.show(view, Sketch::NAME, sketch);
    }
    VisibleSet::drawn(verdicts)
}
