//! The views of a frame: the camera's own, or two eyes, left first.

use antumbra_cull::ViewSpec;
use antumbra_scene::{Camera, Stereo, StereoError};

/// What the eyes are called, in the order of their views.
pub const EYES: [&str; 2] = ["left", "right"];

/// The views a stage is built with: `main`, or in stereo `left` and `right`, each of `size` pixels (width, height).
pub fn specs(stereo: Option<&Stereo>, size: [u32; 2]) -> Vec<ViewSpec> {
    let [width, height] = size;
    if stereo.is_none() {
        return vec![ViewSpec::main(width, height)];
    }
    let eye = |name: &str| ViewSpec {
        name: name.to_owned(),
        size,
    };
    EYES.map(eye).to_vec()
}

/// The cameras of those views: the one given, or its two eyes.
///
/// # Errors
/// What [`Stereo::eyes`] refuses.
pub fn cameras(stereo: Option<&Stereo>, camera: &Camera) -> Result<Vec<Camera>, StereoError> {
    match stereo {
        Some(stereo) => Ok(stereo.eyes(camera)?.to_vec()),
        None => Ok(vec![*camera]),
    }
}
