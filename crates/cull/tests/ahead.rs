//! A host that records two frames before it submits the first: each frame is drawn with its own transforms and judged by its own verdicts.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, Stage, StageOptions, StageScene, ViewInput, read_back};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{Camera, Drawable, EntityKey, Material, Mesh, MeshKey, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{
    HostTargets, add, balls_with_proxies, gpus, look_at, perspective, stage_with, views,
};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [96, 72];
const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

fn camera() -> Camera {
    look_at(
        DVec3::new(3.0, 1.0, 7.0),
        DVec3::ZERO,
        perspective(0.9, 0.05),
    )
}

/// A frame of a host, recorded and not submitted.
fn record(
    stage: &mut Stage,
    scene: &GpuScene,
    mut encoder: wgpu::CommandEncoder,
) -> (wgpu::CommandBuffer, HostTargets) {
    let images = HostTargets::new(scene.gpu(), SIZE, COLOUR, wgpu::TextureUsages::COPY_SRC);
    let input = ViewInput {
        targets: Some(images.imported()),
        ..ViewInput::new(camera())
    };
    stage.record(scene, &[input], &mut encoder).unwrap();
    (encoder.finish(), images)
}

fn embedded(scene: &GpuScene) -> Stage {
    let options = StageOptions {
        mode: Mode::Embedded,
        colour_format: COLOUR,
        ..StageOptions::default()
    };
    let strategy = registry()
        .parse("three-pass:latency=on-gpu:threshold=0:occluders=full:occludees=full:scale=1");
    stage_with(scene, strategy.unwrap(), views(&["main"], SIZE), options)
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&Default::default())
}

fn pixels(gpu: &Gpu, images: &HostTargets) -> Vec<u8> {
    read_back::texture(gpu, &images.colour).unwrap()
}

/// A scene before and after a change, and what changes.
fn changed(host: &mut Scene, movers: &[EntityKey], grown: bool) {
    for key in movers {
        let place = host.local(*key).unwrap();
        let aside = DAffine3::from_translation(DVec3::new(0.3, 0.4, 0.2));
        host.set_local(*key, aside * place).unwrap();
    }
    if grown {
        let drawable = host.drawables().next().unwrap().1;
        for number in 0..200 {
            let place = DVec3::new(f64::from(number) * 0.02 - 2.0, 1.9, 1.0);
            add(host, DAffine3::from_translation(place), drawable);
        }
    }
}

#[test]
fn a_frame_that_is_recorded_ahead_leaves_the_one_before_as_it_was() {
    for gpu in gpus() {
        for grown in [false, true] {
            let mut host = balls_with_proxies(4);
            let movers: Vec<_> = host.drawables().map(|(key, _)| key).step_by(3).collect();
            let mut after = host.clone();
            changed(&mut after, &movers, grown);
            // What each frame shows by itself.
            let alone = |host: &mut Scene| {
                let scene = GpuScene::new(gpu, host).unwrap();
                let (commands, images) = record(&mut embedded(&scene), &scene, encoder(gpu));
                gpu.queue.submit([commands]);
                pixels(gpu, &images)
            };
            let expected = [alone(&mut host.clone()), alone(&mut after)];
            assert!(expected[0] != expected[1]);

            let mut scene = GpuScene::new(gpu, &mut host).unwrap();
            let mut stage = embedded(&scene);
            let before = scene.layout();
            let mut first = encoder(gpu);
            scene.sync_in(&mut host, &mut first).unwrap();
            let (first, first_images) = record(&mut stage, &scene, first);
            changed(&mut host, &movers, grown);
            let mut second = encoder(gpu);
            scene.sync_in(&mut host, &mut second).unwrap();
            assert_eq!(scene.layout() != before, grown, "the buffers are outgrown");
            let (second, second_images) = record(&mut stage, &scene, second);
            gpu.queue.submit([first, second]);
            let found = [&first_images, &second_images].map(|images| pixels(gpu, images));
            assert!(found[0] == expected[0], "the first frame, grown: {grown}");
            assert!(found[1] == expected[1], "the second frame, grown: {grown}");
            gpu.check().unwrap();
        }
    }
}

/// A scene of one ball whose vertices may be replaced.
fn deforming() -> (Scene, MeshKey) {
    let mut host = Scene::new();
    let mesh = Mesh::new("ball", icosphere(2, 1.0));
    let mesh = host.add_deforming_mesh(mesh).unwrap();
    let material = host.add_material(Material::default());
    add(&mut host, DAffine3::IDENTITY, Drawable { mesh, material });
    (host, mesh)
}

/// Stretches the ball along y; where the scene is to grow, also adds a mesh that the arenas have no room for.
fn stretch(host: &mut Scene, mesh: MeshKey, factor: f32, grown: bool) {
    let ball = icosphere(2, 1.0);
    let stretched = ball.positions.iter().map(|[x, y, z]| [*x, *y * factor, *z]);
    host.set_vertices(mesh, stretched.collect(), ball.normals)
        .unwrap();
    if grown {
        grow(host);
    }
}

/// Adds a mesh that the arenas have no room for.
fn grow(host: &mut Scene) {
    let drawable = Drawable {
        mesh: host
            .add_mesh(Mesh::new("large", icosphere(5, 0.5)))
            .unwrap(),
        ..host.drawables().next().unwrap().1
    };
    add(host, DAffine3::from_translation(DVec3::X * 2.0), drawable);
}

#[test]
fn vertices_that_are_replaced_ahead_leave_the_frame_before_as_it_was() {
    for gpu in gpus() {
        for grown in [false, true] {
            let alone = |shapes: &[(f32, bool)]| {
                let (mut host, mesh) = deforming();
                for (factor, grown) in shapes {
                    stretch(&mut host, mesh, *factor, *grown);
                }
                let scene = GpuScene::new(gpu, &mut host).unwrap();
                let (commands, images) = record(&mut embedded(&scene), &scene, encoder(gpu));
                gpu.queue.submit([commands]);
                pixels(gpu, &images)
            };
            let expected = [alone(&[(2.0, false)]), alone(&[(0.5, grown)])];
            assert!(expected[0] != expected[1]);

            let (mut host, mesh) = deforming();
            let mut scene = GpuScene::new(gpu, &mut host).unwrap();
            let mut stage = embedded(&scene);
            stretch(&mut host, mesh, 2.0, false);
            let mut first = encoder(gpu);
            scene.sync_in(&mut host, &mut first).unwrap();
            let (first, first_images) = record(&mut stage, &scene, first);
            let mut second = encoder(gpu);
            stretch(&mut host, mesh, 0.5, grown);
            scene.sync_in(&mut host, &mut second).unwrap();
            let (second, second_images) = record(&mut stage, &scene, second);
            gpu.queue.submit([first, second]);
            let found = [&first_images, &second_images].map(|images| pixels(gpu, images));
            assert!(found[0] == expected[0], "the first frame, grown: {grown}");
            assert!(found[1] == expected[1], "the second frame, grown: {grown}");
            gpu.check().unwrap();
        }
    }
}

#[test]
fn vertices_that_are_not_submitted_yet_outlive_the_buffer_that_they_were_written_to() {
    for (gpu, stops) in gpus()
        .into_iter()
        .flat_map(|gpu| [(gpu, false), (gpu, true)])
    {
        let (mut host, mesh) = deforming();
        stretch(&mut host, mesh, 2.0, true);
        let expected = {
            let scene = GpuScene::new(gpu, &mut host.clone()).unwrap();
            let (commands, images) = record(&mut embedded(&scene), &scene, encoder(gpu));
            gpu.queue.submit([commands]);
            pixels(gpu, &images)
        };
        let (mut host, mesh) = deforming();
        let mut scene = GpuScene::new(gpu, &mut host).unwrap();
        stretch(&mut host, mesh, 2.0, false);
        let mut first = encoder(gpu);
        scene.sync_in(&mut host, &mut first).unwrap();
        // The scene grows, and its vertices are as before.
        if stops {
            host.stop_deforming(mesh);
        }
        grow(&mut host);
        let mut second = encoder(gpu);
        scene.sync_in(&mut host, &mut second).unwrap();
        let (second, images) = record(&mut embedded(&scene), &scene, second);
        gpu.queue.submit([first.finish(), second]);
        assert!(pixels(gpu, &images) == expected);
        gpu.check().unwrap();
    }
}
