//! Settings: which are refused, with which message; values read back as they were set.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{
    DeclareError, RegistryError, SettingError, Stage, StageError, StageOptions, Strategy,
    ViewInput, ViewSpec,
};
use antumbra_draw::GpuScene;
use antumbra_scene::Camera;
use antumbra_strategies::{TestGeometry, ThreePass, registry};
use antumbra_testing::{balls, look_at, perspective, vulkan};
use glam::DVec3;

/// Declares a strategy on a small scene.
fn declared(text: &str, specs: Vec<ViewSpec>) -> Result<(Stage, GpuScene), StageError> {
    declared_strategy(registry().parse(text).unwrap(), specs)
}

fn declared_strategy(
    strategy: Box<dyn Strategy>,
    specs: Vec<ViewSpec>,
) -> Result<(Stage, GpuScene), StageError> {
    let scene = GpuScene::new(vulkan(), &mut balls(3)).unwrap();
    let stage = Stage::new(&scene, strategy, specs, StageOptions::default())?;
    Ok((stage, scene))
}

fn conflict(text: &str) -> String {
    match declared(text, vec![ViewSpec::main(32, 32)]) {
        Err(StageError::Declare(DeclareError::Settings { strategy, conflict })) => {
            assert_eq!(strategy, "three-pass");
            conflict
        }
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn an_unknown_strategy_lists_the_known_ones() {
    let error = registry().parse("two-pass").err().unwrap();
    let RegistryError::Unknown { name, known } = &error else {
        panic!("{error}");
    };
    assert_eq!(name, "two-pass");
    assert_eq!(*known, registry().names().collect::<Vec<_>>());
}

#[test]
fn an_unknown_setting_lists_the_known_ones() {
    for (text, known) in [
        ("three-pass:treshold=3", "threshold"),
        ("stop-and-wait:batches=3", "batch"),
        ("frustum:anything=3", "none"),
    ] {
        let error = registry().parse(text).err().unwrap();
        assert!(
            matches!(error, RegistryError::Setting(SettingError::Unknown { .. })),
            "{error}"
        );
        assert!(error.to_string().contains(known), "{error}");
    }
}

#[test]
fn a_value_out_of_range_says_the_range() {
    for (text, range) in [
        ("three-pass:threshold=-1", "0 to 1000000"),
        ("three-pass:threshold=1000001", "0 to 1000000"),
        ("three-pass:scale=0", "0.05 to 1"),
        ("three-pass:scale=NaN", "0.05 to 1"),
        (
            "three-pass:latency=soon",
            "frame-late, same-frame or on-gpu",
        ),
        ("three-pass:counting=fingers", "identity"),
        ("three-pass:occluders=box", "proxy or full"),
        ("three-pass:occludees=sphere", "proxy, full or box"),
        ("stop-and-wait:batch=0", "1 to 4096"),
        ("stop-and-wait:batch=4097", "1 to 4096"),
    ] {
        let error = registry().parse(text).err().unwrap();
        assert!(
            matches!(error, RegistryError::Setting(SettingError::Value { .. })),
            "{text}: {error}"
        );
        assert!(error.to_string().contains(range), "{error}");
    }
}

#[test]
fn a_setting_without_a_value_is_refused() {
    let error = registry().parse("three-pass:threshold").err();
    let text = "threshold".to_owned();
    assert_eq!(error, Some(RegistryError::Form { text }));
}

#[test]
fn what_a_strategy_says_of_itself_sets_it_again() {
    let registry = registry();
    let changed = "three-pass:latency=on-gpu:counting=compare:threshold=7:coarser=90:occluders=full:scale=0.25";
    for text in registry.names().chain([changed, "stop-and-wait:batch=9"]) {
        let strategy = registry.parse(text).unwrap();
        let mut again = registry.make(strategy.name()).unwrap();
        for setting in strategy.settings() {
            again.set(setting.key, &setting.value).unwrap();
        }
        assert_eq!(again.settings(), strategy.settings(), "{text}");
    }
}

#[test]
fn queries_do_not_count() {
    let words = conflict("three-pass:counting=queries:threshold=2");
    assert!(
        words.contains("set threshold, coarser and allow to 0")
            && words.contains("counting to auto"),
        "{words}"
    );
}

#[test]
fn an_id_buffer_counts_what_it_draws() {
    for apart in [
        "occluders=full:occludees=proxy",
        "occluders=proxy:occludees=box",
    ] {
        let words = conflict(&format!("three-pass:counting=identity:{apart}"));
        assert!(
            words.contains("set occludees to what occluders is"),
            "{words}"
        );
    }
}

#[test]
fn what_goes_together_is_declared() {
    for text in [
        "three-pass:counting=queries:threshold=0",
        "three-pass:counting=auto:threshold=2:occludees=box",
        "three-pass:counting=identity:threshold=2",
    ] {
        declared(text, vec![ViewSpec::main(32, 32)]).unwrap();
    }
}

#[test]
fn the_ideal_must_be_told() {
    let (mut stage, scene) = declared("ideal", vec![ViewSpec::main(32, 32)]).unwrap();
    let eye = DVec3::new(0.0, 0.0, 5.0);
    let camera = look_at(eye, DVec3::ZERO, perspective(1.0, 0.1));
    let error = stage.frame(&scene, &[ViewInput::new(camera)]).unwrap_err();
    assert!(
        error.to_string().contains("no reference for view 'main'"),
        "{error}"
    );
    let blind = Camera {
        position: DVec3::NAN,
        ..camera
    };
    let error = stage.frame(&scene, &[ViewInput::new(blind)]).unwrap_err();
    assert!(matches!(error, StageError::Camera { .. }), "{error}");
    let error = stage.frame(&scene, &[]).unwrap_err();
    assert!(matches!(error, StageError::Input(_)), "{error}");
}

#[test]
fn views_without_pixels_are_refused() {
    for specs in [
        vec![],
        vec![ViewSpec::main(0, 32)],
        vec![ViewSpec::main(32, 1 << 20)],
    ] {
        let error = declared("frustum", specs).unwrap_err();
        assert!(matches!(error, StageError::Input(_)), "{error}");
    }
}

#[test]
fn what_is_out_of_range_in_code_is_refused_in_words() {
    let boxes = ThreePass {
        occluders: TestGeometry::Box,
        ..ThreePass::default()
    };
    let tiny = ThreePass {
        scale: 0.0,
        ..ThreePass::default()
    };
    for (strategy, words) in [(boxes, "set occluders"), (tiny, "0.05 to 1")] {
        let error = declared_strategy(Box::new(strategy), vec![ViewSpec::main(32, 32)]);
        let error = error.unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn a_budget_never_leaves_counting_to_queries_that_cannot_count() {
    let mut strategy = registry()
        .parse("three-pass:counting=queries:threshold=0:latency=on-gpu")
        .unwrap();
    for step in strategy.steps() {
        for (key, value) in &step.settings {
            strategy.set(key, value).unwrap();
        }
        if let Some(dial) = step.dial {
            strategy.set(dial, &0.5.into()).unwrap();
        }
        let settings = strategy.settings();
        let text: Vec<_> = settings
            .iter()
            .map(|setting| format!("{}={}", setting.key, setting.value))
            .collect();
        let text = format!("three-pass:{}", text.join(":"));
        declared(&text, vec![ViewSpec::main(32, 32)]).unwrap();
    }
}

#[test]
fn the_default_threshold_is_the_same_part_of_every_image_and_a_number_stays_that_number() {
    let default = ThreePass::default();
    for (size, pixels) in [
        ([1280, 1024], 10),
        ([640, 480], 2),
        ([320, 240], 1),
        ([16, 16], 1),
        ([3840, 2160], 63),
    ] {
        assert_eq!(default.threshold_for(size), pixels, "{size:?}");
        let fixed = registry().parse("three-pass:threshold=10").unwrap();
        assert!(fixed.following(size).is_empty());
        assert_eq!(
            registry().parse("three-pass").unwrap().following(size),
            [("threshold", pixels.into())]
        );
    }
    let fixed = ThreePass {
        threshold: Some(10),
        ..default
    };
    assert_eq!(fixed.threshold_for([320, 240]), 10);
    let again = registry().parse("three-pass:threshold=7:threshold=auto");
    assert_eq!(again.unwrap().following([640, 480]).len(), 1);
}
