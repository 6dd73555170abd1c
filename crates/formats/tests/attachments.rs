//! Attachments in glTF files: they are read back unchanged, and an invalid attachment does not affect the rest of the
//! scene.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_formats::{
    Attachment, LoadOptions, LoadedScene, SceneFormat, load_slice_with_attachments,
    load_with_attachments, save_glb_with_attachments,
};
use antumbra_scene::{EntityKey, Scene};
use glam::{DAffine3, DVec3};
use serde_json::{Map, Value, json};

fn scene() -> (Scene, [EntityKey; 3]) {
    let mut scene = Scene::new();
    let root = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let names = ["left", "right"];
    let [left, right] = names.map(|name| {
        let place = DAffine3::from_translation(DVec3::X);
        let entity = scene.spawn(Some(root), place).unwrap();
        scene.set_entity_name(entity, name).unwrap();
        entity
    });
    (scene, [root, left, right])
}

fn attachment(name: &str, entities: &[EntityKey]) -> Attachment {
    let facts = json!({"version": 3, "words": ["a", null, {"b": -1.5}]});
    Attachment {
        name: name.to_owned(),
        entities: entities.to_vec(),
        properties: facts.as_object().unwrap().clone(),
        bytes: vec![1, 2, 3, 254, 255],
    }
}

#[test]
fn what_is_attached_comes_back_for_who_asks() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.glb");
    let (scene, [root, left, right]) = scene();
    let wanted = attachment("SOME_body", &[right, root]);
    let bare = Attachment {
        bytes: Vec::new(),
        properties: Map::new(),
        ..attachment("SOME_else", &[left])
    };
    save_glb_with_attachments(&scene, &[wanted.clone(), bare.clone()], &file).unwrap();
    let options = LoadOptions::default();
    let names = ["SOME_else", "NO_body", "SOME_body"];
    let loaded = load_with_attachments(&file, &options, &names).unwrap();
    let scene = &loaded.scene;
    let [else_, body] = [0, 1].map(|at| loaded.attachments[at].as_ref().unwrap());
    assert_eq!(loaded.attachments.len(), 2);
    assert_eq!(body.properties, wanted.properties);
    assert_eq!(body.bytes, wanted.bytes);
    assert_eq!(body.name, "SOME_body");
    let called = |at: &Attachment| {
        at.entities
            .iter()
            .map(|e| scene.entity_name(*e).to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(called(body), ["right", ""]);
    assert_eq!(scene.parent(body.entities[0]), Some(body.entities[1]));
    assert_eq!(
        (called(else_), else_.bytes.len(), else_.properties.len()),
        (vec!["left".to_owned()], 0, 0)
    );
    assert!(
        load_with_attachments(&file, &options, &[])
            .unwrap()
            .attachments
            .is_empty()
    );
}

#[test]
fn attachments_that_no_file_can_hold_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.glb");
    let (mut scene, [_, left, right]) = scene();
    let refused = |scene: &Scene, attachments: &[Attachment]| {
        let error = save_glb_with_attachments(scene, attachments, &file).unwrap_err();
        assert!(!file.exists());
        error.to_string()
    };
    let good = attachment("SOME_body", &[left]);
    assert!(refused(&scene, &[good.clone(), good]).contains("in use"));
    assert!(refused(&scene, &[attachment("MSFT_lod", &[])]).contains("in use"));
    assert!(refused(&scene, &[attachment("", &[])]).contains("empty"));
    for fact in ["nodes", "bufferView"] {
        let mut taken = attachment("SOME_body", &[]);
        taken.properties.insert(fact.to_owned(), Value::from(1));
        assert!(refused(&scene, &[taken]).contains(fact));
    }
    scene.despawn(right);
    let error = refused(&scene, &[attachment("SOME_body", &[right])]);
    assert!(error.contains("not in the scene"), "{error}");
}

/// A scene of one node, a further node, and an extension.
fn with(extension: &str) -> LoadedScene {
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{}},{{}}],
        "extensions":{{"SOME_body":{extension}}},
        "buffers":[{{"byteLength":4,"uri":"data:application/octet-stream;base64,AAECAw=="}}],
        "bufferViews":[{{"buffer":0,"byteLength":4}},{{"buffer":0,"byteOffset":2,"byteLength":4}},{{"buffer":7,"byteLength":1}}]}}"#
    );
    let options = LoadOptions::default();
    load_slice_with_attachments(
        SceneFormat::Gltf,
        text.as_bytes(),
        None,
        &options,
        &["SOME_body"],
    )
    .unwrap()
}

#[test]
fn attachments_that_cannot_be_are_told_and_the_scene_is_there() {
    let good = with(r#"{"nodes":[0],"bufferView":0,"x":1}"#);
    let found = good.attachments[0].as_ref().unwrap();
    assert_eq!(found.bytes, [0, 1, 2, 3]);
    assert_eq!(found.entities.len(), 1);
    for (extension, words) in [
        ("[]", "no JSON object"),
        ("7", "no JSON object"),
        (r#"{"nodes":3}"#, "no array"),
        (r#"{"nodes":[0,1]}"#, "entry 1 of its nodes"),
        (r#"{"nodes":[2]}"#, "entry 0 of its nodes"),
        (r#"{"nodes":[-1]}"#, "entry 0"),
        (r#"{"nodes":["0"]}"#, "entry 0"),
        (r#"{"bufferView":"0"}"#, "no index"),
        (r#"{"bufferView":3}"#, "buffer view 3"),
        (r#"{"bufferView":1}"#, "needs 6 bytes"),
        (r#"{"bufferView":2}"#, "buffer 7"),
    ] {
        let loaded = with(extension);
        assert_eq!(loaded.scene.len(), 1);
        let error = loaded.attachments[0].as_ref().unwrap_err().to_string();
        assert!(
            error.contains(words),
            "{extension}: '{words}' is not in: {error}"
        );
    }
}
