//! Input that is refused: the error names the entity, the pose or the view, and the number.

use antumbra::cull::{Stage, StageOptions, ViewInput, ViewSpec};
use antumbra::draw::GpuScene;
use antumbra::measure::path::{CameraPath, Pose};
use antumbra::scene::{Camera, Geometry, Mesh, Projection, Scene};
use antumbra::strategies::registry;
use antumbra_testing::{SceneBuilder, gpus, look_at, perspective_degrees};
use glam::{DAffine3, DQuat, DVec3};

/// Asserts that a message contains all of these words.
fn says(message: impl std::fmt::Display, words: &[&str]) {
    let message = message.to_string();
    for word in words {
        assert!(message.contains(word), "'{word}' is not in: {message}");
    }
}

/// A scene with a ball named `ball`.
fn named() -> (SceneBuilder, antumbra::scene::EntityKey) {
    let mut set = SceneBuilder::new();
    let ball = set.ball(DVec3::ZERO, 1.0);
    set.scene.set_entity_name(ball, "ball").unwrap();
    (set, ball)
}

#[test]
fn a_transform_of_nan_names_its_entity_and_the_number() {
    let (mut set, ball) = named();
    for (place, number) in [
        (
            DAffine3::from_translation(DVec3::new(1.0, f64::NAN, 3.0)),
            "NaN",
        ),
        (DAffine3::from_scale(DVec3::splat(f64::INFINITY)), "inf"),
        (DAffine3::from_quat(DQuat::NAN), "NaN"),
    ] {
        let before = set.scene.local(ball);
        let error = set.scene.set_local(ball, place).unwrap_err();
        says(error, &["\"ball\"", "local transform", number]);
        assert_eq!(set.scene.local(ball), before);
        let error = set.scene.spawn(Some(ball), place).unwrap_err();
        says(error, &["below entity \"ball\"", number]);
    }
}

#[test]
fn an_infinite_box_names_its_mesh_or_entity_and_the_number() {
    for (bad, number) in [(f32::INFINITY, "inf"), (f32::NAN, "NaN")] {
        let geometry = Geometry {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, bad, 0.0]],
            indices: vec![0, 1, 2],
            ..Geometry::default()
        };
        let error = Scene::new().add_mesh(Mesh::new("sheet", geometry));
        says(error.unwrap_err(), &["\"sheet\"", "position 2", number]);
    }
    // Two transforms that are finite each, but not their product: at creation, when an entity is added, and when it moves.
    let huge = DAffine3::from_scale(DVec3::splat(1e300));
    let [gpu, _] = gpus();
    for (scale, number) in [
        (huge, "inf"),
        (DAffine3::from_scale(DVec3::splat(1e-250)), "1e50"),
    ] {
        let (mut set, ball) = named();
        let above = set.scene.spawn(None, DAffine3::IDENTITY).unwrap();
        set.scene.set_parent(ball, Some(above)).unwrap();
        let mut scene = GpuScene::new(gpu, &mut set.scene).unwrap();
        set.scene.set_local(above, huge).unwrap();
        set.scene.set_local(ball, scale).unwrap();
        let number = match number {
            "inf" => "inf".to_owned(),
            _ => format!("{}", 1e300 * 1e-250),
        };
        says(
            scene.sync(&mut set.scene).unwrap_err(),
            &["'ball'", &number],
        );
        says(
            GpuScene::new(gpu, &mut set.scene).unwrap_err(),
            &["'ball'", &number],
        );
    }
}

#[test]
fn a_camera_that_cannot_see_names_the_view_and_the_number() {
    let (mut set, ball) = named();
    let [gpu, _] = gpus();
    let scene = GpuScene::new(gpu, &mut set.scene).unwrap();
    let strategy = registry().make("frustum").unwrap();
    let views = vec![ViewSpec::main(64, 48)];
    let mut stage = Stage::new(&scene, strategy, views, StageOptions::default()).unwrap();
    let good = look_at(DVec3::Z, DVec3::ZERO, perspective_degrees(60.0, 0.1));
    let with = |projection| Camera { projection, ..good };
    let parallel = |height, near, far| Projection::Orthographic { height, near, far };
    for (camera, words) in [
        (with(perspective_degrees(60.0, 0.0)), ["near", "0 m"]),
        (with(perspective_degrees(60.0, -2.5)), ["near", "-2.5 m"]),
        (with(perspective_degrees(60.0, f64::NAN)), ["near", "NaN"]),
        (with(perspective_degrees(0.0, 0.1)), ["fov_y", "0 radians"]),
        (with(perspective_degrees(180.0, 0.1)), ["fov_y", "3.14159"]),
        (
            with(perspective_degrees(f64::INFINITY, 0.1)),
            ["fov_y", "inf"],
        ),
        (with(parallel(0.0, 0.0, 1.0)), ["height", "0 m"]),
        (with(parallel(1.0, 2.0, 2.0)), ["far", "2 m"]),
        (with(parallel(1.0, 0.0, f64::INFINITY)), ["far", "inf"]),
        (
            Camera {
                position: DVec3::new(0.0, f64::NAN, 0.0),
                ..good
            },
            ["position", "NaN"],
        ),
        (
            Camera {
                rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0),
                ..good
            },
            ["rotation", "2"],
        ),
    ] {
        let error = stage.frame(&scene, &[ViewInput::new(camera)]).unwrap_err();
        says(&error, &words);
        says(error, &["view 'main'"]);
        let error = set.scene.set_camera(ball, camera).unwrap_err();
        says(&error, &words);
        says(error, &["entity \"ball\""]);
    }
    stage.frame(&scene, &[ViewInput::new(good)]).unwrap();
}

#[test]
fn an_image_too_wide_or_of_no_pixels_names_the_view_and_the_limit() {
    let (set, _) = named();
    for gpu in gpus() {
        let scene = GpuScene::new(gpu, &mut set.scene.clone()).unwrap();
        let most = gpu.device.limits().max_texture_dimension_2d;
        for size in [[most + 1, 1], [1, most + 1], [0, 1], [u32::MAX, u32::MAX]] {
            let views = vec![ViewSpec::main(size[0], size[1])];
            let strategy = registry().make("frustum").unwrap();
            let error = Stage::new(&scene, strategy, views, StageOptions::default()).unwrap_err();
            let pixels = format!("{} x {} pixels", size[0], size[1]);
            says(error, &["view 'main'", &pixels, &format!("1 to {most}")]);
        }
    }
}

#[test]
fn a_path_with_nan_names_the_pose_and_the_number() {
    let good = Pose {
        position: DVec3::Z,
        rotation: DQuat::IDENTITY,
        cut: false,
    };
    let nowhere = Pose {
        position: DVec3::new(0.0, f64::NAN, 0.0),
        ..good
    };
    let turned = Pose {
        rotation: DQuat::from_xyzw(0.0, 0.0, f64::NAN, 1.0),
        ..good
    };
    let far = Pose {
        position: DVec3::new(f64::NEG_INFINITY, 0.0, 0.0),
        ..good
    };
    for (bad, words) in [
        (nowhere, ["position", "NaN"]),
        (turned, ["rotation", "NaN"]),
        (far, ["position", "-inf"]),
    ] {
        let poses = vec![good, good, bad, good];
        let error = CameraPath::new("odd", perspective_degrees(60.0, 0.1), poses).unwrap_err();
        says(&error, &words);
        says(error, &["odd", "pose 2"]);
    }
    let error = CameraPath::new("flat", perspective_degrees(60.0, 0.0), vec![good]).unwrap_err();
    says(error, &["flat", "near", "0 m"]);
}
