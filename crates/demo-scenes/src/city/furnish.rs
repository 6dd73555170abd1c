//! Furniture of the rooms, by the use of the room.

use super::city_builder::{CityBuilder, Prefab, rotated_at};
use super::furniture::{bath, bed, fitting, kitchen, lamp, seat, shelf, table};
use super::materials::MaterialKind;
use super::plan::{FLOOR, ROOM_HALF, STOREY};
use super::window::{Hanging, Style, hangings};
use crate::random::Random;
use antumbra_scene::{EntityKey, SceneError};

/// The use of a room.
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

/// A room. Its node is at the centre of its floor; the wall with windows is towards +Z.
pub(super) struct Room {
    pub node: EntityKey,
    pub what: Use,
    /// Direction of the hall: 1 is +X, -1 is -X.
    pub hall: f64,
    pub style: Style,
    pub windows: RoomWindows,
}

/// The outer walls of a room that have windows.
#[derive(Clone, Copy)]
pub(super) struct RoomWindows {
    /// The wall towards +Z.
    pub front: bool,
    /// The wall opposite the hall.
    pub side: bool,
}

/// Half the width and half the depth of a room.
const X: f64 = ROOM_HALF[0];
const Z: f64 = ROOM_HALF[1];
const CEILING: f64 = STOREY - FLOOR;

/// Furnishes a room.
pub(super) fn furnish(
    city: &mut CityBuilder,
    room: &Room,
    random: &mut Random,
) -> Result<(), SceneError> {
    let mut set = Set { city, room };
    if room.windows.front {
        set.put(&fitting::RADIATOR, [0.0, 0.0, Z], 180.0)?;
    }
    match room.what {
        Use::Living => living(&mut set, random)?,
        Use::Kitchen => cooking(&mut set, random)?,
        Use::Bedroom => sleeping(&mut set, random)?,
        Use::Bath => bathing(&mut set)?,
        Use::Study => working(&mut set, random)?,
    }
    let Room { windows, style, .. } = *room;
    let hanging = match random.pick(10) {
        0..=2 => Some(Hanging::Closed),
        3 | 4 => Some(Hanging::Blinds),
        5 | 6 => Some(Hanging::Aside),
        _ => None,
    };
    let Some(hanging) = hanging else {
        return Ok(());
    };
    let material = match (hanging, random.pick(3)) {
        (Hanging::Blinds, _) => MaterialKind::White,
        (_, 0) => MaterialKind::Red,
        (_, 1) => MaterialKind::Blue,
        _ => MaterialKind::Cream,
    };
    let name = format!("{hanging:?}, {}", style.name());
    let places = [
        (windows.front, rotated_at(0.0, 0.0, Z, 0.0)),
        (
            windows.side,
            rotated_at(-room.hall * X, 0.0, 0.0, -90.0 * room.hall),
        ),
    ];
    for (there, place) in places {
        if there {
            let make = || hangings(style, hanging);
            set.city.make(room.node, &name, material, place, make)?;
        }
    }
    Ok(())
}

/// Places prefabs in a room as if its hall were towards +X.
struct Set<'a> {
    city: &'a mut CityBuilder,
    room: &'a Room,
}

impl Set<'_> {
    fn put(&mut self, prefab: &Prefab, place: [f64; 3], degrees: f64) -> Result<(), SceneError> {
        self.place_with_material(prefab, prefab.material, place, degrees)
    }

    fn place_with_material(
        &mut self,
        prefab: &Prefab,
        material: MaterialKind,
        [x, y, z]: [f64; 3],
        degrees: f64,
    ) -> Result<(), SceneError> {
        let side = self.room.hall;
        let place = rotated_at(side * x, y, z, side * degrees);
        self.city
            .place_with_material(self.room.node, prefab, material, place)
    }

    /// A bookcase full of books, its back to the wall opposite the windows.
    fn bookcase(&mut self, x: f64, random: &mut Random) -> Result<(), SceneError> {
        let place = [x, 0.0, -Z + 0.02];
        let books = [&shelf::BOOKS, &shelf::OTHER_BOOKS][random.pick(2)];
        let material = [
            MaterialKind::Red,
            MaterialKind::Blue,
            MaterialKind::Ochre,
            MaterialKind::Cream,
        ][random.pick(4)];
        self.put(&shelf::BOOKCASE, place, 0.0)?;
        self.place_with_material(books, material, place, 0.0)
    }
}

/// A random colour of cloth.
fn cloth(random: &mut Random) -> MaterialKind {
    [
        MaterialKind::Red,
        MaterialKind::Blue,
        MaterialKind::Cream,
        MaterialKind::Green,
    ][random.pick(4)]
}

fn living(set: &mut Set, random: &mut Random) -> Result<(), SceneError> {
    let material = cloth(random);
    set.place_with_material(&fitting::CARPET, cloth(random), [-0.6, 0.0, -0.3], 90.0)?;
    set.place_with_material(&seat::SOFA, material, [-X + 0.5, 0.0, -0.3], 90.0)?;
    set.put(&table::COFFEE_TABLE, [-0.9, 0.0, -0.3], 90.0)?;
    let turn = random.between(150.0, 200.0);
    set.place_with_material(&seat::ARMCHAIR, material, [-0.9, 0.0, 1.3], turn)?;
    set.put(&fitting::TELEVISION, [X - 0.25, 0.0, -0.3], -90.0)?;
    set.bookcase(-0.9, random)?;
    set.put(&lamp::FLOOR_LAMP, [-X + 0.4, 0.0, 1.3], 0.0)?;
    set.put(
        &fitting::POT_PLANT,
        [X - 0.45, 0.0, -Z + 0.5],
        random.between(0.0, 360.0),
    )
}

fn cooking(set: &mut Set, random: &mut Random) -> Result<(), SceneError> {
    set.put(&kitchen::COUNTER, [-X, 0.0, -0.9], 90.0)?;
    set.put(&kitchen::STOVE, [-X, 0.0, 0.62], 90.0)?;
    set.put(&kitchen::POTS, [-X, 0.0, 0.62], 90.0)?;
    set.put(&kitchen::FRIDGE, [-2.2, 0.0, -Z + 0.02], 0.0)?;
    let [x, z] = [0.9, -0.4];
    set.put(&table::DINING_TABLE, [x, 0.0, z], 90.0)?;
    let mut chair = |dx: f64, dz: f64, degrees: f64| {
        let (shift, turn) = (random.between(-0.05, 0.05), random.between(-12.0, 12.0));
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

fn sleeping(set: &mut Set, random: &mut Random) -> Result<(), SceneError> {
    let head = [-X + 0.02, 0.0, -0.6];
    set.put(&bed::DOUBLE_BED, head, 90.0)?;
    set.place_with_material(&bed::DOUBLE_BEDDING, sheet(random), head, 90.0)?;
    set.put(&bed::NIGHTSTAND, [-X + 0.02, 0.0, 0.55], 90.0)?;
    set.put(&bed::WARDROBE, [0.3, 0.0, -Z + 0.02], 0.0)?;
    set.put(&bed::DRESSER, [X - 0.02, 0.0, -0.6], -90.0)
}

fn sheet(random: &mut Random) -> MaterialKind {
    [MaterialKind::White, MaterialKind::Blue, MaterialKind::Cream][random.pick(3)]
}

fn bathing(set: &mut Set) -> Result<(), SceneError> {
    set.put(&bath::TUB, [-1.5, 0.0, -Z + 0.02], 0.0)?;
    let basin = [X - 0.01, 0.0, -0.6];
    set.put(&bath::BASIN, basin, -90.0)?;
    set.put(&bath::MIRROR, [X - 0.001, 0.0, -0.6], -90.0)?;
    set.put(&bath::TOILET, [-X + 0.01, 0.0, 0.5], 90.0)?;
    set.put(&bath::WASHER, [X - 0.02, 0.0, -2.2], -90.0)
}

fn working(set: &mut Set, random: &mut Random) -> Result<(), SceneError> {
    set.put(&table::DESK, [-X + 0.4, 0.0, 0.4], 90.0)?;
    let turn = random.between(-140.0, -40.0);
    set.put(&seat::SWIVEL_CHAIR, [-X + 1.15, 0.0, 0.4], turn)?;
    set.bookcase(-1.6, random)?;
    let head = [X - 0.55, 0.0, -Z + 0.02];
    set.put(&bed::SINGLE_BED, head, 0.0)?;
    set.place_with_material(&bed::SINGLE_BEDDING, sheet(random), head, 0.0)
}
