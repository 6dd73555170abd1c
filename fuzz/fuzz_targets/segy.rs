//! Every input opens as a SEG-Y file that can be read and written, or is an error: no panic, no endless loop, bounded memory. The first byte
//! selects whether the bytes of the line numbers are named.
#![no_main]

mod allocator;

use allocator::MEMORY;
use antumbra_subsurface::BrickSource;
use antumbra_subsurface::segy::{SegyFile, SegyOptions, TraceBytes};
use libfuzzer_sys::fuzz_target;
use std::cell::RefCell;

thread_local! {
    static FOLDER: RefCell<Option<tempfile::TempDir>> = const { RefCell::new(None) };
}

/// Bricks of a volume that are written, at most.
const MOST: u64 = 64;

fuzz_target!(|data: &[u8]| {
    let Some((pick, bytes)) = data.split_first() else {
        return;
    };
    FOLDER.with_borrow_mut(|folder| {
        let folder = folder.get_or_insert_with(|| tempfile::tempdir().unwrap());
        let path = folder.path().join("a.segy");
        std::fs::write(&path, bytes).unwrap();
        let options = SegyOptions {
            trace_bytes: (pick & 1 == 1).then_some(TraceBytes::STANDARD),
            max_memory: Some(MEMORY),
            ..SegyOptions::default()
        };
        match SegyFile::open(&path, &options, &mut |_, _| ()) {
            Err(error) => assert!(error.to_string().len() < 4000),
            Ok(file) => {
                let layout = file.layout();
                assert_eq!(layout.problem(), None);
                let mut samples = vec![0; layout.brick_bytes()];
                let last = layout.bricks().map(|bricks| bricks - 1);
                file.read([0, 0, 0], &mut samples).unwrap();
                file.read(last, &mut samples).unwrap();
                let bricks: u64 = layout.bricks().iter().map(|n| u64::from(*n)).product();
                if bricks <= MOST {
                    let _ = file.write(&folder.path().join("a.vol"), "a", &mut |_, _| ());
                }
            }
        }
    });
});
