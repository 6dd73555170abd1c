//! Every input is a corner-point grid with properties, or an error: no panic, no endless loop, bounded memory. The first byte selects the form
//! (Eclipse text, Eclipse binary).
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_subsurface::read::{
    ReadOptions, grid_file_from_bytes, property_of_from_bytes, surfaces_from_bytes,
};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    let name = ["a.grdecl", "a.egrid"][usize::from(pick & 1)];
    let path = Path::new(name);
    let options = ReadOptions {
        max_memory: Some(MEMORY),
        ..ReadOptions::default()
    };
    match grid_file_from_bytes(path, bytes, &options) {
        Err(error) => assert!(error.to_string().contains(name)),
        Ok(file) => {
            for wanted in [None, Some("PORO")] {
                let read = property_of_from_bytes(&file.grid, path, bytes, wanted, &options);
                if let Ok(property) = read {
                    let _ = file.grid.volume(&property, [4, 4, 4], &mut |_, _| ());
                }
            }
            if let Ok(surfaces) = surfaces_from_bytes(path, bytes, &options, &mut |_, _| ()) {
                for surface in &surfaces {
                    assert!(surface.check().is_ok(), "{:?}", surface.check());
                }
            }
        }
    }
});
