//! Outer walls of a storey, and house doors.

use super::city_builder::quarter_rotation;
use super::plan::{FLOOR, INSIDE, LOT, LotPosition, PARTY, ROOM, STOREY};
use super::shapes::Opening;
use super::window::{DOOR, Style};
use crate::solid::Solid;
use glam::{DAffine3, DVec3};

/// Kind of an outer wall with windows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Face {
    /// Front wall of the ground floor: a door between two rooms.
    Door,
    /// Front or rear wall: the hall's window between two rooms.
    Hall,
    /// Side wall: windows of rooms only.
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

    /// The windows of the wall.
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

/// The wall of a storey towards +Z. The opening of a door reaches the floor.
pub(super) fn wall(face: Face, style: Style) -> Solid {
    let mut openings = face.windows(style);
    if face == Face::Door {
        openings.push(DOOR);
    }
    let mut solid = Solid::default();
    // A side wall ends at the front wall on its left.
    let left = if face == Face::Side { INSIDE } else { LOT };
    solid.wall_with_openings([-left, LOT], HEIGHT, [INSIDE, LOT], &openings);
    // A band between the storeys.
    let z = [LOT - 0.05, LOT + 0.05];
    solid.cuboid(
        [-LOT, HEIGHT[1] - 0.16, z[0]],
        [LOT, HEIGHT[1] - 0.001, z[1]],
    );
    solid
}

/// From the underside of the floor to that of the next floor.
const HEIGHT: [f64; 2] = [-FLOOR, STOREY - FLOOR];

/// Walls to the neighbours: towards -X, and towards +X or, on a corner, towards -Z.
pub(super) fn party_walls(position: LotPosition) -> Solid {
    let mut solid = Solid::default();
    // One centimetre before the end of the lot, where the neighbour's wall begins. The ends of the walls lie inside
    // other walls.
    let thick = [PARTY, LOT - 0.01];
    let inner = INSIDE + 0.05;
    let mut wall = |x: [f64; 2], quarters: i32| {
        let mut wall = Solid::default();
        wall.wall_with_openings(x, HEIGHT, thick, &[]);
        solid.add(&wall, quarter_rotation(quarters));
    };
    if position == LotPosition::Corner {
        wall([0.015 - LOT, inner], -1);
        wall([-inner, LOT - 0.1], 2);
    } else {
        wall([-inner, inner], -1);
        wall([-inner, inner], 1);
    }
    solid
}

/// A house door in its frame, opened inwards by an angle in degrees.
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
    // A canopy in front of the door.
    solid.rounded_box([-0.95, 2.42, LOT - 0.02], [0.95, 2.5, LOT + 0.7], 0.02, 1);
    for x in [-0.8, 0.8] {
        solid.bar([x, 2.1, LOT - 0.01], [x, 2.43, LOT + 0.5], 0.02, 8);
    }
    solid
}

/// The leaf of a door with a panel and a handle on each side. Its hinges are at x = 0; it extends towards -X.
pub(super) fn leaf(wide: f64, y: [f64; 2]) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-wide, y[0], -0.02], [0.0, y[1], 0.02]);
    for z in [[-0.03, -0.015], [0.015, 0.03]] {
        solid.rounded_box(
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
