//! The entities of a scene that stand on terrains, and the regions that their bounding boxes are hidden from.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_scene::{Aabb, EntityKey, Scene, Topology};
use glam::DVec3;

use crate::box_regions::BoxRegions;
use crate::terrain::Terrain;
use crate::world::from_world;

/// A prepared entity.
#[derive(Debug)]
pub(crate) struct PreparedEntity {
    /// The regions hold as long as the entity lies within this box of the world.
    pub within: Aabb,
    /// The regions that each terrain hides it from.
    pub regions: Vec<BoxRegions>,
}

/// All prepared entities of a scene.
#[derive(Debug, Clone, Default)]
pub(crate) struct PreparedEntities {
    entities: HashMap<EntityKey, Arc<PreparedEntity>>,
}

/// The result of preparing a scene's entities.
pub(crate) struct Preparation {
    pub entities: PreparedEntities,
    /// How many of them were not prepared before, or had moved.
    pub new: usize,
}

/// An entity whose regions are being found.
struct NewEntity {
    key: EntityKey,
    within: Aabb,
    regions: Vec<BoxRegions>,
}

impl PreparedEntities {
    /// The prepared entity, if it still lies in its box: `bounds` is its bounding box now.
    pub fn get(&self, entity: EntityKey, bounds: &Aabb) -> Option<&Arc<PreparedEntity>> {
        let prepared = self.entities.get(&entity)?;
        prepared.within.contains_box(bounds).then_some(prepared)
    }

    /// Prepares a scene's entities, except those that are `skipped`. Entities that have not moved are taken over from `self`. `done` is called
    /// once for each finished sector of each terrain.
    pub fn prepare(
        &self,
        terrains: &[Arc<Terrain>],
        scene: &Scene,
        skipped: impl Fn(EntityKey) -> bool,
        done: &(dyn Fn() + Sync),
    ) -> Preparation {
        let mut entities = HashMap::new();
        let mut new: Vec<NewEntity> = Vec::new();
        for (key, drawable) in scene.drawables() {
            let mesh = scene.mesh(drawable.mesh);
            // Lines and points are drawn wider than their bounding boxes.
            let solid = mesh.is_some_and(|mesh| {
                let levels = &mut mesh.levels.iter();
                levels.all(|level| level.topology == Topology::Triangles)
            });
            let bounds = scene.world_bounds(key).filter(|bounds| bounds.is_finite());
            let Some(bounds) = bounds.filter(|_| solid && scene.is_tested(key)) else {
                continue;
            };
            if skipped(key) {
                continue;
            }
            let within = bounds.grown(DVec3::splat(slack(&bounds)));
            let known = self.entities.get(&key);
            match known.filter(|prepared| prepared.within == within) {
                Some(known) => drop(entities.insert(key, Arc::clone(known))),
                None => new.push(NewEntity {
                    key,
                    within,
                    regions: Vec::with_capacity(terrains.len()),
                }),
            }
        }
        let count = new.len();
        for terrain in terrains {
            let local = |at| from_world(at) - terrain.field().origin();
            let boxes: Vec<_> = new
                .iter()
                .map(|entity| {
                    let [a, b] = [entity.within.min, entity.within.max].map(local);
                    [a.min(b), a.max(b)]
                })
                .collect();
            let found = terrain.box_regions(&boxes, done);
            for (entity, regions) in new.iter_mut().zip(found) {
                entity.regions.push(regions);
            }
        }
        for NewEntity {
            key,
            within,
            regions,
        } in new
        {
            entities.insert(key, Arc::new(PreparedEntity { within, regions }));
        }
        Preparation {
            entities: Self { entities },
            new: count,
        }
    }
}

/// The tolerance of a box for rounding, metres.
pub(crate) fn slack(bounds: &Aabb) -> f64 {
    1e-3 + 1e-6 * bounds.min.abs().max(bounds.max.abs()).max_element()
}
