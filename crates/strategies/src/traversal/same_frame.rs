//! The traversal as nodes of the graph: a host loop. Each iteration visits nodes, draws what it found visible, queries a batch of the nodes that are
//! left, and waits for the answers.

use antumbra_cull::boxes::{BoxPassSpec, box_query_pass};
use antumbra_cull::{
    CULL, DrawList, FrameGraph, MeshDetail, SceneTable, Verdicts, ViewNodes, VisibleSet,
};
use antumbra_graph::{BufferDesc, Host};
use antumbra_scene::hierarchy::HierarchyShape;

use super::inputs::TraversalInputs;
use super::settings::{DrawOrder, QueryMode, TraversalSettings};
use super::waiting::WaitingTraversal;
use crate::query_results::query_results;
use crate::sketch::Sketch;
use crate::transparent::shade_transparent;

/// What one iteration of the loop hands to the next.
struct LoopState<T> {
    traversal: Host<T>,
    verdicts: Host<Verdicts>,
}

/// Declares a traversal that waits for each batch of answers.
pub fn same_frame<T: WaitingTraversal>(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    shape: HierarchyShape,
    settings: TraversalSettings,
) -> VisibleSet {
    let inputs = TraversalInputs::new(g, view, shape, settings);
    let mut state = begin::<T>(g, view, inputs);
    g.host_loop(view.named("traversal"), |g| {
        iterate(g, view, inputs, &mut state)
    });
    let LoopState {
        traversal,
        verdicts,
    } = state;
    shade_transparent(g, view, verdicts);
    if settings.sketch {
        let sketch = copy_sketch(g, view, traversal);
        g.show(view, Sketch::NAME, sketch);
    }
    VisibleSet::drawn(verdicts)
}

/// Starts the traversal at the roots.
fn begin<T: WaitingTraversal>(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    inputs: TraversalInputs,
) -> LoopState<T> {
    let traversal = g.graph().host::<T>(view.named("traversal"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("start at the roots"));
    inputs.read_by(&mut node);
    let (traversal, verdicts) = (node.updates(traversal), node.write(verdicts));
    node.run(move |ctx| {
        let (mut traversal, mut verdicts) = (ctx.get_mut(traversal)?, ctx.get_mut(verdicts)?);
        inputs.with_context(ctx, |context, frame| {
            verdicts.reset_outside(context.table);
            traversal.begin(context, &inputs.settings, frame.cuts, &mut verdicts);
            Ok(())
        })
    });
    LoopState {
        traversal,
        verdicts,
    }
}

/// Declares one iteration: visit nodes, draw the visible ones, query a batch, wait. Returns whether the loop is done.
fn iterate<T: WaitingTraversal>(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    inputs: TraversalInputs,
    state: &mut LoopState<T>,
) -> Host<bool> {
    let settings = inputs.settings;
    let most = match settings.queries {
        QueryMode::Single => 1,
        QueryMode::Batches => max_queries(g),
    };
    let visible = g.unsubmitted(&view.named("draw list"));
    let query_boxes = g.unsubmitted_boxes(&view.named("boxes to query"), most);
    let LoopState {
        traversal,
        verdicts,
    } = *state;
    let mut node = g.graph().host_node(view.named("traverse"));
    inputs.read_by(&mut node);
    let (traversal, verdicts) = (node.write(traversal), node.write(verdicts));
    let visible = visible.written_by(&mut node);
    let query_boxes = query_boxes.written_by(&mut node);
    node.run(move |ctx| {
        let (mut traversal, mut boxes) = (ctx.get_mut(traversal)?, ctx.get_mut(query_boxes.list)?);
        let (mut list, mut verdicts) = (ctx.get_mut(visible.list)?, ctx.get_mut(verdicts)?);
        inputs.with_context(ctx, |context, _| {
            traversal.advance(context, &settings, &mut verdicts, &mut boxes);
            fill(&mut list, context.table, traversal.found(), settings.order);
            traversal.found().clear();
            Ok(())
        })?;
        ctx.upload(visible.slots, 0, bytemuck::cast_slice(list.slots()))?;
        ctx.upload(query_boxes.buffer, 0, bytemuck::cast_slice(boxes.boxes()))?;
        Ok(())
    });
    g.shade_list(view, "draw visible", visible);
    let depth = view.targets.depth;
    let answers = g
        .graph()
        .buffer(view.named("query results"), BufferDesc::new(most * 8));
    let spec = BoxPassSpec {
        name: view.named("query pending nodes"),
        group: CULL,
        pipeline: g.box_pipeline(),
    };
    let answers = box_query_pass(g.graph(), spec, inputs.view, query_boxes, depth, answers);
    let done = g.graph().host::<bool>(view.named("done"));
    let mut node = g.graph().host_node(view.named("wait"));
    inputs.read_by(&mut node);
    node.read(query_boxes.list)
        .read_back(answers)
        .bytes(move |host| {
            host.get(query_boxes.list)
                .map_or(0, |boxes| u64::from(boxes.query_count()) * 8)
        });
    let (traversal, verdicts, done) = (
        node.write(traversal),
        node.write(verdicts),
        node.write(done),
    );
    node.run(move |ctx| {
        let results = query_results(ctx.bytes(answers)?);
        let (mut traversal, mut verdicts) = (ctx.get_mut(traversal)?, ctx.get_mut(verdicts)?);
        inputs.with_context(ctx, |context, _| {
            traversal.answer(context, &settings, &mut verdicts, results);
            Ok(())
        })?;
        *ctx.get_mut(done)? = traversal.is_done();
        Ok(())
    });
    *state = LoopState {
        traversal,
        verdicts,
    };
    done
}

/// Most queries of a frame: a query a node of the tree, which has less than two nodes a leaf.
pub(super) fn max_queries(g: &FrameGraph<'_>) -> u64 {
    u64::from(g.scene_layout().slots.max(1)) * 2
}

/// Fills a draw list with the found slots.
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

/// Copies the sketch of a finished traversal into a host value of its own.
fn copy_sketch<T: WaitingTraversal>(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    traversal: Host<T>,
) -> Host<Sketch> {
    let sketch = g.graph().host::<Sketch>(view.named("sketch"));
    let mut node = g.graph().host_node(view.named("sketch traversal"));
    node.group(CULL).read(traversal);
    let sketch = node.write(sketch);
    node.run(move |ctx| {
        ctx.get_mut(sketch)?
            .clone_from(ctx.get(traversal)?.sketch());
        Ok(())
    });
    sketch
}
