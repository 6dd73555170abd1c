//! The range of a file's amplitudes, from a count of magnitudes in steps of an eighth of a power of two. A few spikes would leave all else grey, so
//! the largest thousandth is clipped.

/// The share of samples whose magnitude is within the range.
const WITHIN: f64 = 0.999;

/// Bits of an f32 below its magnitude's step: what is left is the exponent and three bits of the fraction.
const SHIFT: u32 = 20;

/// The greatest end of a range: the difference of two must be finite.
const MOST: f32 = f32::MAX / 4.0;

/// A count of magnitudes.
#[derive(Debug)]
pub(super) struct Amplitudes {
    counts: Vec<u64>,
    low: f32,
    high: f32,
}

/// The values of the least and the greatest sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AmplitudeRange {
    pub(super) range: [f32; 2],
    /// Whether some samples are beyond it.
    pub(super) is_clipped: bool,
}

impl Amplitudes {
    pub(super) fn new() -> Self {
        Self {
            counts: vec![0; 1 << (32 - SHIFT - 1)],
            low: f32::INFINITY,
            high: f32::NEG_INFINITY,
        }
    }

    /// Counts a sample. What is no number is left out.
    pub(super) fn add(&mut self, value: f32) {
        if !value.is_finite() {
            return;
        }
        (self.low, self.high) = (self.low.min(value), self.high.max(value));
        let step = value.abs().to_bits() >> SHIFT;
        if let Some(count) = self.counts.get_mut(step as usize) {
            *count += 1;
        }
    }

    /// The range: symmetric where there are values of both signs. `None` if no sample is a number.
    pub(super) fn range(&self) -> Option<AmplitudeRange> {
        let total: u64 = self.counts.iter().sum();
        if total == 0 {
            return None;
        }
        let mut below = 0;
        let mut counts = self.counts.iter();
        let step = counts.position(|count| {
            below += count;
            below as f64 >= total as f64 * WITHIN
        });
        // The upper end of the step.
        let bits = (step.unwrap_or_default() as u32 + 1) << SHIFT;
        let magnitude = self.low.abs().max(self.high.abs()).min(MOST);
        let limit = f32::from_bits(bits);
        let limit = if limit.is_finite() {
            limit.min(magnitude)
        } else {
            magnitude
        };
        let [low, high] = match (self.low < 0.0, self.high > 0.0) {
            (true, true) => [-limit, limit],
            (true, false) => [-limit, self.high.max(-limit)],
            (false, _) => [self.low.clamp(-limit, limit), limit],
        };
        let range = match low < high {
            true => [low, high],
            // A single value.
            false => [low, low + low.abs().max(1.0)],
        };
        Some(AmplitudeRange {
            range,
            is_clipped: self.low < range[0] || self.high > range[1],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(values: impl IntoIterator<Item = f32>) -> Option<AmplitudeRange> {
        let mut amplitudes = Amplitudes::new();
        values.into_iter().for_each(|value| amplitudes.add(value));
        amplitudes.range()
    }

    #[test]
    fn spikes_are_clipped_and_all_else_is_kept() {
        let wave = (0..10_000).map(|at| ((at as f32) * 0.1).sin() * 7.0);
        let spiked = range(wave.clone().chain([1e9])).unwrap();
        assert!(spiked.is_clipped);
        assert!(spiked.range[1] >= 6.99 && spiked.range[1] < 8.0);
        assert_eq!(spiked.range[0], -spiked.range[1]);
        let plain = range(wave).unwrap();
        assert!(!plain.is_clipped && plain.range[1] <= 7.0);
    }

    #[test]
    fn values_of_one_sign_or_one_value_have_a_range() {
        assert_eq!(range([1.0, 2.0, 3.0]).unwrap().range, [1.0, 3.0]);
        assert_eq!(range([-3.0, -1.0]).unwrap().range, [-3.0, -1.0]);
        assert_eq!(range([0.0; 9]).unwrap().range, [0.0, 1.0]);
        assert_eq!(range([5.0]).unwrap().range, [5.0, 10.0]);
        assert_eq!(range([f32::NAN, f32::INFINITY]), None);
        let [low, high] = range([f32::MAX, -f32::MAX]).unwrap().range;
        assert!((high - low).is_finite() && low < high);
    }
}
