//! All lines of sight that leave an edge (or a vertex) within a range of directions, and walls of terrain across all of them.
//!
//! A path over the terrain from the leftmost of the lines to the rightmost is crossed by every line between. Between two of its corners
//! the path is straight, and so is the edge: a line of sight from a place of the edge to a place of the path is lowest at the ends of both, for
//! `z(path) - z(edge) - slope * distance` is concave in the two places. So a bound for the corners of the path is one for all lines. Where
//! the slope is negative, the distance is replaced by its projection on the middle direction, which is never longer, to keep it so.
//!
//! Stewart's sectors hold a slope of their highest vertex instead, Lipschitz bounds the terrain between two exact lines by its steepest
//! slope; a path over it is exact about what lies along it, and knows where the field ends.

use glam::{DVec2, DVec3};

use super::crossing::{Crossing, slope};
use super::walk::walk;
use crate::field::Field;

/// Below this share of a right angle an edge lies along the lines that leave it.
const ALONG: f64 = 1e-3;

/// What a wall hides: whoever is farther than `distance` and below a line that rises by `slope`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Claim {
    pub slope: f64,
    pub distance: f64,
}

impl Claim {
    pub const OPEN: Self = Self {
        slope: f64::NEG_INFINITY,
        distance: f64::INFINITY,
    };

    /// Before anything has been looked at.
    pub const ALL: Self = Self {
        slope: f64::INFINITY,
        distance: 0.0,
    };

    pub fn and(self, other: Self) -> Self {
        Self {
            slope: self.slope.min(other.slope),
            distance: self.distance.max(other.distance),
        }
    }
}

/// Lines of sight from an edge, or from any place of a rectangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bundle {
    /// The ends of the edge, twice the same for a vertex; or the corners of the rectangle.
    ends: [DVec3; 4],
    /// How many of them count.
    count: usize,
    /// The first and the last direction, counter-clockwise: the rightmost and the leftmost.
    ways: [DVec2; 2],
    middle: DVec2,
    /// Where the rightmost and the leftmost line start: one of the ends each.
    starts: [usize; 2],
    /// Whether each place of the path sees one place of the edge along each direction, or has to be taken with both ends.
    aslant: bool,
}

impl Bundle {
    /// The lines from an edge between two directions less than a right angle apart.
    pub fn new(ends: [DVec3; 2], ways: [DVec2; 2]) -> Self {
        let edge = (ends[1] - ends[0]).truncate();
        let [right, left] = ways.map(|way| way.perp_dot(edge));
        Self {
            ends: [ends[0], ends[1], ends[1], ends[1]],
            count: 2,
            ways,
            middle: (ways[0] + ways[1]).normalize(),
            starts: [usize::from(right < 0.0), usize::from(left > 0.0)],
            aslant: right * left > 0.0 && right.abs().min(left.abs()) > ALONG * edge.length(),
        }
    }

    /// The lines from any place of a rectangle, or of whatever else is convex with four corners, between two directions less than a right angle apart.
    pub fn around(corners: [DVec3; 4], ways: [DVec2; 2]) -> Self {
        let outermost = |way: DVec2, sign: f64| {
            let left = |at: usize| sign * way.perp_dot(corners[at].truncate());
            (1..4).fold(0, |most, at| if left(at) > left(most) { at } else { most })
        };
        Self {
            ends: corners,
            count: 4,
            ways,
            middle: (ways[0] + ways[1]).normalize(),
            starts: [outermost(ways[0], -1.0), outermost(ways[1], 1.0)],
            aslant: false,
        }
    }

    /// The first and the last direction.
    pub fn ways(&self) -> [DVec2; 2] {
        self.ways
    }

    /// The direction between them: walls stand ahead of all ends along it.
    pub fn middle(&self) -> DVec2 {
        self.middle
    }

    /// Which end the rightmost and which the leftmost line starts from.
    pub fn starts(&self) -> [usize; 2] {
        self.starts
    }

    /// The end that lies farther ahead.
    pub fn front(&self) -> usize {
        let edge = (self.ends[1] - self.ends[0]).truncate();
        usize::from(self.middle.dot(edge) > 0.0)
    }

    /// The best claim of the walls across: from what stands highest on the rightmost line to what does on the leftmost, and square to
    /// the lines through each place in `at` and `ahead`. Enough is enough.
    pub fn claim(
        &self,
        field: &Field,
        at: [Option<Crossing>; 2],
        ahead: [Option<Crossing>; 2],
        enough: f64,
    ) -> Claim {
        let mut best = Claim::OPEN;
        if let [Some(right), Some(left)] = at {
            best = self.straight(field, right, left);
        }
        for through in at.into_iter().chain(ahead).flatten() {
            if best.slope >= enough {
                break;
            }
            let claim = self.square(field, through, best.slope);
            if claim.slope > best.slope {
                best = claim;
            }
        }
        best
    }

    /// The claim of the wall from a place on the rightmost line to one on the leftmost.
    fn straight(&self, field: &Field, right: Crossing, left: Crossing) -> Claim {
        let mut wall = Wall::new(self, right.at, f64::NEG_INFINITY);
        let whole = if right.half == left.half {
            wall.step(left.at)
        } else {
            walk(field, right, left.at.truncate(), |at| wall.step(at))
        };
        if whole { wall.claim } else { Claim::OPEN }
    }

    /// The claim of the wall through a place, from the one outermost line to the other.
    fn square(&self, field: &Field, through: Crossing, known: f64) -> Claim {
        let mut claim = Claim::OPEN;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let from = through.at.truncate();
            let start = self.ends[self.starts[side]].truncate();
            let way = self.ways[side];
            // How far it is along the wall to the outermost line: none, if the place is on it or beyond.
            let far = way.perp_dot(from - start) * sign / self.middle.dot(way);
            let mut wall = Wall::new(self, through.at, known);
            let right = -self.middle.perp();
            let whole = wall.claim.slope > known
                && (far <= 0.0
                    || walk(
                        field,
                        through,
                        from + right * (sign * far * (1.0 + 1e-9)),
                        |at| wall.step(at),
                    ));
            if !whole {
                return Claim::OPEN;
            }
            claim = if side == 0 {
                wall.claim
            } else {
                claim.and(wall.claim)
            };
        }
        claim
    }

    /// Looks at where a piece of a wall crosses the lines along which what it sees of the edge ends.
    fn between(&self, from: DVec3, to: DVec3, claim: &mut Claim) {
        if !self.aslant {
            return;
        }
        for (way, start) in [(0, self.starts[1]), (1, self.starts[0])] {
            let start = self.ends[start].truncate();
            let [before, after] =
                [from, to].map(|at| self.ways[way].perp_dot(at.truncate() - start));
            if before * after < 0.0 {
                self.look(from.lerp(to, before / (before - after)), claim);
            }
        }
    }

    /// Lowers the claim to what a place of the path hides of the edge.
    fn look(&self, at: DVec3, claim: &mut Claim) {
        let [first, last, ..] = self.ends;
        if self.count == 2 && first == last {
            self.see(first, at, claim);
        } else if self.aslant {
            let edge = (last - first).truncate();
            let back = (at - first).truncate();
            for way in self.ways {
                let share = way.perp_dot(back) / way.perp_dot(edge);
                self.see(first.lerp(last, share.clamp(0.0, 1.0)), at, claim);
            }
        } else {
            for end in &self.ends[..self.count] {
                self.see(*end, at, claim);
            }
        }
    }

    fn see(&self, from: DVec3, at: DVec3, claim: &mut Claim) {
        let ahead = self.middle.dot((at - from).truncate());
        if ahead <= 0.0 {
            *claim = Claim::OPEN;
            return;
        }
        let far = (at - from).truncate().length();
        let rise = at.z - from.z;
        let steep = if rise >= 0.0 {
            slope(from, at)
        } else {
            rise / ahead
        };
        claim.slope = claim.slope.min(steep);
        claim.distance = claim.distance.max(far);
    }
}

/// A wall as far as it has been walked.
struct Wall<'a> {
    bundle: &'a Bundle,
    claim: Claim,
    last: DVec3,
    /// It is left as soon as its slope is no better.
    known: f64,
}

impl<'a> Wall<'a> {
    fn new(bundle: &'a Bundle, from: DVec3, known: f64) -> Self {
        let mut wall = Self {
            bundle,
            claim: Claim {
                slope: f64::INFINITY,
                distance: 0.0,
            },
            last: from,
            known,
        };
        bundle.look(from, &mut wall.claim);
        wall
    }

    fn step(&mut self, at: DVec3) -> bool {
        self.bundle.between(self.last, at, &mut self.claim);
        self.bundle.look(at, &mut self.claim);
        self.last = at;
        self.claim.slope > self.known
    }
}
