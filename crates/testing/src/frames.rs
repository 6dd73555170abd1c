//! Stages, and frames played on them.

use antumbra_cull::{
    Stage, StageOptions, StageScene, Strategy, Verdicts, ViewInput, ViewSpec, read_back,
};
use antumbra_scene::Camera;
use antumbra_strategies::registry;
use antumbra_verify::{EntitySet, Oracle};

/// Views of these names, all of one size in pixels.
pub fn views(names: &[&str], size: [u32; 2]) -> Vec<ViewSpec> {
    let view = |name: &&str| ViewSpec {
        name: (*name).to_owned(),
        size,
    };
    names.iter().map(view).collect()
}

/// A stage with default options, under a strategy that the registry parses.
pub fn stage(scene: &dyn StageScene, strategy: &str, views: Vec<ViewSpec>) -> Stage {
    let strategy = registry().parse(strategy).unwrap();
    stage_with(scene, strategy, views, StageOptions::default())
}

/// A stage under any strategy, with options.
pub fn stage_with(
    scene: &dyn StageScene,
    strategy: Box<dyn Strategy>,
    views: Vec<ViewSpec>,
    options: StageOptions,
) -> Stage {
    Stage::new(scene, strategy, views, options).unwrap()
}

/// Plays a frame, one camera a view, and waits, so that late answers are there for the next frame. The verdicts of each view.
pub fn frame(stage: &mut Stage, scene: &dyn StageScene, cameras: &[Camera]) -> Vec<Verdicts> {
    let inputs: Vec<ViewInput<'_>> = cameras.iter().copied().map(ViewInput::new).collect();
    stage.frame(scene, &inputs).unwrap();
    scene.gpu().wait().unwrap();
    (0..cameras.len())
        .map(|view| stage.verdicts(view, scene).unwrap())
        .collect()
}

/// The last of several frames of a still scene.
pub struct Settled {
    /// Its verdicts.
    pub verdicts: Verdicts,
    /// Its colours, four bytes a pixel, row by row.
    pub picture: Vec<u8>,
}

/// Plays `frames` frames of one view to a strategy, from a camera that stands still.
pub fn settled(
    scene: &dyn StageScene,
    strategy: &str,
    camera: Camera,
    size: [u32; 2],
    frames: u32,
) -> Settled {
    let mut stage = stage(scene, strategy, views(&["main"], size));
    for _ in 0..frames {
        stage.frame(scene, &[ViewInput::new(camera)]).unwrap();
        scene.gpu().wait().unwrap();
    }
    Settled {
        verdicts: stage.verdicts(0, scene).unwrap(),
        picture: read_back::texture(scene.gpu(), stage.colour(0).unwrap()).unwrap(),
    }
}

/// The share of pixels, in percent of the image, that are wrong when only what the verdicts draw is drawn.
pub fn wrong_pixels_percent(
    oracle: &mut Oracle,
    scene: &dyn StageScene,
    camera: &Camera,
    verdicts: &Verdicts,
) -> f64 {
    let reference = oracle.render(scene, camera, EntitySet::InFrustum).unwrap();
    let drawn = EntitySet::Drawn(verdicts);
    let drawn = oracle.render(scene, camera, drawn).unwrap();
    let pixels = reference.pixels().count() as f64;
    reference.wrong_pixels(&drawn) as f64 * 100.0 / pixels
}
