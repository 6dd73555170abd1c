//! A device without enough memory: the error that `compile` gives. The noop device allocates its buffers on the host, where this program's
//! allocator fails past a limit.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::alloc::System;

use antumbra_graph::{BufferDesc, CompileOptions, Graph};
use cap::Cap;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, 512 << 20);

/// Compiles a plan with a buffer of this size.
fn compile(bytes: u64) -> Result<(), String> {
    let limits = wgpu::Limits {
        max_buffer_size: 1 << 30,
        max_storage_buffer_binding_size: 1 << 30,
        ..Default::default()
    };
    let (device, _) = wgpu::Device::noop(&wgpu::DeviceDescriptor {
        required_limits: limits,
        ..Default::default()
    });
    let mut g = Graph::new("large");
    let data = g.buffer("data", BufferDesc::new(bytes));
    let mut node = g.compute("write");
    let _ = node.storage_write(data);
    node.side_effect().run(|_| Ok(()));
    let plan = g.compile(&CompileOptions::owned(&device));
    plan.map(drop).map_err(|errors| errors.to_string())
}

#[test]
fn insufficient_memory_is_an_error_that_says_so() {
    compile(4).unwrap();
    let message = compile(1 << 30).unwrap_err();
    assert!(message.contains("large"), "{message}");
    assert!(message.to_lowercase().contains("memory"), "{message}");
}
