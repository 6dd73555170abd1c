//! Lights after the glTF extension KHR_lights_punctual.

/// A light. It is at its entity's origin and shines along the entity's -Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Parallel light along -Z.
    Directional {
        /// Linear RGB, 0..1.
        colour: [f32; 3],
        /// Lux.
        illuminance: f32,
    },
    /// Light from a point in all directions.
    Point {
        /// Linear RGB, 0..1.
        colour: [f32; 3],
        /// Candela.
        intensity: f32,
        /// The range in metres beyond which the light has no effect; `None` for unlimited.
        range: Option<f32>,
    },
    /// Light from a point into a cone around -Z.
    Spot {
        /// Linear RGB, 0..1.
        colour: [f32; 3],
        /// Candela.
        intensity: f32,
        /// The range in metres beyond which the light has no effect; `None` for unlimited.
        range: Option<f32>,
        /// The angle from the axis, in radians, up to which the light has full intensity.
        inner: f32,
        /// The angle from the axis, in radians, beyond which there is no light.
        outer: f32,
    },
}

impl Light {
    /// Linear RGB, 0..1.
    #[must_use]
    pub fn colour(&self) -> [f32; 3] {
        match self {
            Self::Directional { colour, .. }
            | Self::Point { colour, .. }
            | Self::Spot { colour, .. } => *colour,
        }
    }

    /// A description of the first invalid number; `None` if all are valid.
    pub(crate) fn problem(&self) -> Option<String> {
        let bad = |what: &str, value: f32| {
            Some(format!(
                "{what} is {value}; it must be finite and at least 0"
            ))
        };
        let ok = |value: f32| value.is_finite() && value >= 0.0;
        if let Some(value) = self.colour().into_iter().find(|c| !ok(*c)) {
            return bad("a colour component", value);
        }
        match *self {
            Self::Directional { illuminance, .. } if !ok(illuminance) => {
                bad("its illuminance", illuminance)
            }
            Self::Point { intensity, .. } | Self::Spot { intensity, .. } if !ok(intensity) => {
                bad("its intensity", intensity)
            }
            Self::Point {
                range: Some(range), ..
            }
            | Self::Spot {
                range: Some(range), ..
            } if !ok(range) => bad("its range", range),
            Self::Spot { inner, outer, .. }
                if !(ok(inner) && inner < outer && outer <= std::f32::consts::FRAC_PI_2) =>
            {
                Some(format!(
                    "its cone runs from {inner} to {outer} radians; need 0 <= inner < outer <= pi/2"
                ))
            }
            _ => None,
        }
    }
}
