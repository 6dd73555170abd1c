//! Surfaces out of points in the world: the origin near their middle, f32 around it, smooth normals.

use antumbra_scene::Geometry;
use glam::DVec3;

use crate::surface::{Surface, SurfaceKind};

/// Metres from the world's zero; what lies further out is no place on Earth, and too coarse in f64 to be drawn.
pub(crate) const MAX_COORDINATE: f64 = 1e12;

/// A point that a surface can have.
pub(crate) fn is_place(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= MAX_COORDINATE
}

/// All points must be places, and all triangles among them. `plan` is empty or as long as the points.
pub(crate) fn surface(
    name: String,
    kind: SurfaceKind,
    points: &[DVec3],
    triangles: &[[u32; 3]],
    plan: Vec<[f32; 2]>,
) -> Surface {
    let low = points.iter().copied().reduce(DVec3::min);
    let high = points.iter().copied().reduce(DVec3::max);
    let origin = (low.unwrap_or_default() + high.unwrap_or_default()) * 0.5;
    let positions = points.iter().map(|&point| (point - origin).as_vec3());
    let geometry = Geometry {
        positions: positions.map(|position| position.to_array()).collect(),
        indices: triangles.as_flattened().to_vec(),
        ..Geometry::default()
    };
    Surface {
        name,
        kind,
        origin,
        geometry: geometry.with_computed_normals(),
        plan,
    }
}
