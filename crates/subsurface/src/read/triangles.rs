//! Surfaces from the triangles of a file. Faults get a consistent winding, and horizons are checked to be height
//! fields.

use std::collections::HashSet;

use glam::{DVec2, DVec3};

use crate::assemble;
use crate::surface::{Surface, SurfaceKind};

/// The greatest number of pairs of triangles that are tested for overlap.
const MAX_PAIRS: usize = 50_000_000;

/// The surface of points in the world and triangles between them. Triangles with a repeated point, repeated triangles,
/// and points without a triangle, are dropped.
pub(super) fn surface(
    name: String,
    kind: SurfaceKind,
    points: &[DVec3],
    triangles: &[[u32; 3]],
) -> Result<Surface, String> {
    let (points, mut triangles) = used(points, triangles);
    if triangles.is_empty() {
        return Err(format!("surface `{name}` has no triangle"));
    }
    if let Some(point) = points.iter().find(|point| !assemble::is_place(**point)) {
        return Err(format!(
            "surface `{name}` has a point at {point}, which is no place on Earth"
        ));
    }
    let mut plan = Vec::new();
    match kind {
        SurfaceKind::Fault => wind_alike(&points, &mut triangles),
        SurfaceKind::Horizon => {
            wind_upwards(&points, &mut triangles);
            let overlap = overlap(&points, &triangles);
            overlap.map_err(|problem| format!("surface `{name}` is no horizon: {problem}"))?;
            plan = normalised(&points);
        }
    }
    Ok(assemble::surface(name, kind, &points, &triangles, plan))
}

/// The position of each point in the plan, from 0 at the least to 1 at the greatest, east and north.
pub(super) fn normalised(points: &[DVec3]) -> Vec<[f32; 2]> {
    let plan = || points.iter().map(|point| flat(*point));
    let low = plan().reduce(DVec2::min).unwrap_or_default();
    let size = plan().reduce(DVec2::max).unwrap_or_default() - low;
    let share = |at: DVec2| ((at - low) / size.max(DVec2::splat(f64::MIN_POSITIVE))).as_vec2();
    plan().map(|at| share(at).to_array()).collect()
}

/// The position of a point in the plan, metres east and north.
fn flat(point: DVec3) -> DVec2 {
    DVec2::new(point.x, -point.z)
}

fn used(points: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut new = vec![u32::MAX; points.len()];
    let mut kept = Vec::new();
    let mut name = |old: u32| {
        let slot = new.get_mut(old as usize)?;
        if *slot == u32::MAX {
            *slot = u32::try_from(kept.len()).ok()?;
            kept.push(*points.get(old as usize)?);
        }
        Some(*slot)
    };
    let mut known = HashSet::with_capacity(triangles.len());
    let mut is_new = |triangle: &[u32; 3]| {
        let mut sorted = *triangle;
        sorted.sort_unstable();
        known.insert(sorted)
    };
    let whole = |triangle: &&[u32; 3]| {
        let [a, b, c] = **triangle;
        a != b && b != c && c != a && is_new(triangle)
    };
    let renamed = |&[a, b, c]: &[u32; 3]| Some([name(a)?, name(b)?, name(c)?]);
    let triangles = triangles.iter().filter(whole).filter_map(renamed);
    let triangles = triangles.collect();
    (kept, triangles)
}

fn corners(points: &[DVec3], triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|index| points.get(index as usize).copied().unwrap_or_default())
}

/// The normal; its length is twice the triangle's area.
fn normal(points: &[DVec3], triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = corners(points, triangle);
    (b - a).cross(c - a)
}

fn wind_upwards(points: &[DVec3], triangles: &mut [[u32; 3]]) {
    for triangle in triangles {
        if normal(points, *triangle).y < 0.0 {
            triangle.swap(1, 2);
        }
    }
}

/// Flips triangles so that neighbours have the same winding, and the mean normal of each connected piece points up.
fn wind_alike(points: &[DVec3], triangles: &mut [[u32; 3]]) {
    let neighbours = neighbours(triangles);
    // Whether each triangle is flipped, once that is known.
    let mut flipped: Vec<Option<bool>> = vec![None; triangles.len()];
    for first in 0..triangles.len() {
        if flipped.get(first) != Some(&None) {
            continue;
        }
        let mut piece = vec![(first, false)];
        let mut next = 0;
        while let Some(&(at, is_flipped)) = piece.get(next) {
            next += 1;
            if let Some(state) = flipped.get_mut(at).filter(|state| state.is_none()) {
                *state = Some(is_flipped);
                let around = neighbours.get(at).into_iter().flatten().flatten();
                piece.extend(around.map(|to| (to.triangle, is_flipped == to.agrees)));
            }
        }
        // Some triangles were reached from two sides.
        piece.sort_unstable();
        piece.dedup_by_key(|(index, _)| *index);
        let up = |index: usize| triangles.get(index).map_or(0.0, |t| normal(points, *t).y);
        let state = |index: usize| flipped.get(index).copied().flatten().unwrap_or_default();
        let signed = |&(index, _): &(usize, bool)| match state(index) {
            true => -up(index),
            false => up(index),
        };
        let faces_down = piece.iter().map(signed).sum::<f64>() < 0.0;
        for (index, _) in piece {
            if state(index) != faces_down
                && let Some(triangle) = triangles.get_mut(index)
            {
                triangle.swap(1, 2);
            }
        }
    }
}

/// The neighbour across each of a triangle's edges; `None` at a border, and where three or more triangles meet.
type Neighbours = [Option<Neighbour>; 3];

#[derive(Clone, Copy)]
struct Neighbour {
    triangle: usize,
    /// Whether both triangles are wound alike.
    agrees: bool,
}

fn neighbours(triangles: &[[u32; 3]]) -> Vec<Neighbours> {
    let mut edges = Vec::with_capacity(triangles.len() * 3);
    for (index, &[a, b, c]) in triangles.iter().enumerate() {
        for (side, [from, to]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            edges.push((from.min(to), from.max(to), index, side, from < to));
        }
    }
    edges.sort_unstable();
    let mut neighbours = vec![[None; 3]; triangles.len()];
    for here in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let &[(.., one, side_one, up_one), (.., two, side_two, up_two)] = here else {
            continue;
        };
        let agrees = up_one != up_two;
        for (at, side, to) in [(one, side_one, two), (two, side_two, one)] {
            let slot = neighbours.get_mut(at).and_then(|sides| sides.get_mut(side));
            if let Some(slot) = slot {
                *slot = Some(Neighbour {
                    triangle: to,
                    agrees,
                });
            }
        }
    }
    neighbours
}

/// Refuses a vertical triangle and two triangles above each other. All must be wound upwards.
fn overlap(points: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), String> {
    let plan: Vec<_> = triangles
        .iter()
        .map(|&triangle| corners(points, triangle).map(flat))
        .collect();
    let boxes: Vec<_> = plan
        .iter()
        .map(|&[a, b, c]| [a.min(b).min(c), a.max(b).max(c)])
        .collect();
    for (corners, &triangle) in plan.iter().zip(triangles) {
        let [a, b, c] = *corners;
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        if normal(points, triangle).y <= longest * longest * 1e-9 {
            return Err(format!("a triangle at {a} stands upright"));
        }
    }
    // Sorted along east; each triangle is tested against those that begin before it ends.
    let mut order: Vec<_> = (0..plan.len()).collect();
    let start = |index: usize| boxes.get(index).map_or(0.0, |[low, _]| low.x);
    order.sort_by(|&a, &b| start(a).total_cmp(&start(b)));
    let mut tested = 0;
    for (at, &one) in order.iter().enumerate() {
        let Some((first, [low, high])) = plan.get(one).zip(boxes.get(one)) else {
            continue;
        };
        for &two in order.get(at + 1..).unwrap_or_default() {
            let Some((second, [least, most])) = plan.get(two).zip(boxes.get(two)) else {
                continue;
            };
            if least.x >= high.x {
                break;
            }
            tested += 1;
            if tested > MAX_PAIRS {
                return Err("its triangles are too long and thin to be checked".into());
            }
            if least.y < high.y && low.y < most.y && !is_apart(first, second) {
                return Err(format!(
                    "the triangles at {} and {} lie above each other",
                    first[0], second[0]
                ));
            }
        }
    }
    Ok(())
}

/// Whether an edge of one triangle separates the two. Both are wound counter-clockwise. Triangles that only touch are
/// separate.
fn is_apart(one: &[DVec2; 3], two: &[DVec2; 3]) -> bool {
    let parts = |inside: &[DVec2; 3], outside: &[DVec2; 3]| {
        let &[a, b, c] = inside;
        [(a, b), (b, c), (c, a)].into_iter().any(|(from, to)| {
            let along = to - from;
            let slack = along.length_squared() * 1e-6;
            let beyond = |at: &DVec2| along.perp_dot(*at - from) <= slack;
            outside.iter().all(beyond)
        })
    };
    parts(one, two) || parts(two, one)
}
