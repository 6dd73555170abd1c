//! Animations in glTF files: what plays, what is left out with which words, and what a hostile file may cost.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{
    LoadError, LoadOptions, LoadProblem, LoadedScene, SceneFormat, load_slice,
    load_slice_with_attachments,
};
use antumbra_scene::Scene;
use common::{floats, glb};
use glam::DVec3;

/// A file of a square whose animation has these channels and samplers. Accessors: 0 the positions, 1 the indices, 2 the times 0 and 1, 3 the vectors (0,0,0) and
/// (4,0,0), 4 the times 1 and 0, 5 a time that is not a number, 6 two weights, 7 joints, 8 weights of joints, 9 three vectors, 10 and 11 a great many zeros,
/// 12 the vectors (0,0,0) and (4,4,4).
fn file(nodes: &str, channels: &str, samplers: &str, more: &str) -> Vec<u8> {
    let mut binary = common::square();
    let mut views = vec![(0, 48), (48, 12)];
    let mut push = |bytes: Vec<u8>| {
        views.push((binary.len(), bytes.len()));
        binary.extend(bytes);
    };
    push(floats(&[0.0, 1.0]));
    push(floats(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0]));
    push(floats(&[1.0, 0.0]));
    push(floats(&[0.0, f32::NAN]));
    push(floats(&[0.0, 1.0]));
    push([0_u8, 1, 0, 0].repeat(4));
    push(floats(&[0.0, 1.0, 0.0, 0.0].repeat(4)));
    push(floats(&[0.0; 9]));
    push(floats(&[0.0, 0.0, 0.0, 4.0, 4.0, 4.0]));
    let views: Vec<String> = (views.iter())
        .map(|(at, length)| format!(r#"{{"buffer":0,"byteOffset":{at},"byteLength":{length}}}"#))
        .collect();
    let accessor = |view: usize, component: u32, count: usize, shape: &str| {
        format!(
            r#"{{"bufferView":{view},"componentType":{component},"count":{count},"type":"{shape}"}}"#
        )
    };
    let accessors = [
        accessor(0, 5126, 4, "VEC3"),
        accessor(1, 5123, 6, "SCALAR"),
        accessor(2, 5126, 2, "SCALAR"),
        accessor(3, 5126, 2, "VEC3"),
        accessor(4, 5126, 2, "SCALAR"),
        accessor(5, 5126, 2, "SCALAR"),
        accessor(6, 5126, 2, "SCALAR"),
        accessor(7, 5121, 4, "VEC4"),
        accessor(8, 5126, 4, "VEC4"),
        accessor(9, 5126, 3, "VEC3"),
        r#"{"componentType":5126,"count":4000000000,"type":"SCALAR"}"#.to_owned(),
        r#"{"componentType":5126,"count":4000000000,"type":"VEC3"}"#.to_owned(),
        accessor(10, 5126, 2, "VEC3"),
    ];
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}},
{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":7,"WEIGHTS_0":8}},"indices":1,"targets":[{{"POSITION":0}}]}}]}}],
"nodes":[{nodes}],"animations":[{{"name":"a","channels":[{channels}],"samplers":[{samplers}]}}]{more}}}"#,
        binary.len(),
        views.join(","),
        accessors.join(",")
    );
    glb(&json, &binary)
}

fn load(file: &[u8]) -> Result<LoadedScene, LoadError> {
    let options = LoadOptions::default();
    load_slice_with_attachments(SceneFormat::Gltf, file, None, &options, &[])
}

/// A channel of the node 0, over a sampler of these accessors.
fn one(path: &str, input: usize, output: usize) -> Vec<u8> {
    file(
        r#"{"mesh":0}"#,
        &format!(r#"{{"sampler":0,"target":{{"node":0,"path":"{path}"}}}}"#),
        &format!(r#"{{"input":{input},"output":{output}}}"#),
        "",
    )
}

/// The upper corner of the scene's box, without what it is rounded outwards by.
fn highest(scene: &mut Scene) -> DVec3 {
    scene.update();
    let max = scene.bounds().unwrap().max;
    (max * 1e6).round() / 1e6
}

#[test]
fn what_plays_is_not_left_out() {
    let loaded = load(&one("translation", 2, 3)).unwrap();
    assert!(loaded.left_out.is_empty(), "{}", loaded.left_out);
    let (mut scene, animation) = (loaded.scene, loaded.animation.unwrap());
    assert_eq!(animation.clip_named("a"), Some(0));
    assert_eq!(animation.moved_entities().count(), 1);
    for (time, x) in [(0.0, 1.0), (0.5, 3.0), (1.0, 5.0), (1.25, 2.0)] {
        animation.pose(&mut scene, 0, time).unwrap();
        assert_eq!(highest(&mut scene).x, x, "{time}");
    }
}

#[test]
fn skins_and_morph_targets_play_and_their_meshes_deform() {
    // Joint 1 moves by 4 m along x; the weight doubles the square.
    let nodes = r#"{"mesh":1,"skin":0,"children":[1,2]},{},{}"#;
    let channels = r#"{"sampler":0,"target":{"node":2,"path":"translation"}},{"sampler":1,"target":{"node":0,"path":"weights"}}"#;
    let samplers = r#"{"input":2,"output":3},{"input":2,"output":6}"#;
    let more = r#","skins":[{"joints":[1,2]}]"#;
    let loaded = load(&file(nodes, channels, samplers, more)).unwrap();
    assert!(loaded.left_out.is_empty(), "{}", loaded.left_out);
    let (mut scene, animation) = (loaded.scene, loaded.animation.unwrap());
    assert_eq!(animation.meshes().len(), 1);
    assert!(scene.deforms(animation.meshes()[0].mesh));
    assert_eq!(highest(&mut scene), DVec3::new(1.0, 1.0, 0.0));
    animation.pose(&mut scene, 0, 1.0).unwrap();
    assert_eq!(highest(&mut scene), DVec3::new(6.0, 2.0, 0.0));
    animation.rest(&mut scene).unwrap();
    assert_eq!(highest(&mut scene), DVec3::new(1.0, 1.0, 0.0));
}

#[test]
fn meshes_of_a_scene_without_its_animation_deform_no_longer() {
    let nodes = r#"{"mesh":1,"skin":0,"children":[1,2]},{},{}"#;
    let channels = r#"{"sampler":0,"target":{"node":2,"path":"translation"}}"#;
    let more = r#","skins":[{"joints":[1,2]}]"#;
    let file = file(nodes, channels, r#"{"input":2,"output":3}"#, more);
    let deform = |scene: &Scene| {
        let mut drawables = scene.drawables();
        drawables.any(|(_, drawable)| scene.deforms(drawable.mesh))
    };
    assert!(deform(&load(&file).unwrap().scene));
    let still = load(&file).unwrap().at_rest();
    assert!(still.animation.is_none() && !deform(&still.scene));
    let options = LoadOptions::default();
    let still = load_slice(SceneFormat::Gltf, &file, None, &options).unwrap();
    assert!(!deform(&still));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bent.glb");
    std::fs::write(&path, &file).unwrap();
    assert!(!deform(&antumbra_formats::load(&path, &options).unwrap()));
}

#[test]
fn skins_that_nothing_moves_are_baked() {
    let nodes = r#"{"mesh":1,"skin":0},{},{"translation":[3,0,0]},{"mesh":0}"#;
    let channels = r#"{"sampler":0,"target":{"node":3,"path":"translation"}}"#;
    let more = r#","skins":[{"joints":[1,2]}]"#;
    let file = file(nodes, channels, r#"{"input":2,"output":3}"#, more);
    let mut loaded = load(&file).unwrap();
    assert!(loaded.animation.unwrap().meshes().is_empty());
    assert_eq!(highest(&mut loaded.scene).x, 4.0);
}

#[test]
fn what_is_scaled_to_nothing_at_rest_may_grow() {
    let nodes = r#"{"mesh":1,"skin":0,"scale":[0,0,0],"children":[1]},{"children":[2]},{}"#;
    let channels = r#"{"sampler":0,"target":{"node":0,"path":"scale"}}"#;
    let more = r#","skins":[{"joints":[1,2]}]"#;
    let file = file(nodes, channels, r#"{"input":2,"output":12}"#, more);
    let loaded = load(&file).unwrap();
    assert!(loaded.left_out.is_empty(), "{}", loaded.left_out);
    let (mut scene, animation) = (loaded.scene, loaded.animation.unwrap());
    for (time, size) in [(0.0, 0.0), (0.5, 2.0), (1.0, 4.0)] {
        animation.pose(&mut scene, 0, time).unwrap();
        assert_eq!(highest(&mut scene), DVec3::new(size, size, 0.0), "{time}");
    }
}

#[test]
fn what_is_wrong_with_a_channel_costs_that_channel_alone() {
    for (input, output, path, reason) in [
        (4, 3, "translation", "keyframe times that do not increase"),
        (5, 3, "translation", "keyframes that are not finite"),
        (2, 9, "translation", "its times and values are not as many"),
        (2, 3, "rotation", "its keyframes cannot be read"),
        (2, 99, "translation", "its keyframes cannot be read"),
        (2, 6, "weights", "its node has no morph targets"),
        (2, 3, "colour", "it moves a property that is not read"),
    ] {
        let loaded = load(&one(path, input, output)).unwrap();
        assert!(loaded.animation.is_none());
        let words = loaded.left_out.to_string();
        let wanted =
            format!("1 animation (no channel of it can be played), 1 animation channel ({reason})");
        assert_eq!(words, wanted);
    }
    let node = r#"{"mesh":0}"#;
    let sampler = r#"{"input":2,"output":3}"#;
    for (channel, reason) in [
        (
            r#"{"sampler":0,"target":{"node":7,"path":"scale"}}"#,
            "its node does not exist",
        ),
        (
            r#"{"sampler":7,"target":{"node":0,"path":"scale"}}"#,
            "its sampler does not exist",
        ),
        (
            r#"{"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":"/materials/0"}}}}"#,
            "it moves something other than a node",
        ),
    ] {
        let good = r#"{"sampler":0,"target":{"node":0,"path":"translation"}}"#;
        let both = format!("{good},{channel}");
        let more = r#","extensionsUsed":["KHR_animation_pointer"]"#;
        let loaded = load(&file(node, &both, sampler, more)).unwrap();
        assert_eq!(loaded.animation.unwrap().clips()[0].channels.len(), 1);
        let words = loaded.left_out.to_string();
        assert_eq!(words, format!("1 animation channel ({reason})"));
    }
}

#[test]
fn keyframes_are_bounded_by_the_limits_of_the_load() {
    // A file of some bytes with thousands of millions of keys, all zero.
    for (input, output) in [(10, 11), (10, 10)] {
        let path = if output == 11 {
            "translation"
        } else {
            "weights"
        };
        let nodes = r#"{"mesh":1}"#;
        let channel = format!(r#"{{"sampler":0,"target":{{"node":0,"path":"{path}"}}}}"#);
        let sampler = format!(r#"{{"input":{input},"output":{output}}}"#);
        let refused = load(&file(nodes, &channel, &sampler, "")).unwrap_err();
        assert!(
            matches!(
                *refused.problem,
                LoadProblem::TooMuchWork { .. } | LoadProblem::TooMuchMemory(_)
            ),
            "{refused}"
        );
        assert!(refused.to_string().contains("animation 0"), "{refused}");
    }
}
