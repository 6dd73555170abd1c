//! Occlusion regions: the positions that none of a set of vertices is visible from, for one sector of directions (Edmondson, section 4.6;
//! Stewart 1997).
//!
//! In a vertical section along the middle of a sector, a vertex's horizon hides the vertex from all positions beyond a distance and below a
//! line. Several vertices are all hidden from the positions beyond the greatest distance and below the lowest of the lines: a convex
//! region. A distance along the middle is shorter than the true distance. Where the region would be too large for that, the line is made
//! steeper.

use glam::DVec3;

use crate::horizon::{Horizon, Sectors};

/// The most corners of a region. Of a region with more, those whose removal changes least are removed, which makes it smaller.
pub const CORNERS: usize = 4;

/// A vertex, or an end of an edge, and its horizon in one sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VertexHorizon {
    /// The position of the vertex, metres east, north and up of the field's origin.
    pub point: DVec3,
    /// Its horizon.
    pub horizon: Horizon,
}

/// The viewpoints in one sector that a set of vertices is hidden from. Coordinates are metres along the sector's middle direction and up,
/// from the field's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// The corners of its upper border. The first is where the region begins; the last is repeated where there are fewer. An empty region
    /// begins at infinity.
    corners: [[f32; 2]; CORNERS],
    /// The slope of the border after the last corner.
    slope: f32,
}

impl Region {
    /// The region without a position: nothing is hidden.
    pub const EMPTY: Self = Self {
        corners: [[f32::INFINITY, f32::NEG_INFINITY]; CORNERS],
        slope: 0.0,
    };

    /// The region that all of these vertices are hidden from, in the sector with the index `sector`.
    #[must_use]
    pub fn of_vertices(
        vertices: impl IntoIterator<Item = VertexHorizon>,
        sectors: &Sectors,
        sector: u32,
    ) -> Self {
        let middle = sectors.sector_middle(sector);
        let mut begin = f64::NEG_INFINITY;
        let mut lines = Vec::new();
        for VertexHorizon { point, horizon } in vertices {
            if horizon.slope == f32::NEG_INFINITY {
                return Self::EMPTY;
            }
            let along = middle.dot(point.truncate());
            let mut slope = f64::from(horizon.slope);
            if slope < 0.0 {
                // A viewpoint at the side of the sector is farther away than its projection, and a falling line is lower there.
                slope /= sectors.half_angle().cos();
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

    /// The intersection of some regions of one sector.
    #[must_use]
    pub fn intersection<'a>(regions: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut begin = f64::NEG_INFINITY;
        let mut lines = Vec::new();
        for region in regions {
            if region.is_empty() {
                return Self::EMPTY;
            }
            begin = begin.max(f64::from(region.corners[0][0]));
            lines.extend(region.lines());
        }
        Self::below(begin, lines)
    }

    /// The region beyond `begin` and below all of some lines.
    fn below(begin: f64, mut lines: Vec<Line>) -> Self {
        if lines.is_empty() || !begin.is_finite() {
            return Self::EMPTY;
        }
        // The lower envelope, from left to right: steep lines come first.
        lines.sort_unstable_by(|a, b| b.slope.total_cmp(&a.slope));
        let mut border: Vec<BorderPiece> = Vec::new();
        for line in lines {
            let mut from = Some(begin);
            while let Some(last) = border.last() {
                if last.line.height_at(last.from) < line.height_at(last.from) {
                    from = last.line.meets(&line).filter(|&at| at > last.from);
                    break;
                }
                border.pop();
                from = Some(begin);
            }
            border.extend(from.map(|from| BorderPiece { from, line }));
        }
        let slope = border
            .last()
            .map_or(f64::NEG_INFINITY, |last| last.line.slope);
        let corners = border
            .iter()
            .map(|piece| [piece.from, piece.line.height_at(piece.from)]);
        Self::rounded(simplified(corners.collect()), slope)
    }

    /// The region rounded inwards to f32.
    fn rounded(corners: Vec<[f64; 2]>, slope: f64) -> Self {
        // Rounding moves a corner along. Its height is lowered by what the steepest line rises over that step.
        let steepest = corners.windows(2).map(|pair| {
            let [[x, z], [next_x, next_z]] = [pair[0], pair[1]];
            ((next_z - z) / (next_x - x)).abs()
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

    /// A stored region. `None` for corners or a slope that no region has.
    #[cfg(feature = "files")]
    pub(crate) fn from_parts(corners: [[f32; 2]; CORNERS], slope: f32) -> Option<Self> {
        let region = Self { corners, slope };
        let finite = corners
            .as_flattened()
            .iter()
            .all(|number| number.is_finite());
        let sorted = corners.windows(2).all(|pair| pair[0][0] <= pair[1][0]);
        let bounded = finite && sorted && slope.is_finite();
        (region == Self::EMPTY || bounded).then_some(region)
    }

    /// Whether no position is in the region.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.corners[0][0] == f32::INFINITY
    }

    /// Whether a viewpoint is in the region, so that the vertices are hidden from it: `along` metres along the sector's middle direction
    /// and `up` metres up, from the field's origin.
    #[must_use]
    pub fn contains(&self, along: f64, up: f64) -> bool {
        let corner = |at: usize| self.corners[at].map(f64::from);
        if along < corner(0)[0] {
            return false;
        }
        let [mut x, mut z] = corner(CORNERS - 1);
        let mut slope = f64::from(self.slope);
        for at in 1..CORNERS {
            let [next_x, next_z] = corner(at);
            if next_x > along {
                [x, z] = corner(at - 1);
                slope = (next_z - z) / (next_x - x);
                break;
            }
        }
        up < z + slope * (along - x)
    }

    /// The corners of its upper border, metres along and up. The first is where the region begins; the last is repeated where there are
    /// fewer.
    #[must_use]
    pub fn corners(&self) -> &[[f32; 2]; CORNERS] {
        &self.corners
    }

    /// The lines that its upper border consists of, from where it begins.
    pub(crate) fn lines(&self) -> impl Iterator<Item = Line> {
        let corners = self.corners.map(|corner| corner.map(f64::from));
        let between = (1..CORNERS).filter_map(move |at| {
            let [[along, up], [next_along, next_up]] = [corners[at - 1], corners[at]];
            let slope = (next_up - up) / (next_along - along);
            (next_along > along).then_some(Line { along, up, slope })
        });
        let [along, up] = corners[CORNERS - 1];
        let slope = f64::from(self.slope);
        between.chain([Line { along, up, slope }])
    }

    /// The slope of the border after the last corner.
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
    fn height_at(&self, along: f64) -> f64 {
        self.up + self.slope * (along - self.along)
    }

    /// Where a less steep line crosses this one.
    fn meets(&self, other: &Self) -> Option<f64> {
        let apart = other.height_at(0.0) - self.height_at(0.0);
        let turn = self.slope - other.slope;
        (turn > 0.0).then(|| apart / turn)
    }
}

/// A piece of a region's upper border.
struct BorderPiece {
    /// Where it begins, metres along.
    from: f64,
    line: Line,
}

/// Removes corners until [`CORNERS`] are left, each time the one whose removal lowers the border least.
fn simplified(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    while corners.len() > CORNERS {
        let loss = |at: usize| {
            let [[x, z], [middle_x, middle_z], [next_x, next_z]] =
                [corners[at - 1], corners[at], corners[at + 1]];
            middle_z - (z + (next_z - z) * (middle_x - x) / (next_x - x))
        };
        let inner = 1..corners.len() - 1;
        let Some(least) = inner.min_by(|&a, &b| loss(a).total_cmp(&loss(b))) else {
            break;
        };
        corners.remove(least);
    }
    corners
}
