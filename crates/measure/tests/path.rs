//! Camera paths: their course, their smoothness, and hostile files.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_measure::path::{CameraPath, MAX_PATH_BYTES, MAX_POSES, Orbit, Pose, Waypoint};
use antumbra_scene::{Aabb, Projection};
use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::*;

fn extents() -> impl Strategy<Value = Aabb> {
    let coordinate = || prop::array::uniform3(-1.0..1.0f64);
    (coordinate(), coordinate(), -3.0..9.0f64).prop_map(|(a, b, exponent)| {
        let scale = 10f64.powf(exponent);
        Aabb::new(DVec3::from_array(a) * scale, DVec3::from_array(b) * scale)
    })
}

proptest! {
    #[test]
    fn an_orbit_around_a_scene_has_all_of_it_in_view(bounds in extents(), aspect in 0.4..3.0f64) {
        let path = CameraPath::orbit_around(&bounds, aspect, 9).unwrap();
        let Projection::Perspective { fov_y, near } = path.projection() else { panic!() };
        let tan = (fov_y / 2.0).tan();
        for pose in path.poses() {
            for corner in bounds.corners() {
                let seen = pose.rotation.inverse() * (corner - pose.position);
                prop_assert!(-seen.z > near, "in front of the near plane");
                prop_assert!(seen.y.abs() <= -seen.z * tan && seen.x.abs() <= -seen.z * tan * aspect);
            }
        }
    }

    #[test]
    fn a_flight_is_smooth(bounds in extents(), seed in any::<u64>()) {
        let frames = 600;
        let path = CameraPath::flight(&bounds, seed, frames).unwrap();
        prop_assert_eq!(path.poses().len(), frames);
        let radius = bounds.half_extents().length();
        // Ten control points, nine segments; neighbours are at most 4 radii apart.
        let step = 9.0 / (frames - 1) as f64;
        for (i, w) in path.poses().windows(3).enumerate() {
            let way = w[1].position - w[0].position;
            prop_assert!(way.length() <= 4.0 * radius * step, "frame {i} jumps by {}", way.length());
            let jerk = (w[2].position - w[1].position - way).length();
            prop_assert!(jerk <= 8.0 * radius * step * step, "frame {i} jerks by {jerk}");
            let turn = (w[0].rotation * DVec3::NEG_Z).angle_between(w[1].rotation * DVec3::NEG_Z);
            prop_assert!(turn <= 4.0 * step, "frame {i} turns by {turn} radians");
            prop_assert!((w[0].rotation * DVec3::X).y.abs() < 1e-9, "frame {i} rolls");
        }
    }

    #[test]
    fn a_flight_goes_through_the_scene_and_around_it(seed in any::<u64>()) {
        let bounds = Aabb::new(DVec3::new(-30.0, 0.0, -20.0), DVec3::new(30.0, 12.0, 20.0));
        let path = CameraPath::flight(&bounds, seed, 400).unwrap();
        let inside = path.poses().iter().filter(|p| p.position.clamp(bounds.min, bounds.max) == p.position).count();
        prop_assert!((20..=380).contains(&inside), "{inside} of 400 poses are inside");
    }

    #[test]
    fn a_saved_path_comes_back_to_the_bit(bounds in extents(), seed in any::<u64>(), cut in 0usize..7) {
        let flight = CameraPath::flight(&bounds, seed, 7).unwrap();
        let mut poses = flight.poses().to_vec();
        poses[cut].cut = true;
        let path = CameraPath::new("p.json", flight.projection(), poses).unwrap();
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("p.json");
        path.save(&file).unwrap();
        prop_assert_eq!(CameraPath::load(&file).unwrap(), path);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in ".{0,200}", json in r#"[\[\]{}:,"0-9eE.+\-a-z ]{0,120}"#) {
        let _ = CameraPath::from_json("any", text.as_bytes());
        let whole = format!(r#"{{"projection":{{"perspective":{{"fov_y_degrees":45,"near":0.1}}}},"poses":[{json}]}}"#);
        let _ = CameraPath::from_json("any", whole.as_bytes());
    }
}

#[test]
fn the_grid_orbit_is_the_one_of_the_built_in_scene() {
    let path = CameraPath::orbit(&Orbit::grid(100)).unwrap();
    assert_eq!(
        path.projection(),
        Projection::Perspective {
            fov_y: 45f64.to_radians(),
            near: 0.1
        }
    );
    let first = path.poses()[0];
    assert!((first.position - DVec3::new(0.0, 10.0, 40.0)).length() < 1e-12);
    for (i, pose) in path.poses().iter().enumerate() {
        let flat = pose.position.with_y(0.0);
        assert!((flat.length() - 40.0).abs() < 1e-9);
        assert!(
            (pose.position + (pose.rotation * DVec3::NEG_Z) * pose.position.length()).length()
                < 1e-9,
            "pose {i} looks past"
        );
        assert!((flat.angle_between(DVec3::Z) - 0.02 * i as f64).abs() < 1e-7);
    }
}

#[test]
fn the_same_seed_flies_the_same_path_and_another_does_not() {
    let fly = |seed| CameraPath::flight(&Aabb::new(DVec3::NEG_ONE, DVec3::ONE), seed, 50).unwrap();
    assert_eq!(fly(1), fly(1));
    assert_ne!(fly(1), fly(2));
}

#[test]
fn small_and_odd_scenes_have_paths_too() {
    let point = Aabb::new(DVec3::ONE, DVec3::ONE);
    let flat = Aabb::new(DVec3::new(-5.0, 0.0, -5.0), DVec3::new(5.0, 0.0, 5.0));
    for bounds in [Aabb::EMPTY, point, flat] {
        for frames in [1, 2, 3] {
            let flight = CameraPath::flight(&bounds, 3, frames).unwrap();
            let orbit = CameraPath::orbit_around(&bounds, 1.0, frames).unwrap();
            assert_eq!(
                (flight.poses().len(), orbit.cameras().len()),
                (frames, frames)
            );
        }
    }
    for max in [DVec3::INFINITY, DVec3::splat(1e300)] {
        let bounds = Aabb {
            min: DVec3::ZERO,
            max,
        };
        assert!(CameraPath::flight(&bounds, 3, 10).is_err());
        assert!(CameraPath::orbit_around(&bounds, 1.0, 10).is_err());
    }
    assert!(CameraPath::orbit_around(&flat, f64::NAN, 10).is_err());
    assert!(CameraPath::flight(&flat, 3, 0).is_err());
    assert!(CameraPath::flight(&flat, 3, usize::MAX).is_err());
}

#[test]
fn looking_straight_down_has_a_top() {
    let pose = Pose::look_at(DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO, None).unwrap();
    assert!((pose.rotation * DVec3::NEG_Z - DVec3::NEG_Y).length() < 1e-12);
    assert!((pose.rotation * DVec3::Y - DVec3::NEG_Z).length() < 1e-12);
    Pose::look_at(DVec3::ONE, DVec3::ONE, None).unwrap_err();
    Pose::look_at(DVec3::ONE, DVec3::ZERO, Some(DVec3::ONE)).unwrap_err();
}

#[test]
fn a_written_file_is_understood() {
    let text = br#"{ "projection": { "perspective": { "fov_y_degrees": 45, "near": 0.1 } },
        "poses": [ { "eye": [0, 10, 40], "target": [0, 0, 0] },
                   { "eye": [5, 10, 40], "target": [0, 0, 0], "up": [0, 0, 1], "cut": true },
                   { "eye": [6, 10, 40], "rotation": [0, 0, 0, 1] } ] }"#;
    let path = CameraPath::from_json("mine", text).unwrap();
    assert_eq!(path.name(), "mine");
    assert_eq!(
        path.poses().iter().map(|p| p.cut).collect::<Vec<_>>(),
        [false, true, false]
    );
    assert_eq!(path.cameras().nth(2).unwrap().forward(), DVec3::NEG_Z);
    let ortho = br#"{"projection":{"orthographic":{"height":10,"near":-5,"far":50}},"poses":[{"eye":[0,0,0],"target":[1,0,0]}]}"#;
    assert!(matches!(
        CameraPath::from_json("o", ortho).unwrap().projection(),
        Projection::Orthographic { .. }
    ));
}

#[test]
fn a_window_off_the_axis_is_read_and_comes_back() {
    let text = br#"{"projection":{"off_axis":{"fov_y_degrees":90,"near":0.5,"shift":[0.125,-0.1]}},"poses":[{"eye":[0,0,0],"target":[1,0,0]}]}"#;
    let path = CameraPath::from_json("aside", text).unwrap();
    let expected = Projection::OffAxis {
        fov_y: 90f64.to_radians(),
        near: 0.5,
        shift: DVec2::new(0.125, -0.1),
    };
    assert_eq!(path.projection(), expected);
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("aside");
    path.save(&file).unwrap();
    assert_eq!(CameraPath::load(&file).unwrap(), path);
    let without = br#"{"projection":{"off_axis":{"near":0.5,"shift":[0,0]}},"poses":[{"eye":[0,0,0],"target":[1,0,0]}]}"#;
    let error = CameraPath::from_json("aside", without)
        .unwrap_err()
        .to_string();
    assert!(error.contains("fov_y_degrees"), "{error}");
}

#[test]
fn every_bad_pose_is_named() {
    let read = |poses: &str| {
        let text = format!(
            r#"{{"projection":{{"perspective":{{"fov_y_degrees":45,"near":0.1}}}},"poses":[{poses}]}}"#
        );
        CameraPath::from_json("bad", text.as_bytes())
            .unwrap_err()
            .to_string()
    };
    let good = r#"{"eye":[0,0,1],"target":[0,0,0]}"#;
    for (pose, words) in [
        (r#"{"eye":[0,0,NaN],"target":[0,0,0]}"#, "expected value"),
        (r#"{"eye":[0,0,1e999],"target":[0,0,0]}"#, "out of range"),
        (r#"{"eye":[0,0],"target":[0,0,0]}"#, "length"),
        (r#"{"eye":[0,0,1],"target":[0,0,1]}"#, "coincide"),
        (
            r#"{"eye":[0,0,1],"target":[0,0,0],"up":[0,0,1]}"#,
            "parallel to the view",
        ),
        (r#"{"eye":[0,0,1]}"#, "target"),
        (r#"{"eye":[0,0,1],"rotation":[0,0,0,2]}"#, "length is 2"),
        (
            r#"{"eye":[0,0,1],"target":[0,0,0],"rotation":[0,0,0,1]}"#,
            "target",
        ),
        (r#"{"eye":[0,0,1],"taget":[0,0,0]}"#, "taget"),
        (
            r#"{"eye":[0,0,1e308],"target":[0,0,-1e308]}"#,
            "no direction",
        ),
    ] {
        let text = read(&format!("{good},{good},{pose},{good}"));
        assert!(
            text.contains("pose 2") && text.contains(words),
            "{pose}: {text}"
        );
    }
    assert!(read("").contains("no poses"));
    assert!(read(&format!("{}{good}", format!("{good},").repeat(MAX_POSES))).contains("more than"));
}

#[test]
fn a_projection_that_cannot_be_drawn_is_refused() {
    let pose = Pose {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        cut: false,
    };
    for projection in [
        Projection::OffAxis {
            fov_y: 1.0,
            near: 0.1,
            shift: DVec2::new(0.0, f64::NAN),
        },
        Projection::Perspective {
            fov_y: 0.0,
            near: 0.1,
        },
        Projection::Perspective {
            fov_y: f64::NAN,
            near: 0.1,
        },
        Projection::Perspective {
            fov_y: 4.0,
            near: 0.1,
        },
        Projection::Perspective {
            fov_y: 1.0,
            near: 0.0,
        },
        Projection::Orthographic {
            height: -1.0,
            near: 0.0,
            far: 1.0,
        },
        Projection::Orthographic {
            height: 1.0,
            near: 1.0,
            far: 1.0,
        },
    ] {
        assert!(
            CameraPath::new("p", projection, vec![pose]).is_err(),
            "{projection:?}"
        );
    }
    let good = Projection::Perspective {
        fov_y: 1.0,
        near: 0.1,
    };
    let bad = Pose {
        position: DVec3::new(0.0, f64::NAN, 0.0),
        ..pose
    };
    assert!(
        CameraPath::new("p", good, vec![pose, bad])
            .unwrap_err()
            .to_string()
            .contains("pose 1")
    );
}

#[test]
fn a_huge_file_is_left_before_memory_is() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("huge.json");
    std::fs::File::create(&file)
        .unwrap()
        .set_len(MAX_PATH_BYTES * 100)
        .unwrap();
    assert!(
        CameraPath::load(&file)
            .unwrap_err()
            .to_string()
            .contains("larger than")
    );
    assert!(
        CameraPath::load(dir.path().join("none.json"))
            .unwrap_err()
            .to_string()
            .contains("none.json")
    );
    std::fs::write(&file, "{").unwrap();
    assert!(
        CameraPath::load(&file)
            .unwrap_err()
            .to_string()
            .contains("huge.json")
    );
}

#[test]
fn a_flight_through_places_goes_from_the_first_to_the_last() {
    let waypoints: Vec<Waypoint> = (0..6)
        .map(|i| Waypoint {
            eye: DVec3::new(f64::from(i) * 100.0, 50.0, 80.0),
            target: DVec3::ZERO,
        })
        .collect();
    let projection = Projection::Perspective {
        fov_y: 1.0,
        near: 0.5,
    };
    let through =
        |whole, frames| CameraPath::through("mine", &waypoints, projection, whole, frames).unwrap();
    let whole = through(60, 60);
    let [first, last] = [whole.poses()[0], whole.poses()[59]];
    // The spline repeats its end points, so the path ends near them, not at them.
    assert!(
        first.position.distance(waypoints[0].eye) < 20.0,
        "{}",
        first.position
    );
    assert!(
        last.position.distance(waypoints[5].eye) < 20.0,
        "{}",
        last.position
    );
    assert!((first.rotation * DVec3::NEG_Z).dot((DVec3::ZERO - first.position).normalize()) > 0.98);
    assert!(whole.poses().iter().all(|pose| !pose.cut));

    // In bursts: each pose is one of the whole flight's, and follows the one before except at a cut.
    let parts = through(60, 30);
    assert_eq!(parts.poses().len(), 30);
    let at = |pose: &Pose| {
        let same =
            |other: &Pose| other.position == pose.position && other.rotation == pose.rotation;
        whole
            .poses()
            .iter()
            .position(same)
            .expect("a pose of the whole flight")
    };
    let places: Vec<usize> = parts.poses().iter().map(at).collect();
    let cuts: Vec<usize> = (0..30).filter(|i| parts.poses()[*i].cut).collect();
    assert_eq!(cuts, [0, 12, 24]);
    for i in 1..30 {
        assert!(
            parts.poses()[i].cut || places[i] == places[i - 1] + 1,
            "{places:?}"
        );
    }
    assert_eq!((places[0], places[24]), (0, 48));

    assert!(CameraPath::through("none", &[], projection, 60, 60).is_err());
    assert_eq!(through(60, 1).poses().len(), 1);
}
