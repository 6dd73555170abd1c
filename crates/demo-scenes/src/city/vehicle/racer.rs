//! Racing cars: open cockpits, wings, wheels outside the body.

use super::body::Body;
use super::cabin;
use super::specs::Stance;
use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};

pub(super) const STANCE: Stance = Stance {
    axles: [1.75, -1.6],
    track: 0.8,
    radius: 0.33,
};

/// Parts in the colour of the car.
pub(super) const BODY: &[Prefab] = &[
    Prefab {
        name: "monocoque",
        material: MaterialKind::RedLacquer,
        make: monocoque,
    },
    Prefab {
        name: "side pods",
        material: MaterialKind::RedLacquer,
        make: side_pods,
    },
    Prefab {
        name: "engine cover",
        material: MaterialKind::RedLacquer,
        make: engine_cover,
    },
];

pub(super) const WINGS: &[Prefab] = &[
    Prefab {
        name: "front wing",
        material: MaterialKind::White,
        make: front_wing,
    },
    Prefab {
        name: "rear wing",
        material: MaterialKind::White,
        make: rear_wing,
    },
    Prefab {
        name: "underbody",
        material: MaterialKind::Black,
        make: underbody,
    },
    Prefab {
        name: "racing mirrors",
        material: MaterialKind::Black,
        make: mirrors,
    },
];

pub(super) const COCKPIT: &[Prefab] = &[
    Prefab {
        name: "racing seat",
        material: MaterialKind::Black,
        make: || moved(&(cabin::SEAT.make)(), [-0.12, 0.08, 0.0]),
    },
    Prefab {
        name: "racing steering wheel",
        material: MaterialKind::Black,
        make: || moved(&(cabin::STEERING_WHEEL.make)(), [0.32, 0.58, 0.0]),
    },
    Prefab {
        name: "driver",
        material: MaterialKind::Blue,
        make: driver,
    },
    Prefab {
        name: "helmet",
        material: MaterialKind::White,
        make: helmet,
    },
];

fn moved(solid: &Solid, place: [f64; 3]) -> Solid {
    let mut all = Solid::default();
    all.add_at(solid, place);
    all
}

/// The body from the nose to behind the driver, open above the seat.
fn monocoque() -> Solid {
    let body = Body {
        sections: &[
            [-0.75, 0.1, 0.78, 0.3],
            [-0.5, 0.09, 0.72, 0.33],
            [0.4, 0.09, 0.68, 0.33],
            [0.9, 0.12, 0.64, 0.28],
            [1.6, 0.2, 0.54, 0.19],
            [2.2, 0.26, 0.42, 0.12],
            [2.42, 0.28, 0.38, 0.09],
            [2.45, 0.285, 0.375, 0.06],
        ],
        belt: [0.4, 0.3],
        arches: &[],
        arch: 0.0,
        columns: 24,
        power: 3.2,
    };
    body.shell(|at| at.y > 0.55 && at.z.abs() < 0.24 && (-0.52..0.48).contains(&at.x))
}

/// Side pods: long boxes with intakes at the front.
fn side_pods() -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        solid.block([12, 6, 4], |u, v, w| {
            let x = -1.35 + 1.6 * u;
            let narrow = 1.0 - 0.55 * (1.0 - u).powi(2);
            let z = side * 0.46 + (w - 0.5) * 0.36 * narrow - side * 0.12 * (1.0 - narrow);
            let round = 1.0 - 0.25 * (2.0 * w - 1.0).powi(2);
            DVec3::new(x, 0.12 + 0.4 * v * narrow * round, z)
        });
        for rib in 0..6 {
            let y = 0.18 + 0.05 * f64::from(rib);
            let z = side * 0.46;
            solid.rounded_box([0.23, y, z - 0.14], [0.28, y + 0.02, z + 0.14], 0.008, 1);
        }
    }
    solid
}

/// The engine cover, from the air box behind the driver's head to the gearbox.
fn engine_cover() -> Solid {
    let mut solid = Solid::default();
    let section = |x: f64, top: f64, half: f64| {
        let sides = 20;
        let corner = |i: usize| {
            let (sin, cos) = (std::f64::consts::PI * (i as f64 / (sides - 1) as f64)).sin_cos();
            DVec3::new(x, 0.5 + (top - 0.5) * sin, -half * cos)
        };
        (0..sides).map(corner).collect::<Vec<_>>()
    };
    let rows = [
        section(-1.95, 0.58, 0.05),
        section(-1.7, 0.66, 0.1),
        section(-1.3, 0.8, 0.17),
        section(-0.95, 0.96, 0.2),
        section(-0.72, 1.02, 0.18),
        section(-0.6, 1.0, 0.14),
        section(-0.56, 0.97, 0.1),
    ];
    solid.loft(&rows);
    // The fin.
    let fin = [
        [-2.0, 0.62],
        [-1.5, 0.66],
        [-1.0, 0.9],
        [-1.05, 0.99],
        [-2.0, 0.9],
    ];
    solid.extrude(&fin, [-0.008, 0.008]);
    solid
}

/// A wing element: its chord is along X, its span from z to z.
fn blade(solid: &mut Solid, [x, y]: [f64; 2], chord: f64, pitch: f64, half: f64) {
    let outline: Vec<[f64; 2]> = (0..18)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / 18.0;
            let (sin, cos) = angle.sin_cos();
            // The profile is thin at the rear, round at the front and concave above.
            let (along, thick) = (0.5 * chord * cos, 0.05 * chord * sin * (0.6 + 0.4 * cos));
            let bow = -0.02 * chord * (1.0 - cos * cos);
            let (s, c) = pitch.sin_cos();
            let up = thick + bow;
            [x + along * c - up * s, y + along * s + up * c]
        })
        .collect();
    solid.extrude(&outline, [-half, half]);
}

fn front_wing() -> Solid {
    let mut solid = Solid::default();
    blade(&mut solid, [2.42, 0.13], 0.34, -0.08, 0.78);
    blade(&mut solid, [2.2, 0.2], 0.2, -0.4, 0.77);
    for side in [-1.0, 1.0] {
        let z = side * 0.78;
        solid.rounded_box([2.08, 0.07, z - 0.012], [2.62, 0.34, z + 0.012], 0.008, 1);
        let z = side * 0.11;
        solid.rounded_box([2.2, 0.12, z - 0.01], [2.4, 0.32, z + 0.01], 0.006, 1);
    }
    solid
}

fn rear_wing() -> Solid {
    let mut solid = Solid::default();
    blade(&mut solid, [-2.1, 0.88], 0.34, -0.25, 0.48);
    blade(&mut solid, [-2.27, 0.99], 0.18, -0.7, 0.48);
    blade(&mut solid, [-2.1, 0.45], 0.2, -0.3, 0.46);
    for side in [-1.0, 1.0] {
        let z = side * 0.48;
        solid.rounded_box([-2.4, 0.36, z - 0.012], [-1.86, 1.08, z + 0.012], 0.008, 1);
        let z = side * 0.08;
        solid.rounded_box([-2.16, 0.4, z - 0.01], [-2.02, 0.88, z + 0.01], 0.006, 1);
    }
    // The rain light and its supports.
    solid.rounded_box([-2.16, 0.3, -0.05], [-1.8, 0.42, 0.05], 0.02, 1);
    solid
}

fn underbody() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-1.9, 0.06, -0.66], [0.75, 0.1, 0.66], 0.012, 1);
    solid.rounded_box([0.7, 0.07, -0.2], [1.5, 0.1, 0.2], 0.012, 1);
    for vane in 0..6 {
        let z = -0.45 + 0.18 * f64::from(vane);
        solid.block([1; 3], |u, v, w| {
            DVec3::new(
                -2.2 + 0.4 * u,
                0.07 + 0.14 * (1.0 - u) + (0.02 + 0.12 * (1.0 - u)) * v,
                z + 0.01 * w,
            )
        });
    }
    solid.block([4, 1, 1], |u, v, w| {
        DVec3::new(
            -2.25 + 0.5 * u,
            0.07 + 0.2 * (1.0 - u).powi(2) + 0.015 * v,
            -0.5 + w,
        )
    });
    solid
}

fn mirrors() -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        let z = side * 0.5;
        solid.rounded_box([0.42, 0.7, z - 0.09], [0.48, 0.79, z + 0.09], 0.025, 2);
        solid.bar([0.45, 0.62, side * 0.26], [0.45, 0.73, z], 0.01, 8);
    }
    solid
}

fn driver() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.3, 0.28, -0.19], [-0.06, 0.72, 0.19], 0.08, 3);
    for side in [-1.0, 1.0] {
        let arm = [
            DVec3::new(-0.18, 0.65, side * 0.19),
            DVec3::new(0.02, 0.48, side * 0.22),
            DVec3::new(0.28, 0.58, side * 0.15),
        ];
        solid.tube(&crate::tube::rounded_path(&arm, 0.1, 13), 0.045, 10);
        let leg = [
            DVec3::new(-0.12, 0.32, side * 0.1),
            DVec3::new(0.35, 0.42, side * 0.1),
            DVec3::new(0.85, 0.26, side * 0.08),
        ];
        solid.tube(&crate::tube::rounded_path(&leg, 0.15, 13), 0.06, 10);
    }
    solid
}

fn helmet() -> Solid {
    let mut solid = Solid::default();
    let profile = [
        [0.15, 0.0],
        [0.14, 0.05],
        [0.11, 0.09],
        [0.06, 0.12],
        [0.0, 0.132],
        [-0.06, 0.125],
        [-0.11, 0.1],
        [-0.13, 0.07],
        [-0.2, 0.06],
        [-0.2, 0.0],
    ];
    solid.revolve_upright([-0.2, 0.86, 0.0], &profile, 24);
    let mut visor = Solid::default();
    visor.block([10, 4, 1], |u, v, w| {
        let angle = (u - 0.5) * 2.2;
        let radius = 0.128 + 0.012 * w;
        let (sin, cos) = angle.sin_cos();
        DVec3::new(radius * cos, -0.03 + 0.08 * v, -radius * sin)
    });
    solid.add(
        &visor,
        DAffine3::from_translation(DVec3::new(-0.2, 0.87, 0.0)),
    );
    solid
}
