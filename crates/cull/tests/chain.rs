//! One strategy before another: an entity that the outer one culls is neither drawn nor tested by any inner one. When it returns, the
//! inner one treats it as if it entered the frustum.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use antumbra_cull::{
    Chain, DeclareError, FrameGraph, Latency, RegistryError, SceneTable, Setting, SettingError,
    Stage, StageError, StageOptions, Strategy, Tunable, Value, Verdict, ViewFrame, ViewInput,
    ViewNodes, ViewSpec, VisibleSet,
};
use antumbra_draw::GpuScene;
use antumbra_scene::Camera;
use antumbra_strategies::registry;
use antumbra_testing::{balls, look_at, perspective, stage_with, views, vulkan};
use antumbra_verify::kit::{Case, Kit};
use glam::DVec3;

/// Which entities an outer strategy culls.
#[derive(Clone)]
enum Takes {
    /// Every third entity.
    Third,
    /// All entities, while this is on.
    All(Arc<AtomicBool>),
    /// None, after another outer strategy has culled every third.
    None,
}

struct Outer {
    takes: Takes,
    inner: Chain,
}

impl Outer {
    fn before(text: &str, takes: Takes) -> Self {
        let inner = Chain::among(Arc::new(registry()));
        let mut outer = Self { takes, inner };
        for (at, part) in text.split(':').enumerate() {
            let (key, value) = match at {
                0 => ("then", part),
                _ => part.split_once('=').unwrap(),
            };
            outer.set_text(key, value).unwrap();
        }
        outer
    }
}

/// Whether no test may judge a slot.
fn is_exempt(table: &SceneTable, frame: &ViewFrame, slot: u32) -> bool {
    let near = |slot| {
        let bounds = table.bounds(slot);
        frame.camera.crosses_near(&bounds, frame.aspect())
    };
    !table.is_tested(slot) || near(slot)
}

impl Strategy for Outer {
    fn name(&self) -> &str {
        "outer"
    }

    fn summary(&self) -> &str {
        "culls some entities"
    }

    fn conservative(&self) -> bool {
        false
    }

    /// `None`, so that the kit does not check which answers cover an entity: it culls visible ones.
    fn latency(&self) -> Option<Latency> {
        None
    }

    fn needs_reference(&self) -> bool {
        self.inner.ask(|inner| inner.needs_reference())
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
        let candidates = g.in_frustum(view);
        let takes = self.takes.clone();
        let left = g.narrowed(view, "left", candidates, move |table, frame, slots| {
            slots.retain(|slot| match &takes {
                _ if is_exempt(table, frame, *slot) => true,
                Takes::Third => slot % 3 != 0,
                Takes::All(on) => !on.load(Ordering::Relaxed),
                Takes::None => true,
            });
        });
        match self.takes {
            Takes::None => {
                let name = self.inner.ask(|inner| inner.name().to_owned());
                let mut between = Self::before(&name, Takes::Third);
                g.chain(view, left, &mut between)
            }
            _ => g.chain(view, left, self.inner.next_mut()),
        }
    }
}

impl Tunable for Outer {
    fn settings(&self) -> Vec<Setting> {
        self.inner.settings()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        self.inner.set("outer", key, value)
    }
}

/// Every registered strategy, in every latency it has.
fn all() -> Vec<String> {
    let registry = registry();
    let mut all = Vec::new();
    for name in registry.names() {
        // So that no entity is below the threshold in the small image.
        let text = match name {
            "three-pass" => "three-pass:threshold=0:scale=1",
            _ => name,
        };
        all.push(text.to_owned());
        let latencies = ["same-frame", "on-gpu"].map(|latency| format!("{text}:latency={latency}"));
        let has = |text: &String| registry.parse(text).is_ok();
        all.extend(latencies.into_iter().filter(has));
    }
    all.push("stop-and-wait:tree=divided".to_owned());
    assert!(all.len() > 14, "{all:?}");
    all
}

#[test]
fn whoever_is_taken_away_is_not_drawn_by_any_strategy() {
    let kit = Kit {
        size: [64, 48],
        random_scenes: 1,
        cases: vec![
            Case::RandomScenes,
            Case::NearPlane,
            Case::SlotReuse,
            Case::Stereo,
        ],
        ..Kit::default()
    };
    for text in all() {
        kit.check_on(vulkan(), || Box::new(Outer::before(&text, Takes::Third)))
            .unwrap_or_else(|failure| panic!("{text}: {failure}"));
    }
}

/// A small scene, and its frames under an outer strategy.
struct Play {
    scene: GpuScene,
    stage: Stage,
    camera: Camera,
}

impl Play {
    fn new(outer: Outer) -> Self {
        let scene = GpuScene::new(vulkan(), &mut balls(3)).unwrap();
        let eye = DVec3::new(12.0, 9.0, 40.0);
        let camera = look_at(eye, DVec3::ZERO, perspective(0.9, 0.1));
        let views = views(&["main"], [64, 48]);
        let stage = stage_with(&scene, Box::new(outer), views, StageOptions::default());
        Self {
            scene,
            stage,
            camera,
        }
    }

    /// Runs a frame. Returns the verdict of each slot, and how many entities were tested.
    fn frame(&mut self) -> (Vec<Verdict>, u32) {
        let owners = Arc::new(self.scene.table().live_slots().collect());
        let input = ViewInput {
            reference: Some(owners),
            ..ViewInput::new(self.camera)
        };
        self.stage.frame(&self.scene, &[input]).unwrap();
        self.scene.gpu().wait().unwrap();
        let verdicts = self.stage.verdicts(0, &self.scene).unwrap();
        let slots = 0..self.scene.table().slots();
        let all = slots.map(|slot| verdicts.get(slot)).collect();
        (all, verdicts.tested())
    }
}

#[test]
fn nobody_is_asked_about_who_was_taken_away_and_all_are_drawn_who_come_back() {
    for text in all() {
        let on = Arc::new(AtomicBool::new(false));
        let mut play = Play::new(Outer::before(&text, Takes::All(on.clone())));
        let mut all = Vec::new();
        for _ in 0..6 {
            all = play.frame().0;
        }
        let drawn = |verdicts: &[Verdict]| verdicts.iter().filter(|v| v.draws()).count();
        assert!(drawn(&all) > 8, "{text}: {all:?}");
        on.store(true, Ordering::Relaxed);
        for frame in 0..6 {
            let (verdicts, asked) = play.frame();
            assert!(verdicts.iter().all(|v| *v == Verdict::Occluded), "{text}");
            // Late answers carry the number of entities that were tested in their own frame.
            assert!(asked == 0 || frame < 3, "{text}: {asked}");
        }
        on.store(false, Ordering::Relaxed);
        let (back, _) = play.frame();
        assert!(drawn(&back) >= drawn(&all), "{text}: {back:?}");
    }
}

#[test]
fn of_three_in_a_row_the_innermost_judges_what_both_left() {
    for text in ["frustum", "occupancy-map", "none", "coherent"] {
        let mut play = Play::new(Outer::before(text, Takes::None));
        let (verdicts, _) = play.frame();
        for (slot, verdict) in verdicts.into_iter().enumerate() {
            assert_eq!(verdict == Verdict::Occluded, slot % 3 == 0, "{text}");
        }
    }
}

#[test]
fn what_is_wrong_is_said_of_the_strategy_it_is_wrong_of() {
    let mut registry = registry();
    registry.register(|| Box::new(Outer::before("frustum", Takes::None)));
    let refused = |text: &str| match registry.parse(text) {
        Err(error @ RegistryError::Setting(_)) => error.to_string(),
        _ => panic!("{text}"),
    };
    for (text, said) in [
        ("outer:then=outer", "'outer' is no strategy"),
        ("outer:then=magic", "occupancy-map"),
        (
            "outer:threshold=3",
            "'outer:then=frustum' has no setting 'threshold' (it has: then)",
        ),
        (
            "outer:then=three-pass:grain=3",
            "'three-pass' has no setting 'grain'",
        ),
        (
            "outer:then=three-pass:threshold=red",
            "'threshold': it takes",
        ),
    ] {
        let error = refused(text);
        assert!(error.contains(said), "{error}");
    }
    let set = registry.parse("outer:then=three-pass:threshold=7").unwrap();
    let settings = set.settings();
    let find = |key: &str| {
        settings
            .iter()
            .find(|s| s.key == key)
            .unwrap()
            .value
            .to_string()
    };
    assert_eq!([find("then"), find("threshold")], ["three-pass", "7"]);
    // A copy has the settings of the original.
    let inner = Outer::before("three-pass:threshold=7", Takes::None).inner;
    assert_eq!(inner.clone().settings(), inner.settings());
}

#[test]
fn an_inner_strategy_that_cannot_be_declared_says_so_itself() {
    let scene = GpuScene::new(vulkan(), &mut balls(26)).unwrap();
    let outer = Outer::before("three-pass:counting=queries:threshold=3", Takes::Third);
    let views = vec![ViewSpec::main(32, 32)];
    match Stage::new(&scene, Box::new(outer), views, StageOptions::default()) {
        Err(StageError::Declare(DeclareError::Settings { strategy, .. })) => {
            assert_eq!(strategy, "three-pass");
        }
        other => panic!("{other:?}"),
    }
}
