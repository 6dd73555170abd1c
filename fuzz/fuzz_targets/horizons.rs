//! Every glTF with the horizons extension gives a terrain or an error: no panic, no endless loop, bounded memory.
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_formats::{LoadOptions, SceneFormat, load_slice_with_attachments};
use antumbra_terrain::Terrain;
use antumbra_terrain::file::EXTENSION;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let options = LoadOptions {
        max_memory: MEMORY,
        max_work: 1 << 24,
        ..LoadOptions::default()
    };
    let format = SceneFormat::Gltf;
    let Ok(loaded) = load_slice_with_attachments(format, data, None, &options, &[EXTENSION]) else {
        return;
    };
    for attachment in loaded.attachments.into_iter().flatten() {
        match Terrain::read(&loaded.scene, &attachment) {
            Err(error) => assert!(error.to_string().len() < 4000),
            Ok(read) => {
                let groups = read.terrain.groups();
                assert_eq!(groups.groups().len(), read.shown.groups.len());
            }
        }
    }
});
