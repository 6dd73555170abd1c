//! A flight around a sub-surface model that changes meanwhile: a slice moves through the seismic volume, a fault is removed and a horizon moved
//! aside. Only the visible bricks of the volume are read. The last frame is saved as `out/subsurface.png`.

use std::error::Error;
use std::path::{Path, PathBuf};

use antumbra::cull::{AdapterChoice, Gpu, Stage, StageOptions, ViewInput, ViewSpec, read_back};
use antumbra::demo_scenes::subsurface::{SubsurfaceScene, SubsurfaceSceneOptions};
use antumbra::draw::GpuScene;
use antumbra::measure::image_error::save_png;
use antumbra::scene::{Camera, EntityKey, Projection, Scene};
use antumbra::strategies::registry;
use antumbra::subsurface::{SurfaceEntities, SurfaceKind};
use glam::{DAffine3, DVec3};

/// The result of the flight.
#[derive(Debug, PartialEq, Eq)]
pub struct Explored {
    /// Number of bricks that were read.
    pub bricks_read: u64,
    /// Number of bricks that the slices and the lens intersect at the end.
    pub bricks_crossed: u64,
    /// Number of entities at the end.
    pub entities: usize,
    /// Number of entities drawn in the last frame.
    pub drawn: usize,
}

/// `explore_subsurface [PNG]`
pub fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args_os().nth(1).map(PathBuf::from);
    let output = output.unwrap_or_else(|| "out/subsurface.png".into());
    if let Some(folder) = output.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut options = SubsurfaceSceneOptions::default();
    options.model.nodes_per_side = 160;
    let explored = run(options, [800, 640], 48, &output)?;
    println!(
        "of {} bricks that slices and lens went through, {} were read",
        explored.bricks_crossed, explored.bricks_read
    );
    println!(
        "{} of {} entities drawn in the end",
        explored.drawn, explored.entities
    );
    println!("image: {}", output.display());
    Ok(())
}

/// Flies, changes the model at a quarter, a half and three quarters of the way, and saves the last frame.
pub fn run(
    options: SubsurfaceSceneOptions,
    size: [u32; 2],
    frames: usize,
    output: &Path,
) -> Result<Explored, Box<dyn Error>> {
    let gpu = Gpu::open(&AdapterChoice::Auto)?;
    let SubsurfaceScene {
        mut scene,
        surfaces,
        mut sections,
        ..
    } = SubsurfaceScene::new(&options, &|_, _| ())?;
    let mut on_gpu = GpuScene::new(&gpu, &mut scene)?;
    let strategy = registry().parse("three-pass:latency=frame-late")?;
    let views = vec![ViewSpec::main(size[0], size[1])];
    let mut stage = Stage::new(&on_gpu, strategy, views, StageOptions::default())?;
    let mut drawn = 0;
    for frame in 0..frames {
        if frame == frames / 4 {
            // The slice moves by five samples; its bricks there are read once they are visible.
            let slice = sections.slices.first_mut().ok_or("no slice")?;
            slice.move_to(&mut scene, slice.index() + 5)?;
        }
        if frame == frames / 2 {
            scene.despawn(surface(&surfaces, SurfaceKind::Fault)?.root);
        }
        if frame == 3 * frames / 4 {
            let aside = DAffine3::from_translation(DVec3::new(0.0, 2500.0, 0.0));
            pull(
                &mut scene,
                surface(&surfaces, SurfaceKind::Horizon)?.root,
                &aside,
            )?;
        }
        let camera = camera(frame, frames)?;
        sections.orient_to(&mut scene, camera.position)?;
        on_gpu.sync(&mut scene)?;
        stage.frame(&on_gpu, &[ViewInput::new(camera)])?;
        gpu.wait()?;
        // Verdicts are of the previous frame: a brick is not read until its tile has been visible.
        let verdicts = stage.verdicts(0, &on_gpu)?;
        let is_hidden = |entity: EntityKey| {
            let slot = on_gpu.slot(entity);
            slot.and_then(|slot| verdicts.seen(slot)) != Some(true)
        };
        sections.page(&mut scene, &is_hidden)?;
        drawn = verdicts.drawn().count();
    }
    let crossed = |bricks: usize| bricks as u64;
    let of_slices = sections.slices.iter().flat_map(|slice| {
        let tiles = slice.tiles().iter();
        tiles.map(|tile| slice.bricks(tile).count())
    });
    let of_lenses = sections.lenses.iter().map(|lens| lens.bricks().count());
    let texture = stage.colour(0).ok_or("no image")?;
    let pixels = read_back::texture(&gpu, texture)?;
    let image = image::RgbaImage::from_raw(size[0], size[1], pixels).ok_or("no image")?;
    save_png(&image, output)?;
    Ok(Explored {
        bricks_read: sections.bricks.stats().read,
        bricks_crossed: of_slices.chain(of_lenses).map(crossed).sum(),
        entities: scene.drawable_count(),
        drawn,
    })
}

fn surface(
    surfaces: &[SurfaceEntities],
    kind: SurfaceKind,
) -> Result<&SurfaceEntities, &'static str> {
    let found = surfaces.iter().find(|surface| surface.kind == kind);
    found.ok_or("no such surface")
}

fn pull(scene: &mut Scene, root: EntityKey, by: &DAffine3) -> Result<(), Box<dyn Error>> {
    let place = scene.local(root).ok_or("the surface is gone")?;
    scene.set_local(root, *by * place)?;
    Ok(())
}

/// The camera on a quarter of a circle around the model.
fn camera(frame: usize, frames: usize) -> Result<Camera, Box<dyn Error>> {
    let projection = Projection::Perspective {
        fov_y: 0.7,
        near: 5.0,
    };
    let angle = frame as f64 / frames as f64 * 1.5;
    let eye = DVec3::new(6800.0, 3600.0, 6200.0).rotate_y(angle);
    let target = DVec3::new(0.0, -1200.0, 0.0);
    Ok(Camera::look_at(eye, target, DVec3::Y, projection)?)
}
