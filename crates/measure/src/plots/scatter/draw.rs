//! Draws speed against error: named points, the line of the Pareto front, and the lines of limits.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::speed::Speed;
use crate::MeasureError;
use crate::plots::axis::Axis;
use crate::plots::canvas::{
    self, Area, Drawing, FAINT, Frame, INK, LegendEntry, Mark, Swatch, UNIT, dashes, legend,
    letters, text_width,
};
use crate::plots::labels::{self, Box4, Labelled};
use crate::report::ErrorBasis;

const TITLE: &str = "Speed against error";
const EVERY_RIGHT: &str = "every pixel right";
const LETTER: i32 = 14;
const RADIUS: i32 = 6;
/// The colour of limits.
const LIMIT: RGBColor = RGBColor(225, 60, 80);

/// The contents of the plot.
pub(super) struct Plot {
    /// Height in CSS pixels.
    pub(super) height: i32,
    pub(super) speed: Speed,
    /// The axis of speeds.
    pub(super) x: Axis,
    /// Those with the most important names first.
    pub(super) points: Vec<Point>,
    /// The Pareto front, the most accurate point first.
    pub(super) edge: Vec<Place>,
    pub(super) edge_line: EdgeLine,
    /// The speed of `ideal`.
    pub(super) ideal: Option<f64>,
    /// What the errors are shares of.
    pub(super) basis: ErrorBasis,
    pub(super) limits: Vec<Limit>,
    pub(super) legend: Vec<LegendEntry>,
}

/// How the line of the Pareto front is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum EdgeLine {
    Solid,
    Dashed,
}

/// A position in the plot.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) speed: f64,
    pub(super) error: f64,
}

/// A strategy or a setting.
pub(super) struct Point {
    /// Its name; empty for a point without a label.
    name: String,
    pub(super) mark: Mark,
    pub(super) place: Place,
    /// The factor of its speed's error bar, to either side.
    blur: Option<f64>,
    /// The error of its worst frame.
    pub(super) worst: Option<f64>,
}

/// A limit of wrong pixels.
pub(super) struct Limit {
    pub(super) error: f64,
    pub(super) words: String,
}

impl Point {
    pub(super) fn new(name: String, mark: Mark, place: Place) -> Self {
        Self {
            name,
            mark,
            place,
            blur: None,
            worst: None,
        }
    }

    /// The point with error bars.
    pub(super) fn with_bars(self, blur: f64, worst: f64) -> Self {
        Self {
            blur: Some(blur),
            worst: Some(worst),
            ..self
        }
    }
}

/// The legend's entry for the line of `ideal`.
pub(super) fn ideal(words: &str) -> LegendEntry {
    LegendEntry::new(words, FAINT, Swatch::Upright)
}

/// Draws the plot.
pub(super) fn sheet(plot: &Plot) -> Result<String, MeasureError> {
    canvas::sheet(TITLE, plot.height, |area| draw(area, plot))
}

/// The chart on the sheet.
struct Ground<On> {
    /// Maps a place to the sheet.
    on: On,
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
    /// The line between no error and some.
    zero: i32,
}

fn draw(area: &Area<'_>, plot: &Plot) -> Drawing {
    let area = &legend(area, &plot.legend)?;
    let x = &plot.x;
    let points = plot.points.iter();
    let errors = points
        .flat_map(|p| [Some(p.place.error), p.worst].into_iter().flatten())
        .chain(plot.limits.iter().map(|limit| limit.error));
    let y = Axis::errors(errors);
    let frame = Frame {
        x: x.clone(),
        y: y.clone(),
        x_means: plot.speed.means(),
        y_means: match plot.basis {
            ErrorBasis::Image => "wrong pixels, mean (%)",
            ErrorBasis::Owned => "wrong pixels of owned ones, mean (%)",
        },
        y_room: 76,
    };
    let chart = frame.draw(area)?;
    // From here on in the sheet's coordinates.
    let area = &area.strip_coord_spec();
    let base = area.get_base_pixel();
    let at = |x_at: f64, y_at: f64| {
        let (x, y) = chart.backend_coord(&(x_at, y_at));
        (x - base.0, y - base.1)
    };
    let (left, bottom) = at(x.ends().start, y.ends().start);
    let (right, top) = at(x.ends().end, y.ends().end);
    let ground = Ground {
        on: |place: Place| at(x.place(place.speed), y.place(place.error)),
        left,
        right,
        top,
        bottom,
        zero: at(x.ends().start, y.break_above_zero()).1,
    };
    let mut taken = ground.lines(area, plot)?;
    taken.extend(ground.edge(area, plot)?);
    taken.extend(ground.bars(area, plot)?);
    ground.points(area, plot, &taken)
}

/// Occupied areas of the sheet.
type Taken = Result<Vec<Box4>, DrawingAreaErrorKind<std::io::Error>>;

impl<On: Fn(Place) -> (i32, i32)> Ground<On> {
    fn at(&self, speed: f64, error: f64) -> (i32, i32) {
        (self.on)(Place { speed, error })
    }

    /// Draws the lines of 0, of `ideal` and of the limits.
    fn lines(&self, area: &Area<'_>, plot: &Plot) -> Taken {
        let (left, right, zero) = (self.left, self.right, self.zero);
        area.draw(&dashes([(left, zero), (right, zero)], FAINT))?;
        let every_right = letters(LETTER - 2, &FAINT).pos(Pos::new(HPos::Left, VPos::Center));
        let middle = zero + LETTER * UNIT * 2 / 3;
        area.draw(&Text::new(
            EVERY_RIGHT,
            (left + 5 * UNIT, middle),
            every_right,
        ))?;
        let mut taken = vec![[
            left,
            zero,
            left + 5 * UNIT + text_width(EVERY_RIGHT, LETTER - 2),
            zero + LETTER * UNIT * 4 / 3,
        ]];
        if let Some(ideal) = plot.ideal {
            let (x, _) = self.at(ideal, 0.0);
            taken.push([x - 2 * UNIT, self.top, x + 2 * UNIT, self.bottom]);
            area.draw(&PathElement::new(
                [(x, self.top), (x, self.bottom)],
                FAINT.stroke_width(2 * UNIT as u32),
            ))?;
        }
        for limit in &plot.limits {
            let (_, y) = self.at(0.0, limit.error);
            area.draw(&dashes([(left, y), (right, y)], LIMIT))?;
            let words = letters(LETTER - 2, &LIMIT).pos(Pos::new(HPos::Left, VPos::Bottom));
            let width = text_width(&limit.words, LETTER - 2);
            let from = left + 5 * UNIT;
            area.draw(&Text::new(
                limit.words.as_str(),
                (from, y - 2 * UNIT),
                words,
            ))?;
            taken.push([from, y - (LETTER + 2) * UNIT, from + width, y]);
        }
        Ok(taken)
    }

    /// Draws the Pareto front in steps. No point is to the right of it or below it.
    fn edge(&self, area: &Area<'_>, plot: &Plot) -> Taken {
        let mut taken = Vec::new();
        let edge = &plot.edge;
        for (from, to) in edge.iter().zip(edge.iter().skip(1)) {
            let ((x0, y0), (x1, y1)) = ((self.on)(*from), (self.on)(*to));
            let line = [(x0, y0), (x0, y1), (x1, y1)];
            if plot.edge_line == EdgeLine::Solid {
                area.draw(&PathElement::new(line, INK.stroke_width(UNIT as u32)))?;
            } else {
                area.draw(&dashes(line, INK))?;
            }
            taken.push([x0 - UNIT, y1, x0 + UNIT, y0]);
            taken.push([x0, y1 - UNIT, x1, y1 + UNIT]);
        }
        Ok(taken)
    }

    /// Draws error bars: horizontal ones for the noise, upward ones to the worst frame.
    fn bars(&self, area: &Area<'_>, plot: &Plot) -> Taken {
        let mut taken = Vec::new();
        let mut bar = |ends: [(i32, i32); 2]| {
            let [(x0, y0), (x1, y1)] = ends;
            taken.push([x0 - UNIT, y1 - UNIT, x1 + UNIT, y0 + UNIT]);
            area.draw(&PathElement::new(ends, FAINT.stroke_width(UNIT as u32)))
        };
        for point in &plot.points {
            let cap = 4 * UNIT;
            if let Some(blur) = point.blur {
                let (x0, y) = self.at(point.place.speed / blur, point.place.error);
                let (x1, _) = self.at(point.place.speed * blur, point.place.error);
                bar([(x0, y), (x1, y)])?;
                bar([(x0, y + cap), (x0, y - cap)])?;
                bar([(x1, y + cap), (x1, y - cap)])?;
            }
            if let Some(worst) = point.worst.filter(|worst| *worst > point.place.error) {
                let (x, y0) = (self.on)(point.place);
                let (_, y1) = self.at(point.place.speed, worst);
                bar([(x, y0), (x, y1)])?;
                bar([(x - cap, y1), (x + cap, y1)])?;
            }
        }
        Ok(taken)
    }

    /// Draws the points, and their names off the occupied areas.
    fn points(&self, area: &Area<'_>, plot: &Plot, taken: &[Box4]) -> Drawing {
        let named = |p: &&Point| !p.name.is_empty();
        let points: Vec<&Point> = plot.points.iter().filter(named).collect();
        let mut taken = taken.to_vec();
        for point in plot.points.iter().filter(|p| p.name.is_empty()) {
            let ((x, y), r) = ((self.on)(point.place), RADIUS * UNIT);
            taken.push([x - r, y - r, x + r, y + r]);
        }
        let places: Vec<Labelled> = points
            .iter()
            .map(|p| Labelled {
                at: (self.on)(p.place),
                width: text_width(&p.name, LETTER),
            })
            .collect();
        let labels = labels::place(
            &places,
            (LETTER + 4) * UNIT,
            RADIUS * UNIT,
            [self.left, self.top, self.right, self.bottom],
            &taken,
        );
        for (point, label) in places.iter().zip(&labels).filter(|(_, label)| label.far) {
            area.draw(&PathElement::new(
                [point.at, leader_end(*point, label)],
                FAINT.stroke_width(UNIT as u32),
            ))?;
        }
        for point in &plot.points {
            canvas::mark(area, (self.on)(point.place), RADIUS * UNIT, point.mark)?;
        }
        for ((point, Labelled { at, width }), label) in points.iter().zip(&places).zip(&labels) {
            // Anchored on the side of its point, since the width is an estimate.
            let (x, anchor) = match (label.left > at.0, label.left + width < at.0) {
                (true, _) => (label.left, HPos::Left),
                (_, true) => (label.left + width, HPos::Right),
                _ => (label.left + width / 2, HPos::Center),
            };
            let ink = if matches!(point.mark, Mark::Ring(_)) {
                &FAINT
            } else {
                &INK
            };
            let style = letters(LETTER, ink).pos(Pos::new(anchor, VPos::Center));
            area.draw(&Text::new(point.name.as_str(), (x, label.middle), style))?;
        }
        Ok(())
    }
}

/// The end of the line between a point and its label: the label's nearest position in x, and its vertical middle.
fn leader_end(point: Labelled, label: &labels::Place) -> (i32, i32) {
    let x = point.at.0.clamp(label.left, label.left + point.width);
    (x, label.middle)
}
