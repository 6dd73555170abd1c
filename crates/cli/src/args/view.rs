//! The scene, the camera path and the device: what the commands that draw have in common.

use std::path::PathBuf;
use std::time::Duration;

use antumbra::cull::AdapterChoice;
use antumbra::formats::Units;
use clap::Args as ClapArgs;

use super::load::LoadArgs;
use super::motion::MotionArgs;
use super::segy::SegyArgs;
use super::value::{LensAt, PathArg, Size, SliceAt};
use crate::eyes::StereoArgs;

/// What decides a scene and its views.
#[derive(Debug, Clone, ClapArgs)]
pub struct ViewArgs {
    /// A scene file (.glb, .gltf, .obj, .ply, .stl; CityJSON as .json or .jsonl), a raster that becomes a terrain (.npz, .tif, .asc, .grd), or a
    /// built-in scene (subsurface, terrain, grid, layer, turbine, city), which may have a size and settings: grid:12,
    /// subsurface:200:tiles=5
    pub scene: Option<String>,
    /// The camera path: orbit, flight, camera (the first camera of the scene file), camera:NAME, a view of the built-in subsurface scene
    /// (open, occluded), or a JSON file of poses. The default flies through subsurface and over terrains, and orbits other scenes
    #[arg(long)]
    pub path: Option<PathArg>,
    /// The number of poses of the path
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: Option<u32>,
    /// The seed of a flight
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The width and height of the image in pixels
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// The samples a pixel: 1, 4, or what else the adapter has
    #[arg(long, default_value_t = 1, value_parser = samples)]
    pub samples: u32,
    /// The graphics adapter: auto, cpu, gpu, or a part of its name or backend
    #[arg(long, default_value = "auto")]
    pub adapter: AdapterChoice,
    /// Print nothing but errors and, where it is a graph, the result itself
    #[arg(long)]
    pub quiet: bool,
    /// The unit of places and heights in rasters, and of SEG-Y files: m, ft, us-ft, degrees, or one for places and one for heights, as degrees,ft. By
    /// default what the file says; a line says what was assumed
    #[arg(long, value_name = "PLACES[,HEIGHTS]")]
    pub units: Option<Units>,
    /// The seconds that the adapter may take for a frame, before the run ends with an error
    #[arg(long, default_value = "600", value_name = "SECONDS", value_parser = seconds)]
    pub patience: Duration,
    #[command(flatten, next_help_heading = "Scene files")]
    pub load: LoadArgs,
    #[command(flatten, next_help_heading = "Animation")]
    pub motion: MotionArgs,
    #[command(flatten, next_help_heading = "Stereo")]
    pub eyes: StereoArgs,
    #[command(flatten, next_help_heading = "Seismic volumes")]
    pub volume: VolumeArgs,
}

/// Which sections of a seismic volume are shown.
#[derive(Debug, Clone, ClapArgs)]
pub struct VolumeArgs {
    /// A seismic volume: as `prepare` writes it (.vol), or SEG-Y (.segy, .sgy)
    #[arg(id = "volume", long = "volume", value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// A slice of the volume; AXIS is inline, crossline or time. Without --slice and --lens, one in the middle of each axis
    #[arg(long, value_name = "AXIS=SAMPLE")]
    pub slice: Vec<SliceAt>,
    /// A semi-transparent box of the volume: the first and last sample along the inline, crossline and time axis
    #[arg(long, value_name = "I..I,C..C,T..T")]
    pub lens: Vec<LensAt>,
    #[command(flatten)]
    pub segy: SegyArgs,
}

fn seconds(text: &str) -> Result<Duration, String> {
    match text.parse() {
        Ok(seconds @ 1..=1_000_000) => Ok(Duration::from_secs(seconds)),
        _ => Err("it takes whole seconds from 1 to 1000000".to_owned()),
    }
}

fn samples(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(samples @ (1 | 2 | 4 | 8 | 16)) => Ok(samples),
        _ => Err("it takes 1, 2, 4, 8 or 16".to_owned()),
    }
}

impl VolumeArgs {
    /// Whether sections are named that replace those of a built-in model.
    pub fn are_named(&self) -> bool {
        self.file.is_some() || !self.slice.is_empty() || !self.lens.is_empty()
    }
}
