//! Visibility by brute force, triangle by triangle: it assumes nothing about surfaces, boundaries or the position of the viewpoint.

use antumbra_terrain::Field;
use glam::{DVec2, DVec3};

/// Triangles of one or several fields, in the coordinates of the first.
pub struct BruteForce {
    triangles: Vec<[DVec3; 3]>,
}

impl BruteForce {
    pub fn of<'a>(fields: impl IntoIterator<Item = &'a Field>) -> Self {
        let mut triangles = Vec::new();
        let mut first = None;
        for field in fields {
            let shift = field.origin() - *first.get_or_insert(field.origin());
            let all = 0..field.triangles().len() as u32;
            triangles.extend(all.map(|at| field.corners(at).map(|corner| corner + shift)));
        }
        Self { triangles }
    }

    /// Whether a triangle that is seen from above, and is farther from the viewpoint than `near` metres, hides a point. A triangle seen from
    /// below hides nothing: it may not be drawn.
    pub fn hides(&self, eye: DVec3, point: DVec3, near: f64) -> bool {
        let way = point - eye;
        let [low, high] = [eye.truncate(), point.truncate()];
        let [low, high] = [low.min(high), low.max(high)];
        let nearest = (near / way.length()).max(1e-9);
        self.triangles.iter().any(|&[a, b, c]| {
            let plan: [DVec2; 3] = [a, b, c].map(DVec3::truncate);
            let beside = plan.iter().all(|at| at.x < low.x)
                || plan.iter().all(|at| at.x > high.x)
                || plan.iter().all(|at| at.y < low.y)
                || plan.iter().all(|at| at.y > high.y);
            if beside {
                return false;
            }
            let normal = (b - a).cross(c - a);
            let [above, sinks] = [normal.dot(eye - a), -normal.dot(way)];
            if above <= 0.0 || sinks <= 0.0 {
                return false;
            }
            let share = above / sinks;
            let at = (eye + way * share).truncate();
            let [p, q, r] = plan;
            let slack = -1e-9 * normal.z;
            let inside = (q - p).perp_dot(at - p) >= slack
                && (r - q).perp_dot(at - q) >= slack
                && (p - r).perp_dot(at - r) >= slack;
            share > nearest && share < 1.0 - 1e-7 && inside
        })
    }
}
