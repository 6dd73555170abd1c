//! What can go wrong with a sub-surface model: what, where, and what to do.

use std::path::PathBuf;

use antumbra_scene::SceneError;
use thiserror::Error;

use crate::volume::Axis;

/// Why a sub-surface model could not be read, prepared or shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SubsurfaceError {
    /// A file cannot be opened, read, made or written.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// `open`, `read`, `create`, `write`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file is not what it should be.
    #[error("{} is no valid {format}: {problem}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// `Irap binary surface`, `ROFF grid`, ...
        format: &'static str,
        /// What is wrong and where: byte, line, record.
        problem: String,
    },
    /// No surface can be made of what is there.
    #[error("surface `{surface}`: {problem}")]
    BadSurface {
        /// Its name.
        surface: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// A volume's numbers cannot be.
    #[error("no volume can be laid out so: {problem}")]
    BadLayout {
        /// What is wrong, and what is possible.
        problem: String,
    },
    /// A brick beyond a volume's last.
    #[error(
        "there is no brick {brick:?}: the volume has {bricks:?} along its axes, counted from 0"
    )]
    NoSuchBrick {
        /// The brick asked for.
        brick: [u32; 3],
        /// Bricks along each axis.
        bricks: [u32; 3],
    },
    /// A buffer for samples of the wrong length.
    #[error("a buffer of {actual} bytes cannot take {expected} samples: give one of that length")]
    BufferLength {
        /// Samples, a byte each.
        expected: usize,
        /// Bytes of the buffer.
        actual: usize,
    },
    /// A budget that holds no brick.
    #[error(
        "a budget of {budget} bytes holds no brick of {brick}: give more, or write the volume in smaller bricks"
    )]
    SmallBudget {
        /// Bytes that may be used.
        budget: usize,
        /// Bytes of a brick.
        brick: usize,
    },
    /// Something that lies, even partly, outside the volume.
    #[error("{what} lies outside the volume along its {axis} axis: it takes samples {} to {}, but there are 0 to {last}; move it inside", asked[0], asked[1])]
    Outside {
        /// What it is.
        what: String,
        /// The axis along which it does.
        axis: Axis,
        /// Its first and last sample.
        asked: [u32; 2],
        /// The volume's last sample.
        last: u32,
    },
    /// Something without a sample.
    #[error(
        "{what} is empty along the {axis} axis: it ends with sample {last}, before its first one, {first}"
    )]
    Empty {
        /// What it is.
        what: String,
        /// The axis along which it is.
        axis: Axis,
        /// Its first sample.
        first: u32,
        /// Its last.
        last: u32,
    },
    /// Bricks of a volume that something was not made for.
    #[error(
        "these bricks are of another volume, of {actual:?} samples or lying elsewhere: give those of the one of {expected:?} samples"
    )]
    OtherVolume {
        /// The size of the right volume.
        expected: [u32; 3],
        /// The size of the bricks' volume.
        actual: [u32; 3],
    },
    /// A setting out of its range.
    #[error("{what} cannot be {value}: {problem}")]
    Setting {
        /// Its name.
        what: &'static str,
        /// What was asked for.
        value: String,
        /// What is possible.
        problem: String,
    },
    /// The scene refused something.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
