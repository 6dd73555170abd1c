//! Cameras, and the lights of KHR_lights_punctual.

use antumbra_scene::{Light, Projection};
use gltf::json::extensions::scene::khr_lights_punctual::Type as LightType;
use gltf::json::validation::Checked;

/// A camera's projection; `None` for one that has none.
pub(super) fn projection(camera: &gltf::json::Camera) -> Option<Projection> {
    if let Some(perspective) = &camera.perspective {
        return Some(Projection::Perspective {
            fov_y: f64::from(perspective.yfov),
            near: f64::from(perspective.znear),
        });
    }
    camera
        .orthographic
        .as_ref()
        .map(|orthographic| Projection::Orthographic {
            height: f64::from(orthographic.ymag.abs()) * 2.0,
            near: f64::from(orthographic.znear),
            far: f64::from(orthographic.zfar),
        })
}

/// A light; `None` for a kind that is not known.
pub(super) fn punctual(
    source: &gltf::json::extensions::scene::khr_lights_punctual::Light,
) -> Option<Light> {
    let (colour, intensity, range) = (source.color, source.intensity, source.range);
    let Checked::Valid(kind) = source.type_ else {
        return None;
    };
    Some(match kind {
        LightType::Directional => Light::Directional {
            colour,
            illuminance: intensity,
        },
        LightType::Point => Light::Point {
            colour,
            intensity,
            range,
        },
        LightType::Spot => Light::Spot {
            colour,
            intensity,
            range,
            inner: source
                .spot
                .as_ref()
                .map_or(0.0, |spot| spot.inner_cone_angle),
            outer: (source.spot.as_ref())
                .map_or(std::f32::consts::FRAC_PI_4, |s| s.outer_cone_angle),
        },
    })
}
