//! No false alarm: conservative strategies on right drivers, with moving cameras and moving scenes. A short run has a few hundred frames; DISTRUST_FRAMES in the
//! environment says how many.

use antumbra_cull::{AuditOptions, StageOptions, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_scene::{AlphaMode, Drawable, EntityKey, Material, Mesh, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{
    add, balls_with_proxies, cuboid, glass, gpus, holes, look_at, perspective, stage_with, views,
};
use glam::{DAffine3, DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

const SIZE: [u32; 2] = [64, 48];

/// Strategies that promise all pixels.
const CONSERVATIVE: [&str; 7] = [
    "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full",
    "three-pass:latency=on-gpu:threshold=0:scale=1:occluders=full:occludees=full:counting=atomics",
    "three-pass:latency=on-gpu:threshold=0:scale=1:occluders=full:occludees=full:counting=queries",
    "occupancy-map:latency=same-frame",
    "depth-pyramid",
    "coherent:latency=on-gpu:fraction=1",
    "coherent:latency=same-frame:fraction=1",
];

/// A scene, and what of it moves.
struct Moving {
    scene: Scene,
    movers: Vec<EntityKey>,
    /// The distance of the camera.
    reach: f64,
}

/// Walls, coplanar twins, glass, holes and boxes that touch, in a heap that turns.
fn heap() -> Moving {
    let mut scene = Scene::new();
    let sphere = scene
        .add_mesh(Mesh::new("sphere", icosphere(1, 0.5)))
        .unwrap();
    let block = scene
        .add_mesh(Mesh::new("block", cuboid(DVec3::ONE)))
        .unwrap();
    let wall = scene
        .add_mesh(Mesh::new("wall", cuboid(DVec3::new(5.0, 4.0, 0.1))))
        .unwrap();
    let image = scene.add_image(holes()).unwrap();
    let masked = Material {
        alpha: AlphaMode::Mask { cutoff: 0.5 },
        base_colour_image: Some(image),
        ..Material::default()
    };
    let [plain, clear, masked] = [Material::default(), glass([1.0, 1.0, 1.0, 0.4]), masked]
        .map(|material| scene.add_material(material));
    let mut movers = Vec::new();
    let mut random = Pcg32::seed_from_u64(5);
    for number in 0..120 {
        let mut along = || f64::from(random.random_range(-6..7)) * 0.5;
        let place = DAffine3::from_translation(DVec3::new(along(), along(), along()));
        let mesh = if number % 3 == 0 { sphere } else { block };
        let material = match number % 9 {
            0 => clear,
            1 => masked,
            _ => plain,
        };
        let entity = add(&mut scene, place, Drawable { mesh, material });
        if number % 4 == 0 {
            movers.push(entity);
        }
    }
    for side in [-1.5, 1.5] {
        let place = DAffine3::from_translation(DVec3::Z * side);
        add(
            &mut scene,
            place,
            Drawable {
                mesh: wall,
                material: plain,
            },
        );
        // In the same place: both are visible, or neither.
        add(
            &mut scene,
            place,
            Drawable {
                mesh: wall,
                material: plain,
            },
        );
    }
    Moving {
        scene,
        movers,
        reach: 6.0,
    }
}

fn lattice() -> Moving {
    Moving {
        scene: balls_with_proxies(5),
        movers: Vec::new(),
        reach: 6.0,
    }
}

/// Plays frames; those whose audits are in, and the patches that they sampled.
fn play(gpu: &antumbra_cull::Gpu, made: fn() -> Moving, strategy: &str, frames: u64) -> [u64; 2] {
    let Moving {
        mut scene,
        movers,
        reach,
    } = made();
    let mut on_gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let options = StageOptions {
        // Half of the frames, with more patches than a stage has by default.
        audit: Some(AuditOptions {
            share: 0.5,
            frame_share: 0.5,
            ..AuditOptions::default()
        }),
        ..StageOptions::default()
    };
    let strategy = registry().parse(strategy).unwrap();
    let name = strategy.name().to_owned();
    assert!(strategy.conservative(), "{name}");
    let mut stage = stage_with(&on_gpu, strategy, views(&["main"], SIZE), options);
    let mut random = Pcg32::seed_from_u64(frames);
    let mut patches = 0;
    let mut taken = 0;
    for number in 0..frames {
        let angle = number as f64 * 0.037;
        let distance = reach * (0.7 + 0.6 * (angle * 0.31).sin());
        let eye = DVec3::new(angle.cos(), (angle * 0.53).sin() * 0.7, angle.sin()) * distance;
        let camera = look_at(eye, DVec3::Y * (angle * 0.2).cos(), perspective(0.9, 0.02));
        if !movers.is_empty() {
            let mover = movers[random.random_range(0..movers.len())];
            let mut along = || random.random_range(-3.0..3.0);
            let turned = DQuat::from_rotation_y(angle);
            let place =
                DAffine3::from_rotation_translation(turned, DVec3::new(along(), along(), along()));
            scene.set_local(mover, place).unwrap();
            scene.update();
            on_gpu.sync(&mut scene).unwrap();
        }
        let cut = random.random_range(0..97) == 0;
        let input = ViewInput {
            cut,
            ..ViewInput::new(camera)
        };
        stage.frame(&on_gpu, &[input]).unwrap();
        // However slow the driver is, what it was asked comes in with the next frame.
        gpu.wait().unwrap();
        let audit = stage.audit(0).unwrap();
        let fresh = (audit.audited() - taken) as usize;
        taken = audit.audited();
        patches += audit
            .frames()
            .rev()
            .take(fresh)
            .map(|frame| u64::from(frame.patches))
            .sum::<u64>();
        let at = format!("{name} on {}, frame {number}", gpu.title());
        assert_eq!(stage.distrust(), [], "{at}");
    }
    [taken, patches]
}

#[test]
fn conservative_strategies_trip_nothing() {
    let frames = std::env::var("DISTRUST_FRAMES").ok();
    let all: u64 = frames.map_or(560, |frames| frames.parse().unwrap());
    let scenes: [fn() -> Moving; 2] = [heap, lattice];
    let plays = gpus().len() * scenes.len() * CONSERVATIVE.len();
    let each = all.div_ceil(plays as u64);
    let [mut audited, mut patches] = [0, 0];
    for gpu in gpus() {
        for made in scenes {
            for strategy in CONSERVATIVE {
                let [frames, sampled] = play(gpu, made, strategy, each);
                audited += frames;
                patches += sampled;
            }
        }
    }
    println!("{all} frames, {audited} audits, {patches} patches, no alarm");
    assert!(audited * 2 > all, "{audited} of {all}");
    assert!(patches > all / 4, "{patches}");
}
