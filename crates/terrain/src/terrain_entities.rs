//! What a horizon strategy knows of a scene: its terrains, the entities that show them, and the other entities that were prepared.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

use antumbra_scene::{Aabb, EntityKey, Scene};
use glam::DVec3;

use crate::field::NONE;
use crate::prepared_entities::{Preparation, PreparedEntities};
use crate::show::ShownTerrain;
use crate::terrain::Terrain;
use crate::world::to_world;

/// Terrains and their entities.
#[derive(Debug, Default)]
pub(crate) struct TerrainEntities {
    terrains: Vec<Arc<Terrain>>,
    /// The number of entities of each terrain.
    counts: Vec<usize>,
    entities: HashMap<EntityKey, TerrainEntity>,
    prepared: RwLock<Arc<PreparedEntities>>,
}

/// An entity that shows triangles of a terrain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TerrainEntity {
    /// The index of its terrain.
    pub terrain: usize,
    /// The group that it shows, or [`NONE`] for ungrouped triangles.
    pub group: u32,
    /// Its bounding box in the world, as it was shown.
    pub bounds: Aabb,
}

impl TerrainEntities {
    /// Adds a terrain and its entities.
    pub fn add(&mut self, terrain: Arc<Terrain>, shown: &ShownTerrain) {
        let index = self.terrains.len();
        let before = self.entities.len();
        let groups = terrain.groups();
        for shown in &shown.groups {
            let group = groups.groups().get(shown.group as usize);
            let triangles = group.map_or(&[][..], |group| groups.triangles(group));
            let entity = TerrainEntity {
                terrain: index,
                group: shown.group,
                bounds: bounds(&terrain, triangles),
            };
            self.entities.insert(shown.entity, entity);
        }
        for shown in &shown.ungrouped {
            let entity = TerrainEntity {
                terrain: index,
                group: NONE,
                bounds: bounds(&terrain, &shown.triangles),
            };
            self.entities.insert(shown.entity, entity);
        }
        self.counts.push(self.entities.len() - before);
        self.terrains.push(terrain);
    }

    /// The terrains, in the order in which they were added.
    pub fn terrains(&self) -> &[Arc<Terrain>] {
        &self.terrains
    }

    /// The number of entities of a terrain.
    pub fn count(&self, terrain: usize) -> usize {
        self.counts.get(terrain).copied().unwrap_or_default()
    }

    /// What an entity shows; `None` for an entity that shows no terrain.
    pub fn get(&self, entity: EntityKey) -> Option<&TerrainEntity> {
        self.entities.get(&entity)
    }

    /// The prepared entities.
    pub fn prepared(&self) -> Arc<PreparedEntities> {
        let prepared = self.prepared.read();
        Arc::clone(&prepared.unwrap_or_else(PoisonError::into_inner))
    }

    /// Prepares all entities of a scene that do not show terrain. Returns how many were new or had moved.
    pub fn prepare(&self, scene: &Scene, done: &(dyn Fn() + Sync)) -> usize {
        let own = |entity| self.entities.contains_key(&entity);
        let before = self.prepared();
        let Preparation { entities, new } = before.prepare(&self.terrains, scene, own, done);
        let mut prepared = self
            .prepared
            .write()
            .unwrap_or_else(PoisonError::into_inner);
        *prepared = Arc::new(entities);
        new
    }
}

/// The bounding box of some triangles in the world.
fn bounds(terrain: &Terrain, triangles: &[u32]) -> Aabb {
    let field = terrain.field();
    let corners = triangles
        .iter()
        .flat_map(|&triangle| field.corners(triangle));
    let world = |corner: DVec3| to_world(corner) + to_world(field.origin());
    Aabb::from_points(corners.map(world)).unwrap_or(Aabb::new(DVec3::ZERO, DVec3::ZERO))
}
