//! Simplification by meshoptimizer (Arseny Kapoulkine; quadrics after Garland and Heckbert, *Surface Simplification
//! Using Quadric Error Metrics*, 1997), in the modes that suit height fields.
//!
//! Edge collapses in space may turn triangles of a height field upside down in the plan. Regularised collapses hardly
//! ever do. Where one does, a result with a few more triangles is tried. Where so many triangles share a vertex that collapses would take for
//! ever, vertices are clustered instead.

use antumbra_scene::Geometry;
use meshopt::{SimplifyOptions, VertexDataAdapter};

/// A simplified mesh: indices into the vertices of its source.
pub(super) struct Simplified {
    pub indices: Vec<u32>,
    /// Triangles that are upside down in the plan.
    pub flipped: usize,
}

/// The number of attempts without flipped triangles, and the factor on the number of triangles from one to the next.
const TRIES: u32 = 4;
const MORE: f64 = 1.25;

/// About `1 / ratio` of a geometry's triangles. With a plan, as few as possible of them are upside down in it.
pub(super) fn to_ratio(geometry: &Geometry, ratio: f64, plan: &[[f32; 2]]) -> Simplified {
    let full = geometry.indices.len() / 3;
    let whole = || Simplified {
        indices: geometry.indices.clone(),
        flipped: flipped(&geometry.indices, plan),
    };
    let Some(vertices) = adapter(geometry) else {
        return whole();
    };
    if !geometry.is_collapsible() {
        let target = ((full as f64 / ratio).ceil() as usize).max(2) * 3;
        let indices = meshopt::simplify_sloppy(&geometry.indices, &vertices, target, 1.0, None);
        let flipped = flipped(&indices, plan);
        return match indices.is_empty() {
            true => whole(),
            false => Simplified { indices, flipped },
        };
    }
    let mut best: Option<Simplified> = None;
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
            best = Some(Simplified { indices, flipped });
        }
        if best.as_ref().is_some_and(|best| best.flipped == 0) {
            break;
        }
    }
    best.unwrap_or_else(whole)
}

/// The ratio of triangles between two levels.
const STEP: usize = 8;
/// A level that keeps more than this share of the previous level's triangles is dropped.
const WORTH: f64 = 0.6;
/// Meshes with fewer triangles have no coarser levels.
const LEAST: usize = 64;

/// Whether simplification may move the border of a mesh.
#[derive(Clone, Copy)]
pub(super) enum Border {
    /// All levels have the same border.
    Locked,
    /// Each level may have another border.
    Free,
}

/// The geometry and up to `coarser` coarser versions of it.
pub(super) fn levels(full: Geometry, coarser: u32, border: Border) -> Vec<Geometry> {
    let mut levels = vec![full];
    for _ in 0..coarser {
        let enough = |last: &&Geometry| last.indices.len() / 3 >= LEAST && last.is_collapsible();
        let Some(last) = levels.last().filter(enough) else {
            break;
        };
        let Some(vertices) = adapter(last) else {
            break;
        };
        let options = match border {
            Border::Locked => SimplifyOptions::LockBorder,
            Border::Free => SimplifyOptions::None,
        };
        let target = last.indices.len() / 3 / STEP * 3;
        let indices = meshopt::simplify(&last.indices, &vertices, target, 1.0, options, None);
        if indices.is_empty() || indices.len() as f64 > last.indices.len() as f64 * WORTH {
            break;
        }
        let next = super::split::compact(last, &indices);
        levels.push(next);
    }
    levels
}

fn adapter(geometry: &Geometry) -> Option<VertexDataAdapter<'_>> {
    let bytes = bytemuck::cast_slice(&geometry.positions);
    VertexDataAdapter::new(bytes, size_of::<[f32; 3]>(), 0).ok()
}

/// The number of triangles with the less frequent winding in the plan.
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
