//! The contents of a sweep's plot: its settings, with the speed axis close around them.

use antumbra_cull::Role;
use plotters::prelude::RGBColor;

use super::draw::{EdgeLine, Limit, Place, Plot, Point, ideal};
use super::speed::Speed;
use crate::format;
use crate::plots::axis::Axis;
use crate::plots::canvas::{FAINT, INK, LegendEntry, Mark, PALETTE, Swatch};
use crate::report::{
    Aggregate, ErrorBasis, ErrorMeasure, LimitChoices, Report, StrategyReport, Sweep,
};
use crate::trade_off::TimeBase;

/// With at most so many settings, those off the Pareto front are named too.
const FEW: usize = 12;
/// `ideal` is shown where it is at most this many times as fast as the fastest setting, or at most half of the settings' own ratio away.
const NEAR: f64 = 1.05;
/// The axis is logarithmic where the fastest setting is this many times as fast as the slowest.
const WIDE: f64 = 2.5;
/// Free space on both sides, as a fraction of the range of speeds.
const MARGIN: f64 = 0.12;
/// The least range, as a fraction of the speed.
const LEAST_SPREAD: f64 = 0.02;
/// Bounds of speeds and error bars, so that no report can make the axis too long.
const MAX_SPEED: f64 = 1e9;
const MAX_BLUR: f64 = 1e3;

/// The plot of a report's sweep; `None` where no setting was measured.
pub(super) fn plot(report: &Report, sweep: &Sweep) -> Option<Plot> {
    let speed = Speed(TimeBase::of(report));
    let basis = report.error_basis();
    let settings: Vec<&StrategyReport> = report
        .strategies
        .iter()
        .filter(|s| !s.is_yardstick())
        .collect();
    // Two error bars of this factor overlap exactly where the ratio of their speeds is within the noise.
    let blur = report.noise.least_ratio().sqrt().min(MAX_BLUR);
    let drawn = |s: &StrategyReport| speed.get(s).clamp(1.0 / MAX_SPEED, MAX_SPEED);
    let on_edge = |s: &&StrategyReport| sweep.edge.iter().any(|on| on == s.title());
    let mut points: Vec<Point> = settings
        .iter()
        .map(|s| {
            let (edge, chosen) = (on_edge(s), chosen(sweep, s));
            let Swept { colour, own_title } = swept(sweep, s);
            let wrong = s.error.wrong(basis);
            let mut words = String::new();
            if edge || chosen.is_some() || settings.len() <= FEW {
                words = format::short(own_title, 48) + chosen.as_deref().unwrap_or_default();
            }
            // With several strategies, the colour tells which one it is.
            let beaten = match sweep.strategies.as_slice() {
                [_] => FAINT,
                _ => colour,
            };
            let mark = match (edge, chosen.is_some()) {
                (true, true) => Mark::Target(colour),
                (false, true) => Mark::Target(beaten),
                (true, false) => Mark::Dot(colour),
                (false, false) => Mark::Ring(beaten),
            };
            let place = Place {
                speed: drawn(s),
                error: wrong.mean,
            };
            let point = Point::new(words, mark, place);
            if edge || chosen.is_some() {
                point.with_bars(blur, wrong.max)
            } else {
                point
            }
        })
        .collect();
    let slowest = points.iter().map(|p| p.place.speed / blur);
    let fastest = points.iter().map(|p| p.place.speed * blur);
    let (low, high) = (
        slowest.reduce(f64::min)?,
        fastest.fold(f64::MIN_POSITIVE, f64::max),
    );
    let limit = report.yardstick(Role::Ideal).map(drawn);
    let shown = limit.filter(|at| (low..high * (high / low).sqrt().max(NEAR)).contains(at));
    let high = shown.map_or(high, |at| high.max(at));
    let spread = (high - low).max(high * LEAST_SPREAD);
    let x = if high > WIDE * low {
        Axis::times(low, high, |v| speed.word(v))
    } else {
        let ends = (low - spread * MARGIN).max(0.0)..high + spread * MARGIN;
        Axis::even(ends, 9, |v| speed.word(v))
    };
    let edge = settings.iter().zip(&points).filter(|(s, _)| on_edge(s));
    let mut edge: Vec<Place> = edge.map(|(_, point)| point.place).collect();
    edge.sort_by(|a, b| a.error.total_cmp(&b.error));
    points.sort_by_key(|point| match point.mark {
        Mark::Target(_) => 0,
        Mark::Dot(_) => 1,
        Mark::Ring(_) => 2,
    });
    let ideal_line = limit.map(|speed| match shown {
        Some(_) => IdealLine::Shown,
        None => IdealLine::OffPlot(speed),
    });
    Some(Plot {
        height: 480,
        speed,
        x,
        basis,
        limits: limits(sweep, basis),
        legend: legend(report, sweep, &points, ideal_line),
        points,
        edge,
        edge_line: EdgeLine::Solid,
        ideal: shown,
    })
}

/// Where the line of `ideal` is.
#[derive(Clone, Copy)]
enum IdealLine {
    Shown,
    /// Outside of the plot, at this speed.
    OffPlot(f64),
}

/// The limits that select a setting, as a suffix of its name; `None` where none does.
fn chosen(sweep: &Sweep, setting: &StrategyReport) -> Option<String> {
    let choices = sweep.budgets.iter().flat_map(|limit| {
        let choices = limit.choices.iter().filter(|choice| choice.within);
        choices.map(move |choice| (limit, choice))
    });
    let its = choices.filter(|(_, choice)| choice.setting == setting.title());
    let its: Vec<String> = its
        .map(|(limit, choice)| short(limit, choice.over))
        .collect();
    (!its.is_empty()).then(|| format!(" (chosen: {})", its.join(", ")))
}

/// A limit in short: "0.05 % mean", "3 false culls".
fn short(limit: &LimitChoices, over: Aggregate) -> String {
    let over = match over {
        Aggregate::Mean => " mean",
        Aggregate::Max => " worst",
        Aggregate::Sum => "",
    };
    match limit.measure {
        ErrorMeasure::WrongPixelsPercent | ErrorMeasure::WrongOfOwnedPercent => {
            format!("{} %{over}", format::percent(limit.limit))
        }
        ErrorMeasure::FalseCulls => format::plural(limit.limit as u64, "false cull"),
        ErrorMeasure::Flip => format!("FLIP {}{over}", format::flip(limit.limit)),
    }
}

/// The limits of the plotted share of wrong pixels that have a position on the logarithmic axis.
fn limits(sweep: &Sweep, basis: ErrorBasis) -> Vec<Limit> {
    let plotted = match basis {
        ErrorBasis::Image => ErrorMeasure::WrongPixelsPercent,
        ErrorBasis::Owned => ErrorMeasure::WrongOfOwnedPercent,
    };
    let of_pixels = |limit: &&LimitChoices| limit.measure == plotted && limit.limit > 0.0;
    let limits = sweep.budgets.iter().filter(of_pixels);
    limits
        .map(|limit| Limit {
            error: limit.limit,
            words: format!("limit {} %", format::percent(limit.limit)),
        })
        .collect()
}

fn legend(
    report: &Report,
    sweep: &Sweep,
    points: &[Point],
    ideal_line: Option<IdealLine>,
) -> Vec<LegendEntry> {
    let entry = |words: &str, colour, swatch| LegendEntry::new(words, colour, swatch);
    let mut entries = vec![entry(
        "efficient edge: no setting is both faster, beyond the noise, and less wrong",
        INK,
        Swatch::Line,
    )];
    if let [_, _, ..] = sweep.strategies.as_slice() {
        let strategies = sweep.strategies.iter().zip(PALETTE.iter().cycle());
        entries.extend(strategies.map(|(s, colour)| {
            let mark = Swatch::Mark(Mark::Dot(*colour));
            LegendEntry::new(format::short(s, 30), *colour, mark)
        }));
    }
    if points.iter().any(|p| matches!(p.mark, Mark::Ring(_))) {
        entries.push(entry(
            "dominated, or faster only within the noise",
            FAINT,
            Swatch::Mark(Mark::Ring(FAINT)),
        ));
    }
    if points.iter().any(|p| matches!(p.mark, Mark::Target(_))) {
        entries.push(entry(
            "chosen by a limit",
            INK,
            Swatch::Mark(Mark::Target(INK)),
        ));
    }
    let noise = (report.noise.least_ratio() - 1.0) * 100.0;
    entries.push(LegendEntry::new(
        format!(
            "bar: noise of {} %; speeds whose bars overlap cannot be told apart",
            format::percent(noise)
        ),
        FAINT,
        Swatch::Bar,
    ));
    if points
        .iter()
        .any(|p| p.worst.is_some_and(|worst| worst > p.place.error))
    {
        entries.push(entry("up to its worst frame", FAINT, Swatch::Rise));
    }
    match ideal_line {
        Some(IdealLine::Shown) => entries.push(ideal("ideal: the limit of any culling")),
        Some(IdealLine::OffPlot(at)) => entries.push(ideal(&format!(
            "ideal, the limit of any culling, is further {}, at {}",
            if points.iter().any(|p| p.place.speed < at) {
                "right"
            } else {
                "left"
            },
            match TimeBase::of(report) {
                TimeBase::Alone => format!("{} frames per second", format::ratio(at)),
                _ => format!("{}x", format::ratio(at)),
            }
        ))),
        None => {}
    }
    entries
}

/// A setting of a sweep in the plot.
struct Swept<'a> {
    /// The colour of its strategy.
    colour: RGBColor,
    /// Its title without the strategy, which the colour tells.
    own_title: &'a str,
}

fn swept<'a>(sweep: &Sweep, setting: &'a StrategyReport) -> Swept<'a> {
    let title = setting.title();
    let own = |spec: &String| match title.strip_prefix(spec.as_str())? {
        "" => Some(title),
        rest => rest.strip_prefix(' '),
    };
    let colours = sweep.strategies.iter().zip(PALETTE.iter().cycle());
    let mut its = colours.filter_map(|(spec, colour)| {
        Some(Swept {
            colour: *colour,
            own_title: own(spec)?,
        })
    });
    its.next().unwrap_or(Swept {
        colour: INK,
        own_title: title,
    })
}
