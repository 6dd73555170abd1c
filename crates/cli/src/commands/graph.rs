//! `antumbra graph`: a strategy's plan as a picture, with the time of each pass in one frame.

use antumbra::cull::{Gpu, Stage, StageOptions};
use antumbra::draw::GpuScene;
use antumbra::graph::PlanFormat;
use antumbra::verify::Oracle;

use crate::args::{Format, GraphArgs};
use crate::eyes::inputs;
use crate::failure::Failure;
use crate::input::Input;
use crate::outputs::Outputs;
use crate::print::print;
use crate::strategies::{Horizons, registry};
use crate::watch::Watch;

/// Prints the graph.
///
/// # Errors
/// What stopped it.
pub fn run(args: GraphArgs) -> Result<(), Failure> {
    // Wrong usage is found before anything is loaded.
    registry(None).parse(&args.strategy)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let mut input = Input::open(
        &args.view,
        Horizons::of([&args.strategy]),
        &gpu,
        &mut Outputs::default(),
    )?;
    let strategy = registry(input.horizon.as_ref()).parse(&args.strategy)?;
    let cameras = input.look(0)?;
    let watch = Watch::start(args.view.patience);
    let scene = GpuScene::new(&gpu, &mut input.scene)?;
    let options = StageOptions {
        timing: true,
        samples: input.samples,
        ..StageOptions::default()
    };
    let mut stage = Stage::new(&scene, strategy, input.views(), options)?;
    let needs_reference = stage.strategy().needs_reference();
    let mut oracle =
        needs_reference.then(|| Oracle::new(&scene, input.size).with_samples(input.samples));
    let views = inputs(oracle.as_mut(), &scene, &cameras)?;
    // The first frame compiles pipelines, and late answers come a frame later.
    for _ in 0..3 {
        stage.frame(&scene, &views)?;
        gpu.wait()?;
        watch.sign();
    }
    // The adapter's work is done, and a reader of the graph may be slow.
    drop(watch);
    let format = match args.format {
        Format::Dot => PlanFormat::Dot,
        Format::Mermaid => PlanFormat::Mermaid,
        Format::Json => PlanFormat::Json,
    };
    print(stage.plan().export(format))
}
