//! Camera paths and the words of settings: every input gives a value or an error. The first byte selects what it is read as (a camera path, a
//! strategy with settings, a budget, an error limit, a size of memory).
#![no_main]

mod allocator;

use antumbra_cull::Budget;
use antumbra_measure::path::CameraPath;
use antumbra_measure::trade_off::ErrorLimit;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    if pick % 5 == 0 {
        match CameraPath::from_json("fuzzed", bytes) {
            Err(error) => assert!(!error.to_string().is_empty()),
            Ok(path) => {
                for pose in 0..path.poses().len().min(100) {
                    path.camera(pose).unwrap();
                }
            }
        }
        return;
    }
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    match pick % 5 {
        1 => drop(antumbra_strategies::registry().parse(text)),
        2 => drop(text.parse::<Budget>()),
        3 => drop(text.parse::<ErrorLimit>()),
        _ => drop(antumbra_files::parse_size(text)),
    }
});
