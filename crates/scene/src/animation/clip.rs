//! Clips: what keyframes drive, and for how long.

use super::keyframes::Keyframes;

/// Channels that play together.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// The name; may be empty, and need not be unique.
    pub name: String,
    /// The channels. Of two with the same target, the later one counts.
    pub channels: Vec<Channel>,
    duration: f64,
}

/// Keyframes of one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The node, by its place in the rig.
    pub node: usize,
    /// The property, and its keyframes.
    pub curve: Curve,
}

/// A property over time. It takes the place of the node's own at rest.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// Metres, relative to the parent.
    Translation(Keyframes),
    /// Quaternions (x, y, z, w), relative to the parent.
    Rotation(Keyframes),
    /// Factors along the node's own axes.
    Scale(Keyframes),
    /// The weight of each morph target of the node's meshes.
    Weights(Keyframes),
}

impl Curve {
    /// The keyframes.
    #[must_use]
    pub fn keyframes(&self) -> &Keyframes {
        match self {
            Self::Translation(keys)
            | Self::Rotation(keys)
            | Self::Scale(keys)
            | Self::Weights(keys) => keys,
        }
    }

    /// Whether it is a part of the node's transform.
    #[must_use]
    pub fn moves_node(&self) -> bool {
        !matches!(self, Self::Weights(_))
    }

    /// The numbers that a key must have; `None` for weights, whose missing ones are 0.
    pub(super) fn width(&self) -> Option<usize> {
        match self {
            Self::Translation(_) | Self::Scale(_) => Some(3),
            Self::Rotation(_) => Some(4),
            Self::Weights(_) => None,
        }
    }
}

impl Clip {
    /// A clip that lasts until its last key.
    #[must_use]
    pub fn new(name: impl Into<String>, channels: Vec<Channel>) -> Self {
        let ends = channels
            .iter()
            .map(|channel| channel.curve.keyframes().end());
        Self {
            name: name.into(),
            duration: ends.fold(0.0, f64::max),
            channels,
        }
    }

    /// Seconds from 0 to the last key.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The time within the clip at which it is after this many seconds: it begins again after its end, which itself is still shown. Before 0 it has not begun.
    #[must_use]
    pub fn time_within(&self, time: f64) -> f64 {
        match time > self.duration && self.duration > 0.0 {
            true => time.rem_euclid(self.duration),
            false => time.clamp(0.0, self.duration),
        }
    }
}
