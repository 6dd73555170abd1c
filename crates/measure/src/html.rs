//! The page: one self-contained `report.html`, made from a report and the pictures that it names.
//!
//! It has no scripts and no fonts and loads nothing; styles and pictures are embedded. All text of the report is escaped, since names of scenes,
//! adapters and strategies are untrusted.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::MeasureError;
use crate::files::write_whole;
use crate::report::Report;
use crate::{format, plots};

mod facts;
mod overview;
mod pictures;

const CSS: &str = include_str!("html/page.css");

/// Writes `report.html` into `dir`, the folder of the report's pictures, and returns its path. A picture that cannot be read is replaced by its
/// error.
///
/// # Errors
/// [`MeasureError`] where the report does not pass [`Report::check`], a plot fails, or the page cannot be written.
pub fn write_html(report: &Report, dir: impl AsRef<Path>) -> Result<PathBuf, MeasureError> {
    let dir = dir.as_ref();
    let file = dir.join("report.html");
    write_whole(&file, page(report, dir)?.as_bytes())?;
    Ok(file)
}

/// The page's text. `dir` is the folder of the report's pictures.
///
/// # Errors
/// As for [`write_html`], except for those of the file.
pub fn page(report: &Report, dir: &Path) -> Result<String, MeasureError> {
    page_with(report, Pictures::Folder(dir))
}

/// Where a report's pictures are.
#[derive(Clone, Copy)]
pub(crate) enum Pictures<'a> {
    /// In files of this folder.
    Folder(&'a Path),
    /// In memory: PNG files by their names.
    Memory(&'a BTreeMap<String, Vec<u8>>),
}

/// The page's text.
///
/// # Errors
/// As for [`page`].
pub(crate) fn page_with(report: &Report, from: Pictures<'_>) -> Result<String, MeasureError> {
    report.check()?;
    let title = escape(&format!("Occlusion culling: {}", report.scene.name));
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{CSS}</style>\n</head>\n<body>\n<main>\n"
    );
    html += &overview::header(report);
    html += &overview::recommendations(report);
    html += &overview::table(report);
    html += &figure(
        "Speed against error",
        match report.sweep {
            Some(_) => {
                "Each setting by its speed and its wrong pixels. Down and to the right is better. The line joins the settings \
                 on the efficient edge; the one to take is the furthest right whose errors are acceptable."
            }
            None => {
                "Each strategy by its speed and its wrong pixels. Down and to the right is better."
            }
        },
        plots::speed_against_error(report)?,
    );
    html += &figure(
        "Frame time along the path",
        "The serialised time of each frame, by pose.",
        plots::frame_times(report)?,
    );
    html += &figure(
        "Where a frame's time goes",
        "Median times of a frame. A strategy is worthwhile when it saves more drawing time than its culling takes.",
        plots::stage_times(report)?,
    );
    html += &pictures::worst_frames(report, from);
    html += &facts::passes(report);
    html += &facts::strategies(report);
    html += &facts::run(report);
    html += "</main>\n</body>\n</html>\n";
    Ok(html)
}

/// A plot with title and explanation; empty where there is no plot.
fn figure(title: &str, meaning: &str, svg: Option<String>) -> String {
    svg.map_or_else(String::new, |svg| {
        format!(
            "<section>\n<h2>{}</h2>\n<p class=\"meaning\">{}</p>\n<div class=\"plot\">{svg}</div>\n</section>\n",
            escape(title),
            escape(meaning)
        )
    })
}

/// Escapes text for an element or a quoted attribute.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let text = format::clean(text);
    let mut letters = text.chars().peekable();
    let mut before = ' ';
    while let Some(c) = letters.next() {
        let next = letters.peek().copied().unwrap_or(' ');
        match c {
            // Keeps 20 000 and 5 % on one line.
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
