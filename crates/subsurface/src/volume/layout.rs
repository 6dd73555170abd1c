//! The layout of a volume: its size, its place in the world, and the meaning of its samples.

use glam::{DMat3, DVec3};

use super::axis::Axis;
use crate::error::SubsurfaceError;

/// The layout of a volume: its size, its position, and the meaning of its samples.
///
/// A sample is a byte: 0 where no value is known, otherwise 1..=255 from the lower to the upper end of `range`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeLayout {
    /// Samples along the inline, crossline and time (or depth) axis.
    pub size: [u32; 3],
    /// Samples along an edge of a brick.
    pub brick: u32,
    /// The position of sample (0, 0, 0) in the world, in metres.
    pub origin: DVec3,
    /// The step to the next sample along each axis, in metres.
    pub steps: [DVec3; 3],
    /// The values of samples 1 and 255.
    pub range: [f32; 2],
}

impl VolumeLayout {
    /// The greatest number of samples along an axis.
    pub const MAX_SAMPLES: u32 = 1 << 20;
    /// The greatest number of samples along an edge of a brick.
    pub const MAX_BRICK_EDGE: u32 = 256;
    /// The greatest absolute coordinate of a position or a step, in metres.
    pub const MAX_COORDINATE: f64 = 1e12;

    /// The number of bricks along each axis.
    #[must_use]
    pub fn bricks(&self) -> [u32; 3] {
        self.size.map(|side| side.div_ceil(self.brick.max(1)))
    }

    /// The number of samples, and bytes, of a brick.
    #[must_use]
    pub fn brick_bytes(&self) -> usize {
        (self.brick as usize).saturating_pow(3)
    }

    /// The number of bytes of all bricks; `None` if it exceeds 64 bits.
    #[must_use]
    pub fn total_bytes(&self) -> Option<u64> {
        let [x, y, z] = self.bricks().map(u64::from);
        let bricks = x.checked_mul(y)?.checked_mul(z)?;
        bricks.checked_mul(u64::from(self.brick).checked_pow(3)?)
    }

    /// The brick that contains a sample.
    #[must_use]
    pub fn brick_of(&self, sample: [u32; 3]) -> [u32; 3] {
        sample.map(|at| at / self.brick.max(1))
    }

    /// The position in the world, in metres, of a position in samples.
    #[must_use]
    pub fn position(&self, place: DVec3) -> DVec3 {
        let [x, y, z] = self.steps;
        self.origin + DMat3::from_cols(x, y, z) * place
    }

    /// The value of a sample; `None` where no value is known.
    #[must_use]
    pub fn value(&self, sample: u8) -> Option<f32> {
        let [low, high] = self.range;
        let part = f32::from(sample.checked_sub(1)?) / 254.0;
        Some(low + (high - low) * part)
    }

    /// A description of the first invalid number; `None` if the layout is valid.
    #[must_use]
    pub fn problem(&self) -> Option<String> {
        for axis in Axis::ALL {
            let size = axis.of(self.size);
            if size == 0 || size > Self::MAX_SAMPLES {
                let most = Self::MAX_SAMPLES;
                return Some(format!("{size} samples {axis}: 1 to {most} are possible"));
            }
        }
        if self.brick == 0 || self.brick > Self::MAX_BRICK_EDGE {
            return Some(format!(
                "bricks of {} samples an edge: 1 to {} are possible",
                self.brick,
                Self::MAX_BRICK_EDGE
            ));
        }
        if (self.total_bytes()).is_none_or(|bytes| isize::try_from(bytes).is_err()) {
            return Some("more bytes than this machine can address".into());
        }
        let steps = self.steps.map(|step| ("a step", step));
        let corner = self.position(DVec3::from(self.size.map(f64::from)));
        let places = [("an origin", self.origin), ("a far corner", corner)];
        let numbers = (steps.into_iter().chain(places))
            .flat_map(|(what, place)| place.to_array().map(|number| (what, number)));
        let far = |number: f64| number.is_nan() || number.abs() > Self::MAX_COORDINATE;
        if let Some((what, number)) = numbers.into_iter().find(|(_, number)| far(*number)) {
            let most = Self::MAX_COORDINATE;
            return Some(format!(
                "{what} with {number:e} m: finite numbers up to {most:e} m are possible"
            ));
        }
        let [x, y, z] = self.steps.map(DVec3::normalize_or_zero);
        if x.cross(y).dot(z).abs() < 1e-6 {
            let [x, y, z] = self.steps;
            return Some(format!(
                "steps of {x}, {y} and {z} do not span space: none may be zero or lie in the plane of the others"
            ));
        }
        let [low, high] = self.range;
        if !(low < high && (high - low).is_finite()) {
            return Some(format!(
                "a range from {low} to {high}: it must be finite and rise"
            ));
        }
        None
    }

    /// Refuses an invalid layout.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`], as found by [`Self::problem`].
    pub fn validate(&self) -> Result<(), SubsurfaceError> {
        (self.problem()).map_or(Ok(()), |problem| {
            Err(SubsurfaceError::BadLayout { problem })
        })
    }

    /// Refuses the layout of another volume.
    pub(crate) fn same_as(&self, other: &Self) -> Result<(), SubsurfaceError> {
        if self == other {
            return Ok(());
        }
        Err(SubsurfaceError::OtherVolume {
            expected: self.size,
            actual: other.size,
        })
    }

    /// The index of a brick among all, the inline axis fastest, then crossline, then time.
    pub(super) fn rank(&self, brick: [u32; 3]) -> Result<u64, SubsurfaceError> {
        let bricks = self.bricks();
        if brick.iter().zip(&bricks).any(|(at, end)| at >= end) {
            return Err(SubsurfaceError::NoSuchBrick { brick, bricks });
        }
        let [[x, y, z], [across, along, _]] = [brick, bricks].map(|each| each.map(u64::from));
        Ok(x + across * (y + along * z))
    }

    /// The brick with this index. `rank` must be less than the number of bricks.
    pub(super) fn brick_at(&self, rank: u64) -> [u32; 3] {
        let [across, along, _] = self.bricks().map(|each| u64::from(each.max(1)));
        // Each number is less than the number of bricks along its axis.
        [rank % across, rank / across % along, rank / across / along].map(|at| at as u32)
    }

    /// Checks the arguments of a [`BrickSource::read`](super::BrickSource::read), and returns the brick's index in
    /// the file's order.
    ///
    /// # Errors
    /// [`SubsurfaceError::NoSuchBrick`], and [`SubsurfaceError::BufferLength`] for a buffer that is not as long as a
    /// brick.
    pub fn check_read(&self, brick: [u32; 3], samples: &[u8]) -> Result<u64, SubsurfaceError> {
        let rank = self.rank(brick)?;
        let (expected, actual) = (self.brick_bytes(), samples.len());
        if expected == actual {
            return Ok(rank);
        }
        Err(SubsurfaceError::BufferLength { expected, actual })
    }
}
