//! The views of a frame: one, or two eyes in stereo, left first.

use antumbra_cull::ViewSpec;
use antumbra_scene::{Camera, Stereo, StereoError};

/// The names of the eyes, in the order of their views.
pub const EYES: [&str; 2] = ["left", "right"];

/// The views of a stage: `main`, or in stereo `left` and `right`, each of `size` pixels (width, height).
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

/// The cameras of these views: `camera` itself, or its two eyes.
///
/// # Errors
/// As for [`Stereo::eyes`].
pub fn cameras(stereo: Option<&Stereo>, camera: &Camera) -> Result<Vec<Camera>, StereoError> {
    match stereo {
        Some(stereo) => Ok(stereo.eyes(camera)?.to_vec()),
        None => Ok(vec![*camera]),
    }
}
