//! Fields for tests.
#![allow(dead_code)]

pub mod truth;

use antumbra_demo_scenes::terrain::FractalOptions;
use antumbra_terrain::{Eye, Field, Terrain};
use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A number between 0 and 1.
pub fn number(chance: &mut Pcg32) -> f64 {
    f64::from(chance.next_u32()) / f64::from(u32::MAX)
}

/// Corners, middles of sides, and chance places of a triangle.
pub fn places(field: &Field, triangle: u32, chance: &mut Pcg32) -> Vec<DVec3> {
    let [a, b, c] = field.corners(triangle);
    let mut places = vec![a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    for _ in 0..3 {
        let [u, v] = [number(chance), number(chance)];
        let (u, v) = if u + v > 1.0 {
            (1.0 - u, 1.0 - v)
        } else {
            (u, v)
        };
        places.push(a + (b - a) * u + (c - a) * v);
    }
    places
}

/// The triangles that are not drawn.
pub fn culled(terrain: &Terrain, eye: &Eye<'_>) -> Vec<u32> {
    let groups = terrain.groups();
    let mut drawn = vec![false; groups.order().len()];
    let mut draw = |range: std::ops::Range<u32>| {
        for at in range {
            drawn[groups.order()[at as usize] as usize] = true;
        }
    };
    eye.each_seen(|group| draw(groups.groups()[group as usize].triangles.clone()));
    draw(groups.always());
    (0..drawn.len() as u32)
        .filter(|&triangle| !drawn[triangle as usize])
        .collect()
}

/// Heights of a fractal landscape, from 0 to 1, `2^order + 1` posts along a side.
pub fn fractal(order: u32, roughness: f64, seed: u64) -> Vec<Vec<f64>> {
    let options = FractalOptions {
        order,
        cell: 1.0,
        relief: 1.0,
        roughness,
        seed,
    };
    let raster = options.raster().unwrap();
    let rows = raster.elevation.chunks(raster.columns as usize);
    rows.map(|row| row.iter().map(|height| f64::from(*height)).collect())
        .collect()
}

/// A field over a regular grid of heights.
pub fn grid(heights: &[Vec<f64>], cell: f64, scale: f64) -> Field {
    let (rows, columns) = (heights.len(), heights[0].len());
    let points = (0..rows * columns).map(|i| {
        let (row, column) = (i / columns, i % columns);
        DVec3::new(
            column as f64 * cell,
            row as f64 * cell,
            heights[row][column] * scale,
        )
    });
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let at = |r: usize, c: usize| ((row + r) * columns + column + c) as u32;
            if (row + column) % 2 == 0 {
                triangles.extend([
                    [at(0, 0), at(0, 1), at(1, 1)],
                    [at(0, 0), at(1, 1), at(1, 0)],
                ]);
            } else {
                triangles.extend([
                    [at(0, 0), at(0, 1), at(1, 0)],
                    [at(0, 1), at(1, 1), at(1, 0)],
                ]);
            }
        }
    }
    Field::new(points.collect(), triangles).unwrap()
}

/// A fractal landscape with its vertices moved about in the plan, so that nothing is regular.
pub fn shaken(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    shake(&fractal(order, 0.55, seed), cell, scale, seed)
}

/// The same with ridges across it, behind which much is hidden.
pub fn ridged(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    shake(&ridges(order, seed), cell, scale, seed)
}

/// The same with a shore: it falls to nothing at its border.
pub fn island(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    let mut heights = ridges(order, seed);
    let last = heights.len() - 1;
    for (row, line) in heights.iter_mut().enumerate() {
        for (column, height) in line.iter_mut().enumerate() {
            let inland = row.min(column).min(last - row).min(last - column);
            *height *= (inland as f64 / 5.0).min(1.0);
        }
    }
    shake(&heights, cell, scale, seed)
}

/// Heights of ridges from west to east.
pub fn ridges(order: u32, seed: u64) -> Vec<Vec<f64>> {
    let mut heights = fractal(order, 0.55, seed);
    for (row, line) in heights.iter_mut().enumerate() {
        let ridge = 0.5 + 0.5 * (row as f64 * std::f64::consts::TAU / 11.0).cos();
        line.iter_mut()
            .for_each(|height| *height = 0.3 * *height + ridge);
    }
    heights
}

/// A field over a grid of heights with its inner vertices moved about in the plan.
fn shake(heights: &[Vec<f64>], cell: f64, scale: f64, seed: u64) -> Field {
    let regular = grid(heights, cell, scale);
    let mut chance = Pcg32::seed_from_u64(seed + 1);
    let [low, high] = regular.plan_bounds();
    let points = regular.points().iter().map(|&point| {
        let shift =
            DVec3::new(number(&mut chance) - 0.5, number(&mut chance) - 0.5, 0.0) * cell * 0.5;
        let inner = point.truncate().cmpgt(low).all() && point.truncate().cmplt(high).all();
        if inner { point + shift } else { point }
    });
    Field::new(points.collect(), regular.triangles().to_vec()).unwrap()
}
