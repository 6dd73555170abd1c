//! Tests of the kit itself: strategies with one deliberate fault each, which the kit must find in the case made for that fault.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "kit_bites/faulty.rs"]
mod faulty;

use antumbra_cull::{StageOutput, Strategy, Tunable};
use antumbra_graph::Mode;
use antumbra_strategies::ThreePass;
use antumbra_testing::{balls_with_proxies, gl, look_at, perspective, vulkan};
use antumbra_verify::kit::{
    Case, Kit, KitFailure, OtherSetups, Setup, Shading, Violation, ViolationKind,
};
use faulty::*;
use glam::DVec3;

fn kit(cases: &[Case]) -> Kit {
    Kit {
        cases: cases.to_vec(),
        random_scenes: 1,
        other_setups: OtherSetups::LeftOut,
        ..Kit::default()
    }
}

/// The violations that the kit finds, one a case at most.
fn found<S: Strategy + Clone + 'static>(strategy: S, cases: &[Case]) -> Vec<Violation> {
    let make = || -> Box<dyn Strategy> { Box::new(strategy.clone()) };
    match kit(cases).check_on(vulkan(), make) {
        Ok(_) => Vec::new(),
        Err(KitFailure::Violations { violations, .. }) => violations,
        Err(failure) => panic!("{failure}"),
    }
}

/// Asserts that each of the cases finds a violation of this kind.
fn bites<S: Strategy + Clone + 'static>(
    strategy: S,
    cases: &[Case],
    expected: fn(&ViolationKind) -> bool,
) {
    let violations = found(strategy, cases);
    let caught: Vec<Case> = violations.iter().map(|v| v.case).collect();
    assert_eq!(caught, cases, "{violations:?}");
    for violation in violations {
        assert!(expected(&violation.kind), "{violation}");
    }
}

#[test]
fn a_late_strategy_without_fault_passes() {
    let kit = Kit {
        exact_when_still: true,
        ..Kit::default()
    };
    let report = kit
        .check_on(vulkan(), || Box::new(Late::default()))
        .unwrap_or_else(|failure| panic!("{failure}"));
    assert_eq!(
        report.cases.len(),
        Case::ALL.len() + Setup::OTHERS.len() * Case::BRIEF.len()
    );
    assert!(
        report.cases.iter().all(|played| played.frames >= 2),
        "{report:?}"
    );
}

#[test]
fn culling_at_random_is_a_false_cull() {
    bites(Random, &[Case::RandomScenes, Case::Many], is_false_cull);
}

fn is_false_cull(kind: &ViolationKind) -> bool {
    matches!(kind, ViolationKind::FalseCull { pixels, .. } if *pixels > 0)
}

#[test]
fn what_is_true_of_metres_is_found_wrong_in_a_tiny_world() {
    bites(Small::Metres, &[Case::Worlds], is_false_cull);
    assert_eq!(found(Small::Metres, &[Case::Lenses]).len(), 0);
}

#[test]
fn what_is_true_of_the_eye_is_found_wrong_through_a_telescope() {
    bites(Small::Radians, &[Case::Lenses], is_false_cull);
    assert_eq!(found(Small::Radians, &[Case::Worlds]).len(), 0);
}

#[test]
fn looking_at_every_fourth_pixel_misses_a_hole() {
    let mut exact = ThreePass::default();
    for (key, value) in [
        ("latency", "same-frame"),
        ("threshold", "0"),
        ("occluders", "full"),
        ("occludees", "full"),
        ("scale", "1"),
    ] {
        exact.set_text(key, value).unwrap();
    }
    assert_eq!(found(Coarse(exact.clone()), &[Case::Gaps]).len(), 0);
    exact.set_text("scale", "0.25").unwrap();
    bites(Coarse(exact), &[Case::Gaps], is_false_cull);
}

#[test]
fn a_scene_of_ones_own_is_played_and_judged() {
    let scene = balls_with_proxies(3);
    let camera = |x: f64| {
        let eye = DVec3::new(x, 2.0, 9.0);
        look_at(eye, DVec3::ZERO, perspective(1.0, 0.1))
    };
    let frames = [
        vec![camera(0.0), camera(0.1)],
        vec![camera(1.0), camera(1.1)],
    ];
    let play = |strategy: Box<dyn Fn() -> Box<dyn Strategy>>| {
        kit(&[]).check_scene(vulkan(), strategy, &scene, &frames)
    };
    let verdicts = play(Box::new(|| Box::new(Late::default()))).unwrap();
    assert_eq!(verdicts.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    let failure = play(Box::new(|| Box::new(Random))).unwrap_err();
    assert_eq!(failure.cases(), [Case::Custom]);
    // The case fails if it is played without a scene.
    let alone = found(Late::default(), &[Case::Custom]);
    assert!(alone[0].to_string().contains("check_scene"), "{}", alone[0]);
}

#[test]
fn trusting_answers_across_a_cut_is_found() {
    let late = Late {
        trusts_across_cuts: true,
        ..Late::default()
    };
    bites(late, &[Case::Cut], |kind| {
        matches!(kind, ViolationKind::CulledWithoutAnswer { .. })
    });
    // The other cases find nothing wrong with it.
    assert_eq!(found(late, &[Case::SlotReuse, Case::NearPlane]).len(), 0);
}

#[test]
fn answers_about_a_former_occupant_are_found() {
    let late = Late {
        trusts_across_births: true,
        ..Late::default()
    };
    bites(late, &[Case::SlotReuse], |kind| {
        matches!(kind, ViolationKind::CulledWithoutAnswer { .. })
    });
    assert_eq!(found(late, &[Case::Cut, Case::NearPlane]).len(), 0);
}

#[test]
fn boxes_tested_across_the_near_plane_are_found() {
    let boxes = BoxTest { knows_near: false };
    bites(boxes, &[Case::InsideBox, Case::NearPlane], |kind| {
        matches!(kind, ViolationKind::NearPlane { .. })
    });
    let boxes = BoxTest { knows_near: true };
    assert_eq!(found(boxes, &[Case::InsideBox, Case::NearPlane]).len(), 0);
}

/// The violations that the kit finds in all setups.
fn found_in_setups<S: Strategy + Clone + 'static>(strategy: S, case: Case) -> Vec<Violation> {
    let kit = Kit {
        other_setups: OtherSetups::Whole,
        ..kit(&[case])
    };
    let make = || -> Box<dyn Strategy> { Box::new(strategy.clone()) };
    match kit.check_on(vulkan(), make) {
        Ok(_) => Vec::new(),
        Err(KitFailure::Violations { violations, .. }) => violations,
        Err(failure) => panic!("{failure}"),
    }
}

#[test]
fn what_is_true_of_pixels_is_found_wrong_of_samples() {
    let violations = found_in_setups(AsManySamples, Case::Gaps);
    let caught: Vec<Setup> = violations.iter().map(|found| found.setup).collect();
    // It waits, so that it is not played in a host's frame.
    let sampled = Setup {
        samples: 4,
        shading: Shading::Host,
        ..Setup::PLAIN
    };
    assert_eq!(caught, [sampled]);
    assert!(is_false_cull(&violations[0].kind), "{}", violations[0]);
    assert!(violations[0].to_string().contains("4 samples a pixel"));
}

#[test]
fn answers_that_are_not_what_the_verdicts_say_are_found() {
    let violations = found_in_setups(Liar, Case::RandomScenes);
    assert_eq!(violations.len(), 1 + Setup::OTHERS.len());
    for Violation { setup, kind, .. } in &violations {
        let answers = setup.output == StageOutput::Answers;
        assert!(
            match kind {
                ViolationKind::FalseAnswers { slots } => answers && !slots.is_empty(),
                ViolationKind::FalseVerdicts { pixels, .. } => !answers && *pixels > 0,
                _ => false,
            },
            "{setup}: {kind}"
        );
    }
}

#[test]
fn what_cannot_be_played_is_said() {
    let kit = Kit {
        other_setups: OtherSetups::Brief,
        ..kit(&[Case::RandomScenes])
    };
    let check = |gpu, strategy: &str| {
        let make = || antumbra_strategies::registry().parse(strategy).unwrap();
        kit.check_on(gpu, make)
            .unwrap_or_else(|failure| panic!("{failure}"))
    };
    // One that waits cannot be recorded into a host's frame; one that needs no wait is played everywhere.
    let waits = check(vulkan(), "coherent:latency=same-frame");
    assert_eq!(waits.left_out.len(), 2, "{:?}", waits.left_out);
    for left in &waits.left_out {
        assert_eq!(left.setup.mode, Mode::Embedded);
        assert!(left.why.contains("sync point"), "{}", left.why);
    }
    let never = check(vulkan(), "coherent:latency=on-gpu");
    assert_eq!(
        (never.cases.len(), never.left_out.len()),
        (1 + Setup::OTHERS.len(), 0)
    );
    // OpenGL cannot read the samples that it has drawn.
    let lacks = check(gl(), "coherent:latency=on-gpu");
    assert_eq!(lacks.left_out.len(), 2, "{:?}", lacks.left_out);
    for left in &lacks.left_out {
        assert_eq!(left.setup.samples, 4);
        assert!(left.why.contains("read the samples"), "{}", left.why);
    }
}

#[test]
fn verdicts_that_are_not_what_was_drawn_are_found() {
    bites(Liar, &[Case::RandomScenes], |kind| {
        matches!(kind, ViolationKind::FalseVerdicts { .. })
    });
}

#[test]
fn verdicts_that_differ_each_time_are_found() {
    bites(Moody::default(), &[Case::Repeat], |kind| {
        matches!(kind, ViolationKind::NotRepeatable)
    });
    bites(Moody::default(), &[Case::Still], |kind| {
        matches!(kind, ViolationKind::Unsettled { .. })
    });
}

#[test]
fn late_answers_that_never_come_right_are_found() {
    let kit = Kit {
        exact_when_still: true,
        ..kit(&[Case::Still])
    };
    let failure = kit
        .check_on(vulkan(), || {
            Box::new(Late {
                threshold: 40,
                ..Late::default()
            })
        })
        .unwrap_err();
    let KitFailure::Violations { violations, .. } = &failure else {
        panic!("{failure}");
    };
    assert!(matches!(
        violations[0].kind,
        ViolationKind::StillFalseCull { .. }
    ));
}

#[test]
fn a_panic_is_told_with_its_case_and_the_rest_goes_on() {
    bites(
        Panics,
        &[Case::Empty, Case::Behind],
        |kind| matches!(kind, ViolationKind::Panicked(message) if message == "on purpose"),
    );
}

#[test]
fn a_failure_says_how_to_have_it_again() {
    let make = || -> Box<dyn Strategy> { Box::new(Random) };
    let kit = Kit {
        seed: 77,
        ..kit(&[Case::RandomScenes])
    };
    let gpu = vulkan();
    let text = kit.check_on(gpu, make).unwrap_err().to_string();
    let adapter = gpu.title();
    let parts = [
        "'random'",
        &adapter,
        "seed 77",
        "128 x 96",
        "random scenes, frame 0",
    ];
    for part in parts {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}

#[test]
fn a_failure_can_be_played_again_and_looked_at() {
    let kit = Kit {
        random_scenes: 1,
        other_setups: OtherSetups::LeftOut,
        ..Kit::default()
    };
    for case in Case::ALL {
        assert_eq!(Case::named(case.name()), Some(case));
    }
    let case = Case::named("random scenes").unwrap();
    let replay = kit.replay(vulkan(), || Box::new(Random), case);
    let violation = replay.violation.unwrap();
    let ViolationKind::FalseCull { pixels, .. } = violation.kind else {
        panic!("{violation}");
    };
    let last = replay.frames.last().unwrap();
    assert_eq!((last.frame, last.size), (violation.frame, kit.size));
    let image = last.rgba();
    let red = image.chunks(4).filter(|pixel| *pixel == [255, 0, 0, 255]);
    assert_eq!(red.count(), pixels);
    // The same seed shows the same again, and a strategy that conforms has no red pixel.
    let again = kit.replay(vulkan(), || Box::new(Random), case);
    assert_eq!(again.frames.last().unwrap().rgba(), image);
    let exact = kit.replay(
        vulkan(),
        || Box::new(antumbra_cull::FrustumOnly),
        Case::Resize,
    );
    assert!(exact.violation.is_none(), "{:?}", exact.violation);
    let sizes: Vec<[u32; 2]> = exact.frames.iter().map(|frame| frame.size).collect();
    assert_eq!(sizes.len(), 10);
    assert!(sizes.contains(&[96, 128]), "{sizes:?}");
    for frame in &exact.frames {
        let red = |image: &[u8]| image.chunks(4).any(|pixel| pixel == [255, 0, 0, 255]);
        assert!(!red(&frame.rgba()));
    }
}
