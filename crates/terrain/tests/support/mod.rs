//! Fields for tests.
#![allow(dead_code)]

use antumbra_terrain::Field;
use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A number between 0 and 1.
pub fn number(chance: &mut Pcg32) -> f64 {
    f64::from(chance.next_u32()) / f64::from(u32::MAX)
}

/// Heights of a fractal landscape, `2^order + 1` posts along a side, by midpoint displacement.
pub fn fractal(order: u32, roughness: f64, seed: u64) -> Vec<Vec<f64>> {
    let side = (1_usize << order) + 1;
    let mut chance = Pcg32::seed_from_u64(seed);
    let mut heights = vec![vec![0.0; side]; side];
    let mut step = side - 1;
    let mut swing = 1.0;
    while step > 1 {
        let half = step / 2;
        for odd in [true, false] {
            for row in (0..side).step_by(half) {
                for column in (0..side).step_by(half) {
                    let (r, c) = ((row / half) % 2, (column / half) % 2);
                    let wanted = if odd { r == 1 && c == 1 } else { r + c == 1 };
                    if !wanted {
                        continue;
                    }
                    let around: [(isize, isize); 4] = if odd {
                        [(-1, -1), (-1, 1), (1, -1), (1, 1)]
                    } else {
                        [(-1, 0), (0, -1), (0, 1), (1, 0)]
                    };
                    let known: Vec<f64> = around
                        .iter()
                        .filter_map(|(dr, dc)| {
                            let row = row.checked_add_signed(dr * half as isize)?;
                            let column = column.checked_add_signed(dc * half as isize)?;
                            heights.get(row)?.get(column).copied()
                        })
                        .collect();
                    let mean = known.iter().sum::<f64>() / known.len() as f64;
                    heights[row][column] = mean + swing * (number(&mut chance) - 0.5);
                }
            }
        }
        step = half;
        swing *= roughness;
    }
    heights
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

/// The same with its vertices moved about in the plan, so that nothing is regular.
pub fn shaken(order: u32, cell: f64, scale: f64, seed: u64) -> Field {
    let heights = fractal(order, 0.55, seed);
    let regular = grid(&heights, cell, scale);
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
