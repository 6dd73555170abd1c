//! The errors of animations.

use crate::error::SceneError;
use thiserror::Error;

/// Why an animation was refused, or could not be posed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum AnimationError {
    /// A part refers to nothing, or does not fit another.
    #[error("animation, {part}: {problem}")]
    BadPart {
        /// The part.
        part: String,
        /// What is wrong.
        problem: String,
    },
    /// There is no such clip.
    #[error("there is no clip {clip}: the animation has {count}, numbered from 0")]
    UnknownClip {
        /// The number asked for.
        clip: usize,
        /// The number of clips.
        count: usize,
    },
    /// A time is NaN or infinite.
    #[error("{time} is no time: give finite seconds")]
    BadTime {
        /// The time.
        time: f64,
    },
    /// The scene refused the pose.
    #[error("the pose: {0}")]
    Scene(#[from] SceneError),
}

/// Why keyframes were refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum KeyframesProblem {
    /// There is no key.
    #[error("no keyframe")]
    Empty,
    /// A time or a value is NaN or infinite.
    #[error("keyframes that are not finite")]
    NotFinite,
    /// A time is not later than the one before it.
    #[error("keyframe times that do not increase")]
    NotIncreasing,
    /// The number of values is not what the times need.
    #[error("keyframes with too few or too many values")]
    Length {
        /// The number of values.
        values: usize,
        /// The number needed.
        needed: usize,
    },
}
