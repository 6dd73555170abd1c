//! Wells of the model: thin tubes that start vertically and bend towards a target.

use super::Model;
use super::extent::{DEPTH, HALF, world};
use crate::random::{Random, Stream};
use antumbra_scene::Geometry;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Number of wells.
const WELLS: usize = 4;
/// Radius of the tubes in metres: much larger than that of a real well, which would be invisible.
const RADIUS: f64 = 9.0;
/// Vertices of a ring.
const SIDES: u32 = 8;
/// Rings of a well in the full model.
const RINGS: f64 = 80.0;
/// Distance between two points of the well path, in metres.
const STRIDE: f64 = 5.0;

/// A well.
#[derive(Debug, Clone, PartialEq)]
pub struct Well {
    /// Its name.
    pub name: String,
    /// World position of the geometry's origin: the head of the well.
    pub origin: DVec3,
    /// A closed tube, with normals.
    pub geometry: Geometry,
}

impl Model {
    /// Makes the four wells.
    #[must_use]
    pub fn wells(&self) -> Vec<Well> {
        let random = &mut Random::new(self.options.seed, Stream::Wells);
        (1..=WELLS)
            .map(|number| well(self, random, number))
            .collect()
    }
}

fn well(model: &Model, random: &mut Random, number: usize) -> Well {
    let towards = DVec2::from_angle(random.angle());
    let aside = DVec2::new(random.between(-0.25, 0.25), random.between(-0.25, 0.25));
    let head = HALF * aside - towards * 900.0;
    let lean = random.between(35.0, 58.0).to_radians();
    let [kick_off, build] = [random.between(350.0, 800.0), random.between(700.0, 1100.0)];
    let target = DEPTH * random.between(0.72, 0.88);

    // The path lies in one vertical plane: metres outwards and down.
    let mut way = vec![DVec2::ZERO];
    let mut drilled = 0.0;
    let mut bit = DVec2::ZERO;
    while bit.y < target {
        let share = ((drilled - kick_off) / build).clamp(0.0, 1.0);
        let angle = lean * share * share * (3.0 - 2.0 * share);
        bit += DVec2::new(angle.sin(), angle.cos()) * STRIDE;
        drilled += STRIDE;
        way.push(bit);
    }
    let rings = ((RINGS * model.options.relative_resolution()).round() as usize).max(6);
    let picked = (0..=rings).filter_map(|ring| way.get(ring * (way.len() - 1) / rings));
    let out = world(towards, 0.0);
    Well {
        name: format!("well {number}"),
        origin: world(head, 0.0),
        geometry: tube(&picked.copied().collect::<Vec<_>>(), out),
    }
}

/// A closed tube around a path in the vertical plane of `out`; points are metres outwards and down.
fn tube(way: &[DVec2], out: DVec3) -> Geometry {
    let at = |point: DVec2| out * point.x - DVec3::Y * point.y;
    let side = out.cross(DVec3::Y);
    let mut positions = Vec::new();
    for (ring, &point) in way.iter().enumerate() {
        let neighbour = |to: usize| way.get(to).copied().unwrap_or(point);
        let ahead =
            at(neighbour(ring + 1) - neighbour(ring.saturating_sub(1))).normalize_or(-DVec3::Y);
        let other = ahead.cross(side);
        positions.extend((0..SIDES).map(|corner| {
            let (sine, cosine) = (TAU * f64::from(corner) / f64::from(SIDES)).sin_cos();
            (at(point) + (side * cosine + other * sine) * RADIUS)
                .as_vec3()
                .to_array()
        }));
    }
    let ends = [way.first(), way.last()].map(|end| at(end.copied().unwrap_or_default()));
    positions.extend(ends.map(|end| end.as_vec3().to_array()));

    let last = (way.len() as u32).saturating_sub(1) * SIDES;
    let centre = last + SIDES;
    let next = |corner: u32| (corner + 1) % SIDES;
    let mut indices = Vec::new();
    for ring in (0..last).step_by(SIDES as usize) {
        for corner in 0..SIDES {
            let [a, b] = [ring + corner, ring + next(corner)];
            indices.extend([a, b, b + SIDES, a, b + SIDES, a + SIDES]);
        }
    }
    for corner in 0..SIDES {
        indices.extend([centre, next(corner), corner]);
        indices.extend([centre + 1, last + corner, last + next(corner)]);
    }
    let geometry = Geometry {
        positions,
        indices,
        ..Geometry::default()
    };
    geometry.with_computed_normals()
}
