//! The changes between two updates of a scene.

use super::drawable::Drawable;
use crate::keys::{EntityKey, ImageKey, MeshKey};
use slotmap::SecondaryMap;

/// The changes since the previous [`Scene::update`](super::Scene::update). Each list is in arena order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneChanges {
    /// Entities that became drawable, or whose mesh, material or role in tests changed (these are in `removed` too).
    pub added: Vec<EntityKey>,
    /// Entities that are no longer drawable or were removed, or whose mesh, material or role in tests changed.
    pub removed: Vec<EntityKey>,
    /// Entities whose world transform changed, or the vertices of whose mesh did, and that are otherwise drawn as before.
    pub moved: Vec<EntityKey>,
    /// Meshes with new vertices.
    pub deformed: Vec<MeshKey>,
    /// Entities, drawable or not, with another parent, or without a parent that they had.
    pub reparented: Vec<EntityKey>,
    /// Images with new pixels.
    pub images: Vec<ImageKey>,
    /// Whether the environment was set to another one or removed. New pixels of its image are reported in `images`
    /// alone.
    pub environment: bool,
}

impl SceneChanges {
    /// Whether nothing changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.added.is_empty()
            && self.removed.is_empty()
            && self.moved.is_empty()
            && self.deformed.is_empty()
            && self.reparented.is_empty()
            && self.images.is_empty()
            && !self.environment
    }
}

/// How an entity is drawn and tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DrawState {
    pub(super) drawable: Drawable,
    pub(super) tested: bool,
}

/// The state that the last update reported, and the changes since then.
#[derive(Clone, Debug, Default)]
pub(super) struct ChangeLog {
    pub(super) reported: SecondaryMap<EntityKey, DrawState>,
    pub(super) touched: Vec<EntityKey>,
    pub(super) despawned: Vec<EntityKey>,
    pub(super) reparented: Vec<EntityKey>,
    pub(super) changed_images: Vec<ImageKey>,
    pub(super) environment_changed: bool,
}

impl ChangeLog {
    /// Records that the entity has another parent.
    pub(super) fn reparented(&mut self, entity: EntityKey) {
        self.reparented.push(entity);
    }

    /// Records that the image has new pixels.
    pub(super) fn image_changed(&mut self, image: ImageKey) {
        self.changed_images.push(image);
    }

    /// Records that the environment has changed.
    pub(super) fn environment_changed(&mut self) {
        self.environment_changed = true;
    }

    /// Records that the entity's drawable or its role in tests was set or cleared.
    pub(super) fn touched(&mut self, entity: EntityKey) {
        self.touched.push(entity);
    }

    /// Records that the entity was removed.
    pub(super) fn despawned(&mut self, entity: EntityKey) {
        if self.reported.remove(entity).is_some() {
            self.despawned.push(entity);
        }
    }
}
