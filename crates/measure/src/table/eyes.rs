//! The stereo table: queries and errors of each eye.

use super::{Definition, Table, number, text};
use crate::format;
use crate::report::{ErrorReport, Report, StrategyReport};

const COLUMNS: &[Definition] = &[
    text("strategy", "", |report, s| {
        Some(format::short(report.title_of(s), 64))
    }),
    number("queries", "left", |_, s| queries(s, 0), None),
    number("queries", "right", |_, s| queries(s, 1), None),
    number(
        "wrong px",
        "left, mean %",
        |_, s| shown(mean(s, 0)),
        Some(|s| mean(s, 0)),
    ),
    number(
        "wrong px",
        "right, mean %",
        |_, s| shown(mean(s, 1)),
        Some(|s| mean(s, 1)),
    ),
    number(
        "wrong px",
        "left, max %",
        |_, s| shown(max(s, 0)),
        Some(|s| max(s, 0)),
    ),
    number(
        "wrong px",
        "right, max %",
        |_, s| shown(max(s, 1)),
        Some(|s| max(s, 1)),
    ),
    number(
        "false culls",
        "left",
        |_, s| culls(s, 0).map(format::count),
        Some(|s| culls(s, 0)),
    ),
    number(
        "false culls",
        "right",
        |_, s| culls(s, 1).map(format::count),
        Some(|s| culls(s, 1)),
    ),
];

impl Table {
    /// The numbers of each eye; `None` where no strategy was measured with two. [`Table::new`] has both eyes together.
    pub fn eyes(report: &Report) -> Option<Self> {
        let measured = report.strategies.iter().any(|s| of(s, 0).is_some());
        (report.scene.views == 2 && measured).then(|| Self::of(report, COLUMNS))
    }
}

/// The error block of an eye; 0 is the left one.
fn of(strategy: &StrategyReport, eye: usize) -> Option<&ErrorReport> {
    match strategy.views.as_slice() {
        both @ [_, _] => both.get(eye),
        _ => None,
    }
}

fn mean(strategy: &StrategyReport, eye: usize) -> Option<f64> {
    of(strategy, eye).map(|error| error.wrong_pixels_percent.mean)
}

fn max(strategy: &StrategyReport, eye: usize) -> Option<f64> {
    of(strategy, eye).map(|error| error.wrong_pixels_percent.max)
}

fn culls(strategy: &StrategyReport, eye: usize) -> Option<f64> {
    of(strategy, eye).map(|error| error.false_culls.entities as f64)
}

fn queries(strategy: &StrategyReport, eye: usize) -> Option<String> {
    let asked = strategy.queries_a_view.get(eye);
    asked.map(|asked| format::count(*asked))
}

fn shown(percent: Option<f64>) -> Option<String> {
    percent.map(format::percent)
}
