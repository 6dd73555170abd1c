//! Visible samples choose levels of detail, and do not decide about entities that are not tested.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, SampleRule, Verdict};
use antumbra_draw::GpuScene;
use antumbra_scene::{Camera, Drawable, EntityKey, Material, Mesh, Scene, icosphere};
use antumbra_testing::{Settled, add, cuboid, drawable, gl, glass, look_at, perspective, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 120];

fn camera() -> Camera {
    look_at(DVec3::ZERO, DVec3::NEG_Z, perspective(1.0, 0.1))
}

/// The result of the fourth frame of a still scene.
fn settled(scene: &GpuScene, text: &str) -> Settled {
    antumbra_testing::settled(scene, text, camera(), SIZE, 4)
}

/// Spheres with four levels of detail, side by side at growing distances; one with two levels; one transparent.
fn spheres() -> (Scene, Vec<EntityKey>) {
    let mut scene = Scene::new();
    let mesh = |count: u32| Mesh {
        name: format!("{count} levels"),
        levels: (0..count)
            .map(|coarser| icosphere(4 - coarser, 1.0))
            .collect(),
        proxy: None,
    };
    let (four, two) = (
        scene.add_mesh(mesh(4)).unwrap(),
        scene.add_mesh(mesh(2)).unwrap(),
    );
    let solid = scene.add_material(Material::default());
    let glass = scene.add_material(glass([0.5, 0.5, 1.0, 0.5]));
    let places = [
        (four, solid, DVec3::new(-3.0, 0.0, -8.0)),
        (four, solid, DVec3::new(0.0, 0.0, -14.0)),
        (four, solid, DVec3::new(6.0, 3.0, -30.0)),
        (four, solid, DVec3::new(6.0, -3.0, -50.0)),
        (two, solid, DVec3::new(3.0, 9.0, -50.0)),
        (four, glass, DVec3::new(-8.0, 9.0, -50.0)),
    ];
    let keys = places.map(|(mesh, material, place)| {
        let place = DAffine3::from_translation(place);
        add(&mut scene, place, Drawable { mesh, material })
    });
    (scene, keys.to_vec())
}

fn levels_follow_visible_samples(gpu: &Gpu) {
    let (mut scene, keys) = spheres();
    let scene = GpuScene::new(gpu, &mut scene).unwrap();
    let slots: Vec<u32> = keys.iter().map(|key| scene.slot(*key).unwrap()).collect();
    let mut oracle = Oracle::new(&scene, SIZE);
    let ids = oracle
        .render(&scene, &camera(), EntitySet::InFrustum)
        .unwrap()
        .ids;
    let rule = SampleRule {
        threshold: 0,
        coarser: 160,
    };
    let mut pictures = Vec::new();
    for latency in ["frame-late", "same-frame", "on-gpu"] {
        let text = format!(
            "three-pass:latency={latency}:threshold=0:scale=1:coarser={}",
            rule.coarser
        );
        let Settled { verdicts, picture } = settled(&scene, &text);
        let mut used = Vec::new();
        for (at, slot) in slots.iter().enumerate().take(5) {
            let samples = ids.iter().filter(|id| **id == slot + 1).count() as u32;
            assert!(samples > 0, "sphere {at} is not seen");
            let coarsest = if at == 4 { 1 } else { 3 };
            assert_eq!(
                verdicts.level(*slot),
                rule.level(samples).min(coarsest),
                "sphere {at}, {samples} samples, {latency}"
            );
            used.push(verdicts.level(*slot));
        }
        assert_eq!(used, [0, 0, 1, 2, 1], "the scene shows less than it should");
        assert_eq!(verdicts.level(slots[5]), 0, "glass is drawn in full");
        pictures.push(picture);
    }
    assert!(pictures[0] == pictures[1], "late and same-frame differ");
    assert!(pictures[1] == pictures[2], "same-frame and on-gpu differ");
    let full = settled(&scene, "frustum").picture;
    assert!(pictures[2] != full, "coarser meshes change no pixel");
}

#[test]
fn levels_follow_visible_samples_on_vulkan() {
    levels_follow_visible_samples(vulkan());
}

#[test]
fn levels_follow_visible_samples_on_gl() {
    levels_follow_visible_samples(gl());
}

#[test]
fn a_rule_goes_one_level_coarser_a_quarter_of_the_samples() {
    let rule = SampleRule {
        threshold: 0,
        coarser: 160,
    };
    let levels = [1, 10, 11, 40, 41, 160, 161].map(|samples| rule.level(samples));
    assert_eq!(levels, [3, 3, 2, 2, 1, 1, 0]);
    assert_eq!(SampleRule::from(5).level(1), 0);
}

/// A wall, a small cube behind it, and one beside it.
fn wall() -> (Scene, [EntityKey; 3]) {
    let mut scene = Scene::new();
    let mut of = |size: DVec3| drawable(&mut scene, "box", cuboid(size), Material::default());
    let (wide, small) = (of(DVec3::new(4.0, 4.0, 0.2)), of(DVec3::ONE));
    let places = [
        (wide, DVec3::new(0.0, 0.0, -6.0)),
        (small, DVec3::new(0.0, 0.0, -10.0)),
        (small, DVec3::new(3.5, 0.0, -10.0)),
    ];
    let keys = places
        .map(|(drawable, place)| add(&mut scene, DAffine3::from_translation(place), drawable));
    (scene, keys)
}

#[test]
fn what_is_not_tested_is_drawn_hides_others_and_is_known_to_be_hidden() {
    let gpu = vulkan();
    let (mut scene, keys) = wall();
    for key in [keys[0], keys[1]] {
        scene.set_tested(key, false).unwrap();
    }
    // A third small cube, behind the wall like the first, but tested.
    let small = scene.drawable(keys[1]).unwrap();
    let far = DAffine3::from_translation(DVec3::new(0.2, 0.0, -14.0));
    let far = add(&mut scene, far, small);
    let mut on_gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let slot = |scene: &GpuScene, key| scene.slot(key).unwrap();
    for text in [
        "three-pass:latency=frame-late",
        "three-pass:latency=same-frame",
        "three-pass:latency=same-frame:threshold=0:counting=queries",
        "three-pass:latency=on-gpu",
        "stop-and-wait",
    ] {
        let verdicts = settled(&on_gpu, text).verdicts;
        let of = |key| verdicts.get(slot(&on_gpu, key));
        assert_eq!(of(keys[0]), Verdict::Untested, "{text}: the wall");
        assert_eq!(of(keys[1]), Verdict::Untested, "{text}: the untested cube");
        assert_eq!(of(keys[2]), Verdict::Visible, "{text}: the cube beside");
        assert_eq!(of(far), Verdict::Occluded, "{text}: the tested cube behind");
        let seen = |key| verdicts.seen(slot(&on_gpu, key));
        assert_eq!(
            (seen(keys[2]), seen(far)),
            (Some(true), Some(false)),
            "{text}"
        );
        // Stop-and-wait issues no query for an entity that is not tested.
        let asked = text.starts_with("three-pass");
        assert_eq!(seen(keys[0]), asked.then_some(true), "{text}");
        assert_eq!(seen(keys[1]), asked.then_some(false), "{text}");
    }
    scene.set_tested(keys[1], true).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    let verdicts = settled(&on_gpu, "three-pass:latency=same-frame").verdicts;
    assert_eq!(verdicts.get(slot(&on_gpu, keys[1])), Verdict::Occluded);
}

#[test]
fn an_image_that_changes_changes_the_picture() {
    let gpu = vulkan();
    let (mut scene, keys) = wall();
    let paint = |red: u8| antumbra_scene::Image {
        name: "paint".into(),
        width: 1,
        height: 1,
        rgba: vec![red, 0, 0, 255],
        sampler: Default::default(),
    };
    let image = scene.add_image(paint(255)).unwrap();
    let material = scene.add_material(Material {
        base_colour_image: Some(image),
        unlit: true,
        ..Material::default()
    });
    let mesh = scene.drawable(keys[0]).unwrap().mesh;
    scene
        .set_drawable(keys[0], Drawable { mesh, material })
        .unwrap();
    let mut on_gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let middle = ((SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) * 4) as usize;
    assert_eq!(settled(&on_gpu, "frustum").picture[middle], 255);
    scene.set_image(image, paint(0)).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    assert_eq!(settled(&on_gpu, "frustum").picture[middle], 0);
}
