//! A walk in one frame: who is met, what is drawn at once, and who is asked about together.

use antumbra_draw::boxes::BoxList;

use super::context::{TraversalContext, Visit, VisitedNode};
use super::frontier::Frontier;
use super::memory::{AnswerLifetime, Memory};
use super::queue::QueuedNode;
use crate::occupancy::OccupancyMap;
use crate::sketch::{NodeOutcome, Sketch};
use antumbra_cull::{Verdict, Verdicts};

/// In what portions a walk asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QueryMode {
    /// In batches whose boxes each reach a block of the screen that no other of the batch lies on; when there were enough of these, about
    /// all who wait at once.
    Batches,
    /// A node at a time.
    Single,
}

/// In what order a batch's entities are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawOrder {
    /// By pipeline, texture and mesh, as few draws as there can be.
    State,
    /// As they were found, near ones first.
    Depth,
}

/// How a walk goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraversalSettings {
    /// In what portions it asks.
    pub asking: QueryMode,
    /// Whether what reaches a free block of the map is visible without a query.
    pub map: bool,
    /// Pixels along a side of a block.
    pub block: u32,
    /// Triangles below a node that is not opened.
    pub grain: u32,
    /// Pixels in width and height below which a sub-tree is dropped; 0: none is.
    pub small: f32,
    /// The part of a batch that must come out visible for the next one to be organised too.
    pub least_seen: f32,
    /// Up to how many neighbours in the tree that were hidden a frame ago share a question.
    pub together: u32,
    /// Triangles that waiting must be able to save, beside those that the questions cost: where those who wait have no more, they are drawn
    /// without a question. 0: whoever waits is asked about.
    pub worth: u32,
    /// How long answers stay valid.
    pub remember: AnswerLifetime,
    /// In what order a batch's entities are drawn.
    pub order: DrawOrder,
    /// Whether it leaves a sketch.
    pub sketch: bool,
}

impl TraversalSettings {
    /// The paper's walk and nothing beyond it.
    pub const PAPER: Self = Self {
        asking: QueryMode::Batches,
        map: true,
        block: 4,
        grain: 0,
        small: 0.0,
        least_seen: 0.0,
        together: 1,
        worth: 0,
        remember: AnswerLifetime {
            visible: 0,
            occluded: 0,
            slow: 0.0,
        },
        order: DrawOrder::State,
        sketch: false,
    };
}

/// A node that waits for an answer.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    nearness: f32,
    met: VisitedNode,
    /// Whether it was asked about together with others, and one of them was visible.
    alone: bool,
}

/// A walk; kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub struct Traversal {
    front: Frontier,
    waiting: Vec<Waiting>,
    asked: Vec<Waiting>,
    /// Where the members of each question end.
    ends: Vec<u32>,
    spare: Vec<Waiting>,
    /// Blocks that a box of the present batch lies on.
    asked_on: OccupancyMap,
    memory: Memory,
    batches: u32,
    most_organised: Option<u32>,
    /// What was met on the way, where a sketch was asked for.
    pub sketch: Sketch,
}

/// What a query costs, in triangles (the paper's section 2, after Severson).
const A_QUERY: u64 = 190;

/// Organised batches of the first frame; after that 7/10 of the last frame's batches.
const FIRST_ORGANISED: u32 = 8;

impl Traversal {
    /// Begins a frame at the roots.
    pub fn begin(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        cuts: u64,
        verdicts: &mut Verdicts,
    ) {
        let last = std::mem::take(&mut self.batches);
        self.most_organised = Some(match self.most_organised {
            Some(_) => last * 7 / 10,
            None => FIRST_ORGANISED,
        });
        self.waiting.clear();
        self.asked.clear();
        let [wide, high] = sight.screen.blocks();
        self.asked_on.reset(wide, high);
        self.memory
            .begin(sight.tree, sight.table, cuts, &sight.screen);
        self.sketch.begin(how.sketch, how.block);
        self.front.begin(sight, verdicts);
    }

    /// The slots found since they were last taken away from here, to be drawn.
    pub fn found(&mut self) -> &mut Vec<u32> {
        &mut self.front.found
    }

    /// Goes on until there is something to ask, and says what: a box a question. None: the walk is over.
    pub fn advance(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    ) {
        boxes.clear();
        self.asked.clear();
        self.meet_all(sight, how, verdicts);
        if how.worth > 0 {
            self.draw_what_is_not_worth_asking(sight, how, verdicts);
        }
        if self.batches == 0 {
            self.sketch.map(&self.front.drawn_on);
        }
        if how.asking == QueryMode::Single {
            self.asked.append(&mut self.waiting);
        } else {
            self.gather();
        }
        self.batches += u32::from(!self.asked.is_empty());
        let mut asked = std::mem::take(&mut self.asked);
        // Siblings, and children of siblings, are neighbours by number.
        asked.sort_unstable_by_key(|waiting| waiting.met.node);
        let (mut last, mut shared) = (false, 1);
        asked.retain(|waiting| {
            let Some(question) = sight.question(waiting.met.node) else {
                self.front
                    .see(sight, &waiting.met, Verdict::Untested, verdicts);
                return false;
            };
            let hidden = !waiting.alone && self.memory.was_hidden(waiting.met.node);
            let joined = hidden && last && shared < how.together;
            shared = if joined { shared + 1 } else { 1 };
            last = hidden;
            match joined {
                true => boxes.push_to_last(question),
                false => boxes.push(question),
            }
            true
        });
        self.asked = asked;
        self.ends.clear();
        self.ends.extend_from_slice(boxes.query_ends());
        verdicts.add_tested(boxes.query_count());
    }

    /// Takes the answers, in the order of the questions: whether any sample was visible.
    pub fn answer(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        verdicts: &mut Verdicts,
        answers: impl Iterator<Item = bool>,
    ) {
        let asked = std::mem::take(&mut self.asked);
        let ends = std::mem::take(&mut self.ends);
        let (mut first, mut seen) = (0, 0);
        // Of what there is no answer about, nothing may be left out.
        let answers = answers.chain(std::iter::repeat(true));
        for (end, visible) in ends.iter().zip(answers) {
            let members = asked.get(first..*end as usize).unwrap_or_default();
            first = *end as usize;
            seen += usize::from(visible) * members.len();
            let together = visible && members.len() > 1;
            for waiting in members {
                let met = &waiting.met;
                if together {
                    // One of them at least is visible; which, each has to say for itself.
                    self.waiting.push(Waiting {
                        alone: true,
                        ..*waiting
                    });
                    continue;
                }
                self.memory.note(met.node, visible, how.remember);
                if let Some(node) = sight.node(met.node) {
                    let outcome = if visible {
                        NodeOutcome::Visible
                    } else {
                        NodeOutcome::Occluded
                    };
                    let screen = &sight.screen;
                    (self.sketch).node(screen, &node.bounds, self.batches, outcome);
                }
                match visible {
                    true => self.front.see(sight, met, Verdict::Visible, verdicts),
                    false => sight.mark(met, Verdict::Occluded, verdicts),
                }
            }
        }
        if (seen as f32) < how.least_seen * asked.len() as f32 {
            self.most_organised = Some(0);
        }
        (self.ends, self.asked) = (ends, asked);
        self.asked.clear();
    }

    /// Whether nothing is left to be asked.
    pub fn is_over(&self) -> bool {
        self.asked.is_empty() && self.waiting.is_empty() && self.front.is_over()
    }

    /// Meets all who are queued; one at a time until one has to wait where each is asked about alone.
    fn meet_all(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        verdicts: &mut Verdicts,
    ) {
        while let Some(next) = self.front.next() {
            self.meet(sight, how, next, verdicts);
            if how.asking == QueryMode::Single && !self.waiting.is_empty() {
                break;
            }
        }
    }

    fn meet(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        next: QueuedNode,
        verdicts: &mut Verdicts,
    ) {
        let (number, nearness) = (next.node, next.nearness);
        let (met, node) = match sight.meet(next, how.small) {
            Visit::Outside => return,
            Visit::Near(met) => return self.front.see(sight, &met, Verdict::Untested, verdicts),
            Visit::Small(met) => return sight.mark(&met, Verdict::BelowThreshold, verdicts),
            Visit::OnScreen(met, node) => (met, node),
        };
        let remembered = self.memory.valid(number, nearness, how.remember);
        if remembered == Some(false) {
            sight.mark(&met, Verdict::Occluded, verdicts);
        } else if remembered.is_some() || how.map && self.front.is_free(met.rect) {
            self.sketch
                .node(&sight.screen, &node.bounds, 0, NodeOutcome::Free);
            self.front.see(sight, &met, Verdict::Visible, verdicts);
        } else {
            self.waiting.push(Waiting {
                nearness,
                met,
                alone: false,
            });
        }
    }

    /// Draws all who wait, if not even all of them together could save what it costs to ask. Those that were visible when they were last asked about are
    /// not counted, for nobody expects to save them: they are taken for visible once more, and what they hold waits in turn.
    fn draw_what_is_not_worth_asking(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        verdicts: &mut Verdicts,
    ) {
        loop {
            let known = |waiting: &Waiting| self.memory.was_visible(waiting.met.node);
            let in_doubt = self.waiting.iter().filter(|waiting| !known(waiting));
            let weight = |waiting: &Waiting| u64::from(sight.tree.weight(waiting.met.node));
            let (count, all) = in_doubt.fold((0, 0), |(count, all), waiting| {
                (count + 1, all + weight(waiting))
            });
            if all > count * A_QUERY + u64::from(how.worth) {
                return;
            }
            let visible: Vec<Waiting> = self
                .waiting
                .extract_if(.., |waiting| self.memory.was_visible(waiting.met.node))
                .collect();
            if visible.is_empty() {
                break;
            }
            for waiting in &visible {
                self.front
                    .see(sight, &waiting.met, Verdict::Visible, verdicts);
            }
            self.meet_all(sight, how, verdicts);
        }
        for waiting in self.waiting.drain(..) {
            self.front
                .draw(sight, &waiting.met, Verdict::Untested, verdicts);
        }
    }

    /// Who of the waiting is asked about next.
    fn gather(&mut self) {
        if self.batches >= self.most_organised.unwrap_or(0) {
            self.asked.append(&mut self.waiting);
            return;
        }
        self.waiting.sort_unstable_by(|a, b| {
            a.nearness
                .total_cmp(&b.nearness)
                .then(a.met.node.cmp(&b.met.node))
        });
        self.asked_on.clear();
        self.spare.clear();
        for waiting in self.waiting.drain(..) {
            if self.asked_on.has_free(waiting.met.rect) {
                self.asked_on.take(waiting.met.rect);
                self.asked.push(waiting);
            } else {
                self.spare.push(waiting);
            }
        }
        std::mem::swap(&mut self.waiting, &mut self.spare);
    }
}
