//! `antumbra graph`: a strategy's plan as a picture, with the times of one frame.

use std::sync::Arc;

use antumbra::cull::{Members, Oracle, Registry, Stage, StageOptions, ViewInput, ViewSpec};
use antumbra::draw::{Gpu, GpuScene};
use antumbra::graph::Picture;

use crate::args::{Format, GraphArgs};
use crate::failure::Failure;
use crate::input::Input;

/// Prints the graph.
///
/// # Errors
/// What stopped it.
pub fn run(args: GraphArgs) -> Result<(), Failure> {
    let strategy = Registry::built_in().parse(&args.strategy)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let mut input = Input::open(&args.view, &gpu)?;
    let camera = input.look(0)?;
    let scene = GpuScene::new(&gpu, &mut input.scene)?;
    let [width, height] = input.size;
    let options = StageOptions {
        timing: true,
        ..StageOptions::default()
    };
    let mut stage = Stage::new(
        &scene,
        strategy,
        vec![ViewSpec::main(width, height)],
        options,
    )?;
    let reference = match stage.strategy().needs_reference() {
        true => Some(Arc::new(
            Oracle::new(&scene, input.size)
                .look(&scene, &camera, Members::Frustum)?
                .owners(),
        )),
        false => None,
    };
    // The first frame compiles pipelines, and late answers come a frame later.
    for _ in 0..3 {
        stage.frame(
            &scene,
            &[ViewInput {
                reference: reference.clone(),
                ..ViewInput::new(camera)
            }],
        )?;
        gpu.wait()?;
    }
    let format = match args.format {
        Format::Dot => Picture::Dot,
        Format::Mermaid => Picture::Mermaid,
        Format::Json => Picture::Json,
    };
    println!("{}", stage.plan().picture(format));
    Ok(())
}
