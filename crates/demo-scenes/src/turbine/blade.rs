//! Blades of fan, compressor and turbine, each on its platform and fir-tree root.

use super::airfoil::{Airfoil, platform};
use super::assembly::{Assembly, shifted};
use super::materials::MaterialKind;
use super::plan::{HUB, Plan, Stages, core_duct, radius_at};
use crate::solid::Solid;
use antumbra_scene::SceneError;
use glam::DVec3;
use std::f64::consts::PI;

/// Position of the fan.
pub(super) const FAN: f64 = -1.45;
/// Clearance between blades and casing, in metres.
const GAP: f64 = 0.005;
/// Relative position of the blades in a stage of the compressor and of the turbine.
pub(super) const BLADES_AT: [f64; 2] = [0.25, 0.76];
/// Inner radius of the fan blades.
pub(super) const FAN_HUB: f64 = 0.42;

/// Adds every blade.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("fan blades")?;
    let mut fan = Solid::default();
    let airfoil = Airfoil {
        radius: [FAN_HUB - 0.005, 1.425],
        chord: [0.26, 0.40],
        stagger: [0.30, 1.08],
        thickness: [0.10, 0.03],
        camber: 0.07,
        sweep: 0.02,
        cells: [40, 40],
    };
    airfoil.add_to(&mut fan);
    let half = PI / plan.fan_blades as f64 * 0.97;
    let step = [FAN_HUB - 0.02, FAN_HUB];
    platform(
        &mut fan,
        [-0.15, 0.15],
        [[step[0]; 2], [step[1]; 2]],
        half,
        6,
    );
    root(&mut fan, [-0.13, 0.13], [0.35, FAN_HUB - 0.02], 0.028);
    let mut fan = engine.part("fan blade", MaterialKind::FanBlade, fan)?;
    engine.place_around(&mut fan, plan.fan_blades, 0.0, shifted(FAN, 0.0))?;

    let [compressor, _, turbine] = plan.airfoils;
    engine.module("compressor blades")?;
    for stage in 0..plan.compressor.count {
        let pitch = plan.compressor.pitch();
        let airfoil = Airfoil {
            radius: [0.0; 2],
            chord: [pitch * 0.5, pitch * 0.56],
            stagger: [0.5, 0.95],
            thickness: [0.10, 0.05],
            camber: 0.09,
            sweep: 0.0,
            cells: compressor,
        };
        let names = ("compressor blade", MaterialKind::CompressorBlade);
        row(
            engine,
            &plan.compressor,
            stage,
            BLADES_AT[0],
            airfoil,
            names,
        )?;
    }
    engine.module("turbine blades")?;
    for stage in 0..plan.turbine.count {
        let pitch = plan.turbine.pitch();
        let airfoil = Airfoil {
            radius: [0.0; 2],
            chord: [pitch * 0.46; 2],
            stagger: [-0.35, -0.95],
            thickness: [0.20, 0.10],
            camber: -0.18,
            sweep: 0.0,
            cells: turbine,
        };
        let names = ("turbine blade", MaterialKind::TurbineBlade);
        row(engine, &plan.turbine, stage, BLADES_AT[1], airfoil, names)?;
    }
    Ok(())
}

/// The blades of one disc, between hub and casing.
fn row(
    engine: &mut Assembly,
    stages: &Stages,
    stage: usize,
    part: f64,
    airfoil: Airfoil,
    (name, material): (&str, MaterialKind),
) -> Result<(), SceneError> {
    let x = stages.at(stage, part);
    let half = airfoil.half_depth();
    let hub = radius_at(&HUB, x);
    let airfoil = Airfoil {
        radius: [hub - 0.004, core_duct(x, half) - GAP],
        ..airfoil
    };
    let count = stages.blades(stage);
    let mut blade = Solid::default();
    airfoil.add_to(&mut blade);
    let (depth, foot) = (stages.pitch() * 0.24, hub - 0.012);
    let width = PI / count as f64 * 0.97;
    platform(&mut blade, [-depth, depth], [[foot; 2], [hub; 2]], width, 2);
    let slot = 0.7 * foot * width;
    root(
        &mut blade,
        [-depth * 0.9, depth * 0.9],
        [foot - 0.035, foot],
        slot.min(0.018),
    );
    let mut blade = engine.part(&format!("{name}, stage {}", stage + 1), material, blade)?;
    // Every row starts at another angle.
    engine.place_around(&mut blade, count, 0.37 * stage as f64, shifted(x, 0.0))
}

/// A fir-tree root: lobes that get narrower inwards.
fn root(solid: &mut Solid, x: [f64; 2], radius: [f64; 2], half_width: f64) {
    let lobes = |height: f64| 0.55 + 0.3 * height + 0.15 * (height * 4.0 * PI).cos();
    solid.block([1, 12, 1], |u, v, w| {
        DVec3::new(
            x[0] + (x[1] - x[0]) * u,
            radius[0] + (radius[1] - radius[0]) * v,
            half_width * lobes(v) * (2.0 * w - 1.0),
        )
    });
}
