//! What keeps a mesh from being a height field, and where.

use std::fmt;

use glam::DVec3;

/// A place where a mesh is no height field. Places are metres east, north and up, as they were given; numbers count from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// A corner that is nowhere: NaN, infinite, or farther from zero than metres can be counted.
    Nowhere {
        /// The corner.
        corner: usize,
        /// Where it is said to be.
        at: DVec3,
    },
    /// A triangle with a corner that there is not.
    NoSuchCorner {
        /// The triangle.
        triangle: usize,
        /// The corner.
        corner: u32,
    },
    /// A triangle that turns the other way than most: it lies upside down.
    Flipped {
        /// The triangle.
        triangle: usize,
        /// Its middle.
        at: DVec3,
    },
    /// A triangle that has an area in space and none in the plan: a vertical wall.
    Vertical {
        /// The triangle.
        triangle: usize,
        /// Its middle.
        at: DVec3,
    },
    /// A triangle without an area.
    Empty {
        /// The triangle.
        triangle: usize,
        /// Its middle.
        at: DVec3,
    },
    /// Two heights at one place.
    TwoHeights {
        /// One of them.
        at: DVec3,
        /// The height of the other.
        other: f64,
    },
    /// An edge with more than two triangles.
    Fan {
        /// A triangle at the edge.
        triangle: usize,
        /// The edge's middle.
        at: DVec3,
    },
    /// Two triangles, one above the other.
    Overhang {
        /// The two.
        triangles: [usize; 2],
        /// The middle of the first.
        at: DVec3,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nowhere { corner, at } => write!(
                f,
                "corner {corner} is at {}, which is no place; give finite metres within 1e9 of zero",
                Place(*at)
            ),
            Self::NoSuchCorner { triangle, corner } => {
                write!(
                    f,
                    "triangle {triangle} has a corner {corner} that there is not"
                )
            }
            Self::Flipped { triangle, at } => write!(
                f,
                "triangle {triangle} at {} lies upside down; turn its corners round",
                Place(*at)
            ),
            Self::Vertical { triangle, at } => write!(
                f,
                "triangle {triangle} at {} is a vertical wall; move its upper corners back",
                Place(*at)
            ),
            Self::Empty { triangle, at } => {
                write!(
                    f,
                    "triangle {triangle} at {} has no area; leave it out",
                    Place(*at)
                )
            }
            Self::TwoHeights { at, other } => write!(
                f,
                "at {} there is another corner {other} m high; keep one of them",
                Place(*at)
            ),
            Self::Fan { triangle, at } => write!(
                f,
                "triangle {triangle} shares its edge at {} with two others or more; keep two",
                Place(*at)
            ),
            Self::Overhang { triangles, at } => write!(
                f,
                "triangles {} and {} lie one above the other at {}; keep one",
                triangles[0],
                triangles[1],
                Place(*at)
            ),
        }
    }
}

struct Place(DVec3);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {}, {})", self.0.x, self.0.y, self.0.z)
    }
}
