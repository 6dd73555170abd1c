//! The lining of the inlet: panels, and as many screws as the scene needs to reach its number of components.

use super::airfoil::platform;
use super::assembly::{Assembly, shifted};
use super::fastener::screw;
use super::materials::MaterialKind;
use super::plan::Plan;
use crate::solid::Solid;
use antumbra_scene::SceneError;
use glam::DAffine3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Axial range and [inner, outer] radius of the panels.
const PANELS: [[f64; 2]; 2] = [[-1.93, -1.69], [1.428, 1.446]];
/// Axial positions of the rings of screws.
const RINGS: [f64; 4] = [-1.915, -1.705, -1.84, -1.77];

/// Adds the panels and the screws.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("inlet liner")?;
    let [x, radius] = PANELS;
    let half = PI / plan.panels as f64 * 0.985;
    let mut panel = Solid::default();
    platform(&mut panel, x, [[radius[0]; 2], [radius[1]; 2]], half, 24);
    let mut panel = engine.part("liner panel", MaterialKind::Liner, panel)?;
    engine.place_around(&mut panel, plan.panels, 0.0, DAffine3::IDENTITY)?;

    let mut head = engine.part("liner screw", MaterialKind::Bolt, screw(0.012))?;
    let inwards = DAffine3::from_rotation_z(-FRAC_PI_2);
    let mut wanted = plan.components.saturating_sub(engine.components());
    for (i, x) in RINGS.into_iter().enumerate() {
        // The first rings have one screw more if the number does not divide evenly.
        let count = wanted.div_ceil(RINGS.len() - i);
        wanted -= count;
        let at = shifted(x, radius[0]) * inwards;
        engine.place_around(&mut head, count, 0.05, at)?;
    }
    Ok(())
}
