//! Helpers that declare test graphs, and a device that does nothing.

use antumbra_graph::{
    Buffer, BufferDesc, CompileError, CompileOptions, Graph, Host, Plan, Texture, TextureDesc,
};

/// A noop device without any feature.
pub fn noop() -> (wgpu::Device, wgpu::Queue) {
    wgpu::Device::noop(&wgpu::DeviceDescriptor::default())
}

pub fn compile(g: Graph) -> Plan {
    g.compile(&CompileOptions::owned(&noop().0))
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// The errors of an owned plan on a device without features.
pub fn errors(g: Graph) -> Vec<CompileError> {
    match g.compile(&CompileOptions::owned(&noop().0)) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.errors,
    }
}

pub fn colour() -> TextureDesc {
    TextureDesc::new(64, 64, wgpu::TextureFormat::Rgba8Unorm)
}

pub fn depth() -> TextureDesc {
    TextureDesc::new(64, 64, wgpu::TextureFormat::Depth32Float)
}

/// A raster node that draws nothing into a colour target.
pub fn draw(g: &mut Graph, name: &str, target: Texture, samples: &[Texture]) -> Texture {
    let mut node = g.raster(name);
    let target = node.colour(target);
    for texture in samples {
        node.sample(*texture);
    }
    node.run(|_| Ok(()));
    target
}

/// A compute node that writes one buffer and reads others.
pub fn compute(g: &mut Graph, name: &str, target: Buffer, reads: &[Buffer]) -> Buffer {
    let mut node = g.compute(name);
    let target = node.storage_write(target);
    for buffer in reads {
        node.storage_read(*buffer);
    }
    node.run(|_| Ok(()));
    target
}

/// A host node that reads back and writes a host value.
pub fn wait(g: &mut Graph, name: &str, reads: &[Buffer], target: Host<u32>) -> Host<u32> {
    let mut node = g.host_node(name);
    for buffer in reads {
        node.read_back(*buffer);
    }
    let target = node.write(target);
    node.run(|_| Ok(()));
    target
}

pub fn bytes(size: u64) -> BufferDesc {
    BufferDesc::new(size)
}

pub fn names(plan: &Plan) -> Vec<&str> {
    plan.passes().iter().map(|pass| pass.name).collect()
}
