//! `src/generated.rs` is what naga says of the files of `wgsl/` today. With `UPDATE_SHADERS=1` (`make shaders`) it is written anew.
#![allow(clippy::unwrap_used, clippy::panic)]

mod emit;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{env, fs};

use antumbra_shaders::{Job, SharedSource};

fn folder() -> PathBuf {
    PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap())
}

/// The `.wgsl` files of a folder, by name.
fn read_folder(folder: &Path) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "wgsl") {
            continue;
        }
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        assert!(
            is_module_name(&name),
            "{}: a shader's file name becomes a Rust module's; use a-z, 0-9 and _, a letter first",
            path.display()
        );
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            text.ends_with('\n'),
            "{}: end the last line, for other files are joined to it",
            path.display()
        );
        found.push((name, text));
    }
    found.sort();
    found
}

fn is_module_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// The text of `src/generated.rs`, from the files as they are. An error in a shared file is reported once, not for each job that imports it.
fn generated() -> String {
    let root = folder().join("wgsl");
    let shared = read_folder(&root.join("shared"));
    let sources: Vec<SharedSource<'_>> = shared
        .iter()
        .map(|(name, text)| SharedSource { name, text })
        .collect();
    let mut jobs = Vec::new();
    let mut errors = BTreeSet::new();
    for (name, text) in read_folder(&root) {
        match Job::from_wgsl_with(&name, &text, &sources) {
            Ok(job) => jobs.push(job),
            Err(error) => {
                errors.insert(error.to_string());
            }
        }
    }
    if !errors.is_empty() {
        let errors: Vec<String> = errors.into_iter().collect();
        panic!("shaders with errors:\n\n{}", errors.join("\n\n"));
    }
    emit::jobs(&jobs, &sources).unwrap()
}

#[test]
fn what_is_generated_is_what_the_shaders_say() {
    let path = folder().join("src/generated.rs");
    let expected = generated();
    if env::var_os("UPDATE_SHADERS").is_some() {
        let beside = path.with_extension("rs.new");
        fs::write(&beside, expected).unwrap();
        fs::rename(&beside, &path).unwrap();
        return;
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(
        found == expected,
        "src/generated.rs is not what wgsl/ says: run `make shaders`"
    );
}

#[test]
fn the_text_of_a_job_is_its_files_joined() {
    let shared = antumbra_shaders::jobs::SHARED;
    for job in antumbra_shaders::jobs::ALL {
        let text = fs::read_to_string(folder().join(format!("wgsl/{}.wgsl", job.name))).unwrap();
        let joined = Job::from_wgsl_with(&job.name, &text, shared).unwrap();
        assert_eq!(job.source, joined.source, "{}", job.name);
    }
}
