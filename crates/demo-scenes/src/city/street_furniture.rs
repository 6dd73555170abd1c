//! Street furniture: benches, lamps, hydrants, bins, fountains and traffic lights.

use super::city_builder::{Prefab, quarter_rotation};
use super::materials::MaterialKind;
use super::shapes::along_z;
use crate::solid::Solid;
use glam::DVec3;

pub(super) const BENCH: Prefab = Prefab {
    name: "bench",
    material: MaterialKind::Wood,
    make: bench,
};
pub(super) const STREET_LAMP: Prefab = Prefab {
    name: "street lamp",
    material: MaterialKind::Steel,
    make: street_lamp,
};
pub(super) const HYDRANT: Prefab = Prefab {
    name: "hydrant",
    material: MaterialKind::RedLacquer,
    make: hydrant,
};
pub(super) const BIN: Prefab = Prefab {
    name: "litter bin",
    material: MaterialKind::Black,
    make: bin,
};
pub(super) const FOUNTAIN: Prefab = Prefab {
    name: "fountain",
    material: MaterialKind::Stone,
    make: fountain,
};
pub(super) const TRAFFIC_LIGHT: Prefab = Prefab {
    name: "traffic light",
    material: MaterialKind::Black,
    make: traffic_light,
};

fn bench() -> Solid {
    let mut solid = Solid::default();
    for slat in 0..4 {
        let z = -0.14 + 0.1 * f64::from(slat);
        solid.rounded_box([-0.85, 0.43, z], [0.85, 0.465, z + 0.085], 0.012, 1);
    }
    for slat in 0..3 {
        let (y, z) = (
            0.56 + 0.12 * f64::from(slat),
            -0.2 - 0.035 * f64::from(slat),
        );
        solid.rounded_box([-0.85, y, z], [0.85, y + 0.09, z + 0.03], 0.012, 1);
    }
    for x in [-0.65, 0.65] {
        solid.bar([x, -0.02, 0.2], [x, 0.44, 0.17], 0.03, 10);
        solid.bar([x, -0.02, -0.2], [x, 0.46, -0.13], 0.03, 10);
        solid.bar([x, 0.42, -0.16], [x, 0.93, -0.3], 0.025, 10);
        solid.bar([x, 0.41, -0.18], [x, 0.41, 0.22], 0.022, 8);
        let arm = [
            [x, 0.43, 0.18],
            [x, 0.62, 0.2],
            [x, 0.66, 0.12],
            [x, 0.66, -0.22],
        ];
        solid.tube(&arm.map(DVec3::from), 0.02, 8);
    }
    solid
}

/// A street lamp; its arm is towards +Z.
fn street_lamp() -> Solid {
    let mut solid = Solid::default();
    let post = [
        [4.9, 0.0],
        [4.9, 0.045],
        [1.25, 0.06],
        [1.2, 0.085],
        [1.12, 0.09],
        [1.08, 0.08],
        [0.35, 0.09],
        [0.3, 0.13],
        [0.22, 0.14],
        [0.18, 0.11],
        [0.06, 0.13],
        [0.0, 0.19],
        [-0.05, 0.19],
        [-0.05, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &post, 20);
    let arm: Vec<DVec3> = (0..=10)
        .map(|i| {
            let part = f64::from(i) / 10.0;
            let (sin, cos) = (part * 1.7).sin_cos();
            DVec3::new(0.0, 4.8 + 0.75 * sin, 0.8 * (1.0 - cos))
        })
        .collect();
    solid.tube(&arm, 0.035, 10);
    let head = [
        [0.1, 0.0],
        [0.1, 0.05],
        [0.02, 0.09],
        [-0.05, 0.24],
        [-0.09, 0.26],
        [-0.1, 0.24],
        [-0.12, 0.2],
        [-0.2, 0.14],
        [-0.23, 0.0],
    ];
    solid.revolve_upright([0.0, 5.5, 0.92], &head, 24);
    solid
}

fn hydrant() -> Solid {
    let mut solid = Solid::default();
    let body = [
        [0.86, 0.0],
        [0.86, 0.03],
        [0.81, 0.035],
        [0.8, 0.08],
        [0.74, 0.13],
        [0.69, 0.15],
        [0.66, 0.16],
        [0.64, 0.12],
        [0.2, 0.11],
        [0.18, 0.15],
        [0.12, 0.15],
        [0.1, 0.12],
        [0.04, 0.12],
        [0.03, 0.17],
        [-0.02, 0.17],
        [-0.02, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &body, 24);
    let cap = [
        [0.19, 0.0],
        [0.19, 0.025],
        [0.17, 0.03],
        [0.17, 0.07],
        [0.13, 0.075],
        [0.12, 0.05],
        [0.0, 0.05],
        [0.0, 0.0],
    ];
    solid.revolve_forward([0.0, 0.5, 0.0], &cap, 18);
    for quarters in [1, 3] {
        let mut side = Solid::default();
        side.revolve_forward([0.0, 0.55, 0.0], &cap, 14);
        solid.add(&side, quarter_rotation(quarters));
    }
    for bolt in 0..8 {
        let (sin, cos) = (f64::from(bolt) * 45.0_f64).to_radians().sin_cos();
        solid.post([0.145 * cos, 0.02, 0.145 * sin], 0.014, 0.03, 6);
    }
    solid
}

fn bin() -> Solid {
    let mut solid = Solid::default();
    let body = [
        [0.9, 0.0],
        [0.89, 0.1],
        [0.85, 0.2],
        [0.82, 0.24],
        [0.76, 0.24],
        [0.75, 0.2],
        [0.1, 0.17],
        [0.08, 0.19],
        [-0.02, 0.19],
        [-0.02, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &body, 24);
    for y in [0.25, 0.45, 0.65] {
        solid.upright_torus([0.0, y, 0.0], 0.185 + 0.02 * y, 0.014, [6, 24]);
    }
    solid
}

fn fountain() -> Solid {
    let mut solid = Solid::default();
    let profile = [
        [2.2, 0.0],
        [2.15, 0.08],
        [1.95, 0.12],
        [1.85, 0.05],
        [1.5, 0.08],
        [1.48, 0.55],
        [1.42, 0.6],
        [1.36, 0.58],
        [1.2, 0.15],
        [0.7, 0.2],
        [0.5, 0.35],
        [0.35, 0.36],
        [0.3, 2.0],
        [0.55, 2.05],
        [0.6, 2.15],
        [0.6, 2.35],
        [0.52, 2.4],
        [0.4, 2.3],
        [-0.05, 2.35],
        [-0.05, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &profile, 48);
    solid
}

/// A traffic light that faces +Z.
fn traffic_light() -> Solid {
    let mut solid = Solid::default();
    let post = [
        [3.3, 0.0],
        [3.3, 0.05],
        [0.1, 0.06],
        [0.06, 0.12],
        [-0.03, 0.12],
        [-0.03, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &post, 14);
    solid.rounded_box([-0.16, 2.3, 0.04], [0.16, 3.2, 0.26], 0.03, 1);
    for lamp in 0..3 {
        let y = 2.46 + 0.29 * f64::from(lamp);
        let hood = [
            [0.1, 0.0],
            [0.07, 0.06],
            [0.03, 0.11],
            [0.0, 0.12],
            [-0.02, 0.0],
        ];
        solid.revolve_forward([0.0, y, 0.26], &hood, 18);
        let mut ring = Solid::default();
        ring.band([-0.02, 0.14], [0.115, 0.125], 18);
        solid.add(&ring, along_z([0.0, y, 0.26]));
    }
    solid
}
