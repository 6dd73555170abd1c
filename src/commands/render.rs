//! `antumbra render`: one image, as a strategy draws it.

use std::sync::Arc;

use antumbra::cull::{
    Members, Oracle, Registry, Stage, StageError, StageOptions, Verdict, ViewInput, ViewSpec,
};
use antumbra::draw::{Gpu, GpuScene, read_back};
use antumbra::measure::image_error::save_png;
use image::{Rgba, RgbaImage};

use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::input::Input;

/// Draws and writes it.
///
/// # Errors
/// What stopped it; no half-written image stays behind.
pub fn run(args: RenderArgs) -> Result<(), Failure> {
    let strategy = Registry::built_in().parse(&args.strategy)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let mut input = Input::open(&args.view, &gpu)?;
    let camera = input.look(args.pose as usize)?;
    let scene = GpuScene::new(&gpu, &mut input.scene)?;
    let [width, height] = input.size;
    let mut stage = Stage::new(
        &scene,
        strategy,
        vec![ViewSpec::main(width, height)],
        StageOptions::default(),
    )?;
    let mut oracle = Oracle::new(&scene, input.size);
    let reference = Some(Arc::new(
        oracle.look(&scene, &camera, Members::Frustum)?.owners(),
    ));
    // Late answers need frames to arrive.
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
    let missing = || StageError::Input("a view without an image".to_owned());
    let texture = stage.colour(0).ok_or_else(missing)?;
    let mut image = RgbaImage::from_raw(width, height, read_back::texture(&gpu, texture)?)
        .ok_or_else(missing)?;
    if args.show_culled {
        let verdicts = stage.verdicts(0, &scene)?;
        let culled = |slot: &u32| {
            matches!(
                verdicts.get(*slot),
                Verdict::Occluded | Verdict::BelowThreshold
            )
        };
        let slots: Vec<u32> = scene.table().live_slots().filter(culled).collect();
        shine_through(
            &mut image,
            &oracle.look(&scene, &camera, Members::Slots(&slots))?.ids,
        );
    }
    save_png(&image, &args.output)?;
    Ok(())
}

/// Tints the pixels that a culled entity covers; the outlines between entities are left darker, so that each can be told apart.
fn shine_through(image: &mut RgbaImage, ids: &[u32]) {
    let width = image.width() as usize;
    for (at, pixel) in image.pixels_mut().enumerate() {
        let id = ids.get(at).copied().unwrap_or(0);
        if id == 0 {
            continue;
        }
        let edge = [at + 1, at + width]
            .iter()
            .any(|other| ids.get(*other).is_some_and(|other| *other != id));
        let Rgba([r, g, b, _]) = pixel;
        let share: u32 = if edge { 85 } else { 45 };
        let mix = |from: u8, to: u32| ((u32::from(from) * (100 - share) + to * share) / 100) as u8;
        (*r, *g, *b) = (mix(*r, 255), mix(*g, 0), mix(*b, 200));
    }
}
