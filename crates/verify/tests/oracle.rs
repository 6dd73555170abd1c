//! The oracle on scenes with a known answer: which box is in front, which owns no pixel, what a transparent box adds.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, Verdict, Verdicts};
use antumbra_draw::GpuScene;
use antumbra_scene::{AlphaMode, Camera, EntityKey, Material, Scene};
use antumbra_testing::{add, cuboid, drawable, gl, look_at, perspective, vulkan};
use antumbra_verify::{Differences, EntitySet, Oracle};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [50, 40];

/// Adds a cube of one metre at each of these places, with this alpha mode.
fn boxes(scene: &mut Scene, alpha: AlphaMode, at: &[DVec3]) -> Vec<EntityKey> {
    let material = Material {
        alpha,
        base_colour: [0.5; 4],
        ..Material::default()
    };
    let shown = drawable(scene, "box", cuboid(DVec3::ONE), material);
    at.iter()
        .map(|place| add(scene, DAffine3::from_translation(*place), shown))
        .collect()
}

fn camera() -> Camera {
    look_at(
        DVec3::new(0.0, 0.0, 5.0),
        DVec3::ZERO,
        perspective(1.0, 0.1),
    )
}

fn owners_follow_the_scene(gpu: &Gpu) {
    let mut scene = Scene::new();
    // First no entity; then a box in front of another, a third beside them, and a fourth behind the camera.
    let mut gpu_scene = GpuScene::new(gpu, &mut scene).unwrap();
    let mut oracle = Oracle::new(&gpu_scene, SIZE);
    let camera = camera();
    let empty = oracle
        .render(&gpu_scene, &camera, EntitySet::InFrustum)
        .unwrap();
    assert_eq!(empty.ids, vec![0; 2000]);
    assert_eq!((empty.owners(), &empty.transparent), (vec![], &None));

    let places = [
        DVec3::ZERO,
        DVec3::new(0.0, 0.0, -3.0),
        DVec3::new(1.5, 0.0, 0.0),
        DVec3::new(0.0, 0.0, 9.0),
    ];
    let solid = boxes(&mut scene, AlphaMode::Opaque, &places);
    gpu_scene.sync(&mut scene).unwrap();
    let slot = |key: &EntityKey| gpu_scene.slot(*key).unwrap();
    let all = oracle
        .render(&gpu_scene, &camera, EntitySet::InFrustum)
        .unwrap();
    assert_eq!(all.owners(), [slot(&solid[0]), slot(&solid[2])]);
    let middle = all.ids[20 * 50 + 25];
    assert_eq!(middle, slot(&solid[0]) + 1);
    let counts = all.samples_by_slot();
    let owned = all.ids.iter().filter(|id| **id == middle).count();
    assert_eq!(counts[slot(&solid[0]) as usize] as usize, owned);

    // Without the box in front, the box behind it owns pixels, and exactly the pixels of the front box are wrong.
    let rest = [slot(&solid[2]), slot(&solid[1])];
    let less = oracle
        .render(&gpu_scene, &camera, EntitySet::Slots(&rest))
        .unwrap();
    assert_eq!(less.owners(), [slot(&solid[1]), slot(&solid[2])]);
    assert_eq!(less.wrong_pixels(&all), owned);
    let mask = less.wrong_pixel_mask(&all);
    assert!((mask.iter().zip(&all.ids)).all(|(wrong, id)| *wrong == (*id == middle)));

    // A transparent box in front of all, and one behind the first box: only the front one has samples, and the ids do not change.
    let glass = [DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.0, 0.0, -1.5)];
    let blended = boxes(&mut scene, AlphaMode::Blend, &glass);
    gpu_scene.sync(&mut scene).unwrap();
    let slot = |key: &EntityKey| gpu_scene.slot(*key).unwrap();
    let glazed = oracle
        .render(&gpu_scene, &camera, EntitySet::InFrustum)
        .unwrap();
    assert_eq!(glazed.ids, all.ids);
    assert_eq!(
        glazed.owners(),
        [slot(&solid[0]), slot(&solid[2]), slot(&blended[0])]
    );
    let samples = glazed.transparent.as_ref().unwrap().samples[slot(&blended[0]) as usize];
    assert!(samples > 0);
    assert!(glazed.wrong_pixels(&all) > 0);
    // Its back faces are culled, so it covers each pixel once.
    assert_eq!(glazed.wrong_pixels(&all), samples as usize);
}

#[test]
fn owners_follow_the_scene_on_vulkan() {
    owners_follow_the_scene(vulkan());
}

#[test]
fn owners_follow_the_scene_on_gl() {
    owners_follow_the_scene(gl());
}

/// A cube, its coincident twin, a cube beside them with another behind it: what culling each of them costs.
fn ties_are_told_from_losses(gpu: &Gpu, samples: u32) {
    let mut scene = Scene::new();
    let places = [
        DVec3::ZERO,
        DVec3::ZERO,
        DVec3::new(1.5, 0.0, 0.0),
        DVec3::new(1.5, 0.0, -2.0),
    ];
    let cubes = boxes(&mut scene, AlphaMode::Opaque, &places);
    let gpu_scene = GpuScene::new(gpu, &mut scene).unwrap();
    let mut oracle = Oracle::new(&gpu_scene, SIZE).with_samples(samples);
    let camera = camera();
    let reference = oracle
        .render(&gpu_scene, &camera, EntitySet::InFrustum)
        .unwrap();
    let slots: Vec<u32> = (cubes.iter())
        .map(|key| gpu_scene.slot(*key).unwrap())
        .collect();
    let owners = reference.owners();
    // Of the twins, the one that is drawn last owns all of their pixels.
    let [twin, other] = match owners.contains(&slots[1]) {
        true => [slots[1], slots[0]],
        false => [slots[0], slots[1]],
    };
    assert!(owners.contains(&twin) && !owners.contains(&other));
    let covered = reference.owned_pixels();
    let mut without = |culled: &[u32]| {
        let mut verdicts = Verdicts::default();
        verdicts.reset(4, Verdict::Visible);
        for slot in culled {
            verdicts.set(*slot, Verdict::Occluded);
        }
        oracle
            .differences(&gpu_scene, &camera, &reference, &verdicts)
            .unwrap()
    };

    let nothing = without(&[other]);
    assert_eq!(nothing, Differences::default());
    // The pixels show the other twin, at the same depth.
    let tied = without(&[twin]);
    assert_eq!(tied.undrawn, [twin]);
    assert_eq!((tied.false_culls(), tied.wrong_pixels()), (0, 0));
    assert!(tied.wrong.is_empty(), "a mask of nothing");
    let ties = tied.tie_pixels();
    assert!(ties > 0);
    // With both of them, the background is seen.
    let gone = without(&[twin, other]);
    assert_eq!((gone.false_culls(), gone.tie_pixels()), (1, 0));
    assert_eq!(gone.wrong_pixels(), ties);
    // A box without the box in front of it shows one that is further away: no tie.
    let behind = without(&[slots[2]]);
    assert_eq!((behind.false_culls(), behind.tie_pixels()), (1, 0));
    assert!(behind.wrong_pixels() > 0);
    let both = without(&[slots[2], twin]);
    assert_eq!((both.false_culls(), both.tie_pixels()), (1, ties));
    assert_eq!(both.tied, [twin]);
    assert_eq!(both.wrong_pixels(), behind.wrong_pixels());
    assert!(covered >= ties + behind.wrong_pixels());
    assert!(covered < reference.pixels().count());
}

#[test]
fn ties_are_told_from_losses_on_vulkan() {
    ties_are_told_from_losses(vulkan(), 1);
    ties_are_told_from_losses(vulkan(), 4);
}

#[test]
fn ties_are_told_from_losses_on_gl() {
    ties_are_told_from_losses(gl(), 1);
    ties_are_told_from_losses(gl(), 4);
}
