//! Speed against error: the one plot on which a strategy, or a setting of one, is chosen.

use plotters::prelude::RGBColor;

use super::axis::Axis;
use super::canvas::{INK, Mark, Swatch, coloured, name};
use crate::MeasureError;
use crate::report::Report;
use crate::trade_off::{TimeBase, front};
use draw::{Picture, Point, sheet};
use speed::Speed;

mod draw;
mod speed;
mod sweep;

/// Speed to the right, mean wrong pixels upwards by decades with a place of their own for those
/// that are 0. The efficient edge joins the strategies than which nothing measured is both faster
/// and less wrong; `ideal`, where it was measured, is the line no strategy can cross. None for a
/// report without strategies.
///
/// Of a sweep it shows the settings alone: those on the edge with their names, how far the noise
/// may have moved each, its worst frame, and every budget of wrong pixels.
///
/// # Errors
/// When the plotter fails.
pub fn speed_against_error(report: &Report) -> Result<Option<String>, MeasureError> {
    let picture = match &report.sweep {
        Some(swept) => sweep::picture(report, swept),
        None => compared(report),
    };
    picture.map(|picture| sheet(&picture)).transpose()
}

/// All strategies of a comparison.
fn compared(report: &Report) -> Option<Picture> {
    let speed = Speed(TimeBase::of(report));
    let (ideal, rest): (Vec<_>, Vec<_>) = coloured(report)
        .into_iter()
        .partition(|(s, _)| s.name == "ideal");
    let points: Vec<Point> = rest
        .into_iter()
        .map(|(s, colour)| {
            let place = (speed.get(s), s.error.wrong_pixels_percent.mean);
            Point::new(name(report, s), Mark::Dot(colour), place)
        })
        .collect();
    if points.is_empty() {
        return None;
    }
    let ideal = ideal.first().map(|(s, _)| speed.get(s));
    let mut legend = vec![entry(
        "efficient edge: nothing measured is both faster and less wrong",
        INK,
        Swatch::Dashes,
    )];
    legend.extend(ideal.map(|_| draw::ideal("ideal: the limit of any culling")));
    let fastest = points.iter().map(|p| p.speed).chain(ideal);
    let fastest = fastest.fold(f64::MIN_POSITIVE, f64::max);
    let costs: Vec<_> = points.iter().map(|p| (-p.speed, p.error)).collect();
    let edge = front(&costs);
    Some(Picture {
        height: 430,
        speed,
        x: Axis::even(0.0..fastest * 1.08, 9, |v| speed.word(v)),
        edge: edge
            .into_iter()
            .filter_map(|at| points.get(at))
            .map(Point::place)
            .collect(),
        solid_edge: false,
        points,
        ideal,
        limits: Vec::new(),
        legend,
    })
}

fn entry(words: impl Into<String>, colour: RGBColor, swatch: Swatch) -> (String, RGBColor, Swatch) {
    (words.into(), colour, swatch)
}
