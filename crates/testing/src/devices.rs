//! Devices, opened once per test program and shared by its tests, which run on several threads.
//!
//! Sharing is sound: wgpu's devices are thread-safe, each test has resources of its own, and what `Gpu::wait` waits for beyond a test's own work
//! is done sooner or later. A test that makes a device fail opens its own.

use std::sync::OnceLock;

use antumbra_cull::{AdapterChoice, Gpu};

/// The first Vulkan adapter.
pub fn vulkan() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open("vulkan"))
}

/// The first OpenGL adapter.
pub fn gl() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open("gl"))
}

/// Vulkan, then OpenGL: what a promise about every backend is tested on.
pub fn gpus() -> [&'static Gpu; 2] {
    [vulkan(), gl()]
}

/// The adapter that programs take where the user names none.
pub fn auto() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| open("auto"))
}

/// SwiftShader, whose rasteriser errs where a pixel has several samples: a fragment has the depth of the pixel's middle, and what covers a sample only because its corners were moved to
/// 1/16 of a pixel is drawn there at a depth beyond all of them, before what hides it.
pub fn is_swiftshader(gpu: &Gpu) -> bool {
    gpu.info.name.contains("SwiftShader")
}

fn open(choice: &str) -> Gpu {
    let Ok(choice) = choice.parse::<AdapterChoice>();
    Gpu::open(&choice)
        .unwrap_or_else(|error| panic!("{error}. `make test` installs software drivers first"))
}
