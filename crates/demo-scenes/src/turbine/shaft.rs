//! Parts along the axis: the two shafts, their bearings, the hub before the compressor and the cone behind the
//! turbine.

use super::assembly::{Assembly, shifted};
use super::materials::MaterialKind;
use super::plan::{HUB, Plan, radius_at};
use crate::solid::Solid;
use antumbra_scene::SceneError;
use antumbra_scene::icosphere;
use std::f64::consts::PI;

/// Bearings: axial position, inner and outer radius.
const BEARINGS: [(f64, [f64; 2]); 4] = [
    (-1.27, [0.07, 0.15]),
    (-0.72, [0.15, 0.24]),
    (0.80, [0.15, 0.24]),
    (1.53, [0.07, 0.15]),
];

/// Adds shafts, bearings, hub and cone.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("shafts")?;
    let mut thin = Solid::default();
    thin.band([-1.62, 1.58], [0.045, 0.07], 96);
    thin.band([-1.36, -1.31], [0.06, 0.09], 96);
    engine.place_single("low-pressure shaft", MaterialKind::Shaft, thin)?;
    let mut thick = Solid::default();
    thick.band([-0.78, 1.04], [0.125, 0.15], 128);
    engine.place_single("high-pressure shaft", MaterialKind::Shaft, thick)?;
    for (x, radius) in BEARINGS {
        bearing(engine, plan, x, radius)?;
    }
    let mut hub = Solid::default();
    let [front, rear] = [-1.1, -0.6].map(|x| radius_at(&HUB, x) - 0.006);
    let profile = [
        [-1.1, front - 0.02],
        [-0.6, rear - 0.02],
        [-0.6, rear],
        [-1.1, front],
    ];
    hub.revolve_closed(&profile, 144);
    hub.band([-0.97, -0.94], [0.26, front - 0.015], 144);
    engine.place_single("front frame's hub", MaterialKind::FrontCasing, hub)?;

    let mut cone = Solid::default();
    cone.revolve(
        &[
            [2.02, 0.0],
            [2.015, 0.02],
            [1.95, 0.09],
            [1.82, 0.22],
            [1.70, 0.325],
            [1.60, 0.39],
            [1.50, 0.412],
            [1.46, 0.41],
            [1.46, 0.0],
        ],
        144,
    );
    engine.place_single("exhaust cone", MaterialKind::Nozzle, cone)
}

fn bearing(
    engine: &mut Assembly,
    plan: &Plan,
    x: f64,
    [inner, outer]: [f64; 2],
) -> Result<(), SceneError> {
    let (wall, half) = ((outer - inner) * 0.25, 0.018);
    let middle = 0.5 * (inner + outer);
    let size = (0.28 * (outer - inner)).min(0.95 * PI * middle / plan.balls as f64);
    for (name, low, high) in [
        ("inner race", inner, inner + wall),
        ("outer race", outer - wall, outer),
    ] {
        let mut race = Solid::default();
        race.band([-half, half], [low, high], 96);
        let mut race = engine.part(name, MaterialKind::Bearing, race)?;
        engine.place(&mut race, shifted(x, 0.0))?;
    }
    let ball = Solid::from(icosphere(2, size as f32));
    let mut ball = engine.part("ball", MaterialKind::Bearing, ball)?;
    engine.place_around(&mut ball, plan.balls, 0.0, shifted(x, middle))
}
