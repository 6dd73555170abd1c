//! The errors of sub-surface models. Each names the problem, its place and the remedy.

use std::path::PathBuf;

use antumbra_scene::SceneError;
use thiserror::Error;

use crate::volume::Axis;

/// Why a sub-surface model could not be read, prepared or added to a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SubsurfaceError {
    /// A file cannot be opened, read, created or written.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// `open`, `read`, `create`, `write`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The contents of a file are invalid.
    #[error("{} is not a valid {format}: {problem}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The format's name: `Irap binary surface`, `ROFF grid`, ...
        format: &'static str,
        /// The problem and its place: byte, line or record.
        problem: String,
    },
    /// The data give no surface.
    #[error("surface `{surface}`: {problem}")]
    BadSurface {
        /// Its name.
        surface: String,
        /// The problem, and the remedy.
        problem: String,
    },
    /// The layout of a volume is invalid.
    #[error("invalid volume layout: {problem}")]
    BadLayout {
        /// The problem, and the valid values.
        problem: String,
    },
    /// The volume has no such brick.
    #[error(
        "there is no brick {brick:?}: the volume has {bricks:?} along its axes, counted from 0"
    )]
    NoSuchBrick {
        /// The requested brick.
        brick: [u32; 3],
        /// The number of bricks along each axis.
        bricks: [u32; 3],
    },
    /// The length of a buffer is wrong.
    #[error("a buffer of {actual} bytes cannot take {expected} samples: give one of that length")]
    BufferLength {
        /// The number of samples, one byte each.
        expected: usize,
        /// The length of the buffer in bytes.
        actual: usize,
    },
    /// The budget is smaller than one brick.
    #[error(
        "a budget of {budget} bytes holds no brick of {brick}: give more, or write the volume in smaller bricks"
    )]
    SmallBudget {
        /// The budget in bytes.
        budget: usize,
        /// The size of a brick in bytes.
        brick: usize,
    },
    /// A part of the volume is, even partly, outside it.
    #[error("{what} is outside the volume along the {axis} axis: it needs samples {} to {}, but there are 0 to {last}; move it inside", asked[0], asked[1])]
    Outside {
        /// What it is.
        what: String,
        /// The axis along which it exceeds the volume.
        axis: Axis,
        /// Its first and last sample along the axis.
        asked: [u32; 2],
        /// The volume's last sample along the axis.
        last: u32,
    },
    /// A part of the volume has no samples.
    #[error(
        "{what} is empty along the {axis} axis: it ends with sample {last}, before its first one, {first}"
    )]
    Empty {
        /// What it is.
        what: String,
        /// The axis along which it is empty.
        axis: Axis,
        /// Its first sample.
        first: u32,
        /// Its last.
        last: u32,
    },
    /// The bricks belong to another volume.
    #[error(
        "these bricks belong to another volume, with {actual:?} samples or at another position: give the bricks of the volume with {expected:?} samples"
    )]
    OtherVolume {
        /// The number of samples of the right volume.
        expected: [u32; 3],
        /// The number of samples of the bricks' volume.
        actual: [u32; 3],
    },
    /// A setting is out of range.
    #[error("{what} cannot be {value}: {problem}")]
    Setting {
        /// Its name.
        what: &'static str,
        /// The value as given.
        value: String,
        /// The valid values.
        problem: String,
    },
    /// The scene refused a change.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
