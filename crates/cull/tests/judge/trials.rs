//! Random views of random worlds.

use antumbra_cull::TestDetail;
use antumbra_cull::judge::*;
use antumbra_testing::gpus;
use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{DAffine3, DVec3, Mat4, Vec3};
use rand::{RngExt as _, SeedableRng as _};
use rand_pcg::Pcg64Mcg;

use crate::play::Play;

/// A view of anything: perspective or parallel, forward or reversed, telescope or fish eye, with a near plane anywhere.
fn any_view(random: &mut Pcg64Mcg, metre: f32, aspect: f32) -> (DepthRange, Mat4) {
    let near = metre * 10f32.powf(random.random_range(-3.0..0.5));
    let far = near + metre * 10f32.powf(random.random_range(0.5..4.0));
    let angle = 10f32.powf(random.random_range(-1.5..0.4));
    let half = metre * 10f32.powf(random.random_range(-0.5..1.5));
    let [wide, behind] = [half * aspect, -half * random.random_range(0.0..2.0)];
    let (range, mut projection) = match random.random_range(0..5) {
        0 => (
            DepthRange::Reversed,
            directx::perspective_infinite_reverse(angle, aspect, near),
        ),
        1 => (
            DepthRange::Reversed,
            directx::perspective(angle, aspect, far, near),
        ),
        2 => (
            DepthRange::Forward,
            directx::perspective(angle, aspect, near, far),
        ),
        3 => (
            DepthRange::Forward,
            directx::orthographic(-wide, wide, -half, half, behind, far),
        ),
        _ => (
            DepthRange::Reversed,
            directx::orthographic(-wide, wide, -half, half, far, behind),
        ),
    };
    if random.random_range(0..3) == 0 {
        projection.z_axis.x += random.random_range(-1.5..1.5);
        projection.z_axis.y += random.random_range(-1.5..1.5);
    }
    (range, projection)
}

/// Trials of the random kind: more of them with the variable `JUDGE_TRIALS`.
#[test]
fn no_view_of_no_world_shows_a_wrong_pixel() {
    let trials = std::env::var("JUDGE_TRIALS").ok();
    let trials: u64 = trials.map_or(24, |number| number.parse().unwrap());
    let formats = [
        wgpu::TextureFormat::Depth32Float,
        wgpu::TextureFormat::Depth24Plus,
        wgpu::TextureFormat::Depth16Unorm,
    ];
    for seed in 0..trials {
        let gpu = gpus()[(seed % 2) as usize];
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let size = [random.random_range(1..260), random.random_range(1..200)];
        let metre = 10f32.powf(random.random_range(-2.0..3.0));
        let (range, projection) = any_view(&mut random, metre, size[0] as f32 / size[1] as f32);
        let many = gpu.info.backend != wgpu::Backend::Gl && seed % 3 == 0;
        let depth = HostDepth {
            format: formats[random.random_range(0..3)],
            samples: if many { 4 } else { 1 },
            range,
        };
        let detail = match seed % 5 {
            0 => TestDetail::Pyramid,
            _ => TestDetail::Pixel,
        };
        let mut play = Play::inspecting(gpu, size, depth, Phases::Two, detail, seed);
        // A world of boxes from a speck to a wall, flat ones among them, with the eye among them or outside.
        let scale = f64::from(metre) * 0.1;
        let spread = random.random_range(0.5..4.0);
        for _ in 0..300 {
            let at = play.anywhere();
            let shape =
                DVec3::from_array([0, 1, 2].map(|_| 10f64.powf(random.random_range(-2.5..0.7))));
            let flat =
                DVec3::from_array([0, 1, 2].map(|_| f64::from(random.random_range(0..12).min(1))));
            let at = DAffine3::from_translation(at.translation * spread)
                * DAffine3::from_mat3(at.matrix3)
                * DAffine3::from_scale(shape * flat);
            play.add(DAffine3::from_scale(DVec3::splat(scale)) * at, Part::Both);
        }
        let reach = scale * 30.0 * random.random_range(0.0..1.0);
        for step in 0..3 {
            let angle = f64::from(step) * random.random_range(0.0..0.4) + seed as f64;
            let eye = DVec3::new(angle.sin(), 0.3, angle.cos()) * reach;
            let towards = DVec3::new(-angle.sin(), -0.1, -angle.cos());
            let view = look_at_mat4(Vec3::ZERO, towards.as_vec3(), Vec3::Y);
            let frame = play.frame(Eye::new(projection * view, eye), Phases::Two);
            assert_eq!(
                frame.wrong_pixels, 0,
                "seed {seed}, step {step}: {depth:?}, {size:?}, {projection}"
            );
        }
    }
}
