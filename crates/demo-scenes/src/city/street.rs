//! Streets: roadways and pavements between crossings, street furniture, and vehicles.

use super::city_builder::{CityBuilder, Prefab, at, quarter_rotation, rotated_at};
use super::materials::MaterialKind;
use super::plan::{BLOCK, PAVEMENT, Plan, ROADWAY, STREET, StreetDirection, StreetPlace, Stretch};
use super::street_furniture::{BENCH, BIN, HYDRANT, STREET_LAMP, TRAFFIC_LIGHT};
use super::vegetation::tree;
use super::vehicle::{self, Vehicle};
use crate::random::Random;
use crate::solid::Solid;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;
use std::f64::consts::FRAC_PI_2;

/// The vehicles of all stretches of street, in random order.
pub(super) struct Traffic {
    /// Number of vehicles by the number of the stretch.
    counts: Vec<usize>,
    vehicles: Vec<Vehicle>,
    random: Random,
}

/// Numbers of vehicles that stretches take.
const COUNTS: [usize; 4] = [3, 2, 4, 3];
/// Distance of the lanes from the centre of the street: parking lanes, and driving lanes.
const LANES: [f64; 4] = [4.75, 1.75, -1.75, -4.75];
/// Places for vehicles in a lane, and distance between two places.
const SLOTS: usize = 9;
const SLOT: f64 = 7.2;

impl Traffic {
    pub fn new(plan: &Plan, mut random: Random) -> Self {
        let [_, stretches] = plan.counts();
        let counts = random.shuffled_deck(stretches, &COUNTS);
        let vehicles = random.shuffled_deck(counts.iter().sum(), &vehicle::ALL);
        Self {
            counts,
            vehicles,
            random,
        }
    }
}

const ROAD: Prefab = Prefab {
    name: "roadway",
    material: MaterialKind::Asphalt,
    make: || {
        let mut solid = Solid::default();
        solid.cuboid([-ROADWAY, -0.3, -BLOCK], [ROADWAY, 0.0, BLOCK]);
        solid
    },
};
const MARKS: Prefab = Prefab {
    name: "lane marks",
    material: MaterialKind::White,
    make: marks,
};
const WALK: Prefab = Prefab {
    name: "pavement",
    material: MaterialKind::Stone,
    make: pavement,
};
const CROSSING: Prefab = Prefab {
    name: "crossing",
    material: MaterialKind::Asphalt,
    make: || {
        let mut solid = Solid::default();
        solid.cuboid([-STREET, -0.3, -STREET], [STREET, 0.0, STREET]);
        solid
    },
};
const STRIPES: Prefab = Prefab {
    name: "zebra crossings",
    material: MaterialKind::White,
    make: stripes,
};
const CORNERS: Prefab = Prefab {
    name: "pavement corners",
    material: MaterialKind::Stone,
    make: corners,
};

/// Adds a street with all that stands and drives on it.
pub(super) fn add(
    city: &mut CityBuilder,
    quarter: EntityKey,
    place: &StreetPlace,
    traffic: &mut Traffic,
) -> Result<(), SceneError> {
    let street = city.node(quarter, &place.name, DAffine3::IDENTITY)?;
    let turn = quarter_rotation(match place.direction {
        StreetDirection::AlongZ => 0,
        StreetDirection::AlongX => 1,
    });
    for Stretch { number, at: middle } in &place.stretches {
        let name = format!("stretch {}", number + 1);
        let node = city.node(street, &name, *middle * turn)?;
        stretch(city, node, *number, traffic)?;
    }
    for middle in &place.crossings {
        let node = city.node(street, "crossing", *middle)?;
        crossing(city, node)?;
    }
    Ok(())
}

fn stretch(
    city: &mut CityBuilder,
    node: EntityKey,
    number: usize,
    traffic: &mut Traffic,
) -> Result<(), SceneError> {
    let random = &mut traffic.random;
    city.put(node, &ROAD, DAffine3::IDENTITY)?;
    city.put(node, &MARKS, DAffine3::IDENTITY)?;
    for half in [0, 2] {
        let side = quarter_rotation(half);
        city.put(node, &WALK, side)?;
        let kerb = ROADWAY + 1.1;
        let standing = |z: f64, degrees: f64| side * rotated_at(kerb, PAVEMENT, z, degrees);
        for z in [-27.0, 13.5] {
            let z = z + random.between(-2.0, 2.0);
            tree(city, node, standing(z, 0.0), random)?;
        }
        for z in [-18.0, 22.0] {
            city.put(node, &STREET_LAMP, standing(z, -90.0))?;
        }
        city.put(node, &BENCH, standing(random.between(-9.0, 5.0), 90.0))?;
        city.put(node, &BIN, standing(7.0, 0.0))?;
    }
    city.put(
        node,
        &HYDRANT,
        rotated_at(ROADWAY + 0.6, PAVEMENT, random.between(26.0, 32.0), -90.0),
    )?;
    let mut places: Vec<usize> = (0..LANES.len() * SLOTS).collect();
    random.shuffle(&mut places);
    let count = traffic.counts.get(number).copied().unwrap_or(0);
    for place in places.into_iter().take(count) {
        let Some(vehicle) = traffic.vehicles.pop() else {
            break;
        };
        let lane = LANES[place % LANES.len()];
        let along = (place / LANES.len()) as f64 - 0.5 * (SLOTS - 1) as f64;
        let shift = traffic.random.between(-0.4, 0.4);
        // Vehicles drive on the right; the front of a vehicle is towards +X.
        let degrees = if lane > 0.0 { 90.0 } else { -90.0 };
        let place = rotated_at(lane, 0.0, SLOT * along + shift, degrees);
        vehicle::add(city, node, &vehicle, place)?;
    }
    Ok(())
}

fn crossing(city: &mut CityBuilder, node: EntityKey) -> Result<(), SceneError> {
    city.put(node, &CROSSING, DAffine3::IDENTITY)?;
    city.put(node, &STRIPES, DAffine3::IDENTITY)?;
    city.put(node, &CORNERS, DAffine3::IDENTITY)?;
    for quarters in 0..4 {
        let place = quarter_rotation(quarters) * at(ROADWAY + 1.6, PAVEMENT, ROADWAY + 1.6);
        city.put(node, &TRAFFIC_LIGHT, place)?;
    }
    Ok(())
}

/// Dashes along the centre, and lines between parking and driving lanes.
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

/// The pavement at +X: a kerb, and slabs behind it.
fn pavement() -> Solid {
    let mut solid = Solid::default();
    let slabs = 14;
    let long = 2.0 * BLOCK / f64::from(slabs);
    for slab in 0..slabs {
        let z = -BLOCK + long * f64::from(slab);
        solid.rounded_box(
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
        solid.add(&arm, quarter_rotation(quarters));
    }
    solid
}

/// Corners of pavements at a crossing, with kerbs in quarter circles.
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
    flat.extrude(&outline, [-0.2, PAVEMENT - 0.002]);
    let lying = DAffine3::from_rotation_x(-FRAC_PI_2);
    let mut solid = Solid::default();
    for quarters in 0..4 {
        solid.add(&flat, quarter_rotation(quarters) * lying);
    }
    solid
}
