//! Ranges of `--vary`: `1..8`, `0..1+0.25`, `1..256*4`.

use crate::failure::Failure;

/// The step from one value of a range to the next.
#[derive(Clone, Copy)]
enum Step {
    /// Added to the value; above 0.
    Plus(f64),
    /// Multiplies the value; above 1.
    Times(f64),
}

/// A range as it is written.
struct ValueRange {
    from: f64,
    to: f64,
    step: Step,
}

impl ValueRange {
    /// Reads what is before and after the dots: `A`, and `B`, `B+STEP` or `B*FACTOR`. `None` for other text, and for a range that does not
    /// reach its end.
    fn read(from: &str, rest: &str) -> Option<Self> {
        let number = |text: &str| text.parse().ok().filter(|n: &f64| n.is_finite());
        let (to, step) = match (rest.split_once('*'), rest.split_once('+')) {
            (Some((to, factor)), _) => (to, Step::Times(number(factor)?)),
            (_, Some((to, step))) => (to, Step::Plus(number(step)?)),
            _ => (rest, Step::Plus(1.0)),
        };
        let (from, to) = (number(from)?, number(to)?);
        let grows = match step {
            Step::Plus(step) => step > 0.0,
            Step::Times(factor) => factor > 1.0 && from >= 0.0,
        };
        (from <= to && grows).then_some(Self { from, to, step })
    }

    /// The value after `n` steps.
    fn value(&self, n: usize) -> f64 {
        let n = n as f64;
        match self.step {
            Step::Plus(step) => self.from + step * n,
            // No factor leads away from 0: the value after 0 is 1.
            Step::Times(_) if self.from == 0.0 && n == 0.0 => 0.0,
            Step::Times(factor) if self.from == 0.0 => factor.powf(n - 1.0),
            Step::Times(factor) => self.from * factor.powf(n),
        }
    }
}

/// The values of a range, its end included where a step reaches it. `None` for a text without `..`, which is no range.
///
/// # Errors
/// [`Failure::Usage`] for a range that cannot be read, and for more than `most` values.
pub fn values(text: &str, most: usize) -> Result<Option<Vec<String>>, Failure> {
    let Some((from, rest)) = text.split_once("..") else {
        return Ok(None);
    };
    let Some(range) = ValueRange::read(from, rest) else {
        return Err(Failure::Usage(format!(
            "'{text}' is no range: write 1..8, 0..1+0.25 (steps above 0) or 1..256*4 (factors above 1, from 0 on)"
        )));
    };
    // The rounding of sums must not lose the end.
    let end = range.to + (range.to - range.from) * 1e-9;
    let values = (0..=most).map(|n| range.value(n));
    let values: Vec<f64> = values.take_while(|value| *value <= end).collect();
    if values.len() > most {
        return Err(Failure::Usage(format!(
            "'{text}' are more than {most} values"
        )));
    }
    Ok(Some(values.into_iter().map(written).collect()))
}

/// A number in its short form: 0.3, and not 0.30000000000000004.
fn written(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
