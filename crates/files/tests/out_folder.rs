//! A folder of outputs: one writer at a time, nothing left where nothing was written, and no file of an earlier set.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod listing;

use std::fs;
use std::io::ErrorKind;

use antumbra_files::{FileContents, OutFolder};
use listing::names;

fn file(name: &str) -> FileContents {
    FileContents {
        path: name.into(),
        bytes: name.into(),
    }
}

#[test]
fn two_writers_exclude_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let first = OutFolder::open(folder.path()).unwrap();
    let refused = OutFolder::open(folder.path()).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::ResourceBusy);
    assert!(refused.to_string().contains("another run"), "{refused}");
    drop(first);
    OutFolder::open(folder.path()).unwrap();
    assert!(names(folder.path()).is_empty());
}

#[test]
fn folders_are_made_and_go_again_if_nothing_is_written() {
    let outer = tempfile::tempdir().unwrap();
    let path = outer.path().join("a/b");
    drop(OutFolder::open(&path).unwrap());
    assert!(names(outer.path()).is_empty());
    let folder = OutFolder::open(&path).unwrap();
    folder.replace(vec![file("x")], &[]).unwrap();
    drop(folder);
    assert_eq!(names(&path), ["x"]);
}

#[test]
fn what_an_earlier_set_named_is_removed_and_nothing_else_is() {
    let outer = tempfile::tempdir().unwrap();
    let folder = OutFolder::open(outer.path()).unwrap();
    for name in ["own", "1.png", "2.png", "3.png"] {
        fs::write(outer.path().join(name), "old").unwrap();
    }
    let old = ["1.png", "2.png", "gone.png"].map(str::to_owned);
    let files = vec![file("2.png"), file("report")];
    folder.replace(files, &old).unwrap();
    drop(folder);
    assert_eq!(names(outer.path()), ["2.png", "3.png", "own", "report"]);
    assert_eq!(fs::read(outer.path().join("2.png")).unwrap(), b"2.png");
}

#[test]
fn what_an_earlier_set_named_and_is_no_regular_file_stays() {
    let outer = tempfile::tempdir().unwrap();
    let folder = OutFolder::open(outer.path()).unwrap();
    for name in ["report", "1.png"] {
        fs::write(outer.path().join(name), "old").unwrap();
    }
    fs::create_dir(outer.path().join("2.png")).unwrap();
    let old = ["2.png", "1.png"].map(str::to_owned);
    folder.replace(vec![file("report")], &old).unwrap();
    assert_eq!(fs::read(outer.path().join("report")).unwrap(), b"report");
    drop(folder);
    assert_eq!(names(outer.path()), ["2.png", "report"]);
}

#[test]
fn a_set_that_fails_changes_nothing() {
    let outer = tempfile::tempdir().unwrap();
    let folder = OutFolder::open(outer.path()).unwrap();
    for name in ["1.png", "report"] {
        fs::write(outer.path().join(name), "old").unwrap();
    }
    fs::create_dir(outer.path().join("page")).unwrap();
    let files = vec![file("page"), file("report")];
    let failed = folder.replace(files, &["1.png".to_owned()]).unwrap_err();
    assert!(failed.path.ends_with("page"));
    drop(folder);
    assert_eq!(names(outer.path()), ["1.png", "page", "report"]);
    assert_eq!(fs::read(outer.path().join("report")).unwrap(), b"old");
}

#[test]
fn a_file_where_the_folder_should_be_is_refused() {
    let outer = tempfile::tempdir().unwrap();
    let path = outer.path().join("file");
    fs::write(&path, "a file").unwrap();
    OutFolder::open(&path).unwrap_err();
    OutFolder::open(&path.join("below")).unwrap_err();
    assert_eq!(names(outer.path()), ["file"]);
}

#[cfg(unix)]
#[test]
fn a_new_file_whose_link_leads_to_an_old_name_stays() {
    use std::os::unix::fs::symlink;
    let outer = tempfile::tempdir().unwrap();
    let folder = OutFolder::open(outer.path()).unwrap();
    for name in ["2.png", "3.png"] {
        fs::write(outer.path().join(name), "old").unwrap();
    }
    symlink("2.png", outer.path().join("1.png")).unwrap();
    let old = ["2.png", "3.png"].map(str::to_owned);
    folder
        .replace(vec![file("1.png"), file("report")], &old)
        .unwrap();
    drop(folder);
    assert_eq!(names(outer.path()), ["1.png", "2.png", "report"]);
    assert_eq!(fs::read(outer.path().join("1.png")).unwrap(), b"1.png");
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_to_a_folder_that_is_not_there_yet() {
    use std::os::unix::fs::symlink;
    let outer = tempfile::tempdir().unwrap();
    let link = outer.path().join("link");
    symlink("deep/out", &link).unwrap();
    drop(OutFolder::open(&link).unwrap());
    assert_eq!(names(outer.path()), ["link"]);
    let folder = OutFolder::open(&link).unwrap();
    folder.replace(vec![file("x")], &[]).unwrap();
    drop(folder);
    assert_eq!(names(&outer.path().join("deep/out")), ["x"]);
    // A link that leads to itself.
    let turning = outer.path().join("turning");
    symlink("turning", &turning).unwrap();
    OutFolder::open(&turning).unwrap_err();
    assert_eq!(names(outer.path()), ["deep", "link", "turning"]);
}
