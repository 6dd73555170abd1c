//! A horizon or a fault at full resolution, wherever it came from.

use antumbra_scene::Geometry;
use glam::DVec3;

use crate::error::SubsurfaceError;

/// A horizon or a fault at full resolution.
///
/// The world is the scene's: metres, right-handed, +X east, +Y up, +Z south.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// For people, and the name of its entity.
    pub name: String,
    /// What it is.
    pub kind: SurfaceKind,
    /// Where the geometry's zero lies in the world. Near its middle, so that f32 is fine enough for what is around it.
    pub origin: DVec3,
    /// Triangles around `origin`, counter-clockwise seen from above for a horizon. Holes are triangles that are not there.
    pub geometry: Geometry,
    /// Where each vertex lies in the plan of a horizon, 0..1 along its two sides: a horizon is a height field, so no two of
    /// its triangles overlap there. Empty for a fault.
    pub plan: Vec<[f32; 2]>,
}

impl Surface {
    /// Refuses a surface whose parts do not fit together.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`]: an origin that is not finite, geometry that no scene would take, a horizon without a place in plan,
    /// 0..1, for each vertex.
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

/// What a surface is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceKind {
    /// The border between two layers of rock, a height field: it is cut into tiles.
    Horizon,
    /// A break in the rocks: it stays whole.
    Fault,
}
