//! The border of what is shown, its outer one and the rims of its holes: where a line of sight may slip out below the surface.
//!
//! A claim of hiding says that the line from a place to the eye runs below a wall of the surface. Follow it from there towards the eye, over
//! the triangles below it. As long as they go on, so does the surface, without a step. They end below the eye, or at a border edge
//! that has the eye on its outer side. If the line is above the surface there, it has come up through it, out of a triangle that is then
//! seen from above; so no other side of any triangle has to hide anything. Hence claims may be believed from wherever
//!
//! - what lies below the eye and within reach of its near plane is lower, and
//! - each line leaves the surface above it: over every edge that it touches and that has the eye on its outer side.
//!
//! Edges with the eye on their inner side, or in line with it, do not matter: there lines come in, or run along to an edge where
//! they leave. What lies before the wall, seen from the eye beyond it, does not matter either, but where the wall stands is not kept, and so
//! all edges between are asked. A place on an edge that its line leaves over is never hidden: it is not above itself. Two surfaces that
//! touch at different heights have an edge each.
//!
//! All lines from an eye to what lies in a circle, no lower than some height, are above a plane through the eye: it falls (or rises) to that
//! height at the nearest (or farthest) place of the circle. So an edge is passed if both ends of what the lines may touch of it are below.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use crate::circle::Circle;
use crate::field::Field;
use crate::packed::{Extent, WIDTH, order};

/// Heights closer than this share of them count as touching, and so do places in the plan.
const SLACK: f64 = 1e-9;

/// Edges with the surface on their left.
#[derive(Debug, Clone)]
pub struct Rim {
    /// In packed order.
    edges: Vec<[DVec3; 2]>,
    /// A box for each edge, then one for each run of boxes, and so on up to one.
    levels: Vec<Vec<Bound>>,
    whole: bool,
}

/// A box around edges in the plan, and their highest place.
#[derive(Debug, Clone, Copy)]
struct Bound {
    extent: Extent,
    top: f64,
}

impl Rim {
    /// The border of a field.
    #[must_use]
    pub fn of(field: &Field) -> Self {
        Self::new(border(field).collect())
    }

    /// Of edges that have the surface on their left.
    #[must_use]
    pub fn new(edges: Vec<[DVec3; 2]>) -> Self {
        let plan = |edge: &[DVec3; 2]| edge.map(DVec3::truncate);
        let middles: Vec<DVec2> = edges
            .iter()
            .map(|edge| plan(edge).into_iter().sum::<DVec2>() / 2.0)
            .collect();
        let whole = is_convex_ring(&edges);
        let packed = order(&middles).into_iter();
        let edges: Vec<[DVec3; 2]> = packed
            .filter_map(|edge| edges.get(edge as usize).copied())
            .collect();
        let own = edges.iter().map(|edge| Bound {
            extent: Extent::around(plan(edge)),
            top: edge[0].z.max(edge[1].z),
        });
        let mut level: Vec<Bound> = own.collect();
        let mut levels = Vec::new();
        while level.len() > 1 {
            let above = level.chunks(WIDTH).map(Bound::around).collect();
            levels.push(std::mem::replace(&mut level, above));
        }
        levels.push(level);
        Self {
            edges,
            levels,
            whole,
        }
    }

    /// Whether it is one ring, and that one convex: lines to whoever is over the surface never leave it.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.whole
    }

    /// Its edges, the surface on their left, metres east, north and up.
    #[must_use]
    pub fn edges(&self) -> &[[DVec3; 2]] {
        &self.edges
    }

    /// Whether all lines to an eye from places over a circle, no lower than `low` metres, pass above every edge where they leave the surface.
    /// It may say no where they do.
    #[must_use]
    pub fn is_passed(&self, eye: DVec3, circle: &Circle, low: f64) -> bool {
        let Some(lines) = Lines::new(eye, circle, low) else {
            return self.edges.is_empty();
        };
        self.is_passed_by(&lines, self.levels.len() - 1, 0)
    }

    fn is_passed_by(&self, lines: &Lines, level: usize, node: usize) -> bool {
        let bound = self.levels.get(level).and_then(|level| level.get(node));
        if bound.is_none_or(|bound| lines.miss(bound)) {
            return true;
        }
        if level > 0 {
            let first = node * WIDTH;
            return (first..first + WIDTH).all(|child| self.is_passed_by(lines, level - 1, child));
        }
        self.edges.get(node).is_none_or(|edge| lines.pass(*edge))
    }
}

impl Bound {
    fn around(run: &[Self]) -> Self {
        let empty = Self {
            extent: Extent::EMPTY,
            top: f64::NEG_INFINITY,
        };
        run.iter().fold(empty, |all, next| Self {
            extent: all.extent.join(&next.extent),
            top: all.top.max(next.top),
        })
    }
}

/// The border edges of a field, which has them on its left.
pub(crate) fn border(field: &Field) -> impl Iterator<Item = [DVec3; 2]> {
    let halves = field.outline().rings.iter().flatten();
    halves.map(|&half| field.ends(half))
}

/// All lines from an eye to places over a circle that are no lower than some height.
#[derive(Debug)]
struct Lines {
    eye: DVec3,
    /// Towards the middle of the circle.
    ahead: DVec2,
    /// What is between the two tangents has no negative share of these.
    sides: [DVec2; 2],
    /// How far ahead they end.
    far: f64,
    /// How much the plane below them rises a metre ahead.
    slope: f64,
    /// None of them is lower anywhere.
    low: f64,
    /// Metres in the plan, and metres up, that rounding may be wrong by.
    slack: [f64; 2],
}

impl Lines {
    /// `None` from over the circle.
    fn new(eye: DVec3, circle: &Circle, low: f64) -> Option<Self> {
        let way = circle.middle - eye.truncate();
        let far = way.length();
        let slack = SLACK * (1.0 + circle.radius + 1e-3 * far);
        let radius = circle.radius + slack;
        let near = far - radius;
        if near <= 0.0 {
            return None;
        }
        let ahead = way / far;
        let spread = DVec2::new(radius, (near * (far + radius)).sqrt()).normalize();
        let end = if low < eye.z { near } else { far + radius };
        Some(Self {
            eye,
            ahead,
            sides: [ahead.perp(), -ahead.perp()].map(|side| ahead * spread.x + side * spread.y),
            far: far + radius,
            slope: (low - eye.z) / end,
            low: low.min(eye.z),
            slack: [slack, SLACK * (1.0 + eye.z.abs() + low.abs())],
        })
    }

    /// Whether they pass above or beside all that is within a bound.
    fn miss(&self, bound: &Bound) -> bool {
        let top = bound.top + self.slack[1];
        if top < self.low {
            return true;
        }
        let middle = (bound.extent.low + bound.extent.high) / 2.0 - self.eye.truncate();
        let half = (bound.extent.high - bound.extent.low) / 2.0;
        let most = |way: DVec2| way.dot(middle) + way.abs().dot(half);
        let [nearest, farthest] = [-most(-self.ahead), most(self.ahead)];
        if nearest > self.far || farthest < -self.slack[0] {
            return true;
        }
        if self.sides.iter().any(|side| most(*side) < -self.slack[0]) {
            return true;
        }
        let lowest = (self.slope * nearest).min(self.slope * farthest);
        top < self.eye.z + lowest
    }

    /// Whether all that leave the surface over an edge pass above it.
    fn pass(&self, [a, b]: [DVec3; 2]) -> bool {
        let Some(ends) = self.touched([a, b]) else {
            return true;
        };
        let [from, to, at] = [a, b, self.eye].map(|at| Coord { x: at.x, y: at.y });
        if orient2d(from, to, at) >= 0.0 {
            return true;
        }
        let above = |height: &dyn Fn(DVec3) -> f64| {
            let slack = self.slack[1];
            ends.iter().all(|end| end.z + slack < height(*end))
        };
        let plane = |end: DVec3| {
            let ahead = self.ahead.dot((end - self.eye).truncate());
            self.eye.z + self.slope * ahead
        };
        above(&|_| self.low) || above(&plane)
    }

    /// What of an edge they may touch.
    fn touched(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [from, to] = [a, b].map(|end| (end - self.eye).truncate());
        let slack = self.slack[0];
        let [first, second] = self.sides;
        let inside = |at: DVec2| {
            let ahead = self.ahead.dot(at);
            [
                first.dot(at) + slack,
                second.dot(at) + slack,
                ahead + slack,
                self.far + slack - ahead,
            ]
        };
        let (mut begin, mut end) = (0.0_f64, 1.0_f64);
        for (start, stop) in inside(from).into_iter().zip(inside(to)) {
            if start < 0.0 && stop < 0.0 {
                return None;
            }
            let share = start / (start - stop);
            if start < 0.0 {
                begin = begin.max(share);
            } else if stop < 0.0 {
                end = end.min(share);
            }
        }
        (begin <= end).then(|| [begin, end].map(|share| a.lerp(b, share)))
    }
}

/// Whether edges make one ring that turns left everywhere.
fn is_convex_ring(edges: &[[DVec3; 2]]) -> bool {
    let place = |at: DVec3| (at.truncate() + DVec2::ZERO).to_array().map(f64::to_bits);
    let starts: HashMap<[u64; 2], [DVec3; 2]> =
        edges.iter().map(|edge| (place(edge[0]), *edge)).collect();
    let Some(first) = edges.first().filter(|_| starts.len() == edges.len()) else {
        return false;
    };
    let coord = |at: DVec3| Coord { x: at.x, y: at.y };
    let mut at = first;
    for step in 1..=edges.len() {
        let Some(next) = starts.get(&place(at[1])) else {
            return false;
        };
        if orient2d(coord(at[0]), coord(at[1]), coord(next[1])) < 0.0 {
            return false;
        }
        if next == first {
            return step == edges.len();
        }
        at = next;
    }
    false
}
