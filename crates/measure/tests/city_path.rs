//! The camera paths of the city: they match their descriptions, and their eyes are not inside of anything.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_demo_scenes::{CityOptions, city};
use antumbra_measure::path::{CameraPath, Pose};
use antumbra_scene::{Aabb, Camera, EntityKey, Projection, Scene};
use glam::{DMat3, DVec3};

/// Poses of the flight; the rest are a walk.
const FLIGHT: usize = 34;
/// Least distance of the eye from everything, in metres.
const CLEAR: f64 = 0.15;

const PATHS: [&str; 2] = ["city.json", "city-middle.json"];

fn path(name: &str) -> CameraPath {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benches/paths");
    CameraPath::load(std::path::Path::new(folder).join(name)).unwrap()
}

fn ahead(pose: &Pose) -> DVec3 {
    pose.rotation * DVec3::NEG_Z
}

/// The entities whose boxes overlap a box, with their triangles in world space.
fn near(scene: &Scene, within: &Aabb) -> Vec<(EntityKey, Vec<[DVec3; 3]>)> {
    let drawables = scene.drawables().filter(|(entity, _)| {
        let bounds = scene.world_bounds(*entity).unwrap();
        bounds.min.cmple(within.max).all() && within.min.cmple(bounds.max).all()
    });
    let placed = drawables.map(|(entity, drawable)| {
        let world = scene.world(entity).unwrap();
        let geometry = scene.mesh(drawable.mesh).unwrap().full().unwrap();
        let triangles = geometry.triangles().map(|triangle| {
            let corners = geometry.corners(triangle).unwrap();
            corners.map(|corner| world.transform_point3(corner))
        });
        (entity, triangles.collect())
    });
    placed.collect()
}

/// The point of a triangle that is nearest to `from`.
fn nearest([a, b, c]: [DVec3; 3], from: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let inside = |p: DVec3, q: DVec3| normal.dot((q - p).cross(from - p)) >= 0.0;
    if normal != DVec3::ZERO && inside(a, b) && inside(b, c) && inside(c, a) {
        return from - normal * (normal.dot(from - a) / normal.length_squared());
    }
    let on_edge = |(p, q): (DVec3, DVec3)| {
        let along = q - p;
        p + along * (along.dot(from - p) / along.length_squared().max(1e-30)).clamp(0.0, 1.0)
    };
    let ends = [(a, b), (b, c), (c, a)].map(on_edge);
    let by_distance = |p: &DVec3, q: &DVec3| p.distance(from).total_cmp(&q.distance(from));
    ends.into_iter().min_by(by_distance).unwrap()
}

/// Whether the segment between two points intersects a triangle.
fn crosses([a, b, c]: [DVec3; 3], from: DVec3, to: DVec3) -> bool {
    let sides = DMat3::from_cols(b - a, c - a, from - to);
    if sides.determinant().abs() < 1e-15 {
        return false;
    }
    let [u, v, way] = (sides.inverse() * (from - a)).to_array();
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&way)
}

#[test]
fn they_are_ninety_six_close_poses_without_a_cut_or_roll() {
    for name in PATHS {
        close(&path(name));
    }
}

fn close(path: &CameraPath) {
    let Projection::Perspective { fov_y, near } = path.projection() else {
        panic!("no perspective");
    };
    assert!((fov_y.to_degrees() - 60.0).abs() < 1e-9 && near == 0.05);
    let poses = path.poses();
    assert_eq!(poses.len(), 96);
    assert!(poses.iter().all(|pose| !pose.cut));
    for (number, pair) in poses.windows(2).enumerate() {
        let way = pair[0].position.distance(pair[1].position);
        let turn = pair[0].rotation.angle_between(pair[1].rotation);
        let (far, much) = if number + 1 < FLIGHT {
            (3.0, 4.0)
        } else {
            (0.5, 5.0)
        };
        assert!(way < far, "{number}: {way} m");
        assert!(
            turn.to_degrees() < much,
            "{number}: {} degrees",
            turn.to_degrees()
        );
        assert!((pair[0].rotation * DVec3::X).y.abs() < 1e-6, "no roll");
    }
}

#[test]
fn one_rises_above_the_roofs_and_walks_round_a_corner_into_a_house() {
    let path = path("city-middle.json");
    let (flight, walk) = path.poses().split_at(FLIGHT);
    let heights = flight.iter().map(|pose| pose.position.y);
    let highest = heights.fold(0.0, f64::max);
    assert!((40.0..120.0).contains(&highest), "{highest} m");
    assert!(flight[0].position.y < 10.0, "it begins between the houses");
    for (number, pose) in walk.iter().enumerate() {
        let floor = pose.position.y - 1.7;
        assert!((-0.01..0.21).contains(&floor), "{number}: {floor} m");
    }
    let turned = ahead(&walk[0]).angle_between(ahead(&walk[walk.len() - 1]));
    assert!(
        turned.to_degrees() > 150.0,
        "about the corner and into the door"
    );
    // The last pose is under a ceiling, the first of the walk under the sky.
    let mut scene = city(CityOptions::default()).unwrap();
    scene.update();
    let covered = |pose: &Pose| {
        let (from, to) = (pose.position, pose.position + DVec3::Y * 100.0);
        let above = near(&scene, &Aabb::new(from, to));
        let mut triangles = above.iter().flat_map(|(_, triangles)| triangles);
        triangles.any(|triangle| crosses(*triangle, from, to))
    };
    assert!(!covered(&walk[0]) && covered(&walk[walk.len() - 1]));
    assert!(!covered(&flight[0]), "it begins under the sky");
}

#[test]
fn one_comes_in_from_outside_and_walks_along_the_edge() {
    let path = path("city.json");
    let mut scene = city(CityOptions::default()).unwrap();
    scene.update();
    let all = scene.bounds().unwrap();
    let (flight, walk) = path.poses().split_at(FLIGHT);
    assert!(flight[0].position.y > 40.0 && !all.contains(flight[0].position));
    assert!(walk.iter().all(|pose| (pose.position.y - 1.7).abs() < 1e-3));
    // Seen from its corner, most of the city is ahead, and some of it never is.
    let middle = |entity: &EntityKey| scene.world_bounds(*entity).unwrap().centre();
    let entities: Vec<EntityKey> = scene.drawables().map(|(entity, _)| entity).collect();
    for pose in path.poses().iter().step_by(8) {
        let camera = Camera::new(path.projection(), pose.position, pose.rotation).unwrap();
        let frustum = camera.frustum(4.0 / 3.0);
        let seen = entities
            .iter()
            .filter(|entity| frustum.intersects(&Aabb::new(middle(entity), middle(entity))));
        let share = seen.count() as f64 / entities.len() as f64;
        assert!((0.3..0.99).contains(&share), "{share} of all are ahead");
    }
}

#[test]
fn their_eyes_come_close_to_nothing_and_pass_through_nothing() {
    let mut scene = city(CityOptions::default()).unwrap();
    scene.update();
    for name in PATHS {
        clear(&scene, &path(name));
    }
}

fn clear(scene: &Scene, path: &CameraPath) {
    for (number, pair) in path.poses().windows(2).enumerate() {
        let [from, to] = [pair[0].position, pair[1].position];
        let around = Aabb::new(from.min(to) - CLEAR, from.max(to) + CLEAR);
        for (entity, triangles) in near(scene, &around) {
            let what = scene.mesh(scene.drawable(entity).unwrap().mesh).unwrap();
            for triangle in triangles {
                let away = nearest(triangle, to).distance(to);
                assert!(
                    away > CLEAR,
                    "pose {}: {away} m to a {}",
                    number + 1,
                    what.name
                );
                let through = crosses(triangle, from, to);
                assert!(!through, "through a {} after pose {number}", what.name);
            }
        }
    }
}

#[test]
fn in_the_middle_parts_of_the_city_are_outside_every_frustum() {
    let path = path("city-middle.json");
    let mut scene = city(CityOptions::default()).unwrap();
    scene.update();
    let bounds = scene.bounds().unwrap();
    for (number, pose) in path.poses().iter().enumerate() {
        let behind = bounds
            .corners()
            .into_iter()
            .filter(|corner| ahead(pose).dot(*corner - pose.position) < 0.0);
        assert!(
            behind.count() > 0,
            "pose {number} has the whole city before it"
        );
    }
}
