//! A stage that is asked for answers alone chooses what one chooses that makes an image, says what that is, and shades nothing.
#![allow(clippy::unwrap_used, clippy::panic)]

use antumbra_cull::{
    AdapterChoice, Draws, Gpu, Stage, StageOptions, StageOutput, Verdict, ViewInput, ViewSpec,
};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{AlphaMode, Material, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{add, balls, cuboid, drawable, glass, look_at, perspective, placed, vulkan};
use glam::DVec3;

const SIZE: [u32; 2] = [160, 120];

/// Strategies that may run in a host's frame, with what their depth decides.
const STRATEGIES: [&str; 8] = [
    "frustum",
    "three-pass:latency=frame-late:threshold=0",
    "three-pass:latency=frame-late:threshold=0:occludees=box:occluders=full",
    "three-pass:latency=on-gpu:threshold=0:scale=1:occluders=full:occludees=full",
    "coherent:latency=on-gpu",
    "coherent:latency=frame-late",
    "occupancy-map:latency=frame-late",
    "stereo-coherent:latency=on-gpu",
];

fn options(output: StageOutput) -> StageOptions {
    StageOptions {
        mode: Mode::Embedded,
        output,
        ..StageOptions::default()
    }
}

fn stage(scene: &GpuScene, strategy: &str, options: StageOptions) -> Stage {
    let views = vec![ViewSpec::main(SIZE[0], SIZE[1])];
    Stage::new(scene, registry().parse(strategy).unwrap(), views, options).unwrap()
}

/// Plays a slow flight; returns the verdicts' slots that are drawn, frame by frame, and the stage.
fn flight(gpu: &Gpu, scene: &GpuScene, mut stage: Stage, owned: bool) -> (Vec<Vec<u32>>, Stage) {
    let mut drawn = Vec::new();
    for frame in 0..6 {
        let angle = f64::from(frame) * 0.01;
        let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * 9.0;
        let view = ViewInput::new(look_at(eye, DVec3::ZERO, perspective(0.8, 0.05)));
        if owned {
            stage.frame(scene, &[view]).unwrap();
        } else {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            stage.record(scene, &[view], &mut encoder).unwrap();
            gpu.queue.submit([encoder.finish()]);
        }
        gpu.wait().unwrap();
        drawn.push(stage.verdicts(0, scene).unwrap().drawn().collect());
    }
    (drawn, stage)
}

/// What the draws of a view draw, in ascending order.
fn listed(gpu: &Gpu, stage: &Stage) -> Vec<u32> {
    let words = |buffer: &wgpu::Buffer| -> Vec<u32> {
        let bytes = antumbra_cull::read_back::buffer(gpu, buffer).unwrap();
        let words = bytes.chunks_exact(4);
        words
            .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
            .collect()
    };
    let mut found = Vec::new();
    for draws in stage.draws(0) {
        match draws {
            Draws::List { list, slots } => {
                let entries = list.slots();
                assert_eq!(&words(slots)[..entries.len()], entries);
                found.extend_from_slice(entries);
            }
            Draws::Indirect {
                layout,
                slots,
                draws,
            } => {
                let (slots, draws) = (words(slots), words(draws));
                for (draw, run) in draws.chunks_exact(5).zip(layout.runs()) {
                    let [count, first] = [draw[1] as usize, draw[4] as usize];
                    assert_eq!(first, run.first as usize);
                    found.extend_from_slice(&slots[first..first + count]);
                }
            }
        }
    }
    found.sort_unstable();
    found
}

#[test]
fn answers_are_those_of_a_stage_that_makes_an_image() {
    for name in ["vulkan", "gl"] {
        // A device of its own: on a shared one, another test's wait may still be delivering this one's answers when the next frame begins.
        let gpu = &Gpu::open(&AdapterChoice::Named(name.to_owned())).unwrap();
        let mut host: Scene = balls(6);
        host.ensure_proxies(&Default::default());
        let scene = GpuScene::new(gpu, &mut host).unwrap();
        for strategy in STRATEGIES {
            let image = StageOptions {
                mode: Mode::Owned,
                ..options(StageOutput::Image)
            };
            let (expected, _) = flight(gpu, &scene, stage(&scene, strategy, image), true);
            let asked = stage(&scene, strategy, options(StageOutput::Answers));
            let (found, asked) = flight(gpu, &scene, asked, false);
            assert_eq!(found, expected, "{strategy}");
            // A tie may be shaded twice: once as seen in the last frame, once as found in this.
            let mut listed = listed(gpu, &asked);
            listed.dedup();
            assert_eq!(Some(&listed), found.last(), "{strategy}");
            assert!(
                strategy == "frustum" || listed.len() < 200,
                "{strategy}: {}",
                listed.len()
            );
            // Only those that test against what they have drawn draw anything.
            let draws = strategy.starts_with("coherent")
                || strategy.starts_with("stereo")
                || strategy.starts_with("occupancy");
            let passes = asked.plan().passes();
            let shades = passes.iter().any(|pass| pass.name.starts_with("shade"));
            assert_eq!(shades, draws, "{strategy}");
        }
    }
}

/// Three balls behind a pane.
fn behind(pane: Material) -> Scene {
    let mut scene = Scene::new();
    let pane = drawable(&mut scene, "pane", cuboid(DVec3::new(5.0, 5.0, 0.1)), pane);
    add(&mut scene, placed(DVec3::Z * 3.0, DVec3::ONE), pane);
    let ball = icosphere(2, 0.4);
    let ball = drawable(&mut scene, "ball", ball, Material::default());
    for x in [-1.0, 0.0, 1.0] {
        add(&mut scene, placed(DVec3::X * x, DVec3::ONE), ball);
    }
    scene
}

#[test]
fn what_can_be_seen_through_hides_nothing_in_answers() {
    let masked = Material {
        alpha: AlphaMode::Mask { cutoff: 0.5 },
        base_colour: [1.0, 1.0, 1.0, 0.2],
        ..Material::default()
    };
    for (pane, hides) in [
        (Material::default(), true),
        (glass([0.2, 0.4, 0.9, 0.5]), false),
        (masked, false),
    ] {
        let mut host = behind(pane);
        host.ensure_proxies(&Default::default());
        let scene = GpuScene::new(vulkan(), &mut host).unwrap();
        for strategy in &STRATEGIES[1..] {
            let asked = stage(&scene, strategy, options(StageOutput::Answers));
            let (found, asked) = flight(vulkan(), &scene, asked, false);
            let mut listed = listed(vulkan(), &asked);
            listed.dedup();
            assert_eq!(Some(&listed), found.last(), "{strategy}");
            let verdicts = asked.verdicts(0, &scene).unwrap();
            let occluded = verdicts.of_kind(Verdict::Occluded).count();
            assert_eq!(occluded, if hides { 3 } else { 0 }, "{strategy}");
        }
    }
}

#[test]
fn a_strategy_that_draws_step_by_step_is_refused() {
    let mut host = balls(2);
    let scene = GpuScene::new(vulkan(), &mut host).unwrap();
    let strategy = registry().parse("stop-and-wait").unwrap();
    let owned = StageOptions {
        mode: Mode::Owned,
        ..options(StageOutput::Answers)
    };
    let views = vec![ViewSpec::main(SIZE[0], SIZE[1])];
    let error = Stage::new(&scene, strategy, views, owned)
        .map(|_| ())
        .unwrap_err();
    assert!(error.to_string().contains("step by step"), "{error}");
}
