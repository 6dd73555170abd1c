//! Budgets: every strategy's first step is conservative, a budget of zero allows no wrong pixel, and along paths with cuts and moving
//! entities the mean of the wrong pixels stays within the budget.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use antumbra_cull::{
    AuditOptions, Budget, DeclareError, FrameGraph, Setting, SettingError, Stage, StageError,
    StageOptions, Step, Strategy, Tunable, Value, Verdict, ViewInput, ViewNodes, ViewSpec,
    VisibleSet,
};
use antumbra_draw::GpuScene;
use antumbra_scene::Camera;
use antumbra_strategies::registry;
use antumbra_testing::{
    balls_with_proxies, look_at, perspective, stage_with, views, vulkan, wrong_pixels_percent,
};
use antumbra_verify::Oracle;
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 120];

fn camera(frame: u32) -> Camera {
    // A cut every ninety frames, to another place on the path.
    let angle = f64::from(frame) * 0.01 + f64::from(frame / 90) * 2.1;
    let eye = DVec3::new(angle.cos(), 0.2, angle.sin()) * 9.0 * (1.2 + 0.3 * (angle * 3.0).sin());
    look_at(eye, DVec3::ZERO, perspective(0.9, 0.05))
}

/// The result of a flight.
struct Flown {
    /// Wrong pixels in percent, mean of the frames.
    wrong: f64,
    /// Wrong pixels in percent, of the worst frame.
    worst: f64,
    /// The step at the end.
    step: usize,
    /// How often the step changed.
    changes: u32,
}

fn fly(strategy: &str, budget: Budget, frames: u32) -> Flown {
    let gpu = vulkan();
    let mut scene = balls_with_proxies(7);
    let movers: Vec<_> = scene.drawables().map(|(key, _)| key).step_by(9).collect();
    let homes: Vec<DAffine3> = movers
        .iter()
        .map(|key| scene.local(*key).unwrap())
        .collect();
    let mut on_gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let strategy = registry().parse(strategy).unwrap();
    let options = StageOptions {
        budget: Some(budget),
        // The image is small and the scene has few triangles, so the audit gets a larger share.
        audit: Some(AuditOptions {
            share: 0.5,
            seed: 5,
            ..AuditOptions::default()
        }),
        ..StageOptions::default()
    };
    let mut stage = stage_with(&on_gpu, strategy, views(&["main"], SIZE), options);
    let mut oracle = Oracle::new(&on_gpu, SIZE);
    let mut flown = Flown {
        wrong: 0.0,
        worst: 0.0,
        step: 0,
        changes: 0,
    };
    let mut before = stage.budget_state().unwrap().0.step;
    for frame in 0..frames {
        for (key, home) in movers.iter().zip(&homes) {
            let away = DVec3::Y * (f64::from(frame) * 0.05 + home.translation.x).sin() * 0.5;
            let place = DAffine3::from_translation(away) * *home;
            scene.set_local(*key, place).unwrap();
        }
        on_gpu.sync(&mut scene).unwrap();
        let camera = camera(frame);
        let input = ViewInput {
            cut: frame % 90 == 0,
            ..ViewInput::new(camera)
        };
        stage.frame(&on_gpu, &[input]).unwrap();
        gpu.wait().unwrap();
        let verdicts = stage.verdicts(0, &on_gpu).unwrap();
        let wrong = wrong_pixels_percent(&mut oracle, &on_gpu, &camera, &verdicts);
        flown.wrong += wrong / f64::from(frames);
        flown.worst = flown.worst.max(wrong);
        flown.step = stage.budget_state().unwrap().0.step;
        flown.changes += u32::from(flown.step != before);
        before = flown.step;
    }
    flown
}

#[test]
fn the_first_step_of_every_strategy_is_conservative() {
    let registry = registry();
    let mut with_steps = 0;
    for name in registry.names() {
        let latencies: &[&str] = match registry.make(name).unwrap().latency() {
            Some(_) => &["frame-late", "same-frame", "on-gpu"],
            None => &["none"],
        };
        for latency in latencies {
            let mut strategy = registry.make(name).unwrap();
            if *latency != "none" && strategy.set_text("latency", latency).is_err() {
                continue;
            }
            let steps = strategy.steps();
            with_steps += usize::from(steps.len() > 1);
            for step in steps.iter().rev() {
                for (key, value) in &step.settings {
                    strategy.set(key, value).unwrap();
                }
                if let Some(dial) = step.dial {
                    strategy.set(dial, &0.5.into()).unwrap();
                    strategy.set(dial, &0.0.into()).unwrap();
                }
            }
            let exact = steps.is_empty() || strategy.conservative();
            assert!(exact, "{name}, {latency}: {:?}", strategy.settings());
        }
    }
    assert!(with_steps >= 9, "{with_steps}");
}

#[test]
fn a_budget_of_nothing_gets_nothing_wrong() {
    for strategy in ["three-pass", "coherent", "occupancy-map:latency=frame-late"] {
        let flown = fly(strategy, Budget::WrongPixels(0.0), 30);
        assert_eq!((flown.worst, flown.step), (0.0, 0), "{strategy}");
    }
}

#[test]
fn the_mean_stays_under_the_budget_and_most_of_it_is_used() {
    for (strategy, budget) in [("three-pass:latency=on-gpu", 0.5), ("three-pass", 0.5)] {
        let flown = fly(strategy, Budget::WrongPixels(budget), 270);
        println!(
            "{strategy}: {:.3} % of {budget} %, worst {:.2}, step {}, {} changes",
            flown.wrong, flown.worst, flown.step, flown.changes
        );
        assert!(flown.wrong <= budget, "{strategy}: {} %", flown.wrong);
        assert!(flown.wrong > 0.0, "{strategy} traded nothing");
    }
}

#[test]
fn three_pass_has_a_step_between_full_size_and_a_much_smaller_one() {
    let registry = registry();
    for (scale, between) in [("0.25", Some("0.5")), ("0.9", None), ("1", None)] {
        let strategy = registry.parse(&format!("three-pass:latency=on-gpu:scale={scale}"));
        let steps = strategy.unwrap().steps();
        let own = |step: &antumbra_cull::Step| {
            let own = step.settings.iter().rfind(|(key, _)| *key == "scale");
            own.map(|(_, value)| value.to_string())
        };
        let found = steps.get(2).and_then(own);
        assert_eq!(found.as_deref(), between, "{steps:?}");
    }
}

#[test]
fn a_strategy_without_steps_that_errs_cannot_keep_a_budget() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    let options = StageOptions {
        budget: Some(Budget::WrongPixels(0.1)),
        ..StageOptions::default()
    };
    let specs = vec![ViewSpec::main(64, 48)];
    struct Nothing;
    impl antumbra_cull::Strategy for Nothing {
        fn name(&self) -> &str {
            "nothing"
        }
        fn summary(&self) -> &str {
            "draws nothing"
        }
        fn conservative(&self) -> bool {
            false
        }
        fn declare(
            &mut self,
            g: &mut antumbra_cull::FrameGraph<'_>,
            view: &mut antumbra_cull::ViewNodes,
        ) -> Result<antumbra_cull::VisibleSet, antumbra_cull::DeclareError> {
            let inside = g.in_frustum(view);
            Ok(g.visible_by(view, inside, |_, _, _| antumbra_cull::Verdict::Occluded))
        }
    }
    let refused = Stage::new(&scene, Box::new(Nothing), specs.clone(), options.clone());
    let Err(StageError::Declare(error)) = refused else {
        panic!("it was accepted");
    };
    let text = error.to_string();
    assert!(
        text.contains("'nothing'") && text.contains("wrong_pixels=0.1%"),
        "{text}"
    );
    // In a host's frame nothing may wait, so a strategy cannot keep a budget there if its only conservative step waits.
    let embedded = StageOptions {
        mode: antumbra_graph::Mode::Embedded,
        ..options.clone()
    };
    let stage = |name: &str| {
        let strategy = registry().parse(name).unwrap();
        Stage::new(&scene, strategy, specs.clone(), embedded.clone())
    };
    for name in [
        "three-pass",
        "coherent:latency=on-gpu",
        "three-pass:latency=on-gpu",
    ] {
        assert!(stage(name).is_ok(), "{name}");
    }
    let Err(StageError::Declare(error)) = stage("occupancy-map:latency=frame-late") else {
        panic!("it was accepted");
    };
    assert!(
        error.to_string().contains("waits within the frame"),
        "{error}"
    );
    // A conservative strategy without steps keeps any budget.
    let frustum = registry().make("frustum").unwrap();
    assert!(Stage::new(&scene, frustum, specs, options).is_ok());
}

/// Counts how often the strategy is declared, and whether the state of its nodes survives a change of step and back.
#[derive(Default)]
struct Counted {
    declared: Arc<AtomicU32>,
    remembered: Arc<AtomicU32>,
    /// How often `declare` fails from now on.
    failures: Arc<AtomicU32>,
    coarse: bool,
}

/// The state of a node: the number of frames that its plan has run.
#[derive(Default)]
struct Frames(u32);

const COARSE: &[antumbra_cull::Parameter<Counted>] = &[antumbra_cull::Parameter::switch(
    "coarse",
    "nothing but another plan",
    |s| s.coarse,
    |s, on| s.coarse = on,
)];

impl Strategy for Counted {
    fn name(&self) -> &str {
        "counted"
    }
    fn summary(&self) -> &str {
        "counts its plans"
    }
    fn conservative(&self) -> bool {
        true
    }
    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }
    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
    }
    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let less = |left: u32| left.checked_sub(1);
        let (set, read) = (Ordering::Relaxed, Ordering::Relaxed);
        if self.failures.try_update(set, read, less).is_ok() {
            return Err(DeclareError::Settings {
                strategy: "counted".to_owned(),
                conflict: "it was told to fail".to_owned(),
            });
        }
        self.declared.fetch_add(1, Ordering::Relaxed);
        let remembered = Arc::clone(&self.remembered);
        let inside = g.in_frustum(view);
        let frames = g.graph().host::<Frames>("frames");
        let mut node = g.graph().host_node("count frames");
        node.read(inside);
        let frames = node.updates(frames);
        node.run(move |ctx| {
            let mut frames = ctx.get_mut(frames)?;
            frames.0 += 1;
            remembered.store(frames.0, Ordering::Relaxed);
            Ok(())
        });
        g.show(view, "frames", frames);
        Ok(g.visible_by(view, inside, |_, _, _| Verdict::Untested))
    }
}

impl Tunable for Counted {
    fn settings(&self) -> Vec<Setting> {
        antumbra_cull::describe(COARSE, self)
    }
    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        antumbra_cull::assign("counted", COARSE, self, key, value)
    }
    fn steps(&self) -> Vec<Step> {
        [false, true]
            .map(|on| Step::of([("coarse", on.into())]))
            .into()
    }
}

#[test]
fn a_step_that_was_stood_on_before_keeps_its_plan_and_memory() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    let strategy = Counted::default();
    let (declared, remembered) = (strategy.declared.clone(), strategy.remembered.clone());
    let options = StageOptions {
        budget: Some(Budget::FrameTime(10.0)),
        ..StageOptions::default()
    };
    let specs = vec![ViewSpec::main(64, 48)];
    let mut stage = Stage::new(&scene, Box::new(strategy), specs, options).unwrap();
    let mut on_step = [0; 2];
    let mut changes = 0;
    let mut before = None;
    for frame in 0..600 {
        stage
            .frame(&scene, &[ViewInput::new(camera(frame))])
            .unwrap();
        let step = stage.budget_state().unwrap().0.step;
        on_step[step] += 1;
        changes += u32::from(before.is_some_and(|before| before != step));
        before = Some(step);
        // Each plan goes on counting from where it stopped.
        assert_eq!(
            remembered.load(Ordering::Relaxed),
            on_step[step],
            "frame {frame}"
        );
        assert_eq!(stage.shown::<Frames>(0, "frames").unwrap().0, on_step[step]);
        // The coarse step is sometimes too slow, and the other one too fast.
        stage.note_time(if step == 0 { 20.0 } else { 1.0 });
    }
    assert!(changes >= 2, "{changes} changes");
    assert_eq!(
        declared.load(Ordering::Relaxed),
        2,
        "after {changes} changes"
    );
}

#[test]
fn a_plan_that_could_not_be_declared_is_tried_again_and_kept_by_its_own_step() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    let strategy = Counted::default();
    let (declared, remembered) = (strategy.declared.clone(), strategy.remembered.clone());
    let failures = strategy.failures.clone();
    let options = StageOptions {
        budget: Some(Budget::FrameTime(10.0)),
        ..StageOptions::default()
    };
    let specs = vec![ViewSpec::main(64, 48)];
    let mut stage = Stage::new(&scene, Box::new(strategy), specs, options).unwrap();
    failures.store(3, Ordering::Relaxed);
    let mut failed = 0;
    let mut on_step = [0; 2];
    for frame in 0..600 {
        match stage.frame(&scene, &[ViewInput::new(camera(frame))]) {
            Ok(_) => {
                let step = stage.budget_state().unwrap().0.step;
                on_step[step] += 1;
                let remembered = remembered.load(Ordering::Relaxed);
                assert_eq!(remembered, on_step[step], "frame {frame}, step {step}");
            }
            Err(error) => {
                assert!(error.to_string().contains("told to fail"), "{error}");
                failed += 1;
            }
        }
        let step = stage.budget_state().unwrap().0.step;
        stage.note_time(if step == 0 { 20.0 } else { 1.0 });
    }
    assert_eq!(failed, 3);
    assert!(on_step.iter().all(|frames| *frames > 0), "{on_step:?}");
    assert_eq!(declared.load(Ordering::Relaxed), 2);
}
