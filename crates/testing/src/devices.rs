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

fn open(choice: &str) -> Gpu {
    let Ok(choice) = choice.parse::<AdapterChoice>();
    Gpu::open(&choice)
        .unwrap_or_else(|error| panic!("{error}. `make test` installs software drivers first"))
}
