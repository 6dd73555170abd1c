//! Conversion of transforms, lights and cameras to glTF.

use super::json;
use antumbra_scene::{Camera, Light, Projection};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

/// The relative error up to which a transform counts as translation, rotation and scale.
const EXACT: f64 = 1e-12;

/// A transform with as few numbers as possible.
pub(super) fn transform(local: &DAffine3) -> json::Transform {
    let translation = local.translation;
    let translation = (translation != DVec3::ZERO).then(|| translation.to_array());
    if local.matrix3 == DMat3::IDENTITY {
        return json::Transform {
            translation,
            ..json::Transform::default()
        };
    }
    if let Some((scale, rotation)) = decomposed(&local.matrix3) {
        return json::Transform {
            translation,
            rotation: (rotation != DQuat::IDENTITY).then(|| rotation.to_array()),
            scale: (scale != DVec3::ONE).then(|| scale.to_array()),
            matrix: None,
        };
    }
    json::Transform {
        matrix: Some(Box::new(DMat4::from(*local).to_cols_array())),
        ..json::Transform::default()
    }
}

/// Scale and rotation of a matrix; `None` if it has another part.
fn decomposed(matrix: &DMat3) -> Option<(DVec3, DQuat)> {
    let lengths = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
    let scale = DVec3::from(lengths) * DVec3::new(matrix.determinant().signum(), 1.0, 1.0);
    let turned = *matrix * DMat3::from_diagonal(scale.recip());
    if !turned.is_finite() {
        return None;
    }
    let rotation = DQuat::from_mat3(&turned).normalize();
    let again = DMat3::from_quat(rotation) * DMat3::from_diagonal(scale);
    let size = scale.abs().max_element();
    again
        .abs_diff_eq(*matrix, size * EXACT)
        .then_some((scale, rotation))
}

pub(super) fn light(light: &Light) -> json::Light {
    let color = light.colour();
    match *light {
        Light::Directional { illuminance, .. } => json::Light {
            kind: "directional",
            color,
            intensity: illuminance,
            range: None,
            spot: None,
        },
        Light::Point {
            intensity, range, ..
        } => json::Light {
            kind: "point",
            color,
            intensity,
            range,
            spot: None,
        },
        Light::Spot {
            intensity,
            range,
            inner,
            outer,
            ..
        } => json::Light {
            kind: "spot",
            color,
            intensity,
            range,
            spot: Some(json::Cone {
                inner_cone_angle: inner,
                outer_cone_angle: outer,
            }),
        },
    }
}

/// A camera and its transform relative to its entity.
pub(super) struct PlacedCamera {
    pub(super) camera: json::Camera,
    pub(super) place: DAffine3,
}

/// Converts a camera; `None` for one that glTF cannot represent.
pub(super) fn camera(camera: &Camera) -> Option<PlacedCamera> {
    let mut position = camera.position;
    let seen = match camera.projection {
        Projection::Perspective { fov_y, near } => json::Camera::Perspective {
            perspective: json::Perspective {
                yfov: fov_y,
                znear: near,
            },
        },
        Projection::OffAxis { .. } | Projection::Matrix(_) => return None,
        Projection::Orthographic { height, near, far } => {
            // In glTF the near plane may not be behind the eye, so the eye is moved back.
            let back = (-near).max(0.0);
            position -= camera.forward() * back;
            json::Camera::Orthographic {
                orthographic: json::Orthographic {
                    xmag: height * 0.5,
                    ymag: height * 0.5,
                    znear: near + back,
                    zfar: far + back,
                },
            }
        }
    };
    let place = DAffine3::from_rotation_translation(camera.rotation, position);
    Some(PlacedCamera {
        camera: seen,
        place,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_are_taken_apart_where_that_says_them() {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
        let place = DVec3::new(460_123.456, -1.0, 5.93e6);
        for scale in [
            DVec3::ONE,
            DVec3::new(2.0, 0.5, 1e-3),
            DVec3::new(-1.0, 3.0, 1.0),
        ] {
            let local = DAffine3::from_scale_rotation_translation(scale, turn, place);
            let written = transform(&local);
            assert_eq!(written.matrix, None);
            assert_eq!(written.translation, Some(place.to_array()));
            let again = DAffine3::from_scale_rotation_translation(
                DVec3::from(written.scale.unwrap_or([1.0; 3])),
                DQuat::from_array(written.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0])),
                place,
            );
            assert!(again.abs_diff_eq(local, 1e-9), "{again} is not {local}");
        }
        assert_eq!(transform(&DAffine3::IDENTITY), json::Transform::default());
        let moved = transform(&DAffine3::from_translation(place));
        assert_eq!((moved.rotation, moved.scale), (None, None));
    }

    #[test]
    fn what_shears_or_flattens_is_a_matrix() {
        let sheared = DMat3::from_cols(DVec3::X, DVec3::new(0.5, 1.0, 0.0), DVec3::Z);
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0));
        for matrix in [sheared, flat, DMat3::ZERO] {
            let local = DAffine3::from_mat3_translation(matrix, DVec3::X);
            let written = transform(&local);
            assert_eq!(
                written.matrix.map(|m| *m),
                Some(DMat4::from(local).to_cols_array())
            );
            assert_eq!(
                (written.translation, written.rotation, written.scale),
                (None, None, None)
            );
        }
    }
}
