//! Why a scene cannot be drawn.

use thiserror::Error;

use antumbra_cull::DeviceError;

/// Why a scene cannot be drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A buffer would exceed the device's limits.
    #[error(
        "{what} need {bytes} bytes, and this device's buffers end at {most}: split the scene or simplify its meshes"
    )]
    TooLarge {
        /// The buffer's contents.
        what: &'static str,
        /// Its size in bytes.
        bytes: u64,
        /// The device's limit, in bytes.
        most: u64,
    },
    /// A world transform does not fit 32-bit floats.
    #[error(
        "entity '{entity}': its world transform holds {number}, which does not fit 32-bit floats; bring its scale and position below 3e38"
    )]
    Transform {
        /// The entity's name, or its key where it has none.
        entity: String,
        /// The first number that does not fit.
        number: f64,
    },
    /// A texture is larger than the device allows.
    #[error("image {image}: {width} x {height} pixels exceed this device's {most}: scale it down")]
    Image {
        /// The image's index.
        image: usize,
        /// Its width in pixels.
        width: u32,
        /// Its height in pixels.
        height: u32,
        /// The device's limit in pixels a side.
        most: u32,
    },
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}
