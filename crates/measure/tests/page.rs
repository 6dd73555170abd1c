//! The plots and the page: complete, self-contained, and safe with any names.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "common/pictures.rs"]
mod pictures;
#[path = "common/swept.rs"]
mod swept;
#[path = "common/synthetic.rs"]
mod synthetic;

use antumbra_measure::html::{page, write_html};
use antumbra_measure::plots::{frame_times, on_paper, speed_against_error, stage_times};
use antumbra_measure::report::Report;

const HOSTILE: &str = "</title><script>alert(1)</script><img src=x onerror='a()'>\"&";

fn hostile() -> Report {
    let mut report = synthetic::report();
    report.scene.name = HOSTILE.into();
    report.scene.path = HOSTILE.into();
    report.adapter.name = HOSTILE.into();
    report.adapter.backend = HOSTILE.into();
    report.antumbra = HOSTILE.into();
    report.command = HOSTILE.into();
    report.labels = [(HOSTILE.to_owned(), HOSTILE.to_owned())].into();
    report.seeds = [(HOSTILE.to_owned(), 1)].into();
    for strategy in &mut report.strategies {
        strategy.label = HOSTILE.into();
        strategy.latency = HOSTILE.into();
        strategy.settings = [(HOSTILE.to_owned(), serde_json::json!(HOSTILE))].into();
        strategy.verdicts = [(HOSTILE.to_owned(), 1.0)].into();
        for pass in &mut strategy.passes {
            pass.name = HOSTILE.into();
            pass.group = HOSTILE.into();
        }
    }
    report
}

#[test]
fn the_page_is_one_file_with_everything_inside() {
    let dir = tempfile::tempdir().unwrap();
    let report = synthetic::report();
    pictures::draw(&report, dir.path());
    let file = write_html(&report, dir.path()).unwrap();
    let html = std::fs::read_to_string(&file).unwrap();
    assert!(file.ends_with("report.html"));
    assert_eq!(html.matches("<svg ").count(), 3);
    assert_eq!(html.matches("</svg>").count(), 3);
    // Two strategies have wrong pixels; three pictures each.
    assert_eq!(html.matches("src=\"data:image/png;base64,").count(), 6);
    assert_eq!(html.matches("src=").count(), 6);
    assert_eq!(
        html.matches("http").count(),
        html.matches("xmlns=\"http://www.w3.org/2000/svg\"").count()
    );
    for words in [
        "3.4 times as fast as frustum, 0.012&nbsp;% wrong pixels on average",
        "No wrong pixel in any frame",
        "llvmpipe",
    ] {
        assert!(html.contains(words), "{words}");
    }
    for (open, close) in [
        ("<section", "</section>"),
        ("<table", "</table>"),
        ("<div", "</div>"),
        ("<details", "</details>"),
        ("<tr", "</tr>"),
    ] {
        assert_eq!(
            html.matches(open).count(),
            html.matches(close).count(),
            "{open}"
        );
    }
}

#[test]
fn no_string_of_a_report_becomes_markup() {
    let dir = tempfile::tempdir().unwrap();
    let html = page(&hostile(), dir.path()).unwrap();
    assert!(
        !html.contains("<script") && !html.contains("<img src=x") && !html.contains("onerror='")
    );
    assert_eq!(html.matches("</title>").count(), 1);
    assert!(html.contains("&lt;script&gt;"));
}

#[test]
fn a_picture_that_cannot_be_shown_is_said_to_be_missing() {
    let dir = tempfile::tempdir().unwrap();
    let report = synthetic::report();
    let html = page(&report, dir.path()).unwrap();
    assert_eq!(html.matches("No picture: cannot read").count(), 6);
    // A file whose content does not match its name is not embedded.
    pictures::draw(&report, dir.path());
    let marked = dir
        .path()
        .join(&report.strategies[4].worst.as_ref().unwrap().images.marked);
    std::fs::write(&marked, "<svg onload='alert(1)'></svg>").unwrap();
    let html = page(&report, dir.path()).unwrap();
    assert_eq!(html.matches("No picture: image").count(), 1);
    assert_eq!(html.matches("data:image/png").count(), 5);
}

#[test]
fn large_pictures_are_shrunk() {
    let dir = tempfile::tempdir().unwrap();
    let mut report = synthetic::report();
    report.scene.size = [2400, 600];
    report.strategies.truncate(5);
    pictures::draw(&report, dir.path());
    let html = page(&report, dir.path()).unwrap();
    let uri = html
        .split("base64,")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap();
    let png = base64::Engine::decode(&base64::engine::general_purpose::STANDARD, uri).unwrap();
    let picture = image::load_from_memory(&png).unwrap();
    assert_eq!((picture.width(), picture.height()), (1000, 250));
}

#[test]
fn stereo_reports_name_the_eye() {
    let dir = tempfile::tempdir().unwrap();
    let mut report = synthetic::report();
    report.scene.views = 2;
    report.strategies[4].worst.as_mut().unwrap().view = 1;
    let mut right = report.strategies[4].error;
    right.wrong_pixels_percent.max = 0.25;
    report.strategies[4].views = vec![report.strategies[4].error, right];
    let html = page(&report, dir.path()).unwrap();
    // The eye's own percentage, not that of both eyes together.
    assert!(html.contains("three-pass: frame 4, right eye, 0.25 % wrong pixels"));
    assert!(html.contains("Each eye") && html.contains("right, mean %"));
    report.scene.views = 1;
    assert!(!page(&report, dir.path()).unwrap().contains("Each eye"));
}

#[test]
fn plots_name_every_strategy_and_follow_the_page_colours() {
    let report = synthetic::report();
    for svg in [
        speed_against_error(&report),
        frame_times(&report),
        stage_times(&report),
    ] {
        let svg = svg.unwrap().unwrap();
        for strategy in &report.strategies {
            assert!(svg.contains(&strategy.name), "{}", strategy.name);
        }
        assert!(svg.starts_with("<svg role=\"img\"") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("currentColor") && !svg.contains("#010203") && !svg.contains("NaN"));
    }
}

#[test]
fn plots_of_odd_reports_are_drawn_or_left_out() {
    let mut report = synthetic::report();
    let all = |report: &Report| {
        [
            speed_against_error(report).unwrap(),
            frame_times(report).unwrap(),
            stage_times(report).unwrap(),
        ]
    };
    // No errors, no yardsticks, no times, one pose.
    for strategy in &mut report.strategies {
        strategy.error = Default::default();
        strategy.time_vs_frustum = None;
        strategy.time_vs_none = None;
        strategy.cull_ms = None;
        strategy.draw_ms = None;
        strategy.frame_ms.median = 0.0;
        strategy.frames.frame_ms = vec![0.0];
    }
    for svg in all(&report) {
        assert!(!svg.unwrap().contains("NaN"));
    }
    // Errors from the smallest to the largest possible.
    for (strategy, wrong) in
        report
            .strategies
            .iter_mut()
            .zip([1e-12, 1e-3, 100.0, 0.0, 50.0, 3.0, f64::MIN_POSITIVE])
    {
        strategy.error.wrong_pixels_percent.mean = wrong;
        strategy.frames.frame_ms = vec![1e-6, 1e9, wrong];
        strategy.frame_ms.median = 1e9;
    }
    for svg in all(&report) {
        let svg = svg.unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
    report.strategies.clear();
    assert_eq!(all(&report), [None, None, None]);
    report.check().unwrap();
    assert!(
        page(&report, std::path::Path::new("."))
            .unwrap()
            .contains("</html>")
    );
}

#[test]
fn many_strategies_still_fit() {
    let mut report = synthetic::report();
    for i in 0..60 {
        let mut strategy = synthetic::strategy(
            "three-pass",
            "frame-late",
            4.0 + f64::from(i) * 0.01,
            1.0,
            0.02,
            700.0,
        );
        strategy.label = format!("three-pass threshold={i}");
        report.strategies.push(strategy);
    }
    let dir = tempfile::tempdir().unwrap();
    assert!(page(&report, dir.path()).unwrap().contains("threshold=59"));
}

#[test]
fn a_sweep_shows_its_trade() {
    let report = swept::with(swept::known(), &["wrong_pixels=0.05%", "wrong_pixels=0"]);
    let svg = speed_against_error(&report).unwrap().unwrap();
    for words in [
        "threshold=4 (chosen: 0.050 % mean, 0.050 % worst)",
        "threshold=0 (chosen: 0 % mean, 0 % worst)",
        "threshold=99",
        "limit 0.050 %",
        "noise of 5.0 %",
        "every pixel right",
        "efficient edge",
        "dominated, or faster only within the noise",
        "chosen by a limit",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    // The yardsticks are not settings, and ideal, 4.9 times as fast, is outside of the plot.
    assert!(!svg.contains(">\nfrustum\n") && svg.contains("further right, at 4.90x"));
    let dir = tempfile::tempdir().unwrap();
    let html = page(&report, dir.path()).unwrap();
    for words in [
        "Sweep of three-pass over threshold = 99, 0, 4, 5, 64",
        "Fastest with at most 0.050&nbsp;% wrong pixels on average",
        "Fastest with no wrong pixel",
        "efficient<small>edge</small>",
    ] {
        assert!(html.contains(words), "{words}");
    }
    let alone = on_paper(&svg);
    assert!(alone.starts_with("<svg ") && alone.contains("fill=\"#fff\""));
    assert!(!alone.contains("currentColor") && !alone.contains("var("));
}

#[test]
fn odd_sweeps_are_drawn_too() {
    let odd = |settings: Vec<(f64, f64)>, noise: Option<f64>| {
        let settings = settings.into_iter().enumerate();
        let settings =
            settings.map(|(i, (time, wrong))| swept::setting(&i.to_string(), time, wrong));
        let mut report = swept::report(settings.collect());
        report.noise.frame_time_ratio_p95 = noise;
        swept::with(
            report,
            &[
                "wrong_pixels=0.001%",
                "wrong_pixels=100%",
                "flip=0",
                "false_culls=7",
            ],
        )
    };
    for (settings, noise) in [
        (vec![(0.4, 0.0)], Some(1.0)),
        (vec![(0.4, 100.0)], None),
        (
            vec![(1e-9, 1e-12), (1e9, f64::MIN_POSITIVE), (1.0, 50.0)],
            Some(50.0),
        ),
        (
            (1..150)
                .map(|i| (f64::from(i), 1.0 / f64::from(i)))
                .collect(),
            Some(1.01),
        ),
    ] {
        let report = odd(settings, noise);
        let svg = speed_against_error(&report).unwrap().unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        let dir = tempfile::tempdir().unwrap();
        assert!(page(&report, dir.path()).unwrap().ends_with("</html>\n"));
    }
    // Axes are bounded.
    let mut extreme = odd(vec![(0.4, 1.0), (0.5, 2.0)], Some(1e300));
    for (at, time) in [(2, 1e-300), (3, f64::MIN_POSITIVE), (4, f64::MAX)] {
        extreme.strategies[at].time_vs_frustum = Some(time);
    }
    let svg = speed_against_error(&extreme).unwrap().unwrap();
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    // No swept strategies, and hostile names.
    let none = odd(Vec::new(), None);
    assert_eq!(speed_against_error(&none).unwrap(), None);
    let mut strange = swept::known();
    for strategy in &mut strange.strategies {
        strategy.label = HOSTILE.into();
    }
    let mut strange = swept::with(strange, &["wrong_pixels=1%"]);
    let sweep = strange.sweep.as_mut().unwrap();
    sweep.strategies = vec![HOSTILE.into(), HOSTILE.into()];
    sweep.vary[0].key = HOSTILE.into();
    let dir = tempfile::tempdir().unwrap();
    let html = page(&strange, dir.path()).unwrap();
    assert!(!html.contains("<script") && !html.contains("<img src=x"));
}

#[test]
fn passes_that_overlap_are_said_to() {
    let mut report = synthetic::report();
    let dir = tempfile::tempdir().unwrap();
    let text = |report: &Report| page(report, dir.path()).unwrap();
    assert!(!text(&report).contains("overlap on this GPU"));
    let strategy = &mut report.strategies[0];
    strategy.frame_ms.median = 3.0;
    let times = [0.5, 1.0, 1.5];
    for (pass, time) in strategy.passes.iter_mut().zip(times) {
        pass.gpu_ms = Some(time);
    }
    assert_eq!(strategy.overlapping_passes_ms(), None);
    strategy.passes[0].gpu_ms = Some(0.75);
    assert_eq!(strategy.overlapping_passes_ms(), None, "a sum of medians");
    strategy.passes[0].gpu_ms = Some(1.0);
    assert_eq!(strategy.overlapping_passes_ms(), Some(3.5));
    let text = text(&report);
    let words = "together 3.50 ms in a frame of 3.00 ms";
    assert!(text.contains(words), "{text}");
}
