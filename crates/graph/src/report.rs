//! What the executor reports of a frame.

use std::time::Duration;

/// The report of a finished frame.
#[derive(Clone, Debug)]
pub struct FrameReport {
    /// The frame's number.
    pub frame: u64,
    /// The frame's last submission; `None` for an embedded plan.
    pub submission: Option<wgpu::SubmissionIndex>,
    /// Sync points that were waited at, those of loop iterations included.
    pub sync_points: u32,
    /// Iterations of all host loops.
    pub loop_iterations: u32,
    /// Frame-late read-backs that found no free slot.
    pub skipped_read_backs: u32,
    /// The results of earlier frames that nodes were given, in the order of their declaration. A result is given once; a node that has none keeps what it made of the last.
    pub late: Vec<LateResult>,
    /// Host time of the frame, waiting included.
    pub cpu: Duration,
    /// Of that, the time spent waiting at sync points.
    pub waited: Duration,
}

/// A result of an earlier frame that a node was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LateResult {
    /// The node's name.
    pub node: String,
    /// How many frames ago the result was made: 1 is the last frame.
    pub age: u64,
}
