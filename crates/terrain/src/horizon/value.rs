//! One horizon: the pair of a slope and a distance. Computed in f64, stored in f32, rounded so that it never hides more.

/// How much the computed slope of a horizon may be above the true one. Heights and distances are a thousand kilometres at most.
const ROUNDING: f64 = 1e-9;

/// A horizon in one sector: it hides its vertex from viewpoints at `distance` or farther, and below a line that rises by `slope`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Horizon {
    /// Metres up for each metre of distance.
    pub slope: f32,
    /// Metres in the plan.
    pub distance: f32,
}

impl Horizon {
    /// The horizon that hides from no viewpoint.
    pub const OPEN: Self = Self {
        slope: f32::NEG_INFINITY,
        distance: f32::INFINITY,
    };

    /// The horizon that hides from every viewpoint: the start of a minimum over sub-sectors.
    pub(crate) const ALL: Self = Self {
        slope: f32::INFINITY,
        distance: 0.0,
    };

    /// Whether the vertex is hidden from a viewpoint that is `distance` metres away in the plan and `up` metres higher.
    #[must_use]
    pub fn hides(&self, distance: f64, up: f64) -> bool {
        distance >= f64::from(self.distance) && up < f64::from(self.slope) * distance
    }

    /// A horizon that hides only what both hide.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            slope: self.slope.min(other.slope),
            distance: self.distance.max(other.distance),
        }
    }
}

/// A horizon in f64, as it is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WideHorizon {
    pub slope: f64,
    pub distance: f64,
}

impl WideHorizon {
    /// The horizon that hides from no viewpoint.
    pub const OPEN: Self = Self {
        slope: f64::NEG_INFINITY,
        distance: f64::INFINITY,
    };

    /// The horizon that hides from every viewpoint: the start of a minimum over sub-sectors.
    pub const ALL: Self = Self {
        slope: f64::INFINITY,
        distance: 0.0,
    };

    /// A horizon that hides only what both hide.
    pub fn and(self, other: Self) -> Self {
        Self {
            slope: self.slope.min(other.slope),
            distance: self.distance.max(other.distance),
        }
    }

    /// The horizon in f32, rounded so that it hides no more than this one.
    pub fn rounded(self) -> Horizon {
        let slope = self.slope - ROUNDING * (1.0 + self.slope.abs());
        let [mut low, mut far] = [slope, self.distance].map(|number| number as f32);
        if f64::from(low) > slope {
            low = low.next_down();
        }
        if f64::from(far) < self.distance {
            far = far.next_up();
        }
        Horizon {
            slope: low,
            distance: far,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_hides_no_more() {
        // Numbers between those of f32, on either side of its nearest.
        for number in 1..2_000 {
            let distance = f64::from(number) * 0.123_456_789;
            let slope = (distance - 100.0) / 77.7;
            let rounded = WideHorizon { slope, distance }.rounded();
            assert!(f64::from(rounded.slope) <= slope - ROUNDING * (1.0 + slope.abs()));
            assert!(f64::from(rounded.distance) >= distance);
        }
    }
}
