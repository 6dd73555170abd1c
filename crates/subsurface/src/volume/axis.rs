//! The axes of a volume.

/// An axis of a volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The axis across the inlines: an inline section has a fixed index along it.
    Inline,
    /// The axis across the crosslines.
    Crossline,
    /// The axis downwards, in time or depth.
    Time,
}

impl Axis {
    /// All axes, in the order of a layout's arrays.
    pub const ALL: [Self; 3] = [Self::Inline, Self::Crossline, Self::Time];

    /// The axes that span a section perpendicular to this axis: to the right and down in the section's image.
    #[must_use]
    pub fn plane(self) -> [Self; 2] {
        match self {
            Self::Inline => [Self::Crossline, Self::Time],
            Self::Crossline => [Self::Inline, Self::Time],
            Self::Time => [Self::Inline, Self::Crossline],
        }
    }

    /// The component of a triple along this axis.
    #[must_use]
    pub fn of<T>(self, [inline, crossline, time]: [T; 3]) -> T {
        match self {
            Self::Inline => inline,
            Self::Crossline => crossline,
            Self::Time => time,
        }
    }

    /// The triple with `at` along this axis and the other two along its plane.
    #[must_use]
    pub fn place<T>(self, at: T, [right, down]: [T; 2]) -> [T; 3] {
        match self {
            Self::Inline => [at, right, down],
            Self::Crossline => [right, at, down],
            Self::Time => [right, down, at],
        }
    }
}

impl std::fmt::Display for Axis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Inline => "inline",
            Self::Crossline => "crossline",
            Self::Time => "time",
        })
    }
}
