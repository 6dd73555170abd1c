//! Comparison tables: for terminals, for Markdown and, by their cells, for the page.

use std::io::IsTerminal;

use unicode_width::UnicodeWidthStr;

use crate::format;
use crate::report::{AnswerReport, Report, StrategyReport};

mod eyes;
mod facts;
mod motion;
mod sweep;

pub use facts::facts;

/// A report as rows and columns of text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The columns, left to right.
    pub columns: Vec<Column>,
    /// The rows, one for each strategy; each has a cell for each column.
    pub rows: Vec<Row>,
}

/// The heading of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// The heading's first line.
    pub title: &'static str,
    /// The heading's second line: the unit, or the rest of the title.
    pub unit: &'static str,
    /// Whether its cells are right-aligned, as numbers are.
    pub right: bool,
}

/// The row of a strategy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// Its cells.
    pub cells: Vec<TableCell>,
    /// Whether it is one of `none`, `frustum`, `ideal`.
    pub yardstick: bool,
    /// Whether it claims to be conservative and is not.
    pub broken: bool,
}

/// A cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableCell {
    /// The text, without control characters; `-` where nothing was measured.
    pub text: String,
    /// Whether it is the best of its column, without the yardsticks.
    pub best: bool,
}

type Show = fn(&Report, &StrategyReport) -> Option<String>;
type Cost = fn(&StrategyReport) -> Option<f64>;

/// The definition of a column.
struct Definition {
    column: Column,
    /// The text of a strategy's cell.
    show: Show,
    /// The value of which the best strategy has the least; `None` where no strategy is the best.
    cost: Option<Cost>,
}

const fn text(title: &'static str, unit: &'static str, show: Show) -> Definition {
    Definition {
        column: Column {
            title,
            unit,
            right: false,
        },
        show,
        cost: None,
    }
}

const fn number(
    title: &'static str,
    unit: &'static str,
    show: Show,
    cost: Option<Cost>,
) -> Definition {
    Definition {
        column: Column {
            title,
            unit,
            right: true,
        },
        show,
        cost,
    }
}

const COLUMNS: &[Definition] = &[
    text("strategy", "", |report, s| {
        Some(format::short(report.title_of(s), 64))
    }),
    text("latency", "", |_, s| Some(format::short(&s.latency, 12))),
    number(
        "frame",
        "ms",
        |_, s| Some(format::milliseconds(s.frame_ms.median)),
        Some(|s| Some(s.frame_ms.median)),
    ),
    number(
        "free run",
        "ms",
        |_, s| s.free_running_ms.map(format::milliseconds),
        Some(|s| s.free_running_ms),
    ),
    number(
        "speed vs",
        "none",
        |_, s| speed(s.time_vs_none),
        Some(|s| s.time_vs_none),
    ),
    number(
        "speed vs",
        "frustum",
        |_, s| speed(s.time_vs_frustum),
        Some(|s| s.time_vs_frustum),
    ),
    number(
        "speed vs",
        "ideal",
        |_, s| speed(s.time_vs_ideal),
        Some(|s| s.time_vs_ideal),
    ),
    number(
        "drawn",
        "entities",
        |_, s| Some(format::count(s.drawn.entities)),
        None,
    ),
    number(
        "queries",
        "a frame",
        |_, s| Some(format::count(s.queries)),
        None,
    ),
    number(
        "sync",
        "points",
        |_, s| Some(s.sync_points.to_string()),
        None,
    ),
    number(
        "answers",
        "frames old",
        |_, s| Some(answer_age(s.answers?)),
        None,
    ),
    number(
        "wrong px",
        "mean %",
        |_, s| Some(format::percent(s.error.wrong_pixels_percent.mean)),
        Some(|s| Some(s.error.wrong_pixels_percent.mean)),
    ),
    number(
        "wrong px",
        "max %",
        |_, s| Some(format::percent(s.error.wrong_pixels_percent.max)),
        Some(|s| Some(s.error.wrong_pixels_percent.max)),
    ),
    number(
        "of owned",
        "mean %",
        |_, s| {
            s.error
                .wrong_of_owned_percent
                .map(|owned| format::percent(owned.mean))
        },
        Some(|s| s.error.wrong_of_owned_percent.map(|owned| owned.mean)),
    ),
    number(
        "of owned",
        "max %",
        |_, s| {
            s.error
                .wrong_of_owned_percent
                .map(|owned| format::percent(owned.max))
        },
        Some(|s| s.error.wrong_of_owned_percent.map(|owned| owned.max)),
    ),
    number(
        "false",
        "culls",
        |_, s| Some(format::count(s.error.false_culls.entities as f64)),
        Some(|s| Some(s.error.false_culls.entities as f64)),
    ),
    number(
        "lost",
        "for good",
        |_, s| {
            s.lost
                .as_ref()
                .map(|lost| format::count(lost.entities as f64))
        },
        Some(|s| s.lost.as_ref().map(|lost| lost.entities as f64)),
    ),
    number("ties", "mean %", ties, None),
    number(
        "FLIP",
        "mean",
        |_, s| Some(format::flip(s.error.flip.mean)),
        Some(|s| Some(s.error.flip.mean)),
    ),
];

/// `1`, or `1-3` where answers differ in age.
fn answer_age(answers: AnswerReport) -> String {
    match answers.youngest == answers.oldest {
        true => answers.oldest.to_string(),
        false => format!("{}-{}", answers.youngest, answers.oldest),
    }
}

/// Pixels that show another entity of equal depth; a column that is left out where no strategy has any.
fn ties(report: &Report, strategy: &StrategyReport) -> Option<String> {
    let percent = |s: &StrategyReport| s.error.ties.map(|ties| ties.percent());
    let any = |s: &StrategyReport| percent(s).is_some_and(|percent| percent > 0.0);
    report.strategies.iter().find(|s| any(s))?;
    percent(strategy).map(format::percent)
}

/// `3.4x`: how many times as fast, from a ratio of times.
fn speed(time_ratio: Option<f64>) -> Option<String> {
    time_ratio
        .filter(|r| *r > 0.0)
        .map(|r| format!("{}x", format::ratio(r.recip())))
}

impl Table {
    /// The table of a report; for a sweep, with a mark on the settings of the efficient edge. Columns in which nothing was measured are left
    /// out.
    pub fn new(report: &Report) -> Self {
        Self::of(report, COLUMNS).with_edge(report)
    }

    fn of<'a>(report: &Report, columns: impl IntoIterator<Item = &'a Definition>) -> Self {
        let used: Vec<&Definition> = columns
            .into_iter()
            .filter(|definition| {
                let shows = |s| (definition.show)(report, s).is_some();
                report.strategies.is_empty() || report.strategies.iter().any(shows)
            })
            .collect();
        let compared: Vec<&StrategyReport> = report
            .strategies
            .iter()
            .filter(|s| !s.is_yardstick())
            .collect();
        let best: Vec<Option<f64>> = used
            .iter()
            .map(|Definition { cost, .. }| {
                // A single strategy is not marked as the best.
                let cost = cost.filter(|_| compared.len() > 1)?;
                compared
                    .iter()
                    .filter_map(|s| cost(s))
                    .min_by(f64::total_cmp)
            })
            .collect();
        let rows = report.strategies.iter().map(|s| Row {
            cells: used
                .iter()
                .zip(&best)
                .map(|(Definition { show, cost, .. }, best)| TableCell {
                    text: show(report, s).unwrap_or_else(|| "-".to_owned()),
                    best: !s.is_yardstick()
                        && best.is_some()
                        && cost.and_then(|cost| cost(s)) == *best,
                })
                .collect(),
            yardstick: s.is_yardstick(),
            broken: s.breaks_its_promise(),
        });
        Self {
            columns: used.iter().map(|definition| definition.column).collect(),
            rows: rows.collect(),
        }
    }

    /// The table for a terminal, with aligned columns. With `colour`, the best values are bold, yardsticks are dim, and strategies that claim to
    /// be conservative and are not are red.
    pub fn terminal(&self, colour: bool) -> String {
        let widths = self.widths();
        let mut out = String::new();
        let mut line = |cells: Vec<(&str, &str)>| {
            let mut text = String::new();
            for (((cell, style), column), width) in cells.iter().zip(&self.columns).zip(&widths) {
                let pad = " ".repeat(width.saturating_sub(cell.width()));
                let cell = if colour && !style.is_empty() {
                    format!("\x1b[{style}m{cell}\x1b[0m")
                } else {
                    (*cell).to_owned()
                };
                text += &if column.right {
                    format!("{pad}{cell}  ")
                } else {
                    format!("{cell}{pad}  ")
                };
            }
            out.push_str(text.trim_end());
            out.push('\n');
        };
        line(self.columns.iter().map(|c| (c.title, "1")).collect());
        line(self.columns.iter().map(|c| (c.unit, "2")).collect());
        for row in &self.rows {
            let style = |cell: &TableCell| match (row.broken, cell.best, row.yardstick) {
                (true, ..) => "31",
                (_, true, _) => "1",
                (.., true) => "2",
                _ => "",
            };
            line(
                row.cells
                    .iter()
                    .map(|cell| (cell.text.as_str(), style(cell)))
                    .collect(),
            );
        }
        out
    }

    /// The table as Markdown, with the best values in bold.
    pub fn markdown(&self) -> String {
        let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let heads = self
            .columns
            .iter()
            .map(|c| format!("{} {}", c.title, c.unit).trim_end().to_owned());
        let mut out = row(heads.collect());
        out += &row(self
            .columns
            .iter()
            .map(|c| if c.right { "---:" } else { "---" }.to_owned())
            .collect());
        for r in &self.rows {
            let cells = r.cells.iter().map(|cell| {
                let text = escape_markdown(&cell.text);
                if cell.best {
                    format!("**{text}**")
                } else {
                    text
                }
            });
            out += &row(cells.collect());
        }
        out
    }

    fn widths(&self) -> Vec<usize> {
        let heads = self
            .columns
            .iter()
            .map(|c| c.title.width().max(c.unit.width()));
        heads
            .enumerate()
            .map(|(i, head)| {
                let cells = self.rows.iter().filter_map(|row| row.cells.get(i));
                cells
                    .map(|cell| cell.text.width())
                    .max()
                    .unwrap_or(0)
                    .max(head)
            })
            .collect()
    }
}

/// Whether to colour the output to a stream: it is a terminal, and `NO_COLOR` is not set.
pub fn wants_colour(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Escapes the characters that have a meaning in Markdown, or in HTML within it.
fn escape_markdown(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '<' => out += "&lt;",
            '&' => out += "&amp;",
            '|' | '*' | '_' | '`' | '[' | ']' | '\\' => out.extend(['\\', c]),
            _ => out.push(c),
        }
    }
    out
}
