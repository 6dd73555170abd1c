//! Stop and wait: front to back, one query an entity, its answer waited for, then its mesh. The classic, and the reason for all others.
//!
//! As the papers describe it before they improve on it: Plate et al. 2004, section 2; Staneker et al. 2004, section 2 (after Bartz,
//! Meissner and Huettner, *OpenGL-assisted occlusion culling for large polygonal models*, 1999). Each turn of the loop draws what the
//! last one found visible and asks about the next; its sync point is where the machine waits.

use antumbra_draw::passes::{self, PassSpec};
use antumbra_draw::{MeshDetail, PipelineKind};
use antumbra_graph::{BufferDesc, Host};

use antumbra_cull::order::by_nearest_corner;
use antumbra_cull::{
    CULL, Candidates, DRAW, DeclareError, FrameGraph, Latency, Parameter, Setting, SettingError,
    Strategy, Tunable, Value, Verdict, Verdicts, ViewNodes, VisibleSet, assign, describe,
    query_detail,
};
use antumbra_scene::hierarchy::HierarchyShape;

use crate::traversal::{QueryMode, TraversalSettings, same_frame, submit_transparent};

/// The strategy `stop-and-wait`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StopAndWait {
    /// Entities asked about between two waits: 1 is the classic. Entities of one batch are not tested against each other.
    pub batch: u32,
    /// A tree to be walked, a query a node; none: a query an entity.
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

/// How a tree is walked: no map, no memory, a query for every node in the frustum.
const A_QUERY_A_NODE: TraversalSettings = TraversalSettings {
    asking: QueryMode::Single,
    map: false,
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

/// Where the traversal stands.
#[derive(Debug, Default)]
struct Traversal {
    /// Slots front to back.
    order: Vec<u32>,
    /// How many of them have been asked about.
    asked: usize,
    /// Those of the last question.
    pending: Vec<u32>,
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
                        "a walk asks about one node at a time: set batch to 1, or tree to none"
                            .to_owned(),
                });
            }
            return Ok(same_frame(g, view, shape, A_QUERY_A_NODE));
        }
        let candidates = g.in_frustum(view);
        let (walk, verdicts) = begin(g, view, candidates);
        let kind = g.shaded_kind();
        let drawing = g.pass(view.named("draw the visible"), DRAW, kind);
        let asking = g.pass(view.named("ask about the next"), CULL, PipelineKind::Query);
        let mut ends = (walk, verdicts);
        let batch = self.batch;
        g.host_loop(view.named("stop and wait"), |g| {
            turn(g, view, &mut ends, &drawing, &asking, batch)
        });
        let verdicts = ends.1;
        if g.scene_layout().transparent {
            let list = g.unsubmitted(&view.named("visible transparent set"));
            let list = submit_transparent(g, view, verdicts, list);
            g.shade_list(view, "transparent", list);
        }
        Ok(VisibleSet::drawn(verdicts))
    }
}

/// Orders the candidates by the nearest corners of their bounds.
fn begin(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    candidates: Host<Candidates>,
) -> (Host<Traversal>, Host<Verdicts>) {
    let inputs = view.inputs();
    let walk = g.graph().host::<Traversal>(view.named("walk"));
    let verdicts = g.graph().host::<Verdicts>(view.named("verdicts"));
    let mut node = g.graph().host_node(view.named("sort front to back"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(candidates);
    let (walk, verdicts) = (node.write(walk), node.write(verdicts));
    node.run(move |ctx| {
        let (scene, frame, candidates) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(candidates)?,
        );
        let (mut walk, mut verdicts) = (ctx.get_mut(walk)?, ctx.get_mut(verdicts)?);
        verdicts.reset_outside(&scene.table);
        for slot in candidates.exempt() {
            verdicts.set(*slot, Verdict::Untested);
        }
        walk.asked = 0;
        walk.order.clear();
        walk.order.extend(candidates.testable());
        // What no test may judge is drawn first, as if a question about it had been answered.
        walk.pending.clear();
        walk.pending.extend(candidates.exempt());
        by_nearest_corner(&mut walk.order, &scene.table, &frame);
        Ok(())
    });
    (walk, verdicts)
}

/// One turn: draw what the last answers showed, ask about the next, wait.
fn turn(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    ends: &mut (Host<Traversal>, Host<Verdicts>),
    drawing: &PassSpec,
    asking: &PassSpec,
    batch: u32,
) -> Host<bool> {
    let inputs = view.inputs();
    let (walk, verdicts) = *ends;
    let draw = g.unsubmitted(&view.named("to draw"));
    let ask = g.unsubmitted(&view.named("to ask about"));
    let mut node = g.graph().host_node(view.named("next"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(verdicts);
    let draw = draw.written_by(&mut node);
    let ask = ask.written_by(&mut node);
    let walk = node.write(walk);
    node.run(move |ctx| {
        let (scene, verdicts) = (ctx.get(inputs.scene)?, ctx.get(verdicts)?);
        let table = &scene.table;
        let (mut walk, mut draw_list, mut ask_list) = (
            ctx.get_mut(walk)?,
            ctx.get_mut(draw.list)?,
            ctx.get_mut(ask.list)?,
        );
        let seen = |slot: &u32| verdicts.get(*slot).draws() && !table.is_transparent(*slot);
        draw_list.fill(
            table,
            walk.pending.iter().copied().filter(seen),
            MeshDetail::Level(0),
        );
        let next = walk.order.len().min(walk.asked + batch as usize);
        let Traversal {
            order,
            asked,
            pending,
        } = &mut *walk;
        pending.clear();
        pending.extend_from_slice(order.get(*asked..next).unwrap_or_default());
        *asked = next;
        let frame = ctx.get(inputs.view)?;
        ask_list.clear();
        for slot in pending.iter() {
            ask_list.push(table, *slot, query_detail(table, &frame, *slot));
        }
        ctx.upload(draw.slots, 0, bytemuck::cast_slice(draw_list.slots()))?;
        ctx.upload(ask.slots, 0, bytemuck::cast_slice(ask_list.slots()))?;
        Ok(())
    });
    view.targets = passes::shaded_pass(g.graph(), drawing, inputs, draw, view.targets);
    let depth = view.targets.depth;
    let answers = g
        .graph()
        .buffer(view.named("answers"), BufferDesc::new(u64::from(batch) * 8));
    let answers = passes::query_pass(g.graph(), asking, inputs, ask, depth, answers);
    let done = g.graph().host::<bool>(view.named("done"));
    let mut node = g.graph().host_node(view.named("wait"));
    node.group(CULL).read(walk).read_back(answers);
    let (verdicts, done) = (node.write(verdicts), node.write(done));
    node.run(move |ctx| {
        let walk = ctx.get(walk)?;
        let mut verdicts = ctx.get_mut(verdicts)?;
        let answers = ctx.bytes(answers)?;
        for (slot, answer) in walk.pending.iter().zip(answers.as_chunks::<8>().0) {
            let seen = u64::from_le_bytes(*answer) != 0;
            verdicts.set(
                *slot,
                if seen {
                    Verdict::Visible
                } else {
                    Verdict::Occluded
                },
            );
        }
        verdicts.add_tested(walk.pending.len() as u32);
        *ctx.get_mut(done)? = walk.pending.is_empty();
        Ok(())
    });
    *ends = (walk, verdicts);
    done
}
