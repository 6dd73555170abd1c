//! Speed against error: the one plot on which a strategy is chosen.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::canvas::{
    Area, Drawing, FAINT, Frame, INK, Swatch, UNIT, coloured, dashes, legend, letters, name, sheet,
    text_width,
};
use super::labels::{self, Place};
use crate::MeasureError;
use crate::report::{Report, StrategyReport};
use crate::words;

const TITLE: &str = "Speed against error";
const EVERY_RIGHT: &str = "every pixel right";
const LETTER: i32 = 14;
const RADIUS: i32 = 6;

/// What speed is measured by.
#[derive(Clone, Copy)]
enum Speed {
    VsFrustum,
    VsNone,
    FramesPerSecond,
}

impl Speed {
    /// The best yardstick that every strategy was held against.
    fn of(report: &Report) -> Self {
        let all = |ratio: fn(&StrategyReport) -> Option<f64>| {
            report
                .strategies
                .iter()
                .all(|s| ratio(s).is_some_and(|r| r > 0.0))
        };
        if all(|s| s.time_vs_frustum) {
            Self::VsFrustum
        } else if all(|s| s.time_vs_none) {
            Self::VsNone
        } else {
            Self::FramesPerSecond
        }
    }

    fn get(self, s: &StrategyReport) -> f64 {
        match self {
            Self::VsFrustum => s.time_vs_frustum.map_or(0.0, f64::recip),
            Self::VsNone => s.time_vs_none.map_or(0.0, f64::recip),
            Self::FramesPerSecond => 1000.0 / s.frame_ms.median.max(1e-6),
        }
    }

    fn means(self) -> &'static str {
        match self {
            Self::VsFrustum => {
                "speed: how many times as fast as frustum culling alone (further right is better)"
            }
            Self::VsNone => "speed: how many times as fast as no culling (further right is better)",
            Self::FramesPerSecond => "speed: frames per second (further right is better)",
        }
    }

    fn word(self, value: f64) -> String {
        match self {
            Self::FramesPerSecond => words::trimmed(value),
            _ => format!("{}x", words::trimmed(value)),
        }
    }
}

/// A strategy as a point.
struct Point {
    name: String,
    colour: RGBColor,
    speed: f64,
    error: f64,
}

/// Speed to the right, mean wrong pixels upwards by decades with a place of their own for those
/// that are 0. The efficient edge joins the strategies than which nothing measured is both faster
/// and less wrong; `ideal`, where it was measured, is the line no strategy can cross. None for a
/// report without strategies.
///
/// # Errors
/// When the plotter fails.
pub fn speed_against_error(report: &Report) -> Result<Option<String>, MeasureError> {
    let speed = Speed::of(report);
    let (ideal, rest): (Vec<_>, Vec<_>) = coloured(report)
        .into_iter()
        .partition(|(s, _)| s.name == "ideal");
    let points: Vec<Point> = rest
        .into_iter()
        .map(|(s, colour)| Point {
            name: name(s),
            colour,
            speed: speed.get(s),
            error: s.error.wrong_pixels_percent.mean,
        })
        .collect();
    if points.is_empty() {
        return Ok(None);
    }
    let ideal = ideal.first().map(|(s, _)| speed.get(s));
    sheet(TITLE, 430, |area| draw(area, speed, &points, ideal)).map(Some)
}

fn draw(area: &Area<'_>, speed: Speed, points: &[Point], ideal: Option<f64>) -> Drawing {
    let edge = efficient_edge(points);
    let mut entries = vec![(
        "efficient edge: nothing measured is both faster and less wrong".to_owned(),
        INK,
        Swatch::Dashes,
    )];
    if ideal.is_some() {
        entries.push((
            "ideal: the limit of any culling".to_owned(),
            FAINT,
            Swatch::Line,
        ));
    }
    let area = &legend(area, &entries)?;
    let fastest = points
        .iter()
        .map(|p| p.speed)
        .chain(ideal)
        .fold(0.0, f64::max);
    let x = Axis::even(0.0..fastest.max(f64::MIN_POSITIVE) * 1.08, 9, |v| {
        speed.word(v)
    });
    let y = Axis::errors(points.iter().map(|p| p.error));
    let frame = Frame {
        x: x.clone(),
        y: y.clone(),
        x_means: speed.means(),
        y_means: "wrong pixels, mean (%)",
        y_room: 76,
    };
    let chart = frame.draw(area)?;
    let on = |speed: f64, error: f64| chart.backend_coord(&(x.place(speed), y.place(error)));
    let at = |x_at: f64, y_at: f64| chart.backend_coord(&(x_at, y_at));
    let (left, bottom) = at(x.ends().start, y.ends().start);
    let (right, top) = at(x.ends().end, y.ends().end);
    // The sheet's own coordinates from here on.
    let area = &area.strip_coord_spec();
    let base = area.get_base_pixel();
    let on = |speed, error| {
        let (x, y) = on(speed, error);
        (x - base.0, y - base.1)
    };
    let (left, right, top, bottom) = (left - base.0, right - base.0, top - base.1, bottom - base.1);
    let zero = at(x.ends().start, y.break_above_zero()).1 - base.1;
    area.draw(&dashes([(left, zero), (right, zero)], FAINT))?;
    let every_right = letters(LETTER - 2, &FAINT).pos(Pos::new(HPos::Left, VPos::Center));
    let middle = zero + LETTER * UNIT * 2 / 3;
    area.draw(&Text::new(
        EVERY_RIGHT,
        (left + 5 * UNIT, middle),
        every_right,
    ))?;
    let mut obstacles = vec![[
        left,
        zero,
        left + 5 * UNIT + text_width(EVERY_RIGHT, LETTER - 2),
        zero + LETTER * UNIT * 4 / 3,
    ]];
    if let Some(ideal) = ideal {
        let (x, _) = on(ideal, 0.0);
        obstacles.push([x - 2 * UNIT, top, x + 2 * UNIT, bottom]);
        area.draw(&PathElement::new(
            [(x, top), (x, bottom)],
            FAINT.stroke_width(2 * UNIT as u32),
        ))?;
    }
    for (from, to) in edge.iter().zip(edge.iter().skip(1)) {
        let ((x0, y0), (x1, y1)) = (on(from.speed, from.error), on(to.speed, to.error));
        // A step: what lies to the right of it or below is not reached.
        area.draw(&dashes([(x0, y0), (x0, y1), (x1, y1)], INK))?;
    }
    let places: Vec<((i32, i32), i32)> = points
        .iter()
        .map(|p| (on(p.speed, p.error), text_width(&p.name, LETTER)))
        .collect();
    let labels = labels::place(
        &places,
        (LETTER + 4) * UNIT,
        RADIUS * UNIT,
        [left, top, right, bottom],
        &obstacles,
    );
    for ((point, (at, width)), label) in points.iter().zip(&places).zip(&labels) {
        if label.far {
            let end = leader_end(*at, *width, label);
            area.draw(&PathElement::new(
                [*at, end],
                FAINT.stroke_width(UNIT as u32),
            ))?;
        }
        area.draw(&Circle::new(*at, RADIUS * UNIT, point.colour.filled()))?;
    }
    for ((point, (at, width)), label) in points.iter().zip(&places).zip(&labels) {
        // Anchored on the side of its point, since the width is but a guess.
        let (x, anchor) = match (label.left > at.0, label.left + width < at.0) {
            (true, _) => (label.left, HPos::Left),
            (_, true) => (label.left + width, HPos::Right),
            _ => (label.left + width / 2, HPos::Center),
        };
        let style = letters(LETTER, &INK).pos(Pos::new(anchor, VPos::Center));
        area.draw(&Text::new(point.name.as_str(), (x, label.middle), style))?;
    }
    Ok(())
}

/// The end of a leader: the nearest of the label's left, middle and right.
fn leader_end(at: (i32, i32), width: i32, label: &Place) -> (i32, i32) {
    (at.0.clamp(label.left, label.left + width), label.middle)
}

/// The strategies than which none is both faster and less wrong, the most right first.
fn efficient_edge(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().collect();
    sorted.sort_by(|a, b| {
        a.error
            .total_cmp(&b.error)
            .then(b.speed.total_cmp(&a.speed))
    });
    let mut fastest = f64::NEG_INFINITY;
    sorted.retain(|p| {
        let extends = p.speed > fastest;
        fastest = fastest.max(p.speed);
        extends
    });
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_holds_what_nothing_beats_on_both_counts() {
        let point = |name: &str, speed, error| Point {
            name: name.to_owned(),
            colour: INK,
            speed,
            error,
        };
        let points = [
            point("fast and wrong", 4.0, 1.0),
            point("slow and right", 1.0, 0.0),
            point("beaten", 2.0, 0.5),
            point("better", 3.0, 0.1),
            point("slower and as right", 0.5, 0.0),
        ];
        let edge: Vec<&str> = efficient_edge(&points)
            .iter()
            .map(|p| p.name.as_str())
            .collect();
        assert_eq!(edge, ["slow and right", "better", "fast and wrong"]);
    }
}
