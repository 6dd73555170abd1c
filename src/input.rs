//! From the command line's words to a device, a scene and a path.

use std::path::Path as FilePath;

use antumbra::draw::Gpu;
use antumbra::measure::path::{Orbit, Path};
use antumbra::scene::{Aabb, LoadOptions, Scene, builtin, load};

use crate::args::ViewArgs;
use crate::failure::Failure;

/// A scene with its name, and what fits it where the command line is silent.
pub struct Input {
    /// The scene, with proxies.
    pub scene: Scene,
    /// What reports call it.
    pub name: String,
    /// The camera path.
    pub path: Path,
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// What a built-in scene was made from; `None` for a file.
    pub scene_seed: Option<u64>,
}

/// File endings that scenes have.
const ENDINGS: [&str; 5] = ["glb", "gltf", "obj", "ply", "stl"];

/// Without a scene named, a software adapter gets a smaller one, so that the answer comes within a minute.
const SMALL: (&str, u32, [u32; 2]) = ("grid:14", 30, [640, 512]);
const FULL: (&str, u32, [u32; 2]) = ("grid", 120, [1280, 1024]);

impl Input {
    /// Loads or builds what the arguments name.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a name nothing answers to; what is wrong with a file otherwise.
    pub fn open(args: &ViewArgs, gpu: &Gpu) -> Result<Self, Failure> {
        let (default_scene, frames, size) = if args.scene.is_none() && gpu.is_cpu() {
            SMALL
        } else {
            FULL
        };
        let named = args.scene.as_deref().unwrap_or(default_scene);
        let size = args.size.map_or(size, |size| size.0);
        let frames = args.frames.unwrap_or(frames) as usize;
        let (mut scene, scene_seed) = scene(named)?;
        scene.ensure_proxies(&Default::default());
        scene.update();
        let path = path(args, named, &scene, size, frames)?;
        let name = FilePath::new(named)
            .file_name()
            .map_or(named.to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self {
            scene,
            name,
            path,
            size,
            scene_seed,
        })
    }
}

/// The scene, and the seed of a built-in one.
fn scene(named: &str) -> Result<(Scene, Option<u64>), Failure> {
    let file = FilePath::new(named);
    let ending = file
        .extension()
        .and_then(|ending| ending.to_str())
        .unwrap_or_default()
        .to_lowercase();
    if file.is_file() || ENDINGS.contains(&ending.as_str()) {
        let loaded = load(file, &LoadOptions::default()).map_err(|error| Failure::Load {
            path: file.to_owned(),
            error,
        });
        return Ok((loaded?, None));
    }
    if file.exists() || named.contains(['/', '\\']) {
        let known = ENDINGS.map(|ending| format!(".{ending}")).join(", ");
        return Err(Failure::Usage(format!(
            "'{named}' is no scene: name a file ({known}) or a built-in scene ({})",
            builtin::names().join(", ")
        )));
    }
    let (name, size) = match named.split_once(':') {
        Some((name, size)) => {
            let size = size
                .parse()
                .map_err(|_| Failure::Usage(format!("'{size}' is no size: write {name}:12")))?;
            (name, Some(size))
        }
        None => (named, None),
    };
    let scene = builtin::by_name(name, size)?;
    Ok((scene, Some(builtin::GridOptions::default().seed)))
}

fn path(
    args: &ViewArgs,
    named: &str,
    scene: &Scene,
    size: [u32; 2],
    frames: usize,
) -> Result<Path, Failure> {
    let nothing = Aabb::new(glam::DVec3::NEG_ONE, glam::DVec3::ONE);
    let bounds = scene.bounds().unwrap_or(nothing);
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    match args.path.as_str() {
        // The grid's own orbit, whole grid or a part of it.
        "orbit" if named == "grid" => Ok(Path::orbit(&Orbit::grid(frames))?),
        "orbit" => Ok(Path::orbit_around(&bounds, aspect, frames)?),
        "flight" => Ok(Path::flight(&bounds, args.seed, frames)?),
        file => Ok(Path::load(file)?),
    }
}
