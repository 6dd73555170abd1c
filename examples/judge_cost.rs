//! What judging costs an engine: the engine of the example `judge` draws a grid of balls by Antumbra's answers, and then the same draws again without asking. The difference is the
//! judging. Also: the time of recording, of moving instances, and the memory.
//!
//! ```text
//! cargo run --release --example judge_cost
//! ```

#[path = "judge/culling.rs"]
#[allow(dead_code, reason = "nothing goes here")]
mod culling;
#[path = "judge/engine.rs"]
#[allow(dead_code, reason = "no image is saved here")]
mod engine;

use std::error::Error;
use std::time::Instant;

use antumbra::cull::judge::{
    Chosen, DepthRange, DrawBuffers, Eye, HostDepth, InstanceDesc, Instances, Judge, JudgeOptions,
    JudgeView, JudgedInstance, Moved, Part,
};
use antumbra::cull::{AdapterChoice, Gpu, TestDetail};
use antumbra::scene::Aabb;
use culling::Culling;
use engine::{Engine, View};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DVec3, Mat4, Vec3};

/// Balls along an edge of the grid.
const SIDE: u32 = 26;
const SIZE: [u32; 2] = [1280, 1024];
const BALL: usize = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    for samples in [1, 4] {
        for tested in [Tested::BoxesByTexels, Tested::Boxes, Tested::Balls] {
            frames(&gpu, samples, tested)?;
        }
    }
    for count in [10_000, 1_000_000] {
        recording(&gpu, count)?;
    }
    Ok(())
}

/// What is tested of the balls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tested {
    /// Their boxes, by a few texels of the pyramid.
    BoxesByTexels,
    /// Their boxes, down to the pixel.
    Boxes,
    /// That they are round, down to the pixel.
    Balls,
}

/// A place of the grid, off its cell's middle by up to a tenth of a metre.
fn place(number: u32) -> DVec3 {
    let cell = DVec3::new(
        f64::from(number % SIDE),
        f64::from(number / SIDE % SIDE),
        f64::from(number / SIDE / SIDE),
    );
    let jitter = DVec3::new(12.9, 78.2, 37.7) * f64::from(number);
    cell - f64::from(SIDE - 1) * 0.5 + jitter.map(f64::sin) * 0.1
}

/// Frames of an orbit with a judge, and without one.
fn frames(gpu: &Gpu, samples: u32, tested: Tested) -> Result<(), Box<dyn Error>> {
    let (device, queue) = (&gpu.device, &gpu.queue);
    let count = SIDE.pow(3);
    let mut engine = Engine::new(device.clone(), queue.clone(), samples, count);
    let detail = match tested {
        Tested::BoxesByTexels => TestDetail::Pyramid,
        Tested::Boxes | Tested::Balls => TestDetail::Pixel,
    };
    let options = JudgeOptions {
        detail,
        ..JudgeOptions::default()
    };
    let mut culling = Culling::new(gpu, &[SIZE], &engine, options)?;
    for number in 0..count {
        let at = DAffine3::from_scale(DVec3::splat(0.45));
        let at = DAffine3::from_translation(place(number)) * at;
        let id = culling.insert(BALL, at)?;
        if tested == Tested::Balls {
            culling.instances.set_roundness(id, 1.0)?;
        }
        engine.place(id.index(), Mat4::from(at.as_affine3a()), number % 4);
    }
    engine.upload();
    let view = engine.view(SIZE);
    let phases = [Written::new(gpu, count), Written::new(gpu, count)];
    let (mut with, mut without, mut recorded) = (Vec::new(), Vec::new(), Vec::new());
    for pose in 0..40 {
        let eye = orbit(&engine, &view, f64::from(pose) * 0.02);
        let started = Instant::now();
        let mut encoder = device.create_command_encoder(&Default::default());
        culling.begin(&[eye], &mut encoder)?;
        let [first, rest] = &phases;
        culling.write(0, Chosen::First, first.buffers(), &mut encoder)?;
        engine.draw(&view, &first.draws, &first.kept, true, &mut encoder);
        culling.judge.test(&[&view.depth], &mut encoder)?;
        culling.write(0, Chosen::Rest, rest.buffers(), &mut encoder)?;
        engine.draw(&view, &rest.draws, &rest.kept, false, &mut encoder);
        recorded.push(started.elapsed().as_secs_f64() * 1e3);
        queue.submit([encoder.finish()]);
        gpu.wait()?;
        with.push(started.elapsed().as_secs_f64() * 1e3);

        let started = Instant::now();
        let mut encoder = device.create_command_encoder(&Default::default());
        engine.draw(&view, &first.draws, &first.kept, true, &mut encoder);
        engine.draw(&view, &rest.draws, &rest.kept, false, &mut encoder);
        queue.submit([encoder.finish()]);
        gpu.wait()?;
        without.push(started.elapsed().as_secs_f64() * 1e3);
    }
    let ratios = with
        .iter()
        .zip(&without)
        .skip(4)
        .map(|(with, without)| 1.0 - without / with);
    let share = median(&mut ratios.collect::<Vec<_>>()) * 100.0;
    let bytes = culling.judge.memory() + culling.instances.memory();
    let bytes = bytes as f64 / f64::from(count);
    println!(
        "{count} balls, {} x {}, {samples} samples, {tested:?}: a culled frame {:.1} ms, judging {share:.1} % of it; {bytes:.1} bytes an instance",
        SIZE[0],
        SIZE[1],
        median(&mut with.split_off(4)),
    );
    Ok(())
}

fn orbit(engine: &Engine, view: &View, angle: f64) -> Eye {
    let eye = DVec3::new(angle.sin(), 0.35, angle.cos()) * f64::from(SIDE) * 1.3;
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let matrix = directx::perspective(0.8, aspect, 0.1, 500.0)
        * look_at_mat4(Vec3::ZERO, -eye.as_vec3(), Vec3::Y)
        * Mat4::from_translation(-eye.as_vec3());
    engine.look(view, matrix);
    Eye::new(matrix, DVec3::ZERO)
}

/// Buffers that draws are written to.
struct Written {
    draws: wgpu::Buffer,
    kept: wgpu::Buffer,
}

impl Written {
    fn new(gpu: &Gpu, objects: u32) -> Self {
        let buffer = |size: u32, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("draws"),
                size: u64::from(size),
                usage: usage | wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        Self {
            draws: buffer(60, wgpu::BufferUsages::INDIRECT),
            kept: buffer(objects * 4, wgpu::BufferUsages::VERTEX),
        }
    }

    fn buffers(&self) -> DrawBuffers<'_> {
        DrawBuffers {
            draws: &self.draws,
            kept: &self.kept,
        }
    }
}

/// The time of recording a frame, and of moving instances, on the host.
fn recording(gpu: &Gpu, count: u32) -> Result<(), Box<dyn Error>> {
    let size = [320, 240];
    let depth = HostDepth {
        format: engine::DEPTH,
        samples: 1,
        range: DepthRange::Forward,
    };
    let view = JudgeView::main(size[0], size[1], depth);
    let mut judge = Judge::new(gpu, vec![view], JudgeOptions::default())?;
    let mut instances = Instances::new(gpu);
    let bounds = Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.45));
    let new = (0..count).map(|number| InstanceDesc {
        bounds,
        at: DAffine3::from_translation(place(number)),
        part: Part::Both,
    });
    let ids = instances.insert_all(&new.collect::<Vec<_>>())?;
    let engine = Engine::new(gpu.device.clone(), gpu.queue.clone(), 1, 1);
    let view = engine.view(size);
    let eye = orbit(&engine, &view, 0.0);
    let mut frame = |instances: &mut Instances| -> Result<f64, Box<dyn Error>> {
        // The first recording wakes the thread, which has waited for the device. The second is what recording takes.
        let mut took = 0.0;
        let mut encoders = Vec::new();
        for _ in 0..2 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let started = Instant::now();
            judge.begin(instances, &[eye], &mut encoder)?;
            judge.test(&[&view.depth], &mut encoder)?;
            took = started.elapsed().as_secs_f64() * 1e3;
            encoders.push(encoder);
        }
        gpu.queue
            .submit(encoders.into_iter().map(wgpu::CommandEncoder::finish));
        gpu.wait()?;
        Ok(took)
    };
    let mut still = Vec::new();
    let mut moving = Vec::new();
    for _ in 0..20 {
        still.push(frame(&mut instances)?);
    }
    // Ten thousand of them, all over.
    let step = ids.len() / 10_000;
    for round in 0..20 {
        let moved: Vec<Moved> = ids
            .iter()
            .step_by(step)
            .map(|id| Moved {
                id: *id,
                at: DAffine3::from_translation(place(id.index() + round)),
            })
            .collect();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let started = Instant::now();
        instances.move_all(&moved)?;
        instances.sync(&mut encoder);
        moving.push(started.elapsed().as_secs_f64() * 1e3);
        gpu.queue.submit([encoder.finish()]);
        frame(&mut instances)?;
    }
    // The same on the GPU alone.
    let records: Vec<JudgedInstance> = (0..count)
        .map(|number| {
            let at = DAffine3::from_translation(place(number));
            JudgedInstance::new(&bounds, &at, Part::Both, 1)
        })
        .collect();
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("instances"),
        size: u64::from(count) * 64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, &bytes(&records));
    let mut theirs = Instances::on_gpu(gpu, buffer, count)?;
    let mut on_gpu = Vec::new();
    for _ in 0..20 {
        on_gpu.push(frame(&mut theirs)?);
    }
    println!(
        "{count} instances: recording {:.3} ms standing still, {:.3} ms on the GPU alone; moving 10,000 {:.3} ms",
        median(&mut still),
        median(&mut on_gpu),
        median(&mut moving),
    );
    Ok(())
}

/// Records as the device reads them.
fn bytes(records: &[JudgedInstance]) -> Vec<u8> {
    let words = records.iter().flat_map(|record| {
        let rows = [record.row_x, record.row_y, record.row_z];
        let numbers = rows.into_iter().flatten().chain(record.centre_low);
        numbers.map(f32::to_bits).chain([record.traits])
    });
    words.flat_map(u32::to_le_bytes).collect()
}

fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or_default()
}
