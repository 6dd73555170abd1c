//! A cell property resampled to a regular grid.
//!
//! In the horizontal plane a cell is the quad halfway between its base and its top, split into two triangles. Over
//! each triangle, base and top are planes. A sample gets the value of the cell that contains it. Cells thinner than a
//! sample's step may be missed.

use glam::{DVec2, DVec3};

use super::{CellProperty, CornerPointGrid};
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::volume::{BrickSource, VolumeLayout};

/// The greatest number of samples, and bytes, of a [`PropertyVolume`]. The volume is held in memory.
pub const MAX_SAMPLES: u64 = 1 << 31;

/// Samples along an edge of a brick.
const BRICK: u32 = 32;

/// The greatest number of times that the cells may cover the horizontal plane, per layer. Cells that overlap more are
/// no grid.
const MAX_COVER: u64 = 64;

/// A cell property on a regular grid, in memory: one byte per sample, at most [`MAX_SAMPLES`].
#[derive(Debug, Clone, PartialEq)]
pub struct PropertyVolume {
    name: String,
    layout: VolumeLayout,
    samples: Vec<u8>,
}

impl PropertyVolume {
    /// The property's name; may be empty.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A sample; `None` outside the volume.
    #[must_use]
    pub fn sample(&self, at: [u32; 3]) -> Option<u8> {
        let inside = at.iter().zip(&self.layout.size).all(|(at, of)| at < of);
        let [i, j, k] = at.map(|index| index as usize);
        let [nx, ny, _] = self.layout.size.map(|side| side as usize);
        let index = inside.then_some(i + nx * (j + ny * k))?;
        self.samples.get(index).copied()
    }
}

impl BrickSource for PropertyVolume {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        self.layout.check_read(brick, samples)?;
        let edge = self.layout.brick;
        let at = |axis: usize, step: u32| {
            let sides = brick.get(axis).zip(self.layout.size.get(axis));
            sides.map_or(0, |(brick, size)| (brick * edge + step).min(size - 1))
        };
        let places = (0..edge).flat_map(|z| (0..edge).map(move |y| (y, z)));
        let places = places.flat_map(|(y, z)| (0..edge).map(move |x| (x, y, z)));
        for (sample, (x, y, z)) in samples.iter_mut().zip(places) {
            *sample = self
                .sample([at(0, x), at(1, y), at(2, z)])
                .unwrap_or_default();
        }
        Ok(())
    }
}

impl CornerPointGrid {
    /// Resamples a property to `size` samples. The inline axis points east, the crossline axis north, the third axis
    /// down. The samples span the box around the active cells, each in the centre of its share. The range is that of
    /// the active cells' values.
    ///
    /// Memory: one byte per sample, at most [`MAX_SAMPLES`].
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`] for a property of another grid, a size of zero or above the maximum, a grid
    /// without an active cell that has a value, and cells with excessive overlap.
    pub fn volume(
        &self,
        property: &CellProperty,
        size: [u32; 3],
        progress: ProgressFn<'_>,
    ) -> Result<PropertyVolume, SubsurfaceError> {
        let bad = |problem: String| SubsurfaceError::BadLayout { problem };
        if property.size != self.size || property.values.len() != self.corners.len() {
            return Err(bad(format!(
                "property `{}` has {:?} cells, but the grid has {:?}; give a property of this grid",
                property.name, property.size, self.size
            )));
        }
        let mut samples = size.iter().map(|&side| u64::from(side));
        let samples = samples.try_fold(1_u64, u64::checked_mul);
        let samples = samples.filter(|samples| (1..=MAX_SAMPLES).contains(samples));
        let samples = samples.ok_or_else(|| {
            bad(format!(
                "{size:?} samples; at least one along each axis and at most {MAX_SAMPLES} in all are possible"
            ))
        })?;
        let (layout, filled) = self.box_around(property, size).ok_or_else(|| {
            bad(format!(
                "no active cell has a value of property `{}`",
                property.name
            ))
        })?;
        layout.validate()?;
        let mut volume = PropertyVolume {
            name: property.name.clone(),
            layout,
            samples: Vec::new(),
        };
        let room = volume.samples.try_reserve_exact(samples as usize);
        room.map_err(|error| bad(format!("{samples} samples: {error}")))?;
        volume.samples.resize(samples as usize, 0);
        let plan = u64::from(size[0]) * u64::from(size[1]);
        // A cell's box in the plane is larger than the cell, by at least one sample on each side.
        let cover = plan * u64::from(self.size[2]) + 16 * filled + samples;
        let mut budget = cover.saturating_mul(MAX_COVER);
        for i in 0..self.size[0] {
            progress(u64::from(i), u64::from(self.size[0]));
            for (cell, value) in self.filled(property, i) {
                let byte = volume.byte(value);
                let spent = self.corners(cell).map_or(Some(0), |corners| {
                    Prism::of(&corners, &layout).fill(byte, &mut volume, budget)
                });
                let Some(spent) = spent else {
                    return Err(bad(format!(
                        "the cells cover the plan more than {MAX_COVER} times per layer; they do not form a grid"
                    )));
                };
                budget -= spent;
            }
        }
        progress(u64::from(self.size[0]), u64::from(self.size[0]));
        Ok(volume)
    }

    /// The active cells with a value in one row of columns, and their values.
    fn filled<'a>(
        &'a self,
        property: &'a CellProperty,
        i: u32,
    ) -> impl Iterator<Item = ([u32; 3], f32)> + 'a {
        let [_, ny, nz] = self.size;
        let cells = (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k]));
        cells.filter_map(|cell| {
            let value = property.values.get(self.index(cell)?).copied()?;
            (self.is_active(cell) && value.is_finite()).then_some((cell, value))
        })
    }

    fn box_around(&self, property: &CellProperty, size: [u32; 3]) -> Option<(VolumeLayout, u64)> {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut least, mut most, mut filled) = (f32::INFINITY, f32::NEG_INFINITY, 0);
        for (cell, value) in (0..self.size[0]).flat_map(|i| self.filled(property, i)) {
            for corner in self.corners(cell).into_iter().flatten() {
                (low, high) = (low.min(corner), high.max(corner));
            }
            (least, most) = (least.min(value), most.max(value));
            filled += 1;
        }
        if !low.is_finite() || !high.is_finite() {
            return None;
        }
        // A range must not be empty. If all values are equal, it is extended by an amount that f32 can represent.
        if least == most {
            most += most.abs().max(1.0);
        }
        // A flat box gets a small height.
        let extent = (high - low).max(DVec3::splat(1e-3));
        let [east, north, down] = size.map(f64::from);
        let step = DVec3::new(extent.x / east, extent.y / down, extent.z / north);
        let layout = VolumeLayout {
            size,
            brick: BRICK,
            origin: DVec3::new(low.x, high.y, high.z) + step * DVec3::new(0.5, -0.5, -0.5),
            steps: [
                DVec3::X * step.x,
                DVec3::NEG_Z * step.z,
                DVec3::NEG_Y * step.y,
            ],
            range: [least, most],
        };
        Some((layout, filled))
    }
}

impl PropertyVolume {
    /// The byte for a value within the range.
    fn byte(&self, value: f32) -> u8 {
        let [low, high] = self.layout.range.map(f64::from);
        let share = (f64::from(value) - low) / (high - low);
        1 + (share * 254.0).round().clamp(0.0, 254.0) as u8
    }

    fn fill(&mut self, [i, j]: [u32; 2], depths: [u32; 2], byte: u8) {
        let [nx, ny, _] = self.layout.size.map(|side| side as usize);
        let column = i as usize + nx * j as usize;
        for k in depths[0]..depths[1] {
            if let Some(sample) = self.samples.get_mut(column + nx * ny * k as usize) {
                *sample = byte;
            }
        }
    }
}

/// A cell in units of samples: its corners in the horizontal plane, and the depths of its top and its base there.
struct Prism {
    plan: [DVec2; 4],
    top: [f64; 4],
    base: [f64; 4],
}

/// The two triangles of a quad with corners south-west, south-east, north-west, north-east.
const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 3], [0, 3, 2]];

/// The fraction of a step within which a sample on a border belongs to both sides.
const SLACK: f64 = 1e-9;

impl Prism {
    fn of(corners: &[DVec3; 8], layout: &VolumeLayout) -> Self {
        let [east, north, down] = layout.steps.map(DVec3::length);
        let measured = corners.map(|corner| {
            let from = corner - layout.origin;
            DVec3::new(from.x / east, -from.z / north, -from.y / down)
        });
        let [b0, b1, b2, b3, t0, t1, t2, t3] = measured;
        let (base, top) = ([b0, b1, b2, b3], [t0, t1, t2, t3]);
        let middle = |corner: usize| ((base[corner] + top[corner]) * 0.5).truncate();
        Self {
            plan: [middle(0), middle(1), middle(2), middle(3)],
            top: top.map(|corner| corner.z),
            base: base.map(|corner| corner.z),
        }
    }

    /// Fills the samples inside the cell. Returns the number of samples visited, or `None` if they are more than
    /// `budget`.
    fn fill(&self, byte: u8, volume: &mut PropertyVolume, budget: u64) -> Option<u64> {
        let [east, north, deep] = volume.layout.size;
        let mut spent = 0;
        for corners in TRIANGLES {
            let [a, b, c] = corners.map(|corner| self.plan[corner]);
            let area = (b - a).perp_dot(c - a);
            if area == 0.0 || !area.is_finite() {
                continue;
            }
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let [i0, i1] = range(low.x, high.x, east);
            let [j0, j1] = range(low.y, high.y, north);
            spent += u64::from(i1.saturating_sub(i0)) * u64::from(j1.saturating_sub(j0));
            if spent > budget {
                return None;
            }
            for (i, j) in (i0..i1).flat_map(|i| (j0..j1).map(move |j| (i, j))) {
                let at = DVec2::new(f64::from(i), f64::from(j));
                let shares = [
                    (c - b).perp_dot(at - b) / area,
                    (a - c).perp_dot(at - c) / area,
                    (b - a).perp_dot(at - a) / area,
                ];
                if shares.iter().any(|share| *share < -SLACK) {
                    continue;
                }
                let mixed = |depths: &[f64; 4]| {
                    let three = corners.map(|corner| depths[corner]);
                    three.iter().zip(shares).map(|(z, share)| z * share).sum()
                };
                let (top, base): (f64, f64) = (mixed(&self.top), mixed(&self.base));
                let depths = range(top.min(base), top.max(base), deep);
                spent += u64::from(depths[1].saturating_sub(depths[0]));
                volume.fill([i, j], depths, byte);
            }
        }
        (spent <= budget).then_some(spent)
    }
}

/// The half-open range of samples between two positions, both included.
fn range(low: f64, high: f64, samples: u32) -> [u32; 2] {
    let most = f64::from(samples);
    let start = (low - SLACK).ceil().clamp(0.0, most) as u32;
    let end = ((high + SLACK).floor() + 1.0).clamp(0.0, most) as u32;
    [start, end]
}
