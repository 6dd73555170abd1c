//! Every input gives a volume, of which every axis can be cut, or an error: no panic, no endless loop, bounded memory.
#![no_main]

mod allocator;

use antumbra_scene::Scene;
use antumbra_subsurface::{SectionPositions, VolumeFile, VolumeSections};
use libfuzzer_sys::fuzz_target;
use std::sync::{Arc, LazyLock};

/// Volumes are mapped, so they need a file.
static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());

fuzz_target!(|data: &[u8]| {
    let path = FOLDER.path().join("a.vol");
    std::fs::write(&path, data).unwrap();
    match VolumeFile::open(&path) {
        Err(error) => assert!(error.to_string().len() < 4000),
        Ok(volume) => {
            let mut scene = Scene::new();
            let places = SectionPositions::middle(&volume);
            let sections = VolumeSections::spawn(&mut scene, Arc::new(volume), &places, 16 << 20);
            if let Ok(mut sections) = sections {
                sections.page(&mut scene, &|_| false).unwrap();
            }
        }
    }
});
