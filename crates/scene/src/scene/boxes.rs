//! The boxes of entities, subtrees and the whole scene, as of the last update.

use super::Scene;
use super::transforms::SCENE;
use crate::bounds::Aabb;
use crate::keys::EntityKey;

impl Scene {
    /// The box around a drawable entity in the world at the last update, rounded outwards. `None` if the entity is
    /// not drawable, its mesh has no vertex, or its transform exceeds the range of f64.
    #[must_use]
    pub fn world_bounds(&self, entity: EntityKey) -> Option<Aabb> {
        let slot = self.tree.get(entity)?.slot as usize;
        self.transforms
            .bounds
            .get(slot)
            .copied()
            .filter(|b| !b.is_empty())
    }

    /// The box around an entity's drawable and those of its descendants, at the last update.
    #[must_use]
    pub fn subtree_bounds(&self, entity: EntityKey) -> Option<Aabb> {
        let slot = self.tree.get(entity)?.slot as usize;
        (self.transforms.subtree_bounds.get(slot).copied()).filter(|b| !b.is_empty())
    }

    /// The box around all drawables at the last update.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        let all = self.transforms.subtree_bounds.get(SCENE as usize);
        all.copied().filter(|b| !b.is_empty())
    }
}
