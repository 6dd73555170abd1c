//! The trip-wire: an audit that finds a wrong pixel of a conservative strategy.

use antumbra_cull::{
    AuditOptions, DistrustCause, DistrustOptions, Gpu, Instead, Rebuilt, Stage, StageOptions,
    ViewInput,
};
use antumbra_draw::GpuScene;
use antumbra_scene::Camera;
use antumbra_strategies::registry;
use antumbra_testing::{
    balls_with_proxies, gpus, look_at, perspective, stage_with, views, wrong_pixels_percent,
};
use antumbra_verify::Oracle;
use glam::DVec3;

use crate::faults::{
    Fault, LOST_COUNT, LOST_FIND, LOST_HISTOGRAM, OTHER_LEVEL, SHIFTED_LEVEL, STALE_LEVEL,
    ZEROED_BOX_QUERY, ZEROED_MESH_QUERY,
};

pub const SIZE: [u32; 2] = [120, 90];

/// A camera path around the scene and into it, one step a frame.
pub fn camera(frame: u32, reach: f64) -> Camera {
    let angle = f64::from(frame) * 0.05;
    let eye = DVec3::new(angle.cos(), 0.2, angle.sin()) * reach * (1.2 + 0.5 * (angle * 3.0).sin());
    look_at(eye, DVec3::ZERO, perspective(0.9, 0.05))
}

/// Frames within which a fault must be found.
const FRAMES: u32 = 60;

/// A stage that audits itself, and believes the driver when it is made.
fn audited(scene: &GpuScene, strategy: &str, audit: AuditOptions) -> Stage {
    let options = StageOptions {
        audit: Some(audit),
        distrust: DistrustOptions {
            self_test: false,
            trip_wire: true,
        },
        ..StageOptions::default()
    };
    let strategy = registry().parse(strategy).unwrap();
    stage_with(scene, strategy, views(&["main"], SIZE), options)
}

fn scene_on(gpu: &Gpu) -> GpuScene {
    GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap()
}

/// Plays frames until the stage falls back; the number of frames.
fn frames_until_fallback(stage: &mut Stage, scene: &GpuScene) -> Option<u32> {
    (0..FRAMES).find(|number| {
        stage
            .frame(scene, &[ViewInput::new(camera(*number, 9.0))])
            .unwrap();
        scene.gpu().wait().unwrap();
        !stage.distrust().is_empty()
    })
}

const EXACT: &str = "three-pass:threshold=0:scale=1:occluders=full:occludees=full:latency";

/// Faults that a right self-test would have found, with a strategy that relies on what they break.
fn cases() -> [(Fault, String); 9] {
    [
        (LOST_COUNT, format!("{EXACT}=same-frame:counting=atomics")),
        (LOST_COUNT, format!("{EXACT}=on-gpu:counting=atomics")),
        (LOST_HISTOGRAM, format!("{EXACT}=on-gpu:counting=identity")),
        (LOST_FIND, "depth-pyramid".to_owned()),
        (STALE_LEVEL, "depth-pyramid".to_owned()),
        (SHIFTED_LEVEL, "depth-pyramid".to_owned()),
        (OTHER_LEVEL, "depth-pyramid".to_owned()),
        (
            ZEROED_BOX_QUERY,
            "occupancy-map:latency=same-frame".to_owned(),
        ),
        (
            ZEROED_MESH_QUERY,
            format!("{EXACT}=same-frame:counting=queries"),
        ),
    ]
}

#[test]
fn each_fault_trips_within_sixty_frames_and_frustum_draws_what_is_visible() {
    for gpu in gpus() {
        let right = scene_on(gpu);
        let mut oracle = Oracle::new(&right, SIZE);
        for (fault, strategy) in cases() {
            let at = format!("{strategy} with {} on {}", fault.name, gpu.title());
            let scene = scene_on(&fault.on(gpu));
            let mut stage = audited(&scene, &strategy, AuditOptions::default());
            let frames = frames_until_fallback(&mut stage, &scene);
            let frames = frames.unwrap_or_else(|| panic!("{at}: nothing found"));
            println!("{at}: after {} frames", frames + 1);
            let [found] = stage.distrust() else {
                panic!("{at}: {:?}", stage.distrust());
            };
            assert_eq!(found.instead, Instead::Frustum, "{at}");
            assert!(strategy.starts_with(&found.strategy), "{at}");
            assert!(found.to_string().contains("an audit of frame"), "{found}");
            let DistrustCause::Audit { frame, view, .. } = &found.cause else {
                panic!("{at}: {found}");
            };
            assert_eq!(view, "main");
            assert!(*frame < found.from_frame, "{found}");
            // The next frame is right already.
            let last = camera(frames + 1, 9.0);
            let report = stage.frame(&scene, &[ViewInput::new(last)]).unwrap();
            assert_eq!(report.rebuilt, Some(Rebuilt::Distrust), "{at}");
            assert_eq!(report.frame, stage.distrust()[0].from_frame);
            assert_eq!(stage.strategy().name(), "frustum");
            let verdicts = stage.verdicts(0, &scene).unwrap();
            assert_eq!(
                wrong_pixels_percent(&mut oracle, &right, &last, &verdicts),
                0.0,
                "{at}"
            );
        }
    }
}

/// Strategies that err without a fault of the driver: aggressive ones, and answers that are a frame late while the camera moves.
const MAY_ERR: [&str; 4] = [
    "three-pass",
    "three-pass:latency=on-gpu:threshold=20",
    "occupancy-map:latency=frame-late",
    "coherent:latency=frame-late:fraction=0.3",
];

#[test]
fn what_may_err_trips_nothing() {
    let census = AuditOptions {
        census: true,
        ..AuditOptions::default()
    };
    for gpu in gpus() {
        let scene = scene_on(gpu);
        for strategy in MAY_ERR {
            let mut stage = audited(&scene, strategy, census);
            for number in 0..30 {
                stage
                    .frame(&scene, &[ViewInput::new(camera(number, 9.0))])
                    .unwrap();
                gpu.wait().unwrap();
            }
            let erred = stage
                .audit(0)
                .unwrap()
                .frames()
                .any(|frame| frame.found_any());
            assert!(erred, "{strategy} on {} has no error to find", gpu.title());
            assert_eq!(stage.distrust(), [], "{strategy} on {}", gpu.title());
        }
    }
}

#[test]
fn a_wire_that_is_turned_off_trips_at_nothing() {
    for gpu in gpus() {
        let scene = scene_on(&LOST_FIND.on(gpu));
        let options = StageOptions {
            audit: Some(AuditOptions {
                census: true,
                ..AuditOptions::default()
            }),
            distrust: DistrustOptions::OFF,
            ..StageOptions::default()
        };
        let strategy = registry().parse("depth-pyramid").unwrap();
        let mut stage = stage_with(&scene, strategy, views(&["main"], SIZE), options);
        assert_eq!(frames_until_fallback(&mut stage, &scene), None);
        assert!(
            stage
                .audit(0)
                .unwrap()
                .frames()
                .any(|frame| frame.found_any())
        );
        assert_eq!(stage.strategy().name(), "depth-pyramid");
    }
}
