//! A traversal that never waits. It uses the answers of earlier frames, draws every node that has no answer, and issues queries whose answers a
//! later frame uses.
//!
//! Staneker et al. 2004 leave coherence in time to future work (section 6.1). This form follows Bittner, Wimmer, Piringer, Purgathofer,
//! *Coherent Hierarchical Culling: Hardware Occlusion Queries Made Useful*, 2004: an answer about an inner node holds for all nodes below it. It is pulled up when
//! all children of a node are occluded, and refined when the node becomes visible.

use std::sync::Arc;

use antumbra_cull::boxes::BoxList;

use super::context::{QueuedNode, TraversalContext, Visit, VisitedNode};
use super::eye_path::EyePath;
use super::frontier::Frontier;
use super::settings::{Retests, TraversalSettings};
use super::shared_queries::{QuerySubject, SharedQueries};
use crate::sketch::{NodeOutcome, Sketch};
use antumbra_cull::{Tree, Verdict, Verdicts};

/// What answers belong to. An answer about another tree, or from before a camera cut, is dropped.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TreeVersion {
    /// The tree's [generation](antumbra_cull::Tree::generation).
    pub generation: u64,
    /// Camera cuts of the view so far.
    pub cuts: u64,
}

impl TreeVersion {
    /// The version of a tree after this many camera cuts of its view.
    pub fn new(tree: &Tree, cuts: u64) -> Self {
        Self {
            generation: tree.generation(),
            cuts,
        }
    }
}

/// The nodes of one frame's queries. They travel with the answers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct QueriedNodes {
    /// The tree and the camera cut of the queries.
    pub version: TreeVersion,
    /// The frame of the queries, in the traversal's own count.
    pub frame: u32,
    /// The nodes, in the order of the queries.
    pub nodes: Arc<Vec<u32>>,
    /// For each query, the end of its nodes in `nodes`.
    pub ends: Arc<Vec<u32>>,
}

/// What is known of a node.
#[derive(Debug, Clone, Copy, Default)]
struct NodeState {
    visible: bool,
    /// The frame of the last query that has an answer; 0: there is none.
    queried: u32,
    /// The frame of the first of the answers "occluded" that followed each other.
    hidden_since: u32,
    /// The first frame in which it is queried again.
    query_from: u32,
    /// Until this frame it does not become occluded by the answers about its children.
    open_until: u32,
    /// Until this frame it shares no query.
    alone_until: u32,
    /// The length of the eye's path at the answer, in metres.
    travelled: f64,
}

/// The state of a late traversal. It is kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub struct LateTraversal {
    nodes: Vec<NodeState>,
    version: Option<TreeVersion>,
    frame: u32,
    path: EyePath,
    frontier: Frontier,
    /// The nodes of this frame's queries.
    queried: Vec<u32>,
    queries: SharedQueries,
    /// A record of the traversal, where the settings ask for one.
    pub sketch: Sketch,
}

/// Frames after which an answer "occluded" is too old to cull anything, at least. An answer is under way as long as there are frames in flight, and so is the next one, that is asked for when it is there.
const EXPIRY: u32 = 4;
/// Frames for which a node that has become visible stays open although all its children are occluded. Also the frames for which a node shares no query
/// after a shared query found a sample.
const HOLD: u32 = 32;
/// A node that covers this part of the screen (1 / `LARGE`) is opened instead of queried: some of it is nearly always visible.
const LARGE: u64 = 8;
/// A node without an answer and with more triangles than this is opened instead of queried: all of it would be drawn until the answer is there.
const HEAVY: u32 = 20_000;
/// A node with more triangles than this is not queried in place of its occluded children. When it becomes visible, the nodes below it have
/// no recent answers, and all of them are drawn until they have.
const UNWIELDY: u32 = 100_000;

impl LateTraversal {
    /// Starts a frame. Answers about another tree, or from before a camera cut, are dropped. `cuts`: camera cuts of the view so far.
    pub fn begin(&mut self, context: &TraversalContext<'_>, cuts: u64) {
        self.frame += 1;
        let now = TreeVersion::new(context.tree, cuts);
        if self.version != Some(now) {
            self.nodes.clear();
            self.path.restart();
            self.version = Some(now);
        }
        self.path.advance(context.screen.eye());
    }

    /// Takes the answers of an earlier frame, in the order of its queries: whether any sample was visible.
    pub fn take(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        queried: &QueriedNodes,
        answers: impl Iterator<Item = bool>,
    ) {
        if self.version != Some(queried.version) {
            return;
        }
        let mut first = 0;
        for (end, visible) in queried.ends.iter().zip(answers) {
            let nodes = queried.nodes.get(first..*end as usize).unwrap_or_default();
            first = *end as usize;
            for node in nodes {
                self.store(settings, queried.frame, *node, visible);
                if visible && nodes.len() > 1 {
                    // At least one of them is visible: each gets a query of its own.
                    let frame = self.frame;
                    let state = self.state_mut(*node);
                    (state.query_from, state.alone_until) = (frame, frame + HOLD);
                }
            }
        }
        for node in queried.nodes.iter() {
            self.pull_up(context, settings, *node);
        }
    }

    /// Visits the tree from its roots: finds the slots to be drawn, gives verdicts, and writes the boxes of this frame's queries.
    pub fn traverse(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    ) {
        boxes.clear();
        self.queried.clear();
        self.sketch.begin(settings.sketch, settings.block);
        self.frontier.begin(context, verdicts);
        while let Some(next) = self.frontier.next() {
            self.visit(context, settings, next, verdicts);
        }
        self.sketch.map(&self.frontier.covered);
        self.write_queries(context, settings, boxes);
        verdicts.add_tested(boxes.query_count());
    }

    /// The slots to be drawn.
    pub fn found(&mut self) -> &mut Vec<u32> {
        &mut self.frontier.found
    }

    /// The nodes of this frame's queries, to travel with the answers.
    pub fn queried(&mut self) -> QueriedNodes {
        QueriedNodes {
            version: self.version.unwrap_or_default(),
            frame: self.frame,
            nodes: Arc::new(std::mem::take(&mut self.queried)),
            ends: Arc::new(self.queries.ends().to_vec()),
        }
    }

    /// Stores the answer of a query of frame `queried`.
    fn store(&mut self, settings: &TraversalSettings, queried: u32, node: u32, visible: bool) {
        let was_hidden = self.is_hidden(node, settings);
        let travelled = self.path.length();
        let frame = self.frame;
        let state = self.state_mut(node);
        // Lifetimes differ, so that the nodes of one frame do not all need a query in the same frame again.
        let frames = match visible {
            true => {
                let first = state.queried == 0 || !state.visible;
                let lifetime = settings.lifetime.visible;
                (settings.retests).frames_to_next(lifetime, node, frame, first)
            }
            false => Retests::Spread.frames_to_next(settings.lifetime.occluded, node, frame, true),
        };
        if !was_hidden {
            state.hidden_since = queried;
        }
        state.query_from = frame + frames;
        (state.visible, state.queried, state.travelled) = (visible, queried, travelled);
        if visible && was_hidden {
            state.open_until = frame + HOLD;
        }
    }

    /// Marks the ancestors of a node as occluded, as far up as all their children are.
    fn pull_up(&mut self, context: &TraversalContext<'_>, settings: &TraversalSettings, node: u32) {
        let mut at = node;
        while self.is_hidden(at, settings)
            && let Some(parent) = context.node(at).map(|node| node.parent)
            && let Some(above) = context.node(parent)
        {
            let held = self
                .nodes
                .get(parent as usize)
                .is_some_and(|state| state.open_until > self.frame);
            let unwieldy = context.tree.weight(parent) > UNWIELDY;
            let is_hidden = |child| self.is_hidden(child, settings);
            if held || unwieldy || !above.children().all(is_hidden) {
                return;
            }
            let states = above
                .children()
                .filter_map(|child| self.nodes.get(child as usize).copied());
            // The answer about the parent is as old as the oldest about its children.
            let oldest = states.min_by_key(|state| state.queried).unwrap_or_default();
            let frame = self.frame;
            let state = self.state_mut(parent);
            (state.visible, state.queried, state.query_from) = (false, oldest.queried, frame);
            state.hidden_since = oldest.queried;
            state.travelled = oldest.travelled;
            at = parent;
        }
    }

    fn state_mut(&mut self, node: u32) -> &mut NodeState {
        let at = node as usize;
        if self.nodes.len() <= at {
            self.nodes.resize(at + 1, NodeState::default());
        }
        &mut self.nodes[at]
    }

    /// Whether a node is occluded by an answer that has not expired.
    fn is_hidden(&self, node: u32, settings: &TraversalSettings) -> bool {
        let Some(state) = self.nodes.get(node as usize) else {
            return false;
        };
        let expiry = EXPIRY.max(2 * settings.in_flight) + settings.lifetime.occluded;
        state.queried > 0 && !state.visible && state.queried + expiry >= self.frame
    }

    fn visit(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        next: QueuedNode,
        verdicts: &mut Verdicts,
    ) {
        let number = next.node;
        let (visited, node) = match context.visit(next, settings.small) {
            Visit::Outside => return,
            Visit::Near(visited) => {
                (self.frontier).expand(context, &visited, Verdict::Untested, verdicts);
                return;
            }
            Visit::Small(visited) => {
                return context.mark(&visited, Verdict::BelowThreshold, verdicts);
            }
            Visit::OnScreen(visited, node) => (visited, node),
        };
        let state = self.nodes.get(number as usize).copied().unwrap_or_default();
        if settings.occupancy_map && self.frontier.is_free(visited.blocks) {
            self.sketch
                .node(&context.screen, &node.bounds, 0, NodeOutcome::Free);
            let verdict = match state.queried {
                0 => Verdict::Untested,
                _ => Verdict::Visible,
            };
            self.frontier.expand(context, &visited, verdict, verdicts);
            return;
        }
        let travelled = self.path.length() - state.travelled;
        let slow = (settings.lifetime).is_slow(travelled, next.distance_squared);
        let needs_query = state.query_from <= self.frame || !slow;
        let hidden = self.is_hidden(number, settings);
        self.sketch.node(
            &context.screen,
            &node.bounds,
            u32::from(needs_query),
            NodeOutcome::of_query(!hidden),
        );
        if hidden {
            context.mark(&visited, Verdict::Occluded, verdicts);
        } else if context.is_unit(number, node) {
            let verdict = match state.queried {
                0 => Verdict::New,
                _ => Verdict::Visible,
            };
            self.frontier.expand(context, &visited, verdict, verdicts);
        } else if state.visible || is_better_opened(context, &visited) {
            // Its children are queried in its place. A node whose answer "occluded" has expired counts as one without an answer.
            self.frontier
                .expand(context, &visited, Verdict::Visible, verdicts);
            return;
        } else {
            self.frontier
                .draw(context, &visited, Verdict::New, verdicts);
        }
        if needs_query {
            self.queried.push(number);
        }
    }

    /// Writes the boxes of the nodes to be queried. Nodes that are occluded share queries.
    fn write_queries(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        boxes: &mut BoxList,
    ) {
        let mut queried = std::mem::take(&mut self.queried);
        let mut queries = std::mem::take(&mut self.queries);
        queries.clear();
        queried.sort_unstable_by_key(|node| self.subject(*node, settings).place(settings.sharing));
        queried.retain(|node| {
            let subject = self.subject(*node, settings);
            queries.push(context, settings, subject, boxes)
        });
        (self.queried, self.queries) = (queried, queries);
    }

    /// What is queried about a node, and with which others.
    fn subject(&self, node: u32, settings: &TraversalSettings) -> QuerySubject {
        let state = self.nodes.get(node as usize).copied().unwrap_or_default();
        let shares = self.is_hidden(node, settings) && state.alone_until <= self.frame;
        QuerySubject {
            node,
            hidden_for: match shares {
                true => state.queried - state.hidden_since.min(state.queried) + 1,
                false => 0,
            },
        }
    }
}

/// Whether a node without a valid answer is opened instead of queried.
fn is_better_opened(context: &TraversalContext<'_>, visited: &VisitedNode) -> bool {
    let [wide, high] = context.screen.blocks().map(u64::from);
    visited.blocks.count() * LARGE >= wide * high || context.tree.weight(visited.node) > HEAVY
}
