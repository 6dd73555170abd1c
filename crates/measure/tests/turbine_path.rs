//! The camera path of the turbine: it matches its description.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_demo_scenes::{TurbineOptions, turbine};
use antumbra_measure::path::{CameraPath, Pose};
use antumbra_scene::{Aabb, Projection};
use glam::DVec3;

/// Width over height of its images: 1280 x 1024.
const ASPECT: f64 = 1.25;
/// Metres between two eyes.
const EYES: f64 = 0.065;

fn path() -> CameraPath {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../benches/paths/turbine.json"
    );
    CameraPath::load(file).unwrap()
}

/// The boxes around both sizes of the engine.
fn engines() -> [Aabb; 2] {
    [1, 2].map(|size| {
        let options = TurbineOptions {
            size,
            ..TurbineOptions::default()
        };
        let mut scene = turbine(options).unwrap();
        scene.update();
        scene.bounds().unwrap()
    })
}

/// The largest distance of a box from the image's centre, for an eye `aside` metres to the right of the pose; 1 is the edge.
fn reach(pose: &Pose, aside: f64, fov_y: f64, bounds: &Aabb) -> f64 {
    let tan = (fov_y / 2.0).tan();
    let eye = pose.position + pose.rotation * DVec3::X * aside;
    let out = bounds.corners().map(|corner| {
        let seen = pose.rotation.inverse() * (corner - eye);
        assert!(seen.z < 0.0, "a corner lies behind the eye");
        (seen.x.abs() / ASPECT).max(seen.y.abs()) / (-seen.z * tan)
    });
    out.into_iter().fold(0.0, f64::max)
}

/// Metres between the eyes of two poses, and degrees between their viewing directions.
fn step(from: &Pose, to: &Pose) -> [f64; 2] {
    let turn = from.rotation.angle_between(to.rotation).to_degrees();
    [from.position.distance(to.position), turn]
}

#[test]
fn the_engine_is_whole_in_every_picture_and_fills_it() {
    let path = path();
    let Projection::Perspective { fov_y, near } = path.projection() else {
        panic!("no perspective");
    };
    assert!((fov_y.to_degrees() - 45.0).abs() < 1e-9 && near == 0.05);
    for bounds in engines() {
        let mut fill = 0.0;
        for (number, pose) in path.poses().iter().enumerate() {
            let reach = [-0.5, 0.0, 0.5].map(|side| reach(pose, side * EYES, fov_y, &bounds));
            let most = reach.into_iter().fold(0.0, f64::max);
            assert!(most < 0.98, "pose {number} reaches {most} of the picture");
            assert!(most > 0.8, "pose {number} reaches only {most}");
            fill += most / path.poses().len() as f64;
        }
        assert!(fill > 0.9, "the engine reaches {fill} of the way out");
    }
}

#[test]
fn neighbouring_poses_are_close_and_none_is_a_cut() {
    let path = path();
    let poses = path.poses();
    assert_eq!(poses.len(), 800);
    assert!(poses.iter().all(|pose| !pose.cut));
    for (number, pair) in poses.windows(2).enumerate() {
        let [way, turn] = step(&pair[0], &pair[1]);
        assert!(
            way < 0.15 && turn < 1.2,
            "{number}: {way} m, {turn} degrees"
        );
    }
    for (number, three) in poses.windows(3).enumerate() {
        let [a, b, c] = [three[0], three[1], three[2]].map(|pose| pose.position);
        let jerk = (c - b - (b - a)).length();
        assert!(
            jerk < 0.01,
            "the eye starts or stops by {jerk} m at {number}"
        );
        assert!((three[1].rotation * DVec3::X).y.abs() < 1e-6, "no roll");
    }
}

#[test]
fn the_eye_halts_twice() {
    let path = path();
    let steps: Vec<_> = path
        .poses()
        .windows(2)
        .map(|p| step(&p[0], &p[1]))
        .collect();
    let stands = |range: std::ops::Range<usize>| steps[range].iter().all(|[way, _]| *way == 0.0);
    let still = &path.poses()[260..300];
    assert!(still.iter().all(|pose| *pose == still[0]));
    assert!(stands(540..599) && !stands(539..540) && !stands(599..600));
    let turned = steps[540..599].iter().map(|[_, turn]| turn).sum::<f64>();
    assert!((3.0..8.0).contains(&turned), "{turned} degrees in all");
}

#[test]
fn it_sees_all_sides_from_below_and_above() {
    let path = path();
    let poses = path.poses().iter();
    let from: Vec<_> = poses.map(|pose| pose.rotation * DVec3::Z).collect();
    let elevations = from.iter().map(|from| from.y.asin().to_degrees());
    let (low, high) = elevations.fold((90.0f64, -90.0f64), |(low, high), e| {
        (low.min(e), high.max(e))
    });
    assert!(low < -19.0 && high > 59.0, "{low} to {high} degrees");
    for side in 0..24 {
        let azimuth = f64::from(side) * 15f64.to_radians();
        let seen = from
            .iter()
            .any(|from| (from.x.atan2(from.z) - azimuth).cos() > 0.999);
        assert!(seen, "nothing from {} degrees", side * 15);
    }
}
