//! Bathroom fixtures. Their backs are at z = 0.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::city::shapes::{along_z, superellipse};
use crate::solid::Solid;

pub(in crate::city) const TUB: Prefab = Prefab {
    name: "bath tub",
    material: MaterialKind::White,
    make: tub,
};
pub(in crate::city) const BASIN: Prefab = Prefab {
    name: "wash basin",
    material: MaterialKind::White,
    make: basin,
};
pub(in crate::city) const TOILET: Prefab = Prefab {
    name: "toilet",
    material: MaterialKind::White,
    make: toilet,
};
pub(in crate::city) const MIRROR: Prefab = Prefab {
    name: "mirror cabinet",
    material: MaterialKind::SilverLacquer,
    make: mirror,
};
pub(in crate::city) const WASHER: Prefab = Prefab {
    name: "washing machine",
    material: MaterialKind::White,
    make: washer,
};
/// A vessel from rings of [height, half width, half depth], from the foot up over the rim and down inside.
fn vessel(solid: &mut Solid, middle: [f64; 2], rings: &[[f64; 3]], power: f64, sides: usize) {
    let sections: Vec<_> = rings
        .iter()
        .map(|[y, wide, deep]| {
            superellipse([middle[0], *y, middle[1]], [*wide, *deep], power, sides)
        })
        .collect();
    solid.loft(&sections);
}

fn tub() -> Solid {
    let mut solid = Solid::default();
    let rings = [
        [0.0, 0.7, 0.28],
        [0.05, 0.76, 0.32],
        [0.5, 0.82, 0.36],
        [0.56, 0.86, 0.39],
        [0.58, 0.86, 0.39],
        [0.59, 0.84, 0.38],
        [0.58, 0.79, 0.33],
        [0.5, 0.77, 0.31],
        [0.25, 0.7, 0.27],
        [0.17, 0.62, 0.22],
        [0.15, 0.5, 0.15],
    ];
    vessel(&mut solid, [0.0, 0.4], &rings, 3.2, 28);
    solid
}

fn basin() -> Solid {
    let mut solid = Solid::default();
    let foot = [
        [0.0, 0.12, 0.1],
        [0.04, 0.1, 0.09],
        [0.3, 0.075, 0.07],
        [0.68, 0.1, 0.09],
    ];
    vessel(&mut solid, [0.0, 0.2], &foot, 2.4, 12);
    let bowl = [
        [0.62, 0.12, 0.1],
        [0.72, 0.24, 0.19],
        [0.82, 0.3, 0.235],
        [0.85, 0.31, 0.24],
        [0.855, 0.3, 0.23],
        [0.84, 0.25, 0.18],
        [0.78, 0.22, 0.15],
        [0.72, 0.14, 0.09],
        [0.71, 0.04, 0.03],
    ];
    vessel(&mut solid, [0.0, 0.25], &bowl, 2.5, 20);
    // Its taps.
    let spout = [
        [0.0, 0.83, 0.06],
        [0.0, 0.98, 0.06],
        [0.0, 1.02, 0.09],
        [0.0, 1.02, 0.17],
        [0.0, 0.99, 0.2],
    ];
    solid.tube(&spout.map(glam::DVec3::from), 0.012, 8);
    solid.post([0.0, 0.82, 0.06], 0.025, 0.05, 12);
    for x in [-0.09, 0.09] {
        let handle = [
            [0.07, 0.0],
            [0.065, 0.02],
            [0.045, 0.024],
            [0.04, 0.012],
            [0.0, 0.014],
            [0.0, 0.0],
        ];
        solid.revolve_upright([x, 0.82, 0.07], &handle, 8);
    }
    solid
}

fn toilet() -> Solid {
    let mut solid = Solid::default();
    let bowl = [
        [0.0, 0.11, 0.2],
        [0.05, 0.1, 0.19],
        [0.2, 0.11, 0.2],
        [0.34, 0.18, 0.25],
        [0.4, 0.19, 0.26],
        [0.41, 0.18, 0.25],
        [0.39, 0.14, 0.2],
        [0.28, 0.1, 0.15],
        [0.22, 0.05, 0.07],
    ];
    vessel(&mut solid, [0.0, 0.46], &bowl, 2.3, 20);
    solid.rounded_box([-0.2, 0.38, 0.0], [0.2, 0.78, 0.19], 0.03, 1);
    solid.rounded_box([-0.21, 0.77, -0.002], [0.21, 0.81, 0.2], 0.015, 1);
    // The raised lid, and the button.
    solid.rounded_box([-0.19, 0.43, 0.2], [0.19, 0.84, 0.23], 0.014, 1);
    solid.post([0.0, 0.805, 0.1], 0.03, 0.012, 14);
    solid.rounded_box([-0.12, 0.1, 0.02], [0.12, 0.4, 0.35], 0.03, 1);
    solid
}

fn mirror() -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-0.4, 1.2, 0.0], [0.4, 1.85, 0.12]);
    for x in [-0.4, 0.0] {
        solid.rounded_box([x + 0.004, 1.2, 0.118], [x + 0.396, 1.85, 0.135], 0.006, 1);
    }
    solid.bar([-0.3, 1.91, 0.08], [0.3, 1.91, 0.08], 0.025, 14);
    solid.cuboid([-0.05, 1.84, 0.04], [0.05, 1.9, 0.08]);
    solid
}

fn washer() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.3, 0.01, 0.02], [0.3, 0.85, 0.6], 0.02, 2);
    let mut ring = Solid::default();
    ring.torus(0.0, 0.19, 0.03, [6, 18]);
    let glass = [
        [0.02, 0.0],
        [0.01, 0.1],
        [-0.01, 0.17],
        [-0.03, 0.17],
        [-0.03, 0.0],
    ];
    ring.revolve(&glass, 18);
    let knob = [[0.52, 0.0], [0.52, 0.025], [0.44, 0.03], [0.44, 0.0]];
    solid.add(&ring, along_z([0.0, 0.42, 0.6]));
    solid.revolve_forward([0.15, 0.77, 0.12], &knob, 16);
    solid.rounded_box([-0.27, 0.72, 0.59], [-0.05, 0.82, 0.612], 0.006, 1);
    solid
}
