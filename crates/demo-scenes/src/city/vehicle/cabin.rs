//! The inside of a car: seats, dashboard, steering wheel, pedals.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

pub(super) const SEAT: Prefab = Prefab {
    name: "car seat",
    material: MaterialKind::Black,
    make: seat,
};
pub(super) const DASHBOARD: Prefab = Prefab {
    name: "dashboard",
    material: MaterialKind::Black,
    make: dashboard,
};
pub(super) const STEERING_WHEEL: Prefab = Prefab {
    name: "steering wheel",
    material: MaterialKind::Black,
    make: steering_wheel,
};
pub(super) const PEDALS: Prefab = Prefab {
    name: "pedals",
    material: MaterialKind::Steel,
    make: pedals,
};

/// A seat: its front is towards +X, its rails are at y = 0.
fn seat() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.22, 0.12, -0.22], [0.27, 0.26, 0.22], 0.05, 2);
    for z in [-0.24, 0.18] {
        solid.rounded_box([-0.2, 0.16, z], [0.24, 0.31, z + 0.07], 0.03, 2);
    }
    let mut back = Solid::default();
    back.rounded_box([-0.06, 0.0, -0.22], [0.06, 0.55, 0.22], 0.045, 2);
    for z in [-0.25, 0.18] {
        back.rounded_box([-0.05, 0.05, z], [0.11, 0.48, z + 0.07], 0.033, 2);
    }
    back.rounded_box([-0.05, 0.6, -0.13], [0.05, 0.78, 0.13], 0.04, 2);
    for z in [-0.07, 0.07] {
        back.bar([0.0, 0.5, z], [0.0, 0.64, z], 0.008, 6);
    }
    let lean =
        DAffine3::from_translation(DVec3::new(-0.24, 0.18, 0.0)) * DAffine3::from_rotation_z(0.25);
    solid.add(&back, lean);
    for z in [-0.17, 0.17] {
        solid.cuboid([-0.22, 0.0, z - 0.02], [0.24, 0.05, z + 0.02]);
        for x in [-0.15, 0.17] {
            solid.cuboid([x - 0.02, 0.04, z - 0.015], [x + 0.02, 0.14, z + 0.015]);
        }
    }
    solid
}

/// A dashboard, centred at the origin.
fn dashboard() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.15, -0.2, -0.72], [0.2, 0.06, 0.72], 0.06, 2);
    solid.rounded_box([-0.2, -0.45, -0.12], [0.15, -0.1, 0.12], 0.03, 1);
    solid.rounded_box([-0.18, 0.02, -0.5], [0.0, 0.12, -0.2], 0.035, 2);
    for (y, z) in [(-0.05, -0.62), (-0.05, 0.62), (-0.03, -0.1), (-0.03, 0.1)] {
        let mut vent = Solid::default();
        vent.band([-0.17, -0.14], [0.03, 0.045], 16);
        solid.add(&vent, DAffine3::from_translation(DVec3::new(0.0, y, z)));
    }
    for button in 0..6 {
        let z = -0.08 + 0.032 * f64::from(button);
        solid.rounded_box([-0.215, -0.2, z], [-0.19, -0.175, z + 0.024], 0.005, 1);
    }
    solid
}

/// A steering wheel, tilted towards the driver's seat at -X.
fn steering_wheel() -> Solid {
    let mut wheel = Solid::default();
    wheel.torus(0.0, 0.18, 0.016, [8, 36]);
    wheel.revolve(
        &[
            [0.03, 0.0],
            [0.03, 0.035],
            [0.01, 0.06],
            [-0.02, 0.06],
            [-0.035, 0.045],
            [-0.04, 0.0],
        ],
        20,
    );
    for spoke in 0..3 {
        let (sin, cos) = (TAU * (f64::from(spoke) / 3.0 + 0.5)).sin_cos();
        let end = DVec3::new(0.0, 0.175 * cos, 0.175 * sin);
        wheel.tube(&[end * 0.2, end], 0.013, 6);
    }
    let column = [[0.3, 0.0], [0.3, 0.022], [0.0, 0.022], [0.0, 0.0]];
    wheel.revolve(&column, 12);
    let mut solid = Solid::default();
    solid.add(&wheel, DAffine3::from_rotation_z(-0.35));
    solid
}

fn pedals() -> Solid {
    let mut solid = Solid::default();
    for (z, wide) in [(-0.12, 0.04), (0.0, 0.045), (0.13, 0.025)] {
        solid.rounded_box([-0.06, -0.42, z - wide], [-0.03, -0.34, z + wide], 0.01, 1);
        solid.bar([-0.03, -0.38, z], [0.12, -0.16, z], 0.01, 8);
    }
    solid
}
