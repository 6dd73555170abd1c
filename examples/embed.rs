//! The culling stage inside a host's frame. This program owns its instance, device, textures, encoder and passes; the stage records its passes
//! between two of the host's and submits nothing. The last frame is saved as `out/embed.png`.

use std::error::Error;
use std::path::{Path, PathBuf};

use antumbra::cull::{
    DEPTH_FORMAT, Gpu, ImportedTargets, Stage, StageOptions, ViewInput, ViewSpec, WANTED_FEATURES,
    read_back,
};
use antumbra::demo_scenes;
use antumbra::draw::GpuScene;
use antumbra::graph::Mode;
use antumbra::measure::image_error::save_png;
use antumbra::scene::{Camera, Projection};
use antumbra::strategies::registry;
use glam::DVec3;

const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const NEAR: f64 = 0.1;
const EYE: DVec3 = DVec3::new(6.0, 4.0, 8.0);

/// The host's own drawing: a sky behind everything, and a board at the depth of the scene's centre.
const SHADER: &str = "
    override depth: f32 = 0.0;
    @vertex fn sky(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
        return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, depth, 1.0);
    }
    @vertex fn board(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
        return vec4f(f32(i & 1u) * 1.8 - 0.9, f32(i >> 1u) * 0.4 - 0.2, depth, 1.0);
    }
    @fragment fn blue(@builtin(position) at: vec4f) -> @location(0) vec4f {
        return vec4f(0.0, 0.05, 0.3 + 0.2 * fract(at.y / 512.0), 1.0);
    }
    @fragment fn orange() -> @location(0) vec4f {
        return vec4f(1.0, 0.2, 0.0, 1.0);
    }
";

/// `embed [PNG]`
pub fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args_os().nth(1).map(PathBuf::from);
    let output = output.unwrap_or_else(|| "out/embed.png".into());
    if let Some(folder) = output.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let refusal = run([640, 480], 8, &output)?;
    println!("the same stage with a sync point is refused:\n{refusal}");
    println!("image: {}", output.display());
    Ok(())
}

/// Draws some frames and saves the last. Returns the error of a stage that would have to wait within the host's frame.
pub fn run(size: [u32; 2], frames: u32, output: &Path) -> Result<String, Box<dyn Error>> {
    let (gpu, scene) = pollster::block_on(open())?;
    let Gpu { device, queue, .. } = &gpu;
    let options = StageOptions {
        mode: Mode::Embedded,
        colour_format: COLOUR,
        ..StageOptions::default()
    };
    let stage = |strategy: &str| -> Result<Stage, Box<dyn Error>> {
        let strategy = registry().parse(strategy)?;
        let views = vec![ViewSpec::main(size[0], size[1])];
        Ok(Stage::new(&scene, strategy, views, options.clone())?)
    };
    let refusal =
        stage("three-pass:latency=same-frame").map_or_else(|e| e.to_string(), |_| "no".into());
    let mut stage = stage("three-pass:latency=frame-late")?;

    let colour = texture(device, "our colour", COLOUR, size);
    let depth = texture(device, "our depth", DEPTH_FORMAT, size);
    // Reversed depth with an infinite far plane: the near plane divided by the distance.
    let middle = NEAR / EYE.length();
    let sky = pipeline(device, ["sky", "blue"], wgpu::CompareFunction::Always, 0.0);
    let board = pipeline(
        device,
        ["board", "orange"],
        wgpu::CompareFunction::GreaterEqual,
        middle,
    );
    for frame in 0..frames {
        let eye = EYE.rotate_y(f64::from(frame) * 0.02);
        let projection = Projection::Perspective {
            fov_y: 0.7,
            near: NEAR,
        };
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
        let mut encoder = device.create_command_encoder(&Default::default());
        let first = wgpu::LoadOp::Clear(0.0);
        draw(&mut encoder, [&colour, &depth], first, &sky, 3);
        let targets = Some(ImportedTargets {
            colour: &colour,
            depth: &depth,
        });
        let view = ViewInput {
            targets,
            ..ViewInput::new(camera)
        };
        let report = stage.record(&scene, &[view], &mut encoder)?;
        draw(
            &mut encoder,
            [&colour, &depth],
            wgpu::LoadOp::Load,
            &board,
            4,
        );
        queue.submit([encoder.finish()]);
        // A window would present here. The stage itself never waits; the device's loss callback, or `Gpu::watch` and `check`, notice a lost device.
        gpu.wait()?;
        let verdicts = stage.verdicts(0, &scene)?;
        let drawn = verdicts.drawn().count();
        println!(
            "frame {}: drew {drawn} of {} entities",
            report.frame,
            scene.table().live()
        );
    }
    let [width, height] = size;
    let image = image::RgbaImage::from_raw(width, height, read_back::texture(&gpu, &colour)?);
    save_png(&image.ok_or("an image of another size")?, output)?;
    Ok(refusal)
}

/// The host's device, with the features that culling can use, and a scene on it.
async fn open() -> Result<(Gpu, GpuScene), Box<dyn Error>> {
    let mut backends = wgpu::InstanceDescriptor::new_without_display_handle();
    backends.backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    let instance = wgpu::Instance::new(backends);
    let adapter = instance.request_adapter(&Default::default()).await?;
    let wanted = wgpu::DeviceDescriptor {
        label: Some("our device"),
        required_features: adapter.features() & WANTED_FEATURES,
        required_limits: adapter.limits(),
        ..Default::default()
    };
    let (device, queue) = adapter.request_device(&wanted).await?;
    let gpu = Gpu::adopt(
        device,
        queue,
        adapter.get_info(),
        adapter.get_downlevel_capabilities(),
    );
    let mut grid = demo_scenes::by_name("grid", Some(6))?;
    grid.ensure_proxies(&Default::default());
    let scene = GpuScene::new(&gpu, &mut grid)?;
    Ok((gpu, scene))
}

fn texture(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    size: [u32; 2],
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

fn pipeline(
    device: &wgpu::Device,
    [vertex, fragment]: [&str; 2],
    compare: wgpu::CompareFunction,
    depth: f64,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("ours"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let constants = &[("depth", depth)];
    let compilation_options = wgpu::PipelineCompilationOptions {
        constants,
        ..Default::default()
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options,
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(false),
            depth_compare: Some(compare),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(COLOUR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// One pass of the host. The first clears the depth to infinitely far; the sky covers every pixel of the colour.
fn draw(
    encoder: &mut wgpu::CommandEncoder,
    [colour, depth]: [&wgpu::Texture; 2],
    load: wgpu::LoadOp<f32>,
    pipeline: &wgpu::RenderPipeline,
    vertices: u32,
) {
    let [colour, depth] = [colour, depth].map(|texture| texture.create_view(&Default::default()));
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("ours"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &colour,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.draw(0..vertices, 0..1);
}
