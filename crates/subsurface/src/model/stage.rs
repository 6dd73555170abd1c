//! How the model is shown: colours, lamps, views, and a flight.

use super::{DEPTH, HALF, Model, world};
use crate::surface::SurfaceKind;
use antumbra_scene::Light;
use glam::{DVec2, DVec3};

/// A named place to look from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// What to call it.
    pub name: &'static str,
    /// The eye, in world metres.
    pub position: DVec3,
    /// What it looks at, in world metres; +Y is up.
    pub target: DVec3,
    /// Full vertical angle of view in radians.
    pub fov_y: f64,
}

/// sRGB, from the top horizon down.
const HORIZONS: [[u8; 3]; 11] = [
    [236, 205, 112],
    [214, 222, 128],
    [159, 204, 128],
    [98, 186, 144],
    [64, 168, 168],
    [72, 148, 194],
    [96, 128, 206],
    [132, 116, 200],
    [168, 124, 190],
    [150, 140, 150],
    [178, 160, 140],
];
/// sRGB.
const FAULTS: [[u8; 3]; 4] = [[206, 62, 48], [224, 94, 52], [186, 44, 72], [214, 78, 96]];

/// Linear RGBA of a surface: the spectrum from the top horizon down, and reds for faults.
pub(crate) fn colour(kind: SurfaceKind, index: usize) -> [f32; 4] {
    let palette: &[[u8; 3]] = match kind {
        SurfaceKind::Horizon => &HORIZONS,
        SurfaceKind::Fault => &FAULTS,
    };
    let colour = palette.get(index % palette.len()).copied();
    let [r, g, b] = colour.unwrap_or([255; 3]).map(linear);
    [r, g, b, 1.0]
}

/// An sRGB component as light.
fn linear(component: u8) -> f32 {
    let component = f32::from(component) / 255.0;
    if component <= 0.040_45 {
        component / 12.92
    } else {
        ((component + 0.055) / 1.055).powf(2.4)
    }
}

pub(super) fn lights() -> [(DVec3, Light); 2] {
    // Candela: about three lux in the middle of the model from the first, one from the second.
    [
        (DVec3::new(3000.0, 2700.0, 2500.0), [1.0, 0.97, 0.92], 1.0e8),
        (
            DVec3::new(-3800.0, 2300.0, -3600.0),
            [0.85, 0.92, 1.0],
            5.0e7,
        ),
    ]
    .map(|(position, colour, intensity)| {
        let range = None;
        let light = Light::Point {
            colour,
            intensity,
            range,
        };
        (position, light)
    })
}

pub(super) fn views() -> [View; 2] {
    let fov_y = 40f64.to_radians();
    [
        View {
            name: "open",
            position: DVec3::new(6900.0, 3500.0, 6500.0),
            target: DVec3::new(350.0, -1700.0, 350.0),
            fov_y,
        },
        View {
            name: "occluded",
            position: DVec3::new(-2700.0, 6200.0, -2400.0),
            target: DVec3::new(150.0, -1100.0, 150.0),
            fov_y,
        },
    ]
}

pub(super) fn flight(model: &Model) -> Vec<(DVec3, DVec3)> {
    let middle = model.options.horizons as usize / 2;
    let centre = DVec3::new(0.0, -1400.0, 0.0);
    // In the widest space about a horizon, at a place given as shares of the field's half.
    let between = |horizon: usize, x: f64, y: f64| {
        let place = HALF * DVec2::new(x, y);
        let about = horizon.saturating_sub(1)..horizon + 3;
        let depths: Vec<f64> = about.filter_map(|k| model.depth(k, place)).collect();
        let spaces = depths.array_windows::<2>().copied();
        let widest = spaces.max_by(|[a, b], [c, d]| (b - a).total_cmp(&(d - c)));
        let [above, below] = widest.unwrap_or([0.0, DEPTH]);
        world(place, f64::midpoint(above, below))
    };
    let (upper, lower) = (middle, middle + 2);
    vec![
        (DVec3::new(6400.0, 3000.0, 5600.0), centre),
        (DVec3::new(600.0, 2600.0, 7000.0), centre),
        (DVec3::new(-5200.0, 2300.0, 4400.0), centre),
        (DVec3::new(-5400.0, 1600.0, -2600.0), centre),
        (DVec3::new(-600.0, 1700.0, -4600.0), centre),
        (DVec3::new(3600.0, 900.0, -1800.0), centre),
        // Down into the cut-out and along the layers.
        (
            DVec3::new(4300.0, -300.0, 2600.0),
            between(upper, 0.3, -0.3),
        ),
        (between(upper, 0.55, -0.5), between(upper, -0.2, 0.0)),
        (between(upper, 0.1, -0.1), between(upper, -0.6, 0.3)),
        (between(lower, -0.45, 0.2), between(lower, -0.9, -0.5)),
        // Out in the south-west and back.
        (between(lower, -0.8, -0.6), between(lower, -0.6, -1.4)),
        (DVec3::new(-2400.0, -900.0, 4600.0), centre),
        (DVec3::new(2800.0, 800.0, 6800.0), centre),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn colours_tell_neighbours_apart() {
        let bits = |kind, index| colour(kind, index).map(f32::to_bits);
        let horizons: HashSet<_> = (0..11).map(|k| bits(SurfaceKind::Horizon, k)).collect();
        assert_eq!(horizons.len(), 11);
        for fault in 0..16 {
            let own = bits(SurfaceKind::Fault, fault);
            assert_ne!(own, bits(SurfaceKind::Fault, fault + 1));
            assert!(!horizons.contains(&own));
        }
        let any = colour(SurfaceKind::Horizon, usize::MAX);
        assert!(any.iter().all(|c| (0.0..=1.0).contains(c)));
    }
}
