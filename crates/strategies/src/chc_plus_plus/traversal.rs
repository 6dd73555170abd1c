//! The traversal of CHC++ that waits for its queries within the frame.
//!
//! Mattausch, Bittner, Wimmer, *CHC++: Coherent Hierarchical Culling Revisited*, 2008. What was visible in the last frame is drawn
//! without a wait, and some of it is queried for the next frame. Everything else is queried and waited for.

use antumbra_cull::boxes::BoxList;
use antumbra_cull::{Verdict, Verdicts};
use antumbra_scene::hierarchy::NONE;

use super::visibility::Visibility;
use crate::sketch::{NodeOutcome, Sketch};
use crate::traversal::{
    BatchOrganiser, Frontier, PendingNode, Purpose, QUERY_TRIANGLES, QuerySubject, QueuedNode,
    SharedQueries, TraversalContext, TraversalSettings, TreeVersion, Visit, VisitedNode,
    WaitingTraversal,
};

/// Batches of a frame after which all nodes are queried at once.
const ORGANISED: u32 = 8;

/// The state of a traversal. It is kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub(super) struct ChcTraversal {
    frontier: Frontier,
    visibility: Visibility,
    /// Nodes that were not visible in the last frame (the paper's i-queue).
    invisible: Vec<PendingNode>,
    /// Leaves that were visible, to be queried beside the next batch (the paper's v-queue).
    visible: Vec<PendingNode>,
    /// Nodes of the present batch.
    queried: Vec<PendingNode>,
    /// The queries of the present batch, about the nodes in `queried`.
    queries: SharedQueries,
    organiser: BatchOrganiser,
    /// Batches of this frame so far.
    batches: u32,
    sketch: Sketch,
}

impl WaitingTraversal for ChcTraversal {
    fn begin(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        cuts: u64,
        verdicts: &mut Verdicts,
    ) {
        self.batches = 0;
        self.organiser.begin(context.screen.blocks());
        self.invisible.clear();
        self.visible.clear();
        self.queried.clear();
        self.visibility.begin(TreeVersion::new(context.tree, cuts));
        self.sketch.begin(settings.sketch, settings.block);
        self.frontier.begin(context, verdicts);
    }

    fn advance(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    ) {
        boxes.clear();
        while let Some(next) = self.frontier.next() {
            self.visit(context, settings, next, verdicts);
        }
        if self.batches == 0 {
            self.sketch.map(&self.frontier.covered);
        }
        if !pays(&self.invisible, context, settings) {
            for pending in self.invisible.drain(..) {
                (self.frontier).draw(context, &pending.visited, Verdict::Untested, verdicts);
                // Its parent is opened in the next frame too, and the node itself is queried with all others.
                let parent = context.node(pending.visited.node).map(|node| node.parent);
                (self.visibility).pull_up(context.tree.hierarchy(), parent.unwrap_or(NONE));
            }
        }
        self.fill_batch(context, settings);
        let mut queried = std::mem::take(&mut self.queried);
        let mut queries = std::mem::take(&mut self.queries);
        queries.clear();
        queried.sort_unstable_by_key(|pending| self.subject(pending).place(settings.sharing));
        queried.retain(|pending| {
            let fits = queries.push(context, settings, self.subject(pending), boxes);
            if !fits && pending.purpose != Purpose::Retest {
                self.expand(
                    context,
                    settings,
                    &pending.visited,
                    Verdict::Untested,
                    verdicts,
                );
            }
            fits
        });
        self.batches += u32::from(!queried.is_empty());
        (self.queried, self.queries) = (queried, queries);
        verdicts.add_tested(boxes.query_count());
    }

    fn found(&mut self) -> &mut Vec<u32> {
        &mut self.frontier.found
    }

    fn answer(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        answers: impl Iterator<Item = bool>,
    ) {
        let queried = std::mem::take(&mut self.queried);
        let queries = std::mem::take(&mut self.queries);
        for (members, seen) in queries.answered(&queried, answers) {
            if seen && members.len() > 1 {
                // At least one of them is visible: each gets a query of its own.
                self.invisible
                    .extend(members.iter().map(PendingNode::alone));
                continue;
            }
            for pending in members {
                self.apply(context, settings, verdicts, pending, seen);
            }
        }
        (self.queries, self.queried) = (queries, queried);
        self.queried.clear();
    }

    fn is_done(&self) -> bool {
        self.queried.is_empty() && self.invisible.is_empty() && self.frontier.is_done()
    }

    fn sketch(&self) -> &Sketch {
        &self.sketch
    }
}

impl ChcTraversal {
    fn visit(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        next: QueuedNode,
        verdicts: &mut Verdicts,
    ) {
        let (visited, node) = match context.visit(next, settings.small) {
            Visit::Outside => return,
            Visit::Near(visited) => {
                return self.expand(context, settings, &visited, Verdict::Untested, verdicts);
            }
            Visit::Small(visited) => {
                return context.mark(&visited, Verdict::BelowThreshold, verdicts);
            }
            Visit::OnScreen(visited, node) => (visited, node),
        };
        let pending = |purpose| PendingNode {
            distance_squared: next.distance_squared,
            visited,
            purpose,
        };
        let unknown = self.visibility.hidden_for(next.node) == 0;
        let reaches_free_block =
            || settings.occupancy_map && unknown && self.frontier.is_free(visited.blocks);
        let was_visible = self.visibility.was_visible(next.node);
        if was_visible || reaches_free_block() {
            self.sketch
                .node(&context.screen, &node.bounds, 0, NodeOutcome::Free);
            let is_leaf = context.is_unit(next.node, node);
            if was_visible && is_leaf && self.visibility.is_due(next.node) {
                self.visible.push(pending(Purpose::Retest));
            }
            self.expand(context, settings, &visited, Verdict::Visible, verdicts);
        } else {
            self.invisible.push(pending(Purpose::Find));
        }
    }

    /// Draws a unit, which is then visible in the next frame too, or opens an inner node.
    fn expand(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        visited: &VisitedNode,
        verdict: Verdict,
        verdicts: &mut Verdicts,
    ) {
        (self.frontier).expand(context, visited, verdict, verdicts);
        if (context.node(visited.node)).is_some_and(|node| context.is_unit(visited.node, node)) {
            let tree = context.tree.hierarchy();
            self.visibility.show(tree, settings, visited.node);
        }
    }

    /// Chooses the nodes of the next batch: all that have been hidden, the nearest of the others, and with them the leaves that are tested again. These
    /// make a batch of their own only where it may pay.
    fn fill_batch(&mut self, context: &TraversalContext<'_>, settings: &TraversalSettings) {
        self.queried.clear();
        let visibility = &self.visibility;
        let stays_hidden = |pending: &PendingNode| {
            pending.purpose == Purpose::FindAlone || visibility.hidden_for(pending.visited.node) > 0
        };
        self.queried.extend(
            self.invisible
                .extract_if(.., |pending| stays_hidden(pending)),
        );
        if self.batches < ORGANISED {
            // The nearest nodes come first: what of them is visible hides others, which are tested after they are drawn.
            (self.organiser).choose(
                &mut self.invisible,
                &mut self.queried,
                settings.batch as usize,
            );
        } else {
            self.queried.append(&mut self.invisible);
        }
        if !self.queried.is_empty() || pays(&self.visible, context, settings) {
            self.queried.append(&mut self.visible);
        }
    }

    /// What is queried about a node, and with which others.
    fn subject(&self, pending: &PendingNode) -> QuerySubject {
        let node = pending.visited.node;
        QuerySubject {
            node,
            hidden_for: match pending.purpose {
                Purpose::Find => self.visibility.hidden_for(node),
                Purpose::FindAlone | Purpose::Retest => 0,
            },
        }
    }

    /// Applies the answer about one node.
    fn apply(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        pending: &PendingNode,
        seen: bool,
    ) {
        let number = pending.visited.node;
        let Some(node) = context.node(number) else {
            return;
        };
        let outcome = NodeOutcome::of_query(seen);
        (self.sketch).node(&context.screen, &node.bounds, self.batches, outcome);
        match (pending.purpose, seen) {
            (Purpose::Retest, true) => self.visibility.confirm(settings, number),
            (Purpose::Retest, false) => self.visibility.found_hidden(number),
            (_, true) => {
                if !context.is_unit(number, node) {
                    self.visibility.open(number);
                }
                self.expand(
                    context,
                    settings,
                    &pending.visited,
                    Verdict::Visible,
                    verdicts,
                );
            }
            (_, false) => {
                self.visibility.found_hidden(number);
                context.mark(&pending.visited, Verdict::Occluded, verdicts);
            }
        }
    }
}

/// Whether nodes hold so many triangles that a wait for queries about them may save more than it costs.
fn pays(
    nodes: &[PendingNode],
    context: &TraversalContext<'_>,
    settings: &TraversalSettings,
) -> bool {
    let weights = nodes.iter();
    let triangles: u64 = weights
        .map(|pending| u64::from(context.tree.weight(pending.visited.node)))
        .sum();
    let queries = nodes.len() as u64;
    settings.worth == 0 || triangles > queries * QUERY_TRIANGLES + u64::from(settings.worth)
}
