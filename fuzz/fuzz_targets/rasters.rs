//! Every input gives a raster or an error: no panic, no endless loop, bounded memory. The first byte selects the format (npz, Esri, GeoTIFF,
//! Surfer).
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_formats::{LoadedRaster, RasterFormat, RasterOptions, load_raster_slice_with};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    let formats = [
        RasterFormat::Npz,
        RasterFormat::Esri,
        RasterFormat::GeoTiff,
        RasterFormat::Surfer,
    ];
    let format = formats[usize::from(*pick) % formats.len()];
    let options = RasterOptions {
        max_memory: MEMORY,
        ..RasterOptions::default()
    };
    match load_raster_slice_with(format, bytes, &options) {
        Err(error) => assert!(error.to_string().len() < 4000),
        Ok(LoadedRaster { raster, .. }) => {
            let nodes = raster.columns as usize * raster.rows as usize;
            assert_eq!(raster.elevation.len(), nodes);
        }
    }
});
