//! The smallest program that culls: no optional feature, and so no C++ compiler, no file loader, no command line, and no renderer but its own. It draws a wall, and asks which of the
//! balls in its room are behind it.

use antumbra::cull::Verdicts;
use antumbra::cull::judge::{
    Eye, HostDepth, InstanceDesc, Instances, Judge, JudgeOptions, JudgeView, Part, Phases,
};
use antumbra::glam::{DAffine3, DVec3};
use antumbra::prelude::*;
use antumbra::scene::Aabb;
use antumbra::wgpu;

/// The wall: 8 m wide, 4 m high, 8 m before the eye, as reversed depth has it.
const SHADER: &str = "
    @vertex fn wall(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
        let corner = vec2f(f32(i & 1u), f32(i >> 1u)) * 2.0 - 1.0;
        return vec4f(corner * vec2f(0.9, 0.6), 0.1 / 8.0, 1.0);
    }
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    let size = [640, 480];
    let depth = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("our depth"),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Depth32Float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let wall = wall(&gpu.device);

    let mut instances = Instances::new(&gpu);
    for x in -20..=20 {
        instances.insert(InstanceDesc {
            bounds: Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.4)),
            at: DAffine3::from_translation(DVec3::new(f64::from(x), 0.0, -3.0)),
            part: Part::Both,
        })?;
    }
    let view = JudgeView::main(size[0], size[1], HostDepth::default());
    let options = JudgeOptions {
        phases: Phases::Late,
        list: true,
        ..JudgeOptions::default()
    };
    let mut judge = Judge::new(&gpu, vec![view], options)?;
    let projection = Projection::Perspective {
        fov_y: 0.8,
        near: 0.1,
    };
    let camera = Camera::look_at(DVec3::Z * 8.0, DVec3::ZERO, DVec3::Y, projection)?;
    let mut verdicts = Verdicts::default();
    for _ in 0..2 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        judge.begin(&mut instances, &[Eye::of(&camera, size)], &mut encoder)?;
        draw(&mut encoder, &wall, &depth);
        judge.test(&[&depth], &mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.wait()?;
        // An answer is a frame late: the first frame draws everything in the view.
        judge.verdicts(0, &mut instances, &mut verdicts)?;
        println!(
            "{} of {} balls are drawn",
            verdicts.drawn().count(),
            instances.len()
        );
    }
    Ok(())
}

fn wall(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("wall"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("wall"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("wall"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

fn draw(encoder: &mut wgpu::CommandEncoder, wall: &wgpu::RenderPipeline, depth: &wgpu::Texture) {
    let view = depth.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("ours"),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    pass.set_pipeline(wall);
    pass.draw(0..4, 0..1);
}
