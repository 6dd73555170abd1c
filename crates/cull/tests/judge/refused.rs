//! What a judge refuses.

use antumbra_cull::Gpu;
use antumbra_cull::judge::*;
use antumbra_scene::Aabb;
use antumbra_testing::engine::Engine;
use antumbra_testing::vulkan;
use glam::{DAffine3, DVec3, Mat4, Vec3};

use crate::play::{cube, hosts, orbit};

/// One instance a call, with a depth of the view's own size.
fn judged(gpu: &Gpu, depth: HostDepth) -> (Judge, Instances, Engine) {
    let options = JudgeOptions {
        list: true,
        ..JudgeOptions::default()
    };
    let judge = Judge::new(gpu, vec![JudgeView::main(64, 48, depth)], options).unwrap();
    (
        judge,
        Instances::new(gpu),
        Engine::new(gpu, [64, 48], depth),
    )
}

fn message<T>(result: Result<T, JudgeError>) -> String {
    match result {
        Ok(_) => panic!("it was not refused"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn what_cannot_be_judged_is_refused_and_the_message_says_what_to_do() {
    let gpu = vulkan();
    let (depth, projection) = hosts()[0];
    let (mut judge, mut instances, engine) = judged(gpu, depth);
    let eye = orbit(projection, 0);
    let mut refused = |eye: Eye| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        message(judge.begin(&mut Instances::new(gpu), &[eye], &mut encoder))
    };
    // The eye.
    let flat = Eye::new(
        Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0)) * eye.clip_from_relative,
        eye.position,
    );
    assert!(refused(Eye::new(Mat4::ZERO, eye.position)).contains("singular"));
    assert!(refused(flat).contains("singular"));
    let mut infinite = eye;
    infinite.clip_from_relative.y_axis.z = f32::NAN;
    assert!(refused(infinite).contains("not finite"));
    assert!(refused(Eye::new(projection, DVec3::splat(f64::INFINITY))).contains("finite"));
    assert!(refused(Eye { shift: -1.0, ..eye }).contains("shifts by -1 pixels"));
    assert!(
        refused(Eye {
            shift: f32::NAN,
            ..eye
        })
        .contains("shifts by NaN pixels")
    );
    for drift in [(Vec3::NAN, 1.0), (Vec3::X, -1.0), (Vec3::X, f32::INFINITY)] {
        let (way, pixels) = drift;
        let drift = Drift { way, pixels };
        assert!(refused(Eye { drift, ..eye }).contains("drifts along"));
    }
    // The instances.
    let desc = |at| InstanceDesc {
        bounds: cube(),
        at,
        part: Part::Both,
    };
    let id = instances.insert(desc(DAffine3::IDENTITY)).unwrap();
    let twice = [Moved {
        id,
        at: DAffine3::IDENTITY,
    }; 2];
    assert!(message(instances.move_all(&twice)).contains("twice"));
    assert!(message(instances.remove_all(&[id, id])).contains("twice"));
    let huge = DAffine3::from_scale(DVec3::splat(1e39));
    assert!(message(instances.insert(desc(huge))).contains("32-bit"));
    let nowhere = DAffine3::from_translation(DVec3::splat(f64::NAN));
    assert!(message(instances.move_to(id, nowhere)).contains("finite"));
    let empty = InstanceDesc {
        bounds: Aabb::EMPTY,
        ..desc(DAffine3::IDENTITY)
    };
    assert!(message(instances.insert(empty)).contains("empty"));
    instances.remove(id).unwrap();
    assert!(message(instances.move_to(id, DAffine3::IDENTITY)).contains("removed"));
    let again = instances.insert(desc(DAffine3::IDENTITY)).unwrap();
    assert_eq!(again.index(), id.index());
    assert!(message(instances.remove(id)).contains("removed"));
    // The depth.
    let other = |size, format, samples| {
        let depth = HostDepth {
            format,
            samples,
            ..depth
        };
        Engine::new(gpu, size, depth)
    };
    let float = wgpu::TextureFormat::Depth32Float;
    for (engine, why) in [
        (other([65, 48], float, 1), "65 x 48"),
        (
            other([64, 48], wgpu::TextureFormat::Depth16Unorm, 1),
            "Depth16Unorm",
        ),
        (other([64, 48], float, 4), "4 samples"),
    ] {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let found = message(judge.test(&[engine.depth()], &mut encoder));
        assert!(found.contains(why), "{found}");
    }
    let bare = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 64,
            height: 48,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    assert!(message(judge.test(&[&bare], &mut encoder)).contains("TEXTURE_BINDING"));
    // A test without a frame.
    assert!(message(judge.test(&[engine.depth()], &mut encoder)).contains("begin"));
    // Views.
    let views = |size: [u32; 2], depth| {
        let view = JudgeView::main(size[0], size[1], depth);
        message(Judge::new(gpu, vec![view], JudgeOptions::default()))
    };
    assert!(views([0, 4], depth).contains("0 x 4"));
    let colour = HostDepth {
        format: wgpu::TextureFormat::Rgba8Unorm,
        ..depth
    };
    assert!(views([4, 4], colour).contains("depth format"));
    assert!(
        views(
            [4, 4],
            HostDepth {
                samples: 3,
                ..depth
            }
        )
        .contains("1, 2, 4 or 8")
    );
    let many = JudgeView::main(
        4,
        4,
        HostDepth {
            samples: 4,
            ..depth
        },
    );
    let on_gl = Judge::new(antumbra_testing::gl(), vec![many], JudgeOptions::default());
    assert!(message(on_gl).contains("OpenGL"));
    // Buffers.
    let buffer = |size, usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let storage = wgpu::BufferUsages::STORAGE;
    let small = Instances::on_gpu(gpu, buffer(640, storage), 11);
    assert!(message(small).contains("larger"));
    let vertices = Instances::on_gpu(gpu, buffer(640, wgpu::BufferUsages::VERTEX), 10);
    assert!(message(vertices).contains("STORAGE"));
    let mut theirs = Instances::on_gpu(gpu, buffer(640, storage), 10).unwrap();
    assert!(message(theirs.insert(desc(DAffine3::IDENTITY))).contains("on the GPU"));
    let template = DrawTemplate {
        elements: 3,
        first_element: 0,
        base_vertex: 0,
        members: vec![0; 4],
    };
    let draws = JudgeDraws::new(gpu, DrawKind::Indexed, &[template]).unwrap();
    let indirect = storage | wgpu::BufferUsages::INDIRECT;
    let (args, kept) = (buffer(16, indirect), buffer(16, storage));
    let into = DrawBuffers {
        draws: &args,
        kept: &kept,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let found = message(judge.write_draws(0, Chosen::First, &draws, into, &mut encoder));
    assert!(found.contains("20 are written"), "{found}");
}
