//! Imports: once each, in any depth, with errors that name the file and the line the author wrote.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_shaders::{Job, ShaderError, SharedSource, SourceLine};
use proptest::prelude::*;

const BASE: SharedSource<'_> = SharedSource {
    name: "base",
    text: "fn one() -> u32 { return 1u; }\n",
};
const TWICE: SharedSource<'_> = SharedSource {
    name: "twice",
    text: "//!import base\n\nfn two() -> u32 { return one() + one(); }",
};

fn line(file: &str, line: u32) -> SourceLine<'_> {
    SourceLine { file, line }
}

fn job(text: &str, shared: &[SharedSource<'_>]) -> Result<Job, ShaderError> {
    Job::from_wgsl_with("job", text, shared)
}

#[test]
fn a_diamond_brings_each_file_once_and_keeps_the_jobs_own_lines() {
    let text = "//!import base\n//!import twice\nenable f16;\n@compute @workgroup_size(1)\nfn main() { _ = one() + two(); }\n";
    let job = job(text, &[BASE, TWICE]).unwrap();
    assert!(job.source.starts_with(text));
    assert_eq!(job.source.matches("fn one").count(), 1);
    assert_eq!(job.locate(5), Some(line("wgsl/job.wgsl", 5)));
    assert_eq!(job.locate(6), Some(line("wgsl/shared/base.wgsl", 1)));
    assert_eq!(job.locate(9), Some(line("wgsl/shared/twice.wgsl", 3)));
    assert_eq!(job.locate(10), None);
    assert_eq!(job.locate(0), None);
}

#[test]
fn line_ends_of_windows_are_fine() {
    let job = job(
        "//!import base\r\n@compute @workgroup_size(1)\r\nfn main() { _ = one(); }\r\n",
        &[BASE],
    );
    assert_eq!(
        job.unwrap().locate(4),
        Some(line("wgsl/shared/base.wgsl", 1))
    );
}

#[test]
fn cycles_are_named_in_order() {
    let a = SharedSource {
        name: "a",
        text: "//!import b\n",
    };
    let b = SharedSource {
        name: "b",
        text: "//!import base\n//!import a\n",
    };
    let error = job("//!import a\n", &[a, b, BASE]).unwrap_err();
    assert_eq!(
        error,
        ShaderError::ImportCycle {
            file: "wgsl/shared/b.wgsl".to_owned(),
            line: 2,
            chain: "a -> b -> a".to_owned(),
        }
    );
    let own = SharedSource {
        name: "own",
        text: "//!import own\n",
    };
    let error = job("//!import own\n", &[own]).unwrap_err();
    assert!(error.to_string().contains("own -> own"), "{error}");
}

#[test]
fn unknown_late_and_misspelt_imports_say_where_and_what_to_do() {
    let unknown = job("\n//!import bas\n", &[BASE]).unwrap_err().to_string();
    assert!(
        unknown.starts_with("wgsl/job.wgsl:2: imports come first"),
        "{unknown}"
    );
    let unknown = job("//!import bas\n", &[BASE]).unwrap_err().to_string();
    assert_eq!(
        unknown,
        "wgsl/job.wgsl:1: there is no shared file `bas`; there are: base"
    );
    let late = job("// why\n//!import base\n", &[BASE]).unwrap_err();
    assert!(
        matches!(late, ShaderError::LateImport { line: 2, .. }),
        "{late:?}"
    );
    for bad in [
        "//!imports base",
        "//!import",
        "//!import a b",
        "//! a comment",
    ] {
        let error = job(bad, &[BASE]).unwrap_err();
        assert!(
            matches!(error, ShaderError::Directive { line: 1, .. }),
            "{bad}: {error:?}"
        );
    }
}

#[test]
fn a_syntax_error_in_an_import_names_that_file_and_line() {
    let broken = SharedSource {
        name: "broken",
        text: "// fine\nfn two() -> u32 { return 2u }\n",
    };
    let text = "//!import base\n//!import broken\n@compute @workgroup_size(1) fn main() {}\n";
    let Err(ShaderError::Invalid { report, file, line }) = job(text, &[BASE, broken]) else {
        panic!("accepted");
    };
    assert_eq!(file.as_deref(), Some("wgsl/shared/broken.wgsl"));
    assert_eq!(line, Some(2));
    assert!(report.contains("wgsl/shared/broken.wgsl:2:"), "{report}");
    assert!(report.contains("return 2u }"), "{report}");
}

#[test]
fn a_validation_error_names_its_file_and_line_and_cause() {
    let text = "//!import base\n\n@compute @workgroup_size(1)\nfn main() {\n    let a = one();\n    if a == 1u { workgroupBarrier(); }\n    var x = 1.0;\n    _ = textureLoad(t, vec2<i32>(0), 0);\n}\n@group(0) @binding(0) var t: texture_storage_2d<rgba8unorm, write>;\n";
    let Err(ShaderError::Invalid { report, file, line }) = job(text, &[BASE]) else {
        panic!("accepted");
    };
    assert_eq!(file.as_deref(), Some("wgsl/job.wgsl"));
    assert!(line.is_some());
    assert!(report.contains("wgsl/job.wgsl:"), "{report}");
    assert!(report.contains("textureLoad"), "{report}");
}

#[test]
fn an_error_without_a_line_still_names_the_job() {
    let error = job("@compute @workgroup_size(0) fn main() {}", &[]).unwrap_err();
    let ShaderError::Invalid { report, file, .. } = error else {
        panic!("another error: {error}");
    };
    assert!(report.contains("wgsl/job.wgsl"), "{report}");
    assert_eq!(file.as_deref(), Some("wgsl/job.wgsl"));
}

#[test]
fn what_bind_groups_cannot_express_is_refused() {
    let nothing = job("fn helper() {}\n", &[]).unwrap_err();
    assert!(
        matches!(nothing, ShaderError::NoEntryPoint { .. }),
        "{nothing:?}"
    );
    let shared = "@group(0) @binding(1) var<uniform> a: f32;
        @group(0) @binding(1) var<uniform> b: f32;
        @fragment fn f() { _ = a; }
        @fragment fn g() { _ = b; }";
    let error = job(shared, &[]).unwrap_err();
    assert!(
        matches!(&error, ShaderError::SharedBinding { first, second, .. } if first == "a" && second == "b"),
        "{error:?}"
    );
    let far = "@group(4294967295) @binding(1) var<uniform> a: f32; @fragment fn f() { _ = a; }";
    let error = job(far, &[]).unwrap_err();
    assert!(
        matches!(
            error,
            ShaderError::GroupNumber {
                group: u32::MAX,
                ..
            }
        ),
        "{error:?}"
    );
}

/// Files that import some of the files before them: no cycles, any number of diamonds. For each file, its imports and the number of lines
/// that follow.
fn files() -> impl Strategy<Value = Vec<(Vec<prop::sample::Index>, usize)>> {
    let file = (
        prop::collection::vec(any::<prop::sample::Index>(), 0..4),
        0..4usize,
    );
    prop::collection::vec(file, 1..8)
}

proptest! {
    #[test]
    fn every_line_is_located_where_it_was_written(files in files()) {
        let texts: Vec<(String, String)> = files
            .iter()
            .enumerate()
            .map(|(file, (imports, lines))| {
                let mut text = String::new();
                for import in imports.iter().filter(|_| file > 0) {
                    text += &format!("//!import f{}\n", import.index(file));
                }
                for line in 0..*lines {
                    text += &format!("// line {line} of f{file}\n");
                }
                (format!("f{file}"), text + "// end")
            })
            .collect();
        let shared: Vec<SharedSource<'_>> = texts.iter().map(|(name, text)| SharedSource { name, text }).collect();
        let last = texts.len() - 1;
        let text = format!("//!import f{last}\n@compute @workgroup_size(1) fn main() {{}}\n");
        let job = job(&text, &shared).unwrap();
        let mut seen = Vec::new();
        for (index, line) in job.source.lines().enumerate() {
            let SourceLine { file, line: number } =
                job.locate(u32::try_from(index).unwrap() + 1).unwrap();
            let name = file.trim_start_matches("wgsl/shared/").trim_end_matches(".wgsl");
            let original = texts.iter().find(|(each, _)| each == name).map_or(&text, |(_, text)| text);
            prop_assert_eq!(original.lines().nth(number as usize - 1), Some(line));
            seen.push((file.to_owned(), number));
        }
        let count = seen.len();
        seen.sort();
        seen.dedup();
        prop_assert_eq!(seen.len(), count);
    }
}
