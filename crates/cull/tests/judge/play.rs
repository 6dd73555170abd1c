//! A world of boxes that an engine draws with a judge, beside the same engine drawing everything; and hosts' depths and projections.

use antumbra_cull::judge::*;
use antumbra_cull::{Gpu, TestDetail};
use antumbra_scene::Aabb;
use antumbra_testing::engine::{BOX_VERTICES, Drawn, Engine};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DQuat, DVec3, Mat4, Vec3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

/// Boxes that come, move and go, drawn by an engine with a judge and by one without.
pub struct Play {
    pub gpu: Gpu,
    pub instances: Instances,
    pub ids: Vec<Option<InstanceId>>,
    pub places: Vec<Option<DAffine3>>,
    pub judge: Judge,
    pub culled: Engine,
    pub full: Engine,
    pub random: Pcg64Mcg,
    /// A size that the view gets between the two calls of the next frame.
    pub resize_in_between: Option<[u32; 2]>,
}

/// What a frame has shown.
#[derive(Debug, Default, Clone, Copy)]
pub struct Frame {
    pub wrong_pixels: usize,
    pub drawn: u32,
    pub rebuilt: bool,
}

pub fn cube() -> Aabb {
    Aabb::from_centre(DVec3::ZERO, DVec3::ONE)
}

impl Play {
    pub fn new(gpu: &Gpu, size: [u32; 2], depth: HostDepth, phases: Phases, seed: u64) -> Self {
        Self::inspecting(gpu, size, depth, phases, TestDetail::default(), seed)
    }

    pub fn inspecting(
        gpu: &Gpu,
        size: [u32; 2],
        depth: HostDepth,
        phases: Phases,
        detail: TestDetail,
        seed: u64,
    ) -> Self {
        let view = JudgeView::main(size[0], size[1], depth);
        let options = JudgeOptions {
            phases,
            list: true,
            detail,
        };
        Self {
            gpu: gpu.clone(),
            instances: Instances::new(gpu),
            ids: Vec::new(),
            places: Vec::new(),
            judge: Judge::new(gpu, vec![view], options).unwrap(),
            culled: Engine::new(gpu, size, depth),
            full: Engine::new(gpu, size, depth),
            random: Pcg64Mcg::seed_from_u64(seed),
            resize_in_between: None,
        }
    }

    pub fn anywhere(&mut self) -> DAffine3 {
        let mut within = |half: f64| self.random.random_range(-half..half);
        let place = DVec3::new(within(12.0), within(8.0), within(12.0));
        let size = DVec3::new(1.05 + within(1.0), 1.05 + within(1.0), 0.51 + within(0.5));
        let axis = DVec3::new(within(1.0), within(1.0), within(1.0) + 2.0).normalize();
        let angle = within(3.0);
        DAffine3::from_scale_rotation_translation(size, DQuat::from_axis_angle(axis, angle), place)
    }

    pub fn add(&mut self, at: DAffine3, part: Part) {
        let id = self
            .instances
            .insert(InstanceDesc {
                bounds: cube(),
                at,
                part,
            })
            .unwrap();
        let index = id.index() as usize;
        self.places.resize(self.places.len().max(index + 1), None);
        self.ids.resize(self.places.len(), None);
        self.places[index] = Some(at);
        self.ids[index] = Some(id);
    }

    pub fn fill(&mut self, count: usize) {
        for _ in 0..count {
            let at = self.anywhere();
            self.add(at, Part::Both);
        }
    }

    /// Some move, some go, some come.
    pub fn stir(&mut self) {
        for index in 0..self.ids.len() {
            let Some(id) = self.ids[index] else { continue };
            match self.random.random_range(0..20) {
                0 => {
                    self.instances.remove(id).unwrap();
                    (self.ids[index], self.places[index]) = (None, None);
                }
                1..4 => {
                    let at = self.anywhere();
                    self.instances.move_to(id, at).unwrap();
                    self.places[index] = Some(at);
                }
                _ => {}
            }
        }
        let gone = self.ids.iter().filter(|id| id.is_none()).count();
        for _ in 0..gone {
            let at = self.anywhere();
            self.add(at, Part::Both);
        }
    }

    fn draws(&self) -> (JudgeDraws, [wgpu::Buffer; 2]) {
        let template = DrawTemplate {
            elements: BOX_VERTICES,
            first_element: 0,
            base_vertex: 0,
            members: (0..self.places.len() as u32).collect(),
        };
        let draws = JudgeDraws::new(&self.gpu, DrawKind::Vertices, &[template]).unwrap();
        let buffer = |size, usage| {
            self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage: usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let into = [
            buffer(draws.draw_bytes(), wgpu::BufferUsages::INDIRECT),
            buffer(draws.kept_bytes(), wgpu::BufferUsages::VERTEX),
        ];
        (draws, into)
    }

    pub fn frame(&mut self, eye: Eye, phases: Phases) -> Frame {
        for engine in [&mut self.culled, &mut self.full] {
            engine.place(&self.places);
            engine.look(eye.clip_from_relative, eye.position);
        }
        let (draws, [args, kept]) = self.draws();
        let into = DrawBuffers {
            draws: &args,
            kept: &kept,
        };
        let device = &self.gpu.device;
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut drawn = 0;
        self.judge
            .begin(&mut self.instances, &[eye], &mut encoder)
            .unwrap();
        let mut rebuilt = false;
        if let Some(size) = self.resize_in_between.take() {
            self.judge.resize(0, size).unwrap();
            self.culled.resize(size);
            self.full.resize(size);
        }
        let draw = |judge: &mut Judge, encoder: &mut wgpu::CommandEncoder, chosen| {
            judge.write_draws(0, chosen, &draws, into, encoder).unwrap();
            let first = chosen == Chosen::First;
            self.culled
                .draw(encoder, Drawn::Indirect(&args, &kept), first);
        };
        draw(&mut self.judge, &mut encoder, Chosen::First);
        self.gpu.queue.submit([encoder.finish()]);
        drawn += count(&self.gpu, &args);
        let mut encoder = device.create_command_encoder(&Default::default());
        rebuilt |= self
            .judge
            .test(&[self.culled.depth()], &mut encoder)
            .unwrap()
            .rebuilt;
        draw(&mut self.judge, &mut encoder, Chosen::Rest);
        // Everything, in the order that the phases have: which of two equal depths wins is no matter of culling.
        let first = bits(&self.gpu, self.judge.mask(0, Chosen::First).unwrap());
        let all = 0..self.places.len() as u32;
        let (now, later): (Vec<u32>, Vec<u32>) = all.partition(|index| is_set(&first, *index));
        self.full.draw(&mut encoder, Drawn::List(&now), true);
        self.full.draw(&mut encoder, Drawn::List(&later), false);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait().unwrap();
        let rest = count(&self.gpu, &args);
        assert!(
            phases == Phases::Two || rest == 0,
            "{rest} in a second phase"
        );
        let (found, expected) = (self.culled.pixels(), self.full.pixels());
        let pairs = found.chunks(4).zip(expected.chunks(4));
        Frame {
            wrong_pixels: pairs.filter(|(one, other)| one != other).count(),
            drawn: drawn + rest,
            rebuilt,
        }
    }
}

/// A mask's words.
pub fn bits(gpu: &Gpu, mask: &wgpu::Buffer) -> Vec<u32> {
    let bytes = antumbra_cull::read_back::buffer(gpu, mask).unwrap();
    let words = bytes.chunks_exact(4);
    words
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect()
}

pub fn is_set(words: &[u32], index: u32) -> bool {
    words[index as usize / 32] >> (index % 32) & 1 != 0
}

/// The instance count of the first draw.
fn count(gpu: &Gpu, args: &wgpu::Buffer) -> u32 {
    let bytes = antumbra_cull::read_back::buffer(gpu, args).unwrap();
    u32::from_le_bytes(bytes[4..8].try_into().unwrap())
}

/// An eye on an orbit, a step a number.
pub fn orbit(projection: Mat4, number: u32) -> Eye {
    let angle = f64::from(number) * 0.05;
    let eye = DVec3::new(angle.sin() * 16.0, 3.0, angle.cos() * 16.0);
    let view = look_at_mat4(Vec3::ZERO, -eye.as_vec3(), Vec3::Y);
    Eye::new(projection * view, eye)
}

fn depth(format: wgpu::TextureFormat, samples: u32, range: DepthRange) -> HostDepth {
    HostDepth {
        format,
        samples,
        range,
    }
}

/// Depths as hosts have them, with a projection for each.
pub fn hosts() -> Vec<(HostDepth, Mat4)> {
    use wgpu::TextureFormat as Format;
    let reversed = directx::perspective_infinite_reverse(0.9, 1.25, 0.1);
    let forward = directx::perspective(0.9, 1.25, 0.1, 100.0);
    let parallel = directx::orthographic(-14.0, 14.0, -11.0, 11.0, -20.0, 60.0);
    let parallel_reversed = directx::orthographic(-14.0, 14.0, -11.0, 11.0, 60.0, -20.0);
    // A plane through the scene as near plane, in view space (Lengyel, Oblique View Frustum Depth Projection and Clipping, 2005).
    let mut oblique = forward;
    let plane = glam::Vec4::new(0.2, 0.1, -1.0, -12.0);
    let corner = glam::Vec4::new(plane.x.signum(), plane.y.signum(), 1.0, 1.0);
    let corner = forward.inverse() * corner;
    let scaled = plane / plane.dot(corner);
    for (column, value) in scaled.to_array().into_iter().enumerate() {
        oblique.col_mut(column).z = value;
    }
    let mut off_axis = reversed;
    off_axis.z_axis.x = 0.6;
    off_axis.z_axis.y = -0.3;
    vec![
        (
            depth(Format::Depth32Float, 1, DepthRange::Reversed),
            reversed,
        ),
        (
            depth(Format::Depth32Float, 4, DepthRange::Reversed),
            reversed,
        ),
        (depth(Format::Depth32Float, 4, DepthRange::Forward), forward),
        (depth(Format::Depth24Plus, 1, DepthRange::Forward), forward),
        (
            depth(Format::Depth24PlusStencil8, 4, DepthRange::Forward),
            forward,
        ),
        (depth(Format::Depth16Unorm, 1, DepthRange::Forward), forward),
        (
            depth(Format::Depth32Float, 1, DepthRange::Forward),
            parallel,
        ),
        (
            depth(Format::Depth32Float, 1, DepthRange::Reversed),
            parallel_reversed,
        ),
        (depth(Format::Depth32Float, 1, DepthRange::Forward), oblique),
        (
            depth(Format::Depth32Float, 1, DepthRange::Reversed),
            off_axis,
        ),
    ]
}
