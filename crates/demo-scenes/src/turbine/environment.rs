//! The environment map: a workshop, modelled as one box and seen from the engine's centre.

use antumbra_scene::{Image, Sampler};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Pixels wide and high.
const SIZE: [u32; 2] = [256, 128];
/// Samples per pixel along each axis, for smooth edges.
const SAMPLES_PER_AXIS: u32 = 3;

/// Distances in metres from the engine's centre to the walls along X and Z, to the floor and to the ceiling.
const WALLS: [f64; 2] = [9.0, 7.0];
const FLOOR: f64 = 2.2;
const CEILING: f64 = 4.0;

/// Centres of the four light panels on the ceiling, and half their size, in metres.
const PANELS: [[f64; 2]; 4] = [[-3.2, 2.4], [3.2, 2.4], [-3.2, -2.4], [3.2, -2.4]];
const PANEL: [f64; 2] = [2.2, 0.7];

/// Renders the equirectangular map; its centre is the direction -Z.
pub(super) fn workshop() -> Image {
    let [width, height] = SIZE;
    let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height {
        for x in 0..width {
            let samples = (0..SAMPLES_PER_AXIS * SAMPLES_PER_AXIS).map(|sample| {
                let place = |pixel: u32, sample: u32, of: u32| {
                    (f64::from(pixel) + (f64::from(sample) + 0.5) / f64::from(SAMPLES_PER_AXIS))
                        / f64::from(of)
                };
                seen(towards(
                    place(x, sample % SAMPLES_PER_AXIS, width),
                    place(y, sample / SAMPLES_PER_AXIS, height),
                ))
            });
            let light = samples.sum::<DVec3>() / f64::from(SAMPLES_PER_AXIS * SAMPLES_PER_AXIS);
            rgba.extend(light.to_array().map(encoded));
            rgba.push(255);
        }
    }
    Image {
        name: "workshop".into(),
        width,
        height,
        rgba,
        sampler: Sampler::default(),
    }
}

/// The direction of a point of the map, 0 to 1 from its upper left corner.
fn towards(u: f64, v: f64) -> DVec3 {
    let (sin, cos) = ((u - 0.5) * TAU).sin_cos();
    let (below, up) = (v * PI).sin_cos();
    DVec3::new(below * sin, up, -below * cos)
}

/// Linear radiance from a direction.
fn seen(towards: DVec3) -> DVec3 {
    let height = if towards.y > 0.0 { CEILING } else { FLOOR };
    let away = |along: f64, far: f64| far / along.abs().max(1e-9);
    let [x, z] = [away(towards.x, WALLS[0]), away(towards.z, WALLS[1])];
    let y = away(towards.y, height);
    let place = towards * x.min(y).min(z);
    if y <= x.min(z) {
        let over = DVec2::new(place.x, place.z);
        if towards.y > 0.0 {
            ceiling(over)
        } else {
            floor(over)
        }
    } else if z < x {
        let side = if towards.z < 0.0 {
            LongWall::Far
        } else {
            LongWall::Near
        };
        long_wall(place.x, place.y, side)
    } else {
        DVec3::new(0.19, 0.19, 0.18) * shaded(place.y)
    }
}

fn ceiling(over: DVec2) -> DVec3 {
    let lit = PANELS.iter().any(|panel| {
        let off = (over - DVec2::from(*panel)).abs();
        off.x < PANEL[0] && off.y < PANEL[1]
    });
    // Beams across the ceiling, two metres apart.
    let beam = (over.x / 2.0 + 0.5).rem_euclid(1.0) < 0.15;
    match (lit, beam) {
        (true, _) => DVec3::new(1.0, 0.98, 0.94),
        (false, true) => DVec3::splat(0.10),
        (false, false) => DVec3::new(0.22, 0.22, 0.23),
    }
}

/// A dark floor with a painted line around the engine.
fn floor(over: DVec2) -> DVec3 {
    let to_line = (over.abs() - DVec2::new(3.4, 2.9)).max_element().abs();
    if to_line < 0.08 {
        DVec3::new(0.42, 0.32, 0.05)
    } else {
        DVec3::new(0.055, 0.055, 0.06)
    }
}

/// A wall along X.
#[derive(Clone, Copy)]
enum LongWall {
    /// At +Z.
    Near,
    /// At -Z.
    Far,
}

/// Windows in the far wall; a workbench with a dark board above it at the near wall.
fn long_wall(x: f64, y: f64, side: LongWall) -> DVec3 {
    let wall = DVec3::new(0.20, 0.20, 0.21) * shaded(y);
    let within = (x / 2.4 + 0.5).rem_euclid(1.0);
    match side {
        LongWall::Far if (0.4..3.0).contains(&y) && (0.1..0.9).contains(&within) => {
            DVec3::new(0.62, 0.74, 0.90)
        }
        LongWall::Near if (-0.6..1.4).contains(&y) && x.abs() < 5.0 => DVec3::new(0.07, 0.09, 0.11),
        _ => wall,
    }
}

/// Brightness of a wall, which decreases towards the floor.
fn shaded(y: f64) -> f64 {
    0.45 + 0.55 * ((y + FLOOR) / (CEILING + FLOOR)).clamp(0.0, 1.0)
}

/// Encodes linear light as an sRGB byte.
fn encoded(light: f64) -> u8 {
    let value = if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    };
    (value * 255.0).round() as u8
}
