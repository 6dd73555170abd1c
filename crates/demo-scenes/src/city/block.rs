//! Blocks: sixteen lots around a courtyard, most with a house, some with a garden. Some blocks are parks.

use super::city_builder::{CityBuilder, at, quarter_rotation, rotated_at};
use super::house::{self, DoorState, House, RoofKind};
use super::materials::MaterialKind;
use super::plan::{BLOCK, BlockPlace, GROUND_FLOOR, LOT, LotPosition, PAVEMENT, Plan};
use super::street_furniture::{BENCH, BIN, FOUNTAIN, STREET_LAMP};
use super::vegetation::{HEDGE, tree};
use super::window::Style;
use crate::random::Random;
use crate::solid::Solid;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;

/// The contents of all lots, in random order. Every seed gives the same number of each kind.
pub(super) struct Lots {
    parks: Vec<bool>,
    /// Lots between two corners: three per side.
    middles: Vec<Option<House>>,
    corners: Vec<Option<House>>,
    houses: usize,
}

/// Lots between two corners of a block, and the values that houses take.
const MIDDLES: usize = 3;
const STOREYS: [usize; 6] = [2, 2, 3, 2, 4, 2];
const STYLES: [Style; 5] = [
    Style::Paired,
    Style::Wide,
    Style::French,
    Style::Paired,
    Style::French,
];
const WALLS: [MaterialKind; 4] = [
    MaterialKind::Cream,
    MaterialKind::Brick,
    MaterialKind::Ochre,
    MaterialKind::Cream,
];
/// One lot in [`GARDENS`] is a garden, one roof in [`FLAT`] is flat, one door in [`OPEN`] is open, one block in
/// [`PARKS`] is a park.
const GARDENS: usize = 20;
const FLAT: usize = 4;
const OPEN: usize = 3;
const PARKS: usize = 13;

impl Lots {
    pub fn new(plan: &Plan, blocks: &mut Random, houses: &mut Random) -> Self {
        let [count, _] = plan.counts();
        let parks = count / PARKS;
        let mut deck: Vec<bool> = (0..count).map(|i| i < parks).collect();
        blocks.shuffle(&mut deck);
        let sides = 4 * (count - parks);
        Self {
            parks: deck,
            middles: shuffled_lots(sides * MIDDLES, LotPosition::Middle, houses),
            corners: shuffled_lots(sides, LotPosition::Corner, houses),
            houses: 0,
        }
    }
}

fn shuffled_lots(count: usize, position: LotPosition, random: &mut Random) -> Vec<Option<House>> {
    let corner = position == LotPosition::Corner;
    let mut one_of = |of: usize| -> Vec<bool> {
        let mut deck: Vec<bool> = (0..count).map(|i| i % of == of / 2).collect();
        random.shuffle(&mut deck);
        deck
    };
    let (gardens, flat, open) = (one_of(GARDENS), one_of(FLAT), one_of(OPEN));
    let walls = random.shuffled_deck(count, &WALLS);
    // Only houses take a value, so that gardens do not use any up.
    let built = gardens.iter().filter(|garden| corner || !**garden).count();
    let pairs: Vec<(usize, Style)> = (0..STOREYS.len() * STYLES.len())
        .map(|i| (STOREYS[i % STOREYS.len()], STYLES[i / STOREYS.len()]))
        .collect();
    let mut types = random.shuffled_deck(built, &pairs);
    (0..count)
        .map(|i| {
            if gardens[i] && !corner {
                return None;
            }
            let (storeys, style) = types.pop()?;
            Some(House {
                position,
                storeys,
                style,
                walls: walls[i],
                roof: if flat[i] {
                    RoofKind::Flat
                } else {
                    RoofKind::Pitched
                },
                door: if open[i] {
                    DoorState::Open
                } else {
                    DoorState::Closed
                },
            })
        })
        .collect()
}

/// Adds a block with all that stands on it.
pub(super) fn add(
    city: &mut CityBuilder,
    quarter: EntityKey,
    place: &BlockPlace,
    lots: &mut Lots,
    rooms: &mut Random,
    gardens: &mut Random,
) -> Result<(), SceneError> {
    let number = place.number + 1;
    if lots.parks.get(place.number).copied().unwrap_or(false) {
        let node = city.node(quarter, &format!("park, block {number}"), place.at)?;
        return park(city, node, gardens);
    }
    let node = city.node(quarter, &format!("block {number}"), place.at)?;
    for side in 0..4 {
        for along in 0..=MIDDLES {
            let corner = along == MIDDLES;
            let x = 2.0 * LOT * (along as f64 - 1.0);
            let place = quarter_rotation(side) * at(x, 0.0, BLOCK - LOT);
            let name = format!("lot {}", side as usize * (MIDDLES + 1) + along + 1);
            let lot = city.node(node, &name, place)?;
            let deck = if corner {
                &mut lots.corners
            } else {
                &mut lots.middles
            };
            match deck.pop().flatten() {
                Some(house) => {
                    lots.houses += 1;
                    let name = format!("house {}", lots.houses);
                    let node = city.node(lot, &name, at(0.0, GROUND_FLOOR, 0.0))?;
                    house::add(city, node, &house, rooms)?;
                }
                None => garden(city, lot, gardens)?,
            }
        }
    }
    let court = city.node(node, "courtyard", DAffine3::IDENTITY)?;
    courtyard(city, court, gardens)
}

fn slab(half: f64, top: f64) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-half, -0.3, -half], [half, top, half]);
    solid
}

fn courtyard(
    city: &mut CityBuilder,
    node: EntityKey,
    random: &mut Random,
) -> Result<(), SceneError> {
    let half = BLOCK - 2.0 * LOT;
    city.make(
        node,
        "lawn",
        MaterialKind::Green,
        DAffine3::IDENTITY,
        || slab(half, PAVEMENT),
    )?;
    for quarters in 0..4 {
        let (x, z) = (random.between(-11.0, 3.0), random.between(7.0, 13.0));
        let turn = quarter_rotation(quarters);
        tree(city, node, turn * at(x, PAVEMENT, z), random)?;
        city.put(node, &BENCH, turn * at(x + 3.5, PAVEMENT, z))?;
        for hedge in 0..3 {
            let x = 2.0 * f64::from(hedge) - 17.0;
            city.put(node, &HEDGE, turn * at(x, PAVEMENT, 17.5))?;
        }
    }
    Ok(())
}

/// A garden with a gap in its hedge towards the street.
fn garden(city: &mut CityBuilder, node: EntityKey, random: &mut Random) -> Result<(), SceneError> {
    city.make(
        node,
        "garden lawn",
        MaterialKind::Green,
        DAffine3::IDENTITY,
        || slab(LOT - 0.005, PAVEMENT),
    )?;
    for hedge in 0..6 {
        if hedge != 3 {
            let x = 2.0 * f64::from(hedge) - 5.5;
            city.put(node, &HEDGE, at(x, PAVEMENT, LOT - 0.5))?;
        }
    }
    for x in [-3.5, 3.5] {
        let place = at(x, PAVEMENT, random.between(-3.5, 3.0));
        tree(city, node, place, random)?;
    }
    city.put(node, &BENCH, at(0.5, PAVEMENT, -5.0))
}

fn park(city: &mut CityBuilder, node: EntityKey, random: &mut Random) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    city.make(node, "park lawn", MaterialKind::Green, here, || {
        slab(BLOCK - 0.005, PAVEMENT - 0.03)
    })?;
    let paths = || {
        let mut solid = Solid::default();
        let (half, low, high) = (BLOCK - 0.01, -0.2, PAVEMENT);
        solid.cuboid([-half, low, -1.5], [half, high, 1.5]);
        for (from, to) in [(-half, -1.5), (1.5, half)] {
            solid.cuboid([-1.5, low, from], [1.5, high, to]);
        }
        solid
    };
    city.make(node, "park paths", MaterialKind::Stone, here, paths)?;
    city.put(node, &FOUNTAIN, at(0.0, PAVEMENT, 0.0))?;
    for quarters in 0..4 {
        let turn = quarter_rotation(quarters);
        let grove = city.node(node, "grove", turn)?;
        for i in 0..9 {
            let (row, column) = (f64::from(i / 3), f64::from(i % 3));
            let mut off = || random.between(-2.5, 2.5);
            let place = at(
                7.5 + 10.0 * row + off(),
                PAVEMENT - 0.03,
                7.5 + 10.0 * column + off(),
            );
            tree(city, grove, place, random)?;
        }
        for i in 0..3 {
            let along = 8.0 + 10.0 * f64::from(i);
            let place = rotated_at(along, PAVEMENT, 1.2, 180.0);
            city.put(node, &BENCH, turn * place)?;
        }
        city.put(
            node,
            &STREET_LAMP,
            turn * rotated_at(5.5, PAVEMENT, -1.25, 0.0),
        )?;
        city.put(node, &BIN, turn * at(6.5, PAVEMENT, 1.2))?;
        for hedge in 0..14 {
            let x = 2.0 * f64::from(hedge) + 5.0;
            city.put(grove, &HEDGE, at(x, PAVEMENT - 0.03, BLOCK - 0.6))?;
        }
    }
    Ok(())
}
