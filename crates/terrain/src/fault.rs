//! The faults that keep a mesh from being a height field.

use std::fmt;

use glam::DVec3;

/// A fault that keeps a mesh from being a height field. Positions are metres east, north and up, as they were given. Indices count from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum FieldFault {
    /// A corner with a coordinate that is NaN, infinite, or farther from zero than 1e9 metres.
    Nowhere {
        /// The corner.
        corner: usize,
        /// Its position.
        at: DVec3,
    },
    /// A triangle with a corner that does not exist.
    NoSuchCorner {
        /// The triangle.
        triangle: usize,
        /// The corner.
        corner: u32,
    },
    /// A triangle whose winding differs from that of most triangles: it lies upside down.
    Flipped {
        /// The triangle.
        triangle: usize,
        /// Its centroid.
        at: DVec3,
    },
    /// A triangle that has an area in space and none in the plan: a vertical wall.
    Vertical {
        /// The triangle.
        triangle: usize,
        /// Its centroid.
        at: DVec3,
    },
    /// A triangle without an area.
    Empty {
        /// The triangle.
        triangle: usize,
        /// Its centroid.
        at: DVec3,
    },
    /// Two corners at one position in the plan, with different heights.
    TwoHeights {
        /// One of the two corners.
        at: DVec3,
        /// The height of the other, metres.
        other: f64,
    },
    /// An edge with more than two triangles.
    Fan {
        /// A triangle at the edge.
        triangle: usize,
        /// The middle of the edge.
        at: DVec3,
    },
    /// Two triangles that overlap in the plan.
    Overhang {
        /// The two triangles.
        triangles: [usize; 2],
        /// The centroid of the first.
        at: DVec3,
    },
}

impl fmt::Display for FieldFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nowhere { corner, at } => write!(
                f,
                "corner {corner} has the position {}; give finite metres within 1e9 of zero",
                Position(*at)
            ),
            Self::NoSuchCorner { triangle, corner } => {
                write!(
                    f,
                    "triangle {triangle} uses corner {corner}, which does not exist"
                )
            }
            Self::Flipped { triangle, at } => write!(
                f,
                "triangle {triangle} at {} lies upside down; reverse the order of its corners",
                Position(*at)
            ),
            Self::Vertical { triangle, at } => write!(
                f,
                "triangle {triangle} at {} is a vertical wall; move its upper corners back",
                Position(*at)
            ),
            Self::Empty { triangle, at } => {
                write!(
                    f,
                    "triangle {triangle} at {} has no area; leave it out",
                    Position(*at)
                )
            }
            Self::TwoHeights { at, other } => write!(
                f,
                "at {} there is a second corner with the height {other} m; keep one of them",
                Position(*at)
            ),
            Self::Fan { triangle, at } => write!(
                f,
                "triangle {triangle} shares its edge at {} with two or more other triangles; keep two in all",
                Position(*at)
            ),
            Self::Overhang { triangles, at } => write!(
                f,
                "triangles {} and {} lie one above the other at {}; keep one",
                triangles[0],
                triangles[1],
                Position(*at)
            ),
        }
    }
}

/// A position as it is written in messages: "(x, y, z)".
struct Position(DVec3);

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {}, {})", self.0.x, self.0.y, self.0.z)
    }
}
