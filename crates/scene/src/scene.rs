//! The scene: entities as generational keys into slotmap arenas, with their components beside them.
//!
//! [`Scene::update`] is called once a frame. It reports which drawable entities were added, removed and moved.

mod assets;
mod boxes;
mod change_log;
mod components;
mod deforming;
mod drawable;
mod propagate;
#[cfg(feature = "simplify")]
mod proxies;
mod reserve;
mod transforms;
mod tree;
mod update;

pub use change_log::SceneChanges;
pub use components::PlacedLight;
pub use drawable::Drawable;

use crate::bounds::Aabb;
use crate::camera::Camera;
use crate::environment::Environment;
use crate::error::SceneError;
use crate::keys::{EntityKey, ImageKey, MaterialKey, MeshKey};
use crate::light::Light;
use crate::material::{Image, Material};
use crate::mesh::Mesh;
use change_log::ChangeLog;
use glam::DAffine3;
use slotmap::{Key as _, SecondaryMap, SlotMap, SparseSecondaryMap};
use transforms::{NOT_IN_PARENT, SCENE, SUBTREE_DIRTY, TRANSFORM_DIRTY, TransformTable};
use tree::EntityTree;

/// A tree of entities with transforms, meshes, lights and cameras. World positions are f64 metres, right-handed, +Y
/// up.
///
/// World transforms and boxes are those of the last [`update`](Self::update). Only [`world`](Self::world) includes
/// later changes.
///
/// ```
/// use antumbra_scene::{Drawable, Geometry, Material, Mesh, Scene};
/// use glam::{DAffine3, DVec3};
///
/// let mut scene = Scene::new();
/// let triangle = Geometry {
///     positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
///     indices: vec![0, 1, 2],
///     ..Geometry::default()
/// };
/// let mesh = scene.add_mesh(Mesh::new("triangle", triangle))?;
/// let material = scene.add_material(Material::default());
/// let entity = scene.spawn(None, DAffine3::from_translation(DVec3::X))?;
/// scene.set_drawable(entity, Drawable { mesh, material })?;
/// assert_eq!(scene.update().added, [entity]);
/// # Ok::<(), antumbra_scene::SceneError>(())
/// ```
#[derive(Clone)]
pub struct Scene {
    name: String,
    tree: EntityTree,
    transforms: TransformTable,
    names: SecondaryMap<EntityKey, String>,
    drawables: SecondaryMap<EntityKey, Drawable>,
    untested: SparseSecondaryMap<EntityKey, ()>,
    lights: SparseSecondaryMap<EntityKey, Light>,
    cameras: SparseSecondaryMap<EntityKey, Camera>,
    meshes: SlotMap<MeshKey, Mesh>,
    mesh_bounds: propagate::MeshBounds,
    deforming: deforming::Deforming,
    materials: SlotMap<MaterialKey, Material>,
    images: SlotMap<ImageKey, Image>,
    environment: Option<Environment>,
    /// Entities with dirty flags. It may contain keys of removed entities.
    queued: Vec<EntityKey>,
    changes: ChangeLog,
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Scene")
            .field("name", &self.name)
            .field("entities", &self.len())
            .field("drawables", &self.drawable_count())
            .field("meshes", &self.meshes.len())
            .field("materials", &self.materials.len())
            .field("images", &self.images.len())
            .finish_non_exhaustive()
    }
}

impl Scene {
    /// A scene without entities, named "scene".
    #[must_use]
    pub fn new() -> Self {
        Self {
            name: "scene".to_owned(),
            tree: EntityTree::default(),
            transforms: TransformTable::new(),
            names: SecondaryMap::new(),
            drawables: SecondaryMap::new(),
            untested: SparseSecondaryMap::new(),
            lights: SparseSecondaryMap::new(),
            cameras: SparseSecondaryMap::new(),
            meshes: SlotMap::with_key(),
            mesh_bounds: SecondaryMap::new(),
            deforming: deforming::Deforming::default(),
            materials: SlotMap::with_key(),
            images: SlotMap::with_key(),
            environment: None,
            queued: Vec::new(),
            changes: ChangeLog::default(),
        }
    }

    /// The scene's name, for messages and reports.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Sets the scene's name.
    pub fn set_name(&mut self, name: impl Into<String>) {
        self.name = name.into();
    }

    /// Adds an entity as a child of `parent`, or as a root. `local` is its transform relative to the parent.
    ///
    /// # Errors
    /// An unknown parent; a transform that is not finite; 2^32 entities. A scale of zero is valid.
    pub fn spawn(
        &mut self,
        parent: Option<EntityKey>,
        local: DAffine3,
    ) -> Result<EntityKey, SceneError> {
        let parent_slot = self.slot_of(parent)?;
        if !local.is_finite() {
            let entity = match parent {
                Some(parent) => format!("a new entity below {}", self.describe(parent)),
                None => "a new root entity".to_owned(),
            };
            return Err(not_finite(entity, &local));
        }
        if self.transforms.len() >= Self::LIMIT as usize {
            return Err(SceneError::Full { limit: Self::LIMIT });
        }
        let entity = self.tree.nodes.insert(tree::TreeNode::default());
        self.tree.attach(entity, parent);
        let slot = self.transforms.push(entity, parent_slot, local);
        self.set_slot(entity, slot);
        self.mark_dirty(entity, 0);
        Ok(entity)
    }

    /// Removes an entity and all its descendants. Returns the number of removed entities, 0 for an unknown entity.
    pub fn despawn(&mut self, entity: EntityKey) -> usize {
        let Some(slot) = self.tree.get(entity).map(|node| node.slot) else {
            return 0;
        };
        self.remove_from_parent_bounds(slot);
        let gone = self.tree.subtree(entity);
        self.tree.detach(entity);
        for &entity in &gone {
            if let Some(node) = self.tree.nodes.remove(entity) {
                self.transforms.remove(node.slot);
            }
            self.names.remove(entity);
            if let Some(had) = self.drawables.remove(entity) {
                self.deforming.unused(had.mesh, entity);
            }
            self.untested.remove(entity);
            self.lights.remove(entity);
            self.cameras.remove(entity);
            self.changes.despawned(entity);
        }
        gone.len()
    }

    /// Whether the entity is in the scene.
    #[must_use]
    pub fn contains(&self, entity: EntityKey) -> bool {
        self.tree.nodes.contains_key(entity)
    }

    /// The number of entities, drawable or not.
    #[must_use]
    pub fn len(&self) -> usize {
        self.tree.nodes.len()
    }

    /// Whether the scene has no entities.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tree.nodes.is_empty()
    }

    /// Every entity, in arena order.
    pub fn entities(&self) -> impl Iterator<Item = EntityKey> + '_ {
        self.tree.nodes.keys()
    }

    /// Sets an entity's transform relative to its parent.
    ///
    /// # Errors
    /// An unknown entity; a transform that is not finite.
    pub fn set_local(&mut self, entity: EntityKey, local: DAffine3) -> Result<(), SceneError> {
        let slot = self.known(entity)?;
        if !local.is_finite() {
            return Err(not_finite(self.describe(entity), &local));
        }
        self.transforms.local[slot as usize] = local;
        self.mark_dirty(entity, TRANSFORM_DIRTY);
        Ok(())
    }

    /// An entity's transform relative to its parent.
    #[must_use]
    pub fn local(&self, entity: EntityKey) -> Option<DAffine3> {
        let slot = self.tree.get(entity)?.slot;
        self.transforms.local.get(slot as usize).copied()
    }

    /// An entity's transform to the world, including changes since the last update.
    #[must_use]
    pub fn world(&self, entity: EntityKey) -> Option<DAffine3> {
        let slot = self.tree.get(entity)?.slot as usize;
        if self.queued.is_empty() {
            return self.transforms.world.get(slot).copied();
        }
        let mut chain = Vec::new();
        let mut above = slot;
        while above != SCENE as usize {
            chain.push(self.transforms.local[above]);
            above = self.transforms.parent[above] as usize;
        }
        chain.into_iter().rev().reduce(|world, local| world * local)
    }

    /// Moves an entity to another parent, or makes it a root. Its local transform stays, so its place in the world
    /// changes.
    ///
    /// # Errors
    /// An unknown entity; a parent that is the entity itself or one of its descendants.
    pub fn set_parent(
        &mut self,
        entity: EntityKey,
        parent: Option<EntityKey>,
    ) -> Result<(), SceneError> {
        let slot = self.known(entity)?;
        let parent_slot = self.slot_of(parent)?;
        let mut above = parent;
        while let Some(key) = above {
            if key == entity {
                return Err(SceneError::Cycle {
                    child: self.describe(entity),
                    parent: parent
                        .map(|parent| self.describe(parent))
                        .unwrap_or_default(),
                });
            }
            above = self.parent(key);
        }
        self.remove_from_parent_bounds(slot);
        self.tree.detach(entity);
        self.tree.attach(entity, parent);
        self.transforms.parent[slot as usize] = parent_slot;
        if parent_slot >= self.transforms.run_start(slot) {
            for moved in self.tree.subtree(entity) {
                let Some(node) = self.tree.get(moved) else {
                    continue;
                };
                let from = node.slot;
                let parent = node.parent.and_then(|parent| self.tree.get(parent));
                let to =
                    (self.transforms).relocate(from, parent.map_or(SCENE, |parent| parent.slot));
                self.set_slot(moved, to);
            }
        }
        self.mark_dirty(entity, TRANSFORM_DIRTY | NOT_IN_PARENT);
        self.changes.reparented(entity);
        Ok(())
    }

    /// The entity's parent; `None` for a root and for an unknown entity.
    #[must_use]
    pub fn parent(&self, entity: EntityKey) -> Option<EntityKey> {
        self.tree.get(entity)?.parent
    }

    /// The entity's children, in the order in which they were added.
    pub fn children(&self, entity: EntityKey) -> impl Iterator<Item = EntityKey> + '_ {
        let first = self.tree.get(entity).and_then(|node| node.children.first);
        self.tree.siblings(first)
    }

    /// The entities without a parent.
    pub fn roots(&self) -> impl Iterator<Item = EntityKey> + '_ {
        self.tree.siblings(self.tree.roots.first)
    }

    /// Sets an entity's name. Names need not be unique.
    ///
    /// # Errors
    /// An unknown entity.
    pub fn set_entity_name(
        &mut self,
        entity: EntityKey,
        name: impl Into<String>,
    ) -> Result<(), SceneError> {
        self.known(entity)?;
        let name = name.into();
        if name.is_empty() {
            self.names.remove(entity);
        } else {
            self.names.insert(entity, name);
        }
        Ok(())
    }

    /// The entity's name; empty if it has none or is unknown.
    #[must_use]
    pub fn entity_name(&self, entity: EntityKey) -> &str {
        self.names.get(entity).map_or("", String::as_str)
    }

    /// The entity's name and key, for messages.
    #[must_use]
    pub fn describe(&self, entity: EntityKey) -> String {
        match self.entity_name(entity) {
            "" => format!("entity {:?}", entity.data()),
            name => format!("entity \"{name}\" ({:?})", entity.data()),
        }
    }

    const LIMIT: u32 = u32::MAX - 1;

    fn known(&self, entity: EntityKey) -> Result<u32, SceneError> {
        match self.tree.get(entity) {
            Some(node) => Ok(node.slot),
            None => Err(SceneError::UnknownEntity {
                entity: self.describe(entity),
                scene: self.name.clone(),
            }),
        }
    }

    fn slot_of(&self, parent: Option<EntityKey>) -> Result<u32, SceneError> {
        parent.map_or(Ok(SCENE), |parent| self.known(parent))
    }

    fn set_slot(&mut self, entity: EntityKey, slot: u32) {
        if let Some(node) = self.tree.nodes.get_mut(entity) {
            node.slot = slot;
        }
    }

    /// Sets dirty flags of an entity for the next update.
    fn mark_dirty(&mut self, entity: EntityKey, what: u8) {
        if let Some(node) = self.tree.get(entity)
            && self.transforms.set_flags(node.slot, what)
        {
            self.queued.push(entity);
        }
    }

    /// Removes the box of `slot`'s subtree from its parent's.
    fn remove_from_parent_bounds(&mut self, slot: u32) {
        let part = self.transforms.part_in_parent(slot as usize);
        let parent = self.transforms.parent[slot as usize];
        self.transforms
            .part_changed(parent as usize, &part, &Aabb::EMPTY);
        if parent != SCENE && self.transforms.flags[parent as usize] & SUBTREE_DIRTY != 0 {
            self.mark_dirty(self.transforms.key[parent as usize], SUBTREE_DIRTY);
        }
    }
}

fn not_finite(entity: String, local: &DAffine3) -> SceneError {
    SceneError::NotFinite {
        entity,
        what: "local transform",
        value: local.to_string(),
    }
}
