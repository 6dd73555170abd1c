//! The combustor: a ring of cans, each with its swirler, fuel nozzle, cross-fire tube and transition to the turbine,
//! and the fuel manifold around the casing.

use super::assembly::{Assembly, shifted};
use super::casing_surface::standing_at;
use super::materials::MaterialKind;
use super::plan::{Plan, radius_at};
use crate::shell::{ShellGrid, ShellSide};
use crate::solid::{Solid, polar};
use crate::tube::rounded_path;
use antumbra_scene::SceneError;
use glam::{DAffine3, DVec3};
use std::f64::consts::{PI, TAU};

/// Distance of the cans' axes from the engine's.
const CIRCLE: f64 = 0.49;
/// Axial range of the cans.
const CAN: [f64; 2] = [0.36, 0.70];
/// Axial end of the transitions, and their [inner, outer] radius there.
const TURBINE: (f64, [f64; 2]) = (0.855, [0.478, 0.612]);
/// The fuel manifold: axial position, radius, and radius of its tube.
const MANIFOLD: [f64; 3] = [0.325, 0.725, 0.013];
/// Cells around a can.
const SIDES: usize = 48;

/// Adds all parts between compressor and turbine.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("combustor")?;
    let count = plan.cans;
    let radius = (0.88 * CIRCLE * (PI / count as f64).sin()).min(0.085);
    let (in_ring, whole) = (shifted(0.0, CIRCLE), DAffine3::IDENTITY);
    for (name, material, solid, at) in [
        ("can", MaterialKind::Can, can(radius), in_ring),
        ("swirler", MaterialKind::Steel, swirler(radius), in_ring),
        ("fuel nozzle", MaterialKind::Steel, nozzle(), whole),
        (
            "cross-fire tube",
            MaterialKind::Can,
            cross_fire(radius, count),
            whole,
        ),
        (
            "transition",
            MaterialKind::TurbineVane,
            transition(radius, count),
            whole,
        ),
    ] {
        let mut part = engine.part(name, material, solid)?;
        engine.place_around(&mut part, count, 0.0, at)?;
    }
    let mut inner = Solid::default();
    let profile = [
        [0.29, 0.40],
        [0.40, 0.345],
        [0.72, 0.345],
        [0.86, 0.40],
        [0.86, 0.41],
        [0.72, 0.357],
        [0.40, 0.357],
        [0.29, 0.41],
    ];
    inner.revolve_closed(&profile, 192);
    engine.place_single("inner combustor casing", MaterialKind::HotCasing, inner)?;

    engine.module("fuel")?;
    let mut feeds = engine.part("fuel feed", MaterialKind::Copper, feed())?;
    engine.place_around(&mut feeds, count, 0.0, whole)?;
    let [x, radius, thick] = MANIFOLD;
    let mut manifold = Solid::default();
    manifold.torus(x, radius, thick, [14, 192]);
    engine.place_single("fuel manifold", MaterialKind::Copper, manifold)
}

/// A thin-walled can around its own axis, with rows of air holes.
fn can(radius: f64) -> Solid {
    let shape = [
        [CAN[0], 0.55 * radius],
        [CAN[0] + 0.02, 0.82 * radius],
        [CAN[0] + 0.05, radius],
        [CAN[1] - 0.05, radius],
        [CAN[1], 0.92 * radius],
    ];
    let rows = 31;
    let at = |row: usize, column: usize, side: ShellSide| {
        let x = CAN[0] + (CAN[1] - CAN[0]) * row as f64 / (rows - 1) as f64;
        let thick = if side == ShellSide::Outer { 0.0 } else { 0.004 };
        polar(
            x,
            radius_at(&shape, x) - thick,
            TAU * column as f64 / SIDES as f64,
        )
    };
    let keep = |row: usize, column: usize| row % 5 != 3 || (column + row / 5 * 2) % 4 != 1;
    let mut solid = Solid::default();
    let wall = ShellGrid {
        rows,
        columns: SIDES,
    };
    solid.shell_where(wall, at, keep);
    solid
}

/// Two rings with slanted vanes between them, at the inlet of a can.
fn swirler(radius: f64) -> Solid {
    let x = [CAN[0] - 0.012, CAN[0] + 0.012];
    let [inner, outer] = [0.22 * radius, 0.5 * radius];
    let mut solid = Solid::default();
    solid.band(x, [inner - 0.003, inner], 32);
    solid.band(x, [outer, outer + 0.004], 32);
    let vanes = 10;
    for vane in 0..vanes {
        let first = TAU * f64::from(vane) / f64::from(vanes);
        solid.block([4, 1, 1], |u, v, w| {
            let reach = inner - 0.001 + (outer - inner + 0.002) * v;
            let angle = first + 0.5 * u + 0.002 * (w - 0.5) / reach;
            polar(x[0] + (x[1] - x[0]) * u, reach, angle)
        });
    }
    solid
}

/// From a pad on the casing inwards and back into the can.
fn nozzle() -> Solid {
    let x = MANIFOLD[0];
    let corners = [[x, 0.645], [x, CIRCLE], [CAN[0] + 0.01, CIRCLE]].map(outwards);
    let mut solid = Solid::default();
    solid.tube(&rounded_path(&corners, 0.03, 20), 0.009, 14);
    let mut pad = Solid::default();
    pad.cylinder(0.026, [0.622, 0.65], 20);
    solid.add(&pad, standing_at(x));
    let mut tip = Solid::default();
    let from = CAN[0];
    tip.revolve(
        &[
            [from + 0.03, 0.0],
            [from + 0.03, 0.005],
            [from + 0.012, 0.012],
            [from, 0.012],
            [from, 0.0],
        ],
        20,
    );
    solid.add(&tip, shifted(0.0, CIRCLE));
    solid
}

/// From the manifold to the nozzle's pad.
fn feed() -> Solid {
    let [x, radius, _] = MANIFOLD;
    let mut solid = Solid::default();
    let way = [[x, radius], [x, 0.5 * (radius + 0.645)], [x, 0.645]].map(outwards);
    solid.tube(&way, 0.007, 14);
    let mut nut = Solid::default();
    nut.prism(0.015, [0.652, 0.668], 6);
    nut.prism(0.015, [0.696, 0.71], 6);
    solid.add(&nut, standing_at(x));
    solid
}

fn outwards([x, radius]: [f64; 2]) -> DVec3 {
    DVec3::new(x, radius, 0.0)
}

/// From a can to the next one.
fn cross_fire(radius: f64, count: usize) -> Solid {
    let x = 0.5;
    let inside = 0.97 * radius / CIRCLE;
    let ends = [inside, TAU / count as f64 - inside].map(|angle| polar(x, CIRCLE, angle));
    let mut solid = Solid::default();
    let middle = ends[0].lerp(ends[1], 0.5);
    solid.tube(&[ends[0], middle, ends[1]], 0.014, 18);
    let collar = (ends[1] - ends[0]).normalize_or(DVec3::Z) * 0.006;
    solid.tube(&[middle - collar, middle, middle + collar], 0.019, 18);
    solid
}

/// From the round end of a can to its segment of the turbine's ring.
fn transition(radius: f64, count: usize) -> Solid {
    let rows = 17;
    let (end, [low, high]) = TURBINE;
    let at = |row: usize, column: usize, side: ShellSide| {
        let part = row as f64 / (rows - 1) as f64;
        let (sin, cos) = (TAU * column as f64 / SIDES as f64).sin_cos();
        let size = if side == ShellSide::Outer { 1.0 } else { 0.95 };
        let from = DVec3::new(
            CAN[1] - 0.01,
            CIRCLE + 0.97 * radius * size * cos,
            0.97 * radius * size * sin,
        );
        // Maps the circle to a square, and the square to the segment of the ring.
        let square = size / sin.abs().max(cos.abs());
        let reach = 0.5 * (low + high) + 0.5 * (high - low) * square * cos;
        let to = polar(end, reach, 0.96 * PI / count as f64 * square * sin);
        let eased = part * part * (3.0 - 2.0 * part);
        let place = from.lerp(to, eased);
        DVec3::new(from.x + (end - from.x) * part, place.y, place.z)
    };
    let mut solid = Solid::default();
    let wall = ShellGrid {
        rows,
        columns: SIDES,
    };
    solid.shell(wall, at);
    solid
}
