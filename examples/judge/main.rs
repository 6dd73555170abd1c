//! An engine of its own that culls by Antumbra's answers: its vertex buffers, its materials, four samples a pixel, forward depth, two views, one of them parallel. Its objects move, come
//! and go, and one view is resized. Each frame is compared with the same engine drawing everything.
//!
//! `culling.rs` is all that the engine has to do with Antumbra; `engine.rs` does not know of it.
//!
//! ```text
//! cargo run --release --example judge                    # in two phases: no pixel is ever wrong
//! cargo run --release --example judge -- late            # a frame late: none is wrong where nothing moves
//! cargo run --release --example judge -- two 10000 300   # objects, frames
//! ```

mod culling;
mod engine;

use std::error::Error;
use std::path::Path;

use antumbra::cull::judge::{Chosen, DrawBuffers, Eye, InstanceId, JudgeOptions, Moved, Phases};
use antumbra::cull::{AdapterChoice, Gpu, read_back};
use culling::Culling;
use engine::{Engine, View, bytes};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DQuat, DVec3, Mat4, Vec3};

/// An object of the game: it swings around a place of its own, so that no two ever touch.
#[derive(Clone, Copy)]
struct Object {
    id: InstanceId,
    mesh: usize,
    home: DVec3,
}

/// What a run has shown.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Pixels that differed from drawing everything, of all frames and views.
    pub wrong_pixels: usize,
    /// The same, of the frames in which nothing had moved since the frame before.
    pub wrong_at_rest: usize,
    /// Objects that were drawn in all, and objects that there were.
    pub drawn: [u64; 2],
}

/// `judge [two|late] [OBJECTS] [FRAMES]`
pub fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |at: usize, otherwise: u32| arguments.get(at).map_or(Ok(otherwise), |text| text.parse());
    let phases = match arguments.first().map(String::as_str) {
        Some("late") => Phases::Late,
        _ => Phases::Two,
    };
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    let play = Play {
        phases,
        objects: number(1, 10_000)?,
        frames: number(2, 300)?,
        ..Play::default()
    };
    let outcome = run(&gpu, play, Some("out/judge.png".as_ref()))?;
    let [drawn, of] = outcome.drawn;
    println!(
        "{phases:?}: {:.1} % of the objects drawn, {} wrong pixels, {} of them where nothing moved; image: out/judge.png",
        drawn as f64 / of as f64 * 100.0,
        outcome.wrong_pixels,
        outcome.wrong_at_rest
    );
    Ok(())
}

/// What is played.
#[derive(Debug, Clone, Copy)]
pub struct Play {
    /// In how many phases the engine draws.
    pub phases: Phases,
    /// Samples a pixel.
    pub samples: u32,
    /// Objects in the world.
    pub objects: u32,
    /// Frames of the flight.
    pub frames: u32,
}

impl Default for Play {
    fn default() -> Self {
        Self {
            phases: Phases::Two,
            samples: 4,
            objects: 10_000,
            frames: 300,
        }
    }
}

/// Plays frames. Every third is at rest: nothing moves, comes or goes, and no view is resized.
pub fn run(gpu: &Gpu, play: Play, image: Option<&Path>) -> Result<Outcome, Box<dyn Error>> {
    let Play {
        phases,
        samples,
        objects,
        frames,
    } = play;
    let side = f64::from(objects).cbrt().ceil();
    let half = side * 1.5;
    let (device, queue) = (gpu.device.clone(), gpu.queue.clone());
    let mut engine = Engine::new(device.clone(), queue.clone(), samples, objects + 64);
    let mut sizes = [[480, 360], [320, 320]];
    let mut culling = Culling::new(
        gpu,
        &sizes,
        &engine,
        JudgeOptions {
            phases,
            ..JudgeOptions::default()
        },
    )?;
    let mut views = sizes.map(|size| [engine.view(size), engine.view(size)]);
    let mut world = Vec::new();
    for number in 0..objects {
        let place = f64::from(number);
        let cell = DVec3::new(
            place % side,
            (place / side).floor() % side,
            (place / side / side).floor(),
        );
        let object = (number as usize % 3, (cell - side * 0.5) * 3.0);
        world.push(insert(&mut culling, &mut engine, object, 0)?);
    }
    let draws = Draws::new(&device, engine.meshes.len(), objects + 64);
    let mut outcome = Outcome::default();
    for frame in 0..frames {
        let is_resized = frame == frames / 2;
        let rests = frame % 3 == 2 && !is_resized;
        if is_resized {
            sizes[0] = [600, 340];
            culling.judge.resize(0, sizes[0])?;
            views[0] = [engine.view(sizes[0]), engine.view(sizes[0])];
        }
        if !rests {
            stir(&mut culling, &mut engine, &mut world, frame)?;
        }
        engine.upload();
        let time = f64::from(if rests { frame - 1 } else { frame });
        let eyes = look(&engine, &views, time, half);
        let mut encoder = device.create_command_encoder(&Default::default());
        culling.begin(&eyes, &mut encoder)?;
        for (number, [view, _]) in views.iter().enumerate() {
            culling.write(number, Chosen::First, draws.buffers(), &mut encoder)?;
            engine.draw(view, &draws.args, &draws.kept, true, &mut encoder);
            draws.count(number as u64 * 2, &mut encoder);
        }
        let depths = [&views[0][0].depth, &views[1][0].depth];
        culling.judge.test(&depths, &mut encoder)?;
        if phases == Phases::Two {
            for (number, [view, _]) in views.iter().enumerate() {
                culling.write(number, Chosen::Rest, draws.buffers(), &mut encoder)?;
                engine.draw(view, &draws.args, &draws.kept, false, &mut encoder);
                draws.count(number as u64 * 2 + 1, &mut encoder);
            }
        }
        queue.submit([encoder.finish()]);

        // The same engine, drawing everything.
        let all = draws.everything(&queue, &engine, &world);
        let mut encoder = device.create_command_encoder(&Default::default());
        for [_, view] in &views {
            engine.draw(view, &all.0, &all.1, true, &mut encoder);
        }
        queue.submit([encoder.finish()]);
        for pair in &views {
            let [found, expected] =
                [&pair[0].image, &pair[1].image].map(|image| read_back::texture(gpu, image));
            let (found, expected) = (found?, expected?);
            let wrong = found
                .chunks(4)
                .zip(expected.chunks(4))
                .filter(|(one, other)| one != other)
                .count();
            outcome.wrong_pixels += wrong;
            outcome.wrong_at_rest += if rests { wrong } else { 0 };
        }
        outcome.drawn[0] += draws.counted(gpu)?;
        outcome.drawn[1] += world.len() as u64 * views.len() as u64;
    }
    if let Some(path) = image {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        let View { image, size, .. } = &views[0][0];
        let pixels = read_back::texture(gpu, image)?;
        image::save_buffer(path, &pixels, size[0], size[1], image::ColorType::Rgba8)?;
    }
    Ok(outcome)
}

/// Adds an object to the culling, and puts it into the engine's slot of the same number.
fn insert(
    culling: &mut Culling,
    engine: &mut Engine,
    (mesh, home): (usize, DVec3),
    frame: u32,
) -> Result<Object, Box<dyn Error>> {
    let at = at(home, frame);
    let id = culling.insert(mesh, at)?;
    engine.place(id.index(), Mat4::from(at.as_affine3a()), id.index() % 4);
    Ok(Object { id, mesh, home })
}

/// Where an object is in a frame.
fn at(home: DVec3, frame: u32) -> DAffine3 {
    let phase = home.dot(DVec3::new(0.7, 1.9, 3.1));
    let time = f64::from(frame) * 0.2 + phase;
    let size = 0.75 + 0.1 * phase.sin();
    let swing = DVec3::new(time.sin(), (time * 0.7).cos(), (time * 1.3).sin()) * 0.25;
    DAffine3::from_scale_rotation_translation(
        DVec3::splat(size),
        DQuat::from_rotation_y(time),
        home + swing,
    )
}

/// A fifth of the objects move; a hundredth go, and come again as others.
fn stir(
    culling: &mut Culling,
    engine: &mut Engine,
    world: &mut [Object],
    frame: u32,
) -> Result<(), Box<dyn Error>> {
    let mut moved = Vec::new();
    for (number, object) in (0u32..).zip(world.iter_mut()) {
        if (number * 7 + frame).is_multiple_of(100) {
            culling.remove(object.mesh, object.id)?;
            *object = insert(culling, engine, ((object.mesh + 1) % 3, object.home), frame)?;
        } else if (number + frame).is_multiple_of(5) {
            let at = at(object.home, frame);
            engine.place(
                object.id.index(),
                Mat4::from(at.as_affine3a()),
                object.id.index() % 4,
            );
            moved.push(Moved { id: object.id, at });
        }
    }
    Ok(culling.instances.move_all(&moved)?)
}

/// A flight through the objects, and a map from above whose near plane is behind its eye.
fn look(engine: &Engine, views: &[[View; 2]; 2], time: f64, half: f64) -> [Eye; 2] {
    let angle = time * 0.02;
    let eye = DVec3::new(
        angle.sin() * half * 0.9,
        half * 0.2,
        angle.cos() * half * 0.9,
    );
    let aspect = |view: &View| view.size[0] as f32 / view.size[1] as f32;
    let flight = directx::perspective(1.1, aspect(&views[0][0]), 0.1, 500.0)
        * look_at_mat4(
            Vec3::ZERO,
            Vec3::new(-eye.x as f32, -2.0, -eye.z as f32),
            Vec3::Y,
        );
    let (wide, deep) = (half as f32 * 1.1, half as f32 * 2.0);
    let map = directx::orthographic(-wide, wide, -wide, wide, -deep, deep)
        * look_at_mat4(Vec3::ZERO, Vec3::NEG_Y, Vec3::Z);
    let matrices = [flight * Mat4::from_translation(-eye.as_vec3()), map];
    for (matrix, pair) in matrices.iter().zip(views) {
        for view in pair {
            engine.look(view, *matrix);
        }
    }
    // The engine computes in f32 from the world's origin. With the whole matrix around the origin, the judge allows for the rounding of just that.
    matrices.map(|matrix| Eye::new(matrix, DVec3::ZERO))
}

/// The buffers that draws are written to, and counts of what was drawn.
struct Draws {
    args: wgpu::Buffer,
    kept: wgpu::Buffer,
    all: (wgpu::Buffer, wgpu::Buffer),
    counts: wgpu::Buffer,
    meshes: u64,
}

impl Draws {
    fn new(device: &wgpu::Device, meshes: usize, objects: u32) -> Self {
        use wgpu::BufferUsages as Usages;
        let buffer = |size: u64, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("draws"),
                size,
                usage: usage | Usages::STORAGE | Usages::COPY_SRC | Usages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let meshes = meshes as u64;
        let [args, all_args] = [0, 1].map(|_| buffer(meshes * 20, Usages::INDIRECT));
        let [kept, all_kept] = [0, 1].map(|_| buffer(u64::from(objects) * 4, Usages::VERTEX));
        Self {
            args,
            kept,
            all: (all_args, all_kept),
            counts: buffer(meshes * 20 * 4, Usages::STORAGE),
            meshes,
        }
    }

    fn buffers(&self) -> DrawBuffers<'_> {
        DrawBuffers {
            draws: &self.args,
            kept: &self.kept,
        }
    }

    fn count(&self, number: u64, encoder: &mut wgpu::CommandEncoder) {
        let bytes = self.meshes * 20;
        encoder.copy_buffer_to_buffer(&self.args, 0, &self.counts, number * bytes, bytes);
    }

    /// The instances of all draws of the last frame.
    fn counted(&self, gpu: &Gpu) -> Result<u64, Box<dyn Error>> {
        let bytes = read_back::buffer(gpu, &self.counts)?;
        let counts = bytes.chunks_exact(20);
        let counts = counts.map(|draw| u32::from_le_bytes([draw[4], draw[5], draw[6], draw[7]]));
        Ok(counts.map(u64::from).sum())
    }

    /// Draws of everything.
    fn everything(
        &self,
        queue: &wgpu::Queue,
        engine: &Engine,
        world: &[Object],
    ) -> &(wgpu::Buffer, wgpu::Buffer) {
        let (mut args, mut slots) = (Vec::new(), Vec::new());
        for (number, mesh) in engine.meshes.iter().enumerate() {
            let first = slots.len() as u32;
            slots.extend(
                world
                    .iter()
                    .filter(|object| object.mesh == number)
                    .map(|object| object.id.index()),
            );
            let count = slots.len() as u32 - first;
            args.extend([
                mesh.indices,
                count,
                mesh.first_index,
                mesh.base_vertex as u32,
                first,
            ]);
        }
        queue.write_buffer(
            &self.all.0,
            0,
            &bytes(args.into_iter().map(u32::to_le_bytes)),
        );
        queue.write_buffer(
            &self.all.1,
            0,
            &bytes(slots.into_iter().map(u32::to_le_bytes)),
        );
        &self.all
    }
}
