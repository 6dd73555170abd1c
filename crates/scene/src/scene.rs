//! The scene: entities as generational keys into slotmap arenas, their components beside them, and one call a frame,
//! [`Scene::update`], that says which drawable entities came, went and moved.

mod assets;
mod changes;
mod components;
mod dense;
mod links;
#[cfg(feature = "simplify")]
mod proxies;
mod update;

pub use changes::SceneChanges;
pub use components::PlacedLight;

use crate::bounds::Aabb;
use crate::camera::Camera;
use crate::environment::Environment;
use crate::error::SceneError;
use crate::keys::{EntityKey, ImageKey, MaterialKey, MeshKey};
use crate::light::Light;
use crate::material::{Image, Material};
use crate::mesh::Mesh;
use changes::Ledger;
use dense::{ATTACH, Dense, MOVE, REFIT, SCENE};
use glam::DAffine3;
use links::Links;
use slotmap::{Key as _, SecondaryMap, SlotMap, SparseSecondaryMap};

/// What an entity looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Drawable {
    /// Its geometry.
    pub mesh: MeshKey,
    /// Its surface.
    pub material: MaterialKey,
}

/// A tree of entities with transforms, meshes, lights and cameras. World positions are f64 metres, right-handed, +Y up.
///
/// Transforms and boxes in the world are those of the last [`update`](Self::update); [`world`](Self::world) alone is
/// always exact.
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
    links: Links,
    dense: Dense,
    names: SecondaryMap<EntityKey, String>,
    drawables: SecondaryMap<EntityKey, Drawable>,
    untested: SparseSecondaryMap<EntityKey, ()>,
    lights: SparseSecondaryMap<EntityKey, Light>,
    cameras: SparseSecondaryMap<EntityKey, Camera>,
    meshes: SlotMap<MeshKey, Mesh>,
    mesh_boxes: update::MeshBoxes,
    materials: SlotMap<MaterialKey, Material>,
    images: SlotMap<ImageKey, Image>,
    environment: Option<Environment>,
    /// Entities whose dense state asks for something; may hold keys of entities that are gone.
    listed: Vec<EntityKey>,
    ledger: Ledger,
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
    /// A scene without an entity, named "scene".
    #[must_use]
    pub fn new() -> Self {
        Self {
            name: "scene".to_owned(),
            links: Links::default(),
            dense: Dense::new(),
            names: SecondaryMap::new(),
            drawables: SecondaryMap::new(),
            untested: SparseSecondaryMap::new(),
            lights: SparseSecondaryMap::new(),
            cameras: SparseSecondaryMap::new(),
            meshes: SlotMap::with_key(),
            mesh_boxes: SecondaryMap::new(),
            materials: SlotMap::with_key(),
            images: SlotMap::with_key(),
            environment: None,
            listed: Vec::new(),
            ledger: Ledger::default(),
        }
    }

    /// The scene's name, for people and reports.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Names the scene.
    pub fn set_name(&mut self, name: impl Into<String>) {
        self.name = name.into();
    }

    /// Adds an entity below `parent`, or a root.
    ///
    /// # Errors
    /// An unknown parent; a transform that is not finite; 2^32 entities. Zero scales are fine.
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
        if self.dense.len() >= Self::LIMIT as usize {
            return Err(SceneError::Full { limit: Self::LIMIT });
        }
        let entity = self.links.entries.insert(links::Entry::default());
        self.links.attach(entity, parent);
        let slot = self.dense.push(entity, parent_slot, local);
        self.set_slot(entity, slot);
        self.ask(entity, 0);
        Ok(entity)
    }

    /// Removes an entity and everything below it; how many entities that were (0 if it was unknown).
    pub fn despawn(&mut self, entity: EntityKey) -> usize {
        let Some(slot) = self.links.get(entity).map(|entry| entry.slot) else {
            return 0;
        };
        self.leave_parent(slot);
        let gone = self.links.subtree(entity);
        self.links.detach(entity);
        for &entity in &gone {
            if let Some(entry) = self.links.entries.remove(entity) {
                self.dense.remove(entry.slot);
            }
            self.names.remove(entity);
            self.drawables.remove(entity);
            self.untested.remove(entity);
            self.lights.remove(entity);
            self.cameras.remove(entity);
            self.ledger.despawned(entity);
        }
        gone.len()
    }

    /// Whether the entity is in the scene.
    #[must_use]
    pub fn contains(&self, entity: EntityKey) -> bool {
        self.links.entries.contains_key(entity)
    }

    /// How many entities there are, drawable or not.
    #[must_use]
    pub fn len(&self) -> usize {
        self.links.entries.len()
    }

    /// Whether there is no entity.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.links.entries.is_empty()
    }

    /// Every entity, in arena order.
    pub fn entities(&self) -> impl Iterator<Item = EntityKey> + '_ {
        self.links.entries.keys()
    }

    /// Places an entity relative to its parent.
    ///
    /// # Errors
    /// An unknown entity; a transform that is not finite.
    pub fn set_local(&mut self, entity: EntityKey, local: DAffine3) -> Result<(), SceneError> {
        let slot = self.known(entity)?;
        if !local.is_finite() {
            return Err(not_finite(self.describe(entity), &local));
        }
        self.dense.local[slot as usize] = local;
        self.ask(entity, MOVE);
        Ok(())
    }

    /// Where an entity is relative to its parent.
    #[must_use]
    pub fn local(&self, entity: EntityKey) -> Option<DAffine3> {
        let slot = self.links.get(entity)?.slot;
        self.dense.local.get(slot as usize).copied()
    }

    /// Where an entity is in the world, now: changes since the last update count.
    #[must_use]
    pub fn world(&self, entity: EntityKey) -> Option<DAffine3> {
        let slot = self.links.get(entity)?.slot as usize;
        if self.listed.is_empty() {
            return self.dense.world.get(slot).copied();
        }
        let mut chain = Vec::new();
        let mut above = slot;
        while above != SCENE as usize {
            chain.push(self.dense.local[above]);
            above = self.dense.parent[above] as usize;
        }
        chain.into_iter().rev().reduce(|world, local| world * local)
    }

    /// Hangs an entity below another parent, or makes it a root. Its local transform stays, so it moves with the parent.
    ///
    /// # Errors
    /// An unknown entity; a parent that is the entity itself or lies below it.
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
        self.leave_parent(slot);
        self.links.detach(entity);
        self.links.attach(entity, parent);
        self.dense.parent[slot as usize] = parent_slot;
        if parent_slot >= self.dense.run_start(slot) {
            for moved in self.links.subtree(entity) {
                let Some(entry) = self.links.get(moved) else {
                    continue;
                };
                let from = entry.slot;
                let parent = entry.parent.and_then(|parent| self.links.get(parent));
                let to = (self.dense).relocate(from, parent.map_or(SCENE, |parent| parent.slot));
                self.set_slot(moved, to);
            }
        }
        self.ask(entity, MOVE | ATTACH);
        self.ledger.reparented(entity);
        Ok(())
    }

    /// The entity above, if there is one.
    #[must_use]
    pub fn parent(&self, entity: EntityKey) -> Option<EntityKey> {
        self.links.get(entity)?.parent
    }

    /// The entities directly below, in the order in which they were hung there.
    pub fn children(&self, entity: EntityKey) -> impl Iterator<Item = EntityKey> + '_ {
        let first = self
            .links
            .get(entity)
            .and_then(|entry| entry.children.first);
        self.links.siblings(first)
    }

    /// The entities without a parent.
    pub fn roots(&self) -> impl Iterator<Item = EntityKey> + '_ {
        self.links.siblings(self.links.roots.first)
    }

    /// Names an entity; names need not be unique.
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

    /// The box around a drawable entity in the world as of the last update, widened outwards by rounding. `None` if the
    /// entity is not drawable, its mesh has no vertex, or its transform left the range of f64.
    #[must_use]
    pub fn world_bounds(&self, entity: EntityKey) -> Option<Aabb> {
        let slot = self.links.get(entity)?.slot as usize;
        self.dense.own.get(slot).copied().filter(|b| !b.is_empty())
    }

    /// The box around everything drawable at and below an entity as of the last update.
    #[must_use]
    pub fn subtree_bounds(&self, entity: EntityKey) -> Option<Aabb> {
        let slot = self.links.get(entity)?.slot as usize;
        (self.dense.subtree.get(slot).copied()).filter(|b| !b.is_empty())
    }

    /// The box around everything drawable as of the last update.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        let all = self.dense.subtree.get(SCENE as usize);
        all.copied().filter(|b| !b.is_empty())
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
        match self.links.get(entity) {
            Some(entry) => Ok(entry.slot),
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
        if let Some(entry) = self.links.entries.get_mut(entity) {
            entry.slot = slot;
        }
    }

    /// Marks an entity for the next update.
    fn ask(&mut self, entity: EntityKey, what: u8) {
        if let Some(entry) = self.links.get(entity)
            && update::mark(&mut self.dense, entry.slot, what)
        {
            self.listed.push(entity);
        }
    }

    /// The box of `slot`'s subtree no longer counts in its parent's.
    fn leave_parent(&mut self, slot: u32) {
        let part = self.dense.part_in_parent(slot as usize);
        let parent = self.dense.parent[slot as usize];
        self.dense
            .part_changed(parent as usize, &part, &Aabb::EMPTY);
        if parent != SCENE && self.dense.state[parent as usize] & REFIT != 0 {
            self.ask(self.dense.key[parent as usize], REFIT);
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
