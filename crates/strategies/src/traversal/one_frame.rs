//! A traversal that waits for its queries within the frame.
//!
//! Staneker, Bartz, Strasser, *Efficient Multiple Occlusion Queries for Scene Graph Systems*, 2004, section 4.2. Three things go beyond the
//! paper and are off in [`TraversalSettings::PAPER`](super::TraversalSettings::PAPER): answers that stay valid for some frames, queries shared
//! by neighbours in the tree, and nodes that are drawn because a wait for them cannot pay.

use antumbra_cull::boxes::BoxList;

use super::context::{QueuedNode, TraversalContext, Visit, VisitedNode};
use super::frontier::Frontier;
use super::memory::NodeMemory;
use super::pending::{BatchOrganiser, PendingNode, Purpose};
use super::settings::{QueryMode, TraversalSettings};
use super::shared_queries::{QuerySubject, SharedQueries};
use super::waiting::WaitingTraversal;
use crate::sketch::{NodeOutcome, Sketch};
use antumbra_cull::{Verdict, Verdicts};

/// The state of a traversal. It is kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub struct Traversal {
    frontier: Frontier,
    /// Nodes that need a query and are not in the present batch.
    waiting: Vec<PendingNode>,
    /// Nodes of the present batch.
    queried: Vec<PendingNode>,
    /// The queries of the present batch, about the nodes in `queried`.
    queries: SharedQueries,
    organiser: BatchOrganiser,
    memory: NodeMemory,
    /// Batches of this frame so far.
    batches: u32,
    /// Most organised batches of this frame.
    most_organised: Option<u32>,
    sketch: Sketch,
}

/// The cost of a query, in triangles (section 2 of the paper, after Severson).
pub(crate) const QUERY_TRIANGLES: u64 = 190;

/// Organised batches of the first frame. Every later frame organises 7/10 as many batches as the last frame had.
const FIRST_ORGANISED: u32 = 8;

impl WaitingTraversal for Traversal {
    fn begin(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        cuts: u64,
        verdicts: &mut Verdicts,
    ) {
        let last = std::mem::take(&mut self.batches);
        self.most_organised = Some(match self.most_organised {
            Some(_) => last * 7 / 10,
            None => FIRST_ORGANISED,
        });
        self.waiting.clear();
        self.queried.clear();
        self.organiser.begin(context.screen.blocks());
        self.memory
            .begin(context.tree, context.table, cuts, &context.screen);
        self.sketch.begin(settings.sketch, settings.block);
        self.frontier.begin(context, verdicts);
    }

    fn found(&mut self) -> &mut Vec<u32> {
        &mut self.frontier.found
    }

    fn advance(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    ) {
        boxes.clear();
        self.queried.clear();
        self.visit_all(context, settings, verdicts);
        if settings.worth > 0 {
            self.draw_where_queries_do_not_pay(context, settings, verdicts);
        }
        if self.batches == 0 {
            self.sketch.map(&self.frontier.covered);
        }
        match settings.queries {
            QueryMode::Single => self.queried.append(&mut self.waiting),
            QueryMode::Batches => self.organise(settings),
        }
        self.batches += u32::from(!self.queried.is_empty());
        let mut queried = std::mem::take(&mut self.queried);
        let mut queries = std::mem::take(&mut self.queries);
        queries.clear();
        queried.sort_unstable_by_key(|waiting| self.subject(waiting).place(settings.sharing));
        queried.retain(|waiting| {
            let subject = self.subject(waiting);
            let fits = queries.push(context, settings, subject, boxes);
            if !fits {
                self.frontier
                    .expand(context, &waiting.visited, Verdict::Untested, verdicts);
            }
            fits
        });
        (self.queried, self.queries) = (queried, queries);
        verdicts.add_tested(boxes.query_count());
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
        let mut seen = 0;
        for (members, visible) in queries.answered(&queried, answers) {
            seen += usize::from(visible) * members.len();
            if visible && members.len() > 1 {
                // At least one of them is visible: each gets a query of its own.
                self.waiting.extend(members.iter().map(PendingNode::alone));
                continue;
            }
            for waiting in members {
                self.apply(context, settings, verdicts, &waiting.visited, visible);
            }
        }
        if (seen as f32) < settings.least_seen * queried.len() as f32 {
            self.most_organised = Some(0);
        }
        (self.queries, self.queried) = (queries, queried);
        self.queried.clear();
    }

    fn is_done(&self) -> bool {
        self.queried.is_empty() && self.waiting.is_empty() && self.frontier.is_done()
    }

    fn sketch(&self) -> &Sketch {
        &self.sketch
    }
}

impl Traversal {
    /// What is queried about a node, and with which others.
    fn subject(&self, waiting: &PendingNode) -> QuerySubject {
        let node = waiting.visited.node;
        QuerySubject {
            node,
            hidden_for: u32::from(waiting.purpose == Purpose::Find && self.memory.was_hidden(node)),
        }
    }

    /// Applies the answer about one node.
    fn apply(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
        visited: &VisitedNode,
        visible: bool,
    ) {
        self.memory.store(visited.node, visible, settings.lifetime);
        if let Some(node) = context.node(visited.node) {
            let outcome = NodeOutcome::of_query(visible);
            (self.sketch).node(&context.screen, &node.bounds, self.batches, outcome);
        }
        match visible {
            true => (self.frontier).expand(context, visited, Verdict::Visible, verdicts),
            false => context.mark(visited, Verdict::Occluded, verdicts),
        }
    }

    /// Visits all queued nodes. With single queries it stops at the first node that needs one.
    fn visit_all(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
    ) {
        while let Some(next) = self.frontier.next() {
            self.visit(context, settings, next, verdicts);
            if settings.queries == QueryMode::Single && !self.waiting.is_empty() {
                break;
            }
        }
    }

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
                (self.frontier).expand(context, &visited, Verdict::Untested, verdicts);
                return;
            }
            Visit::Small(visited) => {
                return context.mark(&visited, Verdict::BelowThreshold, verdicts);
            }
            Visit::OnScreen(visited, node) => (visited, node),
        };
        let remembered = (self.memory).valid(next.node, next.distance_squared, settings.lifetime);
        let reaches_free_block = || settings.occupancy_map && self.frontier.is_free(visited.blocks);
        if remembered == Some(false) {
            context.mark(&visited, Verdict::Occluded, verdicts);
        } else if remembered.is_some() || reaches_free_block() {
            self.sketch
                .node(&context.screen, &node.bounds, 0, NodeOutcome::Free);
            self.frontier
                .expand(context, &visited, Verdict::Visible, verdicts);
        } else {
            self.waiting.push(PendingNode {
                distance_squared: next.distance_squared,
                visited,
                purpose: Purpose::Find,
            });
        }
    }

    /// Draws all waiting nodes if culling every one of them would save less than their queries cost. A node that its last query found visible
    /// does not count as a possible saving: it is taken for visible again, and its children wait in its place.
    fn draw_where_queries_do_not_pay(
        &mut self,
        context: &TraversalContext<'_>,
        settings: &TraversalSettings,
        verdicts: &mut Verdicts,
    ) {
        loop {
            let was_visible = |waiting: &PendingNode| self.memory.was_visible(waiting.visited.node);
            let (mut queries, mut triangles) = (0, 0);
            for waiting in self.waiting.iter().filter(|waiting| !was_visible(waiting)) {
                queries += 1;
                triangles += u64::from(context.tree.weight(waiting.visited.node));
            }
            if triangles > queries * QUERY_TRIANGLES + u64::from(settings.worth) {
                return;
            }
            let visible: Vec<PendingNode> = self
                .waiting
                .extract_if(.., |waiting| was_visible(waiting))
                .collect();
            if visible.is_empty() {
                break;
            }
            for waiting in &visible {
                self.frontier
                    .expand(context, &waiting.visited, Verdict::Visible, verdicts);
            }
            self.visit_all(context, settings, verdicts);
        }
        for waiting in self.waiting.drain(..) {
            self.frontier
                .draw(context, &waiting.visited, Verdict::Untested, verdicts);
        }
    }

    /// Chooses the next batch. While organised batches are left: the nearest waiting nodes whose boxes each reach a block that no other box of the batch
    /// covers. After that: all waiting nodes.
    fn organise(&mut self, settings: &TraversalSettings) {
        if self.batches >= self.most_organised.unwrap_or(0) {
            self.queried.append(&mut self.waiting);
            return;
        }
        (self.organiser).choose(
            &mut self.waiting,
            &mut self.queried,
            settings.batch as usize,
        );
    }
}
