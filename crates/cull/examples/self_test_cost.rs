//! What the self-test costs: making the first stage of a device with it and without, strategy by strategy, and everything at once.
//!
//!     cargo run --release -p antumbra-cull --example self_test_cost -- vulkan gl
//!
//! Each time is the least of several, each on a device that was just opened. Mesa keeps compiled shaders on disk: MESA_SHADER_CACHE_DISABLE=true in the environment
//! measures without.

use std::error::Error;
use std::time::Instant;

use antumbra_cull::{AdapterChoice, DistrustOptions, Gpu, Stage, StageOptions, ViewSpec};
use antumbra_draw::GpuScene;
use antumbra_strategies::registry;
use antumbra_testing::balls_with_proxies;

const STRATEGIES: [&str; 7] = [
    "three-pass",
    "three-pass:latency=on-gpu",
    "three-pass:counting=atomics",
    "occupancy-map:latency=same-frame",
    "depth-pyramid",
    "coherent:latency=same-frame",
    "coherent:latency=on-gpu",
];
const TIMES: usize = 7;

/// Milliseconds to make a stage of a new device.
fn making(
    choice: &AdapterChoice,
    strategy: &str,
    distrust: DistrustOptions,
) -> Result<f64, Box<dyn Error>> {
    let gpu = Gpu::open(choice)?;
    let scene = GpuScene::new(&gpu, &mut balls_with_proxies(4))?;
    let strategy = registry().parse(strategy)?;
    let options = StageOptions {
        distrust,
        ..StageOptions::default()
    };
    let start = Instant::now();
    let stage = Stage::new(&scene, strategy, vec![ViewSpec::main(640, 480)], options)?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    match stage.distrust() {
        [] => Ok(milliseconds),
        [found, ..] => Err(found.to_string().into()),
    }
}

/// Milliseconds of a test of everything.
fn everything(choice: &AdapterChoice, samples: u32) -> Result<f64, Box<dyn Error>> {
    let gpu = Gpu::open(choice)?;
    let start = Instant::now();
    let report = gpu.self_test(samples)?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    match report.passed() {
        true => Ok(milliseconds),
        false => Err(report.to_string().into()),
    }
}

fn least(mut measure: impl FnMut() -> Result<f64, Box<dyn Error>>) -> Result<f64, Box<dyn Error>> {
    let mut least = f64::INFINITY;
    for _ in 0..TIMES {
        least = measure()?.min(least);
    }
    Ok(least)
}

fn main() -> Result<(), Box<dyn Error>> {
    for name in std::env::args().skip(1) {
        let choice = AdapterChoice::Named(name.clone());
        for strategy in STRATEGIES {
            let without = least(|| making(&choice, strategy, DistrustOptions::OFF))?;
            let with = least(|| making(&choice, strategy, DistrustOptions::default()))?;
            println!(
                "{name}, {strategy}: {without:.1} ms without, {with:.1} ms with: {:.1} ms",
                with - without
            );
        }
        for samples in [1, 4] {
            let all = least(|| everything(&choice, samples))?;
            println!("{name}, everything with {samples} samples a pixel: {all:.1} ms");
        }
    }
    Ok(())
}
