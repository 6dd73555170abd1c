//! Stator vanes between hub and casing, and the struts of the frames.

use super::airfoil::{Airfoil, platform};
use super::assembly::{Assembly, shifted};
use super::materials::MaterialKind;
use super::plan::{HUB, Plan, Stages, core_duct, radius_at};
use crate::solid::Solid;
use antumbra_scene::SceneError;
use std::f64::consts::PI;

/// Relative position of the vanes in a stage of the compressor and of the turbine.
const VANES_AT: [f64; 2] = [0.74, 0.26];

/// One ring of vanes.
struct Ring {
    name: String,
    material: MaterialKind,
    x: f64,
    count: usize,
    /// Half the axial length of the platforms.
    depth: f64,
    airfoil: Airfoil,
}

/// Adds every vane and strut.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("outlet vanes")?;
    ring(engine, outlet(plan))?;
    engine.module("compressor vanes")?;
    ring(engine, inlet(plan))?;
    for stage in 0..plan.compressor.count {
        let stages = &plan.compressor;
        let pitch = stages.pitch();
        let airfoil = Airfoil {
            chord: [pitch * 0.42, pitch * 0.46],
            stagger: [-0.55, -0.45],
            thickness: [0.09, 0.09],
            camber: -0.10,
            cells: plan.airfoils[1],
            ..flat()
        };
        let names = ("compressor vane", MaterialKind::CompressorVane);
        ring(engine, staged(stages, stage, VANES_AT[0], airfoil, names))?;
    }
    engine.module("turbine vanes")?;
    for stage in 0..plan.turbine.count {
        let stages = &plan.turbine;
        let airfoil = Airfoil {
            chord: [stages.pitch() * 0.48; 2],
            stagger: [0.7, 0.62],
            thickness: [0.22, 0.20],
            camber: 0.16,
            cells: plan.airfoils[2],
            ..flat()
        };
        let names = ("turbine vane", MaterialKind::TurbineVane);
        ring(engine, staged(stages, stage, VANES_AT[1], airfoil, names))?;
    }
    engine.module("frames")?;
    for (name, x, material) in [
        ("front strut", -0.83, MaterialKind::FrontCasing),
        ("rear strut", 1.56, MaterialKind::Nozzle),
    ] {
        ring(engine, struts(plan, name, x, material))?;
    }
    Ok(())
}

fn outlet(plan: &Plan) -> Ring {
    Ring {
        name: "outlet vane".into(),
        material: MaterialKind::OutletVane,
        x: -1.07,
        count: plan.outlet_vanes,
        depth: 0.085,
        airfoil: Airfoil {
            radius: [0.84, 1.44],
            chord: [0.15, 0.17],
            stagger: [-0.35, -0.25],
            thickness: [0.09, 0.07],
            camber: -0.10,
            cells: [24, 28],
            ..flat()
        },
    }
}

fn inlet(plan: &Plan) -> Ring {
    let x = -0.98;
    Ring {
        name: "inlet vane".into(),
        material: MaterialKind::CompressorVane,
        x,
        count: plan.inlet_vanes,
        depth: 0.04,
        airfoil: Airfoil {
            radius: [radius_at(&HUB, x), 0.762],
            chord: [0.07, 0.09],
            stagger: [0.15, 0.35],
            thickness: [0.10, 0.08],
            camber: 0.06,
            cells: plan.airfoils[1],
            ..flat()
        },
    }
}

fn struts(plan: &Plan, name: &str, x: f64, material: MaterialKind) -> Ring {
    Ring {
        name: name.into(),
        material,
        x,
        count: plan.struts,
        depth: 0.07,
        airfoil: Airfoil {
            radius: [radius_at(&HUB, x), core_duct(x, 0.05)],
            chord: [0.13; 2],
            thickness: [0.28; 2],
            cells: [12, 24],
            ..flat()
        },
    }
}

fn staged(
    stages: &Stages,
    stage: usize,
    part: f64,
    airfoil: Airfoil,
    (name, material): (&str, MaterialKind),
) -> Ring {
    let x = stages.at(stage, part);
    let radius = [radius_at(&HUB, x) + 0.008, core_duct(x, 0.0) - 0.004];
    Ring {
        name: format!("{name}, stage {}", stage + 1),
        material,
        x,
        count: stages.vanes(stage),
        depth: stages.pitch() * 0.22,
        airfoil: Airfoil { radius, ..airfoil },
    }
}

/// An airfoil of size zero, to start from.
fn flat() -> Airfoil {
    Airfoil {
        radius: [0.0; 2],
        chord: [0.0; 2],
        stagger: [0.0; 2],
        thickness: [0.0; 2],
        camber: 0.0,
        sweep: 0.0,
        cells: [1, 4],
    }
}

fn ring(engine: &mut Assembly, ring: Ring) -> Result<(), SceneError> {
    let [root, tip] = ring.airfoil.radius;
    let half = PI / ring.count as f64 * 0.97;
    let x = [-ring.depth, ring.depth];
    // The outer platform follows the casing and overlaps it.
    let follow = |x: f64| core_duct(ring.x + x, 0.0) - core_duct(ring.x, 0.0);
    let shift = if tip > 1.0 { [0.0; 2] } else { x.map(follow) };
    let outer = |height: f64| shift.map(|shift| tip + shift + height);
    let mut vane = Solid::default();
    Airfoil {
        radius: [root, tip],
        ..ring.airfoil
    }
    .add_to(&mut vane);
    platform(
        &mut vane,
        x,
        [[root - 0.008; 2], [root + 0.004; 2]],
        half,
        3,
    );
    platform(&mut vane, x, [outer(-0.006), outer(0.006)], half, 3);
    let mut vane = engine.part(&ring.name, ring.material, vane)?;
    engine.place_around(&mut vane, ring.count, 0.0, shifted(ring.x, 0.0))
}
