//! The length of the eye's path, which tells how old answers may be.

use glam::DVec3;

/// The path of a view's eye.
#[derive(Debug, Clone, Default)]
pub(super) struct EyePath {
    length: f64,
    last: Option<DVec3>,
}

impl EyePath {
    /// Moves the eye to its place in a new frame.
    pub fn advance(&mut self, eye: DVec3) {
        self.length += self.last.map_or(0.0, |last| last.distance(eye));
        self.last = Some(eye);
    }

    /// Starts at the next frame's eye: the way there is not counted.
    pub fn restart(&mut self) {
        self.last = None;
    }

    /// Metres travelled since the first frame.
    pub fn length(&self) -> f64 {
        self.length
    }
}
