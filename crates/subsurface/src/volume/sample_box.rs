//! Boxes of samples.

use super::axis::Axis;
use super::layout::VolumeLayout;
use crate::error::SubsurfaceError;

/// A box of samples, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SampleBox {
    /// The first sample along each axis.
    pub min: [u32; 3],
    /// The last sample along each axis.
    pub max: [u32; 3],
}

impl SampleBox {
    /// The number of samples along each axis; 0 where the box is empty.
    #[must_use]
    pub fn samples(&self) -> [u32; 3] {
        Axis::ALL.map(|axis| {
            let (first, last) = (axis.of(self.min), axis.of(self.max));
            last.checked_sub(first)
                .map_or(0, |steps| steps.saturating_add(1))
        })
    }

    /// Refuses a box that is empty or not within a volume. `what` names the box in the error.
    ///
    /// # Errors
    /// [`SubsurfaceError::Empty`] and [`SubsurfaceError::Outside`], with the axis.
    pub fn check(&self, what: &str, layout: &VolumeLayout) -> Result<(), SubsurfaceError> {
        for axis in Axis::ALL {
            let (first, last) = (axis.of(self.min), axis.of(self.max));
            if first > last {
                let what = what.into();
                return Err(SubsurfaceError::Empty {
                    what,
                    axis,
                    first,
                    last,
                });
            }
            let size = axis.of(layout.size);
            if last >= size {
                return Err(SubsurfaceError::Outside {
                    what: what.into(),
                    axis,
                    asked: [first, last],
                    last: size.saturating_sub(1),
                });
            }
        }
        Ok(())
    }

    /// The bricks that contain the box's samples, the inline axis fastest.
    pub fn bricks(&self, layout: &VolumeLayout) -> impl Iterator<Item = [u32; 3]> + use<> {
        let [x, y, z] = Axis::ALL.map(|axis| {
            let [first, last] = [self.min, self.max].map(|end| axis.of(layout.brick_of(end)));
            first..=last
        });
        z.flat_map(move |z| {
            let x = x.clone();
            (y.clone()).flat_map(move |y| x.clone().map(move |x| [x, y, z]))
        })
    }
}
