//! `antumbra graph`: a strategy's plan as a picture, with the time of each pass in one frame.

use antumbra::graph::PlanFormat;

use crate::args::{Format, GraphArgs};
use crate::drawn_pose::{DrawnPose, PoseRequest};
use crate::failure::Failure;
use crate::outputs::Outputs;
use crate::print::print;

/// Prints the graph.
///
/// # Errors
/// What stopped it.
pub fn run(args: GraphArgs) -> Result<(), Failure> {
    let request = PoseRequest {
        view: &args.view,
        strategy: &args.strategy,
        pose: 0,
        sketch: false,
        timing: true,
    };
    let DrawnPose { stage, watch, .. } = DrawnPose::draw(request, &mut Outputs::default())?;
    // The adapter's work is done, and a reader of the graph may be slow.
    drop(watch);
    let format = match args.format {
        Format::Dot => PlanFormat::Dot,
        Format::Mermaid => PlanFormat::Mermaid,
        Format::Json => PlanFormat::Json,
    };
    print(stage.plan().export(format))
}
