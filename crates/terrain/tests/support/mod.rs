//! Fields for tests.
#![allow(dead_code)]

pub mod brute_force;

use antumbra_demo_scenes::terrain::FractalOptions;
use antumbra_terrain::{Field, Observer, Terrain};
use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A random number from 0 to 1.
pub fn number(rng: &mut Pcg32) -> f64 {
    f64::from(rng.next_u32()) / f64::from(u32::MAX)
}

/// The corners, the middles of the sides, and three random points of a triangle.
pub fn points(field: &Field, triangle: u32, rng: &mut Pcg32) -> Vec<DVec3> {
    let [a, b, c] = field.corners(triangle);
    let mut points = vec![a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    for _ in 0..3 {
        let [u, v] = [number(rng), number(rng)];
        let (u, v) = if u + v > 1.0 {
            (1.0 - u, 1.0 - v)
        } else {
            (u, v)
        };
        points.push(a + (b - a) * u + (c - a) * v);
    }
    points
}

/// The triangles that are not drawn for an observer.
pub fn culled(terrain: &Terrain, observer: &Observer<'_>) -> Vec<u32> {
    let groups = terrain.groups();
    let mut drawn = vec![false; groups.order().len()];
    let mut draw = |range: std::ops::Range<u32>| {
        for at in range {
            drawn[groups.order()[at as usize] as usize] = true;
        }
    };
    observer.each_visible(|group| draw(groups.groups()[group as usize].triangles.clone()));
    draw(groups.ungrouped());
    (0..drawn.len() as u32)
        .filter(|&triangle| !drawn[triangle as usize])
        .collect()
}

/// Heights of a fractal landscape, from 0 to 1, with `2^order + 1` posts on a side.
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

/// A field over a regular grid of heights, `cell` metres apart and `scale` metres high.
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

/// A fractal landscape with vertices displaced in the plan, so that nothing is regular.
pub fn shaken(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    displaced(&fractal(order, 0.55, seed), cell, scale, seed)
}

/// The same with ridges across it, which hide much.
pub fn ridged(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    displaced(&ridges(order, seed), cell, scale, seed)
}

/// The same with a shore: its height falls to 0 at the boundary.
pub fn island(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    let mut heights = ridges(order, seed);
    let last = heights.len() - 1;
    for (row, line) in heights.iter_mut().enumerate() {
        for (column, height) in line.iter_mut().enumerate() {
            let inland = row.min(column).min(last - row).min(last - column);
            *height *= (inland as f64 / 5.0).min(1.0);
        }
    }
    displaced(&heights, cell, scale, seed)
}

/// Heights of ridges that run from west to east.
pub fn ridges(order: u32, seed: u64) -> Vec<Vec<f64>> {
    let mut heights = fractal(order, 0.55, seed);
    for (row, line) in heights.iter_mut().enumerate() {
        let ridge = 0.5 + 0.5 * (row as f64 * std::f64::consts::TAU / 11.0).cos();
        line.iter_mut()
            .for_each(|height| *height = 0.3 * *height + ridge);
    }
    heights
}

/// A field over a grid of heights with its inner vertices displaced in the plan.
fn displaced(heights: &[Vec<f64>], cell: f64, scale: f64, seed: u64) -> Field {
    let regular = grid(heights, cell, scale);
    let mut rng = Pcg32::seed_from_u64(seed + 1);
    let [low, high] = regular.plan_bounds();
    let points = regular.points().iter().map(|&point| {
        let shift = DVec3::new(number(&mut rng) - 0.5, number(&mut rng) - 0.5, 0.0) * cell * 0.5;
        let inner = point.truncate().cmpgt(low).all() && point.truncate().cmplt(high).all();
        if inner { point + shift } else { point }
    });
    Field::new(points.collect(), regular.triangles().to_vec()).unwrap()
}
