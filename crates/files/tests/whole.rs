//! Whole files: what was there stays until the new file is complete, links are followed, permissions kept, and leftovers swept.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod listing;

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::Path;

use antumbra_files::{FileContents, WholeFile, probe, sweep, write_together};
use listing::names;

fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = WholeFile::create(path)?;
    file.file().write_all(bytes)?;
    file.finish()
}

#[test]
fn an_unfinished_file_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let mut file = WholeFile::create(&path).unwrap();
    file.file().write_all(b"half").unwrap();
    assert_eq!(names(folder.path()).len(), 2);
    drop(file);
    assert_eq!(names(folder.path()), ["a.txt"]);
    assert_eq!(fs::read(&path).unwrap(), b"old");
    write(&path, b"new").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"new");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn a_folder_where_a_file_should_be_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let error = WholeFile::create(folder.path()).unwrap_err();
    assert!(error.to_string().contains("it is a folder"), "{error}");
    let missing = folder.path().join("missing/a.txt");
    assert_eq!(probe(&missing).unwrap_err().kind(), ErrorKind::NotFound);
}

#[test]
fn files_appear_together_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| FileContents {
        path: folder.path().join(name),
        bytes: name.into(),
    };
    let failed = write_together(&[file("a"), file("missing/b")]).unwrap_err();
    assert!(failed.path.ends_with("missing/b"));
    assert!(names(folder.path()).is_empty());
    write_together(&[file("a"), file("b")]).unwrap();
    assert_eq!(names(folder.path()), ["a", "b"]);
}

/// A part as a killed process leaves it.
fn leftover(folder: &Path) -> std::path::PathBuf {
    let path = folder.join(".antumbra-abcdefghijkl.partial");
    fs::write(&path, "half").unwrap();
    path
}

#[test]
fn leftovers_are_swept_and_nothing_else_is() {
    let folder = tempfile::tempdir().unwrap();
    let left = leftover(folder.path());
    let others = [
        ".antumbra-short.partial",
        ".antumbra-abcdefghijkl.part",
        ".antumbra-abcdef-hijkl.partial",
        ".volume-x.partial",
    ];
    for other in others {
        fs::write(folder.path().join(other), "not ours").unwrap();
    }
    let mut own = WholeFile::create(&folder.path().join("own.txt")).unwrap();
    own.file().write_all(b"whole").unwrap();
    sweep(folder.path());
    assert!(!left.exists());
    own.finish().unwrap();
    let kept = names(folder.path());
    assert_eq!(kept.len(), others.len() + 1, "{kept:?}");
    assert_eq!(fs::read(folder.path().join("own.txt")).unwrap(), b"whole");
}

#[test]
fn what_another_process_is_writing_is_no_leftover() {
    let folder = tempfile::tempdir().unwrap();
    let path = leftover(folder.path());
    let theirs = File::open(&path).unwrap();
    theirs.lock().unwrap();
    probe(&folder.path().join("own.txt")).unwrap();
    assert!(path.exists());
    drop(theirs);
    probe(&folder.path().join("own.txt")).unwrap();
    assert!(names(folder.path()).is_empty());
}

#[cfg(unix)]
mod unix {
    use super::*;

    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    use antumbra_files::{open, read_whole_file};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn links_stay_and_the_file_they_lead_to_is_written() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("deep")).unwrap();
        let file = folder.path().join("deep/file.txt");
        fs::write(&file, "old").unwrap();
        for (link, to) in [
            ("one", "deep/file.txt"),
            ("two", "one"),
            ("new", "deep/later.txt"),
        ] {
            symlink(to, folder.path().join(link)).unwrap();
        }
        write(&folder.path().join("two"), b"new").unwrap();
        write(&folder.path().join("new"), b"later").unwrap();
        for link in ["one", "two", "new"] {
            let found = fs::symlink_metadata(folder.path().join(link)).unwrap();
            assert!(found.is_symlink(), "{link}");
        }
        assert_eq!(fs::read(&file).unwrap(), b"new");
        let later = fs::read(folder.path().join("deep/later.txt"));
        assert_eq!(later.unwrap(), b"later");
        assert_eq!(names(&folder.path().join("deep")).len(), 2);
    }

    #[test]
    fn permissions_are_kept_and_a_read_only_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        for kept in [0o600, 0o640, 0o664] {
            fs::set_permissions(&path, fs::Permissions::from_mode(kept)).unwrap();
            write(&path, b"new").unwrap();
            assert_eq!(mode(&path), kept);
        }
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        for error in [write(&path, b"other"), probe(&path)] {
            let error = error.unwrap_err();
            assert_eq!(error.kind(), ErrorKind::PermissionDenied);
            assert!(error.to_string().contains("read-only"), "{error}");
        }
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn a_device_stays_a_device() {
        let error = WholeFile::create(Path::new("/dev/null")).unwrap_err();
        assert!(error.to_string().contains("a device"), "{error}");
        let null = fs::metadata("/dev/null").unwrap().file_type();
        assert!(null.is_char_device());
    }

    #[test]
    fn a_fifo_where_a_file_should_be_is_not_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let fifo = folder.path().join("fifo");
        let made = std::process::Command::new("mkfifo").arg(&fifo).status();
        assert!(made.unwrap().success());
        for error in [
            open(&fifo).unwrap_err(),
            read_whole_file(&fifo, 10).unwrap_err(),
            WholeFile::create(&fifo).unwrap_err(),
        ] {
            assert!(error.to_string().contains("a FIFO"), "{error}");
        }
    }
}
