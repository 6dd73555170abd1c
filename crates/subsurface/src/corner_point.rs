//! Corner-point grids: cells between slanted pillars.
//!
//! Each cell has eight corner heights of its own, so a fault is a step between neighbouring cells. Layers become
//! horizons, and a property of the cells becomes a volume.

mod layers;
mod resample;

use glam::DVec3;

pub use resample::{MAX_SAMPLES, PropertyVolume};

/// A corner-point grid. The first index increases along the first pillar direction (east, in a grid without
/// rotation), the second northwards, the third upwards.
#[derive(Debug, Clone, PartialEq)]
pub struct CornerPointGrid {
    size: [u32; 3],
    pillars: Vec<Pillar>,
    corners: Vec<[f32; 8]>,
    active: Vec<bool>,
}

/// The line through the corners of up to four columns of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pillar {
    pub(crate) bottom: DVec3,
    pub(crate) top: DVec3,
}

/// A property of the cells: one value per cell.
#[derive(Debug, Clone, PartialEq)]
pub struct CellProperty {
    /// A name for messages; may be empty.
    pub name: String,
    /// The number of cells along each axis.
    pub size: [u32; 3],
    /// The values, third index fastest, then the second. NaN means that there is no value.
    pub values: Vec<f32>,
}

impl CornerPointGrid {
    /// A grid of `size` cells. There is one more pillar than cells along each side, second index fastest. `corners`
    /// has eight heights per cell; the bits of a corner's index are east, north, top. The lengths of the lists must
    /// match `size`.
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

    /// The grid with all coordinates multiplied: those of the world's axes.
    #[cfg(feature = "read")]
    pub(crate) fn scaled(mut self, scale: DVec3) -> Self {
        if scale != DVec3::ONE {
            for pillar in &mut self.pillars {
                pillar.bottom *= scale;
                pillar.top *= scale;
            }
            for height in self.corners.as_flattened_mut() {
                *height = (f64::from(*height) * scale.y) as f32;
            }
        }
        self
    }

    /// The box around the ends of the pillars.
    #[cfg(feature = "read")]
    pub(crate) fn pillar_box(&self) -> [DVec3; 2] {
        let ends = self
            .pillars
            .iter()
            .flat_map(|pillar| [pillar.bottom, pillar.top]);
        let ends = ends.filter(|end| end.is_finite());
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        ends.fold(empty, |[low, high], end| [low.min(end), high.max(end)])
    }

    /// The number of cells along each axis.
    #[must_use]
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    /// Whether a cell is part of the model. Cells outside the grid are not.
    #[must_use]
    pub fn is_active(&self, cell: [u32; 3]) -> bool {
        let index = self.index(cell);
        index.is_some_and(|index| self.active.get(index).copied().unwrap_or_default())
    }

    /// The number of cells that are part of the model.
    #[must_use]
    pub fn active_cells(&self) -> usize {
        self.active.iter().filter(|active| **active).count()
    }

    /// The corners of a cell in the world. Bit 0 of a corner's index is east, bit 1 north, bit 2 top. `None` outside
    /// the grid, and for a cell with an invalid corner.
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
    /// The point of the pillar, or of its straight continuation, at this height. A pillar without length is vertical.
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
