//! Radiators, television sets, pot plants and carpets.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};

pub(in crate::city) const RADIATOR: Prefab = Prefab {
    name: "radiator",
    material: MaterialKind::White,
    make: radiator,
};
pub(in crate::city) const TELEVISION: Prefab = Prefab {
    name: "television",
    material: MaterialKind::Black,
    make: television,
};
pub(in crate::city) const POT_PLANT: Prefab = Prefab {
    name: "pot plant",
    material: MaterialKind::Green,
    make: pot_plant,
};
pub(in crate::city) const CARPET: Prefab = Prefab {
    name: "carpet",
    material: MaterialKind::Red,
    make: carpet,
};

/// Seven columns on two pipes, in front of the wall at z = 0.
fn radiator() -> Solid {
    let mut solid = Solid::default();
    for column in 0..7 {
        let x = -0.33 + 0.11 * f64::from(column);
        solid.rounded_box([x - 0.04, 0.14, 0.05], [x + 0.045, 0.68, 0.16], 0.03, 1);
    }
    for y in [0.2, 0.62] {
        solid.bar([-0.38, y, 0.105], [0.4, y, 0.105], 0.018, 4);
    }
    for x in [-0.25, 0.25] {
        solid.bar([x, 0.5, -0.01], [x, 0.5, 0.1], 0.012, 4);
    }
    let pipe = [
        [0.39, 0.2, 0.105],
        [0.46, 0.2, 0.105],
        [0.46, 0.17, 0.105],
        [0.46, -0.01, 0.105],
    ];
    solid.tube(&pipe.map(DVec3::from), 0.011, 5);
    let valve = [
        [0.09, 0.0],
        [0.09, 0.022],
        [0.03, 0.026],
        [0.02, 0.015],
        [0.0, 0.015],
        [0.0, 0.0],
    ];
    let mut turned = Solid::default();
    turned.revolve(&valve, 6);
    solid.add(
        &turned,
        DAffine3::from_translation(DVec3::new(0.4, 0.62, 0.105)),
    );
    solid
}

fn television() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.7, 0.1, -0.2], [0.7, 0.5, 0.2], 0.012, 1);
    for x in [-0.6, 0.6] {
        for z in [-0.14, 0.14] {
            solid.post([x, 0.0, z], 0.02, 0.11, 8);
        }
    }
    for door in 0..3 {
        let x = -0.69 + 0.46 * f64::from(door);
        solid.rounded_box([x + 0.004, 0.12, 0.195], [x + 0.456, 0.48, 0.212], 0.006, 1);
    }
    solid.rounded_box([-0.25, 0.495, -0.1], [0.25, 0.515, 0.1], 0.008, 1);
    solid.bar([0.0, 0.51, -0.03], [0.0, 0.7, -0.03], 0.025, 10);
    solid.rounded_box([-0.6, 0.58, -0.03], [0.6, 1.28, 0.012], 0.012, 2);
    solid
}

fn pot_plant() -> Solid {
    let mut solid = Solid::default();
    let pot = [
        [0.3, 0.0],
        [0.3, 0.13],
        [0.34, 0.145],
        [0.34, 0.17],
        [0.28, 0.165],
        [0.0, 0.12],
        [0.0, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &pot, 20);
    for leaf in 0..14 {
        let turn = f64::from(leaf) * 137.5_f64.to_radians();
        let high = 0.45 + 0.6 * f64::from(leaf * 5 % 14) / 14.0;
        let out = 0.16 + 0.22 * f64::from(leaf * 3 % 14) / 14.0;
        let mut blade = Solid::default();
        // A leaf curves upwards and outwards and is widest in its middle.
        blade.block([5, 1, 1], |u, v, w| {
            let wide = 0.008 + 0.16 * (u * (1.0 - u)).powf(0.8);
            DVec3::new(
                out * u * u + 0.01 * (1.0 - u) - 0.006 * v,
                0.29 + high * (u - 0.35 * u * u * u) + 0.004 * v,
                (w - 0.5) * wide * (1.0 - 0.9 * u),
            )
        });
        solid.add(&blade, DAffine3::from_rotation_y(turn));
    }
    solid
}

fn carpet() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-1.2, 0.002, -0.8], [1.2, 0.014, 0.8], 0.005, 1);
    // Fringes at both ends.
    for fringe in 0..24 {
        let z = -0.77 + 0.067 * f64::from(fringe);
        for x in [-1.2_f64, 1.2] {
            let far = x + 0.06 * x.signum();
            solid.bar([x * 0.998, 0.008, z], [far, 0.006, z], 0.004, 4);
        }
    }
    solid
}
