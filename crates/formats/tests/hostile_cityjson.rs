//! Malformed CityJSON: each file gives an error that names the line, or loads without harm.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{LoadOptions, LoadProblem, SceneFormat, load_slice};
use antumbra_scene::Scene;

fn read(text: &str, options: &LoadOptions) -> Result<Scene, LoadProblem> {
    load_slice(SceneFormat::CityJson, text.as_bytes(), None, options)
        .map_err(|error| *error.problem)
}

fn refused(text: &str) -> LoadProblem {
    read(text, &LoadOptions::default()).unwrap_err()
}

/// [`common::CITY`] with the first `from` in it replaced.
fn changed(from: &str, to: &str) -> String {
    assert!(common::CITY.contains(from), "{from}");
    common::CITY.replacen(from, to, 1)
}

#[track_caller]
fn assert_says(problem: &LoadProblem, parts: &[&str]) {
    let text = problem.to_string();
    for part in parts {
        assert!(text.contains(part), "{part:?} is not in {text}");
    }
    assert!(text.len() < 600, "{text}");
}

/// Asserts that the file loads with this many triangles and valid meshes.
#[track_caller]
fn assert_harmless(text: &str, triangles: u64) {
    let mut scene = read(text, &LoadOptions::default()).unwrap();
    scene.update();
    assert_eq!(scene.triangle_count(), triangles);
    assert!(scene.bounds().is_none_or(|bounds| bounds.is_finite()));
    for (_, mesh) in scene.meshes() {
        assert_eq!(mesh.validate(), Ok(()));
    }
}

#[test]
fn a_file_without_its_first_line_is_refused() {
    let (head, feature) = common::CITY.split_once('\n').unwrap();
    assert_says(
        &refused(feature),
        &["line 1", "CityJSONFeature", "first line"],
    );
    assert_says(&refused(""), &["empty"]);
    assert_says(&refused("\n \n"), &["empty"]);
    assert_says(&refused(r#"{"a":1}"#), &["line 1", "first line"]);
    assert_says(&refused("[1]"), &["line 1"]);
    assert_says(
        &refused(&format!("{head}\n{feature}{head}\n")),
        &["line 3", "\"CityJSON\"", "CityJSONFeature"],
    );
    assert_harmless(head, 0);
}

#[test]
fn a_line_that_is_cut_off_is_named() {
    let text = common::CITY.trim_end();
    let line = text.find('\n').unwrap() + 2;
    for length in (line..text.len()).step_by(7) {
        assert_says(&refused(&text[..length]), &["line 2", "EOF"]);
    }
    for length in 1..line - 2 {
        assert_says(&refused(&text[..length]), &["line 1"]);
        let rest = &text[line - 1..];
        assert_says(&refused(&format!("{}\n{rest}", &text[..length])), &["line"]);
    }
    assert_says(
        &refused(&format!("{text}\n{{\"type\":\"CityJSONFeature\",\n}}\n")),
        &["line 3"],
    );
}

#[test]
fn versions_and_transforms_are_checked() {
    assert_says(
        &refused(&changed("2.0", "3.0")),
        &["line 1", "3.0", "convert"],
    );
    let without = changed(r#""version":"2.0","#, "");
    assert_says(&refused(&without), &["version", "missing"]);
    let transform =
        r#""transform":{"scale":[0.001,0.001,0.001],"translate":[85000.0,446000.0,-2.0]},"#;
    assert_says(&refused(&changed(transform, "")), &["line 1", "transform"]);
    for number in ["NaN", "1e999", "null", "\"1\"", "-Infinity"] {
        let broken = changed("[85000.0,", &format!("[{number},"));
        assert_says(&refused(&broken), &["line 1"]);
        let broken = changed("[10000,0,0]", &format!("[{number},0,0]"));
        assert_says(&refused(&broken), &["line 2"]);
    }
    for (from, to) in [
        ("[85000.0,", "[1e300,"),
        ("[0.001,", "[1e306,"),
        ("[10000,0,0]", "[1e44,0,0]"),
    ] {
        assert_says(
            &refused(&changed(from, to)),
            &["line 2", "vertex", "out of range"],
        );
    }
    assert_says(&refused(&changed("0.001,0.001]", "0.001]")), &["line 1"]);
}

#[test]
fn scales_that_flatten_do_no_harm() {
    let all = |scale: &str| changed("[0.001,0.001,0.001]", scale);
    assert_harmless(&all("[0,0,0]"), 0);
    // Vertical walls only.
    assert_harmless(&all("[0.001,0,0.001]"), 4);
    assert_harmless(&all("[1e-200,1e-200,1e-200]"), 0);
    // A mirroring transform.
    assert_harmless(&all("[-0.001,0.001,0.001]"), 18);
    assert_harmless(&all("[1e25,1e25,1e25]"), 18);
}

#[test]
fn indices_out_of_range_are_named() {
    for index in ["12", "4294967295"] {
        let problem = refused(&changed("[[0,1,5,4]]", &format!("[[0,1,5,{index}]]")));
        assert!(matches!(
            problem,
            LoadProblem::MissingReference { count: 12, .. }
        ));
        assert_says(&problem, &["line 2", "\"a-0\"", index]);
    }
    for index in ["-1", "4294967296", "1.5", "null", "\"0\"", "[0]"] {
        let problem = refused(&changed("[[0,1,5,4]]", &format!("[[0,1,5,{index}]]")));
        assert_says(&problem, &["line 2", "\"a-0\"", "lists"]);
    }
    let no_vertices = changed(r#","vertices":[[0,0,0],"#, r#","unread":[[0,0,0],"#);
    assert_says(&refused(&no_vertices), &["line 2", "there are 0"]);
}

#[test]
fn lists_of_another_depth_than_the_type_are_refused() {
    for (from, to) in [
        (r#""type":"Solid""#, r#""type":"MultiSurface""#),
        (r#""type":"Solid""#, r#""type":"MultiSolid""#),
        (
            r#""type":"MultiSurface","lod":"2""#,
            r#""type":"Solid","lod":"2""#,
        ),
        (r#""lod":"1","boundaries""#, r#""lod":"1","borders""#),
    ] {
        assert_says(&refused(&changed(from, to)), &["line 2", "\"a-0\""]);
    }
    let deep = format!("{}{}", "[".repeat(200_000), "]".repeat(200_000));
    for (from, to) in [
        ("[[0,1,5,4]]", &deep),
        (r#""lod":"1""#, &format!(r#""lod":{deep}"#)),
    ] {
        assert_says(&refused(&changed(from, to)), &["line 2"]);
    }
    // The loader does not read this member.
    assert_harmless(&changed("1652", &deep), 18);
}

#[test]
fn rings_that_enclose_nothing_are_left_out() {
    for (from, to, triangles) in [
        ("[[0,1,2,3]]", "[]", 18),
        ("[4,5,6,7],[8,11,10,9]", "[4,5],[8,11,10,9]", 10),
        ("[4,5,6,7],[8,11,10,9]", "", 10),
        ("[4,5,6,7],[8,11,10,9]", "[4,5,6,7],[8,11]", 12),
        ("[4,5,6,7],[8,11,10,9]", "[4,5,6,7],[]", 12),
        // A path to a point and back.
        ("[4,5,6,7],[8,11,10,9]", "[4,5,4,5]", 10),
        ("[4,5,6,7],[8,11,10,9]", "[4,4,4,4]", 10),
        // The first corner is repeated.
        ("[4,5,6,7],[8,11,10,9]", "[4,5,6,7,4]", 12),
    ] {
        assert_harmless(&changed(from, to), triangles);
    }
}

#[test]
fn rings_that_touch_or_cross_themselves_do_no_harm() {
    for ring in [
        // A bow tie, a figure of eight, a spike, a hole outside the ring, a hole equal to the ring.
        "[4,6,5,7]",
        "[4,5,8,6,7,8]",
        "[4,5,6,10,6,7]",
        "[8,9,10],[4,5,6]",
        "[4,5,6,7],[4,5,6,7]",
        "[4,5,6,7],[8,9,10],[8,10,11],[8,9,10]",
        // Not flat.
        "[4,5,2,7]",
    ] {
        let text = changed("[4,5,6,7],[8,11,10,9]", ring);
        let scene = read(&text, &LoadOptions::default()).unwrap();
        assert!(scene.triangle_count() <= 10 + 12, "{ring}");
        for (_, mesh) in scene.meshes() {
            assert_eq!(mesh.validate(), Ok(()), "{ring}");
        }
    }
}

#[test]
fn families_that_go_in_circles_are_refused() {
    let cycle = changed(r#""children":["a-0"]"#, r#""parents":["a-0"]"#);
    let problem = refused(&cycle);
    assert!(
        matches!(problem, LoadProblem::NodeCycle { .. }),
        "{problem:?}"
    );
    assert_says(&problem, &["line 2", "\"a\"", "its own ancestor"]);
    for own in [r#""parents":["a-0"],"#, r#""children":["a-0"],"#] {
        let problem = refused(&changed(r#""parents":["a"],"#, own).replacen(
            r#""children":["a-0"],"g"#,
            r#""g"#,
            1,
        ));
        assert_says(&problem, &["\"a-0\"", "its own ancestor"]);
    }
}

#[test]
fn relatives_that_are_not_there_do_no_harm() {
    assert_harmless(
        &changed(r#""parents":["a"]"#, r#""parents":["missing","a"]"#),
        18,
    );
    assert_harmless(
        &changed(
            r#""children":["a-0"]"#,
            r#""children":["a-0","a-0","missing"]"#,
        ),
        18,
    );
    let orphan = changed(r#""parents":["a"]"#, r#""parents":["missing"]"#)
        .replace(r#""children":["a-0"],"#, "");
    // The building then has only its footprint.
    assert_harmless(&orphan, 20);
}

#[test]
fn an_id_that_occurs_twice_is_refused_in_a_line_and_fine_in_two() {
    assert_says(
        &refused(&changed(r#""a-0":{"type":"B"#, r#""a":{"type":"B"#)),
        &["line 2", "two objects", "\"a\""],
    );
    let (head, feature) = common::CITY.split_once('\n').unwrap();
    assert_harmless(&format!("{head}\n{feature}{feature}"), 36);
}

#[test]
fn semantics_that_fit_nothing_do_no_harm() {
    for values in [
        "[9,9,9,9,9,9,9]",
        "[]",
        "null",
        "[null]",
        "[[0]]",
        "\"x\"",
        "[-1]",
        "[18446744073709551615]",
    ] {
        assert_harmless(&changed("[0,1,1,1,null,2]", values), 18);
    }
}

#[test]
fn budgets_are_kept() {
    type Limit = fn(&mut LoadOptions);
    let limits: [(&str, Limit); 5] = [
        ("max_file_bytes", |o| {
            o.max_file_bytes = common::CITY.len() as u64 - 1
        }),
        ("max_vertices", |o| o.max_vertices = 51),
        ("max_triangles", |o| o.max_triangles = 29),
        ("max_entities", |o| o.max_entities = 1),
        ("max_json_objects", |o| o.max_json_objects = 40),
    ];
    for (name, limit) in limits {
        let mut options = LoadOptions::default();
        limit(&mut options);
        let Err(problem) = read(common::CITY, &options) else {
            panic!("{name} is not kept");
        };
        assert!(matches!(problem, LoadProblem::TooLarge { .. }), "{problem}");
        assert_says(&problem, &[name]);
    }
    let enough = LoadOptions {
        max_vertices: 52,
        max_triangles: 30,
        max_entities: 2,
        max_json_objects: 80,
        ..LoadOptions::default()
    };
    assert!(read(common::CITY, &enough).is_ok());
}

#[test]
fn what_is_counted_is_one_line_at_a_time() {
    let (head, feature) = common::CITY.split_once('\n').unwrap();
    let options = LoadOptions {
        max_json_objects: 80,
        ..LoadOptions::default()
    };
    let many = format!("{head}\n{}", feature.repeat(50));
    assert_eq!(read(&many, &options).unwrap().len(), 100);
    let long = changed("1652", &format!("[{}0]", "[],".repeat(50)));
    let Err(problem) = read(&long, &options) else {
        panic!("the long line is read");
    };
    assert_says(&problem, &["max_json_objects"]);
}

/// A surface whose triangulation would take too long is rejected; long names and numbers are shortened in messages.
#[test]
fn lines_without_end_are_refused_shortly() {
    let ring = (0..20_000)
        .map(|i| (i * 7 % 12).to_string())
        .collect::<Vec<_>>();
    let text = changed("[4,5,6,7],[8,11,10,9]", &format!("[{}]", ring.join(",")));
    assert_says(&refused(&text), &["line 2", "\"a-0\"", "20000 corners"]);
    let name = "n".repeat(1_000_000);
    let text = changed("[[0,1,5,4]]", "[[0,1,5,99]]").replace("a-0", &name);
    assert_says(&refused(&text), &["line 2", "nnn\u{2026}"]);
    assert_says(
        &refused(&changed("CityJSON", &name)),
        &["line 1", "nnn\u{2026}"],
    );
    let text = changed(
        r#""type":"CityJSONFeature""#,
        &format!(r#""type":[],"{name}":0"#),
    );
    assert_says(&refused(&text), &["line 2"]);
}
