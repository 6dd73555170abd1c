//! The program, run as on a command line.
#![allow(dead_code, reason = "each test program uses some of it")]

use std::process::Output;

use assert_cmd::Command;

/// Keeps Mesa's device selection from complaining on standard error where there is no desktop.
pub const QUIET_MESA: (&str, &str) = ("NODEVICE_SELECT", "1");

/// Runs the program.
pub fn antumbra(arguments: &[&str]) -> Output {
    Command::cargo_bin("antumbra")
        .unwrap()
        .args(arguments)
        .env(QUIET_MESA.0, QUIET_MESA.1)
        .output()
        .unwrap()
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
