//! Tables and desks.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;

pub(in crate::city) const DINING_TABLE: Prefab = Prefab {
    name: "dining table",
    material: MaterialKind::Wood,
    make: dining_table,
};
pub(in crate::city) const COFFEE_TABLE: Prefab = Prefab {
    name: "coffee table",
    material: MaterialKind::Wood,
    make: coffee_table,
};
pub(in crate::city) const DESK: Prefab = Prefab {
    name: "desk",
    material: MaterialKind::Wood,
    make: desk,
};

fn dining_table() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.75, 0.72, -0.42], [0.75, 0.755, 0.42], 0.014, 2);
    let leg = [
        [0.725, 0.0],
        [0.725, 0.038],
        [0.6, 0.038],
        [0.585, 0.028],
        [0.565, 0.036],
        [0.545, 0.026],
        [0.15, 0.02],
        [0.12, 0.03],
        [0.09, 0.02],
        [0.0, 0.02],
        [0.0, 0.0],
    ];
    for x in [-0.66, 0.66] {
        for z in [-0.33, 0.33] {
            solid.revolve_upright([x, 0.0, z], &leg, 8);
        }
        solid.cuboid([x - 0.012, 0.62, -0.31], [x + 0.012, 0.73, 0.31]);
    }
    for z in [-0.33, 0.33] {
        solid.cuboid([-0.64, 0.62, z - 0.012], [0.64, 0.73, z + 0.012]);
    }
    solid
}

fn coffee_table() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.5, 0.4, -0.3], [0.5, 0.435, 0.3], 0.014, 2);
    solid.rounded_box([-0.44, 0.16, -0.24], [0.44, 0.18, 0.24], 0.008, 1);
    for x in [-0.43, 0.43] {
        for z in [-0.23, 0.23] {
            solid.bar([x * 1.06, 0.0, z * 1.06], [x, 0.41, z], 0.02, 10);
        }
    }
    solid
}

fn desk() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.8, 0.71, -0.36], [0.8, 0.745, 0.36], 0.012, 1);
    solid.cuboid([-0.76, 0.0, -0.32], [-0.73, 0.72, 0.32]);
    solid.cuboid([-0.74, 0.3, -0.33], [0.34, 0.7, -0.31]);
    solid.cuboid([0.34, 0.04, -0.32], [0.76, 0.72, 0.31]);
    for drawer in 0..3 {
        let y = 0.07 + 0.215 * f64::from(drawer);
        solid.rounded_box([0.35, y, 0.3], [0.75, y + 0.2, 0.325], 0.006, 1);
        solid.bar([0.49, y + 0.13, 0.345], [0.61, y + 0.13, 0.345], 0.006, 6);
        for x in [0.5, 0.6] {
            solid.bar([x, y + 0.13, 0.32], [x, y + 0.13, 0.346], 0.004, 6);
        }
    }
    // A screen on its foot, and a keyboard.
    solid.rounded_box([-0.33, 0.85, -0.2], [0.33, 1.22, -0.175], 0.008, 1);
    solid.bar([0.0, 0.75, -0.2], [0.0, 0.95, -0.19], 0.018, 8);
    solid.post([0.0, 0.742, -0.2], 0.11, 0.012, 20);
    solid.rounded_box([-0.22, 0.743, 0.02], [0.22, 0.762, 0.16], 0.006, 1);
    solid
}
