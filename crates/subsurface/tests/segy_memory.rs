//! A SEG-Y file ten times as large as the memory it may take is written as a volume, under an allocator that fails past that.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::alloc::System;
use std::io::{BufWriter, Write};

use antumbra_subsurface::segy::{SegyFile, SegyOptions};
use antumbra_subsurface::{BrickSource, VolumeFile};
use cap::Cap;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

const MEMORY: u64 = 4 << 20;
const INLINES: i32 = 180;
const CROSSLINES: i32 = 200;
const SAMPLES: u16 = 600;

fn value(inline: i32, crossline: i32, sample: i32) -> i16 {
    ((inline * 7 + crossline * 13 + sample * 29) % 2000 - 1000) as i16
}

#[test]
fn a_file_ten_times_the_budget_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.segy");
    let mut file = BufWriter::new(std::fs::File::create(&path).unwrap());
    let mut head = [0; 3600];
    head[3216..3218].copy_from_slice(&2000_u16.to_be_bytes());
    head[3220..3222].copy_from_slice(&SAMPLES.to_be_bytes());
    head[3224..3226].copy_from_slice(&3_u16.to_be_bytes());
    file.write_all(&head).unwrap();
    // Crosslines first, so that the traces of a brick lie far from each other.
    for crossline in 0..CROSSLINES {
        for inline in 0..INLINES {
            let mut header = [0; 240];
            header[188..192].copy_from_slice(&inline.to_be_bytes());
            header[192..196].copy_from_slice(&crossline.to_be_bytes());
            header[180..184].copy_from_slice(&(crossline * 25).to_be_bytes());
            header[184..188].copy_from_slice(&(inline * 25).to_be_bytes());
            file.write_all(&header).unwrap();
            for sample in 0..i32::from(SAMPLES) {
                file.write_all(&value(inline, crossline, sample).to_be_bytes())
                    .unwrap();
            }
        }
    }
    drop(file.into_inner().unwrap());
    let length = std::fs::metadata(&path).unwrap().len();
    assert!(length > 10 * MEMORY, "{length}");

    let options = SegyOptions {
        max_memory: Some(MEMORY),
        range: Some([-1000.0, 1000.0]),
        ..SegyOptions::default()
    };
    let volume = folder.path().join("large.vol");
    // Threads of the pool allocate too, before they begin.
    rayon::join(|| (), || ());
    let before = ALLOCATOR.allocated();
    ALLOCATOR.set_limit(before + MEMORY as usize).unwrap();
    let written = SegyFile::open(&path, &options, &mut |_, _| ())
        .and_then(|file| file.write(&volume, "large", &mut |_, _| ()));
    ALLOCATOR.set_limit(usize::MAX).unwrap();
    written.unwrap();

    let volume = VolumeFile::open(&volume).unwrap();
    let layout = volume.layout();
    assert_eq!(layout.size, [180, 200, 600]);
    let mut samples = vec![0; layout.brick_bytes()];
    for brick in [[0, 0, 0], [2, 3, 4], [5, 6, 18]] {
        volume.read(brick, &mut samples).unwrap();
        let [i, c, t] = brick.map(|at| at as i32 * 32 + 5);
        let byte = samples[5 + 32 * (5 + 32 * 5)];
        let found = layout.value(byte).unwrap();
        assert!((found - f32::from(value(i, c, t))).abs() < 4.0);
    }
}
