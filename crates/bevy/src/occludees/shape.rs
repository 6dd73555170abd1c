//! The shape of an occludee, in Bevy's terms and in ours.

use antumbra::glam::{DAffine3, DVec3};
use antumbra::scene::Aabb as Bounds;
use bevy::camera::primitives::Aabb;
use bevy::prelude::*;

use super::Kind;

/// What is tested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// A mesh.
    Mesh {
        aabb: Aabb,
        place: GlobalTransform,
        roundness: f32,
    },
    /// The reach of a light, in metres.
    Ball { centre: Vec3, radius: f32 },
}

impl Shape {
    pub fn kind(&self) -> Kind {
        match self {
            Self::Mesh { .. } => Kind::Mesh,
            Self::Ball { .. } => Kind::Light,
        }
    }

    pub fn roundness(&self) -> f32 {
        match self {
            Self::Mesh { roundness, .. } => *roundness,
            Self::Ball { .. } => 1.0,
        }
    }

    /// A box, and its place: along the shape's own axes, which is tighter than along the world's.
    pub fn oriented(&self) -> (Bounds, DAffine3) {
        match self {
            Self::Mesh { aabb, place, .. } => {
                let columns = place.affine().to_cols_array().map(f64::from);
                (bounds_of(aabb), DAffine3::from_cols_array(&columns))
            }
            Self::Ball { centre, radius } => {
                let centre = DVec3::from_array(centre.to_array().map(f64::from));
                let half = DVec3::splat(f64::from(*radius));
                (Bounds::from_centre(centre, half), DAffine3::IDENTITY)
            }
        }
    }

    /// The box in the world.
    pub fn bounds(&self) -> Bounds {
        let (bounds, at) = self.oriented();
        bounds.transformed(&at)
    }
}

/// Bevy's box as one of ours.
pub(crate) fn bounds_of(aabb: &Aabb) -> Bounds {
    let [centre, half] = [aabb.center, aabb.half_extents]
        .map(|point| DVec3::from_array(point.to_array().map(f64::from)));
    Bounds::from_centre(centre, half)
}
