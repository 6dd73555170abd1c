//! Construction of surfaces from points in the world: an origin near their centre, f32 positions around it, and
//! smooth normals.

use antumbra_scene::Geometry;
use glam::DVec3;

use crate::surface::{Surface, SurfaceKind};

/// The greatest distance of a coordinate from zero, in metres. It is far beyond any place on Earth, and beyond the
/// precision of f64 for drawing.
pub(crate) const MAX_COORDINATE: f64 = 1e12;

/// Whether a surface can have this point.
pub(crate) fn is_place(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= MAX_COORDINATE
}

/// A surface of points and triangles between them. All points must be valid ([`is_place`]), and all triangles must
/// index them. `plan` is empty or has one entry per point.
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
