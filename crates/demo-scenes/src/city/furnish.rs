//! Rooms: what stands where in each kind.

use super::kit::{Kit, Piece, turned};
use super::look::Look;
use super::piece::{bath, bed, fitting, kitchen, lamp, seat, shelf, table};
use super::plan::{FLOOR, ROOM_HALF, STOREY};
use super::window::{Hanging, Style, hangings};
use crate::chance::Chance;
use antumbra_scene::{EntityKey, SceneError};

/// What a room is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Living,
    Kitchen,
    Bedroom,
    Bath,
    Study,
}

impl Use {
    pub fn name(self) -> &'static str {
        match self {
            Self::Living => "living room",
            Self::Kitchen => "kitchen",
            Self::Bedroom => "bedroom",
            Self::Bath => "bathroom",
            Self::Study => "study",
        }
    }
}

/// A room to be furnished. Its node stands on its floor's middle, the windows' wall towards +Z.
pub(super) struct Room {
    pub node: EntityKey,
    pub what: Use,
    /// Where the hall lies: 1 towards +X, -1 towards -X.
    pub hall: f64,
    pub style: Style,
    /// Whether there are windows before it, and in the wall opposite the hall's.
    pub windows: [bool; 2],
}

/// Half a room's width and depth.
const X: f64 = ROOM_HALF[0];
const Z: f64 = ROOM_HALF[1];
const CEILING: f64 = STOREY - FLOOR;

/// Puts everything in.
pub(super) fn furnish(kit: &mut Kit, room: &Room, chance: &mut Chance) -> Result<(), SceneError> {
    let mut set = Set { kit, room };
    if room.windows[0] {
        set.put(&fitting::RADIATOR, [0.0, 0.0, Z], 180.0)?;
    }
    match room.what {
        Use::Living => living(&mut set, chance)?,
        Use::Kitchen => cooking(&mut set, chance)?,
        Use::Bedroom => sleeping(&mut set, chance)?,
        Use::Bath => bathing(&mut set)?,
        Use::Study => working(&mut set, chance)?,
    }
    let Room { windows, style, .. } = *room;
    let hanging = match chance.pick(10) {
        0..=2 => Some(Hanging::Closed),
        3 | 4 => Some(Hanging::Blinds),
        5 | 6 => Some(Hanging::Aside),
        _ => None,
    };
    let Some(hanging) = hanging else {
        return Ok(());
    };
    let look = match (hanging, chance.pick(3)) {
        (Hanging::Blinds, _) => Look::White,
        (_, 0) => Look::Red,
        (_, 1) => Look::Blue,
        _ => Look::Cream,
    };
    let name = format!("{hanging:?}, {}", style.name());
    let [before, beside] = windows;
    let places = [
        (before, turned(0.0, 0.0, Z, 0.0)),
        (beside, turned(-room.hall * X, 0.0, 0.0, -90.0 * room.hall)),
    ];
    for (there, place) in places {
        if there {
            let make = || hangings(style, hanging);
            set.kit.make(room.node, &name, look, place, make)?;
        }
    }
    Ok(())
}

/// Places things in a room as if its hall were towards +X.
struct Set<'a> {
    kit: &'a mut Kit,
    room: &'a Room,
}

impl Set<'_> {
    fn put(&mut self, piece: &Piece, place: [f64; 3], degrees: f64) -> Result<(), SceneError> {
        self.put_as(piece, piece.look, place, degrees)
    }

    fn put_as(
        &mut self,
        piece: &Piece,
        look: Look,
        [x, y, z]: [f64; 3],
        degrees: f64,
    ) -> Result<(), SceneError> {
        let side = self.room.hall;
        let place = turned(side * x, y, z, side * degrees);
        self.kit.put_as(self.room.node, piece, look, place)
    }

    /// A bookcase full of books with its back to the wall opposite the windows.
    fn bookcase(&mut self, x: f64, chance: &mut Chance) -> Result<(), SceneError> {
        let place = [x, 0.0, -Z + 0.02];
        let books = [&shelf::BOOKS, &shelf::OTHER_BOOKS][chance.pick(2)];
        let look = [Look::Red, Look::Blue, Look::Ochre, Look::Cream][chance.pick(4)];
        self.put(&shelf::BOOKCASE, place, 0.0)?;
        self.put_as(books, look, place, 0.0)
    }
}

/// A cloth's colour.
fn cloth(chance: &mut Chance) -> Look {
    [Look::Red, Look::Blue, Look::Cream, Look::Green][chance.pick(4)]
}

fn living(set: &mut Set, chance: &mut Chance) -> Result<(), SceneError> {
    let look = cloth(chance);
    set.put_as(&fitting::CARPET, cloth(chance), [-0.6, 0.0, -0.3], 90.0)?;
    set.put_as(&seat::SOFA, look, [-X + 0.5, 0.0, -0.3], 90.0)?;
    set.put(&table::COFFEE_TABLE, [-0.9, 0.0, -0.3], 90.0)?;
    let turn = chance.between(150.0, 200.0);
    set.put_as(&seat::ARMCHAIR, look, [-0.9, 0.0, 1.3], turn)?;
    set.put(&fitting::TELEVISION, [X - 0.25, 0.0, -0.3], -90.0)?;
    set.bookcase(-0.9, chance)?;
    set.put(&lamp::FLOOR_LAMP, [-X + 0.4, 0.0, 1.3], 0.0)?;
    set.put(
        &fitting::POT_PLANT,
        [X - 0.45, 0.0, -Z + 0.5],
        chance.between(0.0, 360.0),
    )
}

fn cooking(set: &mut Set, chance: &mut Chance) -> Result<(), SceneError> {
    set.put(&kitchen::COUNTER, [-X, 0.0, -0.9], 90.0)?;
    set.put(&kitchen::STOVE, [-X, 0.0, 0.62], 90.0)?;
    set.put(&kitchen::POTS, [-X, 0.0, 0.62], 90.0)?;
    set.put(&kitchen::FRIDGE, [-2.2, 0.0, -Z + 0.02], 0.0)?;
    let [x, z] = [0.9, -0.4];
    set.put(&table::DINING_TABLE, [x, 0.0, z], 90.0)?;
    let mut chair = |dx: f64, dz: f64, degrees: f64| {
        let (shift, turn) = (chance.between(-0.05, 0.05), chance.between(-12.0, 12.0));
        set.put(
            &seat::CHAIR,
            [x + dx + shift, 0.0, z + dz - shift],
            degrees + turn,
        )
    };
    chair(-0.6, -0.3, 90.0)?;
    chair(-0.6, 0.35, 90.0)?;
    chair(0.62, 0.0, -90.0)?;
    set.put(&lamp::PENDANT, [x, CEILING, z], 0.0)
}

fn sleeping(set: &mut Set, chance: &mut Chance) -> Result<(), SceneError> {
    let head = [-X + 0.02, 0.0, -0.6];
    set.put(&bed::DOUBLE_BED, head, 90.0)?;
    set.put_as(&bed::DOUBLE_BEDDING, sheet(chance), head, 90.0)?;
    set.put(&bed::NIGHTSTAND, [-X + 0.02, 0.0, 0.55], 90.0)?;
    set.put(&bed::WARDROBE, [0.3, 0.0, -Z + 0.02], 0.0)?;
    set.put(&bed::DRESSER, [X - 0.02, 0.0, -0.6], -90.0)
}

fn sheet(chance: &mut Chance) -> Look {
    [Look::White, Look::Blue, Look::Cream][chance.pick(3)]
}

fn bathing(set: &mut Set) -> Result<(), SceneError> {
    set.put(&bath::TUB, [-1.5, 0.0, -Z + 0.02], 0.0)?;
    let basin = [X - 0.01, 0.0, -0.6];
    set.put(&bath::BASIN, basin, -90.0)?;
    set.put(&bath::MIRROR, [X - 0.001, 0.0, -0.6], -90.0)?;
    set.put(&bath::TOILET, [-X + 0.01, 0.0, 0.5], 90.0)?;
    set.put(&bath::WASHER, [X - 0.02, 0.0, -2.2], -90.0)
}

fn working(set: &mut Set, chance: &mut Chance) -> Result<(), SceneError> {
    set.put(&table::DESK, [-X + 0.4, 0.0, 0.4], 90.0)?;
    let turn = chance.between(-140.0, -40.0);
    set.put(&seat::SWIVEL_CHAIR, [-X + 1.15, 0.0, 0.4], turn)?;
    set.bookcase(-1.6, chance)?;
    let head = [X - 0.55, 0.0, -Z + 0.02];
    set.put(&bed::SINGLE_BED, head, 0.0)?;
    set.put_as(&bed::SINGLE_BEDDING, sheet(chance), head, 0.0)
}
