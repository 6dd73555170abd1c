//! The page: one self-contained `report.html`, drawn from a report and the pictures it names, that
//! a person understands at a glance.
//!
//! No scripts, no fonts, nothing fetched; styles and pictures are inside. Whatever the report says
//! is escaped: names of scenes, adapters and strategies come from strangers' files.

use std::path::{Path, PathBuf};

use crate::MeasureError;
use crate::files::write_beside;
use crate::report::Report;
use crate::{format, plots};

mod facts;
mod overview;
mod pictures;

const CSS: &str = include_str!("html/page.css");

/// Writes `report.html` into `dir`, where the report's pictures are looked for, and gives its path.
/// A picture that cannot be read is replaced by a sentence that says so.
///
/// # Errors
/// When the report does not pass [`Report::check`], a plot fails, or the page cannot be written.
pub fn write_html(report: &Report, dir: impl AsRef<Path>) -> Result<PathBuf, MeasureError> {
    let dir = dir.as_ref();
    let file = dir.join("report.html");
    write_beside(&file, page(report, dir)?.as_bytes())?;
    Ok(file)
}

/// The page's text; `dir` is where the pictures are.
///
/// # Errors
/// As [`write_html`], but for the file.
pub fn page(report: &Report, dir: &Path) -> Result<String, MeasureError> {
    report.check()?;
    let title = escape(&format!("Occlusion culling: {}", report.scene.name));
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{CSS}</style>\n</head>\n<body>\n<main>\n"
    );
    html += &overview::header(report);
    html += &overview::picks(report);
    html += &overview::table(report);
    html += &figure(
        "Speed against error",
        match report.sweep {
            Some(_) => {
                "Each setting by how fast it is and how wrong its pictures are. Down and to the right is better; the line \
                 joins the settings worth having, and one takes the furthest right of those whose errors one puts up with."
            }
            None => {
                "Each strategy by how fast it is and how wrong its pictures are. Down and to the right is better."
            }
        },
        plots::speed_against_error(report)?,
    );
    html += &figure(
        "Frame time along the path",
        "The serialised time of each frame, pose by pose: where the view is crowded, and where a strategy stumbles.",
        plots::frame_times(report)?,
    );
    html += &figure(
        "Where a frame's time goes",
        "Median times a frame. A strategy pays when drawing shrinks by more than culling costs.",
        plots::stage_times(report)?,
    );
    html += &pictures::worst_frames(report, dir);
    html += &facts::passes(report);
    html += &facts::strategies(report);
    html += &facts::run(report);
    html += "</main>\n</body>\n</html>\n";
    Ok(html)
}

/// A titled plot, or nothing where there is none.
fn figure(title: &str, meaning: &str, svg: Option<String>) -> String {
    svg.map_or_else(String::new, |svg| {
        format!(
            "<section>\n<h2>{}</h2>\n<p class=\"meaning\">{}</p>\n<div class=\"plot\">{svg}</div>\n</section>\n",
            escape(title),
            escape(meaning)
        )
    })
}

/// A text as it may stand in an element or in an attribute's quotes.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let text = format::clean(text);
    let mut letters = text.chars().peekable();
    let mut before = ' ';
    while let Some(c) = letters.next() {
        let next = letters.peek().copied().unwrap_or(' ');
        match c {
            // 20 000 and 5 % stay on one line.
            ' ' if before.is_ascii_digit() && (next == '%' || next.is_ascii_digit()) => {
                out += "&nbsp;"
            }
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            _ => out.push(c),
        }
        before = c;
    }
    out
}
