//! What the plot of a sweep shows: its settings alone, close enough to tell them apart.

use plotters::prelude::RGBColor;

use super::draw::{Limit, Picture, Point, ideal};
use super::entry;
use super::speed::Speed;
use crate::format;
use crate::plots::axis::Axis;
use crate::plots::canvas::{FAINT, INK, Mark, PALETTE, Swatch};
use crate::report::{Aggregate, ErrorMeasure, LimitChoices, Report, StrategyReport, Sweep};
use crate::trade_off::TimeBase;

/// With no more settings than this, those off the edge have their names, too.
const FEW: usize = 12;
/// `ideal` is shown where it is no more than this many times as fast as the fastest setting, or
/// further away by half of what the settings themselves are apart.
const NEAR: f64 = 1.05;
/// With the fastest this many times as fast as the slowest, the axis is logarithmic.
const WIDE: f64 = 2.5;
/// Free space on both sides, as a part of the spread, and the least spread as a part of the speed.
const MARGIN: f64 = 0.12;
const LEAST_SPREAD: f64 = 0.02;
/// Faster, slower and noisier than this nothing is drawn, so that no file can ask for endless axes.
const SPEED_MOST: f64 = 1e9;
const BLUR_MOST: f64 = 1e3;

/// The plot of a report's sweep; `None` where no setting was measured.
pub(super) fn picture(report: &Report, sweep: &Sweep) -> Option<Picture> {
    let speed = Speed(TimeBase::of(report));
    let settings: Vec<&StrategyReport> = report
        .strategies
        .iter()
        .filter(|s| !s.is_yardstick())
        .collect();
    // Two bars of this factor overlap just where the ratio of their speeds is within the noise.
    let blur = report.noise.least_ratio().sqrt().min(BLUR_MOST);
    let drawn = |s: &StrategyReport| speed.get(s).clamp(1.0 / SPEED_MOST, SPEED_MOST);
    let on_edge = |s: &&StrategyReport| sweep.edge.iter().any(|on| on == s.title());
    let mut points: Vec<Point> = settings
        .iter()
        .map(|s| {
            let (edge, chosen) = (on_edge(s), chosen(sweep, s));
            let (colour, own) = strategy(sweep, s);
            let wrong = s.error.wrong_pixels_percent;
            let mut words = String::new();
            if edge || chosen.is_some() || settings.len() <= FEW {
                words = format::short(own, 48) + chosen.as_deref().unwrap_or_default();
            }
            // Names leave to colours which strategy it is, where there are several.
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
            let point = Point::new(words, mark, (drawn(s), wrong.mean));
            if edge || chosen.is_some() {
                point.with_bars(blur, wrong.max)
            } else {
                point
            }
        })
        .collect();
    let slowest = points.iter().map(|p| p.speed / blur);
    let fastest = points.iter().map(|p| p.speed * blur);
    let (low, high) = (
        slowest.reduce(f64::min)?,
        fastest.fold(f64::MIN_POSITIVE, f64::max),
    );
    let limit = report.strategy("ideal").map(drawn);
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
    let mut edge: Vec<(f64, f64)> = edge.map(|(_, point)| point.place()).collect();
    edge.sort_by(|a, b| a.1.total_cmp(&b.1));
    points.sort_by_key(|point| match point.mark {
        Mark::Target(_) => 0,
        Mark::Dot(_) => 1,
        Mark::Ring(_) => 2,
    });
    Some(Picture {
        height: 480,
        speed,
        x,
        limits: limits(sweep),
        legend: legend(
            report,
            sweep,
            &points,
            limit.map(|at| (at, shown.is_some())),
        ),
        points,
        edge,
        solid_edge: true,
        ideal: shown,
    })
}

/// Says which budget of wrong pixels a setting is the choice of, if any.
fn chosen(sweep: &Sweep, setting: &StrategyReport) -> Option<String> {
    let choices = sweep.budgets.iter().flat_map(|budget| {
        let choices = budget.choices.iter().filter(|choice| choice.within);
        choices.map(move |choice| (budget, choice))
    });
    let its = choices.filter(|(_, choice)| choice.setting == setting.title());
    let its: Vec<String> = its
        .map(|(budget, choice)| short(budget, choice.over))
        .collect();
    (!its.is_empty()).then(|| format!(" (chosen: {})", its.join(", ")))
}

/// "0.05 % mean", "3 false culls".
fn short(budget: &LimitChoices, over: Aggregate) -> String {
    let over = match over {
        Aggregate::Mean => " mean",
        Aggregate::Max => " worst",
        Aggregate::Sum => "",
    };
    match budget.measure {
        ErrorMeasure::WrongPixelsPercent => format!("{} %{over}", format::percent(budget.limit)),
        ErrorMeasure::FalseCulls => format::plural(budget.limit as u64, "false cull"),
        ErrorMeasure::Flip => format!("FLIP {}{over}", format::flip(budget.limit)),
    }
}

/// The budgets that have a place on an axis of wrong pixels.
fn limits(sweep: &Sweep) -> Vec<Limit> {
    let budgets = sweep.budgets.iter();
    let budgets =
        budgets.filter(|b| b.measure == ErrorMeasure::WrongPixelsPercent && b.limit > 0.0);
    budgets
        .map(|budget| Limit {
            error: budget.limit,
            words: format!("budget {} %", format::percent(budget.limit)),
        })
        .collect()
}

fn legend(
    report: &Report,
    sweep: &Sweep,
    points: &[Point],
    limit: Option<(f64, bool)>,
) -> Vec<(String, RGBColor, Swatch)> {
    let mut entries = vec![entry(
        "efficient edge: no setting is both faster, beyond the noise, and less wrong",
        INK,
        Swatch::Line,
    )];
    if let [_, _, ..] = sweep.strategies.as_slice() {
        let strategies = sweep.strategies.iter().zip(PALETTE.iter().cycle());
        entries.extend(strategies.map(|(s, colour)| {
            entry(
                format::short(s, 30),
                *colour,
                Swatch::Mark(Mark::Dot(*colour)),
            )
        }));
    }
    if points.iter().any(|p| matches!(p.mark, Mark::Ring(_))) {
        entries.push(entry(
            "beaten, or faster within the noise alone",
            FAINT,
            Swatch::Mark(Mark::Ring(FAINT)),
        ));
    }
    if points.iter().any(|p| matches!(p.mark, Mark::Target(_))) {
        entries.push(entry(
            "chosen by a budget",
            INK,
            Swatch::Mark(Mark::Target(INK)),
        ));
    }
    let noise = (report.noise.least_ratio() - 1.0) * 100.0;
    entries.push(entry(
        format!(
            "bar: noise of {} %; speeds whose bars overlap cannot be told apart",
            format::percent(noise)
        ),
        FAINT,
        Swatch::Bar,
    ));
    if points
        .iter()
        .any(|p| p.worst.is_some_and(|worst| worst > p.error))
    {
        entries.push(entry("up to its worst frame", FAINT, Swatch::Rise));
    }
    match limit {
        Some((_, true)) => entries.push(ideal("ideal: the limit of any culling")),
        Some((at, false)) => entries.push(ideal(&format!(
            "ideal, the limit of any culling, is further {}, at {}",
            if points.iter().any(|p| p.speed < at) {
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

/// The colour of a setting's strategy, and what of the title is its own: where colours tell strategies
/// apart, names need not.
fn strategy<'a>(sweep: &Sweep, setting: &'a StrategyReport) -> (RGBColor, &'a str) {
    let title = setting.title();
    let own = |spec: &String| match title.strip_prefix(spec.as_str())? {
        "" => Some(title),
        rest => rest.strip_prefix(' '),
    };
    let colours = sweep.strategies.iter().zip(PALETTE.iter().cycle());
    let mut its = colours.filter_map(|(spec, colour)| Some((*colour, own(spec)?)));
    its.next().unwrap_or((INK, title))
}
