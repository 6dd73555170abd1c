//! Simplification by meshoptimizer (Arseny Kapoulkine; quadrics after Garland and Heckbert, *Surface Simplification Using Quadric Error
//! Metrics*, 1997), in the modes that keep height fields what they are.
//!
//! Collapsing edges in space may turn triangles of a height field upside down in plan. Regularised collapses hardly ever do; where one
//! did, a few more triangles are left.

use antumbra_scene::Geometry;
use meshopt::{SimplifyOptions, VertexDataAdapter};

/// A simplified mesh: indices into the vertices of its source.
pub(super) struct Reduced {
    pub indices: Vec<u32>,
    /// Triangles that are turned over in plan.
    pub flipped: usize,
}

/// How often more triangles are tried before a flip is put up with, and how many more.
const TRIES: u32 = 4;
const MORE: f64 = 1.25;

/// About `1 / ratio` of a geometry's triangles. With a plan, as few as possible of them turned over in it.
pub(super) fn to_ratio(geometry: &Geometry, ratio: f64, plan: &[[f32; 2]]) -> Reduced {
    let full = geometry.indices.len() / 3;
    let whole = || Reduced {
        indices: geometry.indices.clone(),
        flipped: flipped(&geometry.indices, plan),
    };
    let Some(vertices) = adapter(geometry) else {
        return whole();
    };
    let mut best: Option<Reduced> = None;
    for attempt in 0..TRIES {
        let wanted = full as f64 / ratio * MORE.powi(attempt as i32);
        let target = (wanted.ceil() as usize).max(2) * 3;
        if target >= geometry.indices.len() {
            break;
        }
        let indices = meshopt::simplify(
            &geometry.indices,
            &vertices,
            target,
            1.0,
            SimplifyOptions::Regularize,
            None,
        );
        let flipped = flipped(&indices, plan);
        if !indices.is_empty() && best.as_ref().is_none_or(|best| flipped < best.flipped) {
            best = Some(Reduced { indices, flipped });
        }
        if best.as_ref().is_some_and(|best| best.flipped == 0) {
            break;
        }
    }
    best.unwrap_or_else(whole)
}

/// Triangles of each level for one of the next.
const STEP: usize = 8;
/// A level that keeps more than this share of the triangles before it is not worth having.
const WORTH: f64 = 0.6;
/// Meshes of fewer triangles have no coarser levels.
const LEAST: usize = 64;

/// The geometry and up to `coarser` coarser versions of it. With `lock`, all have the same border.
pub(super) fn levels(full: Geometry, coarser: u32, lock: bool) -> Vec<Geometry> {
    let mut levels = vec![full];
    for _ in 0..coarser {
        let Some(last) = levels.last().filter(|last| last.indices.len() / 3 >= LEAST) else {
            break;
        };
        let Some(vertices) = adapter(last) else {
            break;
        };
        let options = if lock {
            SimplifyOptions::LockBorder
        } else {
            SimplifyOptions::None
        };
        let target = last.indices.len() / 3 / STEP * 3;
        let indices = meshopt::simplify(&last.indices, &vertices, target, 1.0, options, None);
        if indices.is_empty() || indices.len() as f64 > last.indices.len() as f64 * WORTH {
            break;
        }
        let next = super::cut::compact(last, &indices);
        levels.push(next);
    }
    levels
}

fn adapter(geometry: &Geometry) -> Option<VertexDataAdapter<'_>> {
    let bytes = bytemuck::cast_slice(&geometry.positions);
    VertexDataAdapter::new(bytes, size_of::<[f32; 3]>(), 0).ok()
}

/// Triangles that go the other way around in plan than most.
fn flipped(indices: &[u32], plan: &[[f32; 2]]) -> usize {
    let mut ways = [0, 0];
    for triangle in indices.as_chunks::<3>().0 {
        let corners = triangle.map(|corner| plan.get(corner as usize).map(|at| at.map(f64::from)));
        if let [Some(a), Some(b), Some(c)] = corners {
            let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            if twice != 0.0 {
                ways[usize::from(twice > 0.0)] += 1;
            }
        }
    }
    ways[0].min(ways[1])
}
