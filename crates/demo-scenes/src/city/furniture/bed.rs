//! Beds, nightstands, wardrobes and dressers.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;

/// The head end is at z = 0 and faces -Z; the backs of the other prefabs are at z = 0.
pub(in crate::city) const DOUBLE_BED: Prefab = Prefab {
    name: "double bed",
    material: MaterialKind::Wood,
    make: || bedstead(1.7),
};
pub(in crate::city) const DOUBLE_BEDDING: Prefab = Prefab {
    name: "double bedding",
    material: MaterialKind::White,
    make: || bedding(1.6, 2),
};
pub(in crate::city) const SINGLE_BED: Prefab = Prefab {
    name: "single bed",
    material: MaterialKind::Wood,
    make: || bedstead(1.0),
};
pub(in crate::city) const SINGLE_BEDDING: Prefab = Prefab {
    name: "single bedding",
    material: MaterialKind::Blue,
    make: || bedding(0.9, 1),
};
pub(in crate::city) const NIGHTSTAND: Prefab = Prefab {
    name: "nightstand",
    material: MaterialKind::Wood,
    make: || drawers([0.42, 0.5, 0.38], [1, 2]),
};
pub(in crate::city) const DRESSER: Prefab = Prefab {
    name: "chest of drawers",
    material: MaterialKind::Wood,
    make: || drawers([1.2, 0.85, 0.46], [2, 3]),
};
pub(in crate::city) const WARDROBE: Prefab = Prefab {
    name: "wardrobe",
    material: MaterialKind::Wood,
    make: wardrobe,
};

/// A bed from z = 0 to z = 2.1.
fn bedstead(wide: f64) -> Solid {
    let mut solid = Solid::default();
    let half = 0.5 * wide;
    for x in [-half + 0.04, half - 0.04] {
        for (z, high) in [(0.04, 0.98), (2.06, 0.52)] {
            let post = [
                [high + 0.06, 0.0],
                [high + 0.05, 0.018],
                [high + 0.02, 0.03],
                [high, 0.018],
                [high - 0.02, 0.03],
                [0.06, 0.03],
                [0.0, 0.022],
                [0.0, 0.0],
            ];
            solid.revolve_upright([x, 0.0, z], &post, 6);
        }
        solid.cuboid([x - 0.015, 0.22, 0.05], [x + 0.015, 0.38, 2.05]);
    }
    let inner = half - 0.05;
    solid.rounded_box([-inner, 0.82, 0.02], [inner, 0.94, 0.06], 0.015, 1);
    solid.rounded_box([-inner, 0.3, 0.025], [inner, 0.4, 0.055], 0.01, 1);
    solid.rounded_box([-inner, 0.25, 2.04], [inner, 0.48, 2.08], 0.015, 1);
    let slats = (wide / 0.17) as usize;
    for slat in 0..slats {
        let x = -inner + 2.0 * inner * (slat as f64 + 0.5) / slats as f64;
        solid.bar([x, 0.39, 0.04], [x, 0.83, 0.04], 0.012, 4);
    }
    for rung in 0..10 {
        let z = 0.15 + 0.2 * f64::from(rung);
        solid.cuboid([-half + 0.03, 0.26, z], [half - 0.03, 0.28, z + 0.08]);
    }
    solid
}

fn bedding(wide: f64, pillows: usize) -> Solid {
    let mut solid = Solid::default();
    let half = 0.5 * wide;
    solid.rounded_box([-half, 0.28, 0.09], [half, 0.48, 2.0], 0.05, 1);
    solid.rounded_box(
        [-half - 0.03, 0.42, 0.68],
        [half + 0.03, 0.56, 1.99],
        0.06,
        2,
    );
    // The folded edge of the cover.
    solid.rounded_box(
        [-half - 0.02, 0.52, 0.64],
        [half + 0.02, 0.6, 0.9],
        0.035,
        2,
    );
    let each = wide / pillows as f64;
    for pillow in 0..pillows {
        let x = -half + each * pillow as f64;
        solid.rounded_box(
            [x + 0.06, 0.47, 0.14],
            [x + each - 0.06, 0.6, 0.56],
            0.06,
            2,
        );
    }
    solid
}

/// A cabinet with columns and rows of drawers with knobs, from z = 0 to its depth.
fn drawers([wide, high, deep]: [f64; 3], [columns, rows]: [usize; 2]) -> Solid {
    let mut solid = Solid::default();
    let half = 0.5 * wide;
    for x in [-half + 0.05, half - 0.05] {
        for z in [0.05, deep - 0.05] {
            solid.post([x, 0.0, z], 0.02, 0.09, 8);
        }
    }
    solid.cuboid([-half, 0.08, 0.0], [half, high - 0.02, deep]);
    solid.rounded_box(
        [-half - 0.015, high - 0.025, -0.002],
        [half + 0.015, high, deep + 0.03],
        0.01,
        1,
    );
    let (across, up) = ((wide - 0.03) / columns as f64, (high - 0.13) / rows as f64);
    for column in 0..columns {
        for row in 0..rows {
            let (x, y) = (
                -half + 0.015 + across * column as f64,
                0.095 + up * row as f64,
            );
            solid.rounded_box(
                [x + 0.006, y + 0.006, deep - 0.005],
                [x + across - 0.006, y + up - 0.006, deep + 0.018],
                0.006,
                1,
            );
            let knob = [
                [0.03, 0.0],
                [0.028, 0.011],
                [0.02, 0.014],
                [0.011, 0.006],
                [0.0, 0.006],
                [0.0, 0.0],
            ];
            let place = [x + 0.5 * across, y + 0.55 * up, deep + 0.016];
            solid.revolve_forward(place, &knob, 6);
        }
    }
    solid
}

fn wardrobe() -> Solid {
    let mut solid = Solid::default();
    for x in [-0.8, 0.8] {
        for z in [0.07, 0.55] {
            solid.post([x, 0.0, z], 0.03, 0.11, 8);
        }
    }
    solid.cuboid([-0.88, 0.1, 0.0], [0.88, 2.12, 0.6]);
    solid.rounded_box([-0.92, 2.1, -0.002], [0.92, 2.17, 0.65], 0.02, 1);
    solid.rounded_box([-0.9, 0.08, 0.002], [0.9, 0.17, 0.63], 0.015, 1);
    for door in 0..3 {
        let x = -0.87 + 0.58 * f64::from(door);
        solid.rounded_box([x + 0.005, 0.18, 0.595], [x + 0.575, 2.09, 0.622], 0.008, 1);
        solid.rounded_box([x + 0.08, 0.25, 0.615], [x + 0.5, 2.02, 0.632], 0.008, 1);
        let handle = if door == 0 { x + 0.54 } else { x + 0.04 };
        solid.bar([handle, 0.95, 0.645], [handle, 1.2, 0.645], 0.008, 8);
        for y in [0.97, 1.18] {
            solid.bar([handle, y, 0.615], [handle, y, 0.646], 0.006, 6);
        }
    }
    solid
}
