//! Culling for a renderer that is not ours: its images with a judge are those of drawing everything.
#![allow(clippy::unwrap_used, clippy::panic)]

use antumbra_cull::judge::{
    Chosen, DepthRange, DrawBuffers, DrawKind, DrawTemplate, Eye, HostDepth, InstanceDesc,
    InstanceId, Instances, Judge, JudgeDraws, JudgeError, JudgeOptions, JudgeView, JudgedInstance,
    Part, Phases,
};
use antumbra_cull::{Gpu, Verdict, Verdicts};
use antumbra_scene::Aabb;
use antumbra_testing::engine::{BOX_VERTICES, Drawn, Engine};
use antumbra_testing::{gpus, vulkan};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DQuat, DVec3, Mat4, Vec3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

/// Boxes that come, move and go, drawn by an engine with a judge and by one without.
struct Play {
    gpu: Gpu,
    instances: Instances,
    ids: Vec<Option<InstanceId>>,
    places: Vec<Option<DAffine3>>,
    judge: Judge,
    culled: Engine,
    full: Engine,
    random: Pcg64Mcg,
}

/// What a frame has shown.
#[derive(Debug, Default, Clone, Copy)]
struct Frame {
    wrong_pixels: usize,
    drawn: u32,
    rebuilt: bool,
}

fn cube() -> Aabb {
    Aabb::from_centre(DVec3::ZERO, DVec3::ONE)
}

impl Play {
    fn new(gpu: &Gpu, size: [u32; 2], depth: HostDepth, phases: Phases, seed: u64) -> Self {
        let view = JudgeView::main(size[0], size[1], depth);
        let options = JudgeOptions { phases, list: true };
        Self {
            gpu: gpu.clone(),
            instances: Instances::new(gpu),
            ids: Vec::new(),
            places: Vec::new(),
            judge: Judge::new(gpu, vec![view], options).unwrap(),
            culled: Engine::new(gpu, size, depth),
            full: Engine::new(gpu, size, depth),
            random: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    fn anywhere(&mut self) -> DAffine3 {
        let mut within = |half: f64| self.random.random_range(-half..half);
        let place = DVec3::new(within(12.0), within(8.0), within(12.0));
        let size = DVec3::new(1.05 + within(1.0), 1.05 + within(1.0), 0.51 + within(0.5));
        let axis = DVec3::new(within(1.0), within(1.0), within(1.0) + 2.0).normalize();
        let angle = within(3.0);
        DAffine3::from_scale_rotation_translation(size, DQuat::from_axis_angle(axis, angle), place)
    }

    fn add(&mut self, at: DAffine3, part: Part) {
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

    fn fill(&mut self, count: usize) {
        for _ in 0..count {
            let at = self.anywhere();
            self.add(at, Part::Both);
        }
    }

    /// Some move, some go, some come.
    fn stir(&mut self) {
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
        let draws = JudgeDraws::new(&self.gpu, DrawKind::Vertices, &[template]);
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

    fn frame(&mut self, eye: Eye, phases: Phases) -> Frame {
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
fn bits(gpu: &Gpu, mask: &wgpu::Buffer) -> Vec<u32> {
    let bytes = antumbra_cull::read_back::buffer(gpu, mask).unwrap();
    let words = bytes.chunks_exact(4);
    words
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect()
}

fn is_set(words: &[u32], index: u32) -> bool {
    words[index as usize / 32] >> (index % 32) & 1 != 0
}

/// The instance count of the first draw.
fn count(gpu: &Gpu, args: &wgpu::Buffer) -> u32 {
    let bytes = antumbra_cull::read_back::buffer(gpu, args).unwrap();
    u32::from_le_bytes(bytes[4..8].try_into().unwrap())
}

/// An eye on an orbit, a step a number.
fn orbit(projection: Mat4, number: u32) -> Eye {
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
fn hosts() -> Vec<(HostDepth, Mat4)> {
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

#[test]
fn in_two_phases_no_pixel_is_wrong_whatever_the_host_draws_with() {
    for gpu in gpus() {
        for (number, (depth, projection)) in hosts().into_iter().enumerate() {
            if depth.samples > 1 && gpu.info.backend == wgpu::Backend::Gl {
                // wgpu cannot read such a depth there.
                continue;
            }
            let mut play = Play::new(gpu, [200, 160], depth, Phases::Two, number as u64);
            play.fill(600);
            let mut drawn = 0;
            for step in 0..12 {
                if step % 3 == 2 {
                    play.stir();
                }
                if step == 6 {
                    play.judge.resize(0, [237, 151]).unwrap();
                    play.culled.resize([237, 151]);
                    play.full.resize([237, 151]);
                }
                let frame = play.frame(orbit(projection, step * 3), Phases::Two);
                assert_eq!(
                    frame.wrong_pixels, 0,
                    "{depth:?}, number {number}, step {step}"
                );
                // The list outgrows its read-back once, at the start, and follows the size.
                assert_eq!(frame.rebuilt, step == 0 || step == 6);
                drawn = frame.drawn;
            }
            assert!(drawn < 570, "{depth:?}, number {number}: {drawn} drawn");
        }
    }
}

#[test]
fn little_is_drawn_that_is_not_seen() {
    let (depth, projection) = hosts()[0];
    for size in [[200, 160], [800, 640]] {
        let mut play = Play::new(vulkan(), size, depth, Phases::Two, 4);
        play.fill(2000);
        let eye = orbit(projection, 2);
        let frames = [0, 1, 2].map(|_| play.frame(eye, Phases::Two));
        let pixels = play.full.pixels();
        let mut seen: Vec<&[u8]> = pixels.chunks(4).collect();
        seen.sort_unstable();
        seen.dedup();
        // A box's rectangle on the image is larger than the box, and its nearest corner nearer.
        let most = seen.len() as u32 * 2;
        assert!(
            frames[2].drawn <= most,
            "{size:?}: {} drawn, {} seen",
            frames[2].drawn,
            seen.len()
        );
    }
}

#[test]
fn a_frame_late_no_pixel_is_wrong_while_nothing_moves() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[3];
        let mut play = Play::new(gpu, [200, 160], depth, Phases::Late, 7);
        play.fill(600);
        let mut culled = false;
        for step in 0..12 {
            // Each pose is drawn twice.
            let eye = orbit(projection, step / 2 * 4);
            if step == 6 {
                play.stir();
            }
            let frame = play.frame(eye, Phases::Late);
            if step % 2 == 1 {
                assert_eq!(frame.wrong_pixels, 0, "step {step}");
                culled |= frame.drawn < 400;
            }
        }
        assert!(culled);
    }
}

#[test]
fn parts_decide_who_waits_and_who_is_tested() {
    let gpu = vulkan();
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(gpu, [200, 160], depth, Phases::Two, 1);
    let wall = DAffine3::from_scale(DVec3::new(9.0, 9.0, 0.1));
    play.add(wall, Part::Occluder);
    let behind = DAffine3::from_translation(DVec3::new(0.0, 0.0, -5.0));
    for part in [Part::Both, Part::Occludee, Part::Occluder, Part::Exempt] {
        play.add(behind, part);
    }
    let eye = orbit(projection, 0);
    let mask = |play: &Play, chosen| bits(gpu, play.judge.mask(0, chosen).unwrap())[0];
    // New ones that hide are drawn first; what hides nothing waits for the test, and is behind the wall.
    assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0);
    assert_eq!(mask(&play, Chosen::First), 0b01011);
    assert_eq!(mask(&play, Chosen::Rest), 0b10000);
    // Then the hidden one is known.
    assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0);
    assert_eq!(mask(&play, Chosen::First), 0b01001);
    assert_eq!(mask(&play, Chosen::Rest), 0b10000);
}

/// One instance a call, with a depth of the view's own size.
fn judged(gpu: &Gpu, depth: HostDepth) -> (Judge, Instances, Engine) {
    let options = JudgeOptions {
        list: true,
        ..JudgeOptions::default()
    };
    let judge = Judge::new(gpu, vec![JudgeView::main(64, 48, depth)], options).unwrap();
    (
        judge,
        Instances::new(gpu),
        Engine::new(gpu, [64, 48], depth),
    )
}

fn message<T>(result: Result<T, JudgeError>) -> String {
    match result {
        Ok(_) => panic!("it was not refused"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn what_cannot_be_judged_is_refused_and_the_message_says_what_to_do() {
    let gpu = vulkan();
    let (depth, projection) = hosts()[0];
    let (mut judge, mut instances, engine) = judged(gpu, depth);
    let eye = orbit(projection, 0);
    let mut refused = |eye: Eye| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        message(judge.begin(&mut Instances::new(gpu), &[eye], &mut encoder))
    };
    // The eye.
    let flat = Eye::new(
        Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0)) * eye.clip_from_relative,
        eye.position,
    );
    assert!(refused(Eye::new(Mat4::ZERO, eye.position)).contains("singular"));
    assert!(refused(flat).contains("singular"));
    let mut infinite = eye;
    infinite.clip_from_relative.y_axis.z = f32::NAN;
    assert!(refused(infinite).contains("not finite"));
    assert!(refused(Eye::new(projection, DVec3::splat(f64::INFINITY))).contains("finite"));
    // The instances.
    let desc = |at| InstanceDesc {
        bounds: cube(),
        at,
        part: Part::Both,
    };
    let id = instances.insert(desc(DAffine3::IDENTITY)).unwrap();
    let twice = [(id, DAffine3::IDENTITY); 2];
    assert!(message(instances.move_all(&twice)).contains("twice"));
    assert!(message(instances.remove_all(&[id, id])).contains("twice"));
    let huge = DAffine3::from_scale(DVec3::splat(1e39));
    assert!(message(instances.insert(desc(huge))).contains("32-bit"));
    let nowhere = DAffine3::from_translation(DVec3::splat(f64::NAN));
    assert!(message(instances.move_to(id, nowhere)).contains("finite"));
    let empty = InstanceDesc {
        bounds: Aabb::EMPTY,
        ..desc(DAffine3::IDENTITY)
    };
    assert!(message(instances.insert(empty)).contains("empty"));
    instances.remove(id).unwrap();
    assert!(message(instances.move_to(id, DAffine3::IDENTITY)).contains("removed"));
    let again = instances.insert(desc(DAffine3::IDENTITY)).unwrap();
    assert_eq!(again.index(), id.index());
    assert!(message(instances.remove(id)).contains("removed"));
    // The depth.
    let other = |size, format, samples| {
        let depth = HostDepth {
            format,
            samples,
            ..depth
        };
        Engine::new(gpu, size, depth)
    };
    let float = wgpu::TextureFormat::Depth32Float;
    for (engine, why) in [
        (other([65, 48], float, 1), "65 x 48"),
        (
            other([64, 48], wgpu::TextureFormat::Depth16Unorm, 1),
            "Depth16Unorm",
        ),
        (other([64, 48], float, 4), "4 samples"),
    ] {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let found = message(judge.test(&[engine.depth()], &mut encoder));
        assert!(found.contains(why), "{found}");
    }
    let bare = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 64,
            height: 48,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    assert!(message(judge.test(&[&bare], &mut encoder)).contains("TEXTURE_BINDING"));
    // A test without a frame.
    assert!(message(judge.test(&[engine.depth()], &mut encoder)).contains("begin"));
    // Views.
    let views = |size: [u32; 2], depth| {
        let view = JudgeView::main(size[0], size[1], depth);
        message(Judge::new(gpu, vec![view], JudgeOptions::default()))
    };
    assert!(views([0, 4], depth).contains("0 x 4"));
    let colour = HostDepth {
        format: wgpu::TextureFormat::Rgba8Unorm,
        ..depth
    };
    assert!(views([4, 4], colour).contains("depth format"));
    assert!(
        views(
            [4, 4],
            HostDepth {
                samples: 3,
                ..depth
            }
        )
        .contains("1, 2, 4 or 8")
    );
    let many = JudgeView::main(
        4,
        4,
        HostDepth {
            samples: 4,
            ..depth
        },
    );
    let on_gl = Judge::new(antumbra_testing::gl(), vec![many], JudgeOptions::default());
    assert!(message(on_gl).contains("OpenGL"));
    // Buffers.
    let buffer = |size, usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let storage = wgpu::BufferUsages::STORAGE;
    let small = Instances::on_gpu(gpu, buffer(640, storage), 11);
    assert!(message(small).contains("larger"));
    let vertices = Instances::on_gpu(gpu, buffer(640, wgpu::BufferUsages::VERTEX), 10);
    assert!(message(vertices).contains("STORAGE"));
    let mut theirs = Instances::on_gpu(gpu, buffer(640, storage), 10).unwrap();
    assert!(message(theirs.insert(desc(DAffine3::IDENTITY))).contains("on the GPU"));
    let template = DrawTemplate {
        elements: 3,
        first_element: 0,
        base_vertex: 0,
        members: vec![0; 4],
    };
    let draws = JudgeDraws::new(gpu, DrawKind::Indexed, &[template]);
    let (args, kept) = (buffer(16, storage), buffer(16, storage));
    let into = DrawBuffers {
        draws: &args,
        kept: &kept,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let found = message(judge.write_draws(0, Chosen::First, &draws, into, &mut encoder));
    assert!(found.contains("20 are written"), "{found}");
}

#[test]
fn a_list_on_the_host_is_a_frame_late_and_forgets_nobody() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[9];
        let mut play = Play::new(gpu, [120, 96], depth, Phases::Late, 3);
        play.fill(300);
        let mut verdicts = Verdicts::default();
        let eye = orbit(projection, 1);
        for step in 0..4 {
            play.frame(eye, Phases::Late);
            play.judge
                .verdicts(0, &mut play.instances, &mut verdicts)
                .unwrap();
            let [_, occluded, _, _, untested, _] = verdicts.tally();
            // The answers of a frame are read by the next: those of the first by the second.
            assert_eq!(occluded > 0, step > 0, "step {step}");
            assert_eq!(untested > 100, step == 0, "step {step}: {untested}");
        }
        // What the list calls hidden owns no pixel: drawing the rest gives the same image.
        let drawn: Vec<u32> = verdicts.drawn().collect();
        assert!(drawn.len() < 250, "{}", drawn.len());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        play.culled.draw(&mut encoder, Drawn::List(&drawn), true);
        let all: Vec<u32> = (0..play.places.len() as u32).collect();
        play.full.draw(&mut encoder, Drawn::List(&all), true);
        gpu.queue.submit([encoder.finish()]);
        assert!(play.culled.pixels() == play.full.pixels());
        // A new one behind everything is drawn until it has been tested; after a cut all are.
        let hidden = verdicts.of_kind(Verdict::Occluded).next().unwrap();
        let at = play.places[hidden as usize].unwrap();
        play.add(at, Part::Both);
        play.frame(eye, Phases::Late);
        play.judge
            .verdicts(0, &mut play.instances, &mut verdicts)
            .unwrap();
        assert_eq!(verdicts.get(300), Verdict::New);
        let cut = Eye { cut: true, ..eye };
        play.frame(cut, Phases::Late);
        play.judge
            .verdicts(0, &mut play.instances, &mut verdicts)
            .unwrap();
        assert_eq!(verdicts.of_kind(Verdict::Occluded).count(), 0);
    }
}

#[test]
fn instances_on_the_gpu_alone_are_judged_the_same() {
    let gpu = vulkan();
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(gpu, [120, 96], depth, Phases::Two, 4);
    play.fill(200);
    // A few that are gone, a few that move one by one.
    for index in [3, 77, 150] {
        play.instances
            .remove(play.ids[index].take().unwrap())
            .unwrap();
        play.places[index] = None;
    }
    let eye = orbit(projection, 2);
    let frames = [play.frame(eye, Phases::Two), play.frame(eye, Phases::Two)];
    let masks = |play: &Play| {
        [Chosen::First, Chosen::Rest].map(|chosen| bits(gpu, play.judge.mask(0, chosen).unwrap()))
    };
    let expected = masks(&play);
    let records: Vec<JudgedInstance> = play
        .places
        .iter()
        .map(|at| {
            at.map_or(JudgedInstance::default(), |at| {
                JudgedInstance::new(&cube(), &at, Part::Both, 5)
            })
        })
        .collect();
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 64 * records.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue
        .write_buffer(&buffer, 0, bytemuck::cast_slice(&records));
    let mut again = Play::new(gpu, [120, 96], depth, Phases::Two, 4);
    again.places = play.places.clone();
    again.instances = Instances::on_gpu(gpu, buffer, 200).unwrap();
    let same = [again.frame(eye, Phases::Two), again.frame(eye, Phases::Two)];
    assert_eq!(masks(&again), expected);
    assert_eq!(
        same.map(|frame| frame.drawn),
        frames.map(|frame| frame.drawn)
    );
}

#[test]
fn moves_reach_the_device_wherever_they_lie() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[0];
        let eye = orbit(projection, 0);
        let settled = |play: &mut Play| {
            let mut verdicts = Verdicts::default();
            for _ in 0..4 {
                assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0);
            }
            let Play {
                judge, instances, ..
            } = play;
            judge.verdicts(0, instances, &mut verdicts).unwrap();
            verdicts
        };
        let mut play = Play::new(gpu, [120, 96], depth, Phases::Two, 5);
        play.fill(2500);
        play.frame(eye, Phases::Two);
        // In one block, in a few, and in so many that they are scattered on the device.
        for step in [1, 100, 20] {
            for index in (0..2500).step_by(step) {
                let at = play.anywhere();
                play.instances
                    .move_to(play.ids[index].unwrap(), at)
                    .unwrap();
                play.places[index] = Some(at);
            }
            let found = settled(&mut play);
            let mut fresh = Play::new(gpu, [120, 96], depth, Phases::Two, 5);
            for at in play.places.iter().flatten() {
                fresh.add(*at, Part::Both);
            }
            assert_eq!(found.tally(), settled(&mut fresh).tally(), "each {step}th");
            assert!(found.agree(&settled(&mut fresh)), "each {step}th");
        }
    }
}

/// A view of anything: perspective or parallel, forward or reversed, telescope or fish eye, with a near plane anywhere.
fn any_view(random: &mut Pcg64Mcg, metre: f32, aspect: f32) -> (DepthRange, Mat4) {
    let near = metre * 10f32.powf(random.random_range(-3.0..0.5));
    let far = near + metre * 10f32.powf(random.random_range(0.5..4.0));
    let angle = 10f32.powf(random.random_range(-1.5..0.4));
    let half = metre * 10f32.powf(random.random_range(-0.5..1.5));
    let [wide, behind] = [half * aspect, -half * random.random_range(0.0..2.0)];
    let (range, mut projection) = match random.random_range(0..5) {
        0 => (
            DepthRange::Reversed,
            directx::perspective_infinite_reverse(angle, aspect, near),
        ),
        1 => (
            DepthRange::Reversed,
            directx::perspective(angle, aspect, far, near),
        ),
        2 => (
            DepthRange::Forward,
            directx::perspective(angle, aspect, near, far),
        ),
        3 => (
            DepthRange::Forward,
            directx::orthographic(-wide, wide, -half, half, behind, far),
        ),
        _ => (
            DepthRange::Reversed,
            directx::orthographic(-wide, wide, -half, half, far, behind),
        ),
    };
    if random.random_range(0..3) == 0 {
        projection.z_axis.x += random.random_range(-1.5..1.5);
        projection.z_axis.y += random.random_range(-1.5..1.5);
    }
    (range, projection)
}

/// Trials of the random kind: more of them with the variable `JUDGE_TRIALS`.
#[test]
fn no_view_of_no_world_shows_a_wrong_pixel() {
    let trials = std::env::var("JUDGE_TRIALS").ok();
    let trials: u64 = trials.map_or(24, |number| number.parse().unwrap());
    let formats = [
        wgpu::TextureFormat::Depth32Float,
        wgpu::TextureFormat::Depth24Plus,
        wgpu::TextureFormat::Depth16Unorm,
    ];
    for seed in 0..trials {
        let gpu = gpus()[(seed % 2) as usize];
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let size = [random.random_range(1..260), random.random_range(1..200)];
        let metre = 10f32.powf(random.random_range(-2.0..3.0));
        let (range, projection) = any_view(&mut random, metre, size[0] as f32 / size[1] as f32);
        let many = gpu.info.backend != wgpu::Backend::Gl && seed % 3 == 0;
        let depth = HostDepth {
            format: formats[random.random_range(0..3)],
            samples: if many { 4 } else { 1 },
            range,
        };
        let mut play = Play::new(gpu, size, depth, Phases::Two, seed);
        // A world of boxes from a speck to a wall, flat ones among them, with the eye among them or outside.
        let scale = f64::from(metre) * 0.1;
        let spread = random.random_range(0.5..4.0);
        for _ in 0..300 {
            let at = play.anywhere();
            let shape =
                DVec3::from_array([0, 1, 2].map(|_| 10f64.powf(random.random_range(-2.5..0.7))));
            let flat =
                DVec3::from_array([0, 1, 2].map(|_| f64::from(random.random_range(0..12).min(1))));
            let at = DAffine3::from_translation(at.translation * spread)
                * DAffine3::from_mat3(at.matrix3)
                * DAffine3::from_scale(shape * flat);
            play.add(DAffine3::from_scale(DVec3::splat(scale)) * at, Part::Both);
        }
        let reach = scale * 30.0 * random.random_range(0.0..1.0);
        for step in 0..3 {
            let angle = f64::from(step) * random.random_range(0.0..0.4) + seed as f64;
            let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * reach;
            let towards = DVec3::new(-angle.sin(), -0.1, -angle.cos());
            let view = look_at_mat4(Vec3::ZERO, towards.as_vec3(), Vec3::Y);
            let frame = play.frame(Eye::new(projection * view, eye), Phases::Two);
            assert_eq!(
                frame.wrong_pixels, 0,
                "seed {seed}, step {step}: {depth:?}, {size:?}, {projection}"
            );
        }
    }
}
