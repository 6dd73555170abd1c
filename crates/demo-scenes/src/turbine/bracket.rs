//! Brackets on the casings at random places. Each is an angle of sheet metal, held by two studs.

use super::assembly::{Assembly, shifted};
use super::casing_surface::{CASING_SURFACES, standing};
use super::fastener::stud;
use super::materials::MaterialKind;
use super::plan::Plan;
use crate::random::{Random, Stream};
use crate::solid::Solid;
use antumbra_scene::SceneError;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Half the length of a bracket's foot, half its width, its height, in metres.
const KINDS: [[f64; 3]; 3] = [
    [0.034, 0.018, 0.040],
    [0.042, 0.024, 0.046],
    [0.028, 0.026, 0.034],
];
/// Thickness of the sheet.
const SHEET: f64 = 0.004;

/// Adds the brackets, two of five on the fan's casing.
pub(super) fn add(engine: &mut Assembly, plan: &Plan, seed: u64) -> Result<(), SceneError> {
    engine.module("brackets")?;
    let mut random = Random::new(seed, Stream::Brackets);
    let mut kinds = Vec::new();
    for kind in KINDS {
        kinds.push(engine.part("bracket", MaterialKind::Bracket, bracket(kind))?);
    }
    let mut bolt = engine.part("bracket bolt", MaterialKind::Bolt, stud(0.0095, 0.0))?;
    for i in 0..plan.brackets {
        let surface = &CASING_SURFACES[usize::from(i % 5 > 1)];
        let kind = random.pick(KINDS.len());
        let x = random.between(surface.x[0], surface.x[1]);
        let at = surface.upright(surface.beside_flanges(x), surface.angle(&mut random));
        let turn = DAffine3::from_rotation_y(FRAC_PI_2 * random.pick(4) as f64);
        engine.place(&mut kinds[kind], at * turn)?;
        let [length, ..] = KINDS[kind];
        for side in [-0.55, 0.55] {
            let foot = shifted(side * length, SHEET);
            engine.place(&mut bolt, at * turn * foot * standing())?;
        }
    }
    Ok(())
}

/// A foot in the plane y = 0, an upright web with a collared hole along one side, and two gussets.
fn bracket([length, width, height]: [f64; 3]) -> Solid {
    let mut solid = Solid::default();
    solid.cuboid([-length, -0.006, -width], [length, SHEET, width]);
    let web = [width - SHEET, width];
    solid.cuboid([-length, SHEET, web[0]], [length, height, web[1]]);
    for x in [-length, length - SHEET] {
        // A wedge from the far edge of the foot to the top of the web.
        solid.block([1, 1, 1], |u, v, w| {
            let far = web[0] * w - width * 0.6 * (1.0 - w);
            let top = SHEET + (height - SHEET) * (0.08 + 0.92 * w);
            DVec3::new(x + SHEET * u, SHEET + (top - SHEET) * v, far)
        });
    }
    let mut collar = Solid::default();
    collar.band([-0.004, 0.004], [0.006, 0.010], 20);
    let at = DVec3::new(0.0, 0.6 * height, width);
    let sideways = DAffine3::from_rotation_y(FRAC_PI_2);
    solid.add(&collar, DAffine3::from_translation(at) * sideways);
    solid
}
