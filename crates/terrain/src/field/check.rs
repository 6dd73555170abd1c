//! Makes a field of corners and triangles, and finds all that keeps them from being one.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use robust::{Coord, orient2d};

use super::fault::Fault;
use super::outline::outline;
use super::weld::weld;
use super::{Field, NONE};
use crate::error::TerrainError;
use crate::packed::{Boxes, Extent};

/// The most faults that are told.
const TOLD: usize = 10;
/// The farthest from zero that a corner may lie, metres.
const FARTHEST: f64 = 1e9;
/// The most triangles: half-edges are numbered with 32 bits.
const MOST: usize = (u32::MAX / 3 - 1) as usize;

/// `centred`: the origin moves into the field's middle, and its corners with it.
pub(super) fn make(
    points: Vec<DVec3>,
    mut triangles: Vec<[u32; 3]>,
    centred: bool,
) -> Result<Field, TerrainError> {
    for (what, count) in [("triangles", triangles.len()), ("corners", points.len())] {
        if count > MOST {
            return Err(TerrainError::TooMany {
                what,
                count,
                most: MOST,
            });
        }
    }
    refuse(places(&points, &triangles))?;
    let mut used = vec![false; points.len()];
    for &corner in triangles.iter().flatten() {
        used[corner as usize] = true;
    }
    let (names, two_heights) = weld(&points, &used);
    for corner in triangles.iter_mut().flatten() {
        *corner = names[*corner as usize];
    }
    let mut faults = two_heights;
    faults.extend(turns(&points, &mut triangles));
    refuse(faults)?;
    let (origin, points, triangles) = compact(points, triangles, centred);
    let there = |triangle: usize| middle(&points, triangles[triangle]) + origin;
    let across = match counterparts(&triangles) {
        Ok(across) => across,
        Err(crowded) => {
            let fan = |half: u32| {
                let [a, b] = [half, super::next(half)]
                    .map(|half| triangles[half as usize / 3][half as usize % 3]);
                let at = (points[a as usize] + points[b as usize]) / 2.0 + origin;
                Fault::Fan {
                    triangle: half as usize / 3,
                    at,
                }
            };
            return refuse(crowded.into_iter().map(fan).collect()).and(Err(empty()));
        }
    };
    let overhangs = overhangs(&points, &triangles)
        .into_iter()
        .map(|triangles| Fault::Overhang {
            triangles,
            at: there(triangles[0]),
        });
    refuse(overhangs.collect())?;
    if triangles.is_empty() {
        return Err(empty());
    }
    let halves = 0..across.len() as u32;
    let edges = halves.filter(|&half| across[half as usize] > half);
    let edges = edges.collect();
    let start = |half: u32| triangles[half as usize / 3][half as usize % 3];
    let outline = outline(&across, start, |vertex| points[vertex as usize].truncate());
    Ok(Field {
        origin,
        points,
        triangles,
        across,
        edges,
        outline,
    })
}

fn empty() -> TerrainError {
    TerrainError::Setting {
        what: "the number of triangles",
        value: "0".to_owned(),
        problem: "give at least one",
    }
}

fn refuse(mut faults: Vec<Fault>) -> Result<(), TerrainError> {
    let total = faults.len();
    if total == 0 {
        return Ok(());
    }
    faults.truncate(TOLD);
    Err(TerrainError::NotAHeightField { faults, total })
}

/// Corners that are nowhere, and triangles that have no corners.
fn places(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Fault> {
    let nowhere = points
        .iter()
        .enumerate()
        .filter(|(_, at)| !at.is_finite() || at.abs().max_element() > FARTHEST)
        .map(|(corner, &at)| Fault::Nowhere { corner, at });
    let missing = triangles
        .iter()
        .enumerate()
        .flat_map(|(triangle, corners)| {
            let missing = corners
                .iter()
                .filter(|&&corner| corner as usize >= points.len());
            missing.map(move |&corner| Fault::NoSuchCorner { triangle, corner })
        });
    nowhere.chain(missing).collect()
}

/// Turns all triangles counter-clockwise if most were not; names those that turn the other way, and those without an area in the plan.
fn turns(points: &[DVec3], triangles: &mut [[u32; 3]]) -> Vec<Fault> {
    let turn = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| coord(points[corner as usize].truncate()));
        orient2d(a, b, c)
    };
    let turns: Vec<f64> = triangles.par_iter().map(turn).collect();
    let left = turns.iter().filter(|turn| **turn > 0.0).count();
    let right = turns.iter().filter(|turn| **turn < 0.0).count();
    if right > left {
        for corners in triangles.iter_mut() {
            corners.swap(1, 2);
        }
    }
    let sign = if right > left { -1.0 } else { 1.0 };
    let faulty = turns
        .iter()
        .enumerate()
        .filter(|(_, turn)| **turn * sign <= 0.0);
    faulty
        .map(|(triangle, &turn)| {
            let corners = triangles[triangle];
            let at = middle(points, corners);
            let [a, b, c] = corners.map(|corner| points[corner as usize]);
            if turn != 0.0 {
                Fault::Flipped { triangle, at }
            } else if (b - a).cross(c - a) != DVec3::ZERO {
                Fault::Vertical { triangle, at }
            } else {
                Fault::Empty { triangle, at }
            }
        })
        .collect()
}

/// Drops corners of no triangle, and moves the origin into the middle if wanted.
fn compact(
    points: Vec<DVec3>,
    mut triangles: Vec<[u32; 3]>,
    centred: bool,
) -> (DVec3, Vec<DVec3>, Vec<[u32; 3]>) {
    let mut names = vec![NONE; points.len()];
    let mut kept: Vec<DVec3> = Vec::new();
    for corner in triangles.iter_mut().flatten() {
        let name = &mut names[*corner as usize];
        if *name == NONE {
            *name = kept.len() as u32;
            kept.push(points[*corner as usize]);
        }
        *corner = *name;
    }
    let (low, high) = kept.iter().fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(low, high), &point| (low.min(point), high.max(point)),
    );
    // A whole number of metres, so that coordinates that were whole numbers stay so.
    let origin = if centred && !kept.is_empty() {
        ((low + high) / 2.0).round()
    } else {
        DVec3::ZERO
    };
    for point in &mut kept {
        *point -= origin;
    }
    (origin, kept, triangles)
}

/// For each half-edge the one that runs the other way, or those that run as another does.
fn counterparts(triangles: &[[u32; 3]]) -> Result<Vec<u32>, Vec<u32>> {
    let halves = triangles.len() * 3;
    let mut seen = HashMap::with_capacity(halves);
    let mut crowded = Vec::new();
    let corner = |half: u32| triangles[half as usize / 3][half as usize % 3];
    for half in 0..halves as u32 {
        let way = (corner(half), corner(super::next(half)));
        if seen.insert(way, half).is_some() {
            crowded.push(half);
        }
    }
    if !crowded.is_empty() {
        return Err(crowded);
    }
    let mut across = vec![NONE; halves];
    for (&(from, to), &half) in &seen {
        if let Some(&other) = seen.get(&(to, from)) {
            across[half as usize] = other;
        }
    }
    Ok(across)
}

/// Pairs of triangles whose insides overlap in the plan, decided exactly; of each triangle so many as are told, since a heap of them has
/// more pairs than memory holds.
fn overhangs(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[usize; 2]> {
    let plan =
        |triangle: usize| triangles[triangle].map(|corner| points[corner as usize].truncate());
    let extents: Vec<Extent> = (0..triangles.len())
        .map(|triangle| Extent::around(plan(triangle)))
        .collect();
    let boxes = Boxes::new(extents.clone());
    let pairs = (0..triangles.len()).into_par_iter().flat_map_iter(|this| {
        let mut pairs = Vec::new();
        boxes.all(
            |extent| extent.touches(&extents[this]),
            |other| {
                let other = other as usize;
                if other != this && overlap(plan(this), plan(other)) {
                    pairs.push([this.min(other), this.max(other)]);
                }
                pairs.len() < TOLD
            },
        );
        pairs
    });
    let mut pairs: Vec<[usize; 2]> = pairs.collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Whether two counter-clockwise triangles share an inside: they do unless a side of one has the other on its right.
fn overlap(first: [DVec2; 3], second: [DVec2; 3]) -> bool {
    let parted = |one: [DVec2; 3], other: [DVec2; 3]| {
        (0..3).any(|side| {
            let (a, b) = (coord(one[side]), coord(one[(side + 1) % 3]));
            other
                .iter()
                .all(|&corner| orient2d(a, b, coord(corner)) <= 0.0)
        })
    };
    !parted(first, second) && !parted(second, first)
}

fn coord(at: DVec2) -> Coord<f64> {
    Coord { x: at.x, y: at.y }
}

fn middle(points: &[DVec3], corners: [u32; 3]) -> DVec3 {
    corners
        .iter()
        .map(|&corner| points[corner as usize])
        .sum::<DVec3>()
        / 3.0
}
