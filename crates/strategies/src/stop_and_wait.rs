//! Stop and wait: for each entity, front to back, one hardware query, a wait for its answer, then its mesh if the answer is "visible". The
//! classic use of occlusion queries, and the baseline of the papers that improve on it.
//!
//! Bartz, Meissner, Huettner, *OpenGL-Assisted Occlusion Culling for Large Polygonal Models*, 1999, as described in Plate et al. 2004,
//! section 2, and Staneker et al. 2004, section 2. Each iteration of a host loop draws what the last answers showed visible, queries the next
//! entities, and waits for their answers at a sync point.

use antumbra_cull::{
    CULL, Candidates, DeclareError, FrameGraph, Latency, MeshDetail, Parameter, Setting,
    SettingError, Strategy, Tunable, Value, Verdict, Verdicts, ViewNodes, VisibleSet, assign,
    describe, query_detail,
};
use antumbra_graph::{BufferDesc, Host};

use antumbra_cull::order::by_nearest_corner;
use antumbra_scene::hierarchy::HierarchyShape;

use crate::query_results::query_results;
use crate::transparent::shade_transparent;
use crate::traversal::{QueryMode, Traversal, TraversalSettings, same_frame};

/// The strategy `stop-and-wait`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StopAndWait {
    /// Entities queried between two waits: 1 is the classic. Entities of one batch are not tested against each other.
    pub batch: u32,
    /// The tree to traverse, with a query a node; `None`: no tree, a query an entity.
    pub tree: Option<HierarchyShape>,
}

impl Default for StopAndWait {
    fn default() -> Self {
        Self {
            batch: 1,
            tree: None,
        }
    }
}

const PARAMETERS: &[Parameter<StopAndWait>] = &[
    Parameter::whole(
        "batch",
        1..=4096,
        "entities",
        "entities queried between two waits",
        |s| s.batch,
        |s, entities| s.batch = entities,
    ),
    Parameter::words(
        "tree",
        &["none", "groups", "boxes", "divided"],
        "the tree to traverse with a query a node: the scene's groups, a bounding volume hierarchy, or groups whose wide ones are divided",
        |s| s.tree.map_or("none", HierarchyShape::word),
        |s, at| s.tree = at.checked_sub(1).map(|at| HierarchyShape::ALL[at]),
    ),
];

/// The traversal of a tree: a query for every node in the frustum, without occupancy map and without memory.
const QUERY_PER_NODE: TraversalSettings = TraversalSettings {
    queries: QueryMode::Single,
    occupancy_map: false,
    ..TraversalSettings::PAPER
};

impl Tunable for StopAndWait {
    fn settings(&self) -> Vec<Setting> {
        describe(PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("stop-and-wait", PARAMETERS, self, key, value)
    }
}

/// The state of the loop.
#[derive(Debug, Default)]
struct Progress {
    /// Slots front to back.
    order: Vec<u32>,
    /// How many of them have been queried.
    queried: usize,
    /// The slots of the last batch of queries.
    batch: Vec<u32>,
}

/// What one iteration of the loop hands to the next.
#[derive(Clone, Copy)]
struct LoopState {
    progress: Host<Progress>,
    verdicts: Host<Verdicts>,
}

impl Strategy for StopAndWait {
    fn name(&self) -> &str {
        "stop-and-wait"
    }

    fn summary(&self) -> &str {
        "front to back, a query an entity, waited for, then its mesh"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::SameFrame)
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        if let Some(shape) = self.tree {
            if self.batch != 1 {
                return Err(DeclareError::Settings {
                    strategy: self.name().to_owned(),
                    conflict:
                        "a traversal queries one node at a time: set batch to 1, or tree to none"
                            .to_owned(),
                });
            }
            return Ok(same_frame::<Traversal>(g, view, shape, QUERY_PER_NODE));
        }
        let candidates = g.in_frustum(view);
        let mut state = begin(g, view, candidates);
        let batch = self.batch;
        g.host_loop(view.named("stop and wait"), |g| {
            iterate(g, view, &mut state, batch)
        });
        shade_transparent(g, view, state.verdicts);
        Ok(VisibleSet::drawn(state.verdicts))
    }
}

/// Sorts the candidates by the nearest corners of their bounds.
fn begin(g: &mut FrameGraph<'_>, view: &ViewNodes, candidates: Host<Candidates>) -> LoopState {
    let inputs = view.inputs();
    let progress = g.graph().host::<Progress>(view.named("progress"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("sort front to back"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(candidates);
    let state = LoopState {
        progress: node.write(progress),
        verdicts: node.write(verdicts),
    };
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let (mut progress, mut verdicts) =
            (ctx.get_mut(state.progress)?, ctx.get_mut(state.verdicts)?);
        verdicts.reset_outside(&scene.table);
        for slot in candidates.exempt() {
            verdicts.set(*slot, Verdict::Untested);
        }
        progress.queried = 0;
        progress.order.clear();
        progress.order.extend(candidates.testable());
        // The slots that no test may cull are drawn first, like a batch whose answers are known.
        progress.batch.clear();
        progress.batch.extend(candidates.exempt());
        by_nearest_corner(&mut progress.order, &scene.table, &frame);
        Ok(())
    });
    state
}

/// Declares one iteration: draw what the last answers showed visible, query the next `batch` entities, wait. Returns whether the loop is done.
fn iterate(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    state: &mut LoopState,
    batch: u32,
) -> Host<bool> {
    let inputs = view.inputs();
    let LoopState { progress, verdicts } = *state;
    let visible = g.unsubmitted(&view.named("draw list"));
    let queries = g.unsubmitted(&view.named("occludees to query"));
    let mut node = g.graph().host_node(view.named("choose the next batch"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(verdicts);
    let visible = visible.written_by(&mut node);
    let queries = queries.written_by(&mut node);
    let progress = node.write(progress);
    node.run(move |ctx| {
        let (scene, verdicts) = (ctx.get(inputs.scene)?, ctx.get(verdicts)?);
        let table = &scene.table;
        let (mut progress, mut visible_list, mut query_list) = (
            ctx.get_mut(progress)?,
            ctx.get_mut(visible.list)?,
            ctx.get_mut(queries.list)?,
        );
        let seen = |slot: &u32| verdicts.get(*slot).draws() && !table.is_transparent(*slot);
        visible_list.fill(
            table,
            progress.batch.iter().copied().filter(seen),
            MeshDetail::Level(0),
        );
        let next = progress.order.len().min(progress.queried + batch as usize);
        let Progress {
            order,
            queried,
            batch,
        } = &mut *progress;
        batch.clear();
        batch.extend_from_slice(order.get(*queried..next).unwrap_or_default());
        *queried = next;
        let frame = ctx.get(inputs.view)?;
        query_list.clear();
        for slot in batch.iter() {
            query_list.push(table, *slot, query_detail(table, &frame, *slot));
        }
        ctx.upload(visible.slots, 0, bytemuck::cast_slice(visible_list.slots()))?;
        ctx.upload(queries.slots, 0, bytemuck::cast_slice(query_list.slots()))?;
        Ok(())
    });
    g.shade_list(view, "draw visible", visible);
    let depth = view.targets.depth;
    let answers = g.graph().buffer(
        view.named("query results"),
        BufferDesc::new(u64::from(batch) * 8),
    );
    let answers = g.query(view, "query the next batch", queries, depth, answers);
    let done = g.graph().host::<bool>(view.named("done"));
    let mut node = g.graph().host_node(view.named("wait"));
    node.group(CULL).read(progress).read_back(answers);
    let (verdicts, done) = (node.write(verdicts), node.write(done));
    node.run(move |ctx| {
        let progress = ctx.get(progress)?;
        let mut verdicts = ctx.get_mut(verdicts)?;
        let results = query_results(ctx.bytes(answers)?);
        for (slot, visible) in progress.batch.iter().zip(results) {
            let verdict = match visible {
                true => Verdict::Visible,
                false => Verdict::Occluded,
            };
            verdicts.set(*slot, verdict);
        }
        verdicts.add_tested(progress.batch.len() as u32);
        *ctx.get_mut(done)? = progress.batch.is_empty();
        Ok(())
    });
    *state = LoopState { progress, verdicts };
    done
}
