//! Occlusion regions: where nobody sees any of a set of vertices, for one sector of directions (Edmondson, section 4.6; Stewart 1997).
//!
//! Seen from the side, along the middle of a sector, what a vertex's horizon hides is all beyond a distance and below a line. What hides
//! several vertices is what hides each of them: all beyond the greatest of the distances and below the lowest of the lines, a convex
//! region. Distances along the middle are shorter than true ones; where that would claim too much, the line is made steeper.

use glam::DVec3;

use crate::horizon::{Horizon, Sectors};

/// The most corners of a region; one with more is filled in between those that matter most, and is smaller for it.
pub const CORNERS: usize = 4;

/// What is hidden from a set of vertices in one sector. Places are along the sector's middle direction and up, metres from the field's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Corners of its upper border, the first where it begins; the last one repeated. It begins nowhere if nothing is hidden.
    corners: [[f32; 2]; CORNERS],
    /// How steeply the border goes on after the last.
    slope: f32,
}

impl Region {
    /// Hides nothing.
    pub const OPEN: Self = Self {
        corners: [[f32::INFINITY, f32::NEG_INFINITY]; CORNERS],
        slope: 0.0,
    };

    /// What hides every one of some vertices in a sector.
    #[must_use]
    pub fn around(
        vertices: impl IntoIterator<Item = (DVec3, Horizon)>,
        sectors: &Sectors,
        sector: u32,
    ) -> Self {
        let middle = sectors.central(sector);
        let mut begin = f64::NEG_INFINITY;
        let mut lines = Vec::new();
        for (point, horizon) in vertices {
            if horizon.slope == f32::NEG_INFINITY {
                return Self::OPEN;
            }
            let along = middle.dot(point.truncate());
            let mut slope = f64::from(horizon.slope);
            if slope < 0.0 {
                // Somebody at the side of the sector is farther away than it seems, and a falling line lower there.
                slope /= sectors.half().cos();
            }
            begin = begin.max(along + f64::from(horizon.distance));
            lines.push(Line {
                along,
                up: point.z,
                slope,
            });
        }
        Self::below(begin, lines)
    }

    /// What is hidden in all of some regions of the same sector.
    #[must_use]
    pub fn all<'a>(regions: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut begin = f64::NEG_INFINITY;
        let mut lines = Vec::new();
        for region in regions {
            if region.is_open() {
                return Self::OPEN;
            }
            begin = begin.max(f64::from(region.corners[0][0]));
            lines.extend(region.lines());
        }
        Self::below(begin, lines)
    }

    /// What lies below all of some lines.
    fn below(begin: f64, mut lines: Vec<Line>) -> Self {
        if lines.is_empty() || !begin.is_finite() {
            return Self::OPEN;
        }
        // From the steepest on: the lowest of them, from left to right.
        lines.sort_unstable_by(|a, b| b.slope.total_cmp(&a.slope));
        let mut border: Vec<(f64, Line)> = Vec::new();
        for line in lines {
            let mut from = Some(begin);
            while let Some((start, above)) = border.last() {
                if above.at(*start) < line.at(*start) {
                    from = above.meets(&line).filter(|at| at > start);
                    break;
                }
                border.pop();
                from = Some(begin);
            }
            border.extend(from.map(|from| (from, line)));
        }
        let slope = border.last().map_or(f64::NEG_INFINITY, |last| last.1.slope);
        let corners = border.iter().map(|(from, line)| [*from, line.at(*from)]);
        Self::rounded(simplified(corners.collect()), slope)
    }

    /// With fewer bits, and no larger.
    fn rounded(corners: Vec<[f64; 2]>, slope: f64) -> Self {
        // Along is moved by rounding, up by as much as the steepest of the lines makes of it.
        let steepest = corners.windows(2).map(|pair| {
            let [[x, z], [next, higher]] = [pair[0], pair[1]];
            ((higher - z) / (next - x)).abs()
        });
        let steepest = steepest.fold(slope.abs(), f64::max);
        let lower = |[along, up]: [f64; 2]| {
            let step = f64::from(f32::EPSILON) * along.abs().max(1e-30);
            let up = up - step * 2.0 * steepest;
            [
                (along + step) as f32,
                (up - f64::from(f32::EPSILON) * up.abs()) as f32,
            ]
        };
        let mut last = [f32::INFINITY, f32::NEG_INFINITY];
        let mut lowered = corners.into_iter().map(lower);
        let corners = std::array::from_fn(|_| {
            last = lowered.next().unwrap_or(last);
            last
        });
        Self {
            corners,
            slope: (slope as f32).next_down(),
        }
    }

    /// What was found before: its corners and its slope, if they can be any region's.
    #[cfg(feature = "files")]
    pub(crate) fn from_parts(corners: [[f32; 2]; CORNERS], slope: f32) -> Option<Self> {
        let region = Self { corners, slope };
        let finite = corners
            .as_flattened()
            .iter()
            .all(|number| number.is_finite());
        let rightwards = corners.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
        let closed = finite && rightwards && slope.is_finite();
        (region == Self::OPEN || closed).then_some(region)
    }

    /// Whether it hides nothing.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.corners[0][0] == f32::INFINITY
    }

    /// Whether somebody at a place, `along` the sector's middle and `up`, is hidden.
    #[must_use]
    pub fn hides(&self, along: f64, up: f64) -> bool {
        let corner = |at: usize| self.corners[at].map(f64::from);
        if along < corner(0)[0] {
            return false;
        }
        let [mut x, mut z] = corner(CORNERS - 1);
        let mut slope = f64::from(self.slope);
        for at in 1..CORNERS {
            let [next, higher] = corner(at);
            if next > along {
                [x, z] = corner(at - 1);
                slope = (higher - z) / (next - x);
                break;
            }
        }
        up < z + slope * (along - x)
    }

    /// The corners of its upper border, from where it begins; the last one is repeated where there are fewer.
    #[must_use]
    pub fn corners(&self) -> &[[f32; 2]; CORNERS] {
        &self.corners
    }

    /// The lines that its upper border is made of, from where it begins.
    pub(crate) fn lines(&self) -> impl Iterator<Item = Line> {
        let corners = self.corners.map(|corner| corner.map(f64::from));
        let between = (1..CORNERS).filter_map(move |at| {
            let [[along, up], [next, higher]] = [corners[at - 1], corners[at]];
            let slope = (higher - up) / (next - along);
            (next > along).then_some(Line { along, up, slope })
        });
        let [along, up] = corners[CORNERS - 1];
        let slope = f64::from(self.slope);
        between.chain([Line { along, up, slope }])
    }

    /// How steeply the border goes on after the last corner.
    #[must_use]
    pub fn slope(&self) -> f32 {
        self.slope
    }
}

/// A line over a sector's middle direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    along: f64,
    up: f64,
    pub slope: f64,
}

impl Line {
    fn at(&self, along: f64) -> f64 {
        self.up + self.slope * (along - self.along)
    }

    /// Where it meets another.
    fn meets(&self, other: &Self) -> Option<f64> {
        let apart = other.at(0.0) - self.at(0.0);
        let turn = self.slope - other.slope;
        (turn > 0.0).then(|| apart / turn)
    }
}

/// Leaves out the corners whose loss costs least.
fn simplified(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    while corners.len() > CORNERS {
        let loss = |at: usize| {
            let [[x, z], [middle, top], [next, higher]] =
                [corners[at - 1], corners[at], corners[at + 1]];
            top - (z + (higher - z) * (middle - x) / (next - x))
        };
        let inner = 1..corners.len() - 1;
        let Some(least) = inner.min_by(|&a, &b| loss(a).total_cmp(&loss(b))) else {
            break;
        };
        corners.remove(least);
    }
    corners
}
