//! Meshes and lights as the judge knows them, by entity.

mod shape;

use antumbra::cull::Gpu;
use antumbra::cull::judge::{InstanceDesc, InstanceId, Instances, JudgeError, Part};
use antumbra::glam::{DAffine3, DVec3};
use antumbra::scene::Aabb as Bounds;
use bevy::ecs::entity::EntityHashMap;
use bevy::prelude::*;

use crate::roundness::Roundness;
pub(crate) use shape::{Shape, bounds_of};

/// Everything that can be culled. One set for all views.
pub(crate) struct Occludees {
    pub instances: Instances,
    pub roundness: Roundness,
    /// Meshes and lights: an entity may be both.
    tracked: [EntityHashMap<Tracked>; 2],
    /// What is tested as its way.
    moving: Vec<(Kind, Entity)>,
    /// Counts meshes that became others.
    pub changed_meshes: u64,
    /// Counts extractions: boxes reach the device in them.
    pub epoch: u64,
}

/// What is known of a mesh or a light.
#[derive(Debug, Clone, Copy)]
struct Tracked {
    id: InstanceId,
    /// What it is now.
    now: Shape,
    /// Its box in the world.
    bounds: Bounds,
    /// A box along the world's axes that holds it for some frames, where that is tested in place of the shape that it is now.
    way: Option<Bounds>,
    /// The epoch with which what is tested reaches the device.
    since: u64,
    /// The epoch in which it was another shape for the last time.
    moved: u64,
}

/// What an entity is tested as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Mesh,
    Light,
}

/// A mesh or a light that is tested.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found {
    /// The place of its bit.
    pub index: u32,
    /// Its box in the world.
    pub bounds: Bounds,
    /// The epoch since which it is tested as it is.
    pub since: u64,
}

/// For so many frames what moves is expected to go on.
const FRAMES_AHEAD: f64 = 8.0;
/// What has stood still for so many frames is tested as itself again.
const FRAMES_AT_REST: u64 = 16;

impl Occludees {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            instances: Instances::new(gpu),
            roundness: Roundness::default(),
            tracked: Default::default(),
            moving: Vec::new(),
            changed_meshes: 0,
            epoch: 0,
        }
    }

    /// Takes over a shape. One that cannot be tested, for its numbers are not finite or there are too many, is not tracked, and so never culled.
    pub fn put(&mut self, entity: Entity, shape: Shape) {
        let outcome = match self.of(shape.kind()).contains_key(&entity) {
            true => self.change(entity, shape),
            false => self.insert(entity, shape),
        };
        if let Err(error) = outcome {
            debug!("antumbra: {entity} is not tested: {error}");
            self.remove(shape.kind(), entity);
        }
    }

    fn insert(&mut self, entity: Entity, shape: Shape) -> Result<(), JudgeError> {
        let (bounds, at) = shape.oriented();
        let id = self.instances.insert(InstanceDesc {
            bounds,
            at,
            // A box alone hides nothing.
            part: Part::Occludee,
        })?;
        self.instances.set_roundness(id, shape.roundness())?;
        let tracked = Tracked {
            id,
            now: shape,
            bounds: shape.bounds(),
            way: None,
            since: self.epoch,
            moved: self.epoch,
        };
        self.of_mut(shape.kind()).insert(entity, tracked);
        Ok(())
    }

    fn change(&mut self, entity: Entity, shape: Shape) -> Result<(), JudgeError> {
        let (kind, epoch) = (shape.kind(), self.epoch);
        let Some(tracked) = self.of_mut(kind).get_mut(&entity) else {
            return Ok(());
        };
        if tracked.now == shape {
            return Ok(());
        }
        let before = std::mem::replace(&mut tracked.bounds, shape.bounds());
        tracked.now = shape;
        tracked.moved = epoch;
        // What was found about the larger box is true of what is inside.
        if tracked
            .way
            .is_some_and(|way| way.contains_box(&tracked.bounds))
        {
            return Ok(());
        }
        let way = moving_on(&before, &tracked.bounds);
        let was_still = tracked.way.replace(way).is_none();
        tracked.since = epoch;
        let id = tracked.id;
        if was_still {
            self.moving.push((kind, entity));
        }
        self.instances.set_bounds(id, way, DAffine3::IDENTITY)
    }

    /// Has what has come to rest tested as itself again.
    pub fn settle(&mut self) {
        let Self {
            instances,
            tracked: [meshes, lights],
            moving,
            epoch,
            ..
        } = self;
        moving.retain(|(kind, entity)| {
            let of = match kind {
                Kind::Mesh => &mut *meshes,
                Kind::Light => &mut *lights,
            };
            let Some(tracked) = of.get_mut(entity) else {
                return false;
            };
            if tracked.way.is_none() {
                return false;
            }
            if *epoch < tracked.moved + FRAMES_AT_REST {
                return true;
            }
            let (bounds, at) = tracked.now.oriented();
            let outcome = instances
                .set_bounds(tracked.id, bounds, at)
                .and_then(|()| instances.set_roundness(tracked.id, tracked.now.roundness()));
            if let Err(error) = outcome {
                // Its way holds it as well.
                debug!("antumbra: {entity} stays as it was tested: {error}");
                return false;
            }
            tracked.way = None;
            tracked.since = *epoch;
            false
        });
    }

    /// Forgets a mesh or a light.
    pub fn remove(&mut self, kind: Kind, entity: Entity) {
        if let Some(tracked) = self.of_mut(kind).remove(&entity)
            && let Err(error) = self.instances.remove(tracked.id)
        {
            warn!("antumbra: {error}");
        }
    }

    /// What is known of a mesh or a light; `None` where it is not tested.
    pub fn find(&self, kind: Kind, entity: Entity) -> Option<Found> {
        let tracked = self.of(kind).get(&entity)?;
        Some(Found {
            index: tracked.id.index(),
            bounds: tracked.bounds,
            since: tracked.since,
        })
    }

    fn of(&self, kind: Kind) -> &EntityHashMap<Tracked> {
        let [meshes, lights] = &self.tracked;
        match kind {
            Kind::Mesh => meshes,
            Kind::Light => lights,
        }
    }

    fn of_mut(&mut self, kind: Kind) -> &mut EntityHashMap<Tracked> {
        let [meshes, lights] = &mut self.tracked;
        match kind {
            Kind::Mesh => meshes,
            Kind::Light => lights,
        }
    }
}

/// What a box covers in the next frames, if each takes it as far as the last. What goes farther than its own size has jumped, and is not expected to go on.
fn moving_on(before: &Bounds, now: &Bounds) -> Bounds {
    let step = now.centre() - before.centre();
    let half = now.half_extents();
    if step.length_squared() > 4.0 * half.length_squared() {
        return *now;
    }
    let ahead = step * FRAMES_AHEAD;
    let there = Bounds {
        min: now.min + ahead,
        max: now.max + ahead,
    };
    // What turns or breathes grows by some.
    now.union(&there).grown(half * 0.1)
}

impl Found {
    /// The distance of its box from a point, in metres; 0 inside.
    pub fn distance(&self, point: Vec3) -> f32 {
        let point = DVec3::from_array(point.to_array().map(f64::from));
        self.bounds.distance(point) as f32
    }
}
