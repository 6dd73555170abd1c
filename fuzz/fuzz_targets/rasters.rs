//! Every input gives a raster or an error: no panic, no endless loop, bounded memory. The first byte selects the format (npz, Esri, GeoTIFF).
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_formats::{RasterFormat, load_raster_slice_within};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    let formats = [RasterFormat::Npz, RasterFormat::Esri, RasterFormat::GeoTiff];
    let format = formats[usize::from(*pick) % formats.len()];
    match load_raster_slice_within(format, bytes, MEMORY) {
        Err(error) => assert!(error.to_string().len() < 4000),
        Ok(raster) => {
            let nodes = raster.columns as usize * raster.rows as usize;
            assert_eq!(raster.elevation.len(), nodes);
        }
    }
});
