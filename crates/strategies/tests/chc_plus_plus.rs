//! `chc-plus-plus`, frame by frame: what shares queries, what tight boxes cull, when visible leaves are tested again, and what it costs where nothing is hidden.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Stage, StageOptions, StageReport, Verdicts, ViewInput};
use antumbra_demo_scenes::layer;
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{Camera, Drawable, EntityKey, Material, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{cuboid, drawable, gl, look_at, perspective, views, vulkan};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 120];
/// Every node is queried, an entity at a time.
const SAME: &str = "chc-plus-plus:latency=same-frame:tree=groups:grain=0:worth=0";
const LATE: &str = "chc-plus-plus:latency=frame-late:tree=groups:grain=0";

fn camera() -> Camera {
    look_at(DVec3::Z * 18.0, DVec3::ZERO, perspective(0.8, 0.1))
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
fn missed(scene: &GpuScene, verdicts: &Verdicts) -> Vec<u32> {
    let mut oracle = Oracle::new(scene, SIZE);
    let reference = oracle
        .render(scene, &camera(), EntitySet::InFrustum)
        .unwrap();
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
    fn new(wall: DVec3) -> Self {
        let mut scene = Scene::new();
        let mut of =
            |name: &str, geometry| drawable(&mut scene, name, geometry, Material::default());
        let ball = of("ball", icosphere(2, 0.4));
        let wall = of("wall", cuboid(wall));
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

    /// 7 x 7 balls without a parent, in a plane.
    fn balls(&mut self, z: f64) {
        for at in 0..49 {
            let place = DVec3::new(f64::from(at % 7) - 3.0, f64::from(at / 7) - 3.0, z);
            self.put(None, place, Some(self.ball));
        }
    }
}

/// A wall that hides 49 balls, and one ball beside it, which is visible.
fn hidden_balls() -> (Props, EntityKey) {
    let mut props = Props::new(DVec3::new(12.0, 12.0, 0.4));
    let wall = props.put(None, DVec3::ZERO, Some(props.wall));
    props.balls(-4.0);
    props.put(None, DVec3::new(7.0, 0.0, 0.0), Some(props.ball));
    (props, wall)
}

#[test]
fn what_stays_hidden_shares_queries_and_is_drawn_when_it_shows() {
    for gpu in [vulkan(), gl()] {
        let (mut props, wall) = hidden_balls();
        let mut scene = GpuScene::new(gpu, &mut props.scene).unwrap();
        for text in [SAME, LATE] {
            let mut alone = stage(&scene, &format!("{text}:multiqueries=false"));
            let mut shared = stage(&scene, text);
            let mut tested = Vec::new();
            for _ in 0..16 {
                let one = frame(&mut alone, &scene, camera()).0;
                let other = frame(&mut shared, &scene, camera()).0;
                assert_eq!(one.tally(), other.tally(), "{text}");
                tested.push([one.tested(), other.tested()]);
            }
            // 49 queries, or one for eleven balls; and now and then one for what is visible.
            let [alone_tested, shared_tested] = tested[15];
            assert!(
                alone_tested >= 49 && shared_tested <= 7,
                "{text}: {tested:?}"
            );
            let early = tested[3][1];
            assert!(shared_tested < early && early < 49, "{text}: {tested:?}");
            let aside = |x: f64| DAffine3::from_translation(DVec3::X * x);
            props.scene.set_local(wall, aside(-6.0)).unwrap();
            scene.sync(&mut props.scene).unwrap();
            let mut missing = missed(&scene, &frame(&mut shared, &scene, camera()).0);
            if text == LATE {
                assert!(!missing.is_empty(), "a late answer is late");
                missing = missed(&scene, &frame(&mut shared, &scene, camera()).0);
            }
            assert_eq!(missing, [0u32; 0], "{text}");
            props.scene.set_local(wall, aside(0.0)).unwrap();
            scene.sync(&mut props.scene).unwrap();
        }
    }
}

#[test]
fn tight_boxes_cull_a_group_that_its_own_box_shows() {
    // Two walls with a gap between them. Behind each wall is a ball of one group, whose box reaches across the gap.
    let mut props = Props::new(DVec3::new(4.0, 12.0, 0.4));
    for x in [-3.0, 3.0] {
        props.put(None, DVec3::X * x, Some(props.wall));
    }
    let group = props.put(None, DVec3::ZERO, None);
    for x in [-3.0, 3.0] {
        props.put(Some(group), DVec3::new(x, 0.0, -2.0), Some(props.ball));
    }
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    // The most queries and waits of a frame, once no node is held open any more because a query found it visible.
    let settled = |settings: &str| {
        let text = format!("{SAME}:free-screen=false:visible-for=1000:randomised=false{settings}");
        let mut stage = stage(&scene, &text);
        let frames: Vec<_> = (0..100)
            .map(|_| frame(&mut stage, &scene, camera()))
            .collect();
        let settled = frames.iter().skip(50);
        let costs = settled.map(|(verdicts, report)| {
            assert_eq!(verdicts.tally()[1], 2, "{settings}");
            (verdicts.tested(), report.plan.sync_points)
        });
        costs.max().unwrap()
    };
    // The group as one; or now and then the group in vain and then both balls.
    assert_eq!(settled(""), (1, 1));
    assert_eq!(settled(":tight-depth=0"), (2, 2));
    // The two balls have about a quarter of the group's surface.
    assert_eq!(settled(":tight-surface=0.1"), (2, 2));
    assert_eq!(settled(":tight-surface=0.9"), (1, 1));
}

#[test]
fn visible_leaves_are_tested_again_in_random_frames() {
    // 49 visible balls, and one behind a wall, about which every frame waits.
    let mut props = Props::new(DVec3::new(1.6, 1.6, 0.1));
    props.balls(0.0);
    props.put(None, DVec3::new(6.0, 0.0, 0.0), Some(props.wall));
    props.put(None, DVec3::new(6.0, 0.0, -1.0), Some(props.ball));
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let tested = |settings: &str| -> Vec<u32> {
        let mut stage = stage(&scene, &format!("{SAME}:visible-for=10{settings}"));
        let frames = (0..31).map(|_| frame(&mut stage, &scene, camera()).0);
        frames.map(|verdicts| verdicts.tested()).skip(1).collect()
    };
    let regular = tested(":randomised=false");
    // The wall too is visible: all 50 at once, every tenth frame.
    let at_once = regular.iter().filter(|tested| **tested == 51).count();
    assert_eq!(
        (at_once, regular.iter().sum::<u32>()),
        (3, 30 + 150),
        "{regular:?}"
    );
    let random = tested("");
    assert!(
        random.iter().all(|tested| (1..18).contains(tested)),
        "{random:?}"
    );
    assert!(
        (150..=30 + 150 + 50).contains(&random.iter().sum::<u32>()),
        "{random:?}"
    );
    assert_ne!(random, tested(":seed=1"));
    assert_eq!(random, tested(":seed=0"));
    // Every frame, where answers hold for none.
    assert!(tested(":visible-for=0").iter().all(|tested| *tested == 51));
}

#[test]
fn what_becomes_hidden_is_culled_after_its_next_test() {
    let (mut props, wall) = hidden_balls();
    let aside = DAffine3::from_translation(DVec3::X * -14.0);
    props.scene.set_local(wall, aside).unwrap();
    let mut scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let mut stage = stage(&scene, SAME);
    for _ in 0..3 {
        assert_eq!(frame(&mut stage, &scene, camera()).0.tally()[1], 0);
    }
    props.scene.set_local(wall, DAffine3::IDENTITY).unwrap();
    scene.sync(&mut props.scene).unwrap();
    let mut occluded = Vec::new();
    for _ in 0..8 {
        let (verdicts, _) = frame(&mut stage, &scene, camera());
        assert_eq!(missed(&scene, &verdicts), [0u32; 0]);
        occluded.push(verdicts.tally()[1]);
    }
    // All are tested within the five frames for which answers hold, and culled one frame later.
    assert!(occluded[0] == 0 && occluded[2] < 49, "{occluded:?}");
    assert_eq!(occluded[7], 49, "{occluded:?}");
}

#[test]
fn where_nothing_hides_it_waits_for_nothing() {
    let scene = GpuScene::new(vulkan(), &mut layer(12).unwrap()).unwrap();
    let mut stage = stage(&scene, "chc-plus-plus:latency=same-frame");
    let eye = look_at(DVec3::Z * 17.0, DVec3::ZERO, perspective(0.8, 0.1));
    for _ in 0..12 {
        let (verdicts, report) = frame(&mut stage, &scene, eye);
        assert_eq!(verdicts.drawn().count(), 144);
        assert_eq!((verdicts.tested(), report.plan.sync_points), (0, 0));
    }
}

#[test]
fn the_late_form_runs_inside_other_frames_and_the_waiting_one_is_refused() {
    let (mut props, _) = hidden_balls();
    let scene = GpuScene::new(vulkan(), &mut props.scene).unwrap();
    let embedded = |text: &str| {
        let options = StageOptions {
            mode: Mode::Embedded,
            ..StageOptions::default()
        };
        let strategy = registry().parse(text).unwrap();
        Stage::new(&scene, strategy, views(&["main"], SIZE), options)
    };
    assert!(embedded(LATE).is_ok());
    let error = embedded(SAME).unwrap_err().to_string();
    assert!(error.contains("traversal"), "{error}");
}

#[test]
fn settings_out_of_range_are_refused_with_the_range() {
    for (setting, range) in [
        ("latency=on-gpu", "frame-late or same-frame"),
        ("tree=octree", "groups, boxes or divided"),
        ("batch=0", "1 to 1000000"),
        ("multiqueries=maybe", "true or false"),
        ("tight-depth=9", "0 to 8"),
        ("tight-surface=NaN", "from 0 to 16"),
        ("visible-for=1001", "0 to 1000"),
        ("seed=-1", "0 to 4294967295"),
    ] {
        let error = registry().parse(&format!("chc-plus-plus:{setting}"));
        let error = error.err().unwrap().to_string();
        assert!(error.contains(range), "{error}");
    }
    let conservative = |text: &str| registry().parse(text).unwrap().conservative();
    assert!(conservative(SAME) && !conservative(LATE));
}
