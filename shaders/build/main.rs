//! Generates Rust from `wgsl/*.wgsl`: joins, parses, validates and reflects each file with naga, and writes `$OUT_DIR/jobs.rs`. An error of
//! naga fails the build, with naga's message, the file and the line.

#[allow(dead_code, reason = "shared with the library, which uses all of it")]
#[path = "../src/error.rs"]
mod error;
#[allow(dead_code, reason = "shared with the library, which uses all of it")]
#[path = "../src/job.rs"]
mod job;
#[path = "../src/reflect.rs"]
mod reflect;
#[path = "../src/report.rs"]
mod report;
#[path = "../src/source.rs"]
mod source;

mod emit;

use std::{
    collections::HashSet,
    env, fs,
    path::{Path, PathBuf},
    process::ExitCode,
};

fn main() -> ExitCode {
    println!("cargo:rerun-if-changed=wgsl");
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(messages) => {
            eprintln!(
                "\nshaders that cannot be built, paths from the folder of antumbra-shaders:\n"
            );
            for message in messages {
                eprintln!("{message}");
            }
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Vec<String>> {
    let one = |message: String| vec![message];
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default()).join("wgsl");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let shared = read_folder(&root.join("shared")).map_err(one)?;
    let files = read_folder(&root).map_err(one)?;
    let sources: Vec<source::SharedSource<'_>> = shared
        .iter()
        .map(|(name, text)| source::SharedSource { name, text })
        .collect();
    let mut jobs = Vec::new();
    let mut failed = Vec::new();
    for (name, text) in &files {
        match reflect::job(name, text, &sources) {
            Ok(job) => jobs.push(job),
            Err(error) => failed.push(error.to_string()),
        }
    }
    // An error in a shared file is found once for each job that imports it.
    let mut reported = HashSet::new();
    failed.retain(|message| reported.insert(message.clone()));
    if !failed.is_empty() {
        return Err(failed);
    }
    emit::write(&out, &jobs, &sources).map_err(one)
}

/// The `.wgsl` files of a folder, by name; empty if there is no such folder.
fn read_folder(folder: &Path) -> Result<Vec<(String, String)>, String> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else {
        return Ok(found);
    };
    for entry in entries {
        let path = entry
            .map_err(|e| format!("{}: {e}", folder.display()))?
            .path();
        if path.extension().is_none_or(|extension| extension != "wgsl") {
            continue;
        }
        let name = path.file_stem().and_then(|stem| stem.to_str());
        let Some(name) = name.filter(|name| is_module_name(name)) else {
            return Err(format!(
                "{}: a shader's file name becomes a Rust module's; use a-z, 0-9 and _, a letter first",
                path.display()
            ));
        };
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        found.push((name.to_owned(), text));
    }
    found.sort();
    Ok(found)
}

fn is_module_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}
