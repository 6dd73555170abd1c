//! Other engines' occlusion tests, as `depth-pyramid:like=...` plays them: each fault that was predicted from what is published of them, on the smallest scene that shows it or shows that it is not there;
//! and all of them in the kit's stories. On each scene our own test is right. `docs/rivals.md` has what follows.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::Gpu;
use antumbra_draw::GpuScene;
use antumbra_scene::{Camera, ClipMatrix, EntityKey, Projection, Scene};
use antumbra_strategies::{Rival, registry};
use antumbra_testing::{
    SceneBuilder, frame, gpus, look_at, over_pixels, perspective_degrees, placed, stage, views,
    vulkan,
};
use antumbra_verify::kit::{Case, Kit, OtherSetups};
use antumbra_verify::{EntitySet, Oracle};
use glam::{DMat4, DQuat, DVec3};

/// A scene, and what a camera sees of it in each frame.
struct Story {
    scene: Scene,
    size: [u32; 2],
    cameras: Vec<Camera>,
}

impl Story {
    /// Three frames of a camera that stands still: in the first there is no previous depth.
    fn still(built: SceneBuilder, size: [u32; 2], camera: Camera) -> Self {
        Self {
            scene: built.scene,
            size,
            cameras: vec![camera; 3],
        }
    }

    /// The entities that are culled in the last frame and own a pixel of it.
    fn false_culls(&self, gpu: &Gpu, like: &str) -> Vec<EntityKey> {
        let scene = GpuScene::new(gpu, &mut self.scene.clone()).unwrap();
        let text = format!("depth-pyramid:like={like}");
        let mut stage = stage(&scene, &text, views(&["main"], self.size));
        let mut oracle = Oracle::new(&scene, self.size);
        let mut missed = Vec::new();
        for camera in &self.cameras {
            let verdicts = frame(&mut stage, &scene, &[*camera]).remove(0);
            let reference = oracle.render(&scene, camera, EntitySet::InFrustum).unwrap();
            missed = reference.owners();
            missed.retain(|slot| !verdicts.get(*slot).draws());
        }
        let key = |slot: u32| scene.table().occupant(slot).unwrap().key;
        missed.into_iter().map(key).collect()
    }

    /// Checks on every backend that these rivals cull these entities wrongly, that the others cull none, and that ours culls none.
    #[track_caller]
    fn is_lost_by(&self, rivals: &[&str], lost: &[EntityKey]) {
        for gpu in gpus() {
            for rival in Rival::ALL.map(Rival::word) {
                let expected = if rivals.contains(&rival) { lost } else { &[] };
                let missed = self.false_culls(gpu, rival);
                assert_eq!(missed, expected, "{rival} on {}", gpu.title());
            }
            assert_eq!(self.false_culls(gpu, "ours"), [], "{}", gpu.title());
        }
    }
}

/// An upright box of two corners.
fn slab(built: &mut SceneBuilder, low: [f64; 3], high: [f64; 3]) -> EntityKey {
    let [low, high] = [low, high].map(DVec3::from);
    built.cube((low + high) * 0.5, high - low)
}

fn parallel(height: f64, near: f64, far: f64) -> Projection {
    Projection::Orthographic { height, near, far }
}

/// Bevy clamps the nearest z to an entry of the matrix that is the near plane's distance in perspective only. In a parallel view from -1000 to 1000 m it is a half, so that all that is nearer is
/// taken to be half a metre before the eye.
#[test]
fn bevy_loses_what_is_beside_and_behind_the_eye_of_a_parallel_view() {
    let mut built = SceneBuilder::new();
    // A metre is a pixel. The eye's plane is z = 0, and both are on the viewer's side of it.
    slab(&mut built, [-20.0, -20.0, 49.0], [20.0, 20.0, 50.0]);
    let before_it = slab(&mut built, [-4.0, -4.0, 99.0], [4.0, 4.0, 100.0]);
    let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, parallel(64.0, -1000.0, 1000.0));
    Story::still(built, [64, 64], camera).is_lost_by(&["bevy"], &[before_it]);
}

/// The same scene in front of the eye's plane: the clamp does nothing there.
#[test]
fn bevy_is_right_in_a_parallel_view_from_its_eye_on() {
    let mut built = SceneBuilder::new();
    slab(&mut built, [-20.0, -20.0, -101.0], [20.0, 20.0, -100.0]);
    slab(&mut built, [-4.0, -4.0, -51.0], [4.0, 4.0, -50.0]);
    let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, parallel(64.0, -1000.0, 1000.0));
    Story::still(built, [64, 64], camera).is_lost_by(&[], &[]);
}

/// With a tilted near plane, depth also depends on where in the image a point is. Bevy's goes by z in view space alone.
#[test]
fn bevy_loses_what_is_aside_under_a_tilted_near_plane() {
    let mut built = SceneBuilder::new();
    slab(&mut built, [-9.0, -5.0, -10.5], [-1.0, 5.0, -10.0]);
    let before_it = slab(&mut built, [-3.2, -0.2, -5.4], [-2.8, 0.2, -5.0]);
    // 90 degrees wide and high. Its near plane is x / 2 + 0.866 d = 1, where d is the distance ahead; depth is 0.567 + (1 / 2 - x / 4) / d.
    let matrix = DMat4::from_cols_array_2d(&[
        [1.0, 0.0, -0.25, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -0.567, -1.0],
        [0.0, 0.0, 0.5, 0.0],
    ]);
    let projection = Projection::Matrix(ClipMatrix::reversed(matrix).unwrap());
    let camera = Camera::new(projection, DVec3::ZERO, DQuat::IDENTITY).unwrap();
    Story::still(built, [64, 64], camera).is_lost_by(&["bevy"], &[before_it]);
}

/// A wall over all but the last sixteen columns of an image, and a ball of thirty-two pixels that shows there.
fn beside_a_wall(size: [u32; 2]) -> (Story, EntityKey) {
    let [wide, high] = size.map(f64::from);
    let mut built = SceneBuilder::new();
    let edge = wide / 2.0 - 16.0;
    slab(&mut built, [-wide, -high, 4.0], [edge, high, 5.0]);
    let ball = built.ball(DVec3::new(edge, 0.0, -20.0), 32.0);
    let camera = over_pixels(DVec3::new(0.0, 0.0, 20.0), size);
    (Story::still(built, size, camera), ball)
}

/// A level of odd width is halved and rounded down: no texel reads its last column. 48 pixels become 3 texels of 16, and then one of 32.
#[test]
fn helio_loses_a_hole_in_the_last_column_of_an_odd_level() {
    let (story, ball) = beside_a_wall([48, 32]);
    story.is_lost_by(&["helio"], &[ball]);
}

/// The same where no level is odd.
#[test]
fn helio_keeps_a_hole_where_no_level_is_odd() {
    let (story, _) = beside_a_wall([64, 32]);
    assert_eq!(story.false_culls(vulkan(), "helio"), []);
}

/// Off the axis a sphere is seen longer than its radius over w. What shows beyond that is beyond the texels that are read.
#[test]
fn helio_loses_the_outer_edge_of_a_sphere_off_the_axis() {
    let mut built = SceneBuilder::new();
    // 90 degrees and 256 pixels: a tangent of 0.75 is the edge between two texels of 32 pixels. By its radius over w the ball ends just before it, and in truth three pixels beyond.
    slab(&mut built, [-2.0, -2.0, -1.01], [0.75, 2.0, -1.0]);
    let ball = built.ball(DVec3::new(6.25, 0.0, -10.0), 2.34);
    let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, perspective_degrees(90.0, 0.1));
    Story::still(built, [256, 256], camera).is_lost_by(&["helio"], &[ball]);
}

/// Helio has one phase: what comes into sight is tested against depth in which it was hidden.
#[test]
fn helio_loses_for_a_frame_what_comes_into_sight() {
    let mut built = SceneBuilder::new();
    slab(&mut built, [-2.0, -2.0, -0.1], [2.0, 2.0, 0.0]);
    let behind = built.ball(DVec3::new(0.0, 0.0, -4.0), 1.0);
    let lens = perspective_degrees(60.0, 0.1);
    let before = look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, lens);
    // From the other side, where the ball is in the image's middle again.
    let after = look_at(DVec3::new(0.0, 0.0, -14.0), DVec3::ZERO, lens);
    let mut story = Story {
        scene: built.scene,
        size: [64, 64],
        cameras: vec![before, before, after],
    };
    let lost = story.false_culls(vulkan(), "helio");
    assert!(lost.contains(&behind), "{lost:?}");
    for rival in [
        "bevy",
        "bevy-meshlets",
        "niagara",
        "unity",
        "vk_lod_clusters",
        "ours",
    ] {
        assert_eq!(story.false_culls(vulkan(), rival), [], "{rival}");
    }
    // A frame later it is there.
    story.cameras.push(after);
    assert_eq!(story.false_culls(vulkan(), "helio"), []);
}

/// A flat square. Boxes here are wider than their meshes by some millionths; seen through a volume of four kilometres, f32 does not tell that from flat.
fn sticker(built: &mut SceneBuilder, size: f64) -> EntityKey {
    built.put(
        built.square,
        placed(DVec3::ZERO, DVec3::new(size, size, 1.0)),
    )
}

/// Where equal depth counts as occluded, a flat box is hidden by another in its plane.
#[test]
fn bevy_meshlets_lose_a_flat_box_in_the_plane_of_another() {
    let mut built = SceneBuilder::new();
    sticker(&mut built, 24.0);
    let on_it = sticker(&mut built, 4.0);
    let eye = DVec3::new(0.0, 0.0, 64.0);
    let camera = look_at(eye, DVec3::ZERO, parallel(32.0, 0.0, 4096.0));
    // Unity's comparison is as strict, and its slack cures it. Bevy's meshes and vk_lod_clusters draw at equal depth; a sphere is never flat.
    Story::still(built, [32, 32], camera).is_lost_by(&["bevy-meshlets"], &[on_it]);
}

/// By itself it is not lost: it is hidden by its own depth of the previous frame, and found by the second phase, where nothing of it is drawn.
#[test]
fn a_flat_box_alone_is_not_lost_in_two_phases() {
    let mut built = SceneBuilder::new();
    sticker(&mut built, 64.0);
    let eye = DVec3::new(0.0, 0.0, 64.0);
    let camera = look_at(eye, DVec3::ZERO, parallel(32.0, 0.0, 4096.0));
    Story::still(built, [32, 32], camera).is_lost_by(&[], &[]);
}

/// Rectangles are clamped two texels, four pixels, before the end of the part of the pyramid in use: what shows in the last two pixels alone is tested by others.
#[test]
fn vk_lod_clusters_lose_what_shows_in_the_last_two_columns() {
    let mut built = SceneBuilder::new();
    slab(&mut built, [-40.0, -40.0, 4.0], [30.0, 40.0, 5.0]);
    let edge = slab(&mut built, [30.0, -1.9, -10.0], [32.0, 1.9, -9.0]);
    let camera = over_pixels(DVec3::new(0.0, 0.0, 20.0), [64, 64]);
    Story::still(built, [64, 64], camera).is_lost_by(&["vk_lod_clusters"], &[edge]);
}

/// The stories of a ball behind two walls with a slit of a pixel between them, at all columns of images of several sizes.
fn slits() -> impl Iterator<Item = (Story, EntityKey)> {
    let sizes = [[64, 48], [47, 31], [96, 40]];
    let slits = sizes.into_iter().flat_map(|size| {
        let columns = (1..size[0] - 1).step_by(5);
        columns.flat_map(move |column| [0.2, 0.9, 4.0].map(move |ball| (size, column, ball)))
    });
    slits.map(|(size, column, diameter)| {
        // 90 degrees upwards: at a metre's distance a pixel is 2 / height wide.
        let pixel = 2.0 / f64::from(size[1]);
        let left = (f64::from(column) - f64::from(size[0]) * 0.5) * pixel;
        let mut built = SceneBuilder::new();
        slab(&mut built, [-9.0, -9.0, -1.001], [left, 9.0, -1.0]);
        slab(&mut built, [left + pixel, -9.0, -1.001], [9.0, 9.0, -1.0]);
        let ball = built.ball(DVec3::new((left + pixel * 0.5) * 6.0, 0.1, -6.0), diameter);
        let camera = look_at(DVec3::ZERO, DVec3::NEG_Z, perspective_degrees(90.0, 0.1));
        (Story::still(built, size, camera), ball)
    })
}

/// niagara's one sample with minimum reduction reads all texels that a sphere's rectangle touches, at either level. Helio's four points, for comparison, do not.
#[test]
fn niagaras_single_sample_misses_no_slit() {
    let mut lost_by_helio = 0;
    for (story, ball) in slits() {
        for rival in ["niagara", "ours"] {
            let missed = story.false_culls(vulkan(), rival);
            assert_eq!(missed, [], "{rival}, {:?}, {ball:?}", story.size);
        }
        lost_by_helio += story.false_culls(vulkan(), "helio").len();
    }
    assert!(lost_by_helio > 0, "the scenes show nothing");
}

#[test]
fn rivals_say_what_they_are() {
    for rival in Rival::ALL {
        let text = format!("depth-pyramid:like={}", rival.word());
        let strategy = registry().parse(&text).unwrap();
        assert!(!strategy.conservative(), "{text}");
        assert!(strategy.summary().contains("yardstick"), "{text}");
    }
    let ours = registry().parse("depth-pyramid:like=ours").unwrap();
    assert!(ours.conservative());
}

/// What a strategy draws of the kit's stories.
#[derive(Default)]
struct Tally {
    frames: u32,
    owners: usize,
    drawn: usize,
    false_culls: usize,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.frames += other.frames;
        self.owners += other.owners;
        self.drawn += other.drawn;
        self.false_culls += other.false_culls;
    }
}

/// Plays a story of the kit. Every frame's image must be that of its verdicts, and what crosses the near plane must be drawn.
fn tally(gpu: &Gpu, kit: &Kit, case: Case, like: &str) -> Tally {
    let text = format!("depth-pyramid:like={like}");
    let replay = kit.replay(gpu, || registry().parse(&text).unwrap(), case);
    assert!(
        replay.violation.is_none(),
        "{text}, {case}: {:?}",
        replay.violation
    );
    let mut tally = Tally::default();
    for frame in &replay.frames {
        let owners = frame.reference.owners();
        let missed = |slot: &&u32| !frame.verdicts.get(**slot).draws();
        tally.false_culls += owners.iter().filter(missed).count();
        tally.owners += owners.len();
        tally.drawn += frame.verdicts.drawn().count();
        tally.frames += 1;
    }
    tally
}

/// Prints the table of `docs/rivals.md`.
#[test]
fn rivals_draw_what_their_verdicts_say_in_all_stories() {
    let kit = Kit {
        random_scenes: 16,
        many_entities: 600,
        other_setups: OtherSetups::LeftOut,
        ..Kit::default()
    };
    let rivals = std::iter::once("ours").chain(Rival::ALL.map(Rival::word));
    for like in rivals {
        let mut all = Tally::default();
        let mut wrong = Vec::new();
        for case in Case::ALL {
            let one = tally(vulkan(), &kit, case, like);
            if one.false_culls > 0 {
                wrong.push(format!("{case} {}", one.false_culls));
            }
            all.add(&one);
        }
        println!(
            "| {like} | {} | {} | {} | {:.2} | {} |",
            all.frames,
            all.owners,
            all.false_culls,
            all.drawn as f64 / all.owners as f64,
            wrong.join(", ")
        );
        assert!(all.drawn + all.false_culls >= all.owners, "{like}");
        assert!(like != "ours" || all.false_culls == 0);
    }
}

/// With four samples a pixel, in a host's frame, as answers alone, and on OpenGL.
#[test]
fn rivals_conform_in_every_setup() {
    let kit = Kit {
        size: [96, 72],
        cases: vec![Case::RandomScenes, Case::Resize],
        random_scenes: 1,
        ..Kit::default()
    };
    for gpu in gpus() {
        for rival in Rival::ALL.map(Rival::word) {
            let text = format!("depth-pyramid:like={rival}");
            let outcome = kit.check_on(gpu, || registry().parse(&text).unwrap());
            assert!(outcome.is_ok(), "{text}: {}", outcome.unwrap_err());
        }
    }
}
