//! The plot of frame times along the path.

use plotters::prelude::*;

use super::axis::Axis;
use super::canvas::{
    Area, Drawing, Frame, LegendEntry, Swatch, UNIT, coloured, legend, name, sheet,
};
use crate::MeasureError;
use crate::format;
use crate::report::Report;
use crate::stats::percentile;

const TITLE: &str = "Frame time along the path";
/// The most points of a line. More would only make the page larger.
const MOST_POINTS: usize = 900;
/// The axis is logarithmic where the slowest strategy takes this many times as long as the fastest.
const WIDE: f64 = 8.0;

struct Line {
    name: String,
    colour: RGBColor,
    times: Vec<f64>,
}

/// Plots serialised frame times in milliseconds over poses, a line for each strategy. Spikes far above the 99th percentiles are cut at the upper
/// edge. `None` where no strategy has a series.
///
/// # Errors
/// [`MeasureError::Plot`] where the plotter fails.
pub fn frame_times(report: &Report) -> Result<Option<String>, MeasureError> {
    let lines: Vec<Line> = coloured(report)
        .into_iter()
        .filter(|one| !one.strategy.frames.frame_ms.is_empty())
        .map(|one| Line {
            name: name(report, one.strategy),
            colour: one.colour,
            times: one.strategy.frames.frame_ms.clone(),
        })
        .collect();
    if lines.is_empty() {
        return Ok(None);
    }
    let part = |percent: f64| -> Result<Vec<f64>, MeasureError> {
        lines
            .iter()
            .map(|line| percentile(&line.times, percent))
            .collect()
    };
    let low = part(1.0)?.into_iter().fold(f64::INFINITY, f64::min);
    let high = part(99.0)?.into_iter().fold(0.0, f64::max);
    let middle = part(50.0)?;
    let (slowest, fastest) = (
        middle.iter().copied().fold(0.0, f64::max),
        middle.iter().copied().fold(f64::INFINITY, f64::min),
    );
    let logarithmic = low > 0.0 && slowest > WIDE * fastest;
    let y = if logarithmic {
        Axis::times(low, high, format::trimmed)
    } else {
        Axis::even(0.0..(high * 1.1).max(1e-3), 7, format::trimmed)
    };
    let means = if logarithmic {
        "frame time (ms, logarithmic)"
    } else {
        "frame time (ms)"
    };
    sheet(TITLE, 360, |area| draw(area, &lines, y, means)).map(Some)
}

fn draw(area: &Area<'_>, lines: &[Line], y: Axis, means: &str) -> Drawing {
    let entries: Vec<_> = lines
        .iter()
        .map(|line| LegendEntry::new(&line.name, line.colour, Swatch::Line))
        .collect();
    let area = legend(area, &entries)?;
    let poses = lines.iter().map(|line| line.times.len()).max().unwrap_or(0);
    let x = Axis::even(
        0.0..poses.saturating_sub(1).max(1) as f64,
        10,
        format::trimmed,
    );
    let frame = Frame {
        x,
        y: y.clone(),
        x_means: "pose (number along the path)",
        y_means: means,
        y_room: 70,
    };
    let mut chart = frame.draw(&area)?;
    for line in lines {
        let points = thinned(&line.times)
            .into_iter()
            .map(|(pose, ms)| (pose as f64, y.place(ms)));
        chart.draw_series(LineSeries::new(
            points,
            line.colour.stroke_width(UNIT as u32 * 3 / 2),
        ))?;
    }
    Ok(())
}

/// The series with at most [`MOST_POINTS`] points: the minimum and the maximum of each stretch, so that no spike is lost.
fn thinned(times: &[f64]) -> Vec<(usize, f64)> {
    let stretch = (2 * times.len()).div_ceil(MOST_POINTS).max(1);
    let mut points: Vec<(usize, f64)> = Vec::new();
    for (i, values) in times.chunks(stretch).enumerate() {
        let numbered = || {
            values
                .iter()
                .copied()
                .enumerate()
                .map(|(k, ms)| (i * stretch + k, ms))
        };
        let least = numbered().min_by(|a, b| a.1.total_cmp(&b.1));
        let most = numbered().max_by(|a, b| a.1.total_cmp(&b.1));
        let mut pair: Vec<_> = least.into_iter().chain(most).collect();
        pair.sort_by_key(|(pose, _)| *pose);
        pair.dedup_by_key(|(pose, _)| *pose);
        points.extend(pair);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_series_stay_and_long_ones_keep_their_spikes() {
        let short: Vec<f64> = (0..300).map(f64::from).collect();
        assert_eq!(thinned(&short).len(), 300);
        let mut long = vec![1.0; 100_000];
        long[77_777] = 50.0;
        let points = thinned(&long);
        assert!(points.len() <= MOST_POINTS && points.contains(&(77_777, 50.0)));
        assert!(points.is_sorted_by_key(|p| p.0));
    }
}
