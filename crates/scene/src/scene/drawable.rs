//! The mesh and material of an entity.

use crate::keys::{MaterialKey, MeshKey};

/// The mesh and the material of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Drawable {
    /// The mesh.
    pub mesh: MeshKey,
    /// The material.
    pub material: MaterialKey,
}
