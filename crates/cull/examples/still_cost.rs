//! What the host spends on a frame in which nothing moves, by the number of entities: the time to record it into an encoder.
//!
//!     cargo run --release -p antumbra-cull --example still_cost -- depth-pyramid frustum
//!
//! Both scenes are cubes in rows behind a wall of cubes, drawn with one mesh. Frames are recorded in turn.

use std::error::Error;
use std::time::Instant;

use antumbra_cull::{AdapterChoice, Gpu, Stage, StageOptions, ViewInput, ViewSpec};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{Camera, Material, Scene};
use antumbra_strategies::registry;
use antumbra_testing::{HostTargets, add, cuboid, drawable, look_at, perspective_degrees, placed};
use glam::DVec3;

const SIZE: [u32; 2] = [320, 240];
const COUNTS: [u32; 2] = [10_000, 1_000_000];
const FRAMES: usize = 40;
const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// Frames until everything lies on the device.
const WARM_UP: usize = 8;

/// Cubes in a row, a column and a file.
fn cubes(count: u32) -> Scene {
    let mut scene = Scene::new();
    let cube = drawable(&mut scene, "cube", cuboid(DVec3::ONE), Material::default());
    let side = f64::from(count).cbrt().round() as u32;
    for number in 0..count {
        let [x, y, z] = [number % side, number / side % side, number / side / side];
        let at = DVec3::new(f64::from(x), f64::from(y), -f64::from(z)) * 1.5;
        add(&mut scene, placed(at, DVec3::ONE), cube);
    }
    scene
}

/// A scene at work.
struct Run {
    scene: GpuScene,
    stage: Stage,
    targets: HostTargets,
    camera: Camera,
    milliseconds: Vec<f64>,
}

impl Run {
    fn new(gpu: &Gpu, strategy: &str, count: u32) -> Result<Self, Box<dyn Error>> {
        let scene = GpuScene::new(gpu, &mut cubes(count))?;
        let options = StageOptions {
            mode: Mode::Embedded,
            colour_format: COLOUR,
            ..StageOptions::default()
        };
        let stage = Stage::new(
            &scene,
            registry().parse(strategy)?,
            vec![ViewSpec::main(SIZE[0], SIZE[1])],
            options,
        )?;
        let eye = DVec3::new(-2.0, 12.0, 8.0);
        Ok(Self {
            targets: HostTargets::new(gpu, SIZE, COLOUR, wgpu::TextureUsages::TEXTURE_BINDING),
            scene,
            stage,
            camera: look_at(
                eye,
                DVec3::new(20.0, 8.0, -20.0),
                perspective_degrees(60.0, 0.1),
            ),
            milliseconds: Vec::new(),
        })
    }

    fn frame(&mut self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        clear(&self.targets, &mut encoder);
        let input = ViewInput {
            targets: Some(self.targets.imported()),
            ..ViewInput::new(self.camera)
        };
        let start = Instant::now();
        self.stage.record(&self.scene, &[input], &mut encoder)?;
        self.milliseconds.push(start.elapsed().as_secs_f64() * 1e3);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait()?;
        Ok(())
    }
}

/// Infinitely far, as a host's frame begins.
fn clear(targets: &HostTargets, encoder: &mut wgpu::CommandEncoder) {
    let depth = targets.depth.create_view(&Default::default());
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
}

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    for strategy in std::env::args().skip(1) {
        let mut runs = Vec::new();
        for count in COUNTS {
            runs.push(Run::new(&gpu, &strategy, count)?);
        }
        for _ in 0..WARM_UP + FRAMES {
            for run in &mut runs {
                run.frame(&gpu)?;
            }
        }
        for (run, count) in runs.iter_mut().zip(COUNTS) {
            let measured = run.milliseconds.split_off(WARM_UP);
            let mut sorted = measured;
            sorted.sort_by(f64::total_cmp);
            let [least, median] = [0, sorted.len() / 2].map(|at| sorted.get(at).copied());
            println!(
                "{strategy}, {count} entities: median {:.3} ms, least {:.3} ms",
                median.unwrap_or(f64::NAN),
                least.unwrap_or(f64::NAN)
            );
        }
    }
    Ok(())
}
