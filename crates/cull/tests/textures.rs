//! Images on surfaces are as sharp along the edges of triangles as elsewhere, in what is shaded and in what is masked.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{ViewInput, read_back};
use antumbra_draw::GpuScene;
use antumbra_scene::{
    AlphaMode, Drawable, Filter, Geometry, Image, Material, Mesh, Sampler, Scene,
};
use antumbra_testing::{add, gpus, look_at, perspective, stage, views};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [160, 160];

/// A square of two triangles, with an image whose left half is transparent black and whose right half is white.
fn scene(alpha: AlphaMode) -> Scene {
    let mut scene = Scene::new();
    let rgba = (0..64 * 64).flat_map(|pixel| [if pixel % 64 < 32 { 0 } else { 255 }; 4]);
    let image = Image {
        name: "halves".to_owned(),
        width: 64,
        height: 64,
        rgba: rgba.collect(),
        sampler: Sampler {
            mipmaps: Some(Filter::Linear),
            ..Sampler::default()
        },
    };
    let image = scene.add_image(image).unwrap();
    let material = scene.add_material(Material {
        base_colour_image: Some(image),
        unlit: true,
        alpha,
        ..Material::default()
    });
    let square = Geometry {
        positions: vec![
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
        ],
        uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Geometry::default()
    };
    let mesh = scene.add_mesh(Mesh::new("square", square)).unwrap();
    add(&mut scene, DAffine3::IDENTITY, Drawable { mesh, material });
    scene
}

/// The red of each pixel of the image, row by row.
fn pixels(gpu: &antumbra_cull::Gpu, alpha: AlphaMode) -> Vec<u8> {
    let on_gpu = GpuScene::new(gpu, &mut scene(alpha)).unwrap();
    let mut stage = stage(&on_gpu, "frustum", views(&["main"], SIZE));
    // The square's sides are 128 pixels: each texel is shown by four.
    let camera = look_at(
        DVec3::Z * 1.25 / (0.5_f64).tan(),
        DVec3::ZERO,
        perspective(1.0, 0.1),
    );
    stage.frame(&on_gpu, &[ViewInput::new(camera)]).unwrap();
    let texels = read_back::texture(gpu, stage.colour(0).unwrap()).unwrap();
    texels.chunks_exact(4).map(|pixel| pixel[0]).collect()
}

#[test]
fn the_edge_between_two_triangles_is_not_seen() {
    for gpu in gpus() {
        for alpha in [AlphaMode::Opaque, AlphaMode::Mask { cutoff: 0.6 }] {
            let found = pixels(gpu, alpha);
            let white = |x: usize, y: usize| found[y * SIZE[0] as usize + x] == 255;
            for y in 20..140 {
                let row = || (20..140).filter(|x| !(76..84).contains(x));
                let wrong: Vec<usize> = row().filter(|x| white(*x, y) != (*x >= 80)).collect();
                assert!(
                    wrong.is_empty(),
                    "{}, {alpha:?}, row {y}: {wrong:?}",
                    gpu.title()
                );
                if alpha == AlphaMode::Opaque {
                    assert!(row().filter(|x| *x < 80).all(|x| found[y * 160 + x] == 0));
                }
            }
        }
    }
}
