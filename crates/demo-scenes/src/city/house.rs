//! Houses: storeys of four rooms around a hall with stairs, under a roof.

use super::facade::{Face, door, party_walls, wall};
use super::furnish::{Room, Use, furnish};
use super::kit::{Kit, at, quarter_turn};
use super::look::Look;
use super::plan::{ROOM, STOREY};
use super::window::{Style, frames};
use super::{roof, storey};
use crate::chance::Chance;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;

/// What a house is like. It faces +Z, and from a corner +X as well.
#[derive(Clone, Copy)]
pub(super) struct House {
    pub corner: bool,
    pub storeys: usize,
    pub style: Style,
    pub walls: Look,
    pub flat: bool,
    /// Whether its door stands open.
    pub open: bool,
}

/// Adds a house to its lot.
pub(super) fn add(
    kit: &mut Kit,
    node: EntityKey,
    house: &House,
    chance: &mut Chance,
) -> Result<(), SceneError> {
    for number in 0..house.storeys {
        let name = format!("storey {}", number + 1);
        let place = at(0.0, STOREY * number as f64, 0.0);
        let storey = kit.node(node, &name, place)?;
        walls(kit, storey, house, number)?;
        within(kit, storey, house, number)?;
        rooms(kit, storey, house, number, chance)?;
    }
    let top = kit.node(node, "roof", at(0.0, STOREY * house.storeys as f64, 0.0))?;
    over(kit, top, house, chance)
}

/// A house's windows: none reaches down to the floor on the ground.
fn style(house: &House, number: usize) -> Style {
    match (house.style, number) {
        (Style::French, 0) => Style::Paired,
        (style, _) => style,
    }
}

/// What a storey has towards its sides: the face, and the turn that takes +Z there.
fn faces(house: &House, number: usize) -> [(Face, i32); 2] {
    let front = if number == 0 { Face::Door } else { Face::Hall };
    if house.corner {
        [(front, 0), (Face::Side, 1)]
    } else {
        [(front, 0), (Face::Hall, 2)]
    }
}

fn walls(kit: &mut Kit, node: EntityKey, house: &House, number: usize) -> Result<(), SceneError> {
    let style = style(house, number);
    for (face, turn) in faces(house, number) {
        let (what, turn) = (
            format!("{}, {}", face.name(), style.name()),
            quarter_turn(turn),
        );
        kit.make(node, &format!("wall {what}"), house.walls, turn, || {
            wall(face, style)
        })?;
        kit.make(node, &format!("windows {what}"), Look::White, turn, || {
            frames(&face.windows(style))
        })?;
    }
    let name = if house.corner {
        "party walls of a corner"
    } else {
        "party walls"
    };
    kit.make(node, name, house.walls, DAffine3::IDENTITY, || {
        party_walls(house.corner)
    })
}

fn within(kit: &mut Kit, node: EntityKey, house: &House, number: usize) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    if number == 0 {
        kit.put(node, &storey::GROUND, here)?;
        let (name, degrees) = if house.open {
            ("open house door", 84.0)
        } else {
            ("house door", 0.0)
        };
        kit.make(node, name, Look::Wood, here, || door(degrees))?;
    } else {
        kit.put(node, &storey::UPPER, here)?;
        kit.put(node, &storey::BALUSTRADE, here)?;
    }
    kit.put(node, &storey::PARTITIONS, here)?;
    kit.put(node, &storey::DOORS, here)?;
    if number + 1 < house.storeys {
        kit.put(node, &storey::STAIRS, here)?;
    }
    Ok(())
}

/// What the rooms of a storey are for, ground floors and each second one above alike.
const USES: [[Use; 4]; 2] = [
    [Use::Living, Use::Kitchen, Use::Bedroom, Use::Bath],
    [Use::Bath, Use::Study, Use::Bedroom, Use::Study],
];

fn rooms(
    kit: &mut Kit,
    node: EntityKey,
    house: &House,
    number: usize,
    chance: &mut Chance,
) -> Result<(), SceneError> {
    let mut uses = USES[number % 2];
    chance.shuffle(&mut uses);
    // Left and right, before and behind: the last one of a house at a corner has no window.
    if house.corner
        && let Some(bath) = uses.iter().position(|what| *what == Use::Bath)
    {
        uses.swap(bath, 3);
    }
    let places = [(1.0, false), (-1.0, false), (1.0, true), (-1.0, true)];
    for (what, (hall, behind)) in uses.into_iter().zip(places) {
        let turn = quarter_turn(if behind { 2 } else { 0 });
        let place = turn * at(-hall * ROOM[0], 0.0, ROOM[1]);
        let right = (hall < 0.0) != behind;
        let room = Room {
            node: kit.node(node, what.name(), place)?,
            what,
            hall,
            style: style(house, number),
            windows: [!(house.corner && behind), house.corner && right],
        };
        furnish(kit, &room, chance)?;
    }
    Ok(())
}

fn over(
    kit: &mut Kit,
    node: EntityKey,
    house: &House,
    chance: &mut Chance,
) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    if house.flat {
        kit.put(node, &roof::FLAT, here)?;
        let z = chance.between(-1.0, 5.0);
        return kit.put(node, &roof::ROOF_UNIT, at(0.0, 0.1, z));
    }
    if house.corner {
        kit.put(node, &roof::HIP, here)?;
        return kit.put(node, &roof::CHIMNEY, at(-3.0, 2.2, -1.5));
    }
    kit.put(node, &roof::GABLE, here)?;
    let x = [-5.0, 0.0, 5.0][chance.pick(3)];
    let z = chance.between(0.8, 1.6);
    kit.put(node, &roof::CHIMNEY, at(x, roof::slope(z), -z))?;
    let eaves = 5.4;
    for x in [-3.2, 3.2] {
        kit.put(node, &roof::DORMER, at(x, roof::slope(eaves), eaves))?;
    }
    Ok(())
}
