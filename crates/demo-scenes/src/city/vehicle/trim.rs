//! Saloons and vans: their dimensions and the parts on their bodies.

use super::body;
use super::specs::{Car, Stance};
use crate::city::city_builder::{Prefab, quarter_rotation};
use crate::city::materials::MaterialKind;
use crate::city::shapes::Opening;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

pub(super) const SALOON: Car = Car {
    body: Prefab {
        name: "saloon body",
        material: MaterialKind::SilverLacquer,
        make: body::saloon,
    },
    trim: &[
        Prefab {
            name: "saloon bumpers",
            material: MaterialKind::Black,
            make: || bumpers([2.24, -2.24], 0.42, 0.74),
        },
        Prefab {
            name: "saloon headlamps",
            material: MaterialKind::White,
            make: || lamps(2.18, 0.6, 0.52, LampKind::Head),
        },
        Prefab {
            name: "saloon rear lamps",
            material: MaterialKind::RedLacquer,
            make: || lamps(-2.18, 0.72, 0.54, LampKind::Rear),
        },
        Prefab {
            name: "saloon grille",
            material: MaterialKind::Steel,
            make: || grille(2.19, [0.52, 0.67]),
        },
        Prefab {
            name: "saloon mirrors and handles",
            material: MaterialKind::Black,
            make: || mirrors(0.62, 1.0, 0.82, &[0.1, -0.75]),
        },
        Prefab {
            name: "saloon floor pan",
            material: MaterialKind::Black,
            make: || pan([-0.85, 0.92], 0.28, 0.8),
        },
    ],
    stance: Stance {
        axles: [1.38, -1.3],
        track: 0.76,
        radius: 0.31,
    },
    seats: &[[0.05, 0.3, 0.36], [-0.72, 0.32, 0.34]],
    dashboard: [0.72, 0.86, 0.36],
    engine: [1.55, 0.52, 0.0],
};

pub(super) const VAN: Car = Car {
    body: Prefab {
        name: "van body",
        material: MaterialKind::White,
        make: body::van,
    },
    trim: &[
        Prefab {
            name: "van bumpers",
            material: MaterialKind::Black,
            make: || bumpers([2.66, -2.64], 0.45, 0.82),
        },
        Prefab {
            name: "van headlamps",
            material: MaterialKind::White,
            make: || lamps(2.6, 0.66, 0.58, LampKind::Head),
        },
        Prefab {
            name: "van rear lamps",
            material: MaterialKind::RedLacquer,
            make: || lamps(-2.58, 0.95, 0.66, LampKind::Rear),
        },
        Prefab {
            name: "van grille",
            material: MaterialKind::Steel,
            make: || grille(2.6, [0.55, 0.76]),
        },
        Prefab {
            name: "van mirrors and handles",
            material: MaterialKind::Black,
            make: || mirrors(1.35, 1.2, 0.93, &[0.5]),
        },
        Prefab {
            name: "van floor pan",
            material: MaterialKind::Black,
            make: || pan([-2.3, 1.25], 0.32, 0.86),
        },
    ],
    stance: Stance {
        axles: [1.75, -1.55],
        track: 0.82,
        radius: 0.31,
    },
    seats: &[[0.55, 0.5, 0.45]],
    dashboard: [1.35, 1.08, 0.45],
    engine: [1.95, 0.55, 0.0],
};

/// Bumpers at the front and the rear.
fn bumpers(x: [f64; 2], y: f64, half: f64) -> Solid {
    let mut solid = Solid::default();
    for (x, turn) in [(x[0], 0), (x[1].abs(), 2)] {
        let mut bar = Solid::default();
        bar.rounded_box(
            [x - 0.14, y - 0.1, -half],
            [x + 0.03, y + 0.08, half],
            0.05,
            2,
        );
        bar.rounded_box(
            [x - 0.3, y - 0.16, -half],
            [x - 0.08, y - 0.08, half],
            0.03,
            1,
        );
        // The number plate.
        bar.rounded_box(
            [x + 0.02, y - 0.06, -0.26],
            [x + 0.038, y + 0.05, 0.26],
            0.006,
            1,
        );
        solid.add(&bar, quarter_rotation(turn));
    }
    solid
}

/// The lamps of one end of a vehicle.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LampKind {
    Head,
    Rear,
}

/// A pair of lamps, at the front or at the rear.
fn lamps(x: f64, y: f64, z: f64, kind: LampKind) -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        let mut lamp = Solid::default();
        lamp.rounded_box([-0.14, -0.07, -0.13], [0.04, 0.07, 0.13], 0.03, 2);
        for (off, radius) in [(-0.055, 0.045), (0.055, 0.045)] {
            let glass = [
                [0.05, 0.0],
                [0.048, 0.5 * radius],
                [0.04, radius],
                [0.03, radius],
                [0.03, 0.0],
            ];
            let mut lens = Solid::default();
            lens.revolve(&glass, 18);
            lamp.add(&lens, DAffine3::from_translation(DVec3::new(0.0, 0.0, off)));
        }
        let turn = quarter_rotation(match kind {
            LampKind::Head => 0,
            LampKind::Rear => 2,
        });
        let place = DVec3::new(x, y, side * z);
        solid.add(&lamp, DAffine3::from_translation(place) * turn);
    }
    solid
}

fn grille(x: f64, y: [f64; 2]) -> Solid {
    let mut solid = Solid::default();
    let half = 0.36;
    let mut frame = Solid::default();
    let opening = Opening {
        x: [-half, half],
        y,
    };
    frame.frame(opening, 0.02, [-0.04, 0.05]);
    solid.add(
        &frame,
        DAffine3::from_translation(DVec3::X * x) * DAffine3::from_rotation_y(FRAC_PI_2),
    );
    for rib in 0..14 {
        let z = -half + 0.05 * (f64::from(rib) + 0.9);
        solid.rounded_box(
            [x - 0.03, y[0] + 0.005, z - 0.006],
            [x + 0.035, y[1] - 0.005, z + 0.006],
            0.004,
            1,
        );
    }
    solid
}

/// Outside mirrors at a position, and door handles behind them.
fn mirrors(x: f64, y: f64, half: f64, handles: &[f64]) -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        let z = side * (half + 0.1);
        solid.rounded_box(
            [x - 0.05, y, z - 0.08],
            [x + 0.06, y + 0.13, z + 0.08],
            0.035,
            2,
        );
        solid.bar(
            [x + 0.02, y + 0.04, side * (half - 0.06)],
            [x, y + 0.06, z],
            0.02,
            8,
        );
        for handle in handles {
            let z = side * (half + 0.05);
            let (rear, front) = (handle - 0.1, handle + 0.1);
            let low = y - 0.16;
            solid.rounded_box(
                [rear, low, z - 0.02],
                [front, low + 0.03, z + 0.02],
                0.012,
                1,
            );
            for x in [rear + 0.02, front - 0.02] {
                let inside = side * (half - 0.04);
                solid.bar([x, low + 0.015, inside], [x, low + 0.015, z], 0.008, 6);
            }
        }
    }
    solid
}

/// The floor, with a tunnel along its centre.
fn pan(x: [f64; 2], y: f64, half: f64) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([x[0], y - 0.02, -half], [x[1], y, half]);
    solid.rounded_box(
        [x[0] + 0.02, y - 0.01, -0.12],
        [x[1] - 0.02, y + 0.12, 0.12],
        0.05,
        2,
    );
    solid.cuboid([x[1] - 0.02, y - 0.01, -half], [x[1], y + 0.4, half]);
    solid
}
