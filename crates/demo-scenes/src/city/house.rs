//! Houses: storeys of four rooms around a hall with stairs, under a roof.

use super::city_builder::{CityBuilder, at, quarter_rotation};
use super::facade::{Face, door, party_walls, wall};
use super::furnish::{Room, RoomWindows, Use, furnish};
use super::materials::MaterialKind;
use super::plan::{LotPosition, ROOM, STOREY};
use super::window::{Style, frames};
use super::{roof, storey};
use crate::random::Random;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;

/// The roof of a house.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum RoofKind {
    Flat,
    /// A gable roof; a hip roof on a corner.
    Pitched,
}

/// The state of a house's door.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DoorState {
    Closed,
    Open,
}

/// The properties of a house. It faces +Z; on a corner also +X.
#[derive(Clone, Copy)]
pub(super) struct House {
    pub position: LotPosition,
    pub storeys: usize,
    pub style: Style,
    pub walls: MaterialKind,
    pub roof: RoofKind,
    pub door: DoorState,
}

/// Adds a house to its lot.
pub(super) fn add(
    city: &mut CityBuilder,
    node: EntityKey,
    house: &House,
    random: &mut Random,
) -> Result<(), SceneError> {
    for number in 0..house.storeys {
        let name = format!("storey {}", number + 1);
        let place = at(0.0, STOREY * number as f64, 0.0);
        let storey = city.node(node, &name, place)?;
        walls(city, storey, house, number)?;
        within(city, storey, house, number)?;
        rooms(city, storey, house, number, random)?;
    }
    let top = city.node(node, "roof", at(0.0, STOREY * house.storeys as f64, 0.0))?;
    over(city, top, house, random)
}

/// The window style of a storey: on the ground floor no window reaches the floor.
fn style(house: &House, number: usize) -> Style {
    match (house.style, number) {
        (Style::French, 0) => Style::Paired,
        (style, _) => style,
    }
}

/// The outer walls of a storey with windows: kind, and the quarters that rotate +Z to it.
fn faces(house: &House, number: usize) -> [(Face, i32); 2] {
    let front = if number == 0 { Face::Door } else { Face::Hall };
    if house.position == LotPosition::Corner {
        [(front, 0), (Face::Side, 1)]
    } else {
        [(front, 0), (Face::Hall, 2)]
    }
}

fn walls(
    city: &mut CityBuilder,
    node: EntityKey,
    house: &House,
    number: usize,
) -> Result<(), SceneError> {
    let style = style(house, number);
    for (face, turn) in faces(house, number) {
        let (what, turn) = (
            format!("{}, {}", face.name(), style.name()),
            quarter_rotation(turn),
        );
        city.make(node, &format!("wall {what}"), house.walls, turn, || {
            wall(face, style)
        })?;
        city.make(
            node,
            &format!("windows {what}"),
            MaterialKind::White,
            turn,
            || frames(&face.windows(style)),
        )?;
    }
    let name = if house.position == LotPosition::Corner {
        "party walls of a corner"
    } else {
        "party walls"
    };
    city.make(node, name, house.walls, DAffine3::IDENTITY, || {
        party_walls(house.position)
    })
}

fn within(
    city: &mut CityBuilder,
    node: EntityKey,
    house: &House,
    number: usize,
) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    if number == 0 {
        city.put(node, &storey::GROUND, here)?;
        let (name, degrees) = if house.door == DoorState::Open {
            ("open house door", 84.0)
        } else {
            ("house door", 0.0)
        };
        city.make(node, name, MaterialKind::Wood, here, || door(degrees))?;
    } else {
        city.put(node, &storey::UPPER, here)?;
        city.put(node, &storey::BALUSTRADE, here)?;
    }
    city.put(node, &storey::PARTITIONS, here)?;
    city.put(node, &storey::DOORS, here)?;
    if number + 1 < house.storeys {
        city.put(node, &storey::STAIRS, here)?;
    }
    Ok(())
}

/// Uses of the rooms on even storeys (the ground floor is 0) and on odd storeys.
const USES: [[Use; 4]; 2] = [
    [Use::Living, Use::Kitchen, Use::Bedroom, Use::Bath],
    [Use::Bath, Use::Study, Use::Bedroom, Use::Study],
];

fn rooms(
    city: &mut CityBuilder,
    node: EntityKey,
    house: &House,
    number: usize,
    random: &mut Random,
) -> Result<(), SceneError> {
    let mut uses = USES[number % 2];
    random.shuffle(&mut uses);
    // Rooms: front left, front right, rear left, rear right. On a corner the last one has no window.
    if house.position == LotPosition::Corner
        && let Some(bath) = uses.iter().position(|what| *what == Use::Bath)
    {
        uses.swap(bath, 3);
    }
    let corner = house.position == LotPosition::Corner;
    let places = [(1.0, false), (-1.0, false), (1.0, true), (-1.0, true)];
    for (what, (hall, behind)) in uses.into_iter().zip(places) {
        let turn = quarter_rotation(if behind { 2 } else { 0 });
        let place = turn * at(-hall * ROOM[0], 0.0, ROOM[1]);
        let right = (hall < 0.0) != behind;
        let room = Room {
            node: city.node(node, what.name(), place)?,
            what,
            hall,
            style: style(house, number),
            windows: RoomWindows {
                front: !(corner && behind),
                side: corner && right,
            },
        };
        furnish(city, &room, random)?;
    }
    Ok(())
}

fn over(
    city: &mut CityBuilder,
    node: EntityKey,
    house: &House,
    random: &mut Random,
) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    if house.roof == RoofKind::Flat {
        city.put(node, &roof::FLAT, here)?;
        let z = random.between(-1.0, 5.0);
        return city.put(node, &roof::ROOF_UNIT, at(0.0, 0.1, z));
    }
    if house.position == LotPosition::Corner {
        city.put(node, &roof::HIP, here)?;
        return city.put(node, &roof::CHIMNEY, at(-3.0, 2.2, -1.5));
    }
    city.put(node, &roof::GABLE, here)?;
    let x = [-5.0, 0.0, 5.0][random.pick(3)];
    let z = random.between(0.8, 1.6);
    city.put(node, &roof::CHIMNEY, at(x, roof::slope(z), -z))?;
    let eaves = 5.4;
    for x in [-3.2, 3.2] {
        city.put(node, &roof::DORMER, at(x, roof::slope(eaves), eaves))?;
    }
    Ok(())
}
