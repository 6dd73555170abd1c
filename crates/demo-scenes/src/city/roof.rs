//! Roofs, chimneys and dormers. A roof lies on the walls of a house; its underside, the ceiling of the top rooms,
//! lies the thickness of a floor below y = 0.

use super::city_builder::{Prefab, quarter_rotation};
use super::materials::MaterialKind;
use super::plan::{FLOOR, LOT};
use super::shapes::Opening;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

pub(super) const GABLE: Prefab = Prefab {
    name: "gable roof",
    material: MaterialKind::Tile,
    make: gable,
};
pub(super) const HIP: Prefab = Prefab {
    name: "hip roof",
    material: MaterialKind::Tile,
    make: hip,
};
pub(super) const FLAT: Prefab = Prefab {
    name: "flat roof",
    material: MaterialKind::Stone,
    make: flat,
};
pub(super) const CHIMNEY: Prefab = Prefab {
    name: "chimney",
    material: MaterialKind::Brick,
    make: chimney,
};
pub(super) const DORMER: Prefab = Prefab {
    name: "dormer",
    material: MaterialKind::White,
    make: dormer,
};
pub(super) const ROOF_UNIT: Prefab = Prefab {
    name: "ventilation",
    material: MaterialKind::Steel,
    make: ventilation,
};

/// Overhang of the eaves, their height, and the height of the ridge.
const EAVES: f64 = 0.5;
const EDGE: f64 = 0.05;
const RIDGE: f64 = 4.2;

/// Height of the slope of a gable roof at z.
pub(super) fn slope(z: f64) -> f64 {
    EDGE + (RIDGE - EDGE) * (1.0 - z.abs() / (LOT + EAVES))
}

/// A gable roof; its ridge is along X.
fn gable() -> Solid {
    let mut solid = Solid::default();
    let out = LOT + EAVES;
    let outline = [
        [-LOT, -FLOOR],
        [LOT, -FLOOR],
        [out, -EDGE],
        [out, EDGE],
        [0.0, RIDGE],
        [-out, EDGE],
        [-out, -EDGE],
    ];
    let half = LOT - 0.005;
    let mut body = Solid::default();
    body.extrude(&outline, [-half, half]);
    solid.add(&body, quarter_rotation(1));
    let mut side = Solid::default();
    let (left, right) = (-half + 0.002, half - 0.002);
    let eaves = [left, right].map(|x| DVec3::new(x, EDGE, out));
    let ridge = [left, right].map(|x| DVec3::new(x, RIDGE, 0.0));
    tiles(&mut side, eaves, ridge, 14);
    // A gutter.
    side.bar(
        [left, EDGE - 0.03, out + 0.07],
        [right, EDGE - 0.03, out + 0.07],
        0.075,
        10,
    );
    solid.add(&side, DAffine3::IDENTITY);
    solid.add(&side, quarter_rotation(2));
    solid.bar(
        [left, RIDGE + 0.02, 0.0],
        [right, RIDGE + 0.02, 0.0],
        0.13,
        12,
    );
    solid
}

/// A hip roof; its eaves are towards the two streets, +X and +Z.
fn hip() -> Solid {
    let mut solid = Solid::default();
    let out = LOT + EAVES;
    let square = |low: f64, high: f64, y: f64| {
        let corners = [[high, high], [high, low], [low, low], [low, high]];
        corners.map(|[x, z]| DVec3::new(x, y, z)).to_vec()
    };
    let top = square(0.15, 0.35, RIDGE - 0.3);
    let eaves = square(-LOT, out, EDGE);
    solid.faceted_loft(&[
        square(-LOT, LOT, -FLOOR),
        square(-LOT, out, -EDGE),
        eaves.clone(),
        top.clone(),
    ]);
    for i in 0..4 {
        let next = (i + 1) % 4;
        let (low, high) = ([eaves[i], eaves[next]], [top[i], top[next]]);
        tiles(&mut solid, low, high, 14);
        let ends = [low[0], high[0]].map(|end| end + DVec3::Y * 0.01);
        solid.tube(&ends, 0.09, 8);
    }
    let knob = [
        [0.7, 0.0],
        [0.6, 0.03],
        [0.5, 0.02],
        [0.42, 0.1],
        [0.33, 0.13],
        [0.24, 0.1],
        [0.16, 0.04],
        [0.0, 0.14],
        [0.0, 0.0],
    ];
    solid.revolve_upright([0.25, RIDGE - 0.35, 0.25], &knob, 16);
    solid
}

/// Rows of tiles up a slope, each overlapping the row below. Eaves and ridge have the same direction, to the right
/// seen from outside.
fn tiles(solid: &mut Solid, eaves: [DVec3; 2], ridge: [DVec3; 2], rows: usize) {
    let across = eaves[1] - eaves[0];
    let normal = across.cross(ridge[0] - eaves[0]).normalize_or(DVec3::Y);
    for row in 0..rows {
        let part = |v: f64| ((row as f64 + v * 1.06) / rows as f64).min(0.995);
        solid.block([1; 3], |u, v, w| {
            let place = eaves[0]
                .lerp(ridge[0], part(v))
                .lerp(eaves[1].lerp(ridge[1], part(v)), 0.001 + 0.998 * u);
            place + normal * ((0.07 - 0.035 * v) * w - 0.02)
        });
    }
}

/// A flat roof: a slab with a parapet.
fn flat() -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-LOT, -FLOOR, -LOT], [LOT, 0.1, LOT]);
    let end = LOT - 0.003;
    let mut ring = Solid::default();
    let mut copings = Solid::default();
    let hole = |half: f64| Opening {
        x: [-half, half],
        y: [-half, half],
    };
    ring.wall_with_openings([-end, end], [-end, end], [0.09, 0.7], &[hole(LOT - 0.25)]);
    let over = LOT - 0.001;
    copings.wall_with_openings(
        [-over, over],
        [-over, over],
        [0.7, 0.76],
        &[hole(LOT - 0.3)],
    );
    let lying = DAffine3::from_rotation_x(-FRAC_PI_2);
    solid.add(&ring, lying);
    solid.add(&copings, lying);
    // The top of the stairs, and two skylights.
    solid.cuboid([-1.6, 0.09, -5.0], [1.2, 2.3, -2.6]);
    solid.rounded_box([-1.8, 2.25, -5.2], [1.4, 2.4, -2.4], 0.03, 1);
    solid.rounded_box([-0.6, 0.1, -2.62], [0.4, 2.1, -2.57], 0.02, 1);
    for x in [-4.0, 4.0] {
        solid.rounded_box([x - 0.8, 0.09, 1.0], [x + 0.8, 0.35, 2.6], 0.04, 1);
        solid.frame(
            Opening {
                x: [x - 0.7, x + 0.7],
                y: [0.1, 0.3],
            },
            0.05,
            [2.59, 2.63],
        );
    }
    solid
}

/// A chimney; its foot is inside the roof.
fn chimney() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.5, -0.9, -0.35], [0.5, 1.5, 0.35], 0.02, 1);
    solid.rounded_box([-0.57, 1.3, -0.42], [0.57, 1.42, 0.42], 0.02, 1);
    solid.rounded_box([-0.62, 1.48, -0.47], [0.62, 1.56, 0.47], 0.025, 1);
    for x in [-0.28, 0.28] {
        let pot = [
            [0.45, 0.0],
            [0.45, 0.1],
            [0.42, 0.15],
            [0.38, 0.15],
            [0.35, 0.12],
            [0.05, 0.15],
            [0.0, 0.17],
            [0.0, 0.0],
        ];
        solid.revolve_upright([x, 1.55, 0.0], &pot, 16);
    }
    solid
}

/// A dormer that faces +Z and intersects the slope of the roof.
fn dormer() -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-0.9, -0.5, -2.9], [0.9, 1.35, 0.0]);
    let gable = [
        [-1.1, 1.25],
        [1.1, 1.25],
        [1.1, 1.32],
        [0.0, 2.1],
        [-1.1, 1.32],
    ];
    solid.extrude(&gable, [-3.6, 0.18]);
    let opening = Opening {
        x: [-0.65, 0.65],
        y: [0.15, 1.2],
    };
    solid.frame(opening, 0.1, [-0.01, 0.06]);
    for x in [[-0.56, 0.0], [0.0, 0.56]] {
        solid.frame(Opening { x, y: [0.24, 1.11] }, 0.05, [-0.01, 0.03]);
    }
    solid.rounded_box([-0.75, 0.07, -0.01], [0.75, 0.15, 0.14], 0.02, 1);
    solid
}

fn ventilation() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.7, 0.12, -0.5], [0.7, 1.0, 0.5], 0.04, 1);
    for x in [-0.6, 0.6] {
        solid.cuboid([x - 0.06, -0.01, -0.45], [x + 0.06, 0.14, 0.45]);
    }
    for rib in 0..9 {
        let y = 0.22 + 0.08 * f64::from(rib);
        solid.rounded_box([-0.62, y, 0.49], [0.62, y + 0.04, 0.53], 0.012, 1);
    }
    let cowl = [
        [0.7, 0.0],
        [0.68, 0.2],
        [0.55, 0.3],
        [0.45, 0.3],
        [0.4, 0.18],
        [0.0, 0.18],
        [0.0, 0.0],
    ];
    solid.revolve_upright([0.0, 0.99, 0.0], &cowl, 24);
    solid
}
