//! Draws speed against error: points with their names, the edge that joins some of them, and the
//! lines that none may cross.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::entry;
use super::speed::Speed;
use crate::MeasureError;
use crate::plots::axis::Axis;
use crate::plots::canvas::{
    self, Area, Drawing, FAINT, Frame, INK, Mark, Swatch, UNIT, dashes, legend, letters, text_width,
};
use crate::plots::labels::{self, Box4, Place};

const TITLE: &str = "Speed against error";
const EVERY_RIGHT: &str = "every pixel right";
const LETTER: i32 = 14;
const RADIUS: i32 = 6;
/// What is not allowed.
const LIMIT: RGBColor = RGBColor(225, 60, 80);

/// All that the plot shows.
pub(super) struct Picture {
    /// Of the sheet, CSS pixels.
    pub(super) height: i32,
    pub(super) speed: Speed,
    /// The axis of speeds.
    pub(super) x: Axis,
    /// Those whose names matter most first.
    pub(super) points: Vec<Point>,
    /// Speeds and errors of the efficient edge, the most right first.
    pub(super) edge: Vec<(f64, f64)>,
    /// Whether the edge is what the plot is about, and no guide to the eye.
    pub(super) solid_edge: bool,
    /// The speed of `ideal`.
    pub(super) ideal: Option<f64>,
    pub(super) limits: Vec<Limit>,
    pub(super) legend: Vec<(String, RGBColor, Swatch)>,
}

/// A strategy, or a setting of one.
pub(super) struct Point {
    /// Its name; empty for a point without.
    name: String,
    pub(super) mark: Mark,
    pub(super) speed: f64,
    pub(super) error: f64,
    /// A factor by which noise may have moved its speed to either side.
    blur: Option<f64>,
    /// The error of its worst frame.
    pub(super) worst: Option<f64>,
}

/// A budget.
pub(super) struct Limit {
    pub(super) error: f64,
    pub(super) words: String,
}

impl Point {
    pub(super) fn new(name: String, mark: Mark, (speed, error): (f64, f64)) -> Self {
        Self {
            name,
            mark,
            speed,
            error,
            blur: None,
            worst: None,
        }
    }

    pub(super) fn with_bars(self, blur: f64, worst: f64) -> Self {
        Self {
            blur: Some(blur),
            worst: Some(worst),
            ..self
        }
    }

    pub(super) fn place(&self) -> (f64, f64) {
        (self.speed, self.error)
    }
}

/// The legend's entry for the line of `ideal`.
pub(super) fn ideal(words: &str) -> (String, RGBColor, Swatch) {
    entry(words, FAINT, Swatch::Upright)
}

pub(super) fn sheet(picture: &Picture) -> Result<String, MeasureError> {
    canvas::sheet(TITLE, picture.height, |area| draw(area, picture))
}

/// Where on the sheet a speed and an error are.
struct Ground<On> {
    on: On,
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
    /// The line between no error and some.
    zero: i32,
}

fn draw(area: &Area<'_>, picture: &Picture) -> Drawing {
    let area = &legend(area, &picture.legend)?;
    let x = &picture.x;
    let points = picture.points.iter();
    let errors = points
        .flat_map(|p| [Some(p.error), p.worst].into_iter().flatten())
        .chain(picture.limits.iter().map(|limit| limit.error));
    let y = Axis::errors(errors);
    let frame = Frame {
        x: x.clone(),
        y: y.clone(),
        x_means: picture.speed.means(),
        y_means: "wrong pixels, mean (%)",
        y_room: 76,
    };
    let chart = frame.draw(area)?;
    // The sheet's own coordinates from here on.
    let area = &area.strip_coord_spec();
    let base = area.get_base_pixel();
    let at = |x_at: f64, y_at: f64| {
        let (x, y) = chart.backend_coord(&(x_at, y_at));
        (x - base.0, y - base.1)
    };
    let (left, bottom) = at(x.ends().start, y.ends().start);
    let (right, top) = at(x.ends().end, y.ends().end);
    let ground = Ground {
        on: |(speed, error)| at(x.place(speed), y.place(error)),
        left,
        right,
        top,
        bottom,
        zero: at(x.ends().start, y.break_above_zero()).1,
    };
    let mut taken = ground.lines(area, picture)?;
    taken.extend(ground.edge(area, picture)?);
    taken.extend(ground.bars(area, picture)?);
    ground.points(area, picture, &taken)
}

/// Room that is taken on the sheet.
type Taken = Result<Vec<Box4>, DrawingAreaErrorKind<std::io::Error>>;

impl<On: Fn((f64, f64)) -> (i32, i32)> Ground<On> {
    /// The lines that mean something by where they are.
    fn lines(&self, area: &Area<'_>, picture: &Picture) -> Taken {
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
        if let Some(ideal) = picture.ideal {
            let (x, _) = (self.on)((ideal, 0.0));
            taken.push([x - 2 * UNIT, self.top, x + 2 * UNIT, self.bottom]);
            area.draw(&PathElement::new(
                [(x, self.top), (x, self.bottom)],
                FAINT.stroke_width(2 * UNIT as u32),
            ))?;
        }
        for limit in &picture.limits {
            let (_, y) = (self.on)((0.0, limit.error));
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

    /// The edge in steps: what lies to the right of it or below is not reached.
    fn edge(&self, area: &Area<'_>, picture: &Picture) -> Taken {
        let mut taken = Vec::new();
        let edge = &picture.edge;
        for (from, to) in edge.iter().zip(edge.iter().skip(1)) {
            let ((x0, y0), (x1, y1)) = ((self.on)(*from), (self.on)(*to));
            let line = [(x0, y0), (x0, y1), (x1, y1)];
            if picture.solid_edge {
                area.draw(&PathElement::new(line, INK.stroke_width(UNIT as u32)))?;
            } else {
                area.draw(&dashes(line, INK))?;
            }
            taken.push([x0 - UNIT, y1, x0 + UNIT, y0]);
            taken.push([x0, y1 - UNIT, x1, y1 + UNIT]);
        }
        Ok(taken)
    }

    /// How far the noise may have moved each point, and up to where its worst frame is.
    fn bars(&self, area: &Area<'_>, picture: &Picture) -> Taken {
        let mut taken = Vec::new();
        let mut bar = |ends: [(i32, i32); 2]| {
            let [(x0, y0), (x1, y1)] = ends;
            taken.push([x0 - UNIT, y1 - UNIT, x1 + UNIT, y0 + UNIT]);
            area.draw(&PathElement::new(ends, FAINT.stroke_width(UNIT as u32)))
        };
        for point in &picture.points {
            let cap = 4 * UNIT;
            if let Some(blur) = point.blur {
                let (x0, y) = (self.on)((point.speed / blur, point.error));
                let (x1, _) = (self.on)((point.speed * blur, point.error));
                bar([(x0, y), (x1, y)])?;
                bar([(x0, y + cap), (x0, y - cap)])?;
                bar([(x1, y + cap), (x1, y - cap)])?;
            }
            if let Some(worst) = point.worst.filter(|worst| *worst > point.error) {
                let (x, y0) = (self.on)(point.place());
                let (_, y1) = (self.on)((point.speed, worst));
                bar([(x, y0), (x, y1)])?;
                bar([(x - cap, y1), (x + cap, y1)])?;
            }
        }
        Ok(taken)
    }

    /// The points and their names, beside whatever room is taken.
    fn points(&self, area: &Area<'_>, picture: &Picture, taken: &[Box4]) -> Drawing {
        let named = |p: &&Point| !p.name.is_empty();
        let points: Vec<&Point> = picture.points.iter().filter(named).collect();
        let mut taken = taken.to_vec();
        for point in picture.points.iter().filter(|p| p.name.is_empty()) {
            let ((x, y), r) = ((self.on)(point.place()), RADIUS * UNIT);
            taken.push([x - r, y - r, x + r, y + r]);
        }
        let places: Vec<((i32, i32), i32)> = points
            .iter()
            .map(|p| ((self.on)(p.place()), text_width(&p.name, LETTER)))
            .collect();
        let labels = labels::place(
            &places,
            (LETTER + 4) * UNIT,
            RADIUS * UNIT,
            [self.left, self.top, self.right, self.bottom],
            &taken,
        );
        for ((at, width), label) in places.iter().zip(&labels).filter(|(_, label)| label.far) {
            let end = leader_end(*at, *width, label);
            area.draw(&PathElement::new(
                [*at, end],
                FAINT.stroke_width(UNIT as u32),
            ))?;
        }
        for point in &picture.points {
            canvas::mark(area, (self.on)(point.place()), RADIUS * UNIT, point.mark)?;
        }
        for ((point, (at, width)), label) in points.iter().zip(&places).zip(&labels) {
            // Anchored on the side of its point, since the width is but a guess.
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

/// The end of a leader: the nearest of the label's left, middle and right.
fn leader_end(at: (i32, i32), width: i32, label: &Place) -> (i32, i32) {
    (at.0.clamp(label.left, label.left + width), label.middle)
}
