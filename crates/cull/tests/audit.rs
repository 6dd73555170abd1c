//! The audit against the oracle: a census finds the oracle's numbers, samples are unbiased and their intervals hold as often as they
//! claim, and an audit does not change what a strategy draws.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{
    AUDIT, AuditOptions, DeclareError, Estimate, FrameAudit, FrameGraph, Gpu, Stage, StageOptions,
    StageOutput, Strategy, Verdict, ViewInput, ViewNodes, VisibleSet, read_back,
};
use antumbra_draw::GpuScene;
use antumbra_graph::Mode;
use antumbra_scene::{
    AlphaMode, Camera, Drawable, Geometry, Material, Mesh, Scene, Topology, icosphere,
};
use antumbra_strategies::registry;
use antumbra_testing::{
    HostTargets, add, balls_with_proxies, gl, glass, gpus, holes, look_at, perspective, stage_with,
    views, vulkan, wrong_pixels_percent,
};
use antumbra_verify::Oracle;
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [150, 110];

/// A camera path around the scene and into it, one step a frame.
fn camera(frame: u32, reach: f64) -> Camera {
    let angle = f64::from(frame) * 0.05;
    let eye = DVec3::new(angle.cos(), 0.2, angle.sin()) * reach * (1.2 + 0.5 * (angle * 3.0).sin());
    look_at(eye, DVec3::ZERO, perspective(0.9, 0.05))
}

fn named(strategy: &str) -> Box<dyn Strategy> {
    registry().parse(strategy).unwrap()
}

/// A flight along the path.
#[derive(Clone, Copy)]
struct Flight {
    frames: u32,
    /// The distance from the middle, as a part of the path's.
    reach: f64,
    /// Samples a pixel.
    samples: u32,
}

impl Flight {
    /// With one sample a pixel.
    fn of(frames: u32, reach: f64) -> Self {
        Self {
            frames,
            reach,
            samples: 1,
        }
    }
}

/// Flies along the path. Calls back with the audit of each frame as soon as it is known, and with the oracle's wrong pixels in percent.
fn fly(
    scene: &GpuScene,
    strategy: Box<dyn Strategy>,
    audit: AuditOptions,
    Flight {
        frames,
        reach,
        samples,
    }: Flight,
    mut known: impl FnMut(&FrameAudit, f64),
) {
    let options = StageOptions {
        audit: Some(audit),
        samples,
        ..StageOptions::default()
    };
    let mut stage = stage_with(scene, strategy, views(&["main"], SIZE), options);
    let mut oracle = Oracle::new(scene, SIZE).with_samples(samples);
    let mut truths = Vec::new();
    let mut taken = 0;
    for frame in 0..frames {
        let camera = camera(frame, reach);
        stage.frame(scene, &[ViewInput::new(camera)]).unwrap();
        scene.gpu().wait().unwrap();
        let verdicts = stage.verdicts(0, scene).unwrap();
        truths.push(wrong_pixels_percent(&mut oracle, scene, &camera, &verdicts));
        let audit = stage.audit(0).unwrap();
        let fresh = (audit.audited() - taken) as usize;
        taken = audit.audited();
        for found in audit.frames().rev().take(fresh) {
            known(found, truths[found.frame as usize]);
        }
    }
    assert!(taken + 3 >= u64::from(frames), "{taken} of {frames}");
}

const CENSUS: AuditOptions = AuditOptions {
    share: 0.02,
    frame_share: 1.0,
    seed: 0,
    census: true,
};

/// Every aggressive strategy, in each latency.
const AGGRESSIVE: [&str; 8] = [
    "three-pass",
    "three-pass:latency=same-frame:threshold=20",
    "three-pass:latency=on-gpu:threshold=20",
    "three-pass:latency=on-gpu:threshold=5:allow=2",
    "occupancy-map:latency=frame-late",
    "coherent:latency=frame-late:fraction=0.3",
    "coherent:latency=same-frame:fraction=0.5",
    "stereo-coherent:latency=frame-late",
];

#[test]
fn a_census_counts_what_the_oracle_counts() {
    for gpu in gpus() {
        let adapter = gpu.title();
        let mut scene = balls_with_proxies(7);
        let scene = GpuScene::new(gpu, &mut scene).unwrap();
        let mut wrong_somewhere = 0;
        // OpenGL cannot read the samples of what was drawn.
        let samples = if gpu.reads_drawn_samples() { 4 } else { 1 };
        let plain = AGGRESSIVE.map(|strategy| (strategy, 1));
        let sampled = AGGRESSIVE.map(|strategy| (strategy, samples));
        for (strategy, samples) in plain.into_iter().chain(sampled) {
            let flight = Flight {
                samples,
                ..Flight::of(16, 9.0)
            };
            fly(&scene, named(strategy), CENSUS, flight, |found, truth| {
                let all = found.wrong_pixels_percent();
                assert!(
                    all.holds(truth),
                    "{strategy} on {adapter}, {samples} samples a pixel, frame {}: {all:?}, and {truth} % are wrong",
                    found.frame
                );
                wrong_somewhere += u32::from(truth > 0.0);
            });
        }
        assert!(wrong_somewhere > 30, "{wrong_somewhere} frames with errors");
    }
}

#[test]
fn answers_alone_are_audited_by_what_the_host_gave() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    let options = StageOptions {
        mode: Mode::Embedded,
        output: StageOutput::Answers,
        audit: Some(CENSUS),
        ..StageOptions::default()
    };
    let mut wrong_somewhere = 0;
    for strategy in AGGRESSIVE
        .iter()
        .filter(|text| !text.contains("same-frame"))
    {
        let mut stage = stage_with(
            &scene,
            named(strategy),
            views(&["main"], SIZE),
            options.clone(),
        );
        let mut oracle = Oracle::new(&scene, SIZE);
        let mut truths = Vec::new();
        for frame in 0..12 {
            let camera = camera(frame, 9.0);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            stage
                .record(&scene, &[ViewInput::new(camera)], &mut encoder)
                .unwrap();
            gpu.queue.submit([encoder.finish()]);
            gpu.wait().unwrap();
            let verdicts = stage.verdicts(0, &scene).unwrap();
            truths.push(wrong_pixels_percent(
                &mut oracle,
                &scene,
                &camera,
                &verdicts,
            ));
        }
        let audit = stage.audit(0).unwrap();
        assert!(audit.audited() >= 9, "{strategy}: {}", audit.audited());
        for found in audit.frames() {
            let truth = truths[found.frame as usize];
            let said = found.wrong_pixels_percent();
            assert!(
                said.holds(truth),
                "{strategy}, frame {}: {said:?}, not {truth}",
                found.frame
            );
            wrong_somewhere += u32::from(truth > 0.0);
        }
    }
    assert!(wrong_somewhere > 10, "{wrong_somewhere} frames with errors");
}

#[test]
fn an_audit_of_several_samples_is_refused_where_they_cannot_be_read() {
    let gpu = gl();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(2)).unwrap();
    let options = StageOptions {
        audit: Some(CENSUS),
        samples: 4,
        ..StageOptions::default()
    };
    let views = views(&["main"], SIZE);
    let error = Stage::new(&scene, named("frustum"), views, options).map(|_| ());
    let said = error.unwrap_err().to_string();
    assert!(said.contains("samples of `main depth`"), "{said}");
}

/// Culls every third entity, and no other.
struct Thirds;

impl Strategy for Thirds {
    fn name(&self) -> &str {
        "thirds"
    }

    fn summary(&self) -> &str {
        "leaves out every third entity"
    }

    fn conservative(&self) -> bool {
        false
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let candidates = g.in_frustum(view);
        Ok(g.visible_by(view, candidates, |_, _, slot| match slot % 3 {
            0 => Verdict::Occluded,
            _ => Verdict::Visible,
        }))
    }
}

/// Solid, transparent, alpha-masked and mirrored spheres, and points.
fn mixed() -> Scene {
    let mut scene = Scene::new();
    let sphere = scene
        .add_mesh(Mesh::new("sphere", icosphere(2, 0.7)))
        .unwrap();
    let points = Geometry {
        topology: Topology::Points,
        positions: (0..60)
            .map(|i| [(i % 8) as f32 * 0.1, (i / 8) as f32 * 0.1, 0.0])
            .collect(),
        indices: (0..60).collect(),
        ..Geometry::default()
    };
    let points = scene.add_mesh(Mesh::new("points", points)).unwrap();
    let image = scene.add_image(holes()).unwrap();
    let materials = [
        Material::default(),
        glass([1.0, 1.0, 1.0, 0.5]),
        Material {
            alpha: AlphaMode::Mask { cutoff: 0.5 },
            base_colour_image: Some(image),
            ..Material::default()
        },
    ]
    .map(|material| scene.add_material(material));
    for number in 0..250 {
        let [x, y, z] = [number % 7, number / 7 % 6, number / 42].map(|i| f64::from(i) - 3.0);
        let shift = DVec3::new((y * 3.7).sin(), (z * 2.9).sin(), (x * 5.3).sin()) * 0.3;
        let scale = DVec3::new(if number % 2 == 0 { 1.0 } else { -1.0 }, 1.0, 1.0);
        let place = DAffine3::from_scale_rotation_translation(
            scale,
            glam::DQuat::from_rotation_y(x),
            DVec3::new(x, y, z) * 1.4 + shift,
        );
        let mesh = if number % 11 == 0 { points } else { sphere };
        let material = materials[number as usize % materials.len()];
        add(&mut scene, place, Drawable { mesh, material });
    }
    scene
}

#[test]
fn glass_holes_points_and_mirrored_meshes_are_audited_as_they_are_drawn() {
    for gpu in gpus() {
        let adapter = gpu.title();
        let scene = GpuScene::new(gpu, &mut mixed()).unwrap();
        fly(
            &scene,
            Box::new(Thirds),
            CENSUS,
            Flight::of(10, 7.0),
            |found, truth| {
                assert!(truth > 5.0, "frame {}: {truth} % are wrong", found.frame);
                let all = found.wrong_pixels_percent();
                assert!(
                    all.holds(truth),
                    "{adapter}, frame {}: {all:?}, not {truth}",
                    found.frame
                );
            },
        );
    }
}

#[test]
fn lots_are_right_on_average() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    // Nothing moves: one reference is enough, and many samples are cheap.
    let camera = camera(9, 9.0);
    let mut oracle = Oracle::new(&scene, SIZE);
    for strategy in [
        "three-pass:latency=same-frame:threshold=20",
        "three-pass:latency=on-gpu:threshold=20",
    ] {
        let options = StageOptions {
            audit: Some(AuditOptions {
                share: 0.5,
                seed: 23,
                ..AuditOptions::default()
            }),
            ..StageOptions::default()
        };
        let mut stage = stage_with(&scene, named(strategy), views(&["main"], SIZE), options);
        let frames = 1_500;
        for _ in 0..frames {
            stage.frame(&scene, &[ViewInput::new(camera)]).unwrap();
            gpu.wait().unwrap();
        }
        let verdicts = stage.verdicts(0, &scene).unwrap();
        let truth = wrong_pixels_percent(&mut oracle, &scene, &camera, &verdicts);
        let audit = stage.audit(0).unwrap();
        let found: Vec<f64> = audit
            .frames()
            .map(|frame| frame.wrong_pixels_percent().percent)
            .collect();
        let number = found.len() as f64;
        let mean = found.iter().sum::<f64>() / number;
        let squares: f64 = found.iter().map(|one| (one - mean).powi(2)).sum();
        let error = squares.sqrt() / number;
        println!("{strategy}: {mean:.4} +- {error:.4} of {truth:.4} %");
        assert!(
            truth > 1.0 && error < 0.1 * truth,
            "{strategy}: {truth} +- {error}"
        );
        assert!(
            (mean - truth).abs() < 4.0 * error,
            "{strategy}: {mean} +- {error}, not {truth}"
        );
        let all = audit.over(usize::MAX);
        assert!(
            all.holds(truth) && all.high < 2.0 * truth,
            "{strategy}: {all:?}, not {truth}"
        );
    }
}

#[test]
fn the_truth_lies_within_the_interval_as_often_as_it_says() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    for (strategy, often) in [
        ("three-pass", 1.0),
        ("three-pass", 0.25),
        ("three-pass:latency=on-gpu:threshold=20", 0.5),
    ] {
        let audit = AuditOptions {
            share: 0.5,
            frame_share: often,
            seed: 11,
            ..AuditOptions::default()
        };
        let (mut frames, mut held, mut wrong) = (0, 0, 0);
        fly(
            &scene,
            named(strategy),
            audit,
            Flight::of(160, 9.0),
            |found, truth| {
                frames += 1;
                held += u32::from(found.wrong_pixels_percent().holds(truth));
                wrong += u32::from(truth > 0.0);
            },
        );
        let least = Estimate::CONFIDENCE * f64::from(frames);
        assert!(
            f64::from(held) >= least,
            "{strategy}: {held} of {frames} held"
        );
        assert!(wrong * 2 > frames, "{strategy}: {wrong} of {frames} wrong");
    }
}

#[test]
fn an_audit_changes_nothing_that_is_drawn_and_is_not_there_unless_asked_for() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut mixed()).unwrap();
    let picture = |audit: Option<AuditOptions>| {
        let options = StageOptions {
            audit,
            ..StageOptions::default()
        };
        let mut stage = stage_with(&scene, Box::new(Thirds), views(&["main"], SIZE), options);
        for frame in 0..3 {
            stage
                .frame(&scene, &[ViewInput::new(camera(frame, 7.0))])
                .unwrap();
        }
        let audits = stage
            .plan()
            .passes()
            .into_iter()
            .filter(|pass| pass.group == Some(AUDIT))
            .count();
        assert_eq!(stage.audit(0).is_some(), audit.is_some());
        let pixels = read_back::texture(gpu, stage.colour(0).unwrap()).unwrap();
        (pixels, audits)
    };
    let (plain, none) = picture(None);
    let (audited, some) = picture(Some(AuditOptions::default()));
    assert_eq!((none, some > 0), (0, true));
    assert!(plain == audited, "the images differ");
}

#[test]
fn the_same_seed_draws_the_same_lots() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(6)).unwrap();
    let found = |seed| {
        let audit = AuditOptions {
            share: 0.2,
            seed,
            ..AuditOptions::default()
        };
        let mut all = Vec::new();
        fly(
            &scene,
            Box::new(Thirds),
            audit,
            Flight::of(12, 8.0),
            |found, _| all.push(found.clone()),
        );
        all
    };
    assert_eq!(found(3), found(3));
    assert_ne!(found(3), found(4));
}

/// The targets of a host. An audit samples the depth.
fn theirs(gpu: &Gpu, format: wgpu::TextureFormat) -> HostTargets {
    HostTargets::new(gpu, SIZE, format, wgpu::TextureUsages::TEXTURE_BINDING)
}

/// Fills the host's depth with one value.
fn clear(encoder: &mut wgpu::CommandEncoder, depth: &wgpu::Texture, to: f32) {
    let view = depth.create_view(&Default::default());
    drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(to),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    }));
}

#[test]
fn a_frame_inside_somebody_elses_is_audited_against_their_depth() {
    let gpu = vulkan();
    let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
    let options = StageOptions {
        mode: Mode::Embedded,
        audit: Some(CENSUS),
        ..StageOptions::default()
    };
    let targets = theirs(gpu, options.colour_format);
    let mut stage = stage_with(&scene, Box::new(Thirds), views(&["main"], SIZE), options);
    let mut oracle = Oracle::new(&scene, SIZE);
    let camera = camera(4, 9.0);
    // At first the host draws nothing; then it draws a wall right in front of the camera, behind which no pixel can be wrong.
    for (wall, hidden) in [(0.0, false), (1.0, true)] {
        for _ in 0..4 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            clear(&mut encoder, &targets.depth, wall);
            let input = ViewInput {
                targets: Some(targets.imported()),
                ..ViewInput::new(camera)
            };
            stage.record(&scene, &[input], &mut encoder).unwrap();
            gpu.queue.submit([encoder.finish()]);
            gpu.wait().unwrap();
        }
        let verdicts = stage.verdicts(0, &scene).unwrap();
        let truth = match hidden {
            true => 0.0,
            false => wrong_pixels_percent(&mut oracle, &scene, &camera, &verdicts),
        };
        assert!(hidden || truth > 5.0, "{truth}");
        let found = stage.audit(0).unwrap().latest().unwrap();
        let found = found.wrong_pixels_percent();
        assert!(found.holds(truth), "{found:?}, not {truth}");
    }
}

/// The number of patches that a frame samples once their cost is known. `wall` is the host's depth: 0 for none, 1 for a wall in front of
/// the scene, which is no entity.
fn patches_a_frame(scene: &GpuScene, strategy: Box<dyn Strategy>, wall: f32) -> f64 {
    let gpu = scene.gpu();
    let options = StageOptions {
        mode: Mode::Embedded,
        audit: Some(AuditOptions {
            share: 0.1,
            frame_share: 1.0,
            ..AuditOptions::default()
        }),
        ..StageOptions::default()
    };
    let targets = theirs(gpu, options.colour_format);
    let mut stage = stage_with(scene, strategy, views(&["main"], SIZE), options);
    for _ in 0..120 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        clear(&mut encoder, &targets.depth, wall);
        let input = ViewInput {
            targets: Some(targets.imported()),
            ..ViewInput::new(camera(4, 9.0))
        };
        stage.record(scene, &[input], &mut encoder).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.wait().unwrap();
    }
    let audit = stage.audit(0).unwrap();
    let late = audit.frames().rev().take(60);
    late.map(|frame| f64::from(frame.patches)).sum::<f64>() / 60.0
}

#[test]
fn what_the_depth_hides_is_not_drawn_again() {
    let [vulkan, gl] = gpus();
    for (gpu, on_gpu) in [(vulkan, false), (vulkan, true), (gl, true)] {
        let scene = GpuScene::new(gpu, &mut balls_with_proxies(7)).unwrap();
        let strategy = || match on_gpu {
            true => named("three-pass:latency=on-gpu:threshold=20"),
            false => Box::new(Thirds),
        };
        let open = patches_a_frame(&scene, strategy(), 0.0);
        let hidden = patches_a_frame(&scene, strategy(), 1.0);
        assert!(
            hidden > 3.0 * open,
            "{}: {hidden} patches behind a wall, {open} without",
            gpu.title()
        );
    }
}
