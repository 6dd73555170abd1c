//! The upper part of the page: the facts of the run, recommendations, and the table.

use super::escape;
use crate::audit_summary;
use crate::format;
use crate::report::Report;
use crate::summary::{self, Summary, Tone};
use crate::table::{Table, facts};
use crate::trade_off;

/// The title and the facts of the run.
pub(super) fn header(report: &Report) -> String {
    let [scene, adapter] = facts(report);
    let swept = report.sweep.as_ref().map(trade_off::sweep_title);
    format!(
        "<header>\n<p class=\"brand\">Antumbra {}</p>\n<h1>Occlusion culling: {}</h1>\n<p class=\"facts\">{}{}<br>{}</p>\n</header>\n",
        escape(&report.antumbra),
        escape(&report.scene.name),
        swept.map_or_else(String::new, |words| escape(&upper_first(&words)) + "<br>"),
        escape(&upper_first(&scene)),
        escape(&upper_first(&adapter)),
    )
}

/// A card for each choice of a sweep's limits or, without limits, for each recommendation; and a card with the distance from `ideal`.
pub(super) fn recommendations(report: &Report) -> String {
    let recommended = summary::recommendations(report);
    let withheld = summary::withheld(report);
    if recommended.is_empty() && withheld.is_empty() {
        return String::new();
    }
    let mut html = "<section class=\"cards\">\n".to_owned();
    let answers = trade_off::choice_texts(report);
    for answer in &answers {
        let lines = answer.lines.iter().map(|line| escape(&upper_first(line)));
        html += &format!(
            "<div class=\"card {}\"><p class=\"question\">{}</p><p class=\"name\">{}</p><p>{}</p></div>\n",
            if answer.within { "good" } else { "poor" },
            escape(&answer.heading),
            escape(report.title_of(answer.setting)),
            lines.collect::<Vec<_>>().join(".</p><p>"),
        );
    }
    // Limits replace the general recommendations.
    for pick in recommended.iter().filter(|_| answers.is_empty()) {
        html += &format!(
            "<div class=\"card {}\"><p class=\"question\">{}</p><p class=\"name\">{}</p><p>{}</p></div>\n",
            class(pick.summary.tone),
            escape(pick.title),
            escape(report.title_of(pick.strategy)),
            escape(&upper_first(&pick.summary.text)),
        );
    }
    for (strategy, loss) in withheld {
        html += &format!(
            "<div class=\"card poor\"><p class=\"question\">Not recommended</p><p class=\"name\">{}</p><p>{}</p></div>\n",
            escape(report.title_of(strategy)),
            escape(&upper_first(&loss)),
        );
    }
    let efficiency = recommended
        .iter()
        .filter_map(|pick| Some((pick.strategy.efficiency()?, pick.strategy)))
        // A strategy that culls visible entities can be faster than `ideal`.
        .filter(|(efficiency, _)| *efficiency <= 1.0)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((efficiency, strategy)) = efficiency {
        html += &format!(
            "<div class=\"card\"><p class=\"question\">Room left</p><p class=\"name\">{} % of ideal</p>\
             <p>{} takes {} times as long as drawing exactly the visible entities, known in advance without cost.</p></div>\n",
            format::percent(efficiency * 100.0),
            escape(strategy.title()),
            format::factor(efficiency.recip()),
        );
    }
    html + "</section>\n"
}

/// The table, in stereo a second one for the eyes, and a sentence about each strategy.
pub(super) fn table(report: &Report) -> String {
    let mut html = match report.sweep {
        Some(_) => "<section>\n<h2>All settings</h2>\n",
        None => "<section>\n<h2>All strategies</h2>\n",
    }
    .to_owned();
    html += &grid(&Table::new(report));
    html += "<p class=\"meaning\">Best values are marked; none, frustum and ideal are the yardsticks and are not \
             marked. Speed vs: how many times as fast (2x takes half the time). Drawn, queries: means over the frames. Wrong px: pixels whose \
             entity differs from the reference, in percent of the image. Of owned: the same in percent of the pixels that entities own. False culls: visible \
             entities not drawn, summed over all frames. Lost for good: entities that were drawn in no frame in which they were visible. Ties: pixels that show \
             another entity of equal depth, which are no errors; FLIP is computed from the shaded images and sees them.</p>\n";
    html += &format!(
        "<p class=\"meaning\">Recommendations, choices and the plot go by wrong pixels as a share {}.</p>\n",
        report.error_basis().words()
    );
    for line in summary::following(report) {
        html += &format!("<p class=\"meaning\">{}</p>\n", escape(&upper_first(&line)));
    }
    if report.sweep.is_some() {
        html += &format!(
            "<p class=\"meaning\">{}</p>\n",
            escape(trade_off::EDGE_LEGEND)
        );
    }
    if let Some(eyes) = Table::eyes(report) {
        html += "<h3>Each eye</h3>\n";
        html += &grid(&eyes);
        html += "<p class=\"meaning\">Above, both eyes count together: a frame draws both, wrong pixels are a share of the pixels of \
                 both. Here each is held against its own reference.</p>\n";
    }
    html += "<ul class=\"verdicts\">\n";
    for strategy in report.strategies.iter().filter(|s| !s.is_yardstick()) {
        let Summary { text, tone } = summary::summarise(report, strategy);
        html += &format!(
            "<li class=\"{}\"><b>{}</b>: {}</li>\n",
            class(tone),
            escape(strategy.title()),
            escape(&text)
        );
    }
    for audit_summary::AuditSummary { strategy, lines } in audit_summary::audit_summaries(report) {
        let lines = lines.iter().map(|line| escape(&upper_first(line)));
        html += &format!(
            "<li><b>{}</b>: {}.</li>\n",
            escape(strategy.title()),
            lines.collect::<Vec<_>>().join(". ")
        );
    }
    html + "</ul>\n</section>\n"
}

/// A table's cells.
fn grid(table: &Table) -> String {
    let mut html = "<div class=\"scroll\"><table class=\"compare\">\n<thead><tr>".to_owned();
    for column in &table.columns {
        html += &format!(
            "<th{}>{}<small>{}</small></th>",
            if column.right { " class=\"n\"" } else { "" },
            escape(column.title),
            escape(column.unit)
        );
    }
    html += "</tr></thead>\n<tbody>\n";
    for row in &table.rows {
        let kind = match (row.broken, row.yardstick) {
            (true, _) => " class=\"broken\"",
            (_, true) => " class=\"yardstick\"",
            _ => "",
        };
        html += &format!("<tr{kind}>");
        for (cell, column) in row.cells.iter().zip(&table.columns) {
            let class = match (column.right, cell.best) {
                (true, true) => " class=\"n best\"",
                (true, false) => " class=\"n\"",
                (false, true) => " class=\"best\"",
                (false, false) => "",
            };
            html += &format!("<td{class}>{}</td>", escape(&cell.text));
        }
        html += "</tr>\n";
    }
    html + "</tbody></table></div>\n"
}

fn class(tone: Tone) -> &'static str {
    match tone {
        Tone::Yardstick => "yardstick",
        Tone::Good => "good",
        Tone::Trade => "trade",
        Tone::Poor => "poor",
        Tone::Broken => "broken",
    }
}

fn upper_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
