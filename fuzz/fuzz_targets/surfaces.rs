//! Every input gives surfaces that can be prepared, or an error: no panic, no endless loop, bounded memory. The first
//! byte selects the file extension, the rest is the file.
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_subsurface::read::{ReadOptions, property_from_bytes, surfaces_from_bytes};
use antumbra_subsurface::{PrepareOptions, prepare_surface};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

const ENDINGS: [&str; 13] = [
    "gri", "irap", "roff", "ts", "json", "csv", "asc", "tif", "zmap", "cps3", "dat", "xyz", "grd",
];

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    let ending = ENDINGS[usize::from(*pick) % ENDINGS.len()];
    let name = format!("file.{ending}");
    let path = Path::new(&name);
    let options = PrepareOptions {
        tiles: 3,
        decimation: 5.0,
        ..PrepareOptions::default()
    };
    let read = ReadOptions {
        max_memory: Some(MEMORY),
        ..ReadOptions::default()
    };
    match surfaces_from_bytes(path, bytes, &read, &mut |_, _| ()) {
        Err(error) => assert!(error.to_string().contains(&name)),
        Ok(surfaces) => {
            assert!(!surfaces.is_empty());
            for surface in &surfaces {
                assert!(
                    surface.check().is_ok(),
                    "{}: {:?}",
                    surface.name,
                    surface.check()
                );
                let prepared = prepare_surface(surface, &options).unwrap();
                assert_eq!(prepared.triangles(), surface.geometry.triangle_count());
                for tile in &prepared.tiles {
                    assert!(tile.mesh.validate().is_ok());
                }
            }
        }
    }
    if ending == "roff" {
        let _ = property_from_bytes(path, bytes);
    }
});
