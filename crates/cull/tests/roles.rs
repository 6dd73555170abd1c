//! What visible samples decide beyond being drawn: levels of detail; and what they do not: entities that are not tested.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{SampleRule, Stage, StageOptions, Verdict, Verdicts, ViewInput, ViewSpec};
use antumbra_draw::{AdapterChoice, Gpu, GpuScene, read_back};
use antumbra_scene::{
    AlphaMode, Camera, Drawable, EntityKey, Geometry, Material, Mesh, Projection, Scene, icosphere,
};
use antumbra_strategies::registry;
use antumbra_verify::{Members, Oracle};
use glam::{DAffine3, DVec3, Vec3};

const SIZE: [u32; 2] = [160, 120];

fn gpu(name: &str) -> Gpu {
    Gpu::open(&AdapterChoice::Named(name.to_owned()))
        .unwrap_or_else(|error| panic!("{error}; run make test, which looks for the drivers first"))
}

fn camera() -> Camera {
    let projection = Projection::Perspective {
        fov_y: 1.0,
        near: 0.1,
    };
    Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, projection).unwrap()
}

/// A few frames of a still scene: the last one's verdicts and picture.
fn settled(scene: &GpuScene, text: &str) -> (Verdicts, Vec<u8>) {
    let strategy = registry().parse(text).unwrap();
    let specs = vec![ViewSpec::main(SIZE[0], SIZE[1])];
    let mut stage = Stage::new(scene, strategy, specs, StageOptions::default()).unwrap();
    for _ in 0..4 {
        stage.frame(scene, &[ViewInput::new(camera())]).unwrap();
        scene.gpu().wait().unwrap();
    }
    let picture = read_back::texture(scene.gpu(), stage.colour(0).unwrap()).unwrap();
    (stage.verdicts(0, scene).unwrap(), picture)
}

/// Spheres of four levels of detail, ever farther away, side by side; one of two levels; one of glass.
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
    let glass = scene.add_material(Material {
        alpha: AlphaMode::Blend,
        base_colour: [0.5, 0.5, 1.0, 0.5],
        ..Material::default()
    });
    let places = [
        (four, solid, DVec3::new(-3.0, 0.0, -8.0)),
        (four, solid, DVec3::new(0.0, 0.0, -14.0)),
        (four, solid, DVec3::new(6.0, 3.0, -30.0)),
        (four, solid, DVec3::new(6.0, -3.0, -50.0)),
        (two, solid, DVec3::new(3.0, 9.0, -50.0)),
        (four, glass, DVec3::new(-8.0, 9.0, -50.0)),
    ];
    let keys = places.map(|(mesh, material, place)| {
        let key = scene
            .spawn(None, DAffine3::from_translation(place))
            .unwrap();
        scene
            .set_drawable(key, Drawable { mesh, material })
            .unwrap();
        key
    });
    (scene, keys.to_vec())
}

fn levels_follow_visible_samples(name: &str) {
    let gpu = gpu(name);
    let (mut scene, keys) = spheres();
    let scene = GpuScene::new(&gpu, &mut scene).unwrap();
    let slots: Vec<u32> = keys.iter().map(|key| scene.slot(*key).unwrap()).collect();
    let mut oracle = Oracle::new(&scene, SIZE);
    let ids = oracle
        .look(&scene, &camera(), Members::Frustum)
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
        let (verdicts, picture) = settled(&scene, &text);
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
    let (_, full) = settled(&scene, "frustum");
    assert!(pictures[2] != full, "coarser meshes change no pixel");
}

#[test]
fn levels_follow_visible_samples_on_vulkan() {
    levels_follow_visible_samples("vulkan");
}

#[test]
fn levels_follow_visible_samples_on_gl() {
    levels_follow_visible_samples("gl");
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

/// A wall, a small cube behind it, another one beside it.
fn wall() -> (Scene, [EntityKey; 3]) {
    let mut scene = Scene::new();
    let half = |half: Vec3| {
        let bounds = antumbra_scene::Aabb::new(-half.as_dvec3(), half.as_dvec3());
        Mesh::new("box", Geometry::from_box(&bounds))
    };
    let (wide, small) = (
        scene.add_mesh(half(Vec3::new(2.0, 2.0, 0.1))).unwrap(),
        scene.add_mesh(half(Vec3::splat(0.5))).unwrap(),
    );
    let material = scene.add_material(Material::default());
    let places = [
        (wide, DVec3::new(0.0, 0.0, -6.0)),
        (small, DVec3::new(0.0, 0.0, -10.0)),
        (small, DVec3::new(3.5, 0.0, -10.0)),
    ];
    let keys = places.map(|(mesh, place)| {
        let key = scene
            .spawn(None, DAffine3::from_translation(place))
            .unwrap();
        scene
            .set_drawable(key, Drawable { mesh, material })
            .unwrap();
        key
    });
    (scene, keys)
}

#[test]
fn what_is_not_tested_is_drawn_hides_others_and_is_known_to_be_hidden() {
    let gpu = gpu("vulkan");
    let (mut scene, keys) = wall();
    for key in [keys[0], keys[1]] {
        scene.set_tested(key, false).unwrap();
    }
    // A third small cube, behind the wall as the first, and tested.
    let small = scene.drawable(keys[1]).unwrap();
    let far = DAffine3::from_translation(DVec3::new(0.2, 0.0, -14.0));
    let far = scene.spawn(None, far).unwrap();
    scene.set_drawable(far, small).unwrap();
    let mut on_gpu = GpuScene::new(&gpu, &mut scene).unwrap();
    let slot = |scene: &GpuScene, key| scene.slot(key).unwrap();
    for text in [
        "three-pass:latency=frame-late",
        "three-pass:latency=same-frame",
        "three-pass:latency=same-frame:threshold=0:counting=queries",
        "three-pass:latency=on-gpu",
        "stop-and-wait",
    ] {
        let (verdicts, _) = settled(&on_gpu, text);
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
        // Stop-and-wait asks nothing about what is not tested.
        let asked = text.starts_with("three-pass");
        assert_eq!(seen(keys[0]), asked.then_some(true), "{text}");
        assert_eq!(seen(keys[1]), asked.then_some(false), "{text}");
    }
    scene.set_tested(keys[1], true).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    let (verdicts, _) = settled(&on_gpu, "three-pass:latency=same-frame");
    assert_eq!(verdicts.get(slot(&on_gpu, keys[1])), Verdict::Occluded);
}

#[test]
fn an_image_that_changes_changes_the_picture() {
    let gpu = gpu("vulkan");
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
    let mut on_gpu = GpuScene::new(&gpu, &mut scene).unwrap();
    let middle = ((SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) * 4) as usize;
    assert_eq!(settled(&on_gpu, "frustum").1[middle], 255);
    scene.set_image(image, paint(0)).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    assert_eq!(settled(&on_gpu, "frustum").1[middle], 0);
}
