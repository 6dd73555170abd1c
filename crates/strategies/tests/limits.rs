//! wgpu's default limits and no feature at all: what a host's device may be. Every strategy runs there that does not need indirect draws; the others are refused, and
//! the message names what is missing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, Stage, StageOptions};
use antumbra_draw::GpuScene;
use antumbra_strategies::registry;
use antumbra_testing::{balls_with_proxies, gpus, views};
use antumbra_verify::kit::{Case, Kit};

/// A device with these features alone and with the default limits, on an adapter of this backend.
fn plain(backend: wgpu::Backends, features: wgpu::Features) -> Gpu {
    let adapters = pollster::block_on(antumbra_cull::adapters(backend));
    let adapter = adapters.first().expect("an adapter, as for all tests");
    let limits = wgpu::Limits::default().or_worse_values_from(&adapter.limits());
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: features,
        required_limits: limits,
        ..Default::default()
    }))
    .unwrap();
    let downlevel = adapter.get_downlevel_capabilities();
    let gpu = Gpu::adopt(device, queue, adapter.get_info(), downlevel);
    // So that the kit sees what wgpu refuses.
    gpu.watch();
    gpu
}

fn kit() -> Kit {
    Kit {
        cases: vec![
            Case::RandomScenes,
            Case::Outgrow,
            Case::Stereo,
            Case::Resize,
        ],
        random_scenes: 2,
        ..Kit::default()
    }
}

#[test]
fn what_needs_no_feature_conforms_on_default_limits() {
    for backend in [wgpu::Backends::VULKAN, wgpu::Backends::GL] {
        let gpu = plain(backend, wgpu::Features::empty());
        for text in [
            "frustum",
            "stop-and-wait",
            "three-pass:latency=frame-late",
            "three-pass:latency=same-frame:counting=queries:threshold=0",
            "three-pass:latency=same-frame:counting=identity",
            "coherent:latency=same-frame",
            "coherent:latency=frame-late",
            "occupancy-map:latency=same-frame",
            "occupancy-map:latency=frame-late",
            "chc-plus-plus:latency=same-frame",
            "chc-plus-plus:latency=frame-late",
        ] {
            let make = || registry().parse(text).unwrap();
            if let Err(failure) = kit().check_on(&gpu, make) {
                panic!("{text}: {failure}");
            }
        }
    }
}

#[test]
fn what_needs_indirect_draws_alone_conforms_on_default_limits() {
    for backend in [wgpu::Backends::VULKAN, wgpu::Backends::GL] {
        let gpu = plain(backend, wgpu::Features::INDIRECT_FIRST_INSTANCE);
        for text in [
            "three-pass:latency=on-gpu",
            "coherent:latency=on-gpu",
            "depth-pyramid",
            "depth-pyramid:like=bevy",
        ] {
            let make = || registry().parse(text).unwrap();
            if let Err(failure) = kit().check_on(&gpu, make) {
                panic!("{text}: {failure}");
            }
        }
    }
}

#[test]
fn what_needs_indirect_draws_says_so() {
    let gpu = plain(wgpu::Backends::VULKAN, wgpu::Features::empty());
    let scene = GpuScene::new(&gpu, &mut balls_with_proxies(3)).unwrap();
    let stage = |text: &str| {
        let strategy = registry().parse(text).unwrap();
        Stage::new(
            &scene,
            strategy,
            views(&["main"], [64, 48]),
            StageOptions::default(),
        )
    };
    for text in [
        "three-pass:latency=on-gpu",
        "coherent:latency=on-gpu",
        "depth-pyramid",
    ] {
        let error = stage(text).unwrap_err().to_string();
        assert!(error.contains("INDIRECT_FIRST_INSTANCE"), "{text}: {error}");
        assert!(
            error.contains("pass `shade"),
            "{text} names no pass: {error}"
        );
    }
    // The same strategies run where the feature is.
    for gpu in gpus() {
        let scene = GpuScene::new(gpu, &mut balls_with_proxies(3)).unwrap();
        let strategy = registry().parse("three-pass:latency=on-gpu").unwrap();
        let views = views(&["main"], [64, 48]);
        assert!(Stage::new(&scene, strategy, views, StageOptions::default()).is_ok());
    }
}
