//! Bolts through flanges and studs on casings. They lie along X.

use super::assembly::{Assembly, shifted};
use super::materials::MaterialKind;
use super::plan::{CORE_CASE, CORE_FLANGES, FAN_CASE, FAN_FLANGES, FLANGE, Plan, radius_at};
use crate::solid::Solid;
use antumbra_scene::SceneError;

/// Adds the bolts of every flange.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("flange bolts")?;
    let [rise, thick] = FLANGE;
    let bolt = through_bolt(0.016, 2.0 * thick);
    let mut bolt = engine.part("fan case bolt", MaterialKind::Bolt, bolt)?;
    for x in FAN_FLANGES {
        let circle = radius_at(&FAN_CASE, x) + 0.5 * rise;
        engine.place_around(&mut bolt, plan.fan_bolts, 0.02, shifted(x, circle))?;
    }
    let bolt = through_bolt(0.0135, 2.0 * thick);
    let mut bolt = engine.part("core bolt", MaterialKind::Bolt, bolt)?;
    for x in CORE_FLANGES {
        let circle = radius_at(&CORE_CASE, x) + 0.5 * rise;
        engine.place_around(&mut bolt, plan.core_bolts, 0.03, shifted(x, circle))?;
    }
    Ok(())
}

/// A bolt whose head and nut clamp a joint of `grip` metres at x = 0; `radius` is the circumradius of the head.
pub(super) fn through_bolt(radius: f64, grip: f64) -> Solid {
    let mut solid = stud(radius, 0.5 * grip);
    let (shank, face) = (0.55 * radius, -0.5 * grip);
    solid.cylinder(1.25 * radius, [face - 0.003, face], 14);
    let nut = face - 0.003 - 0.8 * radius;
    solid.prism(radius, [nut, face - 0.003], 6);
    let end = nut - 0.5 * radius;
    // Two turns of thread, then a bevel.
    let mut profile = vec![[nut, 0.0], [nut, shank]];
    for turn in 1..=4 {
        let x = nut + (end - nut) * 0.2 * f64::from(turn);
        let depth = if turn % 2 == 0 { shank } else { 0.85 * shank };
        profile.push([x, depth]);
    }
    profile.extend([[end, 0.6 * shank], [end, 0.0]]);
    solid.revolve(&profile, 10);
    solid
}

/// A washer and a hexagonal head on the plane x = `foot`.
pub(super) fn stud(radius: f64, foot: f64) -> Solid {
    let mut solid = Solid::default();
    solid.cylinder(1.25 * radius, [foot, foot + 0.003], 14);
    let (low, high) = (foot + 0.003, foot + 0.003 + 0.75 * radius);
    solid.prism(radius, [low, high], 6);
    let dome = [
        [high + 0.12 * radius, 0.0],
        [high + 0.12 * radius, 0.55 * radius],
        [high + 0.06 * radius, 0.78 * radius],
        [high, 0.84 * radius],
        [high, 0.0],
    ];
    solid.revolve(&dome, 12);
    solid
}

/// A round screw head with a cross slot for panels, on the plane x = 0.
pub(super) fn screw(radius: f64) -> Solid {
    let mut solid = Solid::default();
    let head = [
        [0.45 * radius, 0.0],
        [0.45 * radius, 0.35 * radius],
        [0.5 * radius, 0.45 * radius],
        [0.35 * radius, 0.8 * radius],
        [0.12 * radius, radius],
        [0.0, radius],
        [0.0, 0.0],
    ];
    solid.revolve(&head, 16);
    solid
}
