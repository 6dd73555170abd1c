//! The inside of a storey: floor, walls between hall and rooms, doors, stairs.

use super::city_builder::{Prefab, at, quarter_rotation};
use super::facade::leaf;
use super::materials::MaterialKind;
use super::plan::{FLOOR, HALL, STOREY, THIN};
use super::shapes::Opening;
use crate::solid::Solid;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

pub(super) const GROUND: Prefab = Prefab {
    name: "ground floor",
    material: MaterialKind::Wood,
    make: || floor(&[]),
};
pub(super) const UPPER: Prefab = Prefab {
    name: "floor with a stairwell",
    material: MaterialKind::Wood,
    make: || floor(&[WELL]),
};
pub(super) const PARTITIONS: Prefab = Prefab {
    name: "walls between rooms",
    material: MaterialKind::White,
    make: partitions,
};
pub(super) const DOORS: Prefab = Prefab {
    name: "room doors",
    material: MaterialKind::Cream,
    make: doors,
};
pub(super) const STAIRS: Prefab = Prefab {
    name: "stairs",
    material: MaterialKind::Wood,
    make: stairs,
};
pub(super) const BALUSTRADE: Prefab = Prefab {
    name: "balustrade",
    material: MaterialKind::White,
    make: balustrade,
};

/// Half the edge of a floor, which ends inside the outer walls.
const REACH: f64 = 6.85;
/// The stairwell: from the left of the hall's centre, and along -Z.
const WELL: Opening = Opening {
    x: [-HALL, -0.1],
    y: [-0.3, 4.4],
};
/// Range of a room door, from the centre of the house, and its height.
const DOOR: [f64; 2] = [5.15, 6.05];
const DOOR_HEIGHT: f64 = 2.1;

fn floor(holes: &[Opening]) -> Solid {
    let mut slab = Solid::default();
    slab.wall_with_openings([-REACH, REACH], [-REACH, REACH], [-FLOOR, 0.0], holes);
    let mut solid = Solid::default();
    solid.add(&slab, DAffine3::from_rotation_x(-FRAC_PI_2));
    solid
}

fn partitions() -> Solid {
    let mut solid = Solid::default();
    // Walls overlap the floors above and below.
    let height = [-0.02, STOREY - FLOOR + 0.02];
    let thick = [-0.5 * THIN, 0.5 * THIN];
    let end = REACH - 0.1;
    let door = |x: [f64; 2]| Opening {
        x,
        y: [height[0], DOOR_HEIGHT],
    };
    let mut hall = Solid::default();
    let openings = [door(DOOR), door([-DOOR[1], -DOOR[0]])];
    hall.wall_with_openings([-end, end], height, thick, &openings);
    let mut rooms = Solid::default();
    rooms.wall_with_openings([HALL, REACH], height, thick, &[]);
    for half in [0, 2] {
        let turn = quarter_rotation(half);
        solid.add(&hall, turn * at(HALL, 0.0, 0.0) * quarter_rotation(1));
        solid.add(&rooms, turn);
    }
    solid
}

/// Four doors, open into their rooms.
fn doors() -> Solid {
    let mut solid = Solid::default();
    let half = 0.5 * (DOOR[1] - DOOR[0]);
    for (side, quarters) in [(-1.0, -1), (1.0, 1)] {
        let mut door = Solid::default();
        let frame = Opening {
            x: [-half, half],
            y: [-0.06, DOOR_HEIGHT],
        };
        door.frame(frame, 0.05, [-0.08, 0.08]);
        let hinge = at(side * (half - 0.05), 0.0, 0.04);
        // The hinges are on the side away from the windows.
        let opened: f64 = if side > 0.0 { 80.0 } else { 100.0 };
        let swing = DAffine3::from_rotation_y(opened.to_radians());
        door.add(
            &leaf(2.0 * half - 0.11, [0.02, DOOR_HEIGHT - 0.06]),
            hinge * swing,
        );
        let place = at(side * HALL, 0.0, 0.5 * (DOOR[0] + DOOR[1])) * quarter_rotation(quarters);
        for turn in [0, 2] {
            solid.add(&door, quarter_rotation(turn) * place);
        }
    }
    solid
}

/// Steps of a flight, from the near end of the stairwell to its far end.
const STEPS: usize = 17;

fn stairs() -> Solid {
    let mut solid = Solid::default();
    let [x0, x1] = [-HALL + 0.5 * THIN + 0.02, WELL.x[1] - 0.06];
    let run = (WELL.y[1] - WELL.y[0]) / STEPS as f64;
    let rise = STOREY / STEPS as f64;
    for step in 1..STEPS {
        let (y, z) = (rise * step as f64, -WELL.y[0] - run * (step as f64 - 1.0));
        solid.rounded_box([x0, y - 0.045, z - run - 0.04], [x1, y, z + 0.02], 0.014, 1);
        solid.cuboid(
            [x0 + 0.01, y - rise - 0.01, z - 0.03],
            [x1 - 0.01, y - 0.02, z - 0.01],
        );
    }
    let long = WELL.y[1] - WELL.y[0];
    for x in [x0 - 0.01, x1 - 0.03] {
        solid.block([1; 3], |u, v, w| {
            DVec3::new(
                x + 0.04 * w,
                STOREY * u - 0.2 + 0.28 * v,
                -WELL.y[0] - long * u,
            )
        });
    }
    let x = x1 - 0.05;
    let slope = |z: f64| STOREY * (-WELL.y[0] - z) / long;
    for step in (1..STEPS).step_by(2) {
        let z = -WELL.y[0] - run * (step as f64 - 0.5);
        let foot = rise * step as f64 - 0.01;
        solid.post([x, foot, z], 0.014, slope(z) + 1.0 - foot, 8);
    }
    let ends = [-WELL.y[0], -WELL.y[1] + 0.1];
    let rail = ends.map(|z| DVec3::new(x, slope(z) + 1.0, z));
    solid.tube(&rail, 0.028, 10);
    solid.post([x, 0.0, ends[0]], 0.045, 1.1, 12);
    solid
}

/// A balustrade around the stairwell, open at the top of the stairs.
fn balustrade() -> Solid {
    let mut solid = Solid::default();
    let x = WELL.x[1] + 0.04;
    let (near, far) = (-WELL.y[0] + 0.06, -WELL.y[1] + 0.05);
    let post = [
        [0.9, 0.0],
        [0.9, 0.012],
        [0.45, 0.026],
        [0.28, 0.014],
        [0.0, 0.022],
        [0.0, 0.0],
    ];
    let posts = 19;
    for i in 0..=posts {
        let z = near + (far - near) * f64::from(i) / f64::from(posts);
        solid.revolve_upright([x, 0.0, z], &post, 6);
    }
    let along = [[x, 0.91, near + 0.05], [x, 0.91, far - 0.05]];
    solid.tube(&along.map(DVec3::from), 0.03, 10);
    solid
}
