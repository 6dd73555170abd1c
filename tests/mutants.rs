//! The list of mutations keeps up with the code: each place that it names is there once, and the page has its table. (What kills them is run by `make mutants`.)
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::Path;

/// A mutation of `scripts/mutants.list`: the values of its lines.
#[derive(Default)]
struct Mutation<'a> {
    name: &'a str,
    why: &'a str,
    file: &'a str,
    old: &'a str,
    new: &'a str,
    test: &'a str,
}

fn mutations(list: &str) -> Vec<Mutation<'_>> {
    let mut found: Vec<Mutation<'_>> = Vec::new();
    let lines = list
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'));
    for line in lines {
        let (key, value) = line.split_once(": ").unwrap_or_else(|| panic!("{line}"));
        if key == "mutation" {
            found.push(Mutation::default());
        }
        let last = found.last_mut().expect("a mutation begins with its name");
        match key {
            "mutation" => last.name = value,
            "why" => last.why = value,
            "file" => last.file = value,
            "old" => last.old = value,
            "new" => last.new = value,
            "test" => last.test = value,
            _ => panic!("no such key: {line}"),
        }
    }
    found
}

#[test]
fn every_mutation_has_its_place_and_its_row() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| {
        fs::read_to_string(root.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    };
    let list = read("scripts/mutants.list");
    let page = read("docs/mutants.md");
    let all = mutations(&list);
    assert!(all.len() > 20);
    for Mutation {
        name,
        why,
        file,
        old,
        new,
        test,
    } in &all
    {
        assert_eq!(
            read(file).matches(old).count(),
            1,
            "{name}: {file} has to have this place once: {old}"
        );
        assert_ne!(old, new, "{name}");
        assert!(
            test.contains(' '),
            "{name}: a program and a part of a test's name: {test}"
        );
        let row = format!("| {name} | {why} | `{file}` | `{test}` |");
        assert!(
            page.contains(&row),
            "docs/mutants.md has to have this row: {row}"
        );
    }
    let rows = page.lines().filter(|line| line.ends_with("` |")).count();
    assert_eq!(
        rows,
        all.len(),
        "docs/mutants.md: `scripts/mutants.sh --table` prints its table"
    );
}
