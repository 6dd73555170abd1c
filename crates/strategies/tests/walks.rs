//! The traversal of a tree: a hidden sub-tree takes one query, an entity in front of all others takes none, and a scene in which nothing is hidden takes no
//! wait. It works on trees of any depth, and on scenes whose tree changes between frames.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Stage, StageOptions, StageReport, Verdict, Verdicts, ViewInput};
use antumbra_demo_scenes::layer;
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{Camera, Drawable, EntityKey, Material, Scene, icosphere};
use antumbra_strategies::NodeOutcome;
use antumbra_strategies::{Sketch, registry};
use antumbra_testing::{cuboid, drawable, look_at, perspective, views, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg32;

const SIZE: [u32; 2] = [160, 120];
const SAME: &str = "occupancy-map:latency=same-frame:grain=0:worth=0";

fn camera(eye: DVec3) -> Camera {
    look_at(eye, DVec3::ZERO, perspective(0.8, 0.1))
}

fn stage(scene: &GpuScene, text: &str) -> Stage {
    antumbra_testing::stage(scene, text, views(&["main"], SIZE))
}

fn frame(stage: &mut Stage, scene: &GpuScene, camera: Camera) -> (Verdicts, StageReport) {
    let report = stage.frame(scene, &[ViewInput::new(camera)]).unwrap();
    scene.gpu().wait().unwrap();
    (stage.verdicts(0, scene).unwrap(), report)
}

/// The slots that own a pixel and are not drawn.
fn missed(scene: &GpuScene, camera: &Camera, verdicts: &Verdicts) -> Vec<u32> {
    let mut oracle = Oracle::new(scene, SIZE);
    let reference = oracle.render(scene, camera, EntitySet::InFrustum).unwrap();
    let mut owners = reference.owners();
    owners.retain(|slot| !verdicts.get(*slot).draws());
    owners
}

struct Props {
    scene: Scene,
    ball: Drawable,
    wall: Drawable,
}

impl Props {
    fn new() -> Self {
        let mut scene = Scene::new();
        let mut of =
            |name: &str, geometry| drawable(&mut scene, name, geometry, Material::default());
        let ball = of("ball", icosphere(2, 0.4));
        let wall = of("wall", cuboid(DVec3::new(12.0, 12.0, 0.4)));
        Self { scene, ball, wall }
    }

    fn put(&mut self, parent: Option<EntityKey>, at: DVec3, what: Option<Drawable>) -> EntityKey {
        let placed = DAffine3::from_translation(at);
        let entity = self.scene.spawn(parent, placed).unwrap();
        if let Some(what) = what {
            self.scene.set_drawable(entity, what).unwrap();
        }
        entity
    }

    /// A wall before a group of 8 groups of 8 balls.
    fn hidden_groups(&mut self) {
        self.put(None, DVec3::ZERO, Some(self.wall));
        let all = self.put(None, DVec3::new(0.0, 0.0, -8.0), None);
        for group in 0..8 {
            let x = f64::from(group) - 3.5;
            let group = self.put(Some(all), DVec3::X * x, None);
            for ball in 0..8 {
                let y = f64::from(ball) - 3.5;
                self.put(Some(group), DVec3::Y * y, Some(self.ball));
            }
        }
    }
}

#[test]
fn a_hidden_sub_tree_takes_one_question() {
    let mut props = Props::new();
    props.hidden_groups();
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let eye = camera(DVec3::Z * 14.0);
    for text in [
        SAME,
        "occupancy-map-single:grain=0",
        "occupancy-map:latency=same-frame:tree=boxes:worth=0",
    ] {
        let mut stage = stage(&scene, text);
        let (verdicts, report) = frame(&mut stage, &scene, eye);
        let [_, occluded, _, visible, ..] = verdicts.tally();
        assert_eq!((occluded, visible), (64, 1), "{text}");
        assert!(verdicts.tested() <= 4, "{text}: {}", verdicts.tested());
        assert!(
            report.plan.sync_points <= 4,
            "{text}: {}",
            report.plan.sync_points
        );
    }
    // Without the map the wall is queried too, and every node above it.
    let (verdicts, _) = frame(&mut stage(&scene, "stop-and-wait:tree=groups"), &scene, eye);
    assert_eq!((verdicts.tested(), verdicts.tally()[1]), (3, 64));
    // The late form draws the nodes without an answer, queries them, and finds the hidden ones level by level.
    let mut stage = stage(&scene, "occupancy-map:latency=frame-late:grain=0");
    let first = frame(&mut stage, &scene, eye).0;
    assert_eq!(first.drawn().count(), 65);
    for _ in 0..6 {
        frame(&mut stage, &scene, eye);
    }
    let (settled, report) = frame(&mut stage, &scene, eye);
    assert_eq!((settled.tally()[1], report.plan.sync_points), (64, 0));
    assert!(
        settled.tested() <= 2,
        "{} queries for one group",
        settled.tested()
    );
}

#[test]
fn where_nothing_hides_hardly_anything_is_asked() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut layer(12).unwrap()).unwrap();
    let mut stage = stage(&scene, "occupancy-map:latency=same-frame:block=1");
    for _ in 0..3 {
        let (verdicts, report) = frame(&mut stage, &scene, camera(DVec3::Z * 17.0));
        assert_eq!(verdicts.tally()[3], 144);
        assert_eq!((verdicts.tested(), report.plan.sync_points), (0, 0));
    }
}

#[test]
fn what_is_not_worth_a_wait_is_drawn() {
    let mut props = Props::new();
    props.hidden_groups();
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let eye = camera(DVec3::Z * 14.0);
    // 64 balls of 320 triangles wait behind the wall, in one group: 20,480 triangles for a query that costs 190.
    let text = "occupancy-map:latency=same-frame:worth=";
    let (asked, _) = frame(&mut stage(&scene, &format!("{text}20000")), &scene, eye);
    assert_eq!((asked.tested(), asked.tally()[1]), (1, 64));
    let mut stage = stage(&scene, &format!("{text}20300"));
    let (drawn, report) = frame(&mut stage, &scene, eye);
    assert_eq!(
        (
            drawn.tested(),
            drawn.drawn().count(),
            report.plan.sync_points
        ),
        (0, 65, 0)
    );
}

#[test]
fn later_frames_organise_fewer_batches() {
    // Columns of balls behind each other: an organised batch holds one ball of each column.
    let mut props = Props::new();
    for at in 0..360 {
        let (x, y, z) = (at % 3, at / 3 % 3, at / 9);
        let place = DVec3::new(f64::from(x) - 1.0, f64::from(y) - 1.0, -f64::from(z));
        props.put(None, place, Some(props.ball));
    }
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let mut stage = stage(
        &scene,
        "occupancy-map:latency=same-frame:grain=0:tree=groups:block=8:least-seen=0:together=1:visible-for=0:worth=0",
    );
    let mut waits = Vec::new();
    for _ in 0..8 {
        waits.push(
            frame(&mut stage, &scene, camera(DVec3::Z * 9.0))
                .1
                .plan
                .sync_points,
        );
    }
    assert!(waits[0] > 3, "{waits:?}");
    for pair in waits.windows(2) {
        // After n organised batches all other nodes are queried at once. All nodes are leaves, so that is one batch more.
        assert!(pair[1] <= pair[0] * 7 / 10 + 1, "{waits:?}");
    }
}

#[test]
fn what_stays_hidden_shares_its_questions_and_is_found_when_it_comes_to_light() {
    // A wall that hides 49 balls without a parent, and one ball that is visible beside it.
    let mut props = Props::new();
    let wall = props.put(None, DVec3::ZERO, Some(props.wall));
    for at in 0..49 {
        let place = DVec3::new(f64::from(at % 7) - 3.0, f64::from(at / 7) - 3.0, -4.0);
        props.put(None, place, Some(props.ball));
    }
    props.put(None, DVec3::new(7.0, 0.0, 0.0), Some(props.ball));
    let mut scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let eye = camera(DVec3::Z * 18.0);
    for latency in ["same-frame", "frame-late"] {
        let text = format!("occupancy-map:latency={latency}:tree=groups:grain=0:worth=0");
        let mut alone = stage(&scene, &format!("{text}:together=1"));
        let mut together = stage(&scene, &text);
        let mut last = Vec::new();
        for _ in 0..4 {
            last = vec![
                frame(&mut alone, &scene, eye).0,
                frame(&mut together, &scene, eye).0,
            ];
            assert_eq!(last[0].tally(), last[1].tally(), "{latency}");
        }
        let [alone_asked, asked] = [last[0].tested(), last[1].tested()];
        assert!(
            alone_asked >= 49 && asked <= 9,
            "{latency}: {asked} of {alone_asked}"
        );
        // The wall moves aside. The same-frame form draws every ball at once, the late form as soon as an answer is there.
        let aside = |x: f64| DAffine3::from_translation(DVec3::X * x);
        props.scene.set_local(wall, aside(-6.0)).unwrap();
        scene.sync(&mut props.scene).unwrap();
        let mut missing = missed(&scene, &eye, &frame(&mut together, &scene, eye).0);
        if latency == "frame-late" {
            assert!(!missing.is_empty(), "a late answer is late");
            missing = missed(&scene, &eye, &frame(&mut together, &scene, eye).0);
        }
        assert_eq!(missing, [0u32; 0], "{latency}");
        props.scene.set_local(wall, aside(0.0)).unwrap();
        scene.sync(&mut props.scene).unwrap();
    }
}

#[test]
fn trees_of_any_depth_are_walked() {
    let gpu = vulkan();
    let mut props = Props::new();
    let (mut chain, mut comb) = (None, None);
    for step in 0..100_000 {
        chain = Some(props.put(chain, DVec3::ZERO, None));
        if step < 2_000 {
            let entity = props.put(comb, DVec3::new(0.0, 0.0, -0.001), Some(props.ball));
            comb = Some(entity);
        }
    }
    props.put(chain, DVec3::X * 2.0, Some(props.ball));
    let mut scene = GpuScene::new(gpu, &mut props.scene).unwrap();
    for text in [
        SAME,
        "occupancy-map:latency=frame-late:tree=groups",
        "stop-and-wait:tree=groups",
    ] {
        let mut stage = stage(&scene, text);
        let eye = camera(DVec3::Z * 9.0);
        let (verdicts, _) = frame(&mut stage, &scene, eye);
        assert_eq!(missed(&scene, &eye, &verdicts), [0u32; 0], "{text}");
    }
    // Every entity is below the first: moving it moves all of them.
    let root = props.scene.roots().next().unwrap();
    props
        .scene
        .set_local(root, DAffine3::from_translation(DVec3::X))
        .unwrap();
    scene.sync(&mut props.scene).unwrap();
    let eye = camera(DVec3::Z * 9.0);
    let (verdicts, _) = frame(&mut stage(&scene, SAME), &scene, eye);
    assert!(verdicts.drawn().count() > 0);
    assert_eq!(missed(&scene, &eye, &verdicts), [0u32; 0]);
}

#[test]
fn groups_of_those_who_are_gone_are_cleared_away() {
    let mut props = Props::new();
    props.hidden_groups();
    let mut scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let groups = scene.table().groups().parents().len();
    assert_eq!(groups, 9);
    for _ in 0..1_200 {
        let group = props.put(None, DVec3::X, None);
        props.put(Some(group), DVec3::X * 6.0, Some(props.ball));
        scene.sync(&mut props.scene).unwrap();
        props.scene.despawn(group);
        scene.sync(&mut props.scene).unwrap();
        assert!(scene.table().groups().parents().len() <= 2 * groups + 1025);
    }
    // The other entities are still in the same groups.
    let eye = camera(DVec3::Z * 14.0);
    let mut stage = stage(&scene, "stop-and-wait:tree=groups");
    let (verdicts, _) = frame(&mut stage, &scene, eye);
    assert_eq!((verdicts.tested(), verdicts.tally()[1]), (3, 64));
}

#[test]
fn trees_that_change_are_followed() {
    let gpu = vulkan();
    let mut props = Props::new();
    props.hidden_groups();
    let mut scene = GpuScene::new(gpu, &mut props.scene).unwrap();
    let mut random = Pcg32::seed_from_u64(7);
    let mut stages: Vec<(&str, Stage)> = [
        SAME,
        "occupancy-map:latency=same-frame:tree=boxes:worth=0",
        "occupancy-map:latency=same-frame:tree=groups:visible-for=4:worth=0",
        "occupancy-map-single",
    ]
    .map(|text| (text, stage(&scene, text)))
    .into();
    for step in 0..30 {
        let entities: Vec<EntityKey> = props.scene.entities().collect();
        let mut pick = || entities[random.random_range(0..entities.len())];
        let (one, other) = (pick(), pick());
        match step % 5 {
            0 => drop(props.scene.despawn(one)),
            1 => {
                let place = DVec3::new(f64::from(step) * 0.2 - 3.0, 0.0, 2.0);
                props.put(
                    props.scene.contains(other).then_some(other),
                    place,
                    Some(props.ball),
                );
            }
            2 => props.scene.set_tested(one, step % 2 == 0).unwrap(),
            // A parent below its own child is refused without any change.
            3 => drop(props.scene.set_parent(one, Some(other))),
            _ => {
                let moved = DAffine3::from_translation(DVec3::new(0.3, 0.2, 1.0));
                let local = props.scene.local(one).unwrap();
                props.scene.set_local(one, local * moved).unwrap();
            }
        }
        scene.sync(&mut props.scene).unwrap();
        // Every seventh step makes two changes between two frames.
        if step % 7 == 0 {
            props.put(
                None,
                DVec3::new(0.0, 1.0, f64::from(step) * 0.1),
                Some(props.ball),
            );
            scene.sync(&mut props.scene).unwrap();
        }
        let eye = camera(DVec3::new(f64::from(step) * 0.3 - 4.0, 1.0, 13.0));
        for (text, stage) in &mut stages {
            let (verdicts, _) = frame(stage, &scene, eye);
            assert_eq!(
                missed(&scene, &eye, &verdicts),
                [0u32; 0],
                "{text}, step {step}"
            );
            let drawn = scene
                .table()
                .live_slots()
                .filter(|slot| !scene.table().is_tested(*slot));
            for slot in drawn {
                assert!(
                    matches!(
                        verdicts.get(slot),
                        Verdict::Untested | Verdict::OutsideFrustum
                    ),
                    "{text}, step {step}: slot {slot} may not be culled"
                );
            }
        }
    }
}

#[test]
fn a_sketch_is_left_where_one_was_asked_for() {
    let mut props = Props::new();
    props.hidden_groups();
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let eye = camera(DVec3::Z * 14.0);
    let mut plain = stage(&scene, SAME);
    frame(&mut plain, &scene, eye);
    assert!(plain.shown::<Sketch>(0, Sketch::NAME).is_none());
    let mut sketched = stage(&scene, &format!("{SAME}:sketch=true"));
    frame(&mut sketched, &scene, eye);
    let sketch = sketched.shown::<Sketch>(0, Sketch::NAME).unwrap();
    assert_eq!(sketch.block(), 4);
    assert_eq!(sketch.occupancy().size(), [40, 30]);
    let taken = sketch.occupancy().taken();
    assert!((300..1200).contains(&taken), "{taken} of 1200 blocks");
    let outcomes = |outcome| {
        sketch
            .nodes()
            .iter()
            .filter(|node| node.outcome == outcome)
            .count()
    };
    assert!(outcomes(NodeOutcome::Free) >= 1 && outcomes(NodeOutcome::Occluded) == 1);
    assert!(
        sketch
            .nodes()
            .iter()
            .all(|node| (node.batch == 0) == (node.outcome == NodeOutcome::Free))
    );
}

#[test]
fn late_walks_run_inside_somebody_elses_frame_and_waiting_ones_are_refused() {
    let mut props = Props::new();
    props.hidden_groups();
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let embedded = |text: &str| {
        let strategy = registry().parse(text).unwrap();
        let views = views(&["main"], SIZE);
        let options = StageOptions {
            mode: Mode::Embedded,
            ..StageOptions::default()
        };
        Stage::new(&scene, strategy, views, options)
    };
    assert!(embedded("occupancy-map:latency=frame-late").is_ok());
    let error = embedded(SAME).unwrap_err().to_string();
    assert!(error.contains("traversal"), "{error}");
}

#[test]
fn settings_out_of_range_are_refused_with_the_range() {
    let refused = |text: &str| registry().parse(text).err().unwrap().to_string();
    for (text, range) in [
        ("occupancy-map:latency=on-gpu", "frame-late or same-frame"),
        ("occupancy-map:block=0", "1 to 256"),
        ("occupancy-map:tree=octree", "groups, boxes or divided"),
        ("occupancy-map:small=-1", "from 0 to 64"),
        ("occupancy-map-single:slow=NaN", "0 to 10"),
        ("occupancy-map:together=0", "1 to 256"),
        ("occupancy-map:least-seen=1.5", "from 0 to 1"),
        ("occupancy-map:visible-for=-1", "0 to 1000"),
        ("occupancy-map:order=size", "state or depth"),
        ("stop-and-wait:tree=bush", "none, groups, boxes or divided"),
    ] {
        assert!(refused(text).contains(range), "{}", refused(text));
    }
    for key in ["latency", "together", "worth"] {
        let text = refused(&format!("occupancy-map-single:{key}=1"));
        assert!(text.contains(&format!("no setting '{key}'")), "{text}");
    }
    let conservative = |text: &str| registry().parse(text).unwrap().conservative();
    assert!(conservative(SAME) && conservative("occupancy-map-single:visible-for=9"));
    for aggressive in ["small=1", "occluded-for=1", "latency=frame-late"] {
        assert!(
            !conservative(&format!("{SAME}:{aggressive}")),
            "{aggressive}"
        );
    }
}
