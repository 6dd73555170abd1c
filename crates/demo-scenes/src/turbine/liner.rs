//! What the inlet is lined with: panels, and screws, which make up the number of components.

use super::airfoil::platform;
use super::assembly::{Assembly, shifted};
use super::fastener::screw;
use super::look::Look;
use super::plan::Plan;
use crate::solid::Solid;
use antumbra_scene::SceneError;
use glam::DAffine3;
use std::f64::consts::{FRAC_PI_2, PI};

/// From where to where the panels reach, and between which radii.
const PANELS: [[f64; 2]; 2] = [[-1.93, -1.69], [1.428, 1.446]];
/// Rings of screws, along the axis.
const RINGS: [f64; 4] = [-1.915, -1.705, -1.84, -1.77];

/// Adds the panels, and as many screws as the plan's components want.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("inlet liner")?;
    let [x, radius] = PANELS;
    let half = PI / plan.panels as f64 * 0.985;
    let mut panel = Solid::default();
    platform(&mut panel, x, [[radius[0]; 2], [radius[1]; 2]], half, 24);
    let mut panel = engine.part("liner panel", Look::Liner, panel)?;
    engine.around(&mut panel, plan.panels, 0.0, DAffine3::IDENTITY)?;

    let mut head = engine.part("liner screw", Look::Bolt, screw(0.012))?;
    let inwards = DAffine3::from_rotation_z(-FRAC_PI_2);
    let mut wanted = plan.components.saturating_sub(engine.components());
    for (i, x) in RINGS.into_iter().enumerate() {
        // The first rings take more when the number does not divide.
        let count = wanted.div_ceil(RINGS.len() - i);
        wanted -= count;
        let at = shifted(x, radius[0]) * inwards;
        engine.around(&mut head, count, 0.05, at)?;
    }
    Ok(())
}
