//! The parts that all plots share: the SVG sheet, colours, text, axes and legend.

use antumbra_cull::Role;
use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use crate::MeasureError;
use crate::format;
use crate::report::{Report, StrategyReport};

/// Units of the sheet for each CSS pixel at full size. Plotters rounds to whole units; this gives half pixels.
pub(super) const UNIT: i32 = 2;
/// The sheet's width in CSS pixels at full size.
const WIDTH: i32 = 920;
/// Height of the text in CSS pixels.
const LETTER: i32 = 14;

// Placeholder colours, which `sheet` replaces by CSS. No palette has them.
pub(super) const INK: RGBColor = RGBColor(1, 2, 3);
pub(super) const FAINT: RGBColor = RGBColor(4, 5, 6);
pub(super) const GRID: RGBColor = RGBColor(7, 8, 9);
const INKS: [Ink; 3] = [
    Ink {
        placeholder: "#010203",
        css: "currentColor",
        on_white: "#1c2027",
    },
    Ink {
        placeholder: "#040506",
        css: "var(--faint, #777)",
        on_white: "#777",
    },
    Ink {
        placeholder: "#070809",
        css: "var(--grid, #ddd)",
        on_white: "#ddd",
    },
];

/// A colour that depends on where the plot is shown.
struct Ink {
    placeholder: &'static str,
    /// The colour in a page.
    css: &'static str,
    /// The colour in a file of its own.
    on_white: &'static str,
}

/// Colours that are visible on white and on black and distinguishable with most kinds of colour blindness.
pub(super) const PALETTE: [RGBColor; 9] = [
    RGBColor(47, 126, 237),
    RGBColor(240, 120, 20),
    RGBColor(22, 160, 90),
    RGBColor(168, 85, 220),
    RGBColor(225, 60, 80),
    RGBColor(20, 165, 180),
    RGBColor(200, 150, 10),
    RGBColor(225, 80, 170),
    RGBColor(140, 110, 80),
];

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;
pub(super) type Drawing = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Draws a plot on a sheet of `height` CSS pixels and returns its SVG text.
pub(super) fn sheet(
    title: &'static str,
    height: i32,
    draw: impl FnOnce(&Area<'_>) -> Drawing,
) -> Result<String, MeasureError> {
    let mut svg = String::new();
    let size = ((WIDTH * UNIT) as u32, (height * UNIT) as u32);
    let drawn = {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        draw(&area).and_then(|()| area.present())
    };
    drawn.map_err(|e| MeasureError::Plot {
        plot: title,
        reason: e.to_string(),
    })?;
    for ink in INKS {
        svg = svg.replace(ink.placeholder, ink.css);
    }
    // Adds a title for screen readers, and sets width and height in CSS pixels.
    let (width, height) = (WIDTH * UNIT, height * UNIT);
    let head = format!("<svg width=\"{width}\" height=\"{height}\"");
    let css = format!(
        "<svg role=\"img\" aria-label=\"{title}\" width=\"{}\" height=\"{}\"",
        width / UNIT,
        height / UNIT
    );
    Ok(svg.replacen(&head, &css, 1))
}

/// The plot for a file of its own: on a white background, with fixed colours.
pub fn on_paper(svg: &str) -> String {
    const PAPER: &str = "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>";
    let mut svg = svg.to_owned();
    for ink in INKS {
        svg = svg.replace(ink.css, ink.on_white);
    }
    match svg.find('>') {
        Some(head) => {
            svg.insert_str(head + 1, PAPER);
            svg
        }
        None => svg,
    }
}

/// The frame of a chart below the legend: axes with descriptions, grid and ticks.
pub(super) struct Frame<'a> {
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) x_means: &'a str,
    pub(super) y_means: &'a str,
    /// Width of the y axis's labels in CSS pixels.
    pub(super) y_room: i32,
}

impl Frame<'_> {
    pub(super) fn draw<'c, 'b>(
        self,
        area: &Area<'b>,
    ) -> Result<Chart<'c, 'b>, DrawingAreaErrorKind<std::io::Error>> {
        let mut chart = ChartBuilder::on(area)
            .margin_right(14 * UNIT)
            .margin_top(8 * UNIT)
            .x_label_area_size(46 * UNIT)
            .y_label_area_size(self.y_room * UNIT)
            .build_cartesian_2d(self.x, self.y)?;
        chart
            .configure_mesh()
            .axis_style(FAINT.stroke_width(UNIT as u32))
            .bold_line_style(GRID.stroke_width(UNIT as u32))
            .light_line_style(TRANSPARENT)
            .set_all_tick_mark_size(4 * UNIT)
            .label_style(letters(LETTER - 1, &INK))
            .axis_desc_style(letters(LETTER, &INK))
            .x_desc(self.x_means)
            .y_desc(self.y_means)
            .draw()?;
        Ok(chart)
    }
}

/// An entry of a legend.
pub(super) struct LegendEntry {
    pub(super) words: String,
    pub(super) colour: RGBColor,
    pub(super) swatch: Swatch,
}

impl LegendEntry {
    pub(super) fn new(words: impl Into<String>, colour: RGBColor, swatch: Swatch) -> Self {
        Self {
            words: words.into(),
            colour,
            swatch,
        }
    }
}

/// The symbol of a legend entry.
#[derive(Clone, Copy)]
pub(super) enum Swatch {
    Line,
    /// A vertical line.
    Upright,
    /// A horizontal error bar.
    Bar,
    /// An upward error bar.
    Rise,
    Box,
    Dashes,
    Mark(Mark),
}

/// The symbol of a point.
#[derive(Clone, Copy)]
pub(super) enum Mark {
    Dot(RGBColor),
    /// A circle.
    Ring(RGBColor),
    /// A dot in a circle.
    Target(RGBColor),
}

/// Draws a point.
pub(super) fn mark(area: &Area<'_>, at: (i32, i32), radius: i32, mark: Mark) -> Drawing {
    let ring = |radius, colour: RGBColor| Circle::new(at, radius, colour.stroke_width(UNIT as u32));
    match mark {
        Mark::Dot(colour) => area.draw(&Circle::new(at, radius, colour.filled())),
        Mark::Ring(colour) => area.draw(&ring(radius - UNIT / 2, colour)),
        Mark::Target(colour) => {
            area.draw(&Circle::new(at, radius, colour.filled()))?;
            area.draw(&ring(radius + 4 * UNIT, colour))
        }
    }
}

/// Draws a legend at the top, in as many rows as needed, and returns the area below it.
pub(super) fn legend<'a>(
    area: &Area<'a>,
    entries: &[LegendEntry],
) -> Result<Area<'a>, DrawingAreaErrorKind<std::io::Error>> {
    let (row, edge) = (22 * UNIT, 14 * UNIT);
    let width = area.dim_in_pixel().0 as i32;
    let (mut x, mut y) = (edge, 4 * UNIT);
    for LegendEntry {
        words,
        colour,
        swatch,
    } in entries
    {
        let wide = 28 * UNIT + text_width(words, LETTER) + 18 * UNIT;
        if x > edge && x + wide > width {
            (x, y) = (edge, y + row);
        }
        let (middle, right) = (y + row / 2, x + 22 * UNIT);
        let line = [(x, middle), (right, middle)];
        match swatch {
            Swatch::Line => area.draw(&PathElement::new(
                line,
                colour.stroke_width(3 * UNIT as u32),
            ))?,
            Swatch::Box => {
                let corners = [
                    (x + 6 * UNIT, middle - 7 * UNIT),
                    (x + 20 * UNIT, middle + 7 * UNIT),
                ];
                area.draw(&Rectangle::new(corners, colour.filled()))?;
            }
            Swatch::Dashes => area.draw(&dashes(line, *colour))?,
            Swatch::Upright => {
                let (x, half) = (x + 13 * UNIT, 8 * UNIT);
                let line = [(x, middle - half), (x, middle + half)];
                area.draw(&PathElement::new(
                    line,
                    colour.stroke_width(2 * UNIT as u32),
                ))?;
            }
            Swatch::Bar => {
                for end in [x, right] {
                    let cap = [(end, middle - 4 * UNIT), (end, middle + 4 * UNIT)];
                    area.draw(&PathElement::new(cap, colour.stroke_width(UNIT as u32)))?;
                }
                area.draw(&PathElement::new(line, colour.stroke_width(UNIT as u32)))?;
            }
            Swatch::Rise => {
                let (x, half) = (x + 13 * UNIT, 8 * UNIT);
                let rise = [(x, middle + half), (x, middle - half)];
                let cap = [(x - 4 * UNIT, middle - half), (x + 4 * UNIT, middle - half)];
                for line in [rise, cap] {
                    area.draw(&PathElement::new(line, colour.stroke_width(UNIT as u32)))?;
                }
            }
            Swatch::Mark(it) => mark(area, (x + 13 * UNIT, middle), 5 * UNIT, *it)?,
        }
        let style = letters(LETTER, &INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(words.as_str(), (x + 28 * UNIT, middle), style))?;
        x += wide;
    }
    let (_, below) = area.split_vertically(y + row + 2 * UNIT);
    Ok(below)
}

/// A dashed line between points of the sheet.
pub(super) fn dashes<const N: usize>(
    points: [(i32, i32); N],
    colour: RGBColor,
) -> DashedPathElement<std::array::IntoIter<(i32, i32), N>, i32> {
    DashedPathElement::new(points, 5 * UNIT, 4 * UNIT, colour.stroke_width(UNIT as u32))
}

/// A text style with a height in CSS pixels.
pub(super) fn letters<'a>(height: i32, colour: &'a RGBColor) -> TextStyle<'a> {
    // The SVG backend divides sizes by 1.24.
    ("sans-serif", f64::from(height * UNIT) * 1.24)
        .into_font()
        .color(colour)
}

/// An estimate of a text's width in units of the sheet, rather too wide, since the font is not known.
pub(super) fn text_width(text: &str, height: i32) -> i32 {
    let wide = unicode_width::UnicodeWidthStr::width(text) as f64;
    (wide * 0.58 * f64::from(height * UNIT)).ceil() as i32
}

/// A strategy's name on a plot. It is cut later for a sweep, where the end of the name tells settings apart.
pub(super) fn name(report: &Report, strategy: &StrategyReport) -> String {
    let letters = if report.sweep.is_some() { 48 } else { 30 };
    format::short(report.title_of(strategy), letters)
}

/// A strategy with its colour.
pub(super) struct ColouredStrategy<'a> {
    pub(super) strategy: &'a StrategyReport,
    pub(super) colour: RGBColor,
}

/// All strategies with their colours, which are the same on all plots of a report. Yardsticks are grey.
pub(super) fn coloured(report: &Report) -> Vec<ColouredStrategy<'_>> {
    let mut colours = PALETTE.iter().cycle();
    let colour = |s: &StrategyReport| match s.role() {
        Role::Everything => RGBColor(150, 155, 165),
        Role::Frustum => RGBColor(105, 112, 125),
        Role::Ideal => RGBColor(120, 150, 60),
        Role::Contender => colours.next().copied().unwrap_or(INK),
    };
    let mut colour = colour;
    let strategies = report.strategies.iter();
    strategies
        .map(|strategy| ColouredStrategy {
            strategy,
            colour: colour(strategy),
        })
        .collect()
}
