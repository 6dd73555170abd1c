//! A walk that waits for nothing: it goes by the answers of earlier frames, draws what it knows nothing of, and asks for the next ones.
//!
//! What the paper leaves to future work (section 6.1: coherence in time), in the way of Bittner, Wimmer, Piringer, Purgathofer, *Coherent
//! Hierarchical Culling*, 2004: a verdict about an inner node stands for all below it, is pulled up when all children are hidden and refined when
//! the node comes to light.

use antumbra_draw::boxes::BoxList;

use super::context::{TraversalContext, Visit, VisitedNode};
use super::frontier::Frontier;
use super::one_frame::TraversalSettings;
use super::queue::QueuedNode;
use crate::sketch::{NodeOutcome, Sketch};
use antumbra_cull::{Verdict, Verdicts};

/// What a batch of questions was about; goes along with the answers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct QueriedNodes {
    /// The tree's generation and the view's count of cuts: answers about another tree, or from before a cut, say nothing.
    pub of: (u64, u64),
    /// The walk's own count of frames.
    pub frame: u32,
    /// The nodes, in the order of the questions.
    pub nodes: std::sync::Arc<Vec<u32>>,
    /// Where each question's nodes end.
    pub ends: std::sync::Arc<Vec<u32>>,
}

/// What is known of a node.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    visible: bool,
    /// The frame in which it was asked about; 0: never.
    asked: u32,
    /// The first frame in which it is asked about again.
    again: u32,
    /// Until this frame it is not taken for hidden because its children are.
    open_until: u32,
    /// Until this frame it is asked about alone.
    alone_until: u32,
    /// How far the eye had come.
    travelled: f64,
}

/// A walk; kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub struct LateTraversal {
    known: Vec<Known>,
    of: Option<(u64, u64)>,
    frame: u32,
    travelled: f64,
    last_eye: Option<glam::DVec3>,
    front: Frontier,
    asked: Vec<u32>,
    /// What was met on the way, where a sketch was asked for.
    pub sketch: Sketch,
}

/// Frames after which an answer is too old to leave anything out: as long as answers are under way, and one more.
const OLD: u32 = 4;
/// Frames for which a node that came to light stays open, though all its children be hidden.
const OPEN: u32 = 32;
/// A node that reaches over a part of the screen as large as this is opened, not asked about: some of it is nearly always visible.
const LARGE: u64 = 8;
/// A node of more triangles than this is opened, not asked about, where nothing is known: until the answer is there all of it would be drawn.
const HEAVY: u32 = 20_000;
/// A node of more triangles than this is not asked about in place of its hidden children: when it comes to light, what lies below it has not
/// been asked about for a while, and is drawn until it has been.
const UNWIELDY: u32 = 100_000;

impl LateTraversal {
    /// Takes in an answer of an earlier frame: whether each node that was asked about had a visible sample.
    pub fn take(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        asked: &QueriedNodes,
        answers: impl Iterator<Item = bool>,
    ) {
        if self.of != Some(asked.of) {
            return;
        }
        let mut first = 0;
        for (end, visible) in asked.ends.iter().zip(answers) {
            let nodes = asked.nodes.get(first..*end as usize).unwrap_or_default();
            first = *end as usize;
            for node in nodes {
                self.note(how, asked.frame, *node, visible);
                if visible && nodes.len() > 1 {
                    // One of them at least is visible; which, each has to say for itself.
                    let frame = self.frame;
                    let known = self.known_mut(*node);
                    (known.again, known.alone_until) = (frame, frame + OPEN);
                }
            }
        }
        for node in asked.nodes.iter() {
            self.pull_up(sight, how, *node);
        }
    }

    /// Takes an answer about a node that was asked for in a frame.
    fn note(&mut self, how: &TraversalSettings, asked: u32, node: u32, visible: bool) {
        let frames = match visible {
            true => how.remember.visible,
            false => how.remember.occluded,
        };
        let was_hidden = self.is_hidden(node, how);
        let travelled = self.travelled;
        let frame = self.frame;
        let known = self.known_mut(node);
        // Spread, so that not all that was asked about together is asked about together again.
        let spread = node.wrapping_mul(0x9E37_79B9) >> 16;
        known.again = frame + frames
            - if frames > 1 {
                spread % (frames / 2 + 1)
            } else {
                0
            };
        (known.visible, known.asked, known.travelled) = (visible, asked, travelled);
        if visible && was_hidden {
            known.open_until = frame + OPEN;
        }
    }

    /// A node all of whose children are hidden is hidden, and its parent perhaps too.
    fn pull_up(&mut self, sight: &TraversalContext<'_>, how: &TraversalSettings, node: u32) {
        let mut at = node;
        while self.is_hidden(at, how)
            && let Some(parent) = sight.node(at).map(|node| node.parent)
            && let Some(above) = sight.node(parent)
        {
            let held = self
                .known
                .get(parent as usize)
                .is_some_and(|known| known.open_until > self.frame);
            let unwieldy = sight.tree.weight(parent) > UNWIELDY;
            if held || unwieldy || !above.children().all(|child| self.is_hidden(child, how)) {
                return;
            }
            let of = above
                .children()
                .filter_map(|child| self.known.get(child as usize).copied());
            // As old as the oldest of them.
            let oldest = of.min_by_key(|known| known.asked).unwrap_or_default();
            let frame = self.frame;
            let known = self.known_mut(parent);
            (known.visible, known.asked, known.again) = (false, oldest.asked, frame);
            known.travelled = oldest.travelled;
            at = parent;
        }
    }

    fn known_mut(&mut self, node: u32) -> &mut Known {
        let at = node as usize;
        if self.known.len() <= at {
            self.known.resize(at + 1, Known::default());
        }
        &mut self.known[at]
    }

    fn is_hidden(&self, node: u32, how: &TraversalSettings) -> bool {
        let Some(known) = self.known.get(node as usize) else {
            return false;
        };
        let old = OLD + how.remember.occluded;
        known.asked > 0 && !known.visible && known.asked + old >= self.frame
    }

    /// Walks from the roots: finds what is drawn, gives verdicts, and says what is asked about.
    pub fn walk(
        &mut self,
        sight: &TraversalContext<'_>,
        how: &TraversalSettings,
        verdicts: &mut Verdicts,
        boxes: &mut BoxList,
    ) {
        boxes.clear();
        self.asked.clear();
        self.sketch.begin(how.sketch, how.block);
        self.front.begin(sight, verdicts);
        while let Some(next) = self.front.next() {
            self.meet(sight, how, next, verdicts);
        }
        self.sketch.map(&self.front.drawn_on);
        self.ask(sight, how, boxes);
        verdicts.add_tested(boxes.query_count());
    }

    /// The slots to be drawn.
    pub fn found(&mut self) -> &mut Vec<u32> {
        &mut self.front.found
    }

    /// Begins a frame: what another tree or camera cut was about is forgotten.
    pub fn begin(&mut self, sight: &TraversalContext<'_>, cuts: u64) {
        self.frame += 1;
        let now = (sight.tree.generation(), cuts);
        if self.of != Some(now) {
            self.known.clear();
            self.last_eye = None;
            self.of = Some(now);
        }
        let eye = sight.screen.eye();
        self.travelled += self.last_eye.map_or(0.0, |last| last.distance(eye));
        self.last_eye = Some(eye);
    }

    /// What this frame's questions are about.
    pub fn asked(&mut self, boxes: &BoxList) -> QueriedNodes {
        QueriedNodes {
            of: self.of.unwrap_or_default(),
            frame: self.frame,
            nodes: std::sync::Arc::new(std::mem::take(&mut self.asked)),
            ends: std::sync::Arc::new(boxes.query_ends().to_vec()),
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
        let known = self.known.get(number as usize).copied().unwrap_or_default();
        if how.map && self.front.is_free(met.rect) {
            self.sketch
                .node(&sight.screen, &node.bounds, 0, NodeOutcome::Free);
            let verdict = match known.asked {
                0 => Verdict::Untested,
                _ => Verdict::Visible,
            };
            self.front.see(sight, &met, verdict, verdicts);
            return;
        }
        let come = self.travelled - known.travelled;
        let slow = come * come <= f64::from(nearness) * how.remember.slow * how.remember.slow;
        let ask = known.again <= self.frame || !slow;
        let hidden = self.is_hidden(number, how);
        let outcome = if hidden {
            NodeOutcome::Occluded
        } else {
            NodeOutcome::Visible
        };
        self.sketch
            .node(&sight.screen, &node.bounds, u32::from(ask), outcome);
        if hidden {
            sight.mark(&met, Verdict::Occluded, verdicts);
        } else if sight.is_unit(number, node) {
            let verdict = match known.asked {
                0 => Verdict::New,
                _ => Verdict::Visible,
            };
            self.front.see(sight, &met, verdict, verdicts);
        } else if known.visible || self.is_sure_to_open(sight, &met) {
            // It came to light, or is sure to: its children are asked about, not it. One that was hidden too long ago is as if unknown.
            self.front.see(sight, &met, Verdict::Visible, verdicts);
            return;
        } else {
            self.front.draw(sight, &met, Verdict::New, verdicts);
        }
        if ask {
            self.asked.push(number);
        }
    }

    /// Whether a node that nothing is known of is better opened than asked about.
    fn is_sure_to_open(&self, sight: &TraversalContext<'_>, met: &VisitedNode) -> bool {
        let [wide, high] = sight.screen.blocks().map(u64::from);
        let screen = wide * high;
        met.rect.blocks() * LARGE >= screen || sight.tree.weight(met.node) > HEAVY
    }

    /// Asks about all who are to be asked about, siblings that are hidden together.
    fn ask(&mut self, sight: &TraversalContext<'_>, how: &TraversalSettings, boxes: &mut BoxList) {
        // Siblings, and children of siblings, are neighbours by number.
        self.asked.sort_unstable();
        let mut asked = std::mem::take(&mut self.asked);
        let (mut last, mut shared) = (false, 1);
        asked.retain(|number| {
            let Some(question) = sight.question(*number) else {
                return false;
            };
            let known = self.known.get(*number as usize);
            let alone = known.is_some_and(|known| known.alone_until > self.frame);
            let hidden = !alone && self.is_hidden(*number, how);
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
    }
}
