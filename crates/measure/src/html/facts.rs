//! The folded lower part of the page: pass times, settings and verdicts, and the command of the run.

use super::escape;
use crate::format;
use crate::report::{PassTime, Report, StrategyReport};

/// A table of pass times for each strategy.
pub(super) fn passes(report: &Report) -> String {
    let timed: Vec<&StrategyReport> = report
        .strategies
        .iter()
        .filter(|s| !s.passes.is_empty())
        .collect();
    if timed.is_empty() {
        return String::new();
    }
    let body: String = timed
        .iter()
        .map(|strategy| {
            let rows: String = strategy.passes.iter().map(pass).collect();
            let overlap = strategy.overlapping_passes_ms().map_or_else(String::new, |sum| {
                format!(
                    "<p>The passes overlap on this GPU: together {} ms in a frame of {} ms. A time says how long its pass was under way.</p>\n",
                    format::milliseconds(sum),
                    format::milliseconds(strategy.frame_ms.median)
                )
            });
            format!(
                "<h3>{}</h3>\n{overlap}<table class=\"narrow\"><thead><tr><th>pass</th><th>group</th><th class=\"n\">GPU<small>ms</small></th>\
                 <th class=\"n\">CPU<small>ms</small></th></tr></thead><tbody>\n{rows}</tbody></table>\n",
                escape(strategy.title())
            )
        })
        .collect();
    folded(
        "Pass times (medians)",
        &format!("<div class=\"side-by-side\">{}</div>", in_blocks(&body)),
    )
}

/// Puts each `<h3>` with its contents into a block, so that blocks can be side by side.
fn in_blocks(body: &str) -> String {
    body.split("<h3>")
        .skip(1)
        .map(|block| format!("<div><h3>{block}</div>\n"))
        .collect()
}

fn pass(pass: &PassTime) -> String {
    let time = |ms: Option<f64>| ms.map_or_else(|| "-".to_owned(), format::milliseconds);
    format!(
        "<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        escape(&pass.name),
        escape(&pass.group),
        time(pass.gpu_ms),
        time(pass.cpu_ms)
    )
}

/// Settings and verdicts of each strategy.
pub(super) fn strategies(report: &Report) -> String {
    let mut rows = String::new();
    for strategy in &report.strategies {
        let settings: Vec<String> = strategy
            .settings
            .iter()
            .map(|(key, value)| match strategy.follows_image.get(key) {
                Some(found) => format!("{key} = {found} (follows the image)"),
                None => format!("{key} = {value}"),
            })
            .collect();
        let verdicts: Vec<String> = strategy
            .verdicts
            .iter()
            .map(|(verdict, mean)| format!("{verdict} {}", format::count(*mean)))
            .collect();
        let runs = strategy.error.false_culls.longest_run_frames;
        rows += &format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
            escape(strategy.title()),
            if strategy.conservative {
                "conservative"
            } else {
                "aggressive"
            },
            escape(&settings.join(", ")),
            escape(&verdicts.join(", ")),
            format::count(strategy.overdrawn_entities),
            format::count(runs as f64),
        );
    }
    folded(
        "Settings and verdicts",
        &format!(
            "<div class=\"scroll\"><table><thead><tr><th>strategy</th><th>claims to be</th><th>settings</th>\
             <th>verdicts<small>mean entities a frame</small></th><th class=\"n\">overdrawn<small>mean a frame</small></th>\
             <th class=\"n\">false culls<small>longest run, frames</small></th></tr></thead><tbody>\n{rows}</tbody></table></div>\n"
        ),
    )
}

/// The command, the seeds and the labels.
pub(super) fn run(report: &Report) -> String {
    let mut list = String::new();
    let mut entry = |term: &str, text: &str| {
        list += &format!("<dt>{}</dt><dd>{}</dd>\n", escape(term), escape(text))
    };
    if !report.command.is_empty() {
        entry("command", &report.command);
    }
    for (what, seed) in &report.seeds {
        entry(&format!("seed of {what}"), &seed.to_string());
    }
    for (name, words) in &report.labels {
        entry(name, words);
    }
    if list.is_empty() {
        String::new()
    } else {
        folded("How this was run", &format!("<dl>\n{list}</dl>\n"))
    }
}

fn folded(title: &str, body: &str) -> String {
    format!(
        "<details>\n<summary>{}</summary>\n{body}</details>\n",
        escape(title)
    )
}
