//! The plot of the parts of a frame's time: culling, drawing, and the rest.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::canvas::{
    Area, Drawing, Frame, INK, LegendEntry, Swatch, UNIT, coloured, legend, letters, name, sheet,
    text_width,
};
use crate::MeasureError;
use crate::format;
use crate::report::Report;

const TITLE: &str = "Where a frame's time goes";
const CULL: RGBColor = RGBColor(240, 120, 20);
const DRAW: RGBColor = RGBColor(47, 126, 237);
const REST: RGBColor = RGBColor(160, 165, 175);
const LETTER: i32 = 13;

/// A strategy's bar, in milliseconds.
struct Bar {
    name: String,
    cull: f64,
    draw: f64,
    frame: f64,
}

/// Plots a bar for each strategy: culling, drawing, and the rest of the serialised frame. `None` for a report without strategies.
///
/// # Errors
/// [`MeasureError::Plot`] where the plotter fails.
pub fn stage_times(report: &Report) -> Result<Option<String>, MeasureError> {
    // Reversed, since rows count from the bottom and the first strategy is at the top.
    let bars: Vec<Bar> = coloured(report)
        .into_iter()
        .rev()
        .map(|one| one.strategy)
        .map(|s| Bar {
            name: name(report, s),
            cull: s.cull_ms.unwrap_or(0.0),
            draw: s.draw_ms.unwrap_or(0.0),
            frame: s.frame_ms.median,
        })
        .collect();
    if bars.is_empty() {
        return Ok(None);
    }
    let height = 90 + 34 * bars.len().min(200) as i32;
    sheet(TITLE, height, |area| draw(area, &bars)).map(Some)
}

fn draw(area: &Area<'_>, bars: &[Bar]) -> Drawing {
    let entry = |words: &str, colour| LegendEntry::new(words, colour, Swatch::Box);
    let entries = [
        entry("cull: deciding what to draw", CULL),
        entry("draw: the shaded passes", DRAW),
        entry("rest: recording, waiting, other passes", REST),
    ];
    let area = legend(area, &entries)?;
    let longest = bars
        .iter()
        .map(|b| b.frame.max(b.cull + b.draw))
        .fold(1e-6, f64::max);
    let x = Axis::even(0.0..longest * 1.12, 9, format::trimmed);
    let y = Axis::rows(bars.iter().map(|b| b.name.clone()).collect());
    let widest = bars
        .iter()
        .map(|b| text_width(&b.name, LETTER))
        .max()
        .unwrap_or(0);
    let frame = Frame {
        x,
        y,
        x_means: "median time a frame (ms)",
        y_means: "",
        y_room: widest / UNIT + 24,
    };
    let mut chart = frame.draw(&area)?;
    for (row, bar) in bars.iter().enumerate() {
        let middle = row as f64 + 0.5;
        let mut from = 0.0;
        let rest = (bar.frame - bar.cull - bar.draw).max(0.0);
        for (ms, colour) in [(bar.cull, CULL), (bar.draw, DRAW), (rest, REST)] {
            let corners = [(from, middle - 0.3), (from + ms, middle + 0.3)];
            chart.draw_series([Rectangle::new(corners, colour.filled())])?;
            from += ms;
        }
        let style = letters(LETTER, &INK).pos(Pos::new(HPos::Left, VPos::Center));
        let label = EmptyElement::at((from, middle))
            + Text::new(
                format!("{} ms", format::milliseconds(bar.frame)),
                (6 * UNIT, 0),
                style,
            );
        chart.draw_series([label])?;
    }
    Ok(())
}
