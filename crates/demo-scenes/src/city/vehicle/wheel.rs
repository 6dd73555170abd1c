//! Wheels with brakes and suspension. The hub is the origin, +Z is outwards.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::city::shapes::along_z;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::TAU;

/// Wheel and suspension of a car.
pub(super) const CAR: [&[Prefab]; 2] = [
    &[
        Prefab {
            name: "tyre",
            material: MaterialKind::Black,
            make: || tyre([0.2, 0.31], 0.1),
        },
        Prefab {
            name: "rim",
            material: MaterialKind::SilverLacquer,
            make: || rim(0.2, 0.09, 5),
        },
        BRAKE_DISC,
        CALLIPER,
    ],
    &[
        Prefab {
            name: "spring and damper",
            material: MaterialKind::Steel,
            make: || damper([-0.2, 0.05], [-0.24, 0.42]),
        },
        Prefab {
            name: "wishbone",
            material: MaterialKind::Black,
            make: || wishbones(&[-0.1], 0.45),
        },
    ],
];

/// Wheel and suspension of a racing car.
pub(super) const RACER: [&[Prefab]; 2] = [
    &[
        Prefab {
            name: "slick tyre",
            material: MaterialKind::Black,
            make: || tyre([0.17, 0.33], 0.17),
        },
        Prefab {
            name: "racing rim",
            material: MaterialKind::Steel,
            make: || rim(0.17, 0.15, 9),
        },
        BRAKE_DISC,
        CALLIPER,
    ],
    &[
        Prefab {
            name: "racing damper",
            material: MaterialKind::RedLacquer,
            make: || damper([-0.24, -0.05], [-0.5, 0.2]),
        },
        Prefab {
            name: "racing wishbones",
            material: MaterialKind::Black,
            make: || wishbones(&[-0.08, 0.1], 0.62),
        },
    ],
];

const BRAKE_DISC: Prefab = Prefab {
    name: "brake disc",
    material: MaterialKind::Steel,
    make: brake_disc,
};
const CALLIPER: Prefab = Prefab {
    name: "calliper",
    material: MaterialKind::RedLacquer,
    make: calliper,
};

/// A tyre between two radii, with its half width; grooves run around its tread.
fn tyre([inner, outer]: [f64; 2], half: f64) -> Solid {
    let mut right = vec![
        [half * 0.86, inner],
        [half, inner + 0.2 * (outer - inner)],
        [half * 1.08, inner + 0.5 * (outer - inner)],
        [half, outer - 0.03],
        [half * 0.9, outer - 0.008],
        [half * 0.78, outer],
    ];
    for groove in [0.55, 0.18] {
        let x = half * groove;
        right.extend([
            [x + 0.006, outer],
            [x + 0.004, outer - 0.008],
            [x - 0.004, outer - 0.008],
            [x - 0.006, outer],
        ]);
    }
    // Counter-clockwise: from the right end over the tread to the left end.
    let left = right.iter().rev().map(|[x, radius]| [-x, *radius]);
    let profile: Vec<[f64; 2]> = right.iter().copied().chain(left).collect();
    let mut ring = Solid::default();
    ring.revolve_closed(&profile, 26);
    let mut solid = Solid::default();
    solid.add(&ring, along_z([0.0; 3]));
    solid
}

/// A rim that overlaps the tyre.
fn rim(radius: f64, half: f64, spokes: usize) -> Solid {
    let mut ring = Solid::default();
    let barrel = [
        [-half, radius - 0.012],
        [-half * 0.6, radius - 0.03],
        [half * 0.6, radius - 0.03],
        [half, radius - 0.012],
        [half * 1.05, radius + 0.012],
        [half * 0.9, radius + 0.004],
        [half * 0.6, radius - 0.016],
        [-half * 0.6, radius - 0.016],
        [-half * 0.9, radius + 0.004],
        [-half * 1.05, radius + 0.012],
    ];
    ring.revolve_closed(&barrel, 28);
    let front = half * 0.5;
    ring.revolve(
        &[
            [front + 0.02, 0.0],
            [front + 0.02, 0.025],
            [front + 0.005, 0.03],
            [front, 0.055],
            [front - 0.05, 0.06],
            [front - 0.05, 0.0],
        ],
        24,
    );
    let mut solid = Solid::default();
    solid.add(&ring, along_z([0.0; 3]));
    for spoke in 0..spokes {
        let angle = TAU * spoke as f64 / spokes as f64;
        let (sin, cos) = angle.sin_cos();
        let (out, beside) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
        // Two blades that diverge towards the rim.
        for side in [-1.0, 1.0] {
            solid.block([4, 1, 1], |u, v, w| {
                let along = 0.045 + (radius - 0.065) * u;
                let off = side * (0.012 + 0.02 * u) + (v - 0.5) * 0.018;
                let z = front - 0.012 - 0.05 * (1.0 - u) * u + (w - 0.5) * 0.024;
                out * along + beside * off + DVec3::Z * z
            });
        }
    }
    for nut in 0..5 {
        let (sin, cos) = (TAU * (f64::from(nut) + 0.5) / 5.0).sin_cos();
        let mut head = Solid::default();
        head.prism(0.009, [front - 0.01, front + 0.014], 6);
        solid.add(&head, along_z([0.042 * cos, 0.042 * sin, 0.0]));
    }
    solid
}

fn brake_disc() -> Solid {
    let mut ring = Solid::default();
    ring.band([-0.045, -0.037], [0.075, 0.14], 28);
    ring.band([-0.028, -0.02], [0.075, 0.14], 28);
    ring.revolve(
        &[
            [0.01, 0.0],
            [0.01, 0.07],
            [-0.02, 0.08],
            [-0.047, 0.08],
            [-0.047, 0.03],
            [-0.14, 0.03],
            [-0.14, 0.0],
        ],
        24,
    );
    let mut solid = Solid::default();
    solid.add(&ring, along_z([0.0; 3]));
    for vane in 0..12 {
        let turn = DAffine3::from_rotation_z(TAU * f64::from(vane) / 12.0);
        let mut rib = Solid::default();
        rib.cuboid([0.085, -0.003, -0.038], [0.135, 0.003, -0.027]);
        solid.add(&rib, turn);
    }
    solid
}

fn calliper() -> Solid {
    let mut solid = Solid::default();
    for z in [[-0.075, -0.046], [-0.019, 0.004]] {
        solid.block([8, 1, 1], |u, v, w| {
            let angle = 0.5 + 1.1 * u;
            let (sin, cos) = angle.sin_cos();
            // u runs around and v inwards: with w along the axis they are right-handed.
            let radius = 0.15 - 0.055 * v;
            DVec3::new(radius * cos, radius * sin, z[0] + (z[1] - z[0]) * w)
        });
    }
    solid.block([6, 1, 1], |u, v, w| {
        let (sin, cos) = (0.75 + 0.6 * u).sin_cos();
        let radius = 0.158 - 0.012 * v;
        DVec3::new(radius * cos, radius * sin, -0.07 + 0.07 * w)
    });
    for bolt in [0.62, 1.48] {
        let (sin, cos) = f64::sin_cos(bolt);
        solid.bar(
            [0.13 * cos, 0.13 * sin, -0.085],
            [0.13 * cos, 0.13 * sin, -0.05],
            0.009,
            6,
        );
    }
    solid
}

/// A coil spring around a rod, between two points [z, y].
fn damper(foot: [f64; 2], head: [f64; 2]) -> Solid {
    let mut solid = Solid::default();
    let from = DVec3::new(0.0, foot[1], foot[0]);
    let to = DVec3::new(0.0, head[1], head[0]);
    let along = (to - from).normalize_or(DVec3::Y);
    let beside = DVec3::X;
    let across = along.cross(beside);
    let (turns, each) = (6, 10);
    let coil: Vec<DVec3> = (0..=turns * each)
        .map(|i| {
            let part = f64::from(i) / f64::from(turns * each);
            let (sin, cos) = (TAU * f64::from(i) / f64::from(each)).sin_cos();
            let middle = from.lerp(to, 0.2 + 0.7 * part);
            middle + (beside * cos + across * sin) * 0.045
        })
        .collect();
    solid.tube(&coil, 0.007, 6);
    solid.tube(&[from, from.lerp(to, 0.6)], 0.022, 12);
    solid.tube(&[from.lerp(to, 0.5), to], 0.011, 10);
    for (part, radius) in [(0.18, 0.056), (0.9, 0.056)] {
        let ends = [from.lerp(to, part), from.lerp(to, part + 0.03)];
        solid.tube(&ends, radius, 16);
    }
    solid
}

/// Suspension arms at these heights, from the hub inwards.
fn wishbones(heights: &[f64], reach: f64) -> Solid {
    let mut solid = Solid::default();
    for y in heights {
        let hub = DVec3::new(0.0, *y, -0.07);
        for x in [-0.22, 0.22] {
            let inner = DVec3::new(x, y + 0.03, -reach);
            solid.tube(&[hub, inner], 0.014, 10);
            let bush = [inner - DVec3::X * 0.03, inner + DVec3::X * 0.03];
            solid.tube(&bush, 0.024, 12);
        }
        let ends = [hub - DVec3::Y * 0.03, hub + DVec3::Y * 0.03];
        solid.tube(&ends, 0.022, 12);
    }
    let rod = [DVec3::new(0.1, 0.02, -0.08), DVec3::new(0.12, 0.04, -reach)];
    solid.tube(&rod, 0.01, 8);
    // The upright that joins the arms.
    solid.rounded_box([-0.035, -0.12, -0.1], [0.035, 0.13, -0.045], 0.015, 1);
    solid
}
