//! Blocks: sixteen lots around a courtyard, most with a house, some with a garden; some blocks are parks.

use super::green::{CROWNS, HEDGE, TRUNK};
use super::house::{self, House};
use super::kit::{Kit, at, quarter_turn, turned};
use super::look::Look;
use super::outdoor::{BENCH, BIN, FOUNTAIN, STREET_LAMP};
use super::plan::{BLOCK, BlockPlace, GROUND_FLOOR, LOT, PAVEMENT, Plan};
use super::window::Style;
use crate::chance::Chance;
use crate::solid::Solid;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;

/// What has been dealt out to lots: of every kind as many under every seed.
pub(super) struct Lots {
    parks: Vec<bool>,
    /// Three a side, and one at each corner.
    middles: Vec<Option<House>>,
    corners: Vec<Option<House>>,
    houses: usize,
}

/// Lots between two corners, and their shares of what houses are like.
const MIDDLES: usize = 3;
const STOREYS: [usize; 6] = [2, 2, 3, 2, 4, 2];
const STYLES: [Style; 5] = [
    Style::Paired,
    Style::Wide,
    Style::French,
    Style::Paired,
    Style::French,
];
const WALLS: [Look; 4] = [Look::Cream, Look::Brick, Look::Ochre, Look::Cream];
/// Of how many lots one is a garden, of how many roofs one is flat, of how many doors one is open, of how many blocks one is a park.
const GARDENS: usize = 20;
const FLAT: usize = 4;
const OPEN: usize = 3;
const PARKS: usize = 13;

impl Lots {
    pub fn dealt(plan: &Plan, blocks: &mut Chance, houses: &mut Chance) -> Self {
        let [count, _] = plan.counts();
        let parks = count / PARKS;
        let mut deck: Vec<bool> = (0..count).map(|i| i < parks).collect();
        blocks.shuffle(&mut deck);
        let sides = 4 * (count - parks);
        Self {
            parks: deck,
            middles: deal(sides * MIDDLES, false, houses),
            corners: deal(sides, true, houses),
            houses: 0,
        }
    }
}

fn deal(count: usize, corner: bool, chance: &mut Chance) -> Vec<Option<House>> {
    let mut one_of = |of: usize| -> Vec<bool> {
        let mut deck: Vec<bool> = (0..count).map(|i| i % of == of / 2).collect();
        chance.shuffle(&mut deck);
        deck
    };
    let (gardens, flat, open) = (one_of(GARDENS), one_of(FLAT), one_of(OPEN));
    let walls = chance.dealt(count, &WALLS);
    // Dealt to houses alone, so that gardens take none away.
    let built = gardens.iter().filter(|garden| corner || !**garden).count();
    let pairs: Vec<(usize, Style)> = (0..STOREYS.len() * STYLES.len())
        .map(|i| (STOREYS[i % STOREYS.len()], STYLES[i / STOREYS.len()]))
        .collect();
    let mut dealt = chance.dealt(built, &pairs);
    (0..count)
        .map(|i| {
            if gardens[i] && !corner {
                return None;
            }
            let (storeys, style) = dealt.pop()?;
            Some(House {
                corner,
                storeys,
                style,
                walls: walls[i],
                flat: flat[i],
                open: open[i],
            })
        })
        .collect()
}

/// Adds a block with all that stands on it.
pub(super) fn add(
    kit: &mut Kit,
    quarter: EntityKey,
    place: &BlockPlace,
    lots: &mut Lots,
    rooms: &mut Chance,
    gardens: &mut Chance,
) -> Result<(), SceneError> {
    let number = place.number + 1;
    if lots.parks.get(place.number).copied().unwrap_or(false) {
        let node = kit.node(quarter, &format!("park, block {number}"), place.at)?;
        return park(kit, node, gardens);
    }
    let node = kit.node(quarter, &format!("block {number}"), place.at)?;
    for side in 0..4 {
        for along in 0..=MIDDLES {
            let corner = along == MIDDLES;
            let x = 2.0 * LOT * (along as f64 - 1.0);
            let place = quarter_turn(side) * at(x, 0.0, BLOCK - LOT);
            let name = format!("lot {}", side as usize * (MIDDLES + 1) + along + 1);
            let lot = kit.node(node, &name, place)?;
            let deck = if corner {
                &mut lots.corners
            } else {
                &mut lots.middles
            };
            match deck.pop().flatten() {
                Some(house) => {
                    lots.houses += 1;
                    let name = format!("house {}", lots.houses);
                    let node = kit.node(lot, &name, at(0.0, GROUND_FLOOR, 0.0))?;
                    house::add(kit, node, &house, rooms)?;
                }
                None => garden(kit, lot, gardens)?,
            }
        }
    }
    let court = kit.node(node, "courtyard", DAffine3::IDENTITY)?;
    courtyard(kit, court, gardens)
}

/// Adds a tree; its crown is turned by chance.
pub(super) fn tree(
    kit: &mut Kit,
    parent: EntityKey,
    place: DAffine3,
    chance: &mut Chance,
) -> Result<(), SceneError> {
    let place = place * turned(0.0, 0.0, 0.0, chance.between(0.0, 360.0));
    let tree = kit.node(parent, "tree", place)?;
    kit.put(tree, &TRUNK, DAffine3::IDENTITY)?;
    kit.put(tree, &CROWNS[chance.pick(3)], DAffine3::IDENTITY)
}

fn slab(half: f64, top: f64) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-half, -0.3, -half], [half, top, half]);
    solid
}

fn courtyard(kit: &mut Kit, node: EntityKey, chance: &mut Chance) -> Result<(), SceneError> {
    let half = BLOCK - 2.0 * LOT;
    kit.make(node, "lawn", Look::Green, DAffine3::IDENTITY, || {
        slab(half, PAVEMENT)
    })?;
    for quarters in 0..4 {
        let (x, z) = (chance.between(-11.0, 3.0), chance.between(7.0, 13.0));
        let turn = quarter_turn(quarters);
        tree(kit, node, turn * at(x, PAVEMENT, z), chance)?;
        kit.put(node, &BENCH, turn * at(x + 3.5, PAVEMENT, z))?;
        for hedge in 0..3 {
            let x = 2.0 * f64::from(hedge) - 17.0;
            kit.put(node, &HEDGE, turn * at(x, PAVEMENT, 17.5))?;
        }
    }
    Ok(())
}

/// Open towards the street over its hedge.
fn garden(kit: &mut Kit, node: EntityKey, chance: &mut Chance) -> Result<(), SceneError> {
    kit.make(node, "garden lawn", Look::Green, DAffine3::IDENTITY, || {
        slab(LOT - 0.005, PAVEMENT)
    })?;
    for hedge in 0..6 {
        if hedge != 3 {
            let x = 2.0 * f64::from(hedge) - 5.5;
            kit.put(node, &HEDGE, at(x, PAVEMENT, LOT - 0.5))?;
        }
    }
    for x in [-3.5, 3.5] {
        let place = at(x, PAVEMENT, chance.between(-3.5, 3.0));
        tree(kit, node, place, chance)?;
    }
    kit.put(node, &BENCH, at(0.5, PAVEMENT, -5.0))
}

fn park(kit: &mut Kit, node: EntityKey, chance: &mut Chance) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    kit.make(node, "park lawn", Look::Green, here, || {
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
    kit.make(node, "park paths", Look::Stone, here, paths)?;
    kit.put(node, &FOUNTAIN, at(0.0, PAVEMENT, 0.0))?;
    for quarters in 0..4 {
        let turn = quarter_turn(quarters);
        let grove = kit.node(node, "grove", turn)?;
        for i in 0..9 {
            let (row, column) = (f64::from(i / 3), f64::from(i % 3));
            let mut off = || chance.between(-2.5, 2.5);
            let place = at(
                7.5 + 10.0 * row + off(),
                PAVEMENT - 0.03,
                7.5 + 10.0 * column + off(),
            );
            tree(kit, grove, place, chance)?;
        }
        for i in 0..3 {
            let along = 8.0 + 10.0 * f64::from(i);
            let place = turned(along, PAVEMENT, 1.2, 180.0);
            kit.put(node, &BENCH, turn * place)?;
        }
        kit.put(node, &STREET_LAMP, turn * turned(5.5, PAVEMENT, -1.25, 0.0))?;
        kit.put(node, &BIN, turn * at(6.5, PAVEMENT, 1.2))?;
        for hedge in 0..14 {
            let x = 2.0 * f64::from(hedge) + 5.0;
            kit.put(grove, &HEDGE, at(x, PAVEMENT - 0.03, BLOCK - 0.6))?;
        }
    }
    Ok(())
}
