//! Streets: roadways and pavements between crossings, what stands on them, and the vehicles.

use super::block::tree;
use super::kit::{Kit, Piece, at, quarter_turn, turned};
use super::look::Look;
use super::outdoor::{BENCH, BIN, HYDRANT, STREET_LAMP, TRAFFIC_LIGHT};
use super::plan::{BLOCK, PAVEMENT, Plan, ROADWAY, STREET, StreetPlace};
use super::vehicle::{self, Vehicle};
use crate::chance::Chance;
use crate::solid::Solid;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;
use std::f64::consts::FRAC_PI_2;

/// What has been dealt out to stretches of street.
pub(super) struct Traffic {
    /// How many vehicles a stretch has, by its number.
    counts: Vec<usize>,
    vehicles: Vec<Vehicle>,
    chance: Chance,
}

/// How many vehicles stretches have.
const COUNTS: [usize; 4] = [3, 2, 4, 3];
/// Lanes by their distance from the street's middle: parked vehicles, and those on their way.
const LANES: [f64; 4] = [4.75, 1.75, -1.75, -4.75];
/// Places for a vehicle in a lane, and from one to the next.
const SLOTS: usize = 9;
const SLOT: f64 = 7.2;

impl Traffic {
    pub fn dealt(plan: &Plan, mut chance: Chance) -> Self {
        let [_, stretches] = plan.counts();
        let counts = chance.dealt(stretches, &COUNTS);
        let vehicles = chance.dealt(counts.iter().sum(), &vehicle::ALL);
        Self {
            counts,
            vehicles,
            chance,
        }
    }
}

const ROAD: Piece = Piece {
    name: "roadway",
    look: Look::Asphalt,
    make: || {
        let mut solid = Solid::default();
        solid.cuboid([-ROADWAY, -0.3, -BLOCK], [ROADWAY, 0.0, BLOCK]);
        solid
    },
};
const MARKS: Piece = Piece {
    name: "lane marks",
    look: Look::White,
    make: marks,
};
const WALK: Piece = Piece {
    name: "pavement",
    look: Look::Stone,
    make: pavement,
};
const CROSSING: Piece = Piece {
    name: "crossing",
    look: Look::Asphalt,
    make: || {
        let mut solid = Solid::default();
        solid.cuboid([-STREET, -0.3, -STREET], [STREET, 0.0, STREET]);
        solid
    },
};
const STRIPES: Piece = Piece {
    name: "zebra crossings",
    look: Look::White,
    make: stripes,
};
const CORNERS: Piece = Piece {
    name: "pavement corners",
    look: Look::Stone,
    make: corners,
};

/// Adds a street with all that stands and moves on it.
pub(super) fn add(
    kit: &mut Kit,
    quarter: EntityKey,
    place: &StreetPlace,
    traffic: &mut Traffic,
) -> Result<(), SceneError> {
    let street = kit.node(quarter, &place.name, DAffine3::IDENTITY)?;
    let turn = quarter_turn(if place.along_z { 0 } else { 1 });
    for (number, middle) in &place.stretches {
        let name = format!("stretch {}", number + 1);
        let node = kit.node(street, &name, *middle * turn)?;
        stretch(kit, node, *number, traffic)?;
    }
    for middle in &place.crossings {
        let node = kit.node(street, "crossing", *middle)?;
        crossing(kit, node)?;
    }
    Ok(())
}

fn stretch(
    kit: &mut Kit,
    node: EntityKey,
    number: usize,
    traffic: &mut Traffic,
) -> Result<(), SceneError> {
    let chance = &mut traffic.chance;
    kit.put(node, &ROAD, DAffine3::IDENTITY)?;
    kit.put(node, &MARKS, DAffine3::IDENTITY)?;
    for half in [0, 2] {
        let side = quarter_turn(half);
        kit.put(node, &WALK, side)?;
        let kerb = ROADWAY + 1.1;
        let standing = |z: f64, degrees: f64| side * turned(kerb, PAVEMENT, z, degrees);
        for z in [-27.0, 13.5] {
            let z = z + chance.between(-2.0, 2.0);
            tree(kit, node, standing(z, 0.0), chance)?;
        }
        for z in [-18.0, 22.0] {
            kit.put(node, &STREET_LAMP, standing(z, -90.0))?;
        }
        kit.put(node, &BENCH, standing(chance.between(-9.0, 5.0), 90.0))?;
        kit.put(node, &BIN, standing(7.0, 0.0))?;
    }
    kit.put(
        node,
        &HYDRANT,
        turned(ROADWAY + 0.6, PAVEMENT, chance.between(26.0, 32.0), -90.0),
    )?;
    let mut places: Vec<usize> = (0..LANES.len() * SLOTS).collect();
    chance.shuffle(&mut places);
    let count = traffic.counts.get(number).copied().unwrap_or(0);
    for place in places.into_iter().take(count) {
        let Some(vehicle) = traffic.vehicles.pop() else {
            break;
        };
        let lane = LANES[place % LANES.len()];
        let along = (place / LANES.len()) as f64 - 0.5 * (SLOTS - 1) as f64;
        let shift = traffic.chance.between(-0.4, 0.4);
        // On the right of the way they go: a vehicle's front is towards +X.
        let degrees = if lane > 0.0 { 90.0 } else { -90.0 };
        let place = turned(lane, 0.0, SLOT * along + shift, degrees);
        vehicle::add(kit, node, &vehicle, place)?;
    }
    Ok(())
}

fn crossing(kit: &mut Kit, node: EntityKey) -> Result<(), SceneError> {
    kit.put(node, &CROSSING, DAffine3::IDENTITY)?;
    kit.put(node, &STRIPES, DAffine3::IDENTITY)?;
    kit.put(node, &CORNERS, DAffine3::IDENTITY)?;
    for quarters in 0..4 {
        let place = quarter_turn(quarters) * at(ROADWAY + 1.6, PAVEMENT, ROADWAY + 1.6);
        kit.put(node, &TRAFFIC_LIGHT, place)?;
    }
    Ok(())
}

/// Dashes along the middle, and lines that part the parked from the moving.
fn marks() -> Solid {
    let mut solid = Solid::default();
    let mut line = |x: f64, z: [f64; 2]| {
        solid.cuboid([x - 0.06, -0.02, z[0]], [x + 0.06, 0.006, z[1]]);
    };
    let dash = |i: i32| -33.0 + 5.5 * f64::from(i);
    for i in 0..13 {
        line(0.0, [dash(i) - 1.5, dash(i) + 1.5]);
    }
    for x in [-3.55, 3.55] {
        for i in 0..10 {
            let z = -0.5 * 10.0 * SLOT + SLOT * f64::from(i);
            line(x, [z + 0.5, z + SLOT - 0.5]);
        }
    }
    solid
}

/// Towards +X: a kerb, and slabs behind it.
fn pavement() -> Solid {
    let mut solid = Solid::default();
    let slabs = 14;
    let long = 2.0 * BLOCK / f64::from(slabs);
    for slab in 0..slabs {
        let z = -BLOCK + long * f64::from(slab);
        solid.rounded(
            [ROADWAY, -0.2, z],
            [ROADWAY + 0.25, PAVEMENT, z + long],
            0.03,
            1,
        );
        let (low, high) = (-0.2, PAVEMENT - 0.004);
        solid.cuboid([ROADWAY + 0.24, low, z], [STREET, high, z + long]);
    }
    solid
}

fn stripes() -> Solid {
    let mut arm = Solid::default();
    for i in 0..9 {
        let x = -5.0 + 1.25 * f64::from(i);
        arm.cuboid([x - 0.3, -0.02, 6.6], [x + 0.3, 0.007, 10.2]);
    }
    let mut solid = Solid::default();
    for quarters in 0..4 {
        solid.add(&arm, quarter_turn(quarters));
    }
    solid
}

/// Their kerbs run round in quarters of a circle.
fn corners() -> Solid {
    let mut outline = vec![[STREET, STREET], [ROADWAY, STREET]];
    let radius = 3.0;
    for step in 0..=12 {
        let (sin, cos) = (f64::from(step) * 7.5_f64).to_radians().sin_cos();
        let inwards = |part: f64| ROADWAY + radius * (1.0 - part);
        outline.push([inwards(cos), inwards(sin)]);
    }
    outline.push([STREET, ROADWAY]);
    let mut flat = Solid::default();
    flat.extruded(&outline, [-0.2, PAVEMENT - 0.002]);
    let lying = DAffine3::from_rotation_x(-FRAC_PI_2);
    let mut solid = Solid::default();
    for quarters in 0..4 {
        solid.add(&flat, quarter_turn(quarters) * lying);
    }
    solid
}
