//! Axes: a range of numbers with labelled ticks.

use std::ops::Range;

use plotters::coord::ranged1d::{
    BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter,
};
use plotters::coord::types::RangedCoordf64;

use crate::format;

/// An axis for plotters. Values are mapped linearly between its ends; for other scales, [`Axis::place`] transforms them before.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    ends: Range<f64>,
    /// Positions and labels.
    ticks: Vec<(f64, String)>,
    scale: Scale,
}

#[derive(Debug, Clone, Copy)]
enum Scale {
    Even,
    /// Logarithmic. The value 0 is at the position `zero` below the decades.
    Decades {
        zero: f64,
    },
}

impl Axis {
    /// A linear axis with ticks at round numbers.
    pub(super) fn even(ends: Range<f64>, ticks: usize, word: impl Fn(f64) -> String) -> Self {
        let coordinate: RangedCoordf64 = ends.clone().into();
        let places = coordinate.key_points(BoldPoints(ticks));
        let ticks = places.into_iter().map(|at| (at, word(at))).collect();
        Self {
            ends,
            ticks,
            scale: Scale::Even,
        }
    }

    /// A linear axis with a unit for each row, labelled in the middle of the row.
    pub(super) fn rows(words: Vec<String>) -> Self {
        let ends = 0.0..words.len().max(1) as f64;
        let ticks = words
            .into_iter()
            .enumerate()
            .map(|(i, word)| (i as f64 + 0.5, word))
            .collect();
        Self {
            ends,
            ticks,
            scale: Scale::Even,
        }
    }

    /// A logarithmic axis with decades for all positive `values`, and a position below them for 0.
    pub(super) fn errors(values: impl Iterator<Item = f64> + Clone) -> Self {
        let positive = values.filter(|v| *v > 0.0).map(f64::log10);
        let low = positive.clone().fold(f64::INFINITY, f64::min).floor();
        let high = positive.fold(f64::NEG_INFINITY, f64::max).ceil();
        let (low, high) = if low.is_finite() {
            (low, high.max(low + 1.0))
        } else {
            (-2.0, 0.0)
        };
        let zero = low - 1.0;
        let mut ticks = vec![(zero, "0".to_owned())];
        ticks.extend(decades(low, high, 7).map(|at| (at, decimal(at))));
        Self {
            ends: zero - 0.4..high + 0.25,
            ticks,
            scale: Scale::Decades { zero },
        }
    }

    /// A logarithmic axis from `low` to `high`, both positive, with ticks at 1, 2 and 5, and with more ticks where those are few.
    pub(super) fn times(low: f64, high: f64, word: impl Fn(f64) -> String) -> Self {
        let (bottom, top) = (low.log10() - 0.05, high.log10() + 0.05);
        let at = |digits: &[f64]| -> Vec<f64> {
            ((bottom.floor() as i32)..=(top.ceil() as i32))
                .flat_map(|decade| digits.iter().map(move |m| m * 10f64.powi(decade)))
                .filter(|v| (bottom..=top).contains(&v.log10()))
                .collect()
        };
        let mut values = at(&[1.0, 2.0, 5.0]);
        if values.len() < 4 {
            values = at(&[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0]);
        }
        Self {
            ends: bottom..top,
            ticks: values.into_iter().map(|v| (v.log10(), word(v))).collect(),
            scale: Scale::Decades { zero: bottom },
        }
    }

    /// The position of a value on the axis, clamped to its ends.
    pub(super) fn place(&self, value: f64) -> f64 {
        let at = match self.scale {
            Scale::Even => value,
            Scale::Decades { zero } if value <= 0.0 => zero,
            Scale::Decades { .. } => value.log10(),
        };
        at.clamp(self.ends.start, self.ends.end)
    }

    /// The position of the line between 0 and the decades; the start of a linear axis.
    pub(super) fn break_above_zero(&self) -> f64 {
        match self.scale {
            Scale::Even => self.ends.start,
            Scale::Decades { zero } => zero + 0.5,
        }
    }

    /// The positions of its ends.
    pub(super) fn ends(&self) -> Range<f64> {
        self.ends.clone()
    }
}

/// Whole decades, at most about `most` of them.
fn decades(low: f64, high: f64, most: usize) -> impl Iterator<Item = f64> {
    let (low, high) = (low as i32, high as i32);
    let step = (high - low).unsigned_abs() as usize / most + 1;
    (low..=high).step_by(step).map(f64::from)
}

/// A power of ten, written out where that is short: `0.001`, `10`, `1e-7`.
fn decimal(exponent: f64) -> String {
    let value = 10f64.powf(exponent);
    if (-5.0..5.0).contains(&exponent) {
        format::trimmed(value)
    } else {
        format!("{value:.0e}")
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.ends.start) / (self.ends.end - self.ends.start);
        from + (part * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        self.ticks.iter().map(|(at, _)| *at).collect()
    }

    fn range(&self) -> Range<f64> {
        self.ends()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|(at, _)| at == value);
        tick.map(|(_, word)| word.clone()).unwrap_or_default()
    }
}
