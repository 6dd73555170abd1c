//! Cameras and frusta: no box with a point inside the image is culled, one at a time or a million at once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::{Aabb, BoxArray, Camera, CameraError, Frustum, Projection};
use glam::{DQuat, DVec2, DVec3, Vec3, Vec4};
use proptest::prelude::*;

const ASPECT: f64 = 1.5;

fn perspective(fov_y: f64, near: f64) -> Projection {
    Projection::Perspective { fov_y, near }
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
}

fn projection() -> impl Strategy<Value = Projection> {
    prop_oneof![
        (0.05..3.0_f64, -4.0..1.0_f64).prop_map(|(fov, near)| perspective(fov, 10_f64.powf(near))),
        (0.05..3.0_f64, -4.0..1.0_f64, -3.0..3.0_f64, -3.0..3.0_f64).prop_map(
            |(fov_y, near, right, up)| Projection::OffAxis {
                fov_y,
                near: 10_f64.powf(near),
                shift: DVec2::new(right, up),
            }
        ),
        (0.1..50.0_f64, -20.0..20.0_f64, 0.1..50.0_f64).prop_map(|(height, near, depth)| {
            let far = near + depth;
            Projection::Orthographic { height, near, far }
        }),
    ]
}

/// Up to 1e9 m from the origin.
fn camera() -> impl Strategy<Value = Camera> {
    (vector(1.0), 0.0..9.0_f64, vector(1.0), projection()).prop_filter_map(
        "a direction",
        |(place, far, towards, projection)| {
            let eye = place * 10_f64.powf(far);
            Camera::look_at(eye, eye + towards, DVec3::Y, projection).ok()
        },
    )
}

/// A box around a point at `distance` from the camera in any direction; sizes from 1 mm to 1 km.
fn around(camera: &Camera, direction: DVec3, distance: f64, size: DVec3) -> Aabb {
    let half = (size * 3.0).to_array().map(|s| 10_f64.powf(s));
    Aabb::from_centre(
        camera.position + direction * distance,
        DVec3::from_array(half),
    )
}

/// Position of a point in the camera's axes: right, up, ahead.
fn seen_at(camera: &Camera, point: DVec3) -> DVec3 {
    let v = camera.rotation.conjugate() * (point - camera.position);
    DVec3::new(v.x, v.y, -v.z)
}

/// Half the height of the view at this distance ahead.
fn side_limit(camera: &Camera, ahead: f64) -> f64 {
    match camera.projection {
        Projection::Perspective { fov_y, .. } | Projection::OffAxis { fov_y, .. } => {
            ahead * (fov_y * 0.5).tan()
        }
        Projection::Orthographic { height, .. } => height * 0.5,
        // `matrices.rs` has those.
        Projection::Matrix(_) => unreachable!(),
    }
}

/// Offset of the view's centre from the camera's axis at this distance ahead: right, up.
fn middle(camera: &Camera, ahead: f64) -> DVec2 {
    match camera.projection {
        Projection::OffAxis { shift, .. } => shift * ahead,
        _ => DVec2::ZERO,
    }
}

/// Whether a point in the camera's axes lies between the side planes.
fn between_sides(camera: &Camera, at: DVec3, ahead: f64) -> bool {
    let off = (at.truncate() - middle(camera, ahead)).abs();
    let limit = side_limit(camera, ahead);
    off.y <= limit && off.x <= limit * ASPECT
}

fn is_seen(camera: &Camera, point: DVec3) -> bool {
    let at = seen_at(camera, point);
    let far = match camera.projection {
        Projection::Orthographic { far, .. } => far,
        _ => f64::INFINITY,
    };
    at.z >= camera.near() && at.z <= far && between_sides(camera, at, at.z)
}

fn samples(bounds: &Aabb) -> impl Iterator<Item = DVec3> + '_ {
    let steps = || [0.0, 0.2, 0.5, 0.9, 1.0].into_iter();
    let size = bounds.max - bounds.min;
    steps()
        .flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| DVec3::new(x, y, z))))
        .map(move |t| bounds.min + size * t)
}

proptest! {
    #[test]
    fn a_box_with_a_visible_point_is_never_culled(
        camera in camera(),
        direction in vector(1.0),
        distance in 0.0..300.0_f64,
        size in vector(1.0),
    ) {
        let bounds = around(&camera, direction, distance, size);
        let frustum = camera.frustum(ASPECT);
        let seen = samples(&bounds).any(|point| is_seen(&camera, point));
        if seen {
            prop_assert!(frustum.intersects(&bounds));
            let mut boxes = BoxArray::new();
            boxes.push(bounds);
            let mut out = Vec::new();
            frustum.cull(&boxes, &mut out);
            prop_assert_eq!(out, [0]);
        }
    }

    #[test]
    fn a_box_that_the_near_plane_may_cut_is_told(
        camera in camera(),
        direction in vector(1.0),
        distance in 0.0..2.0_f64,
        size in vector(1.0),
    ) {
        let bounds = around(&camera, direction, distance * camera.near().abs(), size);
        let near = camera.near();
        let within = |point: &DVec3| {
            let at = seen_at(&camera, *point);
            between_sides(&camera, at, at.z.max(0.0))
        };
        let before = samples(&bounds).filter(within).any(|p| seen_at(&camera, p).z <= near);
        let behind = samples(&bounds).filter(within).any(|p| seen_at(&camera, p).z >= near);
        if before && behind {
            prop_assert!(camera.crosses_near(&bounds, ASPECT));
        }
        let half = DVec2::new(ASPECT, 1.0) * side_limit(&camera, near);
        let (centre, corner) = match camera.projection {
            Projection::Orthographic { .. } => (camera.position + camera.forward() * near, half.length()),
            _ => (camera.position, near.hypot((middle(&camera, near).abs() + half).length())),
        };
        let reach = (bounds.max - bounds.min).max_element() + bounds.distance(camera.position);
        let slack = near.abs() * 2e-3 + reach * 4e-6 + camera.position.abs().max_element() * 1e-14;
        if bounds.distance(centre) > corner * 1.001 + slack * 2.0 {
            prop_assert!(!camera.crosses_near(&bounds, ASPECT), "away from what the near plane can cut");
        }
    }

    /// The GPU's matrix and the CPU's planes describe the same window.
    #[test]
    fn what_projects_into_the_picture_is_inside_the_frustum(
        camera in camera(),
        clip in prop::array::uniform2(-0.999..0.999_f64),
        ahead in 1.001..300.0_f64,
    ) {
        let ahead = match camera.projection {
            Projection::Orthographic { near, far, .. } => near + (far - near) * ahead / 301.0,
            _ => camera.near() * ahead,
        };
        let half = DVec2::new(ASPECT, 1.0) * side_limit(&camera, ahead);
        let at = middle(&camera, ahead) + half * DVec2::from_array(clip);
        let relative = camera.right() * at.x + camera.up() * at.y + camera.forward() * ahead;
        let matrix = camera.projection_matrix(ASPECT) * camera.view_rotation();
        let projected: Vec4 = matrix * relative.as_vec3().extend(1.0);
        let projected = projected.truncate() / projected.w;
        let off = (projected.truncate().as_dvec2() - DVec2::from_array(clip)).abs().max_element();
        // The matrix is f32: a window that is narrow relative to its offset has fewer significant digits.
        let places = 1.0 + relative.length() / half.y;
        prop_assert!(off < 2e-6 * places, "{projected} instead of {clip:?}");
        let slack = DVec3::splat(camera.position.abs().max_element() * 1e-14 + 1e-12);
        let point = Aabb::from_centre(camera.position + relative, slack);
        prop_assert!(camera.frustum(ASPECT).intersects(&point));
        // On the other side of each edge the point is outside.
        for (side, sign) in [(DVec2::X, 1.0), (DVec2::X, -1.0), (DVec2::Y, 1.0), (DVec2::Y, -1.0)] {
            let at = middle(&camera, ahead) + half * sign * side * 1.01 + half * DVec2::from_array(clip) * (DVec2::ONE - side);
            let relative = camera.right() * at.x + camera.up() * at.y + camera.forward() * ahead;
            let beyond = half.min_element() * 0.01 / (1.0 + middle(&camera, 1.0).length() + side_limit(&camera, 1.0) * 2.0);
            if beyond > slack.x * 100.0 + relative.length() * 1e-5 {
                let point = Aabb::from_centre(camera.position + relative, slack);
                prop_assert!(!camera.frustum(ASPECT).intersects(&point), "{side} {sign}");
            }
        }
    }

    /// Also in the farthest corner of the window.
    #[test]
    fn a_small_box_on_the_near_plane_crosses_it(
        camera in camera(),
        clip in prop::array::uniform2(-1.0..1.0_f64),
        size in 1e-9..1e-3_f64,
    ) {
        let near = camera.near();
        let half = DVec2::new(ASPECT, 1.0) * side_limit(&camera, near);
        let at = middle(&camera, near) + half * DVec2::from_array(clip);
        let point = camera.position + camera.right() * at.x + camera.up() * at.y + camera.forward() * near;
        let bounds = Aabb::from_centre(point, DVec3::splat(size * half.y));
        prop_assert!(camera.crosses_near(&bounds, ASPECT));
    }

    #[test]
    fn an_off_axis_camera_without_a_shift_is_a_perspective_to_the_bit(
        camera in camera(),
        fov_y in 0.05..3.0_f64,
        near in 1e-4..10.0_f64,
        boxes in prop::collection::vec((vector(1.0), 0.0..100.0_f64, vector(1.0)), 0..20),
    ) {
        let on = Camera { projection: perspective(fov_y, near), ..camera };
        let off = Camera { projection: Projection::OffAxis { fov_y, near, shift: DVec2::ZERO }, ..camera };
        let bits = |camera: &Camera| camera.projection_matrix(ASPECT).to_cols_array().map(f32::to_bits);
        prop_assert_eq!(bits(&on), bits(&off));
        for (a, b) in on.frustum(ASPECT).planes().iter().zip(off.frustum(ASPECT).planes()) {
            prop_assert_eq!(a.normal.to_array().map(f64::to_bits), b.normal.to_array().map(f64::to_bits));
            prop_assert_eq!(a, b);
        }
        for (direction, far, size) in boxes {
            let bounds = around(&on, direction, far * near, size);
            prop_assert_eq!(on.crosses_near(&bounds, ASPECT), off.crosses_near(&bounds, ASPECT));
        }
    }

    #[test]
    fn many_boxes_at_once_are_the_same_as_one_by_one(
        camera in camera(),
        boxes in prop::collection::vec((vector(1.0), 0.0..100.0_f64, vector(1.0)), 0..300),
    ) {
        let frustum = camera.frustum(ASPECT);
        let boxes: Vec<Aabb> = boxes.into_iter().map(|(d, far, s)| around(&camera, d, far, s)).collect();
        let mut array = BoxArray::new();
        boxes.iter().for_each(|b| array.push(*b));
        check(&frustum, &boxes, &array);
    }

    #[test]
    fn box_arrays_are_vectors_of_boxes(
        steps in prop::collection::vec((0..5_u8, any::<usize>(), vector(10.0), vector(3.0)), 0..400),
    ) {
        let mut array = BoxArray::new();
        let mut plain: Vec<Aabb> = Vec::new();
        for (kind, at, centre, half) in steps {
            let bounds = if kind == 4 { Aabb::EMPTY } else { Aabb::from_centre(centre, half.abs()) };
            let index = at % (plain.len() + 1);
            match kind {
                0 | 1 | 4 => {
                    array.push(bounds);
                    plain.push(bounds);
                }
                2 => {
                    prop_assert_eq!(array.set(index, bounds), index < plain.len());
                    if let Some(place) = plain.get_mut(index) {
                        *place = bounds;
                    }
                }
                _ => {
                    prop_assert_eq!(array.swap_remove(index), index < plain.len());
                    if index < plain.len() {
                        plain.swap_remove(index);
                    }
                }
            }
        }
        prop_assert_eq!(array.len(), plain.len());
        prop_assert_eq!(array.get(plain.len()), None);
        for (i, bounds) in plain.iter().enumerate() {
            let found = array.get(i).unwrap();
            prop_assert_eq!(found.is_empty(), bounds.is_empty());
            prop_assert!(found.contains_box(bounds));
            prop_assert!(bounds.grown(DVec3::splat(1e-12)).contains_box(&found));
        }
        let camera = Camera::look_at(DVec3::Z * 8.0, DVec3::ZERO, DVec3::Y, perspective(0.6, 0.1)).unwrap();
        check(&camera.frustum(1.0), &plain, &array);
    }
}

/// Indices ascend, bits agree with them, and both agree with testing one box at a time, except for rounding.
fn check(frustum: &Frustum, plain: &[Aabb], array: &BoxArray) {
    let mut out = vec![77];
    frustum.cull(array, &mut out);
    assert_eq!(out.remove(0), 77, "appended, not overwritten");
    assert!(out.is_sorted_by(|a, b| a < b));
    let mut bits = vec![1, 2, 3];
    frustum.cull_into_bits(array, &mut bits);
    let ones: Vec<u32> = (0..plain.len() as u32)
        .filter(|i| bits[*i as usize / 64] >> (i % 64) & 1 == 1)
        .collect();
    assert_eq!(ones, out);
    assert_eq!(
        bits.iter().map(|w| w.count_ones() as usize).sum::<usize>(),
        out.len()
    );
    for (i, bounds) in plain.iter().enumerate() {
        let kept = out.binary_search(&(i as u32)).is_ok();
        if frustum.intersects(bounds) {
            assert!(kept, "box {i}");
        } else if kept {
            let scale = bounds.min.abs().max(bounds.max.abs()).max_element();
            assert!(
                frustum.intersects(&bounds.grown(DVec3::splat(scale * 1e-13))),
                "box {i}"
            );
        }
    }
}

#[test]
fn large_arrays_are_the_same_in_parallel() {
    let camera = Camera::look_at(DVec3::ZERO, DVec3::X, DVec3::Y, perspective(1.0, 0.1)).unwrap();
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let mut array = BoxArray::new();
    let plain: Vec<Aabb> = (0..100_003)
        .map(|i| {
            // Some blocks are close together, so that whole blocks are decided at once.
            let spread = if (i / 64) % 2 == 0 { 100.0 } else { 1.0 };
            let middle = DVec3::new(f64::from(i / 64 % 40) - 20.0, 0.0, 0.0);
            let centre = middle + DVec3::new(random(), random(), random()) * spread;
            Aabb::from_centre(centre, DVec3::splat(0.1))
        })
        .collect();
    plain.iter().for_each(|b| array.push(*b));
    check(&camera.frustum(1.0), &plain, &array);
}

#[test]
fn boxes_that_are_not_finite_are_kept_and_empty_ones_are_not() {
    let camera = Camera::look_at(DVec3::ZERO, DVec3::X, DVec3::Y, perspective(1.0, 0.1)).unwrap();
    let frustum = camera.frustum(1.0);
    let everywhere = Aabb {
        min: DVec3::NEG_INFINITY,
        max: DVec3::INFINITY,
    };
    let odd = Aabb {
        min: DVec3::NAN,
        max: DVec3::NAN,
    };
    // In front of the camera, but inside out.
    let inverted = Aabb {
        min: DVec3::new(9.0, 1.0, 1.0),
        max: DVec3::new(7.0, -1.0, -1.0),
    };
    let partly = Aabb {
        min: DVec3::new(7.0, 1.0, -1.0),
        max: DVec3::new(9.0, -1.0, 1.0),
    };
    let half = Aabb {
        min: DVec3::new(-1.0, f64::NEG_INFINITY, -1.0),
        max: DVec3::INFINITY,
    };
    let mut array = BoxArray::new();
    for bounds in [everywhere, Aabb::EMPTY, odd, inverted, partly, half] {
        array.push(bounds);
    }
    let mut out = Vec::new();
    frustum.cull(&array, &mut out);
    assert_eq!(out, [0, 2, 5]);
    assert!(!frustum.intersects(&inverted) && !frustum.intersects(&partly));
    assert!(frustum.intersects(&half));
    assert!(frustum.intersects(&everywhere));
    assert!(!frustum.intersects(&Aabb::EMPTY));
}

#[test]
fn the_matrices_say_what_the_frustum_says() {
    let eye = DVec3::new(1e7, -3.0, 4e6);
    for projection in [
        perspective(1.0, 0.25),
        Projection::OffAxis {
            fov_y: 1.0,
            near: 0.25,
            shift: DVec2::new(0.3, -0.2),
        },
        Projection::Orthographic {
            height: 10.0,
            near: 0.5,
            far: 20.5,
        },
    ] {
        let camera =
            Camera::look_at(eye, eye + DVec3::new(1.0, -2.0, 0.5), DVec3::Y, projection).unwrap();
        let matrix = camera.projection_matrix(ASPECT) * camera.view_rotation();
        let clip = |right: f64, up: f64, ahead: f64| -> Vec3 {
            let point = camera.position
                + camera.right() * right
                + camera.up() * up
                + camera.forward() * ahead;
            let relative: Vec3 = (point - camera.position).as_vec3();
            let clip: Vec4 = matrix * relative.extend(1.0);
            clip.truncate() / clip.w
        };
        let off = middle(&camera, camera.near());
        let near = clip(off.x, off.y, camera.near());
        assert!(
            near.abs_diff_eq(Vec3::Z, 1e-5),
            "depth is 1 at the near plane: {near}"
        );
        let far = match projection {
            Projection::Orthographic { far, .. } => far,
            _ => 1e9,
        };
        assert!(clip(0.0, 0.0, far).z.abs() < 1e-5, "and 0 far away");
        let up = side_limit(&camera, 2.0);
        let off = middle(&camera, 2.0);
        let corner = clip(off.x + up * ASPECT, off.y + up, 2.0);
        assert!(
            (corner.truncate() - glam::Vec2::ONE).abs().max_element() < 1e-4,
            "{corner}"
        );
        assert!(
            clip(0.0, 0.0, 1.0).z > clip(0.0, 0.0, 2.0).z,
            "nearer is greater"
        );
        let planes = camera.frustum(ASPECT).planes().to_vec();
        let count = match projection {
            Projection::Orthographic { .. } => 6,
            _ => 5,
        };
        assert_eq!(planes.len(), count);
        for plane in planes {
            assert!((plane.normal.length() - 1.0).abs() < 1e-12);
            assert!(
                plane.distance(camera.position + camera.forward() * 2.0) > 0.0,
                "inwards"
            );
        }
    }
}

#[test]
fn cameras_that_cannot_look_name_the_number() {
    let at = |projection| Camera::new(projection, DVec3::ZERO, DQuat::IDENTITY).unwrap_err();
    assert_eq!(at(perspective(1.0, 0.0)), CameraError::Near { near: 0.0 });
    assert_eq!(
        at(perspective(4.0, 0.1)),
        CameraError::FieldOfView { fov_y: 4.0 }
    );
    assert!(
        at(perspective(f64::NAN, 0.1))
            .to_string()
            .contains("fov_y is NaN")
    );
    assert!(
        at(perspective(1.0, f64::INFINITY))
            .to_string()
            .contains("near is inf")
    );
    let aside = |shift| Projection::OffAxis {
        fov_y: 1.0,
        near: 0.1,
        shift,
    };
    for shift in [DVec2::new(f64::NAN, 0.0), DVec2::new(0.0, f64::INFINITY)] {
        assert!(at(aside(shift)).to_string().contains("shift"), "{shift}");
    }
    let closed = Projection::OffAxis {
        fov_y: 0.0,
        near: 0.1,
        shift: DVec2::ZERO,
    };
    assert_eq!(at(closed), CameraError::FieldOfView { fov_y: 0.0 });
    let behind = Projection::OffAxis {
        fov_y: 1.0,
        near: -0.1,
        shift: DVec2::ZERO,
    };
    assert_eq!(at(behind), CameraError::Near { near: -0.1 });
    let flat = Projection::Orthographic {
        height: 0.0,
        near: 0.0,
        far: 1.0,
    };
    assert_eq!(at(flat), CameraError::Height { height: 0.0 });
    let thin = Projection::Orthographic {
        height: 1.0,
        near: 1.0,
        far: 1.0,
    };
    assert_eq!(
        at(thin),
        CameraError::Depth {
            near: 1.0,
            far: 1.0
        }
    );
    let long = Camera::new(
        perspective(1.0, 0.1),
        DVec3::ZERO,
        DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0),
    );
    assert_eq!(long.unwrap_err(), CameraError::Rotation { length: 2.0 });
    let nowhere = Camera::new(perspective(1.0, 0.1), DVec3::NAN, DQuat::IDENTITY);
    assert!(nowhere.unwrap_err().to_string().contains("position"));
    for (eye, target, up) in [
        (DVec3::X, DVec3::X, DVec3::Y),
        (DVec3::ZERO, DVec3::Y, DVec3::Y),
        (DVec3::ZERO, DVec3::X, DVec3::ZERO),
    ] {
        let error = Camera::look_at(eye, target, up, perspective(1.0, 0.1)).unwrap_err();
        assert!(matches!(error, CameraError::NoDirection { .. }), "{error}");
    }
}

#[test]
fn the_eye_inside_a_box_crosses_the_near_plane() {
    let camera =
        Camera::look_at(DVec3::ONE, DVec3::ZERO, DVec3::Y, perspective(1.0, 1e-4)).unwrap();
    let around = Aabb::from_centre(DVec3::ONE, DVec3::splat(0.5));
    assert!(camera.crosses_near(&around, ASPECT));
    assert_eq!(camera.nearest_corner_distance(&around), 0.75_f64.sqrt());
    let behind = Aabb::from_centre(DVec3::splat(3.0), DVec3::splat(0.5));
    assert!(!camera.crosses_near(&behind, ASPECT));
    let ahead = Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5));
    assert!(!camera.crosses_near(&ahead, ASPECT));
    assert!(!camera.crosses_near(&Aabb::EMPTY, ASPECT));
}
