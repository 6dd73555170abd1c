//! A horizon or a fault at full resolution, from any source.

use antumbra_scene::Geometry;
use glam::DVec3;

use crate::error::SubsurfaceError;

/// A horizon or a fault at full resolution.
///
/// The world is the scene's: metres, right-handed, +X east, +Y up, +Z south.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// A name for messages, and for the surface's entity.
    pub name: String,
    /// Whether it is a horizon or a fault.
    pub kind: SurfaceKind,
    /// The position of the geometry's zero in the world. It is near the centre, so that f32 positions around it are
    /// precise.
    pub origin: DVec3,
    /// Triangles relative to `origin`, counter-clockwise from above for a horizon. Holes are missing triangles.
    pub geometry: Geometry,
    /// The position of each vertex in the plan of a horizon, 0..1 along its two sides. A horizon is a height field,
    /// so its triangles do not overlap there. Empty for a fault.
    pub plan: Vec<[f32; 2]>,
}

impl Surface {
    /// Refuses an inconsistent surface.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`]: an origin that is not finite, invalid geometry, or a horizon without a
    /// position in the plan, 0..1, for each vertex.
    pub fn check(&self) -> Result<(), SubsurfaceError> {
        let bad = |problem: String| {
            Err(SubsurfaceError::BadSurface {
                surface: self.name.clone(),
                problem,
            })
        };
        if !self.origin.is_finite() {
            return bad(format!("its origin {} is not finite", self.origin));
        }
        if let Some(problem) = self.geometry.problem() {
            return bad(problem);
        }
        if self.kind == SurfaceKind::Horizon {
            let (places, vertices) = (self.plan.len(), self.geometry.positions.len());
            if places != vertices {
                return bad(format!("{places} places in plan for {vertices} vertices"));
            }
            let outside = |place: &[f32; 2]| place.iter().any(|along| !(0.0..=1.0).contains(along));
            if let Some(vertex) = self.plan.iter().position(outside) {
                return bad(format!("vertex {vertex} lies outside its plan, 0 to 1"));
            }
        }
        Ok(())
    }
}

/// The kind of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceKind {
    /// The boundary between two layers of rock, a height field. It is cut into tiles.
    Horizon,
    /// A break in the rocks. It stays whole.
    Fault,
}
