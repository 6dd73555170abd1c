//! Frames that do not follow one another as they should: sizes, instances and encoders that change or go between the calls.

use antumbra_cull::judge::*;
use antumbra_cull::read_back;
use antumbra_testing::{gpus, vulkan};
use glam::{DAffine3, DVec3};

use crate::play::{Play, bits, cube, hosts, is_set, orbit};

fn encoder() -> wgpu::CommandEncoder {
    vulkan().device.create_command_encoder(&Default::default())
}

fn play(phases: Phases, count: usize) -> (Play, Eye) {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [160, 120], depth, phases, 11);
    play.fill(count);
    (play, orbit(projection, 0))
}

/// What is drawn in all, after frames of a still world.
fn settled(play: &mut Play, eye: Eye, phases: Phases) -> u32 {
    let frames = [0, 1, 2].map(|_| play.frame(eye, phases));
    assert_eq!(frames[2].wrong_pixels, 0);
    frames[2].drawn
}

#[test]
fn a_size_may_change_between_the_calls_of_a_frame() {
    let (mut play, eye) = play(Phases::Two, 400);
    settled(&mut play, eye, Phases::Two);
    for size in [[320, 240], [64, 48], [161, 121]] {
        play.resize_in_between = Some(size);
        assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0, "{size:?}");
        assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0, "{size:?}");
    }
}

#[test]
fn what_an_encoder_took_with_it_comes_again() {
    let (mut play, eye) = play(Phases::Two, 400);
    settled(&mut play, eye, Phases::Two);
    for index in (0..400).step_by(7) {
        let at = play.anywhere();
        play.instances
            .move_to(play.ids[index].unwrap(), at)
            .unwrap();
        play.places[index] = Some(at);
    }
    let mut lost = encoder();
    play.judge
        .begin(&mut play.instances, &[eye], &mut lost)
        .unwrap();
    drop(lost);
    assert_eq!(play.frame(eye, Phases::Two).wrong_pixels, 0);
}

#[test]
fn instances_may_change_between_the_calls_of_a_frame() {
    let (mut play, eye) = play(Phases::Two, 400);
    settled(&mut play, eye, Phases::Two);
    // Another judge brings the changes onto the device while the frame is under way: an index that was hidden gets an owner in plain sight.
    let (depth, _) = hosts()[0];
    let mut other = Judge::new(
        vulkan(),
        vec![JudgeView::main(160, 120, depth)],
        JudgeOptions::default(),
    )
    .unwrap();
    let mut first = encoder();
    play.judge
        .begin(&mut play.instances, &[eye], &mut first)
        .unwrap();
    let drawn = |play: &Play, chosen| bits(vulkan(), play.judge.mask(0, chosen).unwrap());
    vulkan().queue.submit([first.finish()]);
    let hidden = (0..400)
        .find(|index| !is_set(&drawn(&play, Chosen::First), *index))
        .unwrap();
    play.instances
        .remove(play.ids[hidden as usize].take().unwrap())
        .unwrap();
    let before_all =
        DAffine3::from_translation(eye.position * 0.9) * DAffine3::from_scale(DVec3::splat(0.2));
    play.add(before_all, Part::Both);
    assert_eq!(
        play.ids[hidden as usize].map(InstanceId::index),
        Some(hidden)
    );
    let mut second = encoder();
    other
        .begin(&mut play.instances, &[eye], &mut second)
        .unwrap();
    play.judge
        .test(&[play.culled.depth()], &mut second)
        .unwrap();
    vulkan().queue.submit([second.finish()]);
    assert!(is_set(&drawn(&play, Chosen::Rest), hidden));
}

#[test]
fn a_cut_other_instances_and_a_frame_without_a_test_forget_what_was_hidden() {
    let (mut play, eye) = play(Phases::Late, 600);
    let first = play.frame(eye, Phases::Late).drawn;
    let few = settled(&mut play, eye, Phases::Late);
    assert!(few < first / 2, "{few} of {first}");
    assert_eq!(
        play.frame(Eye { cut: true, ..eye }, Phases::Late).drawn,
        first
    );
    assert_eq!(settled(&mut play, eye, Phases::Late), few);
    // A frame that was drawn and not tested.
    let mut untested = encoder();
    play.judge
        .begin(&mut play.instances, &[eye], &mut untested)
        .unwrap();
    vulkan().queue.submit([untested.finish()]);
    assert_eq!(play.frame(eye, Phases::Late).drawn, first);
    assert_eq!(settled(&mut play, eye, Phases::Late), few);
    // The same places with other owners.
    play.instances = Instances::new(vulkan());
    for at in play.places.clone().into_iter().flatten() {
        let part = Part::Both;
        let bounds = cube();
        play.instances
            .insert(InstanceDesc { bounds, at, part })
            .unwrap();
    }
    assert_eq!(play.frame(eye, Phases::Late).drawn, first);
}

#[test]
fn growth_keeps_what_is_known() {
    let (mut play, eye) = play(Phases::Late, 600);
    let few = settled(&mut play, eye, Phases::Late);
    for _ in 0..2000 {
        // Behind the eye.
        play.add(DAffine3::from_translation(eye.position * 3.0), Part::Both);
    }
    assert_eq!(play.frame(eye, Phases::Late).drawn, few);
}

#[test]
fn draws_have_their_chosen_members_in_order_however_many_there_are() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[0];
        let mut play = Play::new(gpu, [160, 120], depth, Phases::Two, 12);
        play.fill(500);
        let eye = orbit(projection, 0);
        play.frame(eye, Phases::Two);
        play.frame(eye, Phases::Two);
        let mask = bits(gpu, play.judge.mask(0, Chosen::First).unwrap());
        // Draws of no instance, of a few, and one of many among them.
        for largest in [5, 200] {
            let mut all = 0..500;
            let templates: Vec<DrawTemplate> = (0..60)
                .map(|number| DrawTemplate {
                    elements: 36 + number,
                    first_element: number * 7,
                    base_vertex: -3,
                    members: all
                        .by_ref()
                        .take(if number == 30 {
                            largest
                        } else {
                            number as usize % 5
                        })
                        .collect(),
                })
                .collect();
            let draws = JudgeDraws::new(gpu, DrawKind::Indexed, &templates).unwrap();
            let buffer = |size| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: None,
                    size,
                    usage: wgpu::BufferUsages::STORAGE
                        | wgpu::BufferUsages::INDIRECT
                        | wgpu::BufferUsages::COPY_SRC,
                    mapped_at_creation: false,
                })
            };
            let (args, kept) = (buffer(draws.draw_bytes()), buffer(draws.kept_bytes()));
            let into = DrawBuffers {
                draws: &args,
                kept: &kept,
            };
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            play.judge
                .write_draws(0, Chosen::First, &draws, into, &mut encoder)
                .unwrap();
            gpu.queue.submit([encoder.finish()]);
            let words = |buffer: &wgpu::Buffer| -> Vec<u32> {
                let bytes = read_back::buffer(gpu, buffer).unwrap();
                bytes
                    .chunks_exact(4)
                    .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
                    .collect()
            };
            let (args, kept) = (words(&args), words(&kept));
            let mut first = 0;
            for (template, draw) in templates.iter().zip(args.chunks_exact(5)) {
                let members = template.members.iter().copied();
                let chosen: Vec<u32> = members.filter(|index| is_set(&mask, *index)).collect();
                let expected = [
                    template.elements,
                    chosen.len() as u32,
                    template.first_element,
                    -3i32 as u32,
                    first,
                ];
                assert_eq!(draw, expected);
                let from = first as usize;
                assert_eq!(kept[from..from + chosen.len()], chosen);
                first += template.members.len() as u32;
            }
        }
    }
}
