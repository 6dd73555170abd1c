//! SEG-Y files as volumes: revisions, orders of bytes, formats of samples, headers, missing and dead traces, sizes beyond the memory, and damage.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

use antumbra_subsurface::segy::{SegyFile, SegyOptions, TraceBytes};
use antumbra_subsurface::{BrickSource, VolumeFile};
use glam::DVec3;
use proptest::prelude::*;
use tempfile::TempDir;

#[path = "read_support/segy.rs"]
mod support;
use support::Segy;

const BRICK: usize = 32;

fn saved(bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.segy");
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn open(path: &Path, options: &SegyOptions) -> Result<SegyFile, String> {
    SegyFile::open(path, options, &mut |_, _| ()).map_err(|error| error.to_string())
}

fn opened(bytes: &[u8]) -> SegyFile {
    open(&saved(bytes).1, &SegyOptions::default()).unwrap()
}

fn refused(bytes: &[u8], options: &SegyOptions, word: &str) {
    let (_folder, path) = saved(bytes);
    let error = open(&path, options).unwrap_err();
    assert!(error.contains(word), "`{error}` does not say `{word}`");
}

/// All samples of the first brick.
fn brick(source: &dyn BrickSource) -> Vec<u8> {
    let mut samples = vec![9; BRICK * BRICK * BRICK];
    source.read([0, 0, 0], &mut samples).unwrap();
    samples
}

fn sample(bricks: &[u8], [i, c, t]: [usize; 3]) -> u8 {
    bricks[i + BRICK * (c + BRICK * t)]
}

/// Asserts that every sample of a small file is what it was written with.
fn assert_values(file: &SegyFile, made: &Segy) {
    let layout = *file.layout();
    assert_eq!(layout.size, [3, 4, 5]);
    let samples = brick(file);
    let step = (layout.range[1] - layout.range[0]) / 254.0;
    for i in 0..3 {
        for c in 0..4 {
            for t in 0..5 {
                let expected = (made.value)(1100 + i as i32, 1200 + 2 * c as i32, t);
                let expected = expected.clamp(layout.range[0], layout.range[1]);
                let value = layout.value(sample(&samples, [i, c, t])).unwrap();
                assert!((value - expected).abs() <= step, "{value} for {expected}");
            }
        }
    }
}

#[test]
fn every_revision_order_and_format_reads_alike() {
    for revision in 0..3 {
        for format in [1, 2, 3, 5, 6, 8] {
            for is_little in [false, true] {
                let made = Segy {
                    revision,
                    is_little,
                    ..Segy::new(format)
                };
                assert_values(&opened(&made.write()), &made);
            }
        }
    }
}

#[test]
fn a_volume_lies_where_its_traces_do() {
    let file = opened(&Segy::new(5).write());
    let layout = file.layout();
    // A millisecond is a metre; the first sample is at 1,000 ms.
    let first = layout.position(DVec3::ZERO);
    assert!(first.distance(DVec3::new(500_000.0, -1000.0, -6_000_000.0)) < 1e-3);
    let [inline, crossline, time] = layout.steps;
    assert!(inline.distance(DVec3::new(0.0, 0.0, -25.0)) < 1e-6);
    assert!(crossline.distance(DVec3::new(25.0, 0.0, 0.0)) < 1e-6);
    assert_eq!(time, DVec3::new(0.0, -4.0, 0.0));
    assert!(file.notes().iter().any(|note| note.contains("--velocity")));

    let (_folder, path) = saved(&Segy::new(5).write());
    let fast = SegyOptions {
        velocity: Some(3000.0),
        ..SegyOptions::default()
    };
    let file = open(&path, &fast).unwrap();
    assert_eq!(file.layout().steps[2], DVec3::new(0.0, -6.0, 0.0));
    let feet = SegyOptions {
        units: "ft".parse().unwrap(),
        ..SegyOptions::default()
    };
    let file = open(&path, &feet).unwrap();
    assert!((file.layout().steps[2].y + 4.0 * 0.3048).abs() < 1e-9);
    assert!((file.layout().origin.x - 152_400.0).abs() < 1e-3);
    // A velocity says what the samples are, whatever the unit of places.
    let both = SegyOptions {
        velocity: Some(3000.0),
        ..feet
    };
    let file = open(&path, &both).unwrap();
    assert_eq!(file.layout().steps[2], DVec3::new(0.0, -6.0, 0.0));
    assert!((file.layout().origin.x - 152_400.0).abs() < 1e-3);
}

/// Degrees of a small survey, and of the same in arc seconds.
fn on_globe(unit: i16) -> Vec<u8> {
    let mut bytes = Segy {
        unit,
        ..Segy::new(5)
    }
    .write();
    for trace in 0..12_usize {
        let at = 3600 + trace * 260;
        // Hundredths of a degree, about 60 degrees north.
        let step = if unit == 2 { 3600 } else { 1 };
        let (row, column) = (trace as i32 / 4, trace as i32 % 4);
        let place = [(500 + column) * step, (6000 + row) * step];
        bytes[at + 70..at + 72].copy_from_slice(&(-100_i16).to_be_bytes());
        for (place, value) in [180, 184].into_iter().zip(place) {
            bytes[at + place..at + place + 4].copy_from_slice(&value.to_be_bytes());
        }
    }
    bytes
}

#[test]
fn degrees_are_taken_to_metres_about_their_middle_or_as_told() {
    let width = |latitude: f64| 0.01 * 111_195.08 * latitude.to_radians().cos();
    for unit in [2, 3] {
        let bytes = on_globe(unit);
        let file = opened(&bytes);
        let [inline, crossline, _] = file.layout().steps;
        assert!((crossline.x - width(60.01)).abs() < 0.01, "{crossline}");
        assert!((inline.z + 1111.95).abs() < 0.01, "{inline}");
        let (_folder, path) = saved(&bytes);
        let told = SegyOptions {
            latitude: Some(10.0),
            ..SegyOptions::default()
        };
        let [_, crossline, _] = open(&path, &told).unwrap().layout().steps;
        assert!((crossline.x - width(10.0)).abs() < 0.01, "{crossline}");
    }
}

#[test]
fn degrees_without_a_word_are_told_by_their_shape() {
    // A second of time over the fraction of a unit.
    let mut bytes = on_globe(0);
    for trace in 0..12 {
        let at = 3600 + trace * 260;
        bytes[at + 70..at + 72].copy_from_slice(&(-1000_i16).to_be_bytes());
    }
    let file = opened(&bytes);
    let notes = file.notes().join("; ");
    assert!(notes.contains("can only be degrees"), "{notes}");
    // A survey of usual size that says nothing is one of lengths.
    let lengths = Segy {
        unit: 0,
        ..Segy::new(5)
    };
    let file = opened(&lengths.write());
    assert!((file.layout().steps[0].z + 25.0).abs() < 1e-6);
}

#[test]
fn degrees_minutes_and_seconds_in_one_number_are_no_lengths() {
    let bytes = Segy {
        unit: 4,
        ..Segy::new(5)
    }
    .write();
    refused(&bytes, &SegyOptions::default(), "--units m");
    let (_folder, path) = saved(&bytes);
    let options = SegyOptions {
        units: "m".parse().unwrap(),
        ..SegyOptions::default()
    };
    let file = open(&path, &options).unwrap();
    assert!((file.layout().steps[0].z + 25.0).abs() < 1e-6);
}

#[test]
fn degrees_on_no_globe_are_lengths() {
    let made = Segy {
        unit: 3,
        ..Segy::new(5)
    };
    let bytes = made.write();
    let file = opened(&bytes);
    assert!((file.layout().steps[0].z + 25.0).abs() < 1e-6);
    let said = file.notes().iter().any(|note| note.contains("on no globe"));
    assert!(said, "{:?}", file.notes());
    // A caller who names degrees means it.
    let options = SegyOptions {
        units: "degrees".parse().unwrap(),
        ..SegyOptions::default()
    };
    refused(&bytes, &options, "--units m");
    // Arc seconds on the globe: 10 to a unit of the file.
    let seconds = Segy {
        unit: 2,
        ..Segy::new(5)
    };
    let mut bytes = seconds.write();
    for trace in 0..12 {
        let at = 3600 + trace * 260 + 184;
        let y = i32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) / 40;
        bytes[at..at + 4].copy_from_slice(&y.to_be_bytes());
    }
    let file = opened(&bytes);
    assert!(
        file.notes()
            .iter()
            .any(|note| note.contains("latitude 41.66"))
    );
}

#[test]
fn missing_and_dead_traces_have_no_value() {
    let made = Segy {
        code: |inline, crossline| match (inline, crossline) {
            (1101, 1202) => None,
            (1102, 1206) => Some(2),
            _ => Some(1),
        },
        ..Segy::new(1)
    };
    let file = opened(&made.write());
    assert_eq!(file.live_positions(), 10);
    let samples = brick(&file);
    for t in 0..5 {
        assert_eq!(sample(&samples, [1, 1, t]), 0, "missing");
        assert_eq!(sample(&samples, [2, 3, t]), 0, "dead");
        assert_ne!(sample(&samples, [2, 2, t]), 0);
    }
    let notes = file.notes().join("; ");
    assert!(notes.contains("1 traces are dead"), "{notes}");
    assert!(notes.contains("1 positions of the grid"), "{notes}");
}

#[test]
fn traces_that_are_not_live_move_no_grid() {
    let live = Segy::new(1);
    let made = Segy {
        crosslines: [1200, 5, 2],
        code: |_, crossline| Some(if crossline == 1208 { 3 } else { 1 }),
        ..Segy::new(1)
    };
    let mut bytes = made.write();
    // Dummies at the end of each line, without numbers or a place.
    for line in 0..3 {
        let at = 3600 + (line * 5 + 4) * 260;
        bytes[at + 180..at + 184].copy_from_slice(&7_i32.to_be_bytes());
        bytes[at + 184..at + 188].copy_from_slice(&9_i32.to_be_bytes());
        bytes[at + 188..at + 196].fill(0);
    }
    let file = opened(&bytes);
    assert_values(&file, &live);
    let layout = file.layout();
    assert!(layout.steps[0].distance(DVec3::new(0.0, 0.0, -25.0)) < 1e-6);
    let notes = file.notes().join("; ");
    assert!(notes.contains("3 traces are dead"), "{notes}");
    assert!(!notes.contains("positions of the grid"), "{notes}");
}

#[test]
fn samples_that_are_no_number_have_no_value() {
    let made = Segy {
        value: |_, crossline, sample| match (crossline, sample) {
            (1202, 2) => f32::NAN,
            (1202, 3) => f32::INFINITY,
            _ => 1.0 + sample as f32,
        },
        ..Segy::new(5)
    };
    let samples = brick(&opened(&made.write()));
    assert_eq!(sample(&samples, [0, 1, 2]), 0);
    assert_eq!(sample(&samples, [0, 1, 3]), 0);
    assert_eq!(sample(&samples, [0, 1, 4]), 255);
}

#[test]
fn line_numbers_are_found_where_they_are() {
    let made = Segy {
        numbers: [9, 21],
        ..Segy::new(5)
    };
    let bytes = made.write();
    let file = opened(&bytes);
    assert_values(&file, &made);
    assert!(
        file.notes()
            .iter()
            .any(|note| note.contains("bytes 9 and 21"))
    );
    // Bytes that no other program uses are named by the caller.
    let made = Segy {
        numbers: [221, 233],
        ..Segy::new(5)
    };
    let (_folder, path) = saved(&made.write());
    let options = SegyOptions {
        trace_bytes: Some("inline=221,crossline=233".parse().unwrap()),
        ..SegyOptions::default()
    };
    assert_values(&open(&path, &options).unwrap(), &made);
    // Without, the traces are one line.
    let line = open(&path, &SegyOptions::default()).unwrap();
    assert_eq!(line.layout().size, [1, 12, 5]);
    assert!(line.notes().iter().any(|note| note.contains("one line")));
}

#[test]
fn a_count_of_traces_is_not_taken_for_line_numbers() {
    let made = Segy {
        counts: true,
        ..Segy::new(5)
    };
    let bytes = made.write();
    assert_values(&opened(&bytes), &made);
    // The last trace again, at the same position.
    let mut twice = bytes.clone();
    let again = twice.len() - 260;
    twice.extend_from_within(again..);
    let at = twice.len() - 260 + 4;
    twice[at..at + 4].copy_from_slice(&13_i32.to_be_bytes());
    let file = opened(&twice);
    assert_values(&file, &made);
    let notes = file.notes().join("; ");
    assert!(notes.contains("1 traces share"), "{notes}");
    assert!(!notes.contains("bytes 5 and 21"), "{notes}");
}

#[test]
fn dummies_have_no_say_in_where_line_numbers_are() {
    let made = Segy {
        numbers: [9, 21],
        code: |_, crossline| Some(if crossline == 1206 { 3 } else { 1 }),
        ..Segy::new(5)
    };
    let mut bytes = made.write();
    for line in 0..3 {
        let at = 3600 + (line * 4 + 3) * 260;
        bytes[at + 188..at + 192].copy_from_slice(&7_i32.to_be_bytes());
    }
    let file = opened(&bytes);
    let notes = file.notes().join("; ");
    assert!(notes.contains("bytes 9 and 21"), "{notes}");
    assert_eq!(file.layout().size[..2], [3, 3]);
}

#[test]
fn line_numbers_elsewhere_are_refused_with_what_to_do() {
    let options = SegyOptions {
        // The number of the trace in the file, which is no line.
        trace_bytes: Some(TraceBytes {
            inline: 1,
            crossline: 189,
            ..TraceBytes::STANDARD
        }),
        ..SegyOptions::default()
    };
    let big = Segy {
        crosslines: [1200, 40, 3],
        inlines: [1100, 30, 7],
        ..Segy::new(5)
    };
    refused(&big.write(), &options, "--trace-bytes");
}

#[test]
fn further_texts_and_offsets_are_skipped() {
    for (revision, texts) in [(1, 2), (2, 1)] {
        let made = Segy {
            revision,
            texts,
            ..Segy::new(3)
        };
        assert_values(&opened(&made.write()), &made);
    }
    // A number of -1: a text that says it is the last one.
    let made = Segy::new(5);
    let mut bytes = made.write();
    bytes[3200 + 304..3200 + 306].copy_from_slice(&(-1_i16).to_be_bytes());
    let mut text = vec![b' '; 3200];
    let mut last = text.clone();
    text[..4].copy_from_slice(b"text");
    last[..16].copy_from_slice(b"((SEG: EndText))");
    bytes.splice(3600..3600, [text, last].concat());
    assert_values(&opened(&bytes), &made);
}

#[test]
fn a_stated_offset_of_the_first_trace_counts() {
    for is_little in [false, true] {
        let made = Segy {
            revision: 2,
            is_little,
            ..Segy::new(5)
        };
        let mut bytes = made.write();
        bytes.splice(3600..3600, [0x55; 100]);
        // The standard's bytes 3521 to 3528.
        let mut offset = 3700_u64.to_be_bytes();
        if is_little {
            offset.reverse();
        }
        bytes[3520..3528].copy_from_slice(&offset);
        assert_values(&opened(&bytes), &made);
    }
}

#[test]
fn a_last_trace_that_is_cut_off_is_left_out() {
    let made = Segy::new(5);
    let mut bytes = made.write();
    bytes.truncate(bytes.len() - 7);
    let file = opened(&bytes);
    assert_eq!(file.live_positions(), 11);
    assert!(file.notes().iter().any(|note| note.contains("cut off")));
}

#[test]
fn a_range_is_found_or_named() {
    let made = Segy {
        inlines: [1, 30, 1],
        crosslines: [1, 40, 1],
        value: |inline, crossline, sample| match (inline, crossline, sample) {
            (3, 3, 3) => 1e20,
            _ => ((inline * 7 + crossline * 3 + sample as i32) % 11 - 5) as f32,
        },
        ..Segy::new(5)
    };
    let bytes = made.write();
    let file = opened(&bytes);
    let [low, high] = file.layout().range;
    assert!(
        (5.0..7.0).contains(&high) && low == -high,
        "{low} to {high}"
    );
    assert!(file.notes().iter().any(|note| note.contains("--range")));
    let (_folder, path) = saved(&bytes);
    let options = SegyOptions {
        range: Some([-2.0, 2.0]),
        ..SegyOptions::default()
    };
    assert_eq!(open(&path, &options).unwrap().layout().range, [-2.0, 2.0]);
}

/// A survey of several bricks in all directions.
fn survey() -> Segy {
    Segy {
        samples: 70,
        inlines: [1, 40, 1],
        crosslines: [1, 67, 1],
        code: |inline, crossline| match (inline * 31 + crossline * 17) % 23 {
            0 => None,
            1 => Some(2),
            _ => Some(1),
        },
        value: |inline, crossline, sample| {
            let phase = (inline * 3 + crossline * 5 + sample as i32 * 7) as f32 * 0.05;
            phase.sin() * 1000.0
        },
        ..Segy::new(1)
    }
}

fn assert_same_bricks(a: &dyn BrickSource, b: &dyn BrickSource) {
    assert_eq!(a.layout(), b.layout());
    let [x, y, z] = a.layout().bricks();
    let mut samples = [vec![0; BRICK.pow(3)], vec![1; BRICK.pow(3)]];
    for brick in (0..z).flat_map(|z| (0..y).flat_map(move |y| (0..x).map(move |x| [x, y, z]))) {
        let [of_a, of_b] = &mut samples;
        a.read(brick, of_a).unwrap();
        b.read(brick, of_b).unwrap();
        assert_eq!(of_a, of_b, "brick {brick:?}");
    }
}

#[test]
fn a_written_volume_has_the_bricks_of_the_file() {
    let (folder, path) = saved(&survey().write());
    let file = open(&path, &SegyOptions::default()).unwrap();
    let volume = folder.path().join("a.vol");
    let mut seen = Vec::new();
    file.write(&volume, "survey", &mut |done, total| {
        seen.push((done, total))
    })
    .unwrap();
    assert_eq!(seen.last(), Some(&(6, 6)));
    let written = VolumeFile::open(&volume).unwrap();
    assert_eq!(written.name(), "survey");
    assert_same_bricks(&file, &written);
}

#[test]
fn crosslines_may_be_first_in_the_file() {
    let made = survey();
    let bytes = made.write();
    let trace = 240 + 70 * 4;
    let (head, traces) = bytes.split_at(3600);
    let mut traces: Vec<&[u8]> = traces.chunks(trace).collect();
    traces.sort_by_key(|trace| <[u8; 4]>::try_from(&trace[192..196]).unwrap());
    let turned = [head, &traces.concat()].concat();
    assert_ne!(turned, bytes);
    let (_one, one) = saved(&bytes);
    let (_other, other) = saved(&turned);
    // The amplitudes of all traces are counted, so that the ranges agree.
    let [one, other] = [one, other].map(|path| open(&path, &SegyOptions::default()).unwrap());
    assert_same_bricks(&one, &other);
}

#[test]
fn a_budget_that_takes_no_column_is_refused() {
    let (folder, path) = saved(&survey().write());
    let options = SegyOptions {
        max_memory: Some(200_000),
        ..SegyOptions::default()
    };
    let file = open(&path, &options).unwrap();
    let volume = folder.path().join("a.vol");
    let error = file.write(&volume, "", &mut |_, _| ()).unwrap_err();
    assert!(error.to_string().contains("--memory"), "{error}");
    assert!(!volume.exists());
    let tiny = SegyOptions {
        max_memory: Some(10_000),
        ..SegyOptions::default()
    };
    refused(&survey().write(), &tiny, "--memory");
}

#[test]
fn what_is_no_segy_is_refused_with_what_is_wrong() {
    let options = SegyOptions::default();
    let good = Segy::new(5).write();
    refused(&[], &options, "text header");
    refused(&good[..3500], &options, "binary header");
    refused(&good[..3700], &options, "before its first trace");
    let mut odd = good.clone();
    odd[3224..3226].copy_from_slice(&[77, 77]);
    refused(&odd, &options, "sample format");
    let mut none = good.clone();
    none[3220..3222].fill(0);
    none[3600 + 114..3600 + 116].fill(0);
    refused(&none, &options, "how many samples");
    let mut longer = good.clone();
    longer[3600 + 260 + 114..3600 + 260 + 116].copy_from_slice(&9_u16.to_be_bytes());
    longer.extend([0; 16]);
    refused(&longer, &options, "different lengths");
    let dead = Segy {
        code: |_, _| Some(2),
        ..Segy::new(5)
    };
    refused(&dead.write(), &options, "no live trace");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Bytes of the headers replaced by others give a volume that can be read, or an error.
    #[test]
    fn damaged_headers_are_survived(at in prop::collection::vec((0_usize..4200, any::<u8>()), 1..8), cut in 0_usize..4500) {
        let mut bytes = Segy { revision: 2, ..Segy::new(1) }.write();
        for (at, value) in at {
            let length = bytes.len();
            bytes[(3200 + at).min(length - 1)] = value;
        }
        bytes.truncate(bytes.len().saturating_sub(if cut < 600 { cut } else { 0 }));
        let (folder, path) = saved(&bytes);
        let options = SegyOptions { max_memory: Some(64 << 20), ..SegyOptions::default() };
        if let Ok(file) = open(&path, &options) {
            prop_assert!(file.layout().problem().is_none());
            brick(&file);
            if file.layout().bricks().iter().map(|n| u64::from(*n)).product::<u64>() < 64 {
                let volume = folder.path().join("a.vol");
                let _ = file.write(&volume, "", &mut |_, _| ());
            }
        }
    }
}
