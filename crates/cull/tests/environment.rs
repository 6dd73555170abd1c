//! Environment lighting: a mirror reflects the part of the environment in front of it, rough metal averages all of it. The same on Vulkan
//! and OpenGL.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{Gpu, Stage, ViewInput, read_back};
use antumbra_draw::GpuScene;
use antumbra_scene::{
    Camera, Drawable, Environment, Geometry, Image, ImageKey, Light, Material, Mesh, Sampler, Scene,
};
use antumbra_testing::{add, gl, perspective, stage, views, vulkan};
use glam::{DAffine3, DQuat, DVec3};

const SIZE: [u32; 2] = [48, 40];
/// The environment's colour on each side, in bytes: +X, -X, +Y, -Y, +Z, -Z.
const SIDES: [[u8; 3]; 6] = [
    [200, 40, 40],
    [40, 200, 40],
    [60, 90, 220],
    [90, 60, 10],
    [200, 200, 30],
    [30, 180, 200],
];

/// An equirectangular image with one colour for each side of a cube.
fn sides(colours: [[u8; 3]; 6]) -> Image {
    let (width, height) = (96, 48);
    let mut rgba = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let turn = ((f64::from(x) + 0.5) / f64::from(width) - 0.5) * std::f64::consts::TAU;
            let down = (f64::from(y) + 0.5) / f64::from(height) * std::f64::consts::PI;
            let (below, up) = down.sin_cos();
            let towards = DVec3::new(below * turn.sin(), up, -below * turn.cos());
            let axis = towards.abs().max_position();
            let side = axis * 2 + usize::from(towards[axis] < 0.0);
            rgba.extend(colours[side]);
            rgba.push(255);
        }
    }
    Image {
        name: "sides".into(),
        width,
        height,
        rgba,
        sampler: Sampler::default(),
    }
}

/// Six plates around the origin that face outwards, one a side. The environment is the only light.
fn plates(material: Material) -> (Scene, ImageKey) {
    let mut scene = Scene::new();
    let square = Geometry {
        positions: vec![
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
        ],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Geometry::default()
    };
    let mesh = scene.add_mesh(Mesh::new("plate", square)).unwrap();
    let material = scene.add_material(material);
    for outwards in OUTWARDS {
        let turned = DQuat::from_rotation_arc(DVec3::Z, outwards);
        let place = DAffine3::from_rotation_translation(turned, outwards * 2.0);
        add(&mut scene, place, Drawable { mesh, material });
    }
    let lamp = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let dark = Light::Directional {
        colour: [1.0; 3],
        illuminance: 0.0,
    };
    scene.set_light(lamp, dark).unwrap();
    let image = scene.add_image(sides(SIDES)).unwrap();
    surround(&mut scene, image, 1.0);
    (scene, image)
}

const OUTWARDS: [DVec3; 6] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];

fn surround(scene: &mut Scene, image: ImageKey, intensity: f32) {
    let around = Environment { image, intensity };
    scene.set_environment(Some(around)).unwrap();
}

fn mirror() -> Material {
    Material {
        metallic: 1.0,
        roughness: 0.0,
        ..Material::default()
    }
}

/// Renders each plate from in front of it, and reads the middle pixel.
struct Viewer {
    stage: Stage,
}

impl Viewer {
    fn new(scene: &GpuScene, strategy: &str) -> Self {
        let stage = stage(scene, strategy, views(&["main"], SIZE));
        Self { stage }
    }

    fn picture(&mut self, scene: &GpuScene, outwards: DVec3) -> Vec<u8> {
        let up = if outwards.y == 0.0 {
            DVec3::Y
        } else {
            DVec3::X
        };
        let eye = outwards * 4.0;
        let camera = Camera::look_at(eye, DVec3::ZERO, up, perspective(0.5, 0.1)).unwrap();
        self.stage.frame(scene, &[ViewInput::new(camera)]).unwrap();
        scene.gpu().wait().unwrap();
        read_back::texture(scene.gpu(), self.stage.colour(0).unwrap()).unwrap()
    }

    fn middles(&mut self, scene: &GpuScene) -> [[u8; 3]; 6] {
        OUTWARDS.map(|outwards| {
            let picture = self.picture(scene, outwards);
            let at = ((SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) * 4) as usize;
            [picture[at], picture[at + 1], picture[at + 2]]
        })
    }
}

fn close(seen: [u8; 3], wanted: [u8; 3], by: u8) -> bool {
    seen.iter().zip(wanted).all(|(a, b)| a.abs_diff(b) <= by)
}

fn a_mirror_shows_what_it_looks_at(gpu: &Gpu) {
    let (mut scene, _) = plates(mirror());
    let scene = GpuScene::new(gpu, &mut scene).unwrap();
    for strategy in ["frustum", "three-pass:latency=same-frame"] {
        let seen = Viewer::new(&scene, strategy).middles(&scene);
        for (seen, wanted) in seen.into_iter().zip(SIDES) {
            assert!(
                close(seen, wanted, 3),
                "{strategy}: {seen:?}, not {wanted:?}"
            );
        }
    }
}

#[test]
fn a_mirror_shows_what_it_looks_at_on_vulkan() {
    a_mirror_shows_what_it_looks_at(vulkan());
}

#[test]
fn a_mirror_shows_what_it_looks_at_on_gl() {
    a_mirror_shows_what_it_looks_at(gl());
}

#[test]
fn indirect_draws_reflect_too() {
    let gpu = vulkan();
    let (mut scene, _) = plates(mirror());
    let scene = GpuScene::new(gpu, &mut scene).unwrap();
    let seen = Viewer::new(&scene, "three-pass:latency=on-gpu").middles(&scene);
    assert_eq!(seen, Viewer::new(&scene, "frustum").middles(&scene));
}

#[test]
fn rough_metal_and_matt_white_show_the_light_of_a_whole_half() {
    let gpu = vulkan();
    let rough = Material {
        metallic: 1.0,
        ..Material::default()
    };
    for material in [rough, Material::default()] {
        let (mut scene, image) = plates(material);
        // Light from +X alone, a square of 90 degrees: it gives 55 % of the irradiance of a full environment to the plate that faces it,
        // 11 % to the four beside it, and none to the plate that faces away. As sRGB bytes: 196, 94 and 0.
        let mut one = [[0; 3]; 6];
        one[0] = [255; 3];
        scene.set_image(image, sides(one)).unwrap();
        let scene = GpuScene::new(gpu, &mut scene).unwrap();
        let seen = Viewer::new(&scene, "none").middles(&scene).map(|c| c[0]);
        assert!((185..206).contains(&seen[0]), "{seen:?}");
        assert!(seen[1] < 16, "{seen:?}");
        for side in &seen[2..] {
            assert!((80..112).contains(side), "{seen:?}");
        }
    }
}

#[test]
fn paint_reflects_little_and_metal_in_its_own_colour() {
    let gpu = vulkan();
    let red = |metallic| Material {
        base_colour: [1.0, 0.0, 0.0, 1.0],
        metallic,
        roughness: 0.0,
        ..Material::default()
    };
    let up = |material| {
        let (mut scene, image) = plates(material);
        scene.set_image(image, sides([[255; 3]; 6])).unwrap();
        let scene = GpuScene::new(gpu, &mut scene).unwrap();
        Viewer::new(&scene, "none").middles(&scene)[2]
    };
    assert!(close(up(red(1.0)), [255, 0, 0], 1));
    // 4 % of white, as sRGB.
    assert!(close(up(red(0.0)), [255, 56, 56], 3), "{:?}", up(red(0.0)));
    // NaN reads as 0, and infinities are clamped.
    for odd in [f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(up(red(odd)), up(red(0.0)));
    }
    assert_eq!(up(red(f32::INFINITY)), up(red(1.0)));
}

#[test]
fn what_changes_around_a_scene_changes_the_next_picture() {
    let gpu = vulkan();
    let (mut scene, image) = plates(mirror());
    scene.set_environment(None).unwrap();
    let mut on_gpu = GpuScene::new(gpu, &mut scene).unwrap();
    let mut viewer = Viewer::new(&on_gpu, "frustum");
    let plain = viewer.picture(&on_gpu, DVec3::Y);

    surround(&mut scene, image, 1.0);
    on_gpu.sync(&mut scene).unwrap();
    let around = viewer.picture(&on_gpu, DVec3::Y);
    assert_ne!(plain, around);

    surround(&mut scene, image, 0.25);
    on_gpu.sync(&mut scene).unwrap();
    let dim = viewer.picture(&on_gpu, DVec3::Y);
    assert_ne!(around, dim, "a quarter as strong");

    let mut other = SIDES;
    other[2] = [250, 10, 10];
    scene.set_image(image, sides(other)).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    assert_ne!(dim, viewer.picture(&on_gpu, DVec3::Y), "repainted");

    scene.set_environment(None).unwrap();
    on_gpu.sync(&mut scene).unwrap();
    assert!(plain == viewer.picture(&on_gpu, DVec3::Y), "as before");
}
