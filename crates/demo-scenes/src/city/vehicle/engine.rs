//! Engines: block, heads, intake, gearbox, radiator and exhaust. The crankshaft is the X axis.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;
use crate::tube::rounded_path;
use glam::{DAffine3, DVec3};

pub(super) const PARTS: &[Prefab] = &[
    Prefab {
        name: "engine block",
        material: MaterialKind::Steel,
        make: block,
    },
    Prefab {
        name: "cylinder heads",
        material: MaterialKind::SilverLacquer,
        make: heads,
    },
    Prefab {
        name: "intake",
        material: MaterialKind::Black,
        make: intake,
    },
    Prefab {
        name: "gearbox",
        material: MaterialKind::SilverLacquer,
        make: gearbox,
    },
    Prefab {
        name: "exhaust manifold",
        material: MaterialKind::Steel,
        make: manifold,
    },
];

/// The exhaust of a car, under its floor, in the coordinates of the car.
pub(super) const EXHAUST: Prefab = Prefab {
    name: "exhaust",
    material: MaterialKind::Steel,
    make: exhaust,
};

/// Cylinders in a row along X.
const CYLINDERS: [f64; 3] = [-0.12, 0.0, 0.12];

fn block() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.2, -0.12, -0.13], [0.2, 0.12, 0.13], 0.025, 1);
    solid.rounded_box([-0.18, -0.17, -0.1], [0.18, -0.1, 0.1], 0.03, 1);
    for side in [-1.0, 1.0] {
        let mut bank = Solid::default();
        bank.rounded_box([-0.19, 0.0, -0.06], [0.19, 0.17, 0.06], 0.015, 1);
        for rib in 0..6 {
            let x = -0.175 + 0.07 * f64::from(rib);
            bank.cuboid([x - 0.005, 0.02, -0.068], [x + 0.005, 0.16, 0.068]);
        }
        let lean = DAffine3::from_translation(DVec3::new(0.0, 0.05, 0.05 * side))
            * DAffine3::from_rotation_x(0.6 * side);
        solid.add(&bank, lean);
    }
    // Pulleys in front.
    for (y, z, radius) in [(0.0, 0.0, 0.075), (0.11, 0.12, 0.04), (0.1, -0.12, 0.045)] {
        let profile = [
            [0.25, 0.0],
            [0.25, 0.4 * radius],
            [0.24, radius],
            [0.232, 0.85 * radius],
            [0.224, radius],
            [0.21, radius],
            [0.21, 0.25 * radius],
            [0.18, 0.25 * radius],
            [0.18, 0.0],
        ];
        let mut pulley = Solid::default();
        pulley.revolve(&profile, 24);
        solid.add(&pulley, DAffine3::from_translation(DVec3::new(0.0, y, z)));
    }
    solid
}

fn heads() -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        let mut head = Solid::default();
        head.rounded_box([-0.2, 0.165, -0.07], [0.2, 0.21, 0.07], 0.012, 1);
        head.rounded_box([-0.19, 0.2, -0.06], [0.19, 0.25, 0.06], 0.024, 2);
        for x in CYLINDERS {
            head.post([x, 0.24, 0.0], 0.022, 0.03, 14);
            head.upright_torus([x, 0.27, 0.0], 0.012, 0.005, [6, 12]);
        }
        let lean = DAffine3::from_translation(DVec3::new(0.0, 0.05, 0.05 * side))
            * DAffine3::from_rotation_x(0.6 * side);
        solid.add(&head, lean);
    }
    solid
}

fn intake() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.18, 0.25, -0.06], [0.18, 0.33, 0.06], 0.035, 2);
    for x in CYLINDERS {
        for side in [-1.0, 1.0] {
            let corners = [
                DVec3::new(x, 0.29, 0.0),
                DVec3::new(x, 0.29, 0.1 * side),
                DVec3::new(x, 0.2, 0.1 * side),
            ];
            solid.tube(&rounded_path(&corners, 0.04, 11), 0.02, 10);
        }
    }
    solid.bar([0.17, 0.29, 0.0], [0.24, 0.29, 0.0], 0.035, 14);
    solid
}

/// The gearbox, towards the rear.
fn gearbox() -> Solid {
    let mut profile = Solid::default();
    profile.revolve(
        &[
            [-0.19, 0.0],
            [-0.19, 0.15],
            [-0.22, 0.15],
            [-0.25, 0.13],
            [-0.36, 0.09],
            [-0.38, 0.1],
            [-0.4, 0.1],
            [-0.42, 0.08],
            [-0.55, 0.07],
            [-0.57, 0.085],
            [-0.59, 0.085],
            [-0.6, 0.0],
        ],
        28,
    );
    for bolt in 0..10 {
        let angle = f64::from(bolt) * 36.0_f64.to_radians();
        let at = DVec3::new(-0.205, 0.14 * angle.cos(), 0.14 * angle.sin());
        let mut head = Solid::default();
        head.prism(0.012, [-0.03, 0.025], 6);
        profile.add(&head, DAffine3::from_translation(at));
    }
    profile
}

fn manifold() -> Solid {
    let mut solid = Solid::default();
    for side in [-1.0, 1.0] {
        for (i, x) in CYLINDERS.into_iter().enumerate() {
            let low = -0.02 * i as f64;
            let corners = [
                DVec3::new(x, 0.17, 0.2 * side),
                DVec3::new(x, 0.13, 0.27 * side),
                DVec3::new(x - 0.05, low, 0.28 * side),
                DVec3::new(-0.26, low - 0.08, 0.2 * side),
            ];
            solid.tube(&rounded_path(&corners, 0.05, 19), 0.019, 8);
        }
        let join = DVec3::new(-0.26, -0.1, 0.2 * side);
        let way = [join + DVec3::X * 0.05, join - DVec3::new(0.25, 0.02, 0.0)];
        solid.tube(&way, 0.04, 12);
    }
    solid
}

fn exhaust() -> Solid {
    let mut solid = Solid::default();
    let corners = [
        DVec3::new(0.8, 0.17, 0.1),
        DVec3::new(-0.5, 0.17, 0.1),
        DVec3::new(-0.9, 0.17, 0.45),
        DVec3::new(-1.5, 0.2, 0.45),
    ];
    solid.tube(&rounded_path(&corners, 0.15, 24), 0.03, 10);
    let pot = [
        [0.3, 0.0],
        [0.3, 0.05],
        [0.26, 0.1],
        [-0.26, 0.1],
        [-0.3, 0.05],
        [-0.3, 0.0],
    ];
    let mut muffler = Solid::default();
    muffler.revolve(&pot, 22);
    solid.add(
        &muffler,
        DAffine3::from_translation(DVec3::new(-1.75, 0.21, 0.45)),
    );
    solid.bar([-2.0, 0.21, 0.45], [-2.23, 0.2, 0.45], 0.03, 12);
    solid
}
