//! Cameras with a matrix: what they see and what crosses their near plane, against points that are projected one by one.
#![allow(clippy::unwrap_used)]

use antumbra_scene::{Aabb, Camera, ClipMatrix, Projection};
use glam::{DMat4, DQuat, DVec2, DVec3, DVec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

fn rows(rows: [DVec4; 4]) -> DMat4 {
    DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
}

/// Perspective and parallel matrices beside the axis, forward and reversed, with and without far planes, with straight and oblique near planes.
fn matrix(random: &mut Pcg32) -> ClipMatrix {
    let mut around = |middle: f64, reach: f64| middle + random.random_range(-reach..reach);
    let parallel = around(0.0, 1.0) > 0.0;
    let w = match parallel {
        true => DVec4::W,
        false => DVec4::NEG_Z,
    };
    let x = DVec4::new(around(1.2, 0.8), 0.0, around(0.0, 0.4), 0.0);
    let y = DVec4::new(0.0, around(1.2, 0.8), around(0.0, 0.4), 0.0);
    // In front of a plane around a metre away.
    let plane = DVec4::new(around(0.0, 0.3), around(0.0, 0.3), -1.0, around(-1.0, 0.5));
    // So that depths stay above 0 for some way.
    let near = plane * if parallel { 0.05 } else { 0.5 };
    if around(0.0, 1.0) > 0.0 {
        ClipMatrix::reversed(rows([x, y, w - near, w])).unwrap()
    } else {
        ClipMatrix::forward(rows([x, y, near, w])).unwrap()
    }
}

/// A camera around a place that is far from the origin, and the matrix from points relative to it to clip space.
fn camera(random: &mut Pcg32) -> (Camera, DMat4) {
    let matrix = matrix(random);
    let mut number = || random.random_range(-1.0..1.0);
    let axis = DVec3::new(number(), number(), number()).normalize();
    let rotation = DQuat::from_axis_angle(axis, number() * 3.0);
    let position = DVec3::new(number(), number(), number()) * 1e5;
    let camera = Camera::new(Projection::Matrix(matrix), position, rotation).unwrap();
    (
        camera,
        matrix.matrix() * DMat4::from_quat(rotation.inverse()),
    )
}

/// Points of a box around a camera, relative to it.
fn bounds(random: &mut Pcg32, camera: &Camera) -> (Aabb, Vec<DVec3>) {
    let mut number = || random.random_range(-1.0..1.0);
    let centre = camera.rotation * DVec3::new(number() * 4.0, number() * 4.0, number() * 6.0 - 3.0);
    let half = DVec3::new(number(), number(), number()).abs() * 2.0;
    let steps = (0..7).map(|step| f64::from(step) / 3.0 - 1.0);
    let mut points = Vec::new();
    for x in steps.clone() {
        for y in steps.clone() {
            for z in steps.clone() {
                points.push(centre + half * DVec3::new(x, y, z));
            }
        }
    }
    let middle = camera.position + centre;
    (Aabb::new(middle - half, middle + half), points)
}

#[test]
fn what_is_on_the_image_is_in_the_frustum_and_what_is_far_from_it_is_not() {
    let mut random = Pcg32::seed_from_u64(5);
    let (mut seen, mut unseen) = (0, 0);
    for _ in 0..4_000 {
        let (camera, clip) = camera(&mut random);
        let (bounds, points) = bounds(&mut random, &camera);
        let part = [-1.0, -0.3, 0.2, 1.0].map(DVec2::splat);
        for (low, high) in [(part[0], part[3]), (part[1], part[2])] {
            let frustum = camera.window(1.0, low, high);
            let inside = points.iter().any(|point| {
                let clip = clip * point.extend(1.0);
                let at = clip.truncate() / clip.w;
                clip.w > 0.0
                    && at.truncate().cmpge(low).all()
                    && at.truncate().cmple(high).all()
                    && (0.0..=1.0).contains(&at.z)
            });
            assert!(
                frustum.intersects(&bounds) || !inside,
                "{camera:?} {bounds:?}"
            );
            seen += u32::from(inside);
            unseen += u32::from(!frustum.intersects(&bounds));
        }
    }
    assert!(seen > 1_000 && unseen > 2_000, "{seen} and {unseen}");
}

#[test]
fn what_the_near_plane_cuts_crosses_it_and_what_is_in_front_of_it_does_not() {
    let mut random = Pcg32::seed_from_u64(6);
    let (mut cut, mut clear) = (0, 0);
    for _ in 0..8_000 {
        let (camera, clip) = camera(&mut random);
        let (bounds, points) = bounds(&mut random, &camera);
        let clips = || points.iter().map(|point| clip * point.extend(1.0));
        let crosses = camera.crosses_near(&bounds, 1.0);
        // Within the image's sides, on both sides of the plane.
        let within =
            || clips().filter(|clip| clip.w > 0.0 && clip.x.abs().max(clip.y.abs()) <= clip.w);
        let behind = within().any(|clip| clip.z > clip.w);
        let before = within().any(|clip| clip.z <= clip.w);
        let beside = clips().any(|clip| clip.w <= 0.0 && clip.z <= clip.w);
        assert!(
            crosses || !(behind && before || beside),
            "{camera:?} {bounds:?}"
        );
        cut += u32::from(behind && before);
        // Clearly in front of the plane and of the eye.
        let front = clips().all(|clip| clip.w > 0.01 && clip.w - clip.z > 0.01);
        assert!(!(crosses && front), "{camera:?} {bounds:?}");
        clear += u32::from(front);
    }
    assert!(cut > 300 && clear > 1_000, "{cut} and {clear}");
}

#[test]
fn the_near_plane_and_the_divisor_are_those_of_the_other_projections() {
    let eye = DVec3::new(3.0, -2.0, 5.0);
    for projection in [
        Projection::Perspective {
            fov_y: 0.9,
            near: 0.1,
        },
        Projection::OffAxis {
            fov_y: 0.7,
            near: 0.3,
            shift: DVec2::new(0.2, -0.1),
        },
        Projection::Orthographic {
            height: 4.0,
            near: -1.0,
            far: 20.0,
        },
    ] {
        let own = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection).unwrap();
        let matrix = ClipMatrix::reversed(own.projection_matrix(1.25).as_dmat4()).unwrap();
        let same = Camera {
            projection: Projection::Matrix(matrix),
            ..own
        };
        assert!((own.near() - same.near()).abs() < 1e-5, "{}", same.near());
        let (ours, theirs) = (own.divisor(), same.divisor());
        assert!(ours.0.abs_diff_eq(theirs.0, 1e-6) && (ours.1 - theirs.1).abs() < 1e-6);
        let (ours, theirs) = (own.near_plane(), same.near_plane());
        assert!(ours.normal.abs_diff_eq(theirs.normal, 1e-6));
        assert!((ours.distance(DVec3::ZERO) - theirs.distance(DVec3::ZERO)).abs() < 1e-5);
        // Their pixels are bounded by each other.
        let [least, most] = matrix.pixels_a_metre([500, 400]);
        let middle = f64::from(own.projection_matrix(1.25).y_axis.y) * 200.0;
        assert!(least <= middle && middle <= most, "{least} {middle} {most}");
    }
}
