//! Kitchen furniture. The backs are at z = 0.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::city::shapes::{Opening, superellipse};
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

pub(in crate::city) const COUNTER: Prefab = Prefab {
    name: "kitchen counter",
    material: MaterialKind::White,
    make: counter,
};
pub(in crate::city) const STOVE: Prefab = Prefab {
    name: "stove",
    material: MaterialKind::Steel,
    make: stove,
};
pub(in crate::city) const FRIDGE: Prefab = Prefab {
    name: "fridge",
    material: MaterialKind::White,
    make: fridge,
};
pub(in crate::city) const POTS: Prefab = Prefab {
    name: "pots",
    material: MaterialKind::SilverLacquer,
    make: pots,
};

/// Cupboards with a sink, 2.4 m wide.
fn counter() -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-1.2, 0.1, 0.0], [1.2, 0.86, 0.56]);
    solid.cuboid([-1.19, 0.0, 0.05], [1.19, 0.11, 0.5]);
    for unit in 0..4 {
        let x = -1.2 + 0.6 * f64::from(unit);
        let fronts: &[[f64; 2]] = match unit {
            1 => &[[0.12, 0.34], [0.35, 0.58], [0.59, 0.84]],
            _ => &[[0.12, 0.84]],
        };
        for [low, high] in fronts {
            solid.rounded_box([x + 0.004, *low, 0.555], [x + 0.596, *high, 0.58], 0.006, 1);
            let y = high - 0.06;
            solid.bar([x + 0.2, y, 0.605], [x + 0.4, y, 0.605], 0.007, 8);
            for x in [x + 0.21, x + 0.39] {
                solid.bar([x, y, 0.57], [x, y, 0.606], 0.005, 6);
            }
        }
    }
    // The worktop around the sink.
    let hole = Opening {
        x: [0.15, 0.65],
        y: [-0.47, -0.12],
    };
    let mut top = Solid::default();
    top.wall_with_openings([-1.2, 1.2], [-0.62, 0.0], [0.855, 0.9], &[hole]);
    solid.add(&top, DAffine3::from_rotation_x(-FRAC_PI_2));
    let bowl = |y: f64, wide: f64, deep: f64| superellipse([0.4, y, 0.295], [wide, deep], 5.0, 20);
    solid.loft(&[
        bowl(0.87, 0.2, 0.12),
        bowl(0.895, 0.265, 0.19),
        bowl(0.91, 0.265, 0.19),
        bowl(0.91, 0.24, 0.165),
        bowl(0.885, 0.23, 0.155),
        bowl(0.8795, 0.15, 0.1),
    ]);
    let spout = [
        [0.4, 0.89, 0.07],
        [0.4, 1.12, 0.07],
        [0.4, 1.19, 0.1],
        [0.4, 1.2, 0.16],
        [0.4, 1.17, 0.21],
        [0.4, 1.12, 0.22],
    ];
    solid.tube(&spout.map(DVec3::from), 0.012, 10);
    solid
}

fn stove() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.3, 0.02, 0.0], [0.3, 0.9, 0.58], 0.01, 1);
    solid.rounded_box([-0.28, 0.14, 0.575], [0.28, 0.7, 0.6], 0.01, 1);
    solid.bar([-0.24, 0.64, 0.63], [0.24, 0.64, 0.63], 0.01, 10);
    for x in [-0.22, 0.22] {
        solid.bar([x, 0.64, 0.59], [x, 0.64, 0.631], 0.007, 6);
    }
    for (x, z) in [(-0.14, 0.15), (0.14, 0.15), (-0.14, 0.42), (0.14, 0.42)] {
        solid.upright_torus([x, 0.9, z], 0.085, 0.009, [4, 16]);
        solid.post([x, 0.895, z], 0.03, 0.012, 10);
        let knob = [[0.03, 0.0], [0.03, 0.016], [0.0, 0.02], [0.0, 0.0]];
        let across = if z < 0.3 { 1.5 * x } else { 0.95 * x };
        solid.revolve_forward([across, 0.79, 0.575], &knob, 8);
    }
    solid
}

fn fridge() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.3, 0.03, 0.02], [0.3, 1.85, 0.58], 0.02, 1);
    for y in [[0.06, 1.25], [1.27, 1.84]] {
        solid.rounded_box([-0.3, y[0], 0.585], [0.3, y[1], 0.64], 0.02, 2);
        let grip = if y[0] > 1.0 { [1.3, 1.55] } else { [0.85, 1.2] };
        solid.bar([-0.25, grip[0], 0.68], [-0.25, grip[1], 0.68], 0.011, 10);
        for end in [grip[0] + 0.02, grip[1] - 0.02] {
            solid.bar([-0.25, end, 0.63], [-0.25, end, 0.681], 0.008, 6);
        }
    }
    for (x, z) in [(-0.25, 0.08), (0.25, 0.08), (-0.25, 0.52), (0.25, 0.52)] {
        solid.post([x, 0.0, z], 0.02, 0.05, 8);
    }
    solid
}

/// Two pots on the rings of a stove.
fn pots() -> Solid {
    let mut solid = Solid::default();
    for (x, z, radius, high) in [(-0.14, 0.15, 0.09, 0.13), (0.14, 0.42, 0.11, 0.08)] {
        let profile = [
            [high + 0.045, 0.0],
            [high + 0.04, 0.014],
            [high + 0.03, 0.01],
            [high + 0.022, 0.02],
            [high + 0.014, radius * 0.8],
            [high, radius + 0.006],
            [high - 0.006, radius],
            [0.006, radius],
            [0.0, radius - 0.008],
            [0.0, 0.0],
        ];
        solid.revolve_upright([x, 0.908, z], &profile, 18);
        for side in [-1.0, 1.0] {
            let grip = [
                [x + side * radius * 0.97, 0.908 + 0.7 * high, z - 0.03],
                [x + side * (radius + 0.035), 0.908 + 0.7 * high, z - 0.025],
                [x + side * (radius + 0.035), 0.908 + 0.7 * high, z + 0.025],
                [x + side * radius * 0.97, 0.908 + 0.7 * high, z + 0.03],
            ];
            solid.tube(&grip.map(DVec3::from), 0.006, 6);
        }
    }
    solid
}
