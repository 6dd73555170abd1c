//! The conformance kit on every strategy of this crate, with every setting that changes its passes, on Vulkan and on GL.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{AdapterChoice, Counting, Gpu};
use antumbra_strategies::registry;
use antumbra_testing::{gl, vulkan};
use antumbra_verify::kit::{Case, Kit, KitFailure, OtherSetups, Setup, ViolationKind};

/// Checks strategies, given as the registry parses them. Reports all failures together.
fn conform(gpu: &Gpu, kit: &Kit, strategies: impl IntoIterator<Item = String>) {
    let registry = registry();
    let failures: Vec<String> = strategies
        .into_iter()
        .filter_map(|text| {
            // Late answers are exact in a still scene, unless proxies make them wrong.
            let exact_when_still = text.contains("occluders=full:occludees=full");
            let kit = Kit {
                exact_when_still,
                ..kit.clone()
            };
            let outcome = kit.check_on(gpu, || registry.parse(&text).unwrap());
            Some(format!("{text}: {}", outcome.err()?))
        })
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// The three-pass strategy of one latency, with all ways of counting and all test geometry that the device supports together.
fn three_passes(gpu: &Gpu, latency: &str) -> Vec<String> {
    let mut all = Vec::new();
    for way in Counting::ALL {
        for occluders in ["full", "proxy"] {
            for occludees in ["full", "proxy", "box"] {
                let apart = occluders != occludees;
                if way.lacking(gpu, 1).is_none() && !(way == Counting::Identity && apart) {
                    all.push(format!(
                        "three-pass:latency={latency}:counting={way}:threshold=0:scale=1:occluders={occluders}:occludees={occludees}"
                    ));
                }
            }
        }
    }
    all
}

/// All cases on a small image. In other setups a part is played, and all of it with KIT=whole in the environment; KIT_CASE="camera cut" plays one case alone, and no other setup.
fn small() -> Kit {
    let kit = Kit {
        size: [96, 72],
        random_scenes: 2,
        other_setups: match std::env::var("KIT").as_deref() {
            Ok("whole") => OtherSetups::Whole,
            _ => OtherSetups::Brief,
        },
        ..Kit::default()
    };
    let Ok(name) = std::env::var("KIT_CASE") else {
        return kit;
    };
    let case = Case::named(&name).unwrap_or_else(|| panic!("no case is named {name:?}"));
    Kit {
        cases: vec![case],
        other_setups: OtherSetups::LeftOut,
        ..kit
    }
}

/// The cases in which settings of one latency differ, at the cost of a few frames.
fn quick(latency: &str) -> Kit {
    let cases = match latency {
        "frame-late" => vec![Case::RandomScenes, Case::Cut, Case::SlotReuse],
        _ => vec![Case::RandomScenes, Case::NearPlane],
    };
    Kit {
        random_scenes: 1,
        cases,
        other_setups: OtherSetups::LeftOut,
        ..small()
    }
}

fn baselines(gpu: &Gpu) {
    conform(gpu, &small(), named(&["none", "frustum", "ideal"]));
}

fn stop_and_wait(gpu: &Gpu) {
    // One query a wait is slow with five thousand entities.
    let fewer = Kit {
        many_entities: 300,
        ..small()
    };
    conform(gpu, &fewer, named(&["stop-and-wait"]));
    conform(gpu, &small(), named(&["stop-and-wait:batch=16"]));
}

fn three_pass_in_every_case(gpu: &Gpu) {
    let notable = [
        "three-pass",
        "three-pass:threshold=0:scale=1:occluders=full:occludees=full",
        "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full",
        "three-pass:threshold=0:guard=0.5",
        "three-pass:latency=same-frame:threshold=8",
        "three-pass:latency=on-gpu:threshold=0:scale=1:occluders=full:occludees=full:counting=queries",
        "three-pass:latency=same-frame:coarser=100",
        "three-pass:latency=on-gpu:coarser=100",
        "three-pass:latency=on-gpu",
    ];
    conform(gpu, &small(), named(&notable));
}

fn three_pass_in_every_setting(gpu: &Gpu) {
    for latency in ["frame-late", "same-frame", "on-gpu"] {
        let all = three_passes(gpu, latency);
        // Every device has at least queries and counting by comparison.
        assert!(all.len() >= 12, "only {all:?} on {}", gpu.title());
        conform(gpu, &quick(latency), all);
    }
}

/// Both coherent strategies in all latencies, with single and shared queries, and with a fraction, which takes more frames to settle.
fn coherent(gpu: &Gpu) {
    for strategy in ["coherent", "stereo-coherent"] {
        let whole = [
            format!("{strategy}:latency=same-frame"),
            format!("{strategy}:latency=same-frame:together=1"),
            format!("{strategy}:latency=frame-late"),
            format!("{strategy}:latency=on-gpu"),
            format!("{strategy}:latency=frame-late:guard=0.5"),
        ];
        conform(gpu, &small(), whole);
        let parts = [
            format!("{strategy}:latency=same-frame:fraction=0.5"),
            format!("{strategy}:latency=frame-late:fraction=0.25:late=2"),
            format!("{strategy}:latency=on-gpu:fraction=0.5"),
        ];
        let patient = Kit {
            settle_frames: 16,
            ..small()
        };
        conform(gpu, &patient, parts);
    }
}

/// Traversals of every kind of tree, with batches and single queries, in the same frame and late; and with memory, which takes more frames to settle.
fn walks(gpu: &Gpu) {
    let whole = [
        "occupancy-map:latency=same-frame",
        "occupancy-map:latency=same-frame:tree=boxes:grain=0:block=1:order=depth:worth=0",
        "occupancy-map:latency=same-frame:tree=groups:worth=0",
        "occupancy-map:latency=frame-late",
        "occupancy-map:latency=frame-late:grain=0:visible-for=0",
        "occupancy-map:latency=frame-late:occluded-for=3:guard=0.5",
    ];
    conform(gpu, &small(), named(&whole));
    let aggressive = [
        "occupancy-map:latency=same-frame:occluded-for=3:slow=1:worth=0",
        "occupancy-map:latency=same-frame:small=2:worth=100",
        "occupancy-map:latency=frame-late:occluded-for=3:visible-for=3",
    ];
    let patient = Kit {
        settle_frames: 16,
        ..small()
    };
    conform(gpu, &patient, named(&aggressive));
    let fewer = Kit {
        many_entities: 300,
        ..small()
    };
    let single = [
        "occupancy-map-single",
        "stop-and-wait:tree=divided",
        "stop-and-wait:tree=boxes",
    ];
    conform(gpu, &fewer, named(&single));
}

/// CHC++ in both latencies, with all of its parts and with none of them, over every kind of tree.
fn chc_plus_plus(gpu: &Gpu) {
    let parts_off = "batch=1:multiqueries=false:tight-depth=0:visible-for=0:randomised=false:free-screen=false:worth=0";
    let all = [
        "chc-plus-plus:latency=same-frame".to_owned(),
        format!("chc-plus-plus:latency=same-frame:tree=boxes:grain=0:{parts_off}"),
        "chc-plus-plus:latency=same-frame:tree=groups:grain=0:worth=0:tight-depth=8:tight-surface=16".to_owned(),
        "chc-plus-plus:latency=frame-late".to_owned(),
        "chc-plus-plus:latency=frame-late:guard=0.5".to_owned(),
        format!("chc-plus-plus:latency=frame-late:grain=0:{parts_off}"),
    ];
    conform(gpu, &small(), all);
}

fn depth_pyramid(gpu: &Gpu) {
    let all = [
        "depth-pyramid",
        "depth-pyramid:history=pyramid",
        "depth-pyramid:shape=box",
        "depth-pyramid:detail=pyramid",
        "depth-pyramid:phases=1",
        "depth-pyramid:phases=1:late=cull",
        "depth-pyramid:phases=1:history=pyramid",
    ];
    conform(gpu, &small(), named(&all));
}

/// Random worlds, one a seed: more of them with PYRAMID_SEEDS=1000 in the environment.
#[test]
fn depth_pyramid_culls_nothing_visible_in_random_worlds() {
    let seeds = std::env::var("PYRAMID_SEEDS").map_or(12, |text| text.parse().unwrap());
    for gpu in [vulkan(), gl()] {
        for seed in 0..seeds {
            let kit = Kit {
                seed,
                // Odd sizes, and now and then several samples a pixel.
                size: [61 + seed as u32 % 50, 47 + seed as u32 % 37],
                cases: vec![Case::RandomScenes],
                random_scenes: 2,
                other_setups: OtherSetups::LeftOut,
                setup: Setup {
                    samples: match seed % 4 == 3 && gpu.reads_drawn_samples() {
                        true => 4,
                        false => 1,
                    },
                    ..Setup::PLAIN
                },
                ..Kit::default()
            };
            conform(gpu, &kit, named(&["depth-pyramid"]));
        }
    }
}

#[test]
fn depth_pyramid_conforms_on_vulkan() {
    depth_pyramid(vulkan());
}

#[test]
fn depth_pyramid_conforms_on_gl() {
    depth_pyramid(gl());
}

#[test]
fn chc_plus_plus_conforms_on_vulkan() {
    chc_plus_plus(vulkan());
}

#[test]
fn chc_plus_plus_conforms_on_gl() {
    chc_plus_plus(gl());
}

#[test]
fn walks_conform_on_vulkan() {
    walks(vulkan());
}

#[test]
fn walks_conform_on_gl() {
    walks(gl());
}

#[test]
fn coherent_strategies_conform_on_vulkan() {
    coherent(vulkan());
}

#[test]
fn coherent_strategies_conform_on_gl() {
    coherent(gl());
}

#[test]
fn baselines_conform_on_vulkan() {
    baselines(vulkan());
}

#[test]
fn baselines_conform_on_gl() {
    baselines(gl());
}

#[test]
fn stop_and_wait_conforms_on_vulkan() {
    stop_and_wait(vulkan());
}

#[test]
fn stop_and_wait_conforms_on_gl() {
    stop_and_wait(gl());
}

#[test]
fn three_pass_conforms_in_every_case_on_vulkan() {
    three_pass_in_every_case(vulkan());
}

#[test]
fn three_pass_conforms_in_every_case_on_gl() {
    three_pass_in_every_case(gl());
}

#[test]
fn three_pass_conforms_in_every_setting_on_vulkan() {
    three_pass_in_every_setting(vulkan());
}

#[test]
fn three_pass_conforms_in_every_setting_on_gl() {
    three_pass_in_every_setting(gl());
}

#[test]
fn claims_are_made_where_they_hold_and_nowhere_else() {
    let conservative = |text: &str| registry().parse(text).unwrap().conservative();
    let exact = "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full";
    for text in ["none", "frustum", "ideal", "stop-and-wait", exact] {
        assert!(conservative(text), "{text}");
    }
    for setting in [
        "latency=frame-late",
        "threshold=1",
        "coarser=1",
        "occluders=proxy",
        "occludees=proxy",
        "occludees=box",
        "scale=0.9",
    ] {
        let text = format!("{exact}:{setting}");
        assert!(!conservative(&text), "{text}");
    }
}

#[test]
fn a_missing_adapter_is_named_with_what_is_there() {
    let kit = Kit::on(AdapterChoice::Named("no such adapter".to_owned()));
    let make = || registry().make("frustum").unwrap();
    let failure = kit.check(make).unwrap_err();
    assert!(matches!(failure, KitFailure::Device { .. }));
    assert!(failure.to_string().contains("no such adapter"), "{failure}");
}

#[test]
fn settings_that_do_not_go_together_fail_every_case_in_words() {
    let text = "three-pass:counting=queries:threshold=3";
    let make = || registry().parse(text).unwrap();
    let kit = quick("frame-late");
    let failure = kit.check_on(vulkan(), make).unwrap_err();
    assert_eq!(failure.cases(), kit.cases);
    let KitFailure::Violations { violations, .. } = &failure else {
        panic!("{failure}");
    };
    assert!(
        matches!(&violations[0].kind, ViolationKind::Failed(text) if text.contains("threshold"))
    );
}
