//! The boundary of the surface in a tree: its outer borders and the rims of its holes, where a line of sight may leave the surface from
//! below.
//!
//! A horizon claims that the line from a point to the viewpoint runs below a wall of the surface. Follow the line from there towards the
//! viewpoint, over the triangles below it. As long as there are triangles, the surface has no step. They end below the viewpoint, or at a
//! boundary edge that has the viewpoint on its outer side. If the line is above the surface there, it has come up through the surface, out
//! of a triangle that is seen from above. So no back side of a triangle has to hide anything. Hence horizons hold from every viewpoint for
//! which
//!
//! - the surface below it, and within reach of its near plane, is lower, and
//! - each line leaves the surface above it: over every edge that it touches and that has the viewpoint on its outer side.
//!
//! Edges with the viewpoint on their inner side, or in line with it, do not matter: there lines enter, or run along to an edge where they
//! leave. Edges beyond the wall, seen from the viewpoint, do not matter either. But the position of the wall is not stored, so all edges
//! between the point and the viewpoint are tested. A point on an edge that its line leaves over is never hidden: it is not above itself.
//! Two surfaces that touch at different heights have an edge each.
//!
//! All lines from a viewpoint to what lies in a circle, no lower than some height, lie above a plane through the viewpoint: it falls (or
//! rises) to that height at the nearest (or farthest) point of the circle. So the lines pass an edge if both ends of the part of it that they
//! may touch are below that plane.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use crate::circle::Circle;
use crate::field::Field;
use crate::packed_tree::{Extent, WIDTH, packed_order};

/// The relative tolerance within which heights, and positions in the plan, count as touching.
const TOLERANCE: f64 = 1e-9;

/// The boundary edges of one or several fields, each with the surface on its left, in a bounding volume hierarchy.
#[derive(Debug, Clone)]
pub struct BoundaryTree {
    /// In packed order.
    edges: Vec<[DVec3; 2]>,
    /// A bound for each edge, then one for each run of bounds, and so on up to one.
    levels: Vec<Vec<Bound>>,
    convex: bool,
}

/// A box around edges in the plan, and their highest point.
#[derive(Debug, Clone, Copy)]
struct Bound {
    extent: Extent,
    top: f64,
}

impl BoundaryTree {
    /// The boundary of a field.
    #[must_use]
    pub fn of(field: &Field) -> Self {
        Self::new(boundary_edges(field).collect())
    }

    /// A tree over edges that have the surface on their left, metres east, north and up.
    #[must_use]
    pub fn new(edges: Vec<[DVec3; 2]>) -> Self {
        let plan = |edge: &[DVec3; 2]| edge.map(DVec3::truncate);
        let middles: Vec<DVec2> = edges
            .iter()
            .map(|edge| plan(edge).into_iter().sum::<DVec2>() / 2.0)
            .collect();
        let convex = is_convex_ring(&edges);
        let packed = packed_order(&middles).into_iter();
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
            convex,
        }
    }

    /// Whether the edges are one convex ring. Then lines to a viewpoint over the surface never leave it.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        self.convex
    }

    /// The edges, the surface on their left, metres east, north and up.
    #[must_use]
    pub fn edges(&self) -> &[[DVec3; 2]] {
        &self.edges
    }

    /// Whether all lines to a viewpoint from points over a circle, no lower than `lowest` metres, pass above every edge where they leave the
    /// surface. It may be `false` where they do.
    #[must_use]
    pub fn is_below_lines(&self, viewpoint: DVec3, circle: &Circle, lowest: f64) -> bool {
        let Some(lines) = Lines::new(viewpoint, circle, lowest) else {
            return self.edges.is_empty();
        };
        self.is_node_below(&lines, self.levels.len() - 1, 0)
    }

    fn is_node_below(&self, lines: &Lines, level: usize, node: usize) -> bool {
        let bound = self.levels.get(level).and_then(|level| level.get(node));
        if bound.is_none_or(|bound| lines.miss(bound)) {
            return true;
        }
        if level > 0 {
            let first = node * WIDTH;
            return (first..first + WIDTH).all(|child| self.is_node_below(lines, level - 1, child));
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

/// The boundary edges of a field, each with the field on its left, metres from the field's origin.
pub(crate) fn boundary_edges(field: &Field) -> impl Iterator<Item = [DVec3; 2]> {
    let half_edges = field.boundary().rings.iter().flatten();
    half_edges.map(|&half_edge| field.ends(half_edge))
}

/// All lines from a viewpoint to points over a circle that are no lower than some height.
#[derive(Debug)]
struct Lines {
    viewpoint: DVec3,
    /// The unit direction towards the middle of the circle.
    ahead: DVec2,
    /// The inward normals of the two tangents.
    sides: [DVec2; 2],
    /// The distance ahead at which the lines end, metres.
    farthest: f64,
    /// The slope of the plane below the lines, along `ahead`.
    slope: f64,
    /// None of the lines is lower than this anywhere, metres.
    lowest: f64,
    /// The tolerance in the plan, metres.
    plan_slack: f64,
    /// The tolerance of heights, metres.
    height_slack: f64,
}

impl Lines {
    /// `None` if the viewpoint is over the circle.
    fn new(viewpoint: DVec3, circle: &Circle, lowest: f64) -> Option<Self> {
        let direction = circle.middle - viewpoint.truncate();
        let distance = direction.length();
        let slack = TOLERANCE * (1.0 + circle.radius + 1e-3 * distance);
        let radius = circle.radius + slack;
        let nearest = distance - radius;
        if nearest <= 0.0 {
            return None;
        }
        let ahead = direction / distance;
        let tangent = DVec2::new(radius, (nearest * (distance + radius)).sqrt()).normalize();
        let end = if lowest < viewpoint.z {
            nearest
        } else {
            distance + radius
        };
        Some(Self {
            viewpoint,
            ahead,
            sides: [ahead.perp(), -ahead.perp()].map(|side| ahead * tangent.x + side * tangent.y),
            farthest: distance + radius,
            slope: (lowest - viewpoint.z) / end,
            lowest: lowest.min(viewpoint.z),
            plan_slack: slack,
            height_slack: TOLERANCE * (1.0 + viewpoint.z.abs() + lowest.abs()),
        })
    }

    /// Whether the lines pass above or beside all edges within a bound.
    fn miss(&self, bound: &Bound) -> bool {
        let top = bound.top + self.height_slack;
        if top < self.lowest {
            return true;
        }
        let middle = (bound.extent.low + bound.extent.high) / 2.0 - self.viewpoint.truncate();
        let half = (bound.extent.high - bound.extent.low) / 2.0;
        let most = |direction: DVec2| direction.dot(middle) + direction.abs().dot(half);
        let [nearest, farthest] = [-most(-self.ahead), most(self.ahead)];
        if nearest > self.farthest || farthest < -self.plan_slack {
            return true;
        }
        if self.sides.iter().any(|side| most(*side) < -self.plan_slack) {
            return true;
        }
        let lowest = (self.slope * nearest).min(self.slope * farthest);
        top < self.viewpoint.z + lowest
    }

    /// Whether all lines that leave the surface over an edge pass above it.
    fn pass(&self, [a, b]: [DVec3; 2]) -> bool {
        let Some(ends) = self.touched([a, b]) else {
            return true;
        };
        let [from, to, at] = [a, b, self.viewpoint].map(|at| Coord { x: at.x, y: at.y });
        if orient2d(from, to, at) >= 0.0 {
            return true;
        }
        let all_below = |height: &dyn Fn(DVec3) -> f64| {
            ends.iter()
                .all(|end| end.z + self.height_slack < height(*end))
        };
        let plane = |end: DVec3| {
            let ahead = self.ahead.dot((end - self.viewpoint).truncate());
            self.viewpoint.z + self.slope * ahead
        };
        all_below(&|_| self.lowest) || all_below(&plane)
    }

    /// The ends of the part of an edge that the lines may touch.
    fn touched(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let [from, to] = [a, b].map(|end| (end - self.viewpoint).truncate());
        let slack = self.plan_slack;
        let [first, second] = self.sides;
        let inside = |at: DVec2| {
            let ahead = self.ahead.dot(at);
            [
                first.dot(at) + slack,
                second.dot(at) + slack,
                ahead + slack,
                self.farthest + slack - ahead,
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

/// Whether edges form one ring that turns left everywhere.
fn is_convex_ring(edges: &[[DVec3; 2]]) -> bool {
    let key = |at: DVec3| (at.truncate() + DVec2::ZERO).to_array().map(f64::to_bits);
    let starts: HashMap<[u64; 2], [DVec3; 2]> =
        edges.iter().map(|edge| (key(edge[0]), *edge)).collect();
    let Some(first) = edges.first().filter(|_| starts.len() == edges.len()) else {
        return false;
    };
    let coord = |at: DVec3| Coord { x: at.x, y: at.y };
    let mut at = first;
    for step in 1..=edges.len() {
        let Some(next) = starts.get(&key(at[1])) else {
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
