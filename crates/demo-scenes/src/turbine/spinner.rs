//! The spinner before the fan: a blunt cone of shells, held by rings of screws.

use super::assembly::Assembly;
use super::blade::{FAN, FAN_HUB};
use super::casing_surface::{standing, upright};
use super::fastener::screw;
use super::materials::MaterialKind;
use super::plan::Plan;
use crate::solid::Solid;
use antumbra_scene::SceneError;
use std::f64::consts::TAU;

/// Its axial end and its length.
const REAR: f64 = FAN - 0.16;
const LENGTH: f64 = 0.34;

/// Adds the spinner and its screws.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("spinner")?;
    let outer: Vec<[f64; 2]> = (0..=20).map(|i| point(f64::from(i) / 20.0)).collect();
    let mut profile = vec![[REAR, 0.0]];
    profile.extend(outer.iter().rev());
    let mut spinner = Solid::default();
    spinner.revolve(&profile, 128);
    engine.place_single("spinner", MaterialKind::Spinner, spinner)?;

    let mut head = engine.part("spinner screw", MaterialKind::Bolt, screw(0.012))?;
    let [rings, each] = plan.spinner_screws;
    for ring in 0..rings {
        let [x, _] = point(0.94 - 0.7 * ring as f64 / rings as f64);
        for i in 0..each {
            let angle = TAU * (i as f64 + 0.5) / each as f64;
            let at = upright(&outer, x, angle, 0.0) * standing();
            engine.place(&mut head, at)?;
        }
    }
    Ok(())
}

/// [x, radius] of its outside, from 0 at its tip to 1 at the fan platforms.
fn point(part: f64) -> [f64; 2] {
    [REAR - LENGTH * (1.0 - part), FAN_HUB * part.powf(0.62)]
}
