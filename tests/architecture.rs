//! The picture of the crates in `docs/architecture.md` is the one that the code's own imports make, and there is no arrow that the page does not allow.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Arrows = BTreeMap<String, BTreeSet<String>>;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The published crates below the root, by name without `antumbra-`, each with its folder.
fn crates() -> BTreeMap<String, PathBuf> {
    let below = fs::read_dir(root().join("crates")).unwrap();
    let folders = below.map(|entry| entry.unwrap().path());
    let folders = folders.chain([root().join("shaders")]);
    let named = folders.map(|folder| {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        (name, folder)
    });
    // What only tests use is no part of the house.
    named.filter(|(name, _)| name != "testing").collect()
}

fn source_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            source_files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// Whose names a crate's code mentions, comments and tests aside.
fn imports() -> Arrows {
    let crates = crates();
    let mut arrows = Arrows::new();
    for (name, folder) in &crates {
        let mut files = Vec::new();
        source_files(&folder.join("src"), &mut files);
        let mut to = BTreeSet::new();
        for file in files {
            let text = fs::read_to_string(file).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            for line in code
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
            {
                for other in crates.keys().filter(|other| *other != name) {
                    let item = format!("antumbra_{}::", other.replace('-', "_"));
                    let module = format!("antumbra::{}", other.replace('-', "_"));
                    if line.contains(&item) || line.contains(&module) {
                        to.insert(other.clone());
                    }
                }
            }
        }
        arrows.insert(name.clone(), to);
    }
    arrows
}

/// What can be reached from a crate in two or more steps.
fn far(arrows: &Arrows, from: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut stack: Vec<&String> = arrows[from].iter().flat_map(|near| &arrows[near]).collect();
    while let Some(next) = stack.pop() {
        if found.insert(next.clone()) {
            stack.extend(&arrows[next]);
        }
    }
    found
}

/// The picture: every arrow that no longer way implies.
fn picture(arrows: &Arrows) -> String {
    let mut lines = vec!["flowchart LR".to_owned()];
    for (from, to) in arrows {
        let implied = far(arrows, from);
        let shown = to.iter().filter(|to| !implied.contains(*to));
        lines.extend(shown.map(|to| format!("  {from} --> {to}")));
    }
    lines.join("\n")
}

#[test]
fn the_page_shows_the_crates_as_the_code_imports_them() {
    let page = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let picture = picture(&imports());
    assert!(
        page.contains(&picture),
        "docs/architecture.md has another picture than the code; it should be:\n{picture}"
    );
}

#[test]
fn no_arrow_runs_back_and_none_is_there_that_the_page_does_not_list() {
    let page = fs::read_to_string(root().join("docs/architecture.md")).unwrap();
    let arrows = imports();
    for (from, to) in &arrows {
        assert!(
            !far(&arrows, from).contains(from),
            "{from} depends on itself"
        );
        // The table of rooms: | `crate` | what is in it | `a`, `b` |
        let row = page
            .lines()
            .find(|line| line.starts_with(&format!("| `{from}` |")));
        let row = row.unwrap_or_else(|| panic!("{from} is not in the page's table of crates"));
        let last = row.trim_end_matches('|').rsplit('|').next().unwrap();
        let allowed: BTreeSet<&str> = last.split('`').skip(1).step_by(2).collect();
        let found: BTreeSet<&str> = to.iter().map(String::as_str).collect();
        assert_eq!(
            found, allowed,
            "{from}: what it imports, and what the page's table lists"
        );
    }
}

#[test]
fn a_crate_depends_on_what_it_imports_and_on_no_other_crate_of_ours() {
    let arrows = imports();
    for (name, folder) in crates() {
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let depends = manifest
            .split("\n[dependencies]\n")
            .nth(1)
            .unwrap_or_default();
        let depends = depends.split("\n[").next().unwrap();
        let named: BTreeSet<&str> = depends
            .lines()
            .filter_map(|line| line.strip_prefix("antumbra-"))
            .filter_map(|line| line.split(['.', ' ', '=']).next())
            .collect();
        // The program goes through the facade, and so does the plug-in.
        if !["cli", "bevy"].contains(&name.as_str()) {
            let imported: BTreeSet<&str> = arrows[&name].iter().map(String::as_str).collect();
            assert_eq!(named, imported, "{name}: its manifest, and what it imports");
        }
    }
}
