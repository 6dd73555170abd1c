//! What surrounds a scene: an image that shiny surfaces reflect and that lights the others from all sides.

use crate::keys::ImageKey;

/// An image around the whole scene, infinitely far away.
///
/// The image is equirectangular: its first row is straight up (+Y), its last straight down, its middle column lies towards -Z, and from
/// there it turns to the right, to +X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// An image of the scene.
    pub image: ImageKey,
    /// What the image's linear light is multiplied with, 0 or more. At 1 a perfect mirror shows the image's own colours.
    pub intensity: f32,
}
