//! Keyframes: values at times, and what is between them.

use glam::{DQuat, DVec3};

use super::error::KeyframesProblem;

/// What is between two keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The earlier key's value.
    Step,
    /// A line; for rotations the shortest arc at constant speed (Shoemake, *Animating Rotation with Quaternion Curves*, 1985).
    #[default]
    Linear,
    /// A cubic Hermite spline. Each key has three values: the tangent on the way in, the value itself, and the tangent on the way out; tangents in units a second.
    CubicSpline,
}

impl Interpolation {
    /// The number of values a key.
    #[must_use]
    pub fn values_per_key(self) -> usize {
        match self {
            Self::Step | Self::Linear => 1,
            Self::CubicSpline => 3,
        }
    }
}

/// Values of a fixed width at increasing times. Before the first time and after the last the value stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframes {
    interpolation: Interpolation,
    times: Vec<f32>,
    values: Vec<f32>,
    width: usize,
}

/// A place between two keys; the same key twice before the first and after the last.
#[derive(Clone, Copy)]
struct Span {
    from: usize,
    to: usize,
    /// From 0 to 1.
    share: f64,
    /// From one key to the other.
    seconds: f64,
}

impl Keyframes {
    /// Keys at these times in seconds, with values of `width` numbers each, key by key.
    ///
    /// # Errors
    /// [`KeyframesProblem`]: no key, a number that is not finite, times that do not increase, another number of values than `times` times `width` (three times that for
    /// a cubic spline).
    pub fn new(
        interpolation: Interpolation,
        times: Vec<f32>,
        values: Vec<f32>,
        width: usize,
    ) -> Result<Self, KeyframesProblem> {
        if times.is_empty() || width == 0 {
            return Err(KeyframesProblem::Empty);
        }
        let rows = times.len().saturating_mul(interpolation.values_per_key());
        let needed = rows.saturating_mul(width);
        if values.len() != needed {
            return Err(KeyframesProblem::Length {
                values: values.len(),
                needed,
            });
        }
        if !times.iter().chain(&values).all(|number| number.is_finite()) {
            return Err(KeyframesProblem::NotFinite);
        }
        if !times.is_sorted_by(|before, after| before < after) {
            return Err(KeyframesProblem::NotIncreasing);
        }
        Ok(Self {
            interpolation,
            times,
            values,
            width,
        })
    }

    /// The numbers of a value.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The last time, in seconds.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.times.last().copied().map_or(0.0, f64::from)
    }

    /// The value at a time, number by number.
    #[must_use]
    pub fn sample(&self, time: f64) -> Vec<f32> {
        let span = self.span(time);
        let number = |i| self.number(&span, i) as f32;
        (0..self.width).map(number).collect()
    }

    /// The first three numbers of the value at a time.
    #[must_use]
    pub fn vector(&self, time: f64) -> DVec3 {
        let span = self.span(time);
        DVec3::from_array([0, 1, 2].map(|i| self.number(&span, i)))
    }

    /// The value at a time as a rotation, (x, y, z, w), of unit length; none where the four numbers have no length.
    #[must_use]
    pub fn rotation(&self, time: f64) -> DQuat {
        let span = self.span(time);
        if self.interpolation == Interpolation::Linear {
            let key = |key| unit([0, 1, 2, 3].map(|i| self.value(key, i)));
            return key(span.from).slerp(key(span.to), span.share).normalize();
        }
        unit([0, 1, 2, 3].map(|i| self.number(&span, i)))
    }

    fn span(&self, time: f64) -> Span {
        let at = |key: usize| self.times.get(key).copied().map_or(0.0, f64::from);
        let next = self.times.partition_point(|key| f64::from(*key) <= time);
        let last = self.times.len().saturating_sub(1);
        let (from, to) = (next.saturating_sub(1), next.min(last));
        let seconds = at(to) - at(from);
        let share = match seconds > 0.0 {
            true => ((time - at(from)) / seconds).clamp(0.0, 1.0),
            false => 0.0,
        };
        Span {
            from,
            to,
            share,
            seconds,
        }
    }

    /// One number of the value within a span.
    fn number(&self, span: &Span, i: usize) -> f64 {
        let (from, to, t) = (self.value(span.from, i), self.value(span.to, i), span.share);
        match self.interpolation {
            Interpolation::Step => from,
            Interpolation::Linear => from + (to - from) * t,
            Interpolation::CubicSpline => {
                let out = self.raw(span.from * 3 + 2, i) * span.seconds;
                let into = self.raw(span.to * 3, i) * span.seconds;
                let (t2, t3) = (t * t, t * t * t);
                from * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + out * (t3 - 2.0 * t2 + t)
                    + to * (3.0 * t2 - 2.0 * t3)
                    + into * (t3 - t2)
            }
        }
    }

    /// One number of a key's own value.
    fn value(&self, key: usize, i: usize) -> f64 {
        match self.interpolation {
            Interpolation::Step | Interpolation::Linear => self.raw(key, i),
            Interpolation::CubicSpline => self.raw(key * 3 + 1, i),
        }
    }

    fn raw(&self, row: usize, i: usize) -> f64 {
        let found = self.values.get(row * self.width + i);
        found.copied().map_or(0.0, f64::from)
    }
}

/// The numbers as a rotation of unit length.
fn unit(numbers: [f64; 4]) -> DQuat {
    let given = DQuat::from_array(numbers);
    let length = given.length();
    match length > 0.0 && length.is_finite() {
        true => given / length,
        false => DQuat::IDENTITY,
    }
}
