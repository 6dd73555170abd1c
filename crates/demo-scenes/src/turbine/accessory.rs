//! Parts on the outside: the gearbox with its pumps, electronic boxes on posts, mounts and thrust links.

use super::assembly::{Assembly, shifted};
use super::casing_surface::{standing, upright};
use super::fastener::stud;
use super::materials::MaterialKind;
use super::plan::{FAN_CASE, Plan};
use crate::solid::{Solid, polar};
use antumbra_scene::SceneError;
use glam::{DAffine3, DVec3};
use std::f64::consts::PI;

/// Extent of the gearbox below the core: along the axis, radius, and angle in degrees.
const GEARBOX: [[f64; 2]; 3] = [[-0.5, 0.15], [0.93, 1.05], [155.0, 205.0]];
/// Half the size of an electronic box: along the axis, upwards, around.
const BOX: DVec3 = DVec3::new(0.13, 0.045, 0.10);
/// Height of the posts below a box.
const POST: f64 = 0.08;

/// Adds all accessories.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("accessories")?;
    engine.place_single("gearbox", MaterialKind::Gearbox, gearbox())?;
    let mut pump = engine.part("pump", MaterialKind::Gearbox, pump())?;
    let [x, [low, high], [from, to]] = GEARBOX;
    for i in 0..plan.pumps {
        // Alternately on the rear and the front face.
        let (row, rows) = (i / 2, plan.pumps.div_ceil(2));
        let angle = from + (to - from) * (row as f64 + 0.5) / rows as f64;
        let turn = DAffine3::from_rotation_x(angle.to_radians());
        let (face, about) = if i % 2 == 0 { (x[1], 0.0) } else { (x[0], PI) };
        let place = turn * shifted(face, 0.5 * (low + high)) * DAffine3::from_rotation_y(about);
        engine.place(&mut pump, place)?;
    }
    boxes(engine, plan)?;
    mounts(engine)
}

fn gearbox() -> Solid {
    let [x, radius, degrees] = GEARBOX;
    let [from, to] = degrees.map(f64::to_radians);
    let mut solid = Solid::default();
    let mut part = |x: [f64; 2], radius: [f64; 2], angle: [f64; 2], steps: usize| {
        let mix = |[a, b]: [f64; 2], part: f64| a + (b - a) * part;
        solid.block([1, 1, steps], |u, v, w| {
            polar(mix(x, u), mix(radius, v), mix(angle, w))
        });
    };
    part(x, radius, [from, to], 40);
    for rib in 0..6 {
        let at = x[0] + (x[1] - x[0]) * (f64::from(rib) + 0.5) / 6.0;
        let raised = [radius[1] - 0.002, radius[1] + 0.018];
        part(
            [at - 0.006, at + 0.006],
            raised,
            [from - 0.004, to + 0.004],
            40,
        );
    }
    // Four legs up to the casing.
    for x in [x[0] + 0.02, x[1] - 0.06] {
        for angle in [from + 0.03, to - 0.08] {
            part(
                [x, x + 0.04],
                [0.6, radius[0] + 0.01],
                [angle, angle + 0.05],
                2,
            );
        }
    }
    solid
}

/// A stepped pump with a port on its side; its flange lies in the plane x = 0.
fn pump() -> Solid {
    let mut solid = Solid::default();
    solid.revolve(
        &[
            [0.24, 0.0],
            [0.24, 0.018],
            [0.232, 0.026],
            [0.19, 0.026],
            [0.19, 0.046],
            [0.182, 0.053],
            [0.07, 0.053],
            [0.05, 0.04],
            [0.016, 0.04],
            [0.016, 0.058],
            [-0.01, 0.058],
            [-0.01, 0.0],
        ],
        64,
    );
    for ring in 0..5 {
        let x = 0.08 + 0.02 * f64::from(ring);
        solid.band([x, x + 0.008], [0.05, 0.057], 64);
    }
    let mut port = Solid::default();
    port.cylinder(0.016, [0.04, 0.075], 24);
    port.prism(0.022, [0.062, 0.072], 6);
    solid.add(&port, shifted(0.13, 0.0) * standing());
    solid
}

/// Electronic boxes on the fan casing, in two rows below and above, between the openings.
fn boxes(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    let mut housing = engine.part("electronic box", MaterialKind::Electronics, electronics())?;
    let mut bolt = engine.part("box bolt", MaterialKind::Bolt, stud(0.011, 0.0))?;
    let [x, z] = [BOX.x - 0.02, BOX.z - 0.02];
    let angles = [180.0_f64, 0.0, 168.5, 191.5, 348.5, 11.5];
    let rows = [-1.53, -1.25];
    let places = angles.iter().flat_map(|angle| rows.map(|x| (x, angle)));
    for (at, angle) in places.take(plan.boxes) {
        let at = upright(&FAN_CASE, at, angle.to_radians(), 0.0);
        engine.place(&mut housing, at)?;
        for (x, z) in [(-x, -z), (-x, z), (x, -z), (x, z)] {
            let head = DVec3::new(x, POST + 2.0 * BOX.y + 0.001, z);
            let lid = DAffine3::from_translation(head) * standing();
            engine.place(&mut bolt, at * lid)?;
        }
    }
    Ok(())
}

/// A box with cooling fins and plugs, on four posts that reach into the casing.
fn electronics() -> Solid {
    let mut solid = Solid::default();
    let [x, y, z] = BOX.to_array();
    let top = POST + 2.0 * y;
    solid.cuboid([-x, POST, -z], [x, top, z]);
    for fin in 0..12 {
        let at = -0.8 * x + 1.6 * x * f64::from(fin) / 11.0;
        solid.cuboid(
            [at - 0.002, top - 0.002, -0.6 * z],
            [at + 0.002, top + 0.02, 0.6 * z],
        );
    }
    let mut post = Solid::default();
    post.cylinder(0.011, [-0.02, POST + 0.002], 20);
    post.cylinder(0.022, [-0.02, 0.008], 20);
    for [x, z] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]]
        .map(|[i, k]| [i * (x - 0.02), k * (z - 0.02)])
    {
        let foot = DAffine3::from_translation(DVec3::new(x, 0.0, z));
        solid.add(&post, foot * standing());
    }
    let mut plug = Solid::default();
    plug.cylinder(0.02, [x - 0.002, x + 0.03], 24);
    plug.cylinder(0.024, [x + 0.01, x + 0.022], 24);
    for i in [-1.0, 0.0, 1.0] {
        let beside = DVec3::new(0.0, POST + y, i * 0.055);
        solid.add(&plug, DAffine3::from_translation(beside));
    }
    solid
}

/// Two mounts on top of the core, and the thrust links between them.
fn mounts(engine: &mut Assembly) -> Result<(), SceneError> {
    for (name, x, radius) in [
        ("front mount", [-0.93, -0.68], [0.78, 1.1]),
        ("rear mount", [1.48, 1.61], [0.78, 1.1]),
    ] {
        let mut mount = Solid::default();
        mount.block([1, 8, 12], |u, v, w| {
            // A mount is narrower towards its top.
            let half = 0.16 - 0.07 * v;
            let inset = 0.03 * v * (1.0 - 2.0 * u);
            let reach = radius[0] + (radius[1] - radius[0]) * v;
            polar(
                x[0] + (x[1] - x[0]) * u + inset,
                reach,
                half * (2.0 * w - 1.0),
            )
        });
        engine.place_single(name, MaterialKind::Steel, mount)?;
    }
    for side in [-1.0, 1.0] {
        let ends = [(-0.75, 0.1), (1.54, 0.07)];
        let ends = ends.map(|(x, angle)| polar(x, 1.06, side * angle));
        let way: Vec<_> = (0..=24)
            .map(|i| ends[0].lerp(ends[1], f64::from(i) / 24.0))
            .collect();
        let mut link = Solid::default();
        link.tube(&way, 0.02, 24);
        engine.place_single("thrust link", MaterialKind::Steel, link)?;
    }
    Ok(())
}
