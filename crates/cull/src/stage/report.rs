//! What a stage reports of a frame.

use antumbra_graph::FrameReport;

/// The report of a finished frame.
#[derive(Debug, Clone)]
pub struct StageReport {
    /// The frame's number in the stage, from 0. Audits name frames by it.
    pub frame: u64,
    /// What its plan reports: the submission, waits and read-backs. The frame's number there is the plan's own.
    pub plan: FrameReport,
    /// Why this frame had another plan than the last one; `None`: it had the same. To compile a plan takes milliseconds.
    pub rebuilt: Option<Rebuilt>,
}

/// Why a frame has another plan than the last one, and what its nodes keep. `Layout` and `Size` drop the plans of other steps, and keep nothing if the budget goes to another
/// step in the same frame, or if there was another new plan less than four frames ago: then everything in the frustum is drawn, as after a camera cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rebuilt {
    /// The stage was given another scene, and draws with that scene's renderer. Nothing is kept.
    Scene,
    /// The scene's [layout](crate::SceneLayout) has changed: it outgrew its buffers, or has other classes, lights or transparency. What the strategy knows on the host is kept.
    Layout,
    /// A view was [resized](crate::Stage::resize). What the strategy knows on the host is kept.
    Size,
    /// A budget went to a step that has no plan yet. Nothing is kept.
    Step,
    /// The driver was [found wrong](crate::Stage::distrust), and `frustum` draws from now on. Nothing is kept.
    Distrust,
    /// A budget came back to a step. Its plan and memory are used again, as after a camera cut; nothing was compiled.
    Resumed,
}
