//! The program, run as on a command line.
#![allow(dead_code, reason = "each test program uses some of it")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// The program's path.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_antumbra");

/// Keeps Mesa's device selection from complaining on standard error where there is no desktop.
pub const QUIET_MESA: (&str, &str) = ("NODEVICE_SELECT", "1");

/// A folder for files, removed with all that is in it.
pub struct Folder(TempDir);

impl Folder {
    /// An empty one.
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// The path of a file in it; of the folder itself for an empty name.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The path of a file in it, as an argument.
    pub fn at(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_owned()
    }

    /// Writes a file; its path, as an argument.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> String {
        fs::write(self.path(name), contents).unwrap();
        self.at(name)
    }
}

/// The program, not yet started. What it prints is caught.
pub fn program<T: AsRef<OsStr>>(arguments: &[T]) -> Command {
    caught(Command::new(PROGRAM), arguments)
}

/// A command that starts the program, with the program's arguments. What is printed is caught.
pub fn caught<T: AsRef<OsStr>>(mut command: Command, arguments: &[T]) -> Command {
    command
        .args(arguments)
        .env(QUIET_MESA.0, QUIET_MESA.1)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Runs the program.
pub fn antumbra(arguments: &[&str]) -> Output {
    program(arguments).output().unwrap()
}

/// The names of a folder's files, sorted. A folder that is missing has none.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// What it complained of.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The run succeeds; what it printed.
pub fn succeeds(arguments: &[&str]) -> String {
    let output = antumbra(arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        stderr(&output)
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The run fails with this status, and its message has all of these words in it.
pub fn refuses(arguments: &[&str], status: i32, words: &[&str]) {
    let output = antumbra(arguments);
    let message = stderr(&output);
    assert_eq!(
        output.status.code(),
        Some(status),
        "{arguments:?}: {message}"
    );
    for word in words {
        assert!(
            message.contains(word),
            "{arguments:?}: '{word}' is not in: {message}"
        );
    }
    assert!(!message.contains("panicked"), "{message}");
}
