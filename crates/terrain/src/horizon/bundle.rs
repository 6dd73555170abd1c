//! Bundles: all lines of sight that leave a vertex, an edge or a rectangle within a range of directions, and walls of terrain that block
//! all of them.
//!
//! A wall is a path over the terrain from the rightmost of the lines to the leftmost. Every line between crosses it. Between two of its
//! corners the path is straight, and so is the edge that the lines leave. A line of sight from a point of the edge to a point of the path is
//! lowest at the ends of both, because `z(path) - z(edge) - slope * distance` is concave in the two points. So a bound for the corners of
//! the path is a bound for all lines. Where the slope is negative, the distance is replaced by its projection on the middle direction, which
//! is never longer, to keep the expression concave.
//!
//! Other bounds: Stewart's sectors take the slope of their highest vertex; a Lipschitz bound limits the terrain between two exact lines by
//! its steepest slope. A path over the terrain is exact along the path, and shows where the field ends.

use glam::{DVec2, DVec3};

use super::crossing::{Crossing, slope};
use super::value::WideHorizon;
use super::walk::walk;
use crate::field::Field;

/// Below this share of a right angle an edge counts as parallel to the lines that leave it.
const PARALLEL: f64 = 1e-3;

/// The lines of sight from an edge, or from all points of a rectangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bundle {
    /// The ends of the edge, equal for a vertex; or the corners of the rectangle.
    points: [DVec3; 4],
    /// How many of `points` are used.
    count: usize,
    /// The rightmost and the leftmost direction.
    directions: [DVec2; 2],
    middle: DVec2,
    /// The indices of the points that the rightmost and the leftmost line start at.
    starts: [usize; 2],
    /// Whether the edge is at an angle to all lines. Then each point of a wall sees one point of the edge along each direction. Otherwise
    /// every point of the wall is combined with both ends.
    oblique: bool,
}

/// Points that walls are built through: where terrain stands highest along some lines of a bundle.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallPoints {
    /// On the rightmost and on the leftmost line.
    pub outermost: [Option<Crossing>; 2],
    /// On other lines of those two directions.
    pub other: [Option<Crossing>; 2],
}

impl Bundle {
    /// The lines from an edge between two directions, the rightmost and the leftmost, less than a right angle apart.
    pub fn from_edge(ends: [DVec3; 2], directions: [DVec2; 2]) -> Self {
        let edge = (ends[1] - ends[0]).truncate();
        let [right, left] = directions.map(|direction| direction.perp_dot(edge));
        Self {
            points: [ends[0], ends[1], ends[1], ends[1]],
            count: 2,
            directions,
            middle: (directions[0] + directions[1]).normalize(),
            starts: [usize::from(right < 0.0), usize::from(left > 0.0)],
            oblique: right * left > 0.0 && right.abs().min(left.abs()) > PARALLEL * edge.length(),
        }
    }

    /// The lines from all points of a rectangle, or of another convex quadrilateral, between two directions less than a right angle apart.
    pub fn from_rectangle(corners: [DVec3; 4], directions: [DVec2; 2]) -> Self {
        let outermost = |direction: DVec2, sign: f64| {
            let left = |at: usize| sign * direction.perp_dot(corners[at].truncate());
            (1..4).fold(0, |most, at| if left(at) > left(most) { at } else { most })
        };
        Self {
            points: corners,
            count: 4,
            directions,
            middle: (directions[0] + directions[1]).normalize(),
            starts: [
                outermost(directions[0], -1.0),
                outermost(directions[1], 1.0),
            ],
            oblique: false,
        }
    }

    /// The rightmost and the leftmost direction.
    pub fn directions(&self) -> [DVec2; 2] {
        self.directions
    }

    /// The direction between them. Walls lie ahead of all points of the bundle along it.
    pub fn middle(&self) -> DVec2 {
        self.middle
    }

    /// The indices of the points that the rightmost and the leftmost line start at.
    pub fn starts(&self) -> [usize; 2] {
        self.starts
    }

    /// The index of the end of the edge that lies farther ahead.
    pub fn front(&self) -> usize {
        let edge = (self.points[1] - self.points[0]).truncate();
        usize::from(self.middle.dot(edge) > 0.0)
    }

    /// The horizon of the best wall: of the one from the highest point on the rightmost line to that on the leftmost, and of those square
    /// to the middle direction through each of the points. The search ends once the slope reaches `enough`.
    pub fn best_horizon(&self, field: &Field, points: &WallPoints, enough: f64) -> WideHorizon {
        let mut best = WideHorizon::OPEN;
        if let [Some(right), Some(left)] = points.outermost {
            best = self.straight_wall(field, right, left);
        }
        for through in points.outermost.into_iter().chain(points.other).flatten() {
            if best.slope >= enough {
                break;
            }
            let horizon = self.square_wall(field, through, best.slope);
            if horizon.slope > best.slope {
                best = horizon;
            }
        }
        best
    }

    /// The horizon of the wall from a point on the rightmost line to one on the leftmost.
    fn straight_wall(&self, field: &Field, right: Crossing, left: Crossing) -> WideHorizon {
        let mut wall = Wall::new(self, right.at, f64::NEG_INFINITY);
        let arrived = if right.half_edge == left.half_edge {
            wall.step(left.at)
        } else {
            walk(field, right, left.at.truncate(), |at| wall.step(at))
        };
        if arrived {
            wall.horizon
        } else {
            WideHorizon::OPEN
        }
    }

    /// The horizon of the wall through a point, square to the middle direction, from one outermost line to the other. Given up where its
    /// slope is no better than `known`.
    fn square_wall(&self, field: &Field, through: Crossing, known: f64) -> WideHorizon {
        let mut horizon = WideHorizon::OPEN;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let from = through.at.truncate();
            let start = self.points[self.starts[side]].truncate();
            let direction = self.directions[side];
            // The distance along the wall to the outermost line: negative for a point beyond that line.
            let distance = direction.perp_dot(from - start) * sign / self.middle.dot(direction);
            let mut wall = Wall::new(self, through.at, known);
            let right = -self.middle.perp();
            let arrived = wall.horizon.slope > known
                && (distance <= 0.0
                    || walk(
                        field,
                        through,
                        from + right * (sign * distance * (1.0 + 1e-9)),
                        |at| wall.step(at),
                    ));
            if !arrived {
                return WideHorizon::OPEN;
            }
            horizon = if side == 0 {
                wall.horizon
            } else {
                horizon.and(wall.horizon)
            };
        }
        horizon
    }

    /// Lowers the horizon to what a piece of a wall hides where it crosses the lines from the ends of the edge: there the part of the edge
    /// that it is seen from changes.
    fn include_piece(&self, from: DVec3, to: DVec3, horizon: &mut WideHorizon) {
        if !self.oblique {
            return;
        }
        for (side, start) in [(0, self.starts[1]), (1, self.starts[0])] {
            let start = self.points[start].truncate();
            let [before, after] =
                [from, to].map(|at| self.directions[side].perp_dot(at.truncate() - start));
            if before * after < 0.0 {
                self.include_point(from.lerp(to, before / (before - after)), horizon);
            }
        }
    }

    /// Lowers the horizon to what a point of a wall hides of the edge.
    fn include_point(&self, at: DVec3, horizon: &mut WideHorizon) {
        let [first, last, ..] = self.points;
        if self.count == 2 && first == last {
            self.include_line(first, at, horizon);
        } else if self.oblique {
            let edge = (last - first).truncate();
            let back = (at - first).truncate();
            for direction in self.directions {
                let share = direction.perp_dot(back) / direction.perp_dot(edge);
                self.include_line(first.lerp(last, share.clamp(0.0, 1.0)), at, horizon);
            }
        } else {
            for point in &self.points[..self.count] {
                self.include_line(*point, at, horizon);
            }
        }
    }

    /// Lowers the horizon to the line from a point of the edge to a point of a wall.
    fn include_line(&self, from: DVec3, at: DVec3, horizon: &mut WideHorizon) {
        let ahead = self.middle.dot((at - from).truncate());
        if ahead <= 0.0 {
            *horizon = WideHorizon::OPEN;
            return;
        }
        let distance = (at - from).truncate().length();
        let rise = at.z - from.z;
        let steep = if rise >= 0.0 {
            slope(from, at)
        } else {
            rise / ahead
        };
        horizon.slope = horizon.slope.min(steep);
        horizon.distance = horizon.distance.max(distance);
    }
}

/// A wall, as far as it has been walked.
struct Wall<'a> {
    bundle: &'a Bundle,
    horizon: WideHorizon,
    last: DVec3,
    /// The wall is given up as soon as its slope is no better than this.
    known: f64,
}

impl<'a> Wall<'a> {
    fn new(bundle: &'a Bundle, from: DVec3, known: f64) -> Self {
        let mut wall = Self {
            bundle,
            horizon: WideHorizon::ALL,
            last: from,
            known,
        };
        bundle.include_point(from, &mut wall.horizon);
        wall
    }

    /// Extends the wall to a point. Returns whether to go on.
    fn step(&mut self, at: DVec3) -> bool {
        self.bundle.include_piece(self.last, at, &mut self.horizon);
        self.bundle.include_point(at, &mut self.horizon);
        self.last = at;
        self.horizon.slope > self.known
    }
}
