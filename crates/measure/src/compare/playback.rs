//! The script that plays an animation: each pose of the path has its own time, the same for every strategy and for the reference.

use antumbra_scene::animation::{Animation, AnimationError};
use antumbra_scene::{Camera, Scene};

use super::Script;
use crate::report::MotionFacts;

/// A clip, and when each pose of a path shows it.
#[derive(Debug, Clone)]
pub struct Playback {
    animation: Animation,
    clip: usize,
    timing: Timing,
}

/// The times of poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Seconds at the first pose.
    pub start: f64,
    /// How many poses a second of the clip has; `None` where time stands still.
    pub frames_per_second: Option<f64>,
}

impl Timing {
    /// Seconds at a pose.
    #[must_use]
    pub fn at(&self, pose: usize) -> f64 {
        let passed = self
            .frames_per_second
            .map_or(0.0, |rate| pose as f64 / rate);
        self.start + passed
    }
}

impl Playback {
    /// One clip of an animation.
    ///
    /// # Errors
    /// A clip that the animation does not have.
    pub fn new(animation: Animation, clip: usize, timing: Timing) -> Result<Self, AnimationError> {
        let count = animation.clips().len();
        match clip < count {
            true => Ok(Self {
                animation,
                clip,
                timing,
            }),
            false => Err(AnimationError::UnknownClip { clip, count }),
        }
    }

    /// Brings the scene to the time of a pose.
    ///
    /// # Errors
    /// As for [`Animation::pose`].
    pub fn show(&self, scene: &mut Scene, pose: usize) -> Result<(), AnimationError> {
        self.animation.pose(scene, self.clip, self.timing.at(pose))
    }

    /// Brings the scene to a part of the clip, from 0 to 1.
    ///
    /// # Errors
    /// As for [`Animation::pose`].
    pub fn show_part(&self, scene: &mut Scene, part: f64) -> Result<(), AnimationError> {
        self.animation
            .pose(scene, self.clip, self.duration() * part)
    }

    /// What a report says of it.
    #[must_use]
    pub fn facts(&self) -> MotionFacts {
        let clip = self.animation.clips().get(self.clip);
        MotionFacts {
            clip: self.clip as u64,
            name: clip.map_or_else(String::new, |clip| clip.name.clone()),
            seconds: self.duration(),
            start: self.timing.start,
            frames_per_second: self.timing.frames_per_second,
        }
    }

    fn duration(&self) -> f64 {
        let clip = self.animation.clips().get(self.clip);
        clip.map_or(0.0, |clip| clip.duration())
    }
}

impl Script for Playback {
    fn set(&mut self, scene: &mut Scene, pose: usize, _: &Camera) -> Result<(), String> {
        self.show(scene, pose).map_err(|error| error.to_string())
    }
}
