//! Trees and hedges.

use super::city_builder::{CityBuilder, Prefab, rotated_at};
use super::materials::MaterialKind;
use crate::random::Random;
use crate::solid::Solid;
use antumbra_scene::{EntityKey, Geometry, SceneError, icosphere};
use glam::{DAffine3, DVec3, Vec3};

pub(super) const TRUNK: Prefab = Prefab {
    name: "trunk",
    material: MaterialKind::Wood,
    make: trunk,
};
/// Crowns of three shapes for one trunk.
pub(super) const CROWNS: [Prefab; 3] = [
    Prefab {
        name: "crown",
        material: MaterialKind::Green,
        make: || crown(0),
    },
    Prefab {
        name: "broad crown",
        material: MaterialKind::Green,
        make: || crown(1),
    },
    Prefab {
        name: "tall crown",
        material: MaterialKind::Green,
        make: || crown(2),
    },
];
/// A hedge, two metres long along X.
pub(super) const HEDGE: Prefab = Prefab {
    name: "hedge",
    material: MaterialKind::Green,
    make: hedge,
};

/// A trunk, two and a half metres high up to the crown; its roots are below the ground.
fn trunk() -> Solid {
    let mut solid = Solid::default();
    let stem = [
        [3.6, 0.0],
        [3.5, 0.08],
        [2.4, 0.13],
        [1.2, 0.15],
        [0.4, 0.18],
        [0.12, 0.24],
        [-0.1, 0.34],
        [-0.15, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &stem, 14);
    for branch in 0..5 {
        let angle = f64::from(branch) * 2.4;
        let high = 2.2 + 0.2 * f64::from(branch);
        let (sin, cos) = angle.sin_cos();
        let way = [
            DVec3::new(0.0, high, 0.0),
            DVec3::new(0.45 * cos, high + 0.5, 0.45 * sin),
            DVec3::new(0.8 * cos, high + 1.3, 0.8 * sin),
        ];
        solid.tube(&way, 0.05, 8);
    }
    solid
}

/// Lumps of leaves around the upper end of a trunk.
fn crown(growth: usize) -> Solid {
    let (wide, high, lumps) = [(0.85, 0.9, 8), (1.05, 0.7, 9), (0.6, 1.35, 8)][growth];
    let mut solid = Solid::default();
    let mut add = |place: DVec3, radius: f64, number: usize| {
        let lump = leaves(radius as f32, number as f32 + growth as f32 * 3.0);
        solid.add(&lump, DAffine3::from_translation(place));
    };
    let middle = 3.6 + high * 0.7;
    add(DVec3::new(0.0, middle + 0.2, 0.0), 0.5 + 0.6 * high, 0);
    for lump in 1..lumps {
        let (sin, cos) = (lump as f64 * 2.4).sin_cos();
        let up = ((lump * 5) % lumps) as f64 / lumps as f64 - 0.45;
        let out = wide * (1.0 - 0.5 * up.abs());
        let place = DVec3::new(out * cos, middle + high * 1.5 * up, out * sin);
        add(place, 0.62 + 0.1 * ((lump * 3) % 4) as f64, lump);
    }
    solid
}

/// A ball with dents.
fn leaves(radius: f32, phase: f32) -> Solid {
    let ball = icosphere(2, 1.0);
    let dented = |p: &[f32; 3]| {
        let place = Vec3::from(*p);
        let dent = (place.x * 7.0 + phase).sin()
            + (place.y * 8.0 - 1.7 * phase).sin()
            + (place.z * 7.5 + 0.6 * phase).sin();
        (place * radius * (1.0 + 0.055 * dent)).to_array()
    };
    let geometry = Geometry {
        positions: ball.positions.iter().map(dented).collect(),
        indices: ball.indices,
        ..Geometry::default()
    };
    Solid::from(geometry.with_computed_normals())
}

fn hedge() -> Solid {
    let mut solid = Solid::default();
    solid.block([14, 8, 5], |u, v, w| {
        let place = DVec3::new(2.0 * (u - 0.5), 1.15 * v - 0.05, 0.6 * (w - 0.5));
        let bump = (place.x * 9.0).sin() + (place.y * 11.0 + 1.0).sin() + (place.z * 10.0).cos();
        // The ends stay flat, so that hedges join.
        let flat = (4.0 * u * (1.0 - u)).min(0.4) / 0.4;
        place + DVec3::new(0.0, 0.03 * v, 0.05 * (w - 0.5)) * bump * flat
    });
    solid
}

/// Adds a tree at a random rotation.
pub(super) fn tree(
    city: &mut CityBuilder,
    parent: EntityKey,
    place: DAffine3,
    random: &mut Random,
) -> Result<(), SceneError> {
    let place = place * rotated_at(0.0, 0.0, 0.0, random.between(0.0, 360.0));
    let tree = city.node(parent, "tree", place)?;
    city.put(tree, &TRUNK, DAffine3::IDENTITY)?;
    city.put(tree, &CROWNS[random.pick(3)], DAffine3::IDENTITY)
}
