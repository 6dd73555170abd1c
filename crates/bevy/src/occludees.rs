//! The boxes of meshes, as the judge knows them, by entity.

use antumbra::cull::Gpu;
use antumbra::cull::judge::{InstanceDesc, InstanceId, Instances, JudgeError, Part};
use antumbra::glam::{DAffine3, DVec3};
use antumbra::scene::Aabb as Bounds;
use bevy::camera::primitives::Aabb;
use bevy::ecs::entity::EntityHashMap;
use bevy::prelude::*;

use crate::roundness::Roundness;

/// All meshes that can be culled. One set for all cameras.
pub(crate) struct Occludees {
    pub instances: Instances,
    pub roundness: Roundness,
    /// Of meshes and of lights: an entity may be both.
    indices: [EntityHashMap<u32>; 2],
    /// By the index of the instance.
    tracked: Vec<Option<Tracked>>,
    /// Counts extractions: boxes reach the device in them.
    pub epoch: u64,
}

/// What is known of a mesh.
#[derive(Debug, Clone, Copy)]
struct Tracked {
    id: InstanceId,
    /// Its box in the world.
    now: WorldBox,
    /// How round it is in there.
    roundness: f32,
    /// What is tested, where that is more than its box: where it may be in the next frames.
    tested: Option<WorldBox>,
    /// The epoch with which what is tested reaches the device.
    since: u64,
}

/// What is tested.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shape<'a> {
    /// A mesh's box, its place, and how round it is.
    Mesh(&'a Aabb, &'a GlobalTransform, f32),
    /// A light's reach: its centre and its radius.
    Ball(Vec3, f32),
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
    pub now: WorldBox,
    /// The epoch since which it is tested as it is.
    pub since: u64,
}

/// A box along the world's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WorldBox {
    pub least: Vec3,
    pub most: Vec3,
}

/// For so many frames what moves is expected to go on.
const FRAMES_AHEAD: f32 = 8.0;

impl Occludees {
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            instances: Instances::new(gpu),
            roundness: Roundness::default(),
            indices: Default::default(),
            tracked: Vec::new(),
            epoch: 0,
        }
    }

    /// Takes over a shape. One that cannot be tested, for its numbers are not finite or there are too many, is not tracked, and so never culled.
    pub fn put(&mut self, entity: Entity, shape: Shape<'_>) {
        if let Err(error) = self.try_put(entity, shape) {
            debug!("antumbra: {entity} is not tested: {error}");
            self.remove(shape.kind(), entity);
        }
    }

    fn try_put(&mut self, entity: Entity, shape: Shape<'_>) -> Result<(), JudgeError> {
        let now = shape.in_world();
        let Some(index) = self.of(shape.kind()).get(&entity).copied() else {
            return self.insert(entity, shape, now);
        };
        let Some(Some(tracked)) = self.tracked.get_mut(index as usize) else {
            return Ok(());
        };
        let before = std::mem::replace(&mut tracked.now, now);
        let roundness = std::mem::replace(&mut tracked.roundness, shape.roundness());
        let is_same = before == now && (roundness == shape.roundness() || tracked.tested.is_some());
        if is_same || tracked.tested.is_some_and(|tested| tested.holds(&now)) {
            // What was found about the larger box is true of what is inside.
            return Ok(());
        }
        let tested = now.moving_on(now.middle() - before.middle());
        tracked.tested = Some(tested);
        tracked.since = self.epoch;
        let id = tracked.id;
        self.instances
            .set_bounds(id, tested.bounds(), DAffine3::IDENTITY)
    }

    fn insert(
        &mut self,
        entity: Entity,
        shape: Shape<'_>,
        now: WorldBox,
    ) -> Result<(), JudgeError> {
        let (bounds, at) = match shape {
            // Along its own axes, which is tighter than along the world's.
            Shape::Mesh(aabb, place, _) => {
                let [centre, half] = [aabb.center, aabb.half_extents].map(double);
                let columns = place.affine().to_cols_array().map(f64::from);
                let at = DAffine3::from_cols_array(&columns);
                (Bounds::from_centre(centre, half), at)
            }
            Shape::Ball(..) => (now.bounds(), DAffine3::IDENTITY),
        };
        let id = self.instances.insert(InstanceDesc {
            bounds,
            at,
            // A box alone hides nothing.
            part: Part::Occludee,
        })?;
        self.instances.set_roundness(id, shape.roundness())?;
        let index = id.index();
        self.of_mut(shape.kind()).insert(entity, index);
        let length = self.tracked.len().max(index as usize + 1);
        self.tracked.resize(length, None);
        if let Some(place) = self.tracked.get_mut(index as usize) {
            *place = Some(Tracked {
                id,
                now,
                roundness: shape.roundness(),
                tested: None,
                since: self.epoch,
            });
        }
        Ok(())
    }

    /// Forgets a mesh or a light.
    pub fn remove(&mut self, kind: Kind, entity: Entity) {
        let Some(index) = self.of_mut(kind).remove(&entity) else {
            return;
        };
        let tracked = self.tracked.get_mut(index as usize).and_then(Option::take);
        if let Some(tracked) = tracked
            && let Err(error) = self.instances.remove(tracked.id)
        {
            warn!("antumbra: {error}");
        }
    }

    /// What is known of a mesh or a light; `None` where it is not tested.
    pub fn find(&self, kind: Kind, entity: Entity) -> Option<Found> {
        let index = *self.of(kind).get(&entity)?;
        let tracked = self.tracked.get(index as usize)?.as_ref()?;
        Some(Found {
            index,
            now: tracked.now,
            since: tracked.since,
        })
    }

    fn of(&self, kind: Kind) -> &EntityHashMap<u32> {
        let [meshes, lights] = &self.indices;
        match kind {
            Kind::Mesh => meshes,
            Kind::Light => lights,
        }
    }

    fn of_mut(&mut self, kind: Kind) -> &mut EntityHashMap<u32> {
        let [meshes, lights] = &mut self.indices;
        match kind {
            Kind::Mesh => meshes,
            Kind::Light => lights,
        }
    }
}

impl Shape<'_> {
    fn kind(&self) -> Kind {
        match self {
            Self::Mesh(..) => Kind::Mesh,
            Self::Ball(..) => Kind::Light,
        }
    }

    fn roundness(&self) -> f32 {
        match self {
            Self::Mesh(_, _, roundness) => *roundness,
            // The box is a cube around it.
            Self::Ball(..) => 1.0,
        }
    }

    fn in_world(&self) -> WorldBox {
        match *self {
            Self::Mesh(aabb, place, _) => WorldBox::of(aabb, place),
            Self::Ball(centre, radius) => WorldBox {
                least: centre - radius,
                most: centre + radius,
            },
        }
    }
}

impl WorldBox {
    fn of(aabb: &Aabb, place: &GlobalTransform) -> Self {
        let affine = place.affine();
        let middle = affine.transform_point3a(aabb.center);
        let half = affine.matrix3.x_axis.abs() * aabb.half_extents.x
            + affine.matrix3.y_axis.abs() * aabb.half_extents.y
            + affine.matrix3.z_axis.abs() * aabb.half_extents.z;
        // By a step of f32 more, for the sums are rounded.
        let half = half + (middle.abs() + half) * f32::EPSILON;
        Self {
            least: Vec3::from(middle - half),
            most: Vec3::from(middle + half),
        }
    }

    /// Its middle.
    pub fn middle(&self) -> Vec3 {
        (self.least + self.most) * 0.5
    }

    fn holds(&self, other: &Self) -> bool {
        self.least.cmple(other.least).all() && self.most.cmpge(other.most).all()
    }

    /// What it covers in the next frames, if each takes it as far as this. What goes farther than its own size has jumped, and is not expected to go on.
    fn moving_on(&self, step: Vec3) -> Self {
        if step.length_squared() > (self.most - self.least).length_squared() {
            return *self;
        }
        let ahead = step * FRAMES_AHEAD;
        // What turns or breathes grows by some.
        let room = (self.most - self.least) * 0.05;
        Self {
            least: self.least.min(self.least + ahead) - room,
            most: self.most.max(self.most + ahead) + room,
        }
    }

    /// The distance of a point; 0 inside.
    pub fn distance(&self, point: Vec3) -> f32 {
        point.distance(point.clamp(self.least, self.most))
    }

    pub fn bounds(&self) -> Bounds {
        Bounds {
            min: DVec3::from_array(self.least.to_array().map(f64::from)),
            max: DVec3::from_array(self.most.to_array().map(f64::from)),
        }
    }
}

fn double(point: Vec3A) -> DVec3 {
    DVec3::from_array(point.to_array().map(f64::from))
}
