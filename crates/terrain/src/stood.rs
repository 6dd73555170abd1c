//! The entities of a scene that stand on a terrain: which of them were prepared, and as what.

use std::collections::HashMap;
use std::sync::Arc as Shared;

use antumbra_scene::{Aabb, EntityKey, Scene, Topology};

use crate::show::from_world;
use crate::standing::Stand;
use crate::terrain::Terrain;

/// An entity that was prepared.
#[derive(Debug)]
pub(crate) struct Placed {
    /// As long as it lies in this box of the world, it is hidden where the box is.
    pub within: Aabb,
    /// What each terrain hides of it.
    pub stands: Vec<Stand>,
}

/// All of a scene that were.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stood {
    placed: HashMap<EntityKey, Shared<Placed>>,
}

impl Stood {
    /// What is known of an entity that lies in some box now.
    pub fn at(&self, entity: EntityKey, now: &Aabb) -> Option<&Shared<Placed>> {
        let placed = self.placed.get(&entity)?;
        placed.within.contains_box(now).then_some(placed)
    }

    /// Prepares a scene's entities but for those `skipped`, and how many of them that were anew: who has not moved is taken over.
    pub fn prepare(
        &self,
        terrains: &[Shared<Terrain>],
        scene: &Scene,
        skipped: impl Fn(EntityKey) -> bool,
        done: &(dyn Fn() + Sync),
    ) -> (Self, usize) {
        let mut placed = HashMap::new();
        let mut new = Vec::new();
        for (entity, drawable) in scene.drawables() {
            let mesh = scene.mesh(drawable.mesh);
            // Lines and points are drawn wider than they are.
            let solid = mesh.is_some_and(|mesh| {
                let levels = &mut mesh.levels.iter();
                levels.all(|level| level.topology == Topology::Triangles)
            });
            let bounds = scene
                .world_bounds(entity)
                .filter(|bounds| bounds.is_finite());
            let Some(bounds) = bounds.filter(|_| solid && scene.is_tested(entity)) else {
                continue;
            };
            if skipped(entity) {
                continue;
            }
            let within = bounds.grown(glam::DVec3::splat(slack(&bounds)));
            match self
                .placed
                .get(&entity)
                .filter(|placed| placed.within == within)
            {
                Some(known) => drop(placed.insert(entity, Shared::clone(known))),
                None => new.push((entity, within)),
            }
        }
        let count = new.len();
        let mut placed_anew: Vec<_> = new
            .into_iter()
            .map(|(entity, within)| (entity, within, Vec::with_capacity(terrains.len())))
            .collect();
        for terrain in terrains {
            let local = |at| from_world(at) - terrain.field().origin();
            let boxes: Vec<_> = placed_anew
                .iter()
                .map(|(_, within, _)| {
                    let [a, b] = [within.min, within.max].map(local);
                    [a.min(b), a.max(b)]
                })
                .collect();
            let stands = terrain.stand(&boxes, done);
            for ((_, _, all), stand) in placed_anew.iter_mut().zip(stands) {
                all.push(stand);
            }
        }
        for (entity, within, stands) in placed_anew {
            placed.insert(entity, Shared::new(Placed { within, stands }));
        }
        (Self { placed }, count)
    }
}

/// How far a box may be off for what rounding does to it, metres.
pub(crate) fn slack(bounds: &Aabb) -> f64 {
    1e-3 + 1e-6 * bounds.min.abs().max(bounds.max.abs()).max_element()
}
