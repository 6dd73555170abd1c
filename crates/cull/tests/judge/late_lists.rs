//! Hosts with lists of their own: what was hidden as it was found, and eyes that move until answers are used.

use antumbra_cull::judge::*;
use antumbra_cull::{TestDetail, Verdict, Verdicts};
use antumbra_testing::{gpus, vulkan};
use glam::Vec3;

use crate::play::{Play, cube, hosts, orbit};
use crate::{ahead, boxed};

/// The indices that the newest answers call hidden, and the frame that these are about.
pub fn hidden(play: &mut Play) -> Option<(u64, Vec<u32>)> {
    let count = play.places.len() as u32;
    let found = play.judge.hidden(0).unwrap()?;
    let indices = (0..count).filter(|index| found.contains(*index));
    Some((found.frame, indices.collect()))
}

#[test]
fn what_was_hidden_comes_with_its_frame_and_ends_with_a_cut() {
    for gpu in gpus() {
        let (depth, projection) = hosts()[0];
        let mut play = Play::new(gpu, [120, 96], depth, Phases::Late, 11);
        play.fill(300);
        assert!(hidden(&mut play).is_none());
        let eye = orbit(projection, 1);
        let count = 4;
        for _ in 0..count {
            play.frame(eye, Phases::Late);
        }
        let (frame, found) = hidden(&mut play).unwrap();
        assert_eq!(frame, count - 1);
        let mut verdicts = Verdicts::default();
        play.judge
            .verdicts(0, &mut play.instances, &mut verdicts)
            .unwrap();
        let occluded: Vec<u32> = verdicts.of_kind(Verdict::Occluded).collect();
        assert_eq!(found, occluded);
        assert!(occluded.len() > 50, "{}", occluded.len());
        assert!(!play.judge.hidden(0).unwrap().unwrap().contains(u32::MAX));
        play.frame(Eye { cut: true, ..eye }, Phases::Late);
        assert_eq!(hidden(&mut play).unwrap().0, count);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        play.judge
            .begin(
                &mut play.instances,
                &[Eye { cut: true, ..eye }],
                &mut encoder,
            )
            .unwrap();
        assert!(hidden(&mut play).is_none());
    }
}

#[test]
fn what_a_few_texels_hide_is_hidden_down_to_the_pixel_too_and_more() {
    let (depth, projection) = hosts()[0];
    for gpu in gpus() {
        let [coarse, fine] = [TestDetail::Pyramid, TestDetail::Pixel].map(|detail| {
            let mut play = Play::inspecting(gpu, [200, 160], depth, Phases::Late, detail, 13);
            play.fill(900);
            for _ in 0..3 {
                play.frame(orbit(projection, 1), Phases::Late);
            }
            hidden(&mut play).unwrap().1
        });
        assert!(coarse.iter().all(|index| fine.contains(index)));
        let (coarse, fine) = (coarse.len(), fine.len());
        assert!(coarse > 50 && fine > coarse, "{coarse} and {fine}");
    }
}

#[test]
fn the_more_an_image_may_shift_the_less_is_hidden() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 12);
    play.fill(900);
    let mut before: Option<Vec<u32>> = None;
    for shift in [0.0, 1.0, 4.0, 16.0] {
        let eye = Eye {
            shift,
            ..orbit(projection, 1)
        };
        play.frame(eye, Phases::Late);
        let (_, found) = hidden(&mut play).unwrap();
        if let Some(before) = before {
            assert!(found.iter().all(|index| before.contains(index)));
            assert!(found.len() < before.len(), "{shift}: {}", found.len());
        }
        before = Some(found);
    }
}

#[test]
fn a_shift_is_counted_in_pixels_and_what_the_edge_cuts_off_may_come_in() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 0);
    // 10 m away a metre is this many pixels.
    let scale = f64::from(projection.col(0).x) * 100.0 / 10.0;
    // A wall up to 50 pixels right of the middle, and what ends 5 pixels inside of it behind.
    let wall = 50.0 / scale;
    play.add(
        boxed([-10.0 + wall, 0.0, -10.1], [10.0, 12.0, 0.1]),
        Part::Both,
    );
    let end = 45.0 / scale * 11.0 / 10.0;
    play.add(boxed([end - 0.2, 0.0, -11.5], [0.2, 0.2, 0.5]), Part::Both);
    // Behind the wall as well, and in part beyond the image's left edge.
    let edge = -100.0 / scale * 12.0 / 10.0;
    play.add(boxed([edge, 0.0, -12.5], [0.5, 0.2, 0.5]), Part::Both);
    let mut found = |shift, way, pixels| {
        let eye = Eye {
            shift,
            drift: Drift { way, pixels },
            ..ahead(projection)
        };
        play.frame(eye, Phases::Late);
        hidden(&mut play).unwrap().1
    };
    assert_eq!(found(0.0, Vec3::ZERO, 0.0), [1, 2]);
    assert_eq!(found(3.0, Vec3::ZERO, 0.0), [1]);
    assert_eq!(found(7.0, Vec3::ZERO, 0.0), [0u32; 0]);
    // An eye that goes left, or backwards, brings it in; one that goes any other way does not.
    assert_eq!(found(0.0, Vec3::NEG_X, 3.0), [1]);
    assert_eq!(found(0.0, Vec3::Z, 3.0), [1]);
    for way in [Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z] {
        assert_eq!(found(0.0, way, 3.0), [1, 2], "{way}");
    }
}

#[test]
fn an_eye_that_goes_one_way_uncovers_on_one_side() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 0);
    let scale = f64::from(projection.col(0).x) * 100.0 / 10.0;
    // A wall from 50 pixels left of the middle to 50 right of it, and behind it what ends 5 pixels inside of its right edge.
    let wall = 50.0 / scale;
    play.add(boxed([0.0, 0.0, -10.1], [wall, 12.0, 0.1]), Part::Both);
    let end = 45.0 / scale * 11.0 / 10.0;
    play.add(boxed([end - 0.2, 0.0, -11.5], [0.2, 0.2, 0.5]), Part::Both);
    let id = play.ids[1].unwrap();
    // As a box and as a ball.
    for roundness in [2.0, 1.0] {
        play.instances.set_roundness(id, roundness).unwrap();
        let mut is_hidden = |way: Vec3, pixels| {
            let eye = Eye {
                drift: Drift { way, pixels },
                ..ahead(projection)
            };
            play.frame(eye, Phases::Late);
            hidden(&mut play).unwrap().1.contains(&1)
        };
        assert!(is_hidden(Vec3::ZERO, 20.0));
        // To the right the wall goes left; forwards, its edge goes outwards. What is behind follows less.
        assert!(is_hidden(Vec3::X, 3.0) && !is_hidden(Vec3::X, 8.0));
        assert!(is_hidden(Vec3::X * 3e38, 3.0) && !is_hidden(Vec3::X * 3e38, 8.0));
        assert!(!is_hidden(Vec3::X, f32::MAX) && !is_hidden(Vec3::Z, f32::MAX));
        assert!(is_hidden(Vec3::NEG_X, 20.0) && is_hidden(Vec3::Y, 20.0));
        assert!(is_hidden(Vec3::NEG_Z, 20.0) && !is_hidden(Vec3::Z, 8.0));
        assert!(
            is_hidden(Vec3::new(1.0, 4.0, 0.0), 8.0) && !is_hidden(Vec3::new(4.0, 1.0, 0.0), 9.0)
        );
    }
}

#[test]
fn a_larger_box_drifts_as_far_as_its_parts() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 0);
    let scale = f64::from(projection.col(0).x) * 100.0 / 10.0;
    // A wall up to 14 pixels right of the middle. Behind it is what begins 70 pixels left of it, and 5 right, and ends at 10.
    let wall = 14.0 / scale;
    play.add(
        boxed([wall - 10.0, 0.0, -10.1], [10.0, 12.0, 0.1]),
        Part::Both,
    );
    let end = 10.0 / scale * 11.0 / 10.0;
    for begin in [-70.0, 5.0] {
        let begin = begin / scale * 11.0 / 10.0;
        let [middle, half] = [(begin + end) / 2.0, (end - begin) / 2.0];
        play.add(boxed([middle, 0.0, -11.5], [half, 0.2, 0.5]), Part::Both);
    }
    // Backwards, the wall's edge goes inwards.
    for (pixels, expected) in [(2.0, &[1, 2][..]), (8.0, &[])] {
        let drift = Drift {
            way: Vec3::Z,
            pixels,
        };
        let eye = Eye {
            drift,
            ..ahead(projection)
        };
        play.frame(eye, Phases::Late);
        assert_eq!(hidden(&mut play).unwrap().1, expected, "{pixels}");
    }
}

#[test]
fn what_is_round_hides_where_only_the_corners_of_its_box_show() {
    let (depth, projection) = hosts()[0];
    let mut play = Play::new(vulkan(), [200, 160], depth, Phases::Late, 0);
    // All of the image but its upper right quarter is covered.
    play.add(boxed([-20.0, 0.0, -10.1], [20.0, 20.0, 0.1]), Part::Both);
    play.add(boxed([0.0, -20.0, -10.1], [20.0, 20.0, 0.1]), Part::Both);
    // A ball of 2 m comes to 1.41 m on the diagonal, its box to 2.
    let ball = boxed([-1.7, -1.7, -14.0], [2.0, 2.0, 2.0]);
    play.add(ball, Part::Both);
    let id = play.ids[2].unwrap();
    let found = |play: &mut Play| {
        play.frame(ahead(projection), Phases::Late);
        hidden(play).unwrap().1
    };
    assert_eq!(found(&mut play), [0u32; 0]);
    play.instances.set_roundness(id, 1.0).unwrap();
    assert_eq!(found(&mut play), [2]);
    // It stays round wherever it goes and whatever part it has.
    play.instances.set_part(id, Part::Occludee).unwrap();
    play.instances.move_to(id, ball).unwrap();
    assert_eq!(found(&mut play), [2]);
    play.instances.set_roundness(id, 1.8).unwrap();
    assert_eq!(found(&mut play), [0u32; 0]);
    play.instances.set_roundness(id, 1.0).unwrap();
    play.instances.set_bounds(id, cube(), ball).unwrap();
    assert_eq!(found(&mut play), [0u32; 0]);
    play.instances.remove(id).unwrap();
    assert!(play.instances.set_roundness(id, 1.0).is_err());
}
