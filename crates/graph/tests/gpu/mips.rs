//! A chain of mips, each made from the one before within one texture.

use antumbra_graph::{
    Bind, Buffer, BufferDesc, CompileError, CompileOptions, Graph, Texture, TextureDesc,
};

use crate::device::{Gpu, gpu};

const SIDE: u32 = 8;
const MIPS: u32 = 4;

/// How a node reads the mip before the one that it writes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reading {
    Sampled,
    Storage,
}

/// Writes numbers into mip 0, into each further mip the largest of four texels of the mip before, and the corner of each mip into a buffer.
fn chain(gpu: &Gpu, reading: Reading) -> (Graph, Buffer) {
    let mut g = Graph::new("mips");
    let desc = TextureDesc::new(SIDE, SIDE, wgpu::TextureFormat::R32Float).mips(MIPS);
    let mut image = g.texture("image", desc);
    let number = "f32(id.x + 10u * id.y)".to_owned();
    let finest = gpu.level("", &number);
    let load = |offset: &str| match reading {
        Reading::Sampled => format!("textureLoad(finer, id.xy * 2u + vec2u({offset}), 0).x"),
        Reading::Storage => format!("textureLoad(finer, id.xy * 2u + vec2u({offset})).x"),
    };
    let finer = match reading {
        Reading::Sampled => "@group(0) @binding(0) var finer: texture_2d<f32>;",
        Reading::Storage => "@group(0) @binding(0) var finer: texture_storage_2d<r32float, read>;",
    };
    let [a, b, c, d] = ["0, 0", "1, 0", "0, 1", "1, 1"].map(load);
    let coarser = gpu.level(finer, &format!("max(max({a}, {b}), max({c}, {d}))"));
    for mip in 0..MIPS {
        let pipeline = if mip == 0 { &finest } else { &coarser }.clone();
        let layout = pipeline.get_bind_group_layout(0);
        let mut node = g.compute(format!("mip {mip}"));
        let mut binds: Vec<Bind> = Vec::new();
        if mip > 0 {
            match reading {
                Reading::Sampled => node.sample(image),
                Reading::Storage => node.storage_texture_read(image),
            };
            binds.push(Bind::Mip(0, image, mip - 1));
        }
        let next = node.storage_texture_write(image);
        binds.push(Bind::Mip(1, next, mip));
        node.run(move |ctx| {
            let group = ctx.bind_group(0, &layout, &binds)?;
            ctx.pass().set_pipeline(&pipeline);
            ctx.pass().set_bind_group(0, &group, &[]);
            ctx.pass().dispatch_workgroups(SIDE >> mip, SIDE >> mip, 1);
            Ok(())
        });
        image = next;
    }
    let corners = corners(gpu, &mut g, image);
    (g, corners)
}

/// Adds a node that reads the last texel of each mip.
fn corners(gpu: &Gpu, g: &mut Graph, image: Texture) -> Buffer {
    let pipeline = gpu.pipeline(&format!(
        "@group(0) @binding(0) var image: texture_2d<f32>;
        @group(0) @binding(1) var<storage, read_write> corners: array<u32>;
        @compute @workgroup_size(1) fn main() {{
            for (var mip = 0; mip < {MIPS}; mip++) {{
                let last = textureDimensions(image, mip) - 1u;
                corners[mip] = u32(textureLoad(image, last, mip).x);
            }}
        }}"
    ));
    let layout = pipeline.get_bind_group_layout(0);
    let corners = g.buffer("corners", BufferDesc::new(u64::from(MIPS) * 4));
    let mut node = g.compute("read all mips");
    node.sample(image);
    let corners = node.storage_write(corners);
    node.run(move |ctx| {
        let binds = [Bind::Texture(0, image), Bind::Buffer(1, corners)];
        let group = ctx.bind_group(0, &layout, &binds)?;
        ctx.pass().set_pipeline(&pipeline);
        ctx.pass().set_bind_group(0, &group, &[]);
        ctx.pass().dispatch_workgroups(1, 1, 1);
        Ok(())
    });
    g.output(corners);
    corners
}

impl Gpu {
    /// A pipeline that writes a value for each texel of a mip.
    fn level(&self, finer: &str, value: &str) -> wgpu::ComputePipeline {
        self.pipeline(&format!(
            "{finer}
            @group(0) @binding(1) var coarser: texture_storage_2d<r32float, write>;
            @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3u) {{
                textureStore(coarser, id.xy, vec4f({value}));
            }}"
        ))
    }

    fn pipeline(&self, source: &str) -> wgpu::ComputePipeline {
        let module = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
        self.device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                cache: None,
            })
    }
}

/// The last texel is the largest of its mip, at every mip.
fn check(gpu: &Gpu, reading: Reading) {
    let (g, corners) = chain(gpu, reading);
    let mut plan = gpu.compile(g);
    for _ in 0..2 {
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        let found = gpu.read_u32(plan.buffer(corners).unwrap(), u64::from(MIPS));
        assert_eq!(found, [(SIDE - 1) * 11; MIPS as usize]);
    }
}

#[test]
fn a_mip_is_made_from_the_one_before_on_every_backend() {
    for backends in [wgpu::Backends::VULKAN, wgpu::Backends::GL] {
        check(&gpu(backends), Reading::Storage);
    }
}

/// On OpenGL a texture has only the mips that it was last sampled with: a write of another is lost.
#[test]
fn a_mip_is_sampled_while_another_is_written_except_on_opengl() {
    check(&gpu(wgpu::Backends::VULKAN), Reading::Sampled);
    let gl = gpu(wgpu::Backends::GL);
    let (g, _) = chain(&gl, Reading::Sampled);
    let refused = g.compile(&CompileOptions::owned(&gl.device)).err().unwrap();
    let passes: Vec<&str> = refused
        .errors
        .iter()
        .map(|error| match error {
            CompileError::SampledBesideWrite { pass, resource } if resource == "image" => pass,
            other => panic!("{other}"),
        })
        .map(String::as_str)
        .collect();
    assert_eq!(passes, ["mip 1", "mip 2", "mip 3"]);
}

#[test]
fn the_last_frames_texture_is_sampled_while_this_frames_is_written_on_every_backend() {
    for backends in [wgpu::Backends::VULKAN, wgpu::Backends::GL] {
        let gpu = gpu(backends);
        let mut g = Graph::new("accumulate");
        let desc = TextureDesc::new(SIDE, SIDE, wgpu::TextureFormat::R32Float).mips(MIPS);
        let image = g.texture("image", desc);
        let mut node = g.compute("accumulate");
        node.sample(image.previous());
        let image = node.storage_texture_write(image);
        node.run(|_| Ok(()));
        g.output(image);
        let mut plan = gpu.compile(g);
        plan.execute(&gpu.device, &gpu.queue).unwrap();
    }
}
