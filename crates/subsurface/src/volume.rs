//! Seismic volumes: samples on a regular grid, in bricks.

mod bricks;
mod colours;
mod file;
mod format;
mod write;

pub use bricks::{BrickCache, BrickCacheStats};
pub use colours::ColourMap;
pub(crate) use colours::{UNKNOWN, amplitudes};
pub use file::VolumeFile;
pub use write::write_volume;

use glam::{DMat3, DVec3};

use crate::error::SubsurfaceError;

/// How large a volume is, where it lies, and what its samples mean.
///
/// A sample is a byte: 0 where nothing is known, else 1..=255 from the lower to the upper end of `range`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeLayout {
    /// Samples along the inline, crossline and time (or depth) axis.
    pub size: [u32; 3],
    /// Samples along an edge of a brick.
    pub brick: u32,
    /// Where sample (0, 0, 0) lies in the world, in metres.
    pub origin: DVec3,
    /// The way to the next sample along each axis, in metres.
    pub steps: [DVec3; 3],
    /// The values that 1 and 255 stand for.
    pub range: [f32; 2],
}

impl VolumeLayout {
    /// The most samples along an axis.
    pub const MAX_SAMPLES: u32 = 1 << 20;
    /// The most samples along an edge of a brick.
    pub const MAX_BRICK_EDGE: u32 = 256;
    /// How far from zero the numbers of a place or a step may be, in metres.
    pub const MAX_COORDINATE: f64 = 1e12;

    /// Bricks along each axis.
    #[must_use]
    pub fn bricks(&self) -> [u32; 3] {
        self.size.map(|side| side.div_ceil(self.brick.max(1)))
    }

    /// Samples, and bytes, of a brick.
    #[must_use]
    pub fn brick_bytes(&self) -> usize {
        (self.brick as usize).saturating_pow(3)
    }

    /// Bytes of all bricks; `None` when 64 bits cannot count them.
    #[must_use]
    pub fn total_bytes(&self) -> Option<u64> {
        let [x, y, z] = self.bricks().map(u64::from);
        let bricks = x.checked_mul(y)?.checked_mul(z)?;
        bricks.checked_mul(u64::from(self.brick).checked_pow(3)?)
    }

    /// Which brick holds a sample.
    #[must_use]
    pub fn brick_of(&self, sample: [u32; 3]) -> [u32; 3] {
        sample.map(|at| at / self.brick.max(1))
    }

    /// Where a place between the samples lies in the world, in metres.
    #[must_use]
    pub fn position(&self, place: DVec3) -> DVec3 {
        let [x, y, z] = self.steps;
        self.origin + DMat3::from_cols(x, y, z) * place
    }

    /// The value that a sample stands for; `None` where nothing is known.
    #[must_use]
    pub fn value(&self, sample: u8) -> Option<f32> {
        let [low, high] = self.range;
        let part = f32::from(sample.checked_sub(1)?) / 254.0;
        Some(low + (high - low) * part)
    }

    /// What is wrong with the numbers, in words; `None` if nothing is.
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

    /// Refuses numbers that cannot be.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`] with what [`Self::problem`] finds.
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

    /// Where a brick stands among all, the inline axis fastest, then crossline, then time.
    fn rank(&self, brick: [u32; 3]) -> Result<u64, SubsurfaceError> {
        let bricks = self.bricks();
        if brick.iter().zip(&bricks).any(|(at, end)| at >= end) {
            return Err(SubsurfaceError::NoSuchBrick { brick, bricks });
        }
        let [[x, y, z], [across, along, _]] = [brick, bricks].map(|each| each.map(u64::from));
        Ok(x + across * (y + along * z))
    }

    /// The other way round; `rank` must be one of a brick.
    fn brick_at(&self, rank: u64) -> [u32; 3] {
        let [across, along, _] = self.bricks().map(|each| u64::from(each.max(1)));
        // Each is less than the count of bricks along its axis.
        [rank % across, rank / across % along, rank / across / along].map(|at| at as u32)
    }

    /// For a [`BrickSource::read`]: the brick's place in the order of the file.
    ///
    /// # Errors
    /// [`SubsurfaceError`] for a brick that is not there, or a buffer that is not as long as one.
    pub fn check_read(&self, brick: [u32; 3], samples: &[u8]) -> Result<u64, SubsurfaceError> {
        let rank = self.rank(brick)?;
        let (expected, actual) = (self.brick_bytes(), samples.len());
        if expected == actual {
            return Ok(rank);
        }
        Err(SubsurfaceError::BufferLength { expected, actual })
    }
}

/// An axis of a volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// From inline to inline: an inline section has a fixed place along it.
    Inline,
    /// From crossline to crossline.
    Crossline,
    /// Down, in time or depth.
    Time,
}

impl Axis {
    /// All three, as they follow each other in a layout's arrays.
    pub const ALL: [Self; 3] = [Self::Inline, Self::Crossline, Self::Time];

    /// The axes that span a section with a fixed place along this one: to the right and down in its image.
    #[must_use]
    pub fn plane(self) -> [Self; 2] {
        match self {
            Self::Inline => [Self::Crossline, Self::Time],
            Self::Crossline => [Self::Inline, Self::Time],
            Self::Time => [Self::Inline, Self::Crossline],
        }
    }

    /// This axis' part of three.
    #[must_use]
    pub fn of<T>(self, [inline, crossline, time]: [T; 3]) -> T {
        match self {
            Self::Inline => inline,
            Self::Crossline => crossline,
            Self::Time => time,
        }
    }

    /// A triple with `at` along this axis and the others along its plane.
    #[must_use]
    pub fn place<T>(self, at: T, [right, down]: [T; 2]) -> [T; 3] {
        match self {
            Self::Inline => [at, right, down],
            Self::Crossline => [right, at, down],
            Self::Time => [right, down, at],
        }
    }
}

impl std::fmt::Display for Axis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Inline => "inline",
            Self::Crossline => "crossline",
            Self::Time => "time",
        })
    }
}

/// A box of samples, both ends within.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SampleBox {
    /// The first sample along each axis.
    pub min: [u32; 3],
    /// The last.
    pub max: [u32; 3],
}

impl SampleBox {
    /// How many samples it holds along each axis; 0 where it is empty.
    #[must_use]
    pub fn samples(&self) -> [u32; 3] {
        Axis::ALL.map(|axis| {
            let (first, last) = (axis.of(self.min), axis.of(self.max));
            last.checked_sub(first)
                .map_or(0, |steps| steps.saturating_add(1))
        })
    }

    /// Refuses a box that is empty or not within a volume.
    ///
    /// # Errors
    /// [`SubsurfaceError::Empty`] and [`SubsurfaceError::Outside`], naming the axis; `what` says what the box is of.
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

    /// The bricks that hold its samples, the inline axis fastest.
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

/// Where bricks come from: a file, or a rule.
pub trait BrickSource: Send + Sync {
    /// The volume's layout.
    fn layout(&self) -> &VolumeLayout;

    /// Fills `samples` ([`VolumeLayout::brick_bytes`] long) with a brick, the inline axis fastest, then crossline, then time. Places beyond the
    /// volume's end repeat its last samples.
    ///
    /// # Errors
    /// When there is no such brick, or it cannot be read.
    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError>;
}
