//! Counting visible samples: all ways give the same count for each entity, the counts equal the oracle's pixels, and as booleans they
//! equal hardware queries. With thousands of occludees, with one sample a pixel and with four, on Vulkan and on OpenGL.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::{Arc, Mutex};

use antumbra_cull::{
    Candidates, Capability, Counting, DeclareError, FrameGraph, Gpu, Latency, MeshDetail, Outcome,
    Samples, StageOptions, Strategy, Verdict, ViewFrame, ViewInput, ViewNodes, VisibleSet,
};
use antumbra_draw::GpuScene;
use antumbra_scene::{
    AlphaMode, Camera, Drawable, Geometry, Material, Mesh, Scene, Topology, icosphere,
};
use antumbra_testing::{add, gl, glass, holes, look_at, perspective, stage_with, views, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [240, 180];

/// Draws everything, counts samples, and keeps the counts.
struct Counter {
    way: Counting,
    occludee: MeshDetail,
    size: [u32; 2],
    counted: Arc<Mutex<Samples>>,
}

impl Strategy for Counter {
    fn name(&self) -> &str {
        "counter"
    }

    fn summary(&self) -> &str {
        "counts visible samples for a test"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::SameFrame)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let inside = g.in_frustum(view);
        let proxies = g.proxies(view, inside, MeshDetail::Level(0), self.occludee);
        let counts = g.count_samples(view, proxies, self.way, self.size);
        let counted = Arc::clone(&self.counted);
        let chosen = g.choose(
            view,
            |node| {
                node.read(inside)
                    .read(counts.queried)
                    .read_back(counts.buffer);
            },
            move |ctx, _, _, verdicts| {
                let asked = ctx.get(counts.queried)?;
                counted
                    .lock()
                    .unwrap()
                    .take(&asked, counts.layout, ctx.bytes(counts.buffer)?);
                for slot in ctx.get(inside)?.inside() {
                    verdicts.set(*slot, Verdict::Untested);
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}

/// The image that samples are counted in.
#[derive(Debug, Clone, Copy)]
struct Image {
    size: [u32; 2],
    samples: u32,
}

/// The visible samples of every slot in the frustum, with full meshes as occluders.
fn count(
    scene: &GpuScene,
    camera: &Camera,
    way: Counting,
    occludee: MeshDetail,
    Image { size, samples }: Image,
) -> Vec<(u32, u32)> {
    let counted = Arc::new(Mutex::new(Samples::default()));
    let counter = Counter {
        way,
        occludee,
        size,
        counted: Arc::clone(&counted),
    };
    let views = views(&["main"], SIZE);
    let options = StageOptions {
        samples,
        ..StageOptions::default()
    };
    let mut stage = stage_with(scene, Box::new(counter), views, options);
    stage.frame(scene, &[ViewInput::new(*camera)]).unwrap();
    let mut candidates = Candidates::default();
    candidates.find(scene.table(), &ViewFrame::new(*camera, SIZE, 0));
    let counted = counted.lock().unwrap();
    let of = |slot: &u32| (*slot, counted.get(*slot).unwrap());
    candidates.inside().iter().map(of).collect()
}

/// 5,832 opaque spheres in a slightly irregular lattice, and twelve each of transparent spheres, alpha-masked spheres and clouds of points.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let sphere = scene
        .add_mesh(Mesh::new("sphere", icosphere(1, 0.45)))
        .unwrap();
    let material = scene.add_material(Material::default());
    for number in 0..18 * 18 * 18 {
        let [x, y, z] = [number % 18, number / 18 % 18, number / 324].map(|i| f64::from(i) - 8.5);
        let shift = DVec3::new((y * 3.7).sin(), (z * 2.9).sin(), (x * 5.3).sin()) * 0.1;
        let place = DAffine3::from_translation(DVec3::new(x, y, z) + shift);
        let mesh = sphere;
        add(&mut scene, place, Drawable { mesh, material });
    }
    let glass = scene.add_material(glass([1.0, 1.0, 1.0, 0.5]));
    let image = scene.add_image(holes()).unwrap();
    let sieve = scene.add_material(Material {
        alpha: AlphaMode::Mask { cutoff: 0.5 },
        base_colour_image: Some(image),
        ..Material::default()
    });
    let points = Geometry {
        topology: Topology::Points,
        positions: (0..8)
            .map(|i| [i as f32 * 0.2, 0.01 * i as f32, 0.0])
            .collect(),
        indices: (0..8).collect(),
        ..Geometry::default()
    };
    let points = scene.add_mesh(Mesh::new("points", points)).unwrap();
    for number in 0..12 {
        let place = DVec3::new(
            f64::from(number) - 6.0,
            0.4,
            if number % 2 == 0 { 10.0 } else { 2.0 },
        );
        for (i, (mesh, material)) in [(sphere, glass), (sphere, sieve), (points, sieve)]
            .into_iter()
            .enumerate()
        {
            let place = place + DVec3::Y * (i as f64 * 2.1 - 2.0);
            let place = DAffine3::from_translation(place);
            add(&mut scene, place, Drawable { mesh, material });
        }
    }
    scene
}

fn camera() -> Camera {
    look_at(
        DVec3::new(3.0, 4.0, 26.0),
        DVec3::ZERO,
        perspective(1.0, 0.1),
    )
}

/// The ways of counting that return numbers, as far as the device has them and its driver gets them right: SwiftShader compares the depth of a pixel's middle with those of its samples.
fn counting_ways(gpu: &Gpu, samples: u32) -> Vec<Counting> {
    let tried = gpu.self_test(samples).unwrap();
    let is_wrong = |way: Counting| {
        let outcome = tried.outcome(Capability::of(way));
        matches!(outcome, Some(Outcome::Failed(_)))
    };
    [Counting::Compare, Counting::Identity, Counting::Atomics]
        .into_iter()
        .filter(|way| way.lacking(gpu, samples).is_none() && !is_wrong(*way))
        .collect()
}

fn all_ways_agree(gpu: &Gpu, samples: u32) {
    let scene = GpuScene::new(gpu, &mut scene()).unwrap();
    let camera = camera();
    let full = MeshDetail::Level(0);
    let image = Image {
        size: SIZE,
        samples,
    };
    let ways = counting_ways(gpu, samples);
    // OpenGL cannot read the samples of what was drawn.
    let least = if samples == 1 || gpu.reads_drawn_samples() {
        2
    } else {
        1
    };
    assert!(ways.len() >= least, "{ways:?} on {}", gpu.title());
    let counted = count(&scene, &camera, ways[0], full, image);
    assert!(
        counted.len() > 5000,
        "{} entities in the frustum",
        counted.len()
    );
    for way in ways {
        assert_eq!(count(&scene, &camera, way, full, image), counted, "{way}");
    }
    let asked = count(&scene, &camera, Counting::Queries, full, image);
    let booleans: Vec<_> = counted
        .iter()
        .map(|(slot, n)| (*slot, u32::from(*n > 0)))
        .collect();
    assert_eq!(asked, booleans);

    // Counts equal the oracle's samples: owned samples of occluders, visible fragments of transparent entities. Alpha-masked entities are
    // left out of its image, since they occlude nothing in a count.
    let table = scene.table();
    let counts = |slot: &u32| table.is_occluder(*slot) || table.is_transparent(*slot);
    let members: Vec<u32> = table.live_slots().filter(counts).collect();
    let mut oracle = Oracle::new(&scene, SIZE).with_samples(samples);
    let image = oracle
        .render(&scene, &camera, EntitySet::Slots(&members))
        .unwrap();
    let owned = image.samples_by_slot();
    let mut compared = [0, 0];
    for (slot, samples) in counted.iter().filter(|(slot, _)| counts(slot)) {
        let seen = owned.get(*slot as usize).copied().unwrap_or(0);
        assert_eq!(*samples, seen, "slot {slot}");
        compared[usize::from(table.is_transparent(*slot))] += usize::from(seen > 0);
    }
    assert!(
        compared[0] > 300 && compared[1] >= 6,
        "{compared:?} have pixels"
    );
}

fn boxes_and_smaller_images_agree(gpu: &Gpu) {
    let scene = GpuScene::new(gpu, &mut scene()).unwrap();
    let camera = camera();
    let half = SIZE.map(|side| side / 2);
    let one = |size| Image { size, samples: 1 };
    for (occludee, size) in [
        (MeshDetail::Box, SIZE),
        (MeshDetail::Box, half),
        (MeshDetail::Level(0), half),
    ] {
        let counted = count(&scene, &camera, Counting::Compare, occludee, one(size));
        assert!(counted.iter().any(|(_, samples)| *samples > 1));
        if Counting::Atomics.lacking(gpu, 1).is_none() {
            let atomics = count(&scene, &camera, Counting::Atomics, occludee, one(size));
            assert_eq!(atomics, counted, "{occludee:?} {size:?}");
        }
        let asked = count(&scene, &camera, Counting::Queries, occludee, one(size));
        let booleans: Vec<_> = counted
            .iter()
            .map(|(slot, n)| (*slot, u32::from(*n > 0)))
            .collect();
        assert_eq!(asked, booleans, "{occludee:?} {size:?}");
    }
}

#[test]
fn all_ways_agree_on_vulkan() {
    all_ways_agree(vulkan(), 1);
}

#[test]
fn all_ways_agree_on_four_samples_a_pixel() {
    all_ways_agree(vulkan(), 4);
    all_ways_agree(gl(), 4);
}

#[test]
fn all_ways_agree_on_gl() {
    all_ways_agree(gl(), 1);
}

#[test]
fn boxes_and_smaller_images_agree_on_vulkan() {
    boxes_and_smaller_images_agree(vulkan());
}

#[test]
fn boxes_and_smaller_images_agree_on_gl() {
    boxes_and_smaller_images_agree(gl());
}

#[test]
fn every_way_runs_on_vulkan() {
    let gpu = vulkan();
    for way in Counting::ALL {
        assert_eq!(way.lacking(gpu, 1), None, "{way} on {}", gpu.title());
        assert_eq!(way.lacking(gpu, 4), None, "{way} on {}", gpu.title());
    }
}
