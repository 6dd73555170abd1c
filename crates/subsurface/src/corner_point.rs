//! Corner-point grids: cells between slanted pillars, each with eight heights of its own, so that a fault is a step between
//! neighbours. Layers become horizons, and what fills the cells a volume.

mod layers;
mod resample;

use glam::DVec3;

pub use resample::{MAX_SAMPLES, PropertyVolume};

/// Cells between pillars. The first index grows along the pillars' first one (east, in a grid that is not turned), the second northwards,
/// the third upwards.
#[derive(Debug, Clone, PartialEq)]
pub struct CornerPointGrid {
    size: [u32; 3],
    pillars: Vec<Pillar>,
    corners: Vec<[f32; 8]>,
    active: Vec<bool>,
}

/// The line on which the corners of up to four columns of cells lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pillar {
    pub(crate) bottom: DVec3,
    pub(crate) top: DVec3,
}

/// A value a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct CellProperty {
    /// For people; may be empty.
    pub name: String,
    /// Cells along each axis.
    pub size: [u32; 3],
    /// The third index fastest, then the second; NaN where there is none.
    pub values: Vec<f32>,
}

impl CornerPointGrid {
    /// A pillar more than cells along each side, second index fastest; heights a cell, corner bits east, north, top. The lists must fit
    /// the size.
    #[cfg(feature = "read")]
    pub(crate) fn new(
        size: [u32; 3],
        pillars: Vec<Pillar>,
        corners: Vec<[f32; 8]>,
        active: Vec<bool>,
    ) -> Self {
        Self {
            size,
            pillars,
            corners,
            active,
        }
    }

    /// Cells along each axis.
    #[must_use]
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    /// Whether a cell is part of the model. There is none outside.
    #[must_use]
    pub fn is_active(&self, cell: [u32; 3]) -> bool {
        let index = self.index(cell);
        index.is_some_and(|index| self.active.get(index).copied().unwrap_or_default())
    }

    /// Cells that are part of the model.
    #[must_use]
    pub fn active_cells(&self) -> usize {
        self.active.iter().filter(|active| **active).count()
    }

    /// The corners of a cell in the world: bit 0 of a corner's number is east, bit 1 north, bit 2 top. `None` outside the grid, and for a
    /// cell with a corner at no place on Earth.
    #[must_use]
    pub fn corners(&self, cell: [u32; 3]) -> Option<[DVec3; 8]> {
        let heights = self.corners.get(self.index(cell)?)?;
        let [i, j, _] = cell.map(|index| index as usize);
        let rows = self.size[1] as usize + 1;
        let mut corners = [DVec3::ZERO; 8];
        for ((number, corner), &height) in corners.iter_mut().enumerate().zip(heights) {
            let (east, north) = (number & 1, number >> 1 & 1);
            let pillar = self.pillars.get((i + east) * rows + j + north)?;
            *corner = pillar.at(f64::from(height))?;
        }
        Some(corners)
    }

    fn index(&self, cell: [u32; 3]) -> Option<usize> {
        let inside = cell.iter().zip(&self.size).all(|(at, of)| at < of);
        let [i, j, k] = cell.map(|index| index as usize);
        let [_, ny, nz] = self.size.map(|side| side as usize);
        inside.then_some((i * ny + j) * nz + k)
    }
}

impl Pillar {
    /// Where the pillar, or its straight continuation, has that height. A pillar without length stands upright.
    fn at(&self, height: f64) -> Option<DVec3> {
        let rise = self.top.y - self.bottom.y;
        let share = if rise == 0.0 {
            0.0
        } else {
            (height - self.bottom.y) / rise
        };
        let mut place = self.bottom.lerp(self.top, share);
        place.y = height;
        crate::assemble::is_place(place).then_some(place)
    }
}
