//! Discs that carry the blades, drums between them, and the tie bolts.

use super::assembly::{Assembly, shifted};
use super::blade::{BLADES_AT, FAN, FAN_HUB};
use super::fastener::through_bolt;
use super::materials::MaterialKind;
use super::plan::{HUB, Plan, Stages, radius_at};
use crate::solid::Solid;
use antumbra_scene::SceneError;

/// Sides of a disc.
const SIDES: usize = 144;
/// Axial end of the thick shaft; discs behind it sit on the thin one.
const THICK_SHAFT_END: f64 = 1.05;

/// Adds every disc, drum and tie bolt.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("rotor")?;
    let fan = disc([0.075, FAN_HUB - 0.021], 0.12);
    let mut fan = engine.part("fan disc", MaterialKind::Disc, fan)?;
    engine.place(&mut fan, shifted(FAN, 0.0))?;
    let mut drum = Solid::default();
    let rim = FAN_HUB - 0.02;
    drum.band([FAN + 0.12, -1.12], [rim - 0.015, rim], SIDES);
    engine.place_single("fan drum", MaterialKind::Disc, drum)?;

    let mut bolt = engine.part("tie bolt", MaterialKind::Bolt, through_bolt(0.009, 0.03))?;
    let rotors = [
        (&plan.compressor, BLADES_AT[0], "compressor"),
        (&plan.turbine, BLADES_AT[1], "turbine"),
    ];
    for (stages, part, name) in rotors {
        for stage in 0..stages.count {
            let x = stages.at(stage, part);
            let bore = if x < THICK_SHAFT_END { 0.165 } else { 0.085 };
            let solid = disc([bore, radius_at(&HUB, x) - 0.03], stages.pitch() * 0.22);
            let named = format!("{name} disc, stage {}", stage + 1);
            let mut part = engine.part(&named, MaterialKind::Disc, solid)?;
            engine.place(&mut part, shifted(x, 0.0))?;
            let circle = radius_at(&HUB, x) - 0.085;
            engine.place_around(&mut bolt, plan.tie_bolts, 0.2, shifted(x, circle))?;
        }
        drums(engine, stages, part, name)?;
    }
    Ok(())
}

/// Drums between the discs of a rotor, with the fins of their seals.
fn drums(engine: &mut Assembly, stages: &Stages, part: f64, name: &str) -> Result<(), SceneError> {
    for stage in 1..stages.count {
        let [front, rear] = [stage - 1, stage].map(|stage| stages.at(stage, part));
        let half = stages.pitch() * 0.22;
        let x = [front + half, rear - half];
        let top = radius_at(&HUB, 0.5 * (front + rear)) - 0.02;
        let mut drum = Solid::default();
        drum.band(x, [top - 0.012, top], SIDES);
        for fin in 1..4 {
            let at = x[0] + (x[1] - x[0]) * f64::from(fin) * 0.25;
            drum.band([at - 0.001, at + 0.001], [top - 0.002, top + 0.01], SIDES);
        }
        engine.place_single(&format!("{name} drum {stage}"), MaterialKind::Disc, drum)?;
    }
    Ok(())
}

/// A disc at x = 0 from bore to rim: thick at both, thin between.
fn disc([bore, rim]: [f64; 2], half: f64) -> Solid {
    let side = [
        [half * 0.9, bore],
        [half * 0.9, bore + 0.025],
        [half * 0.55, bore + 0.045],
        [half * 0.28, bore + 0.075],
        [half * 0.22, bore + (rim - bore) * 0.5],
        [half * 0.28, rim - 0.07],
        [half * 0.6, rim - 0.045],
        [half, rim - 0.03],
        [half, rim],
    ];
    let mirrored = side.iter().rev().map(|&[x, radius]| [-x, radius]);
    let profile: Vec<_> = side.iter().copied().chain(mirrored).collect();
    let mut solid = Solid::default();
    solid.revolve_closed(&profile, SIDES);
    solid
}
