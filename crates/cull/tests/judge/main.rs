//! Culling for a renderer that is not ours: its images with a judge are those of drawing everything.
#![allow(clippy::unwrap_used, clippy::panic)]

mod drift;
mod late_lists;
mod play;
mod refused;
mod sequence;
mod trials;
mod two_views;

use antumbra_cull::judge::*;
use antumbra_cull::{AdapterChoice, Gpu, Verdict, Verdicts};
use antumbra_scene::Aabb;
use antumbra_testing::engine::Drawn;
use antumbra_testing::{gpus, is_swiftshader, vulkan};
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DVec3, Mat4, Vec3};
use play::{Play, bits, cube, hosts, orbit};

#[test]
fn in_two_phases_no_pixel_is_wrong_whatever_the_host_draws_with() {
    for gpu in gpus() {
        for (number, (depth, projection)) in hosts().into_iter().enumerate() {
            if depth.samples > 1 && gpu.info.backend == wgpu::Backend::Gl {
                // wgpu cannot read such a depth there.
                continue;
            }
            if depth.samples > 1 && is_swiftshader(gpu) {
                // It draws hidden boxes through those before them, judged or not.
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
                assert_eq!(frame.rebuilt, step == 6);
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

#[test]
fn a_list_on_the_host_is_a_frame_late_and_forgets_nobody() {
    for name in ["vulkan", "gl"] {
        // A device of its own: on a shared one, another test's wait may still be delivering this one's answers when they are looked for.
        let gpu = &Gpu::open(&AdapterChoice::Named(name.to_owned())).unwrap();
        let (depth, projection) = hosts()[9];
        let mut play = Play::new(gpu, [120, 96], depth, Phases::Late, 3);
        play.fill(300);
        let mut verdicts = Verdicts::default();
        let eye = orbit(projection, 1);
        let found = |play: &mut Play, verdicts: &mut Verdicts| {
            let Play {
                judge, instances, ..
            } = play;
            judge.verdicts(0, instances, verdicts).unwrap()
        };
        for step in 0..3 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            play.judge
                .begin(&mut play.instances, &[eye], &mut encoder)
                .unwrap();
            // The answers of a frame are there for the next.
            let of = found(&mut play, &mut verdicts);
            assert_eq!(of, u64::checked_sub(step * 2, 1), "step {step}");
            let [_, occluded, _, _, untested, _] = verdicts.tally();
            assert_eq!(
                (occluded > 0, untested > 100),
                (step > 0, step == 0),
                "step {step}"
            );
            drop(encoder);
            play.frame(eye, Phases::Late);
        }
        assert_eq!(found(&mut play, &mut verdicts), Some(5));
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
        found(&mut play, &mut verdicts);
        assert_eq!(verdicts.get(300), Verdict::New);
        play.frame(eye, Phases::Late);
        found(&mut play, &mut verdicts);
        assert_eq!(verdicts.get(300), Verdict::Occluded);
        let cut = Eye { cut: true, ..eye };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        play.judge
            .begin(&mut play.instances, &[cut], &mut encoder)
            .unwrap();
        found(&mut play, &mut verdicts);
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

/// An eye in the origin that looks along -Z.
fn ahead(projection: Mat4) -> Eye {
    Eye::new(projection, DVec3::ZERO)
}

fn boxed(centre: [f64; 3], half: [f64; 3]) -> DAffine3 {
    let at = DAffine3::from_translation(DVec3::from_array(centre));
    at * DAffine3::from_scale(DVec3::from_array(half))
}

#[test]
fn a_beam_beside_the_eye_is_drawn_although_both_its_ends_are_hidden() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Two, 0);
    play.add(boxed([0.0, 0.0, -5.0], [9.0, 9.0, 0.1]), Part::Both);
    play.add(boxed([0.6, -0.1, -9.0], [0.1, 0.1, 11.0]), Part::Both);
    for _ in 0..3 {
        let frame = play.frame(ahead(projection), Phases::Two);
        assert_eq!((frame.wrong_pixels, frame.drawn), (0, 2));
    }
}

#[test]
fn depths_that_one_step_of_the_format_makes_equal_are_visible() {
    let (depth, projection) = hosts()[5];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Two, 0);
    play.add(boxed([0.0, 0.0, -50.0], [40.0, 40.0, 0.0]), Part::Both);
    for number in 0..30 {
        let x = f64::from(number) - 15.0;
        play.add(
            boxed([x, 0.0, -50.02 - 0.02 * f64::from(number)], [0.4, 2.0, 0.0]),
            Part::Occludee,
        );
    }
    let mut equal = 0;
    for _ in 0..2 {
        let frame = play.frame(ahead(projection), Phases::Two);
        assert_eq!(frame.wrong_pixels, 0);
        equal = frame.drawn;
    }
    assert!((2..31).contains(&equal), "{equal} drawn");
}

#[test]
fn who_gets_the_index_of_one_that_was_hidden_is_seen_at_once() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 0);
    play.add(boxed([0.0, 0.0, -5.0], [9.0, 9.0, 0.1]), Part::Both);
    play.add(boxed([0.0, 0.0, -8.0], [1.0, 1.0, 1.0]), Part::Both);
    for step in 0..3 {
        let frame = play.frame(ahead(projection), Phases::Late);
        assert_eq!(
            (frame.wrong_pixels, frame.drawn),
            (0, if step == 0 { 2 } else { 1 })
        );
    }
    let hidden = play.ids[1].take().unwrap();
    play.instances.remove(hidden).unwrap();
    play.add(boxed([0.0, 0.0, -3.0], [0.5, 0.5, 0.5]), Part::Both);
    assert_eq!(play.ids[1].map(|id| id.index()), Some(hidden.index()));
    let frame = play.frame(ahead(projection), Phases::Late);
    assert_eq!((frame.wrong_pixels, frame.drawn), (0, 2));
}

#[test]
fn bounds_and_parts_may_change_and_what_is_known_stays() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Two, 0);
    play.add(boxed([0.0, 0.0, -5.0], [1.0, 9.0, 0.1]), Part::Both);
    let behind = DAffine3::from_translation(DVec3::new(0.0, 0.0, -8.0));
    play.add(behind * DAffine3::from_scale(DVec3::splat(0.5)), Part::Both);
    let chosen = |play: &mut Play| {
        let frame = play.frame(ahead(projection), Phases::Two);
        assert_eq!(frame.wrong_pixels, 0);
        [Chosen::First, Chosen::Rest]
            .map(|chosen| bits(vulkan(), play.judge.mask(0, chosen).unwrap())[0])
    };
    chosen(&mut play);
    assert_eq!(chosen(&mut play), [0b01, 0]);
    // It grows out of the wall's shadow: no new instance, so it waits for the test, which finds it.
    let wide = DVec3::new(4.0, 0.5, 0.5);
    let id = play.ids[1].unwrap();
    play.instances
        .set_bounds(id, Aabb::from_centre(DVec3::ZERO, wide), behind)
        .unwrap();
    play.places[1] = Some(behind * DAffine3::from_scale(wide));
    assert_eq!(chosen(&mut play), [0b01, 0b10]);
    // What hides nothing is never drawn first; what is not tested is always drawn.
    play.instances.set_part(id, Part::Occludee).unwrap();
    assert_eq!(chosen(&mut play), [0b01, 0b10]);
    assert_eq!(chosen(&mut play), [0b01, 0b10]);
    play.instances
        .set_bounds(
            id,
            Aabb::from_centre(DVec3::ZERO, DVec3::splat(0.5)),
            behind,
        )
        .unwrap();
    play.places[1] = Some(behind * DAffine3::from_scale(DVec3::splat(0.5)));
    assert_eq!(chosen(&mut play), [0b01, 0]);
    play.instances.set_part(id, Part::Occluder).unwrap();
    assert_eq!(chosen(&mut play), [0b11, 0]);
    let nowhere = play.instances.set_bounds(id, Aabb::EMPTY, behind);
    assert!(nowhere.unwrap_err().to_string().contains("empty"));
}

#[test]
fn what_rounding_lets_a_host_draw_at_its_far_plane_is_drawn() {
    let depth = hosts()[6].0;
    let far = 1000.0;
    let projection = directx::perspective(0.9, 1.25, 0.1, far as f32);
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Two, 0);
    // Faces from just before the far plane to a metre behind it, side by side and turned to different angles of the eye.
    for number in 0..400 {
        let [x, y] = [f64::from(number % 20), f64::from(number / 20)];
        let z = -far - 0.0025 * f64::from(number) + 0.05;
        play.add(
            boxed([x * 40.0 - 400.0, y * 40.0 - 400.0, z], [15.0, 15.0, 0.0]),
            Part::Both,
        );
    }
    let mut drawn = 0;
    for step in 0..6 {
        let view = look_at_mat4(
            Vec3::ZERO,
            Vec3::new(0.02 * step as f32, 0.01, -1.0),
            Vec3::Y,
        );
        let frame = play.frame(ahead(projection * view), Phases::Two);
        assert_eq!(frame.wrong_pixels, 0, "step {step}");
        drawn += frame.drawn;
    }
    assert!(drawn < 6 * 400, "{drawn}");
}
