//! The environment of a scene: an image that shiny surfaces reflect and that lights all surfaces from all sides.

use crate::keys::ImageKey;

/// An image around the whole scene, at infinite distance.
///
/// The image is equirectangular. Its first row is straight up (+Y) and its last row straight down. Its middle column
/// is towards -Z, and columns to the right of it turn towards +X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// An image of the scene.
    pub image: ImageKey,
    /// The factor on the image's linear light, 0 or more. At 1 a perfect mirror shows the image's own colours.
    pub intensity: f32,
}
