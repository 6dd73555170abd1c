//! Proxies that deviate from their meshes: the deviation is known, and no proxy is used where it shows. Also the part of the image that a frame may leave
//! out, in every latency.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{AuditOptions, Gpu, StageOptions, Verdicts, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_scene::{Camera, Drawable, EntityKey, Material, Mesh, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{
    add, balls_with_proxies, gpus, look_at, perspective, stage_with, views, vulkan,
};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 120];

fn camera(eye: DVec3) -> Camera {
    look_at(eye, eye + DVec3::NEG_Z, perspective(1.0, 0.1))
}

/// Spheres with proxies, 7 along a side.
fn balls(gpu: &Gpu) -> GpuScene {
    GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap()
}

/// The verdicts of the fifth frame of a still scene.
fn settled(scene: &GpuScene, text: &str, camera: Camera) -> Verdicts {
    antumbra_testing::settled(scene, text, camera, SIZE, 5).verdicts
}

/// A sphere whose proxy is a fifth of a metre too large, and a small sphere behind it, which is visible beside the mesh and hidden behind the proxy.
/// Everything is scaled by `scale`.
fn eclipse(scale: f64) -> (Scene, EntityKey, EntityKey) {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let mut too_large = Mesh::new("too large", icosphere(4, 1.0));
    too_large.proxy = Some(icosphere(4, 1.2));
    let meshes = [too_large, Mesh::new("small", icosphere(3, 0.2))];
    let places = [DVec3::new(0.0, 0.0, -5.0), DVec3::new(2.2, 0.0, -10.0)];
    let mut keys = Vec::new();
    for (mesh, place) in meshes.into_iter().zip(places) {
        let mesh = scene.add_mesh(mesh).unwrap();
        let place = DAffine3::from_scale(DVec3::splat(scale)) * DAffine3::from_translation(place);
        keys.push(add(&mut scene, place, Drawable { mesh, material }));
    }
    (scene, keys[0], keys[1])
}

#[test]
fn no_stand_in_hides_where_its_deviation_shows() {
    for gpu in gpus() {
        let adapter = gpu.title();
        for scale in [1.0, 100.0] {
            let (mut scene, large, small) = eclipse(scale);
            let scene = GpuScene::new(gpu, &mut scene).unwrap();
            let [large, small] = [large, small].map(|key| scene.slot(key).unwrap());
            let off = f64::from(scene.table().deviation(large));
            assert!((off - 0.2 * scale).abs() < 0.02 * scale, "{off} at {scale}");
            assert_eq!(scene.table().deviation(small), 0.0);
            // A fifth of a metre at 3.8 metres, of 110 pixels a metre at one metre: 5.8 pixels.
            for (deviation, drawn) in [("any", false), ("8", false), ("4", true), ("0", true)] {
                for latency in ["same-frame", "frame-late", "on-gpu"] {
                    for counting in ["auto", "atomics", "compare", "queries"] {
                        let text = format!(
                            "three-pass:latency={latency}:counting={counting}:deviation={deviation}:threshold=0:scale=1"
                        );
                        let verdicts = settled(&scene, &text, camera(DVec3::ZERO));
                        assert!(verdicts.get(large).draws(), "{text}: the sphere is lost");
                        assert_eq!(verdicts.get(small).draws(), drawn, "{text} on {adapter}");
                    }
                }
            }
        }
    }
}

#[test]
fn in_every_latency_as_much_is_left_out_as_is_allowed() {
    let scene = balls(vulkan());
    let camera = camera(DVec3::new(0.4, 0.3, 9.0));
    let all = |allow: &str| {
        let texts = ["same-frame", "frame-late", "on-gpu"]
            .map(|latency| format!("three-pass:latency={latency}:threshold=0:allow={allow}"));
        texts.map(|text| settled(&scene, &text, camera).drawn().count())
    };
    let exact = all("0");
    let less = all("5");
    assert_eq!(exact, [exact[0]; 3]);
    assert_eq!(less, [less[0]; 3]);
    assert!(less[0] + 5 < exact[0], "{} of {}", less[0], exact[0]);
}

/// The slots drawn in a frame.
type Drawn = Vec<u32>;
/// A frame, and the part of the image it left out, in percent, as far as its audit knows.
type LeftOut = (u64, Option<f64>);

/// Renders eight frames from places far apart. Returns what each drew and what each left out.
fn leaping(scene: &GpuScene, text: &str) -> (Vec<Drawn>, Vec<LeftOut>) {
    let strategy = registry().parse(text).unwrap();
    let options = StageOptions {
        audit: Some(AuditOptions {
            // On the GPU the part left out is known of audited frames only.
            frame_share: 1.0,
            ..AuditOptions::default()
        }),
        ..StageOptions::default()
    };
    let mut stage = stage_with(scene, strategy, views(&["main"], SIZE), options);
    let mut drawn = Vec::new();
    for frame in 0..8 {
        let eye = DVec3::new(f64::from(frame % 3) - 1.0, 0.3, 11.0 - f64::from(frame));
        stage.frame(scene, &[ViewInput::new(camera(eye))]).unwrap();
        scene.gpu().wait().unwrap();
        drawn.push(stage.verdicts(0, scene).unwrap().drawn().collect());
    }
    let audit = stage.audit(0).unwrap();
    let left_out = audit.frames();
    let left_out = left_out.map(|found| (found.frame, found.left_out_percent()));
    (drawn, left_out.collect())
}

#[test]
fn the_gpu_turns_each_frames_threshold_as_the_host_does() {
    for gpu in gpus() {
        let adapter = gpu.title();
        let scene = balls(gpu);
        let mut fewest = usize::MAX;
        for settings in [
            "threshold=0:allow=0.000000001",
            "threshold=0:allow=0.2",
            "threshold=0:allow=5",
            "threshold=12:allow=0.2",
            "threshold=12:allow=5:coarser=80",
            "threshold=5000:allow=5",
            "threshold=0:allow=100",
        ] {
            let [host, on_gpu] = ["same-frame", "on-gpu"].map(|latency| {
                leaping(&scene, &format!("three-pass:latency={latency}:{settings}"))
            });
            assert_eq!(host.0, on_gpu.0, "{settings} on {adapter}: who is drawn");
            for known in &on_gpu.1 {
                let same = host.1.iter().find(|(frame, _)| *frame == known.0);
                let (Some(ours), Some(theirs)) = (known.1, same.and_then(|same| same.1)) else {
                    panic!(
                        "{settings} on {adapter}: nothing is known of frame {}",
                        known.0
                    );
                };
                assert!(
                    (ours - theirs).abs() < 1e-9,
                    "{settings} on {adapter}: {ours}, {theirs}"
                );
            }
            assert!(on_gpu.1.len() >= 5, "{:?}", on_gpu.1);
            fewest = fewest.min(host.0.iter().map(Vec::len).min().unwrap_or(0));
        }
        assert!(
            fewest < 20,
            "{fewest} are drawn with all that may be left out"
        );
    }
}
