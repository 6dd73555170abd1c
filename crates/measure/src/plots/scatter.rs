//! The plot of speed against error, for strategies or for the settings of a sweep.

use super::axis::Axis;
use super::canvas::{INK, LegendEntry, Mark, Swatch, coloured, name};
use crate::MeasureError;
use crate::report::Report;
use crate::trade_off::{Cost, TimeBase, front};
use antumbra_cull::Role;
use draw::{EdgeLine, Place, Plot, Point, sheet};
use speed::Speed;

mod draw;
mod speed;
mod sweep;

/// Plots mean wrong pixels (by [`Report::error_basis`]), logarithmic with a position for 0, over speed. A line connects the strategies on the Pareto front (the efficient
/// edge). A vertical line shows `ideal`, the limit of every conservative strategy, where it was measured. `None` for a report without
/// strategies.
///
/// For a sweep, it shows only the settings: names of those on the front, error bars for the noise and the worst frame, and each limit of wrong
/// pixels.
///
/// # Errors
/// [`MeasureError::Plot`] where the plotter fails.
pub fn speed_against_error(report: &Report) -> Result<Option<String>, MeasureError> {
    let plot = match &report.sweep {
        Some(swept) => sweep::plot(report, swept),
        None => compared(report),
    };
    plot.map(|plot| sheet(&plot)).transpose()
}

/// All strategies of a comparison.
fn compared(report: &Report) -> Option<Plot> {
    let speed = Speed(TimeBase::of(report));
    let basis = report.error_basis();
    let (ideal, rest): (Vec<_>, Vec<_>) = coloured(report)
        .into_iter()
        .partition(|one| one.strategy.role() == Role::Ideal);
    let points: Vec<Point> = rest
        .into_iter()
        .map(|one| {
            let place = Place {
                speed: speed.get(one.strategy),
                error: one.strategy.error.wrong(basis).mean,
            };
            Point::new(name(report, one.strategy), Mark::Dot(one.colour), place)
        })
        .collect();
    if points.is_empty() {
        return None;
    }
    let ideal = ideal.first().map(|one| speed.get(one.strategy));
    let mut legend = vec![LegendEntry::new(
        "efficient edge: nothing measured is both faster and less wrong",
        INK,
        Swatch::Dashes,
    )];
    legend.extend(ideal.map(|_| draw::ideal("ideal: the limit of any culling")));
    let fastest = points.iter().map(|p| p.place.speed).chain(ideal);
    let fastest = fastest.fold(f64::MIN_POSITIVE, f64::max);
    let cost = |p: &Point| Cost {
        time: -p.place.speed,
        error: p.place.error,
    };
    let edge = front(&points.iter().map(cost).collect::<Vec<_>>());
    Some(Plot {
        height: 430,
        speed,
        x: Axis::even(0.0..fastest * 1.08, 9, |v| speed.word(v)),
        edge: edge
            .into_iter()
            .filter_map(|at| points.get(at))
            .map(|point| point.place)
            .collect(),
        edge_line: EdgeLine::Dashed,
        points,
        ideal,
        basis,
        limits: Vec::new(),
        legend,
    })
}
