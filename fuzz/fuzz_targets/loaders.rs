//! Every input gives a scene or an error: no panic, no endless loop, bounded memory. The first byte selects the
//! format, the rest is the file.
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_formats::{LoadOptions, SceneFormat, load_slice};
use antumbra_scene::ProxyOptions;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    let formats = [
        SceneFormat::Gltf,
        SceneFormat::Obj,
        SceneFormat::Ply,
        SceneFormat::Stl,
        SceneFormat::CityJson,
    ];
    let options = LoadOptions {
        max_file_bytes: 1 << 20,
        max_vertices: 1 << 16,
        max_triangles: 1 << 16,
        max_entities: 1 << 12,
        max_image_pixels: 1 << 16,
        max_json_objects: 1 << 14,
        max_memory: MEMORY,
        max_work: 1 << 24,
        skip_images: false,
        strict: false,
    };
    let format = formats[usize::from(*pick) % formats.len()];
    match load_slice(format, bytes, None, &options) {
        Err(error) => assert!(error.to_string().len() > 10),
        Ok(mut scene) => {
            assert!(scene.len() as u64 <= options.max_entities);
            let changes = scene.update();
            assert_eq!(changes.added.len(), scene.drawable_count());
            assert!(scene.bounds().is_none_or(|bounds| bounds.is_finite()));
            for (_, mesh) in scene.meshes() {
                assert!(mesh.validate().is_ok());
            }
            let triangles = scene.triangle_count();
            scene.ensure_proxies(&ProxyOptions::default());
            assert_eq!(scene.triangle_count(), triangles);
            for (_, mesh) in scene.meshes() {
                let proxy = mesh
                    .proxy
                    .as_ref()
                    .map_or(0, |proxy| proxy.triangle_count());
                assert!(proxy <= mesh.triangle_count().max(12));
            }
            assert!(scene.update().is_empty());
        }
    }
});
