//! The camera paths through fetched files: they match their descriptions. Where a file is missing (`scripts/data.sh engine city` fetches
//! them), only the path is tested.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_formats::{LoadOptions, load};
use antumbra_measure::path::{CameraPath, Pose};
use antumbra_scene::{Aabb, Projection, Scene};
use glam::DVec3;

/// Width over height of their images: 1280 x 1024.
const ASPECT: f64 = 1.25;
/// Poses on foot, in Delft.
const WALK: usize = 67;
/// Poses from which the whole engine is in view.
const WHOLE: usize = 56;

fn repository() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn path(name: &str, fov_y_degrees: f64, near: f64) -> CameraPath {
    let path = CameraPath::load(repository().join("benches/paths").join(name)).unwrap();
    let Projection::Perspective { fov_y, near: n } = path.projection() else {
        panic!("no perspective");
    };
    assert!((fov_y.to_degrees() - fov_y_degrees).abs() < 1e-9 && n == near);
    assert_eq!(path.poses().len(), 120);
    for pose in path.poses() {
        assert!(!pose.cut);
        assert!((pose.rotation * DVec3::X).y.abs() < 1e-6, "no roll");
    }
    path
}

/// The scene of a fetched file; `None` where the file is missing.
fn scene(name: &str) -> Option<Scene> {
    let file = repository().join("data").join(name);
    if !file.is_file() {
        eprintln!("skipped: {} is not there", file.display());
        return None;
    }
    let mut scene = load(&file, &LoadOptions::default()).unwrap();
    scene.update();
    Some(scene)
}

#[track_caller]
fn assert_close(poses: &[Pose], way: f64, turn: f64) {
    for (number, pair) in poses.windows(2).enumerate() {
        let far = pair[0].position.distance(pair[1].position);
        let turned = pair[0].rotation.angle_between(pair[1].rotation);
        let turned = turned.to_degrees();
        assert!(
            far <= way && turned <= turn,
            "{number}: {far} m, {turned} degrees"
        );
    }
}

/// The boxes of all drawables.
fn boxes(scene: &Scene) -> Vec<Aabb> {
    let drawn = scene.drawables();
    drawn.filter_map(|(e, _)| scene.world_bounds(e)).collect()
}

/// Metres along the ground from a point to a box.
fn aside(bounds: &Aabb, point: DVec3) -> f64 {
    let nearest = point.clamp(bounds.min, bounds.max) - point;
    nearest.with_y(0.0).length()
}

/// Whether a line from a point crosses an odd number of faces of an entity.
fn is_inside(scene: &Scene, point: DVec3) -> bool {
    scene.drawables().any(|(entity, drawable)| {
        let bounds = scene.world_bounds(entity).unwrap();
        if aside(&bounds, point) > 0.0 || point.y > bounds.max.y {
            return false;
        }
        let local = scene
            .world(entity)
            .unwrap()
            .inverse()
            .transform_point3(point);
        let full = scene.mesh(drawable.mesh).unwrap().full().unwrap();
        let above = full.triangles().filter(|triangle| {
            let [a, b, c] = full
                .corners(*triangle)
                .unwrap()
                .map(|corner| corner - local);
            let side = |p: DVec3, q: DVec3| p.x * q.z - p.z * q.x;
            let sides = [side(a, b), side(b, c), side(c, a)];
            let around = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
            around && {
                let normal = (b - a).cross(c - a);
                normal.dot(a) / normal.y > 0.0
            }
        });
        above.count() % 2 == 1
    })
}

#[test]
fn delft_is_walked_and_then_flown_over() {
    let path = path("delft.json", 60.0, 0.1);
    let (walk, flight) = path.poses().split_at(WALK);
    assert_close(walk, 0.7, 5.0);
    assert_close(&path.poses()[WALK - 1..], 6.0, 4.0);
    let eye = walk[0].position.y;
    assert!(walk.iter().all(|pose| (pose.position.y - eye).abs() < 0.1));
    let low = flight
        .windows(2)
        .all(|p| p[1].position.y >= p[0].position.y);
    assert!(low, "it only rises");
    let high = flight.iter().filter(|pose| pose.position.y > 60.0).count();
    assert!(high >= 25, "{high} poses over the town");
    assert!(flight.iter().all(|pose| pose.position.y < 150.0));
}

#[test]
fn delft_is_walked_at_a_mans_height_between_its_houses() {
    let (path, Some(scene)) = (path("delft.json", 60.0, 0.1), scene("delft.city.jsonl")) else {
        return;
    };
    let boxes = boxes(&scene);
    for (number, pose) in path.poses().iter().enumerate() {
        let eye = pose.position;
        assert!(!is_inside(&scene, eye), "pose {number} is inside a house");
        if number >= WALK {
            continue;
        }
        let beside = |bounds: &&Aabb| aside(bounds, eye) < 12.0;
        let ground: Vec<_> = boxes.iter().filter(beside).map(|b| b.min.y).collect();
        assert!(ground.len() >= 3, "pose {number} is not among houses");
        let mean = ground.iter().sum::<f64>() / ground.len() as f64;
        let height = eye.y - mean;
        assert!(
            (height - 1.7).abs() < 0.25,
            "pose {number}: {height} m above the ground"
        );
    }
    let bounds = scene.bounds().unwrap();
    let last = path.poses()[119].position;
    assert!(aside(&bounds, last) == 0.0, "it ends over the town");
}

#[test]
fn the_engine_is_circled_and_then_seen_from_close() {
    let path = path("engine.json", 45.0, 1.0);
    // The engine is 743 long.
    assert_close(&path.poses()[..WHOLE], 51.0, 3.0);
    assert_close(&path.poses()[WHOLE - 1..], 51.0, 4.0);
    assert_close(&path.poses()[90..], 20.0, 3.0);
}

#[test]
fn the_engine_is_whole_first_and_reaches_out_of_the_picture_then() {
    let (path, Some(scene)) = (path("engine.json", 45.0, 1.0), scene("2CylinderEngine.glb")) else {
        return;
    };
    let bounds = scene.bounds().unwrap();
    let tan = 22.5_f64.to_radians().tan();
    let boxes = boxes(&scene);
    // The distance of a point from the image's centre; 1 is the edge.
    let reach = |pose: &Pose, point: DVec3| {
        let seen = pose.rotation.inverse() * (point - pose.position);
        if seen.z >= 0.0 {
            return f64::INFINITY;
        }
        (seen.x.abs() / ASPECT).max(seen.y.abs()) / (-seen.z * tan)
    };
    for (number, pose) in path.poses().iter().enumerate() {
        let corners = bounds.corners();
        let most = corners.map(|corner| reach(pose, corner));
        let most = most.into_iter().fold(0.0, f64::max);
        if number < WHOLE {
            assert!(most < 1.0, "pose {number} reaches {most} of the picture");
        }
        let within = |b: &&Aabb| b.contains(pose.position);
        let parts = boxes
            .iter()
            .filter(|b| reach(pose, b.centre()) > 1.0)
            .count();
        if number >= 90 {
            assert!(
                parts * 3 > boxes.len() * 2,
                "pose {number}: {parts} parts out"
            );
        }
        assert_eq!(boxes.iter().filter(within).count(), 0, "pose {number}");
    }
}
