//! Vehicles: assemblies of parts on wheels. Their fronts are towards +X, their wheels stand on y = 0, +Z is their right.

mod body;
mod cabin;
mod engine;
mod racer;
mod trim;
mod wheel;

use super::kit::{Kit, Piece, at, quarter_turn};
use super::look::Look;
use antumbra_scene::{EntityKey, SceneError};
use glam::DAffine3;

/// What a vehicle is, and its colour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vehicle {
    kind: Kind,
    look: Look,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Saloon,
    Van,
    Racer,
}

/// What is dealt out to streets.
pub(super) const ALL: [Vehicle; 10] = [
    of(Kind::Saloon, Look::SilverLacquer),
    of(Kind::Racer, Look::RedLacquer),
    of(Kind::Van, Look::White),
    of(Kind::Saloon, Look::Blue),
    of(Kind::Racer, Look::SilverLacquer),
    of(Kind::Saloon, Look::RedLacquer),
    of(Kind::Van, Look::Ochre),
    of(Kind::Saloon, Look::Black),
    of(Kind::Racer, Look::Blue),
    of(Kind::Saloon, Look::Cream),
];

const fn of(kind: Kind, look: Look) -> Vehicle {
    Vehicle { kind, look }
}

/// Where a vehicle's wheels stand: its front and its rear axle, how far from its middle, and how high.
struct Stance {
    axles: [f64; 2],
    track: f64,
    radius: f64,
}

/// Adds a vehicle.
pub(super) fn add(
    kit: &mut Kit,
    street: EntityKey,
    vehicle: &Vehicle,
    place: DAffine3,
) -> Result<(), SceneError> {
    let name = match vehicle.kind {
        Kind::Saloon => "saloon",
        Kind::Van => "van",
        Kind::Racer => "racing car",
    };
    let node = kit.node(street, name, place)?;
    match vehicle.kind {
        Kind::Racer => racer(kit, node, vehicle.look),
        Kind::Saloon => car(kit, node, vehicle.look, &trim::SALOON),
        Kind::Van => car(kit, node, vehicle.look, &trim::VAN),
    }
}

/// What differs between a saloon and a van.
struct Car {
    body: Piece,
    trim: &'static [Piece],
    stance: Stance,
    /// Where seats stand: their middles, forwards, upwards, and to either side.
    seats: &'static [[f64; 3]],
    dashboard: [f64; 3],
    engine: [f64; 3],
}

fn car(kit: &mut Kit, node: EntityKey, look: Look, car: &Car) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    let body = kit.node(node, "body", here)?;
    kit.put_as(body, &car.body, look, here)?;
    for piece in car.trim {
        kit.put(body, piece, here)?;
    }
    let cabin = kit.node(node, "cabin", here)?;
    for [x, y, z] in car.seats {
        for side in [-1.0, 1.0] {
            kit.put(cabin, &cabin::SEAT, at(*x, *y, side * z))?;
        }
    }
    let [x, y, z] = car.dashboard;
    kit.put(cabin, &cabin::DASHBOARD, at(x, y, 0.0))?;
    kit.put(cabin, &cabin::STEERING_WHEEL, at(x - 0.28, y + 0.02, -z))?;
    kit.put(cabin, &cabin::PEDALS, at(x, y, -z))?;
    let [x, y, z] = car.engine;
    let engine = kit.node(node, "engine", at(x, y, z))?;
    for piece in engine::PARTS {
        kit.put(engine, piece, here)?;
    }
    kit.put(node, &engine::EXHAUST, here)?;
    wheels(kit, node, &car.stance, &wheel::CAR)
}

fn racer(kit: &mut Kit, node: EntityKey, look: Look) -> Result<(), SceneError> {
    let here = DAffine3::IDENTITY;
    let body = kit.node(node, "body", here)?;
    for piece in racer::BODY {
        kit.put_as(body, piece, look, here)?;
    }
    for piece in racer::WINGS {
        kit.put(body, piece, here)?;
    }
    let cockpit = kit.node(node, "cockpit", here)?;
    for piece in racer::COCKPIT {
        kit.put(cockpit, piece, here)?;
    }
    let engine = kit.node(node, "engine", at(-1.05, 0.36, 0.0))?;
    for piece in engine::PARTS {
        kit.put(engine, piece, here)?;
    }
    wheels(kit, node, &racer::STANCE, &wheel::RACER)
}

/// Four wheels with their brakes and what holds them.
fn wheels(
    kit: &mut Kit,
    node: EntityKey,
    stance: &Stance,
    [wheel, suspension]: &[&[Piece]; 2],
) -> Result<(), SceneError> {
    let ends = [("front", stance.axles[0]), ("rear", stance.axles[1])];
    for (end, x) in ends {
        for (side, z, turn) in [("left", -stance.track, 2), ("right", stance.track, 0)] {
            // Outwards is +Z.
            let place = at(x, stance.radius, z) * quarter_turn(turn);
            let name = format!("{end} {side} wheel");
            let assembly = kit.node(node, &name, place)?;
            for piece in *wheel {
                kit.put(assembly, piece, DAffine3::IDENTITY)?;
            }
            let name = format!("{end} {side} suspension");
            let assembly = kit.node(node, &name, place)?;
            for piece in *suspension {
                kit.put(assembly, piece, DAffine3::IDENTITY)?;
            }
        }
    }
    Ok(())
}
