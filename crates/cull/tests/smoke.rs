//! End to end on a small grid: every strategy draws the same picture as drawing everything.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::*;
use antumbra_draw::{AdapterChoice, Gpu, GpuScene, read_back};
use antumbra_scene::builtin::{GridOptions, grid};
use antumbra_scene::{Camera, Projection};
use glam::DVec3;

#[test]
fn smoke() {
    let choice = std::env::var("ANTUMBRA_TEST_ADAPTER")
        .unwrap_or_else(|_| "auto".into())
        .parse::<AdapterChoice>()
        .unwrap();
    let gpu = Gpu::open(&choice).unwrap();
    println!("{}", gpu.title());
    let mut scene = grid(GridOptions {
        per_side: 6,
        ..Default::default()
    })
    .unwrap();
    scene.ensure_proxies(&Default::default());
    let gpu_scene = GpuScene::new(&gpu, &mut scene).unwrap();
    let camera = Camera::look_at(
        DVec3::new(7.0, 4.0, 8.0),
        DVec3::ZERO,
        DVec3::Y,
        Projection::Perspective {
            fov_y: 0.785,
            near: 0.1,
        },
    )
    .unwrap();
    let registry = Registry::built_in();
    let mut reference = None;
    for text in [
        "none",
        "frustum",
        "stop-and-wait",
        "three-pass:latency=same-frame:occluders=full:occludees=full:counting=identity",
        "three-pass:latency=same-frame:occluders=full:occludees=full:counting=queries",
        "three-pass:latency=same-frame:occluders=full:occludees=full:counting=atomics",
        "three-pass:latency=same-frame:occluders=full:occludees=full:counting=compare",
        "three-pass:latency=on-gpu:occluders=full:occludees=full:counting=identity",
        "three-pass:latency=on-gpu:occluders=full:occludees=full:counting=queries",
        "three-pass:latency=frame-late",
    ] {
        let strategy = registry.parse(text).unwrap();
        let mut stage = Stage::new(
            &gpu_scene,
            strategy,
            vec![ViewSpec::main(320, 240)],
            StageOptions::default(),
        )
        .unwrap();
        for _ in 0..3 {
            let start = std::time::Instant::now();
            stage
                .frame(&gpu_scene, &[ViewInput::new(camera.clone())])
                .unwrap();
            gpu.wait().unwrap();
            println!("{text}: {:?}", start.elapsed());
        }
        let verdicts = stage.verdicts(0, &gpu_scene).unwrap();
        println!(
            "{text}: {:?} sync {}",
            verdicts.tally(),
            stage.plan().sync_points()
        );
        let pixels = read_back::texture(&gpu, stage.colour(0).unwrap()).unwrap();
        if text == "none" {
            std::fs::write("/tmp/none.rgba", &pixels).unwrap();
            reference = Some(pixels);
        } else {
            let wrong = pixels
                .chunks(4)
                .zip(reference.as_ref().unwrap().chunks(4))
                .filter(|(a, b)| a != b)
                .count();
            println!("{text}: {wrong} pixels differ");
        }
    }
}
