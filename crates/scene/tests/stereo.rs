//! Stereo cameras: where the two images agree, how they differ in front of and behind the convergence plane, and
//! which settings are rejected.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::{Camera, CameraError, Projection, Stereo, StereoError};
use glam::{DMat4, DQuat, DVec2, DVec3};
use proptest::prelude::*;

const ASPECT: f64 = 1.25;

fn camera(shift: DVec2) -> Camera {
    let eye = DVec3::new(3.0, -2.0, 7.0);
    let projection = Projection::OffAxis {
        fov_y: 0.9,
        near: 0.05,
        shift,
    };
    Camera::look_at(eye, DVec3::new(-4.0, 1.0, 0.5), DVec3::Y, projection).unwrap()
}

/// Position of a point in the image, -1 to 1 across and upwards.
fn lands(camera: &Camera, point: DVec3) -> DVec2 {
    let view = DMat4::from_quat(camera.rotation.conjugate());
    let clip =
        camera.projection_matrix(ASPECT).as_dmat4() * view * (point - camera.position).extend(1.0);
    clip.truncate().truncate() / clip.w
}

proptest! {
    /// A point on the convergence plane has one position in both images, a nearer point is crossed (farther right in
    /// the left eye), a farther point uncrossed; heights are equal.
    #[test]
    fn the_eyes_agree_at_the_convergence_distance_and_part_before_and_behind(
        interocular in 0.01..0.5_f64,
        convergence in 1.0..50.0_f64,
        own in prop::array::uniform2(-0.5..0.5_f64),
        place in prop::array::uniform2(-0.6..0.6_f64),
        nearer in 0.1..0.95_f64,
        farther in 1.05..100.0_f64,
    ) {
        let middle = camera(DVec2::from_array(own));
        let [left, right] = Stereo::new(interocular, convergence).unwrap().eyes(&middle).unwrap();
        let point = |depth: f64| {
            middle.position + (middle.forward() + middle.right() * place[0] + middle.up() * place[1]) * depth
        };
        let parted = |depth: f64| lands(&left, point(depth)) - lands(&right, point(depth));
        prop_assert!(parted(convergence).abs().max_element() < 1e-5, "{}", parted(convergence));
        for depth in [nearer * convergence, convergence, farther * convergence] {
            prop_assert!(parted(depth).y.abs() < 1e-5, "higher in one eye: {}", parted(depth));
            let expected = interocular * (1.0 / depth - 1.0 / convergence)
                * f64::from(middle.projection_matrix(ASPECT).x_axis.x);
            prop_assert!((parted(depth).x - expected).abs() < 1e-5 * (1.0 + expected.abs()));
        }
        if interocular > 0.02 * convergence {
            prop_assert!(parted(nearer * convergence).x > 0.0, "crossed");
            prop_assert!(parted(farther * convergence).x < 0.0, "uncrossed");
        }
    }
}

#[test]
fn the_eyes_stand_beside_the_camera_and_are_turned_as_it_is() {
    let middle = camera(DVec2::new(0.1, -0.2));
    let [left, right] = Stereo::new(0.5, 4.0).unwrap().eyes(&middle).unwrap();
    assert_eq!([left.rotation, right.rotation], [middle.rotation; 2]);
    assert!((right.position - left.position - middle.right() * 0.5).length() < 1e-14);
    assert!(((left.position + right.position) * 0.5 - middle.position).length() < 1e-14);
    for (eye, right) in [(left, 0.1 + 0.0625), (right, 0.1 - 0.0625)] {
        let Projection::OffAxis { fov_y, near, shift } = eye.projection else {
            panic!("{eye:?}")
        };
        assert_eq!((fov_y, near, shift), (0.9, 0.05, DVec2::new(right, -0.2)));
    }
}

#[test]
fn eyes_in_one_place_are_the_camera_to_the_bit() {
    let perspective = Projection::Perspective {
        fov_y: 1.0,
        near: 0.1,
    };
    // The critical case: a sum would change -0 to 0 in one eye only.
    let place = DVec3::new(-0.0, 1.0, -0.0);
    for middle in [
        camera(DVec2::ZERO),
        Camera::new(perspective, place, DQuat::IDENTITY).unwrap(),
    ] {
        let eyes = Stereo::new(0.0, 3.0).unwrap().eyes(&middle).unwrap();
        for eye in eyes {
            assert_eq!(eye, middle);
            let bits = |camera: &Camera| camera.position.to_array().map(f64::to_bits);
            assert_eq!(bits(&eye), bits(&middle));
        }
    }
}

#[test]
fn distances_that_cannot_be_are_refused_with_their_range() {
    for bad in [-0.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = Stereo::new(bad, 1.0).unwrap_err();
        assert!(matches!(error, StereoError::Interocular { .. }), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("0 or more") && text.contains(&bad.to_string()),
            "{text}"
        );
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Stereo::new(0.1, bad).unwrap_err();
        assert!(matches!(error, StereoError::Convergence { .. }), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("above 0") && text.contains(&bad.to_string()),
            "{text}"
        );
    }
    // The fields are public, so eyes() checks again.
    let unchecked = Stereo {
        interocular: 0.1,
        convergence: 0.0,
    };
    let error = unchecked.eyes(&camera(DVec2::ZERO)).unwrap_err();
    assert_eq!(error, StereoError::Convergence { value: 0.0 });
}

#[test]
fn cameras_without_eyes_say_so() {
    let stereo = Stereo::new(0.1, 2.0).unwrap();
    let parallel = Camera {
        projection: Projection::Orthographic {
            height: 2.0,
            near: 0.0,
            far: 9.0,
        },
        ..camera(DVec2::ZERO)
    };
    let error = stereo.eyes(&parallel).unwrap_err();
    assert!(error.to_string().contains("orthographic"), "{error}");
    let lost = Camera {
        position: DVec3::NAN,
        ..camera(DVec2::ZERO)
    };
    assert!(matches!(
        stereo.eyes(&lost),
        Err(StereoError::Camera(CameraError::NotFinite { .. }))
    ));
    // Valid distances whose window is not finite.
    let extreme = Stereo::new(1e300, 1e-300).unwrap();
    assert!(matches!(
        extreme.eyes(&camera(DVec2::ZERO)),
        Err(StereoError::Camera(_))
    ));
}
