//! What the self-test of a device costs: on a device that was just opened, on a second one of the same process, and when the report is there.
//!
//!     cargo run --release -p antumbra-cull --example self_test_cost -- vulkan gl
//!
//! Mesa keeps compiled shaders on disk: MESA_SHADER_CACHE_DISABLE=true in the environment measures without.

use std::time::Instant;

use antumbra_cull::{AdapterChoice, DeviceError, Gpu};

fn main() -> Result<(), DeviceError> {
    for name in std::env::args().skip(1) {
        let choice = AdapterChoice::Named(name);
        for samples in [1, 4] {
            for which in ["first device", "second device", "third device"] {
                let gpu = Gpu::open(&choice)?;
                let [test, again] = [(); 2].map(|()| {
                    let start = Instant::now();
                    let report = gpu.self_test(samples);
                    (start.elapsed().as_secs_f64() * 1e3, report)
                });
                let right = if test.1?.passed() { "right" } else { "WRONG" };
                again.1?;
                println!(
                    "{}, {samples} samples a pixel, {which}: {:.2} ms, {right}; again: {:.4} ms",
                    gpu.title(),
                    test.0,
                    again.0
                );
            }
        }
    }
    Ok(())
}
