//! A plan contains only what its scene requires: no pass, resource or kind of pipeline for a feature that the scene does not use, and all for one
//! that it does.
//!
//! `crates/cull/tests/plans.rs` tests the passes of the second eye and of transparency; this file tests their buffers and pipelines.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../examples/what_it_costs.rs"]
#[allow(dead_code, reason = "it measures; here only its scenes are used")]
mod what_it_costs;

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

use antumbra::cull::{
    DrawSource, Pass, PipelineClass, Renderer, ShadeTargets, Stage, StageOptions, StageScene,
    Strategy, TestRenderer, ViewInput, WithRenderer,
};
use antumbra::draw::{BuiltinRenderer, GpuScene, PipelineKind};
use antumbra::graph::PlanFormat;
use antumbra::scene::Scene;
use antumbra::strategies::registry;
use antumbra_testing::{look_at, perspective, stage_with, views, vulkan};
use glam::DVec3;
use what_it_costs::Part;

/// The strategies whose plans are tested.
const STRATEGIES: [&str; 7] = [
    "none",
    "frustum",
    "stop-and-wait",
    "three-pass:latency=same-frame",
    "three-pass:latency=on-gpu",
    "coherent:latency=same-frame",
    "occupancy-map:latency=same-frame",
];

/// Twenty-seven opaque balls under parallel light.
fn plain() -> Scene {
    what_it_costs::plain(3).unwrap()
}

/// The same scene with a part added.
fn with(part: Part) -> Scene {
    let mut scene = plain();
    part.add_to(&mut scene).unwrap();
    scene
}

/// The names of the passes that run and of the resources that are used.
struct Plan {
    passes: BTreeSet<String>,
    resources: BTreeSet<String>,
}

impl Plan {
    fn has(&self, word: &str) -> bool {
        let mut names = self.passes.iter().chain(&self.resources);
        names.any(|name| name.contains(word))
    }
}

fn stage(scene: &dyn StageScene, strategy: Box<dyn Strategy>, names: &[&str]) -> Stage {
    let views = views(names, [64, 48]);
    stage_with(scene, strategy, views, StageOptions::default())
}

fn plan(scene: &mut Scene, text: &str, views: &[&str]) -> Plan {
    let scene = GpuScene::new(vulkan(), scene).unwrap();
    let stage = stage(&scene, registry().parse(text).unwrap(), views);
    let picture = stage.plan().export(PlanFormat::Json);
    let picture: serde_json::Value = serde_json::from_str(&picture).unwrap();
    let names = |of: &str, is: &dyn Fn(&serde_json::Value) -> bool| {
        let all = picture[of].as_array().unwrap().iter();
        all.filter(|one| is(one))
            .map(|one| one["name"].as_str().unwrap().to_owned())
            .collect::<BTreeSet<_>>()
    };
    Plan {
        passes: names("passes", &|pass| pass["pruned"] == false),
        resources: names("resources", &|resource| resource["used"] == true),
    }
}

/// The kinds of pipelines that a renderer has made.
type Kinds = Arc<Mutex<Vec<PipelineKind>>>;

/// A scene whose renderer records the kinds of its pipelines.
fn watched(scene: &mut Scene, kinds: &Kinds) -> WithRenderer<GpuScene> {
    let kinds = Arc::clone(kinds);
    WithRenderer::new(GpuScene::new(vulkan(), scene).unwrap(), move |scene| {
        Box::new(Watching {
            inner: BuiltinRenderer::new(scene.gpu()),
            kinds: Arc::clone(&kinds),
        })
    })
}

/// The built-in renderer, watched.
struct Watching {
    inner: BuiltinRenderer,
    kinds: Kinds,
}

impl Renderer for Watching {
    fn begin_view(&mut self, pass: Pass<'_>) {
        self.inner.begin_view(pass);
    }
    fn shade(&mut self, pass: Pass<'_>, source: DrawSource, into: ShadeTargets) -> ShadeTargets {
        let out = self.inner.shade(pass, source, into);
        *self.kinds.lock().unwrap() = self.inner.kinds().collect();
        out
    }
    fn tests(&mut self) -> &mut dyn TestRenderer {
        self.inner.tests()
    }
}

/// Whether the shading pipelines have positional lights, and whether they have an environment.
fn shading(scene: &mut Scene) -> [bool; 2] {
    let kinds = Kinds::default();
    let watched = watched(scene, &kinds);
    let _stage = stage(&watched, registry().make("frustum").unwrap(), &["main"]);
    let kinds = kinds.lock().unwrap();
    let [
        PipelineKind::Shaded {
            positional_lights,
            environment,
            ..
        },
    ] = kinds.as_slice()
    else {
        panic!("{kinds:?}");
    };
    assert_eq!(
        watched.scene().buffers().environment.is_some(),
        *environment
    );
    assert_eq!(watched.layout().positional_lights, *positional_lights);
    [*positional_lights, *environment]
}

#[test]
fn a_stage_draws_each_scene_with_that_scenes_renderer() {
    let plainly = GpuScene::new(vulkan(), &mut plain()).unwrap();
    let kinds = Kinds::default();
    let watched = watched(&mut plain(), &kinds);
    let mut stage = stage(&plainly, registry().make("frustum").unwrap(), &["main"]);
    let input = || ViewInput::new(look_at(DVec3::Z * 9.0, DVec3::ZERO, perspective(0.9, 0.1)));
    stage.frame(&plainly, &[input()]).unwrap();
    assert!(kinds.lock().unwrap().is_empty());
    stage.frame(&watched, &[input()]).unwrap();
    assert!(!kinds.lock().unwrap().is_empty());
    stage.frame(&plainly, &[input()]).unwrap();
}

#[test]
fn a_second_eye_has_resources_of_its_own_and_one_eye_none() {
    for text in STRATEGIES {
        let one = plan(&mut plain(), text, &["main"]);
        assert!(!one.has("left") && !one.has("right"), "{text}");
        let two = plan(&mut plain(), text, &["left", "right"]);
        let of = |eye: &str| {
            let names = two.resources.iter();
            names.filter(|name| name.starts_with(eye)).count()
        };
        assert!(of("left") > 4 && of("right") > 4, "{text}");
    }
}

#[test]
fn transparency_has_lists_of_its_own_where_something_is_transparent() {
    for text in STRATEGIES {
        let solid = plan(&mut plain(), text, &["main"]);
        assert!(!solid.has("transparent") && !solid.has("blended"), "{text}");
        let glazed = plan(&mut with(Part::Transparency), text, &["main"]);
        assert!(glazed.has("transparent"), "{text}: {:?}", glazed.passes);
        let more = glazed.resources.difference(&solid.resources).count();
        assert!(more > 0, "{text}");
    }
}

/// Words in the names of passes and resources that count samples: an id buffer, histograms, counts a slot.
const COUNTING: [&str; 4] = ["entity ids", "histogram", "visible samples", "count"];

#[test]
fn nothing_counts_where_zero_or_more_is_all_that_is_asked() {
    for latency in ["frame-late", "same-frame", "on-gpu"] {
        let queries = format!("three-pass:latency={latency}:counting=queries:threshold=0");
        let found = plan(&mut plain(), &queries, &["main"]);
        assert!(found.has("quer"), "{queries}: {:?}", found.passes);
        // On the GPU the answers are copied from queries to slots, where the compaction reads them.
        let brought = |word: &&str| latency == "on-gpu" && *word == "visible samples";
        for word in COUNTING.iter().filter(|word| !brought(word)) {
            assert!(!found.has(word), "{queries} has '{word}'");
        }
        for (way, words) in [
            (
                "identity",
                &["entity ids", "histogram", "visible samples"][..],
            ),
            ("compare", &["count", "visible samples"]),
            ("atomics", &["count", "visible samples"]),
        ] {
            let text = format!("three-pass:latency={latency}:counting={way}:threshold=8");
            let found = plan(&mut plain(), &text, &["main"]);
            assert!(!found.has("quer"), "{text}: {:?}", found.passes);
            for word in words {
                assert!(
                    found.has(word),
                    "{text} has no '{word}': {:?} {:?}",
                    found.passes,
                    found.resources
                );
            }
        }
    }
    for text in ["stop-and-wait", "coherent", "occupancy-map"] {
        let found = plan(&mut plain(), text, &["main"]);
        for word in COUNTING {
            assert!(!found.has(word), "{text} has '{word}'");
        }
    }
}

#[test]
fn a_tree_is_followed_by_those_who_walk_it_and_by_nobody_else() {
    for text in STRATEGIES {
        let walks = text.starts_with("occupancy");
        assert_eq!(
            plan(&mut plain(), text, &["main"]).has("tree"),
            walks,
            "{text}"
        );
    }
    let two = plan(&mut plain(), "occupancy-map", &["left", "right"]);
    let trees = two
        .passes
        .iter()
        .filter(|name| name.starts_with("follow tree"));
    assert_eq!(
        trees.count(),
        1,
        "both eyes walk one tree: {:?}",
        two.passes
    );
    assert!(plan(&mut plain(), "stop-and-wait:tree=divided", &["main"]).has("tree"));
}

#[test]
fn an_environment_is_reflected_where_there_is_one() {
    assert!(!shading(&mut plain())[1]);
    let mut scene = with(Part::Environment);
    assert!(shading(&mut scene.clone())[1]);
    // The image stays in the scene, and has no effect by itself.
    scene.set_environment(None).unwrap();
    assert!(!shading(&mut scene)[1]);
}

#[test]
fn distances_to_lights_are_computed_where_a_light_has_a_place() {
    assert!(!shading(&mut plain())[0]);
    let mut scene = with(Part::PositionalLights);
    assert!(shading(&mut scene.clone())[0]);
    let lamps: Vec<_> = scene.lights().map(|lamp| lamp.entity).collect();
    scene.clear_light(lamps[lamps.len() - 1]);
    assert!(!shading(&mut scene)[0]);
}

/// A volume is shown by slices, whose tiles are images. Without a slice there is no texture, and no pipeline that samples one.
#[test]
fn a_volume_brings_textures_and_without_one_there_are_none() {
    let textured = |scene: &mut Scene| {
        let scene = GpuScene::new(vulkan(), scene).unwrap();
        let classes = scene.layout().classes().any(PipelineClass::textured);
        // The first texture is one white texel, for materials without an image.
        assert_eq!(scene.buffers().textures.len() > 1, classes);
        classes
    };
    assert!(!textured(&mut plain()));
    let mut scene = with(Part::Volume);
    assert!(textured(&mut scene.clone()));
    let slices: Vec<_> = scene
        .roots()
        .filter(|root| scene.children(*root).count() > 0)
        .collect();
    for slice in slices {
        scene.despawn(slice);
    }
    assert!(!textured(&mut scene));
}
