//! `antumbra render`: one image, as a strategy draws it; in stereo, the images of both eyes.

use std::path::{Path, PathBuf};

use antumbra::cull::{Gpu, Stage, StageError, Verdict, read_back};
use antumbra::draw::GpuScene;
use antumbra::files::{FileContents, write_together};
use antumbra::measure::image_error::encode_png;
use antumbra::measure::stereo_picture::{StereoLayout, StereoPicture, combine_eyes};
use antumbra::measure::traversal_picture::encode_traversal;
use antumbra::scene::Camera;
use antumbra::strategies::Sketch;
use antumbra::verify::{EntitySet, Oracle};
use image::{Rgba, RgbaImage};

use crate::args::RenderArgs;
use crate::drawn_pose::{DrawnPose, PoseRequest};
use crate::failure::Failure;
use crate::losses::losses;
use crate::outputs::Outputs;
use crate::print::{print, warn};

/// What the names of two views' files end with.
const EYES: [&str; 2] = ["-left", "-right"];

/// Draws the image and writes it.
///
/// # Errors
/// What stopped it; no half-written image stays behind.
pub fn run(mut args: RenderArgs) -> Result<(), Failure> {
    // A layout puts two images together.
    args.view.eyes.stereo |= args.layout.is_some();
    let files = OutputFiles::of(&args);
    let mut outputs = Outputs::for_view(&args.view);
    files
        .images
        .iter()
        .for_each(|image| outputs.writes("--output", image));
    files
        .sketches
        .iter()
        .for_each(|sketch| outputs.writes("--sketch", sketch));
    outputs.check()?;
    has_ending("--output", &args.output, "png")?;
    if let Some(sketch) = &args.sketch {
        has_ending("--sketch", sketch, "svg")?;
    }
    let request = PoseRequest {
        view: &args.view,
        strategy: &args.strategy,
        pose: args.pose as usize,
        sketch: args.sketch.is_some(),
        timing: false,
    };
    let pose = DrawnPose::draw(request, &mut outputs)?;
    let losses = match args.view.quiet {
        true => Vec::new(),
        false => losses(&pose)?,
    };
    let DrawnPose {
        stage,
        scene,
        cameras,
        size,
        gpu,
        watch,
        ..
    } = pose;
    // Culled entities are shown by pixel, not by sample.
    let mut by_pixel = Oracle::new(&scene, size);
    let mut written = Vec::with_capacity(files.images.len() + files.sketches.len());
    let mut pictures = Vec::with_capacity(cameras.len());
    for (view, camera) in cameras.iter().enumerate() {
        let mut image = picture(&stage, view, &gpu, size)?;
        if let Some(file) = files.sketches.get(view) {
            let sketch = stage
                .shown::<Sketch>(view, Sketch::NAME)
                .ok_or_else(missing)?;
            written.push(FileContents {
                path: file.clone(),
                bytes: encode_traversal(&image, sketch, file)?,
            });
        }
        if args.show_culled {
            show_culled(&mut image, &stage, view, &scene, camera, &mut by_pixel)?;
        }
        pictures.push(image);
    }
    // The adapter's work is done.
    drop(watch);
    let mut pictures = pictures.into_iter();
    let parts = match (pictures.next(), pictures.next()) {
        (Some(left), Some(right)) => combine_eyes(left, right, args.layout.unwrap_or_default())?,
        (Some(picture), None) => vec![StereoPicture {
            suffix: "",
            picture,
        }],
        (None, _) => return Err(missing().into()),
    };
    for part in &parts {
        let path = suffixed(&args.output, part.suffix);
        written.push(FileContents {
            bytes: encode_png(&part.picture, &path)?,
            path,
        });
    }
    write_together(&written).map_err(|failed| Failure::Output {
        path: failed.path,
        error: failed.source,
    })?;
    losses.iter().for_each(warn);
    if !args.view.quiet {
        for (what, files) in [("image", &files.images), ("sketch", &files.sketches)] {
            for file in files {
                print(format_args!("{what}: {}", file.display()))?;
            }
        }
    }
    Ok(())
}

/// What is written: one or two images, and as many sketches as there are views.
struct OutputFiles {
    images: Vec<PathBuf>,
    sketches: Vec<PathBuf>,
}

impl OutputFiles {
    /// Their names, from the arguments alone.
    fn of(args: &RenderArgs) -> Self {
        let views: &[&str] = match args.view.eyes.requested() {
            true => &EYES,
            false => &[""],
        };
        let images = match args.layout {
            Some(StereoLayout::Separate) => views,
            _ => &[""],
        };
        let all = |path: &Path, suffixes: &[&str]| {
            let suffixes = suffixes.iter();
            suffixes.map(|suffix| suffixed(path, suffix)).collect()
        };
        Self {
            images: all(&args.output, images),
            sketches: (args.sketch.as_ref()).map_or_else(Vec::new, |sketch| all(sketch, views)),
        }
    }
}

/// Refuses a name that says the file is something else.
fn has_ending(role: &str, path: &Path, wanted: &str) -> Result<(), Failure> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ending.is_some_and(|ending| ending.eq_ignore_ascii_case(wanted)) {
        true => Ok(()),
        false => Err(Failure::Usage(format!(
            "{role} '{}': it is written as .{wanted} alone",
            path.display()
        ))),
    }
}

fn missing() -> StageError {
    StageError::Input("a view without an image".to_owned())
}

fn picture(
    stage: &Stage,
    view: usize,
    gpu: &Gpu,
    [width, height]: [u32; 2],
) -> Result<RgbaImage, Failure> {
    let texture = stage.colour(view).ok_or_else(missing)?;
    let image = RgbaImage::from_raw(width, height, read_back::texture(gpu, texture)?);
    Ok(image.ok_or_else(missing)?)
}

/// `NAME.png` and `-left` make `NAME-left.png`.
fn suffixed(path: &Path, suffix: &str) -> PathBuf {
    if suffix.is_empty() {
        return path.to_owned();
    }
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(suffix);
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

fn show_culled(
    image: &mut RgbaImage,
    stage: &Stage,
    view: usize,
    scene: &GpuScene,
    camera: &Camera,
    oracle: &mut Oracle,
) -> Result<(), Failure> {
    let verdicts = stage.verdicts(view, scene)?;
    let culled = |slot: &u32| {
        matches!(
            verdicts.get(*slot),
            Verdict::Occluded | Verdict::BelowThreshold
        )
    };
    let slots: Vec<u32> = scene.table().live_slots().filter(culled).collect();
    let hidden = oracle.render(scene, camera, EntitySet::Slots(&slots))?;
    shine_through(image, &hidden.ids);
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
