//! Ranges of `--vary`: `1..8`, `0..1+0.25`, `1..256*4`.

use super::MOST_SETTINGS;
use crate::failure::Failure;

/// How a range goes on from a value.
#[derive(Clone, Copy)]
enum Next {
    Plus(f64),
    Times(f64),
}

impl Next {
    /// The value after `n` of them.
    fn value(self, from: f64, n: usize) -> f64 {
        let n = n as f64;
        match self {
            Self::Plus(step) => from + step * n,
            // Nothing grows out of 0: after it comes 1.
            Self::Times(_) if from == 0.0 && n == 0.0 => 0.0,
            Self::Times(factor) if from == 0.0 => factor.powf(n - 1.0),
            Self::Times(factor) => from * factor.powf(n),
        }
    }

    fn goes_on(self, from: f64) -> bool {
        match self {
            Self::Plus(step) => step > 0.0,
            Self::Times(factor) => factor > 1.0 && from >= 0.0,
        }
    }
}

/// The values of the range `text`, which begins at `from`; `rest` is what comes after its dots: `B`, `B+STEP` or `B*FACTOR`. B is among them
/// where a step ends on it.
///
/// # Errors
/// [`Failure::Usage`] for what is no range, and for more values than a sweep may have.
pub fn values(text: &str, from: &str, rest: &str) -> Result<Vec<String>, Failure> {
    let Some((from, to, next)) = read(from, rest) else {
        return Err(Failure::Usage(format!(
            "'{text}' is no range: write 1..8, 0..1+0.25 (steps above 0) or 1..256*4 (factors above 1, from 0 on)"
        )));
    };
    // What a sum of decimals is off by is no reason to miss the end.
    let end = to + (to - from) * 1e-9;
    let values = (0..=MOST_SETTINGS).map(|n| next.value(from, n));
    let values: Vec<f64> = values.take_while(|value| *value <= end).collect();
    if values.len() > MOST_SETTINGS {
        return Err(Failure::Usage(format!(
            "'{text}' are more than {MOST_SETTINGS} values"
        )));
    }
    Ok(values.into_iter().map(written).collect())
}

fn read(from: &str, rest: &str) -> Option<(f64, f64, Next)> {
    let number = |text: &str| text.parse().ok().filter(|n: &f64| n.is_finite());
    let (to, next) = match (rest.split_once('*'), rest.split_once('+')) {
        (Some((to, factor)), _) => (to, Next::Times(number(factor)?)),
        (_, Some((to, step))) => (to, Next::Plus(number(step)?)),
        _ => (rest, Next::Plus(1.0)),
    };
    let (from, to) = (number(from)?, number(to)?);
    (from <= to && next.goes_on(from)).then_some((from, to, next))
}

/// A number as one would type it: 0.3, and not 0.30000000000000004.
fn written(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
