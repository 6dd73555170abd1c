//! A horizon over scattered points: the Delaunay triangulation of their plan (B. Delaunay, *Sur la sphère vide*,
//! 1934), without the long triangles that would close holes and fill a concave outline.

use delaunator::Point;
use glam::{DVec2, DVec3};

use super::triangles::normalised;
use crate::assemble;
use crate::progress::ProgressFn;
use crate::surface::{Surface, SurfaceKind};

/// The default limit of an edge, as a multiple of the median of the triangles' longest edges.
const USUAL: f64 = 4.0;

/// The points of a horizon, in the world.
pub(super) struct PointSet {
    pub(super) name: String,
    pub(super) points: Vec<DVec3>,
}

/// The horizons over sets of points, in metres. All points must be valid ([`assemble::is_place`]). Sets that span no triangle are left out, unless
/// all do.
pub(super) fn surfaces(
    sets: Vec<PointSet>,
    longest_edge: Option<f64>,
    progress: ProgressFn<'_>,
) -> Result<Vec<Surface>, String> {
    if let Some(longest) = longest_edge
        && (longest <= 0.0 || longest.is_nan())
    {
        return Err(format!(
            "a longest edge of {longest} m leaves no triangle; give a positive length"
        ));
    }
    let mut surfaces = Vec::new();
    let (mut done, count) = (0, sets.len() as u64);
    let mut last_problem = String::new();
    for set in sets {
        progress(done, count);
        match surface(set, longest_edge) {
            Ok(surface) => surfaces.push(surface),
            Err(problem) => {
                tracing::warn!("{problem}; it is left out");
                last_problem = problem;
            }
        }
        done += 1;
    }
    if surfaces.is_empty() {
        return Err(last_problem);
    }
    Ok(surfaces)
}

fn surface(
    PointSet { name, points }: PointSet,
    longest_edge: Option<f64>,
) -> Result<Surface, String> {
    let count = points.len();
    let points = merged(points);
    if u32::try_from(points.len()).is_err() {
        return Err(format!(
            "surface `{name}` has more points than 32 bits count"
        ));
    }
    let mut triangles = triangulated(&points);
    let side = |from: u32, to: u32| at(&points, from).distance(at(&points, to));
    let longest = |&[a, b, c]: &[u32; 3]| side(a, b).max(side(b, c)).max(side(c, a));
    let limit = longest_edge.unwrap_or_else(|| {
        let mut edges: Vec<_> = triangles.iter().map(longest).collect();
        let middle = edges.len() / 2;
        if edges.is_empty() {
            return 0.0;
        }
        USUAL * *edges.select_nth_unstable_by(middle, f64::total_cmp).1
    });
    triangles.retain(|triangle| longest(triangle) <= limit);
    if triangles.is_empty() {
        return Err(format!(
            "surface `{name}`: its {count} picks span no triangle with edges up to {limit} m"
        ));
    }
    // Points far from all others are in no triangle now.
    let mut renamed = vec![u32::MAX; points.len()];
    let mut kept = Vec::with_capacity(points.len());
    for index in triangles.as_flattened_mut() {
        if let Some(slot) = renamed.get_mut(*index as usize) {
            if *slot == u32::MAX {
                *slot = kept.len() as u32;
                kept.extend(points.get(*index as usize));
            }
            *index = *slot;
        }
    }
    let plan = normalised(&kept);
    let kind = SurfaceKind::Horizon;
    Ok(assemble::surface(name, kind, &kept, &triangles, plan))
}

/// Merges points at the same place in the plan into one at their mean height. The result is ordered by place.
fn merged(mut points: Vec<DVec3>) -> Vec<DVec3> {
    let key = |point: &DVec3| (point.x, point.z);
    points.sort_by(|a, b| {
        let plan = a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z));
        plan.then(a.y.total_cmp(&b.y))
    });
    let groups = points.chunk_by(|a, b| key(a) == key(b));
    let mean = |group: &[DVec3]| group.iter().sum::<DVec3>() / group.len() as f64;
    groups
        .filter_map(|group| {
            let first = group.first()?;
            Some(DVec3::new(first.x, mean(group).y, first.z))
        })
        .collect()
}

/// The position of a point in the plan, metres east and north.
fn at(points: &[DVec3], index: u32) -> DVec2 {
    let point = points.get(index as usize).copied().unwrap_or_default();
    DVec2::new(point.x, -point.z)
}

/// The triangles, counter-clockwise from above, without slivers that are too thin for f32.
fn triangulated(points: &[DVec3]) -> Vec<[u32; 3]> {
    let plan = || (0..points.len() as u32).map(|index| at(points, index));
    let low = plan().reduce(DVec2::min).unwrap_or_default();
    let high = plan().reduce(DVec2::max).unwrap_or_default();
    // The plan is scaled to about one, since the triangulation merges points nearer than some 1e-16.
    let size = (high - low).max_element().max(f64::MIN_POSITIVE);
    let scaled = plan().map(|point| (point - low) / size);
    let scaled: Vec<_> = scaled.map(|point| Point::from(point.to_array())).collect();
    let found = delaunator::triangulate(&scaled).triangles;
    // Positions far from zero have the precision of f64.
    let far = low.abs().max(high.abs()).max_element();
    let thin = (size * 1e-6).max(far * 1e-15);
    let oriented = |&[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [a, b, c].map(|index| index as u32);
        let [p, q, r] = [a, b, c].map(|index| at(points, index));
        let area = (q - p).perp_dot(r - p);
        let longest = p.distance(q).max(q.distance(r)).max(r.distance(p));
        match area {
            area if area.abs() <= longest * thin => None,
            area if area < 0.0 => Some([a, c, b]),
            _ => Some([a, b, c]),
        }
    };
    let (triangles, _) = found.as_chunks::<3>();
    triangles.iter().filter_map(oriented).collect()
}
