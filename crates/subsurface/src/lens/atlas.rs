//! A texture atlas of the sections of a stack.

use std::ops::Range;

use antumbra_scene::Image;

use crate::image::clamped_image;
use crate::volume::Axis;

/// A stack may have this many times fewer sections than its box has samples. A box that needs still fewer loses
/// samples in the plane as well.
const UNEVEN: u32 = 4;

/// The samples of a box that are in an image, and their places.
#[derive(Debug)]
pub(super) struct Atlas {
    axis: Axis,
    /// The kept samples along each of the box's axes, counted from its first.
    kept: [Vec<u32>; 3],
    /// The number of sections side by side.
    columns: u32,
    /// The width and height of the image in pixels.
    size: [u32; 2],
}

/// The samples of a brick.
pub(super) struct BrickSamples<'a> {
    pub(super) brick: [u32; 3],
    /// Samples along an edge.
    pub(super) edge: u32,
    pub(super) samples: &'a [u8],
}

impl Atlas {
    /// An atlas for the sections along `axis` of a box with this many samples, in an image no longer than `side`.
    pub(super) fn new(axis: Axis, samples: [u32; 3], side: u32) -> Self {
        let count = axis.of(samples);
        let plane = axis.plane().map(|along| along.of(samples));
        // Every n-th sample in the plane is kept, with the first n that fits.
        let mut every = 1;
        let ([right, down], room) = loop {
            let [right, down] = plane.map(|samples| samples.div_ceil(every));
            // At most 2^28.
            let room = (side / right) * (side / down);
            if room >= count.div_ceil(every.saturating_mul(UNEVEN)) {
                break ([right, down], room);
            }
            every += 1;
        };
        let sections = count.min(room);
        let columns = (side / right).min(sections);
        let pick = |(samples, kept): (u32, u32)| -> Vec<u32> {
            (0..kept).map(|i| spread(i, kept, samples)).collect()
        };
        Self {
            axis,
            kept: axis
                .place((count, sections), [(plane[0], right), (plane[1], down)])
                .map(pick),
            columns,
            size: [columns * right, sections.div_ceil(columns) * down],
        }
    }

    /// The axis along which the sections follow each other.
    pub(super) fn axis(&self) -> Axis {
        self.axis
    }

    /// The sections in the image, as sample indices from the box's first.
    pub(super) fn sections(&self) -> &[u32] {
        self.kept_along(self.axis)
    }

    fn kept_along(&self, axis: Axis) -> &[u32] {
        axis.of(self.kept.each_ref()).as_slice()
    }

    /// The mean number of samples between two sections.
    pub(super) fn spacing(&self) -> f64 {
        let sections = self.sections();
        let (last, steps) = (sections.last().copied(), sections.len() - 1);
        last.filter(|_| steps > 0)
            .map_or(1.0, |last| f64::from(last) / steps as f64)
    }

    /// The texture coordinates of a section's first and last sample.
    pub(super) fn corners(&self, section: usize) -> [[f32; 2]; 2] {
        let corner = self.corner(section as u32);
        let cell = self.cell();
        [0, 1].map(|end| {
            std::array::from_fn(|i| {
                let pixel = corner[i] + end * (cell[i] - 1);
                ((f64::from(pixel) + 0.5) / f64::from(self.size[i])) as f32
            })
        })
    }

    /// Transparent pixels for the whole image.
    pub(super) fn blank(&self) -> Vec<[u8; 4]> {
        let [width, height] = self.size.map(|side| side as usize);
        vec![[0; 4]; width * height]
    }

    /// An image with these pixels.
    pub(super) fn image(&self, pixels: Vec<[u8; 4]>) -> Image {
        clamped_image(self.size, pixels.into_flattened())
    }

    /// Writes the samples of a brick that are in the box into the image. `min` is the box's first sample.
    pub(super) fn fill(
        &self,
        pixels: &mut [[u8; 4]],
        colours: &[[u8; 4]; 256],
        min: [u32; 3],
        brick: &BrickSamples<'_>,
    ) {
        let BrickSamples {
            brick,
            edge,
            samples,
        } = *brick;
        let [right, down] = self.axis.plane();
        let strides = [1, edge as usize, (edge as usize).pow(2)];
        // The kept samples along an axis that are in this brick: their numbers among the kept ones, and their offsets
        // in the brick.
        let held = |axis: Axis| -> (Range<usize>, Vec<usize>) {
            let kept = self.kept_along(axis);
            let (min, start) = (axis.of(min), axis.of(brick) * edge);
            let from = kept.partition_point(|at| min + at < start);
            let until = kept.partition_point(|at| min + at < start + edge);
            let offset = |at: &u32| (min + at - start) as usize * axis.of(strides);
            (from..until, kept[from..until].iter().map(offset).collect())
        };
        let (sections, section_offsets) = held(self.axis);
        let (columns, column_offsets) = held(right);
        let (rows, row_offsets) = held(down);
        let width = self.size[0] as usize;
        for (section, section_offset) in sections.zip(&section_offsets) {
            let [left, top] = self.corner(section as u32).map(|at| at as usize);
            for (row, row_offset) in rows.clone().zip(&row_offsets) {
                let start = (top + row) * width + left;
                let into = &mut pixels[start + columns.start..start + columns.end];
                let base = section_offset + row_offset;
                for (pixel, offset) in into.iter_mut().zip(&column_offsets) {
                    *pixel = colours[usize::from(samples[base + offset])];
                }
            }
        }
    }

    /// The width and height of a section in pixels.
    fn cell(&self) -> [u32; 2] {
        // No longer than the image.
        (self.axis.plane()).map(|along| self.kept_along(along).len() as u32)
    }

    /// A section's upper left pixel.
    fn corner(&self, section: u32) -> [u32; 2] {
        let [width, height] = self.cell();
        let (column, row) = (section % self.columns, section / self.columns);
        [column * width, row * height]
    }
}

/// The `i`-th of `kept` samples out of `count`: the first and the last, and others evenly between.
fn spread(i: u32, kept: u32, count: u32) -> u32 {
    let (i, steps, last) = (u64::from(i), u64::from(kept - 1), u64::from(count - 1));
    if steps == 0 {
        return (last / 2) as u32;
    }
    // No more than `last`.
    ((2 * i * last + steps) / (2 * steps)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn an_atlas_fits_and_keeps_both_ends(samples in [1u32..3000, 1u32..3000, 1u32..3000], side in 64u32..4096) {
            for axis in Axis::ALL {
                let atlas = Atlas::new(axis, samples, side);
                prop_assert!(atlas.size.iter().all(|pixels| (1..=side).contains(pixels)), "{:?}", atlas.size);
                for (kept, samples) in atlas.kept.iter().zip(samples) {
                    prop_assert!(kept.is_sorted_by(|a, b| a < b));
                    if kept.len() > 1 {
                        prop_assert_eq!([kept[0], kept[kept.len() - 1]], [0, samples - 1]);
                    }
                }
                // Every section is within the image, including the lower right pixel of the last one.
                let last = atlas.sections().len() as u32 - 1;
                let ([left, top], [width, height]) = (atlas.corner(last), atlas.cell());
                prop_assert!(left + width <= atlas.size[0] && top + height <= atlas.size[1]);
            }
        }
    }

    #[test]
    fn what_fits_is_kept_whole_and_what_does_not_is_thinned_evenly() {
        let whole = Atlas::new(Axis::Time, [256; 3], 4096);
        assert_eq!(whole.size, [4096; 2]);
        assert!(whole.kept.iter().all(|kept| kept.len() == 256));
        assert_eq!(whole.spacing(), 1.0);

        let large = Atlas::new(Axis::Time, [500; 3], 4096);
        let lengths: Vec<_> = large.kept.iter().map(Vec::len).collect();
        assert_eq!(lengths, [250, 250, 256]);
        assert!((large.spacing() - 499.0 / 255.0).abs() < 1e-12);
    }
}
