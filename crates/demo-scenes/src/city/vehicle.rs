//! Vehicles: assemblies of parts on wheels. The front is towards +X, the right side towards +Z; the wheels stand on y
//! = 0.

mod body;
mod cabin;
mod engine;
mod racer;
mod specs;
mod trim;
mod wheel;

use super::city_builder::{CityBuilder, Prefab, at, quarter_rotation};
use super::materials::MaterialKind;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;
use specs::{Car, Stance};

/// Kind and colour of a vehicle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vehicle {
    kind: Kind,
    material: MaterialKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Saloon,
    Van,
    Racer,
}

/// The vehicles of the streets.
pub(super) const ALL: [Vehicle; 10] = [
    of(Kind::Saloon, MaterialKind::SilverLacquer),
    of(Kind::Racer, MaterialKind::RedLacquer),
    of(Kind::Van, MaterialKind::White),
    of(Kind::Saloon, MaterialKind::Blue),
    of(Kind::Racer, MaterialKind::SilverLacquer),
    of(Kind::Saloon, MaterialKind::RedLacquer),
    of(Kind::Van, MaterialKind::Ochre),
    of(Kind::Saloon, MaterialKind::Black),
    of(Kind::Racer, MaterialKind::Blue),
    of(Kind::Saloon, MaterialKind::Cream),
];

const fn of(kind: Kind, material: MaterialKind) -> Vehicle {
    Vehicle { kind, material }
}

/// Adds a vehicle.
pub(super) fn add(
    city: &mut CityBuilder,
    street: EntityKey,
    vehicle: &Vehicle,
    place: DAffine3,
) -> Result<(), SceneError> {
    let name = match vehicle.kind {
        Kind::Saloon => "saloon",
        Kind::Van => "van",
        Kind::Racer => "racing car",
    };
    let node = city.node(street, name, place)?;
    match vehicle.kind {
        Kind::Racer => racer(city, node, vehicle.material),
        Kind::Saloon => car(city, node, vehicle.material, &trim::SALOON),
        Kind::Van => car(city, node, vehicle.material, &trim::VAN),
    }
}

fn car(
    city: &mut CityBuilder,
    node: EntityKey,
    material: MaterialKind,
    car: &Car,
) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    let body = city.node(node, "body", here)?;
    city.place_with_material(body, &car.body, material, here)?;
    for prefab in car.trim {
        city.put(body, prefab, here)?;
    }
    let cabin = city.node(node, "cabin", here)?;
    for [x, y, z] in car.seats {
        for side in [-1.0, 1.0] {
            city.put(cabin, &cabin::SEAT, at(*x, *y, side * z))?;
        }
    }
    let [x, y, z] = car.dashboard;
    city.put(cabin, &cabin::DASHBOARD, at(x, y, 0.0))?;
    city.put(cabin, &cabin::STEERING_WHEEL, at(x - 0.28, y + 0.02, -z))?;
    city.put(cabin, &cabin::PEDALS, at(x, y, -z))?;
    let [x, y, z] = car.engine;
    let engine = city.node(node, "engine", at(x, y, z))?;
    for prefab in engine::PARTS {
        city.put(engine, prefab, here)?;
    }
    city.put(node, &engine::EXHAUST, here)?;
    wheels(city, node, &car.stance, &wheel::CAR)
}

fn racer(
    city: &mut CityBuilder,
    node: EntityKey,
    material: MaterialKind,
) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    let body = city.node(node, "body", here)?;
    for prefab in racer::BODY {
        city.place_with_material(body, prefab, material, here)?;
    }
    for prefab in racer::WINGS {
        city.put(body, prefab, here)?;
    }
    let cockpit = city.node(node, "cockpit", here)?;
    for prefab in racer::COCKPIT {
        city.put(cockpit, prefab, here)?;
    }
    let engine = city.node(node, "engine", at(-1.05, 0.36, 0.0))?;
    for prefab in engine::PARTS {
        city.put(engine, prefab, here)?;
    }
    wheels(city, node, &racer::STANCE, &wheel::RACER)
}

/// Adds four wheels with their brakes and suspensions.
fn wheels(
    city: &mut CityBuilder,
    node: EntityKey,
    stance: &Stance,
    [wheel, suspension]: &[&[Prefab]; 2],
) -> Result<(), SceneError> {
    let ends = [("front", stance.axles[0]), ("rear", stance.axles[1])];
    for (end, x) in ends {
        for (side, z, turn) in [("left", -stance.track, 2), ("right", stance.track, 0)] {
            // A wheel's outer side is +Z.
            let place = at(x, stance.radius, z) * quarter_rotation(turn);
            let name = format!("{end} {side} wheel");
            let assembly = city.node(node, &name, place)?;
            for prefab in *wheel {
                city.put(assembly, prefab, DAffine3::IDENTITY)?;
            }
            let name = format!("{end} {side} suspension");
            let assembly = city.node(node, &name, place)?;
            for prefab in *suspension {
                city.put(assembly, prefab, DAffine3::IDENTITY)?;
            }
        }
    }
    Ok(())
}
