//! The error type of the crate. Each message says what is wrong, where, and what to do about it.

use std::path::PathBuf;

/// Why measuring, reporting, or reading a file failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// A file could not be opened, read, written or renamed.
    #[error("cannot {action} {path}: {source}", path = path.display())]
    File {
        /// The attempted action: "read", "write", ...
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A file is larger than the limit of its kind. Nothing past the limit was read.
    #[error("{path} is larger than {limit} bytes, the most a {kind} may have", path = path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What the file should have been.
        kind: &'static str,
        /// The limit in bytes.
        limit: u64,
    },
    /// A file is not valid JSON of its kind.
    #[error("{path} is no valid {kind}: {reason}", path = path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What the file should have been.
        kind: &'static str,
        /// What is wrong, with the line or the pose.
        reason: String,
    },
    /// A measured number is NaN or infinite.
    #[error("report field {field} is not a finite number: leave a value out that was not measured")]
    NotFinite {
        /// The field, e.g. `strategies[2].frame_ms.median`.
        field: String,
    },
    /// A report contradicts itself.
    #[error("report field {field} {problem}")]
    Report {
        /// The field, e.g. `strategies[2].worst.images.marked`.
        field: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A script could not change the scene for a pose.
    #[error("the scene cannot be brought to pose {pose}: {problem}")]
    Script {
        /// The pose; the first is 0.
        pose: usize,
        /// What stopped it.
        problem: String,
    },
    /// A camera path is not valid.
    #[error("camera path {name:?}: {problem}")]
    Path {
        /// The path's name.
        name: String,
        /// What is wrong, with the number of the pose (the first is 0).
        problem: String,
    },
    /// The stereo parameters are not valid, or do not fit the camera.
    #[error(transparent)]
    Stereo(#[from] antumbra_scene::StereoError),
    /// A statistic is not defined for the values.
    #[error("cannot take the {statistic}: {problem}")]
    Statistics {
        /// The statistic's name.
        statistic: &'static str,
        /// What is wrong with the values, with the index of the first bad one.
        problem: String,
    },
    /// A text is no error limit.
    #[error("'{text}' is no error limit: {forms}")]
    ErrorLimit {
        /// The text.
        text: String,
        /// The forms of an error limit.
        forms: &'static str,
    },
    /// Two images or buffers differ in size.
    #[error(
        "{what}: {got} where {expected} was expected; both must come from the same view and size"
    )]
    SizeMismatch {
        /// What was compared.
        what: &'static str,
        /// The size that was found.
        got: String,
        /// The size that was needed.
        expected: String,
    },
    /// An image could not be decoded or encoded.
    #[error("image {path}: {source}", path = path.display())]
    Image {
        /// The image's file.
        path: PathBuf,
        /// The decoder's or encoder's error.
        source: image::ImageError,
    },
    /// A plot could not be drawn.
    #[error("cannot draw the plot {plot:?}: {reason}")]
    Plot {
        /// The plot's title.
        plot: &'static str,
        /// The plotter's error.
        reason: String,
    },
    /// There is no such strategy or setting.
    #[error(transparent)]
    Registry(#[from] antumbra_cull::RegistryError),
    /// A stage could not be built, or a frame failed.
    #[error(transparent)]
    Stage(#[from] antumbra_cull::StageError),
    /// The scene does not fit the device.
    #[error(transparent)]
    Draw(#[from] antumbra_draw::DrawError),
    /// The device.
    #[error(transparent)]
    Device(#[from] antumbra_cull::DeviceError),
}
