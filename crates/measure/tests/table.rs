//! Tables and summaries: they show the report's numbers, and no name can change a terminal.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "common/swept.rs"]
mod swept;
#[path = "common/synthetic.rs"]
mod synthetic;

use antumbra_measure::report::{MissingParts, Report, StereoFacts};
use antumbra_measure::summary::{Tone, recommendations, summarise};
use antumbra_measure::table::{Table, facts};

fn cell(report: &Report, strategy: &str, column: (&str, &str)) -> (String, bool) {
    let table = Table::new(report);
    let at = table
        .columns
        .iter()
        .position(|c| (c.title, c.unit) == column)
        .unwrap();
    let row = table
        .rows
        .iter()
        .find(|row| row.cells[0].text == strategy)
        .unwrap();
    (row.cells[at].text.clone(), row.cells[at].best)
}

#[test]
fn cells_say_what_the_report_says_and_the_best_are_marked() {
    let report = synthetic::report();
    let get = |strategy, column| cell(&report, strategy, column);
    assert_eq!(
        get("three-pass", ("speed vs", "frustum")),
        ("3.38x".into(), true)
    );
    assert_eq!(
        get("id-histogram", ("speed vs", "frustum")),
        ("3.23x".into(), false)
    );
    assert_eq!(
        get("frustum", ("speed vs", "frustum")),
        ("1.00x".into(), false)
    );
    assert_eq!(get("ideal", ("speed vs", "none")), ("10.7x".into(), false));
    assert_eq!(
        get("three-pass", ("wrong px", "mean %")),
        ("0.012".into(), false)
    );
    assert_eq!(get("hi-z", ("wrong px", "mean %")), ("0".into(), true));
    assert_eq!(get("three-pass", ("false", "culls")), ("48".into(), false));
    assert_eq!(get("hi-z", ("queries", "a frame")), ("8 420".into(), false));
    assert_eq!(
        get("coherent-queries", ("sync", "points")),
        ("1".into(), false)
    );
}

#[test]
fn terminal_columns_are_aligned_and_plain_without_colour() {
    let text = Table::new(&synthetic::report()).terminal(false);
    assert!(!text.contains('\x1b'));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 2 + 7);
    // Right-aligned numbers of a column end at the same position.
    let end = |line: &str, number: &str| line.find(number).unwrap() + number.len();
    assert_eq!(
        end(lines[2], "31.9"),
        lines[0].find("frame").unwrap() + "frame".len()
    );
    assert_eq!(end(lines[4], "10.7x"), end(lines[2], "1.00x"));
    assert!(text.is_ascii());
}

#[test]
fn wide_letters_keep_the_columns_aligned() {
    let mut report = synthetic::report();
    report.strategies[3].label = "\u{7acb}\u{65b9}".into();
    let text = Table::new(&report).terminal(false);
    let line = text.lines().find(|l| l.contains('\u{7acb}')).unwrap();
    let other = text.lines().find(|l| l.contains("three-pass")).unwrap();
    // Two letters of double width take two columns more than their number, and three bytes each.
    let letters = |l: &str, word: &str| l[..l.find(word).unwrap()].chars().count();
    assert_eq!(letters(line, "on-gpu") + 2, letters(other, "frame-late"));
}

#[test]
fn colour_marks_the_best_and_the_broken() {
    let mut report = synthetic::report();
    report.strategies[3].error.false_culls.entities = 2;
    let text = Table::new(&report).terminal(true);
    let line = |name: &str| text.lines().find(|l| l.contains(name)).unwrap().to_owned();
    assert!(line("hi-z").contains("\x1b[31mhi-z\x1b[0m"));
    assert!(line("three-pass").contains("\x1b[1m3.38x\x1b[0m"));
}

#[test]
fn hostile_names_cannot_repaint_a_terminal_or_break_markdown() {
    let mut report = synthetic::report();
    report.strategies[3].name = "\x1b[2J\u{202e}evil|x\n<img>".into();
    report.scene.name = "scene\x07\n\u{9b}31m".into();
    let table = Table::new(&report);
    let text = table.terminal(false) + &facts(&report).join("\n");
    assert!(
        !text
            .chars()
            .any(|c| (c.is_control() && c != '\n') || c == '\u{202e}')
    );
    assert_eq!(table.terminal(false).lines().count(), 2 + 7);
    let markdown = table.markdown();
    let line = markdown.lines().find(|l| l.contains("evil")).unwrap();
    assert!(
        line.contains("evil\\|x") && line.contains("&lt;img"),
        "{line}"
    );
    assert_eq!(markdown.lines().count(), 2 + 7);
}

#[test]
fn parts_that_a_scene_lacks_are_counted_in_words() {
    let mut report = synthetic::report();
    let lost = |part: &str, count: u64| MissingParts {
        part: part.to_owned(),
        count,
        reason: "missing".to_owned(),
    };
    report.scene.left_out = vec![
        lost("image", 1),
        lost("images", 2),
        lost("geometries", 2),
        lost("levels of detail", 2),
    ];
    let [text, _] = facts(&report);
    let words = "1 image (missing), 2 images (missing), 2 geometries (missing), 2 levels of detail (missing)";
    assert!(text.contains(words), "{text}");
}

#[test]
fn columns_that_nobody_measured_are_left_out() {
    let mut report = synthetic::report();
    for strategy in &mut report.strategies {
        strategy.time_vs_ideal = None;
        strategy.free_running_ms = None;
    }
    report.strategies[4].time_vs_none = None;
    let titles: Vec<_> = Table::new(&report)
        .columns
        .iter()
        .map(|c| (c.title, c.unit))
        .collect();
    assert!(!titles.contains(&("speed vs", "ideal")) && titles.contains(&("speed vs", "none")));
    assert_eq!(cell(&report, "three-pass", ("speed vs", "none")).0, "-");
}

#[test]
fn an_empty_report_has_a_table_too() {
    let report = Report {
        strategies: Vec::new(),
        ..synthetic::report()
    };
    assert_eq!(Table::new(&report).terminal(true).lines().count(), 2);
    assert!(recommendations(&report).is_empty());
}

#[test]
fn verdicts_are_what_a_person_would_say() {
    let mut report = synthetic::report();
    let say = |report: &Report, i: usize| {
        let v = summarise(report, &report.strategies[i]);
        (v.text, v.tone)
    };
    assert_eq!(
        say(&report, 4),
        (
            "3.4 times as fast as frustum, 0.012 % wrong pixels on average (0.072 % in the worst frame)".into(),
            Tone::Trade
        )
    );
    assert_eq!(
        say(&report, 3),
        (
            "2.5 times as fast as frustum, every pixel right".into(),
            Tone::Good
        )
    );
    assert_eq!(
        say(&report, 1),
        (
            "2.2 times as fast as none, every pixel right".into(),
            Tone::Yardstick
        )
    );
    report.strategies[3].time_vs_frustum = Some(1.009);
    assert_eq!(
        say(&report, 3),
        (
            "as fast as frustum, within the noise, every pixel right".into(),
            Tone::Poor
        )
    );
    report.strategies[3].time_vs_frustum = Some(1.5);
    assert_eq!(
        say(&report, 3),
        (
            "takes 1.50 times as long as frustum, every pixel right".into(),
            Tone::Poor
        )
    );
    report.strategies[3].error.wrong_pixels_percent.max = 0.4;
    assert_eq!(say(&report, 3).1, Tone::Broken);
    assert!(
        say(&report, 3)
            .0
            .ends_with("claims to be conservative and is not")
    );
}

#[test]
fn picks_name_the_fastest_right_and_the_fastest_hardly_wrong() {
    let mut report = synthetic::report();
    let names = |report: &Report| -> Vec<(String, String)> {
        recommendations(report)
            .iter()
            .map(|p| (p.title.to_owned(), p.strategy.name.clone()))
            .collect()
    };
    assert_eq!(
        names(&report),
        [
            ("Fastest with every pixel right".into(), "hi-z".into()),
            (
                "Fastest of all, with at most 0.1 % wrong pixels".into(),
                "three-pass".into()
            ),
        ]
    );
    report.strategies[3].frame_ms.median = 0.5;
    assert_eq!(
        names(&report),
        [(
            "Fastest of all, and every pixel right".into(),
            "hi-z".into()
        )]
    );
}

#[test]
fn two_eyes_have_a_table_of_their_own() {
    let mut report = synthetic::report();
    assert_eq!(Table::eyes(&report), None, "one view");
    assert!(!facts(&report)[0].contains("eyes"));
    report.scene.views = 2;
    report.scene.stereo = Some(StereoFacts {
        interocular: 0.064,
        convergence: 12.345_678,
    });
    for (strategy, wrong) in report.strategies.iter_mut().zip([0.0, 0.0, 0.0, 0.5, 0.25]) {
        let mut right = strategy.error;
        right.wrong_pixels_percent.mean = wrong;
        right.false_culls.entities = 7;
        strategy.views = vec![strategy.error, right];
        strategy.queries_a_view = vec![120.0, 30.5];
    }
    let line = &facts(&report)[0];
    assert!(
        line.contains("2 views (eyes 0.064 m apart, converging at 12.35 m)"),
        "{line}"
    );
    let table = Table::eyes(&report).unwrap();
    let heads: Vec<_> = table.columns.iter().map(|c| (c.title, c.unit)).collect();
    for column in [
        ("queries", "left"),
        ("wrong px", "right, mean %"),
        ("false culls", "right"),
    ] {
        assert!(heads.contains(&column), "{column:?} is not in {heads:?}");
    }
    let three = table
        .rows
        .iter()
        .find(|row| row.cells[0].text == "three-pass")
        .unwrap();
    let cells: Vec<&str> = three.cells.iter().map(|cell| cell.text.as_str()).collect();
    assert_eq!(
        cells,
        [
            "three-pass",
            "120",
            "30.5",
            "0.012",
            "0.25",
            "0.072",
            "0.072",
            "48",
            "7"
        ]
    );
    let at = heads
        .iter()
        .position(|head| *head == ("wrong px", "right, mean %"))
        .unwrap();
    assert!(three.cells[at].best, "least of those that compete");
    // A strategy whose eyes were not measured.
    let last = table.rows.last().unwrap();
    assert!(last.cells[1..].iter().all(|cell| cell.text == "-"));
    let markdown = table.markdown();
    assert!(
        markdown.starts_with("| strategy | queries left | queries right |"),
        "{markdown}"
    );
    assert_eq!(
        table.terminal(false).lines().count(),
        2 + report.strategies.len()
    );
}

#[test]
fn a_sweep_has_a_short_table_with_its_edge_marked() {
    assert_eq!(Table::sweep(&swept::known()), None, "no sweep");
    let report = swept::with(swept::known(), &[]);
    let table = Table::sweep(&report).unwrap();
    let heads: Vec<_> = table.columns.iter().map(|c| (c.title, c.unit)).collect();
    assert_eq!(
        heads,
        [
            ("strategy", ""),
            ("frame", "ms"),
            ("speed vs", "frustum"),
            ("speed vs", "ideal"),
            ("wrong px", "mean %"),
            ("wrong px", "max %"),
            ("false", "culls"),
            ("efficient", "edge"),
        ]
    );
    for table in [table, Table::new(&report)] {
        let marked = table
            .rows
            .iter()
            .filter(|row| row.cells.last().unwrap().text == "*");
        let marked: Vec<&str> = marked.map(|row| row.cells[0].text.as_str()).collect();
        assert_eq!(marked, ["threshold=0", "threshold=4", "threshold=64"]);
        assert_eq!(table.rows[1].cells[0].text, "frustum");
    }
    assert!(!Table::new(&swept::known()).terminal(false).contains("edge"));
}
