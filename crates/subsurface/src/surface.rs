//! A horizon or a fault at full resolution, wherever it came from.

use antumbra_scene::Geometry;
use glam::DVec3;

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

/// What a surface is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceKind {
    /// The border between two layers of rock, a height field: it is cut into tiles.
    Horizon,
    /// A break in the rocks: it stays whole.
    Fault,
}
