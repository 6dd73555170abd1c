//! The outer walls of a storey, and a house's door.

use super::form::Opening;
use super::kit::quarter_turn;
use super::plan::{FLOOR, INSIDE, LOT, PARTY, ROOM, STOREY};
use super::window::{DOOR, Style};
use crate::solid::Solid;
use glam::{DAffine3, DVec3};

/// What a wall with windows has in its middle, and whether it lies before or beside the rooms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Face {
    /// A door between two rooms.
    Door,
    /// The hall's window between two rooms.
    Hall,
    /// Only the rooms' windows, of a wall that stands across to the two others.
    Side,
}

impl Face {
    pub fn name(self) -> &'static str {
        match self {
            Self::Door => "with a door",
            Self::Hall => "with a hall window",
            Self::Side => "of the side",
        }
    }

    /// Its windows.
    pub fn windows(self, style: Style) -> Vec<Opening> {
        let middle = if self == Self::Side { ROOM[1] } else { ROOM[0] };
        let mut windows = Vec::new();
        for middle in [-middle, middle] {
            windows.extend(style.of_room().iter().map(|window| Opening {
                x: window.x.map(|x| x + middle),
                y: window.y,
            }));
        }
        if self == Self::Hall {
            windows.push(style.of_hall());
        }
        windows
    }
}

/// The wall before a storey, towards +Z. A door's opening reaches down to the floor.
pub(super) fn wall(face: Face, style: Style) -> Solid {
    let mut openings = face.windows(style);
    if face == Face::Door {
        openings.push(DOOR);
    }
    let mut solid = Solid::default();
    // A side wall ends at the front wall, which is at its left.
    let left = if face == Face::Side { INSIDE } else { LOT };
    solid.pierced([-left, LOT], HEIGHT, [INSIDE, LOT], &openings);
    // A band between the storeys.
    let z = [LOT - 0.05, LOT + 0.05];
    solid.cuboid(
        [-LOT, HEIGHT[1] - 0.16, z[0]],
        [LOT, HEIGHT[1] - 0.001, z[1]],
    );
    solid
}

/// From the underside of its floor to that of the next.
const HEIGHT: [f64; 2] = [-FLOOR, STOREY - FLOOR];

/// The walls to the neighbours: towards -X, and towards +X or, of a house at a corner, towards -Z.
pub(super) fn party_walls(corner: bool) -> Solid {
    let mut solid = Solid::default();
    // A centimetre short of the lot's end, where the neighbour's begins; their ends are within other walls.
    let thick = [PARTY, LOT - 0.01];
    let inner = INSIDE + 0.05;
    let mut wall = |x: [f64; 2], quarters: i32| {
        let mut wall = Solid::default();
        wall.pierced(x, HEIGHT, thick, &[]);
        solid.add(&wall, quarter_turn(quarters));
    };
    if corner {
        wall([0.015 - LOT, inner], -1);
        wall([-inner, LOT - 0.1], 2);
    } else {
        wall([-inner, inner], -1);
        wall([-inner, inner], 1);
    }
    solid
}

/// The leaf of a house's door in its frame, opened inwards by degrees.
pub(super) fn door(opened: f64) -> Solid {
    let mut solid = Solid::default();
    let frame = Opening {
        x: DOOR.x,
        y: [-0.06, DOOR.y[1]],
    };
    solid.frame(frame, 0.05, [LOT - 0.24, LOT - 0.12]);
    let hinge = [DOOR.x[1] - 0.05, 0.0, LOT - 0.2];
    let turn =
        DAffine3::from_translation(hinge.into()) * DAffine3::from_rotation_y(-opened.to_radians());
    solid.add(&leaf(1.09, [0.02, 2.14]), turn);
    // A canopy, and a step before the door.
    solid.rounded([-0.95, 2.42, LOT - 0.02], [0.95, 2.5, LOT + 0.7], 0.02, 1);
    for x in [-0.8, 0.8] {
        solid.bar([x, 2.1, LOT - 0.01], [x, 2.43, LOT + 0.5], 0.02, 8);
    }
    solid
}

/// A door's leaf with a panel and a handle on either side, its hinges on the vertical at x = 0; it reaches towards -X.
pub(super) fn leaf(wide: f64, y: [f64; 2]) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-wide, y[0], -0.02], [0.0, y[1], 0.02]);
    for z in [[-0.03, -0.015], [0.015, 0.03]] {
        solid.rounded(
            [-wide + 0.12, y[0] + 0.15, z[0]],
            [-0.12, y[1] - 0.12, z[1]],
            0.007,
            1,
        );
    }
    for z in [-1.0, 1.0] {
        let (x, y) = (-wide + 0.07, 1.05);
        let handle = [[x, y, 0.0], [x, y, 0.06 * z], [x + 0.12, y, 0.06 * z]];
        solid.tube(&handle.map(DVec3::from), 0.01, 6);
    }
    solid
}
