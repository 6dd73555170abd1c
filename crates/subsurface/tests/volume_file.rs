//! Volume files: written volumes are read back, and invalid files are rejected with a message.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod volume_rule;

use std::path::{Path, PathBuf};

use antumbra_subsurface::{BrickSource, SubsurfaceError, VolumeFile, VolumeLayout, write_volume};
use proptest::prelude::*;
use volume_rule::{Rule, layout};

/// Offsets of the numbers in the header.
const VERSION: usize = 8;
const NAME_LENGTH: usize = 12;
const SIZE: usize = 16;
const BRICK: usize = 28;
const ORIGIN: usize = 32;
const STEPS: usize = 56;
const RANGE: usize = 128;
const NAME: usize = 136;
const HEADER: usize = 4096;

struct Written {
    folder: tempfile::TempDir,
    path: PathBuf,
}

fn written(rule: &Rule, name: &str) -> Written {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("test.volume");
    write_volume(&path, name, rule, &mut |_, _| {}).unwrap();
    Written { folder, path }
}

/// The message for a file whose bytes were changed.
fn refused(change: impl FnOnce(&mut Vec<u8>)) -> String {
    let file = written(&Rule::new([9, 5, 3], 4), "small");
    let mut bytes = std::fs::read(&file.path).unwrap();
    change(&mut bytes);
    std::fs::write(&file.path, bytes).unwrap();
    let error = VolumeFile::open(&file.path).unwrap_err();
    assert!(matches!(error, SubsurfaceError::Format { .. }), "{error}");
    error.to_string()
}

fn put<const N: usize>(bytes: &mut [u8], at: usize, number: [u8; N]) {
    bytes[at..at + N].copy_from_slice(&number);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn what_was_written_comes_back(size in [1u32..20, 1u32..20, 1u32..20], brick in 1u32..9, name in "\\PC{0,30}") {
        let rule = Rule::new(size, brick);
        let file = written(&rule, &name);
        let opened = VolumeFile::open(&file.path).unwrap();
        prop_assert_eq!(opened.layout(), &rule.layout);
        prop_assert_eq!(opened.name(), &name);
        let [x, y, z] = rule.layout.bricks();
        let mut got = vec![0; rule.layout.brick_bytes()];
        let mut expected = got.clone();
        for brick in (0..x).flat_map(|x| (0..y).flat_map(move |y| (0..z).map(move |z| [x, y, z]))) {
            opened.read(brick, &mut got).unwrap();
            rule.read(brick, &mut expected).unwrap();
            prop_assert_eq!(&got, &expected, "brick {:?}", brick);
        }
    }

    #[test]
    fn no_header_ends_the_program(start in 0usize..NAME, garbage in prop::collection::vec(any::<u8>(), 1..64)) {
        let file = written(&Rule::new([9, 5, 3], 4), "small");
        let mut bytes = std::fs::read(&file.path).unwrap();
        bytes[start..start + garbage.len()].copy_from_slice(&garbage);
        std::fs::write(&file.path, bytes).unwrap();
        // Some changes cannot be detected; a file that opens must be readable to its last brick.
        if let Ok(opened) = VolumeFile::open(&file.path) {
            let last = opened.layout().bricks().map(|count| count - 1);
            opened.read(last, &mut vec![0; opened.layout().brick_bytes()]).unwrap();
        }
    }
}

#[test]
fn every_brick_is_made_once_and_progress_ends_with_all() {
    let rule = Rule::new([40, 30, 20], 8);
    let folder = tempfile::tempdir().unwrap();
    let mut heard = Vec::new();
    write_volume(&folder.path().join("v"), "", &rule, &mut |done, total| {
        heard.push((done, total))
    })
    .unwrap();
    assert_eq!(heard.first(), Some(&(0, 60)));
    assert_eq!(heard.last(), Some(&(60, 60)));
    let asked = rule.take_asked();
    let mut once = asked.clone();
    once.dedup();
    assert_eq!((asked.len(), once.len()), (60, 60));
}

#[test]
fn a_file_begins_as_its_description_says() {
    let file = written(&Rule::new([9, 5, 3], 4), "Nørth");
    let bytes = std::fs::read(&file.path).unwrap();
    assert_eq!(&bytes[..8], b"\x89AVOL\r\n\x1a");
    assert_eq!(&bytes[NAME..NAME + 6], "Nørth".as_bytes());
    assert_eq!(bytes[SIZE..SIZE + 12], [9, 0, 0, 0, 5, 0, 0, 0, 3, 0, 0, 0]);
    assert_eq!(bytes.len(), HEADER + 3 * 2 * 64);
}

/// A source that fails in the middle.
struct Broken(VolumeLayout);

impl BrickSource for Broken {
    fn layout(&self) -> &VolumeLayout {
        &self.0
    }

    fn read(&self, brick: [u32; 3], _: &mut [u8]) -> Result<(), SubsurfaceError> {
        match brick {
            [0, 0, 0] => Ok(()),
            brick => Err(SubsurfaceError::NoSuchBrick {
                brick,
                bricks: [1; 3],
            }),
        }
    }
}

#[test]
fn a_source_that_fails_leaves_what_was_there() {
    let file = written(&Rule::new([9, 5, 3], 4), "small");
    let before = std::fs::read(&file.path).unwrap();
    let broken = Broken(layout([9, 9, 9], 4));
    let error = write_volume(&file.path, "", &broken, &mut |_, _| {}).unwrap_err();
    assert!(matches!(error, SubsurfaceError::NoSuchBrick { .. }));
    assert_eq!(std::fs::read(&file.path).unwrap(), before);
    assert_eq!(std::fs::read_dir(file.folder.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn a_written_file_has_the_rights_of_any_other() {
    use std::os::unix::fs::PermissionsExt;
    let file = written(&Rule::new([1; 3], 1), "");
    let plain = file.folder.path().join("plain");
    std::fs::write(&plain, "").unwrap();
    let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&file.path), mode(&plain));
}

#[test]
fn what_cannot_be_written_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("v");
    let none = write_volume(&path, "", &Rule::new([0, 5, 5], 4), &mut |_, _| {});
    assert!(none.unwrap_err().to_string().contains("0 samples inline"));
    let long = write_volume(
        &path,
        &"x".repeat(1025),
        &Rule::new([1; 3], 1),
        &mut |_, _| {},
    );
    assert!(long.unwrap_err().to_string().contains("1025 bytes"));
    let nowhere = write_volume(
        &folder.path().join("no/such/folder/v"),
        "",
        &Rule::new([1; 3], 1),
        &mut |_, _| {},
    );
    assert!(matches!(
        nowhere,
        Err(SubsurfaceError::File {
            action: "create",
            ..
        })
    ));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_file_cut_short_is_told_both_lengths() {
    let said = refused(|bytes| bytes.truncate(bytes.len() - 1));
    let whole = HEADER + 3 * 2 * 64;
    assert!(said.contains(&(whole - 1).to_string()), "{said}");
    assert!(said.contains(&whole.to_string()), "{said}");
    let said = refused(|bytes| bytes.truncate(HEADER - 1));
    assert!(said.contains("4095") && said.contains("4096"), "{said}");
    let said = refused(Vec::clear);
    assert!(said.contains("0 bytes"), "{said}");
}

#[test]
fn a_file_that_goes_on_is_refused() {
    let said = refused(|bytes| bytes.push(0));
    assert!(said.contains("something else follows"), "{said}");
}

#[test]
fn a_file_of_another_kind_or_version_is_refused() {
    assert!(refused(|bytes| bytes[4] = b'X').contains("mark"));
    let said = refused(|bytes| put(bytes, VERSION, 2u32.to_le_bytes()));
    assert!(said.contains("version 2"), "{said}");
}

#[test]
fn lying_sizes_are_refused() {
    let said = refused(|bytes| put(bytes, SIZE, 17u32.to_le_bytes()));
    assert!(said.contains("its header says"), "{said}");
    let said = refused(|bytes| put(bytes, SIZE, 0u32.to_le_bytes()));
    assert!(said.contains("0 samples inline"), "{said}");
    let said = refused(|bytes| put(bytes, SIZE + 4, u32::MAX.to_le_bytes()));
    assert!(said.contains("4294967295 samples crossline"), "{said}");
    for brick in [0, 257, u32::MAX] {
        let said = refused(|bytes| put(bytes, BRICK, brick.to_le_bytes()));
        assert!(said.contains(&format!("bricks of {brick}")), "{said}");
    }
    let said = refused(|bytes| put(bytes, NAME_LENGTH, u32::MAX.to_le_bytes()));
    assert!(said.contains("a name of 4294967295 bytes"), "{said}");
}

#[test]
fn the_largest_sizes_do_not_overflow() {
    for brick in [1u32, 3, 256] {
        let said = refused(|bytes| {
            for axis in 0..3 {
                put(bytes, SIZE + 4 * axis, (1u32 << 20).to_le_bytes());
            }
            put(bytes, BRICK, brick.to_le_bytes());
        });
        assert!(said.contains("its header says 11529"), "{said}");
    }
}

#[test]
fn numbers_that_are_none_are_refused() {
    let said = refused(|bytes| put(bytes, ORIGIN + 8, f64::NAN.to_le_bytes()));
    assert!(said.contains("origin"), "{said}");
    let said = refused(|bytes| put(bytes, STEPS + 32, f64::INFINITY.to_le_bytes()));
    assert!(said.contains("step"), "{said}");
    let said = refused(|bytes| {
        put(bytes, STEPS + 56, (-1e9f64).to_le_bytes());
        put(bytes, SIZE + 8, (1u32 << 20).to_le_bytes());
    });
    assert!(said.contains("far corner"), "{said}");
    let said = refused(|bytes| put(bytes, ORIGIN, f64::MAX.to_le_bytes()));
    assert!(said.contains("origin"), "{said}");
    let said = refused(|bytes| put(bytes, STEPS + 56, 0f64.to_le_bytes()));
    assert!(said.contains("do not span space"), "{said}");
    for end in [f32::NAN, f32::INFINITY, -2.0, -3.0] {
        let said = refused(|bytes| put(bytes, RANGE + 4, end.to_le_bytes()));
        assert!(said.contains("a range from -2"), "{said}");
    }
    let said = refused(|bytes| bytes[NAME + 2] = 0xff);
    assert!(said.contains("byte 138"), "{said}");
}

#[test]
fn what_is_no_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    assert!(VolumeFile::open(folder.path()).is_err());
    let missing = VolumeFile::open(&folder.path().join("missing"));
    assert!(matches!(missing, Err(SubsurfaceError::File { .. })));
}

#[test]
fn bricks_that_are_not_there_and_wrong_buffers_are_refused() {
    let file = written(&Rule::new([9, 5, 3], 4), "small");
    let opened = VolumeFile::open(&file.path).unwrap();
    for brick in [[3, 0, 0], [0, 2, 0], [0, 0, 1], [u32::MAX; 3]] {
        let got = opened.read(brick, &mut [0; 64]);
        assert!(matches!(got, Err(SubsurfaceError::NoSuchBrick { .. })));
    }
    let got = opened.read([0; 3], &mut [0; 63]);
    assert!(matches!(got, Err(SubsurfaceError::BufferLength { .. })));
}
