//! The side from which a stack of sections is viewed.

use crate::volume::Axis;

/// The stack of sections that is drawn, and the side of the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct StackOrientation {
    /// The axis along which the sections follow each other.
    pub axis: Axis,
    /// The end of the axis that is nearer to the eye. The section at the other end is drawn first.
    pub eye_side: AxisEnd,
}

/// An end of one of a volume's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AxisEnd {
    /// The end with sample 0.
    First,
    /// The end with the last sample.
    Last,
}
