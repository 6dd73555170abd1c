//! A fractal landscape by midpoint displacement on a square grid. Fournier, Fussell, Carpenter, *Computer Rendering
//! of Stochastic Models*, 1982.

use antumbra_scene::Raster;
use glam::DVec2;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use antumbra_terrain::TerrainError;

/// Options of the fractal landscape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FractalOptions {
    /// The raster has `2^order + 1` posts along a side; 1 to 13.
    pub order: u32,
    /// Distance between neighbouring posts, in metres.
    pub cell: f64,
    /// Height difference between the lowest and the highest post, in metres.
    pub relief: f64,
    /// Amplitude of each level relative to the level before it, between 0 and 1: 0.5 is smooth, 0.7 rugged.
    pub roughness: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for FractalOptions {
    /// 1,025 x 1,025 posts, 30 m apart, with 1,500 m of relief: the size of the thesis's Mt. Tiefort.
    fn default() -> Self {
        Self {
            order: 10,
            cell: 30.0,
            relief: 1500.0,
            roughness: 0.5,
            seed: 42,
        }
    }
}

impl FractalOptions {
    /// Makes the height field.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for an order outside 1 to 13, a cell size or relief that is not a positive length up
    /// to 100 km, and a roughness that is not between 0 and 1.
    pub fn raster(&self) -> Result<Raster, TerrainError> {
        self.check()?;
        let side = (1_usize << self.order) + 1;
        let mut heights = vec![0.0; side * side];
        let mut random = Pcg32::seed_from_u64(self.seed);
        let mut swing = 1.0;
        let mut number =
            |swing: f64| swing * (f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5);
        for corner in [0, side - 1, side * (side - 1), side * side - 1] {
            heights[corner] = number(swing);
        }
        let mut step = side - 1;
        while step > 1 {
            let half = step / 2;
            // First the centres of squares, from their corners; then the centres of sides, from their neighbours.
            for row in (half..side).step_by(step) {
                for column in (half..side).step_by(step) {
                    let around = [(half, half), (half, 0), (0, half), (0, 0)];
                    let sum: f64 = around
                        .iter()
                        .map(|(v, u)| heights[(row - half + 2 * v) * side + column - half + 2 * u])
                        .sum();
                    heights[row * side + column] = sum / 4.0 + number(swing);
                }
            }
            for row in (0..side).step_by(half) {
                let first = if (row / half).is_multiple_of(2) {
                    half
                } else {
                    0
                };
                for column in (first..side).step_by(step) {
                    let place = |row: Option<usize>, column: Option<usize>| {
                        let (row, column) = (row?, column?);
                        (row < side && column < side).then(|| heights[row * side + column])
                    };
                    let around = [
                        place(row.checked_sub(half), Some(column)),
                        place(Some(row + half), Some(column)),
                        place(Some(row), column.checked_sub(half)),
                        place(Some(row), Some(column + half)),
                    ];
                    let known = around.iter().flatten();
                    let (sum, count) = known.fold((0.0, 0.0), |(sum, count), height| {
                        (sum + height, count + 1.0)
                    });
                    heights[row * side + column] = sum / count + number(swing);
                }
            }
            step = half;
            swing *= self.roughness;
        }
        Ok(self.scaled(&heights, side as u32))
    }

    fn scaled(&self, heights: &[f64], side: u32) -> Raster {
        let (low, high) = heights.iter().fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(low, high), &height| (low.min(height), high.max(height)),
        );
        let scale = self.relief / (high - low).max(f64::MIN_POSITIVE);
        Raster {
            columns: side,
            rows: side,
            origin: DVec2::ZERO,
            step_u: DVec2::new(self.cell, 0.0),
            step_v: DVec2::new(0.0, self.cell),
            elevation: heights
                .iter()
                .map(|height| ((height - low) * scale) as f32)
                .collect(),
        }
    }

    fn check(&self) -> Result<(), TerrainError> {
        let refuse = |what, value: String, problem| {
            Err(TerrainError::Setting {
                what,
                value,
                problem,
            })
        };
        if !(1..=13).contains(&self.order) {
            return refuse("the order", self.order.to_string(), "give 1 to 13");
        }
        for (what, length) in [("the cell", self.cell), ("the relief", self.relief)] {
            if !(length > 0.0 && length <= 1e5) {
                let value = length.to_string();
                return refuse(what, value, "give metres, more than 0 and at most 100,000");
            }
        }
        if !(self.roughness > 0.0 && self.roughness < 1.0) {
            let value = self.roughness.to_string();
            return refuse("the roughness", value, "give a number between 0 and 1");
        }
        Ok(())
    }
}
