//! Checks points and triangles, reports what keeps them from being a height field, and computes what a field stores beside them.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use robust::{Coord, orient2d};

use super::boundary::{Boundary, boundary};
use super::half_edge::{NONE, next};
use super::weld::weld;
use crate::error::TerrainError;
use crate::fault::FieldFault;
use crate::packed_tree::{Extent, PackedTree};

/// The most faults that an error lists.
const MOST_LISTED: usize = 10;
/// The largest coordinate of a corner, metres.
const FARTHEST: f64 = 1e9;
/// The most triangles: half-edges are numbered with 32 bits.
const MOST: usize = (u32::MAX / 3 - 1) as usize;

/// The origin of a checked field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// The middle of the field. The points become relative to it.
    Centred,
    /// Zero. The points stay as they are.
    Zero,
}

/// The parts of a field.
pub(super) struct Checked {
    pub origin: DVec3,
    pub points: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// For each half-edge, the one of the neighbouring triangle; [`NONE`] at the boundary.
    pub opposite: Vec<u32>,
    /// One half-edge for each edge.
    pub edges: Vec<u32>,
    pub boundary: Boundary,
}

/// Checks points and triangles, and welds, compacts and connects them.
pub(super) fn check(
    points: Vec<DVec3>,
    mut triangles: Vec<[u32; 3]>,
    origin: Origin,
) -> Result<Checked, TerrainError> {
    for (what, count) in [("triangles", triangles.len()), ("corners", points.len())] {
        if count > MOST {
            return Err(TerrainError::TooMany {
                what,
                count,
                most: MOST,
            });
        }
    }
    refuse(invalid_corners(&points, &triangles))?;
    let mut used = vec![false; points.len()];
    for &corner in triangles.iter().flatten() {
        used[corner as usize] = true;
    }
    let welded = weld(&points, &used);
    for corner in triangles.iter_mut().flatten() {
        *corner = welded.replacements[*corner as usize];
    }
    let mut faults = welded.faults;
    faults.extend(wind_counter_clockwise(&points, &mut triangles));
    refuse(faults)?;
    let Compacted {
        origin,
        points,
        triangles,
    } = compact(&points, triangles, origin);
    let centroid_of = |triangle: usize| centroid(&points, triangles[triangle]) + origin;
    let opposite = match opposites(&triangles) {
        Ok(opposite) => opposite,
        Err(crowded) => {
            let fan = |half_edge: u32| {
                let [a, b] = [half_edge, next(half_edge)]
                    .map(|side| triangles[side as usize / 3][side as usize % 3]);
                let at = (points[a as usize] + points[b as usize]) / 2.0 + origin;
                FieldFault::Fan {
                    triangle: half_edge as usize / 3,
                    at,
                }
            };
            return refuse(crowded.into_iter().map(fan).collect()).and(Err(empty()));
        }
    };
    let overhangs =
        overhangs(&points, &triangles)
            .into_iter()
            .map(|triangles| FieldFault::Overhang {
                triangles,
                at: centroid_of(triangles[0]),
            });
    refuse(overhangs.collect())?;
    if triangles.is_empty() {
        return Err(empty());
    }
    let half_edges = 0..opposite.len() as u32;
    let edges = half_edges.filter(|&half_edge| opposite[half_edge as usize] > half_edge);
    let edges = edges.collect();
    let start = |half_edge: u32| triangles[half_edge as usize / 3][half_edge as usize % 3];
    let plan = |vertex: u32| points[vertex as usize].truncate();
    let boundary = boundary(&opposite, start, plan);
    Ok(Checked {
        origin,
        points,
        triangles,
        opposite,
        edges,
        boundary,
    })
}

fn empty() -> TerrainError {
    TerrainError::Setting {
        what: "the number of triangles",
        value: "0".to_owned(),
        problem: "give at least one",
    }
}

/// An error with the faults, if there are any.
fn refuse(mut faults: Vec<FieldFault>) -> Result<(), TerrainError> {
    let total = faults.len();
    if total == 0 {
        return Ok(());
    }
    faults.truncate(MOST_LISTED);
    Err(TerrainError::NotAHeightField { faults, total })
}

/// Corners without a finite position, and triangles with corners that do not exist.
fn invalid_corners(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<FieldFault> {
    let nowhere = points
        .iter()
        .enumerate()
        .filter(|(_, at)| !at.is_finite() || at.abs().max_element() > FARTHEST)
        .map(|(corner, &at)| FieldFault::Nowhere { corner, at });
    let missing = triangles
        .iter()
        .enumerate()
        .flat_map(|(triangle, corners)| {
            let missing = corners
                .iter()
                .filter(|&&corner| corner as usize >= points.len());
            missing.map(move |&corner| FieldFault::NoSuchCorner { triangle, corner })
        });
    nowhere.chain(missing).collect()
}

/// Reverses all triangles if most are clockwise. Returns the triangles whose winding differs from that of most, and those without an area
/// in the plan.
fn wind_counter_clockwise(points: &[DVec3], triangles: &mut [[u32; 3]]) -> Vec<FieldFault> {
    let signed_area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| coord(points[corner as usize].truncate()));
        orient2d(a, b, c)
    };
    let areas: Vec<f64> = triangles.par_iter().map(signed_area).collect();
    let left = areas.iter().filter(|area| **area > 0.0).count();
    let right = areas.iter().filter(|area| **area < 0.0).count();
    if right > left {
        for corners in triangles.iter_mut() {
            corners.swap(1, 2);
        }
    }
    let sign = if right > left { -1.0 } else { 1.0 };
    let faulty = areas
        .iter()
        .enumerate()
        .filter(|(_, area)| **area * sign <= 0.0);
    faulty
        .map(|(triangle, &area)| {
            let corners = triangles[triangle];
            let at = centroid(points, corners);
            let [a, b, c] = corners.map(|corner| points[corner as usize]);
            if area != 0.0 {
                FieldFault::Flipped { triangle, at }
            } else if (b - a).cross(c - a) != DVec3::ZERO {
                FieldFault::Vertical { triangle, at }
            } else {
                FieldFault::Empty { triangle, at }
            }
        })
        .collect()
}

/// Points and triangles without unused points.
struct Compacted {
    origin: DVec3,
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Drops the points that no triangle uses, and makes the rest relative to the origin.
fn compact(points: &[DVec3], mut triangles: Vec<[u32; 3]>, origin: Origin) -> Compacted {
    let mut indices = vec![NONE; points.len()];
    let mut kept: Vec<DVec3> = Vec::new();
    for corner in triangles.iter_mut().flatten() {
        let index = &mut indices[*corner as usize];
        if *index == NONE {
            *index = kept.len() as u32;
            kept.push(points[*corner as usize]);
        }
        *corner = *index;
    }
    let (low, high) = kept.iter().fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(low, high), &point| (low.min(point), high.max(point)),
    );
    // A whole number of metres: coordinates that are whole numbers stay whole.
    let origin = if origin == Origin::Centred && !kept.is_empty() {
        ((low + high) / 2.0).round()
    } else {
        DVec3::ZERO
    };
    for point in &mut kept {
        *point -= origin;
    }
    Compacted {
        origin,
        points: kept,
        triangles,
    }
}

/// For each half-edge the opposite one, or the half-edges that have the same ends and direction as another.
fn opposites(triangles: &[[u32; 3]]) -> Result<Vec<u32>, Vec<u32>> {
    let count = triangles.len() * 3;
    let mut seen = HashMap::with_capacity(count);
    let mut crowded = Vec::new();
    let corner = |half_edge: u32| triangles[half_edge as usize / 3][half_edge as usize % 3];
    for half_edge in 0..count as u32 {
        let ends = (corner(half_edge), corner(next(half_edge)));
        if seen.insert(ends, half_edge).is_some() {
            crowded.push(half_edge);
        }
    }
    if !crowded.is_empty() {
        return Err(crowded);
    }
    let mut opposite = vec![NONE; count];
    for (&(from, to), &half_edge) in &seen {
        if let Some(&other) = seen.get(&(to, from)) {
            opposite[half_edge as usize] = other;
        }
    }
    Ok(opposite)
}

/// Pairs of triangles whose interiors overlap in the plan, decided exactly. At most [`MOST_LISTED`] pairs are kept for each triangle: a
/// pile of triangles has more pairs than memory holds.
fn overhangs(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[usize; 2]> {
    let plan =
        |triangle: usize| triangles[triangle].map(|corner| points[corner as usize].truncate());
    let extents: Vec<Extent> = (0..triangles.len())
        .map(|triangle| Extent::around(plan(triangle)))
        .collect();
    let tree = PackedTree::new(&extents);
    let pairs = (0..triangles.len()).into_par_iter().flat_map_iter(|this| {
        let mut pairs = Vec::new();
        tree.each_while(
            |extent| extent.touches(&extents[this]),
            |other| {
                let other = other as usize;
                if other != this && overlap(plan(this), plan(other)) {
                    pairs.push([this.min(other), this.max(other)]);
                }
                pairs.len() < MOST_LISTED
            },
        );
        pairs
    });
    let mut pairs: Vec<[usize; 2]> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Whether the interiors of two counter-clockwise triangles overlap. They do unless a side of one has all of the other on its right.
fn overlap(first: [DVec2; 3], second: [DVec2; 3]) -> bool {
    let separates = |one: [DVec2; 3], other: [DVec2; 3]| {
        (0..3).any(|side| {
            let (a, b) = (coord(one[side]), coord(one[(side + 1) % 3]));
            other
                .iter()
                .all(|&corner| orient2d(a, b, coord(corner)) <= 0.0)
        })
    };
    !separates(first, second) && !separates(second, first)
}

fn coord(at: DVec2) -> Coord<f64> {
    Coord { x: at.x, y: at.y }
}

fn centroid(points: &[DVec3], corners: [u32; 3]) -> DVec3 {
    corners
        .iter()
        .map(|&corner| points[corner as usize])
        .sum::<DVec3>()
        / 3.0
}
