//! What the command line takes.

use std::path::PathBuf;
use std::str::FromStr;

use antumbra::cull::{Latency, Range};
use antumbra::draw::AdapterChoice;
use antumbra::measure::MeasureError;
use antumbra::measure::stereo_picture::StereoLayout;
use antumbra::measure::trade_off::ErrorLimit;
use antumbra::subsurface::{Axis, SampleBox};
use antumbra::terrain::Method;
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

use crate::eyes::StereoArgs;

/// Compares occlusion culling strategies: what each costs, and what each gets wrong.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    compare: CompareArgs,
}

impl Args {
    /// Without a verb: compare.
    pub fn command(self) -> Command {
        self.command.unwrap_or(Command::Compare(self.compare))
    }
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a scene under several strategies along a camera path, and say what each cost and got wrong
    Compare(CompareArgs),
    /// Draw a scene under many settings of a strategy, and show the trade: speed against error
    Sweep(SweepArgs),
    /// Draw one image
    Render(RenderArgs),
    /// Print the graph of a strategy
    Graph(GraphArgs),
    /// Make a terrain of a raster or a mesh, a scene of horizons, faults and picks, or a seismic volume of cell properties
    Prepare(PrepareArgs),
    /// List adapters, their features and limits, and which ways of counting each allows
    Doctor,
}

/// What decides a scene and how it is looked at.
#[derive(Debug, Clone, ClapArgs)]
pub struct ViewArgs {
    /// A file (.glb, .gltf, .obj, .ply, .stl, CityJSON as .json or .jsonl; a raster .npz, .tif, .asc becomes a terrain) or a built-in scene (subsurface, terrain, grid, layer, turbine, city), with a size and settings if need be (grid:12,
    /// subsurface:200:tiles=5)
    pub scene: Option<String>,
    /// The camera path: orbit, flight, a view of the scene's (open and occluded of subsurface), or a JSON file of poses; where none is
    /// named, subsurface is flown through, terrain is flown over, and others are circled
    #[arg(long)]
    pub path: Option<String>,
    /// A seismic volume to show sections of, as `prepare` writes it
    #[arg(long, value_name = "FILE")]
    pub volume: Option<PathBuf>,
    /// A slice of the volume, AXIS inline, crossline or time; three in the middle where neither slice nor lens is asked for
    #[arg(long, value_name = "AXIS=SAMPLE")]
    pub slice: Vec<SliceAt>,
    /// A semi-transparent box of the volume: first and last sample along the inline, crossline and time axis
    #[arg(long, value_name = "I..I,C..C,T..T")]
    pub lens: Vec<LensAt>,
    /// Poses of the path
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: Option<u32>,
    /// Width and height of the image in pixels
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// Two eyes, if any.
    #[command(flatten)]
    pub eyes: StereoArgs,
    /// Seed of a flight
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// auto, cpu, gpu, or part of an adapter's name or backend
    #[arg(long, default_value = "auto")]
    pub adapter: AdapterChoice,
}

/// Arguments of `compare`.
#[derive(Debug, Clone, ClapArgs)]
pub struct CompareArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// Strategies, each NAME or NAME:key=value:key=value
    #[arg(long, value_delimiter = ',', value_name = "A,B")]
    pub strategies: Vec<String>,
    /// A setting of all strategies of that name
    #[arg(long, value_name = "STRATEGY.KEY=VALUE")]
    pub set: Vec<String>,
    /// When the answers of queries are used, for strategies that ask any: frame-late, same-frame, on-gpu
    #[arg(long, value_parser = latency)]
    pub latency: Option<Latency>,
    /// Each strategy once more, auditing itself: its own estimate of its wrong pixels, beside the truth, and what that costs. It may draw this
    /// part of its triangles again
    #[arg(long, value_name = "SHARE", num_args = 0..=1, require_equals = true, value_parser = share)]
    pub audit: Option<Option<f64>>,
    /// Each strategy that can trade once more, with a budget in place of settings: wrong_pixels=0.02% or frame_time=16ms
    #[arg(long, value_name = "WHAT=MOST")]
    pub budget: Vec<antumbra::cull::Budget>,
    /// Where report.json and report.html go
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `sweep`.
#[derive(Debug, Clone, ClapArgs)]
pub struct SweepArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// The strategy whose settings are varied, NAME or NAME:key=value; of several each is
    #[arg(long, value_delimiter = ',', value_name = "A,B", required = true)]
    pub strategy: Vec<String>,
    /// A setting and the values it takes, of every strategy named or, as STRATEGY.KEY, of one alone; several settings take all
    /// combinations. 1..8 is each whole number from 1 to 8, 0..1+0.25 are steps of a quarter, 1..256*4 is four times more each time (from 0:
    /// 0, 1, 4, ...)
    #[arg(long, value_name = "KEY=V1,V2", required = true)]
    pub vary: Vec<String>,
    /// A setting that stays as it is, of all strategies of that name
    #[arg(long, value_name = "STRATEGY.KEY=VALUE")]
    pub set: Vec<String>,
    /// The most error that is put up with, to name the fastest setting within it: wrong_pixels=0.05%, false_culls=3 or flip=0.01
    #[arg(long, value_name = "ERROR=MOST", value_parser = budget)]
    pub budget: Vec<ErrorLimit>,
    /// Where report.json, report.html and trade.svg go
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `render`.
#[derive(Debug, ClapArgs)]
pub struct RenderArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// The image to write, a PNG; of separate eyes NAME-left.png and NAME-right.png
    #[arg(short, long)]
    pub output: PathBuf,
    /// How two eyes' images are put together, for --stereo: side-by-side (where none is named), separate, or red-cyan
    #[arg(long)]
    pub layout: Option<StereoLayout>,
    /// The strategy, NAME or NAME:key=value
    #[arg(long, default_value = "frustum")]
    pub strategy: String,
    /// Which pose of the path, from 0
    #[arg(long, default_value_t = 0)]
    pub pose: u32,
    /// Show what was culled, shining through in magenta
    #[arg(long)]
    pub show_culled: bool,
    /// A second picture, an SVG for a browser: the occupancy map, and every node that was met with its batch and its answer; for strategies
    /// that can leave a sketch
    #[arg(long, value_name = "FILE.svg")]
    pub sketch: Option<PathBuf>,
}

/// Arguments of `graph`.
#[derive(Debug, ClapArgs)]
pub struct GraphArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// The strategy, NAME or NAME:key=value
    #[arg(long)]
    pub strategy: String,
    /// How it is written
    #[arg(long, value_enum, default_value_t = Format::Dot)]
    pub format: Format,
}

/// How a graph is written.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Format {
    /// For Graphviz
    Dot,
    /// For Markdown pages
    Mermaid,
    /// For programs
    Json,
}

/// Arguments of `prepare`.
#[derive(Debug, ClapArgs)]
pub struct PrepareArgs {
    /// Files of horizons and faults: Irap surfaces (.gri, .irap), ROFF grids, GOCAD TSurfs (.ts), faultroom JSON, picks (.csv), rasters (.asc,
    /// .tif); for a volume a ROFF property; for a terrain one raster (.npz, .asc, .tif) or mesh (.glb, .gltf, .obj, .ply, .stl); or what is
    /// built in (subsurface, subsurface:200, terrain, terrain:20000:seed=3)
    #[arg(required = true)]
    pub input: Vec<PathBuf>,
    /// What a scene is made of the input: a terrain with its horizons, or horizons and faults below the ground; where it is not said, .npz,
    /// meshes and the built-in terrain become a terrain, and all else, .asc and .tif too, becomes sub-surface
    #[arg(long = "as", value_enum, value_name = "WHAT")]
    pub made: Option<Made>,
    #[command(flatten)]
    pub terrain: TerrainArgs,
    /// What to write: a scene (.glb) or a volume (.vol)
    #[arg(short, long)]
    pub output: PathBuf,
    /// Tiles along each side of a horizon, 1 to 64
    #[arg(long, default_value_t = 10)]
    pub tiles: u32,
    /// Triangles of a surface for each of its low-resolution version
    #[arg(long, default_value_t = 100.0)]
    pub decimation: f64,
    /// Triangles of the source for each of the high-resolution version
    #[arg(long, default_value_t = 1.0)]
    pub thinning: f64,
    /// Coarser levels of detail between the two, 0 to 4
    #[arg(long, default_value_t = 2)]
    pub levels: u32,
    /// Which way z grows in the files, where not as is their custom
    #[arg(long, value_enum)]
    pub positive: Option<Way>,
    /// What triangle files (GOCAD, faultroom) hold, where not faults
    #[arg(long, value_enum)]
    pub kind: Option<Kind>,
    /// Triangles between picks with a longer edge are holes, in metres; four times the usual where none is named
    #[arg(long, value_name = "METRES")]
    pub longest_edge: Option<f64>,
    /// The column that names a pick's surface
    #[arg(long, value_name = "NAME")]
    pub surface_column: Option<String>,
    /// The ROFF grid whose cells a property belongs to
    #[arg(long, value_name = "FILE")]
    pub grid: Option<PathBuf>,
    /// Samples of a property's volume; two a cell where none are named
    #[arg(long, value_name = "IxCxT")]
    pub samples: Option<Samples>,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// What is made of rasters and meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Made {
    /// One surface, seen from above, with its horizons
    Terrain,
    /// Horizons and faults, cut into tiles
    Subsurface,
}

/// How a terrain is made.
#[derive(Debug, Default, Clone, PartialEq, ClapArgs)]
#[command(next_help_heading = "Terrains")]
pub struct TerrainArgs {
    /// Vertices of the field over a raster; 100,000 where neither these nor an error are named
    #[arg(long, conflicts_with = "error")]
    pub vertices: Option<usize>,
    /// How far a raster's posts may lie above or below the field, in metres
    #[arg(long, value_name = "METRES")]
    pub error: Option<f64>,
    /// Sectors of directions, 4 to 1024; 32 where none are named
    #[arg(long)]
    pub sectors: Option<u32>,
    /// Sub-sectors of each sector, 1 to 1024; 4 where none are named
    #[arg(long)]
    pub parts: Option<u32>,
    /// Reaches that horizons are found for, 1 to 8; 1 where none is named
    #[arg(long)]
    pub reaches: Option<u32>,
    /// How horizons are found: sound, rays or thesis; sound where none is named
    #[arg(long, value_parser = method)]
    pub method: Option<Method>,
    /// Seeds that groups are grown from; one for every 200 triangles where none are named
    #[arg(long)]
    pub seeds: Option<u32>,
    /// The seed of chance that casts those, and of the built-in landscape
    #[arg(long)]
    pub seed: Option<u64>,
}

/// Which way z grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Way {
    /// Depths
    Down,
    /// Elevations
    Up,
}

/// What a surface is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// Cut into tiles
    Horizon,
    /// Kept whole
    Fault,
}

/// Samples along three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Samples(pub [u32; 3]);

impl FromStr for Samples {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides: Vec<u32> = text
            .split('x')
            .map_while(|side| side.parse().ok())
            .collect();
        let whole = text.split('x').count() == 3;
        <[u32; 3]>::try_from(sides)
            .ok()
            .filter(|sides| whole && sides.iter().all(|side| *side > 0))
            .map(Self)
            .ok_or_else(|| "write it as 256x256x128".to_owned())
    }
}

/// Where a slice lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceAt(pub Axis, pub u32);

impl FromStr for SliceAt {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (axis, sample) = text.split_once('=').unwrap_or((text, ""));
        let axis = Axis::ALL
            .into_iter()
            .find(|known| known.to_string() == axis);
        match (axis, sample.parse()) {
            (Some(axis), Ok(sample)) => Ok(Self(axis, sample)),
            _ => Err("write it as inline=120, crossline=80 or time=300".to_owned()),
        }
    }
}

/// Where a lens lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LensAt(pub SampleBox);

impl FromStr for LensAt {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = |part: &str| {
            let (first, last) = part.split_once("..")?;
            Some((first.parse().ok()?, last.parse().ok()?))
        };
        let parts: Vec<(u32, u32)> = text.split(',').map_while(ends).collect();
        match parts.as_slice() {
            [i, c, t] if text.split(',').count() == 3 => Ok(Self(SampleBox {
                min: [i.0, c.0, t.0],
                max: [i.1, c.1, t.1],
            })),
            _ => Err("write it as 100..180,60..120,200..320".to_owned()),
        }
    }
}

/// An image's width and height in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text
            .split_once('x')
            .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        match sides {
            Some([w, h]) if (1..=16_384).contains(&w) && (1..=16_384).contains(&h) => {
                Ok(Self([w, h]))
            }
            _ => Err("write it as 1280x1024; each side is 1 to 16384".to_owned()),
        }
    }
}

fn method(text: &str) -> Result<Method, String> {
    text.parse()
        .map_err(|()| "it takes sound, rays or thesis".to_owned())
}

fn budget(text: &str) -> Result<ErrorLimit, String> {
    text.parse()
        .map_err(|error: MeasureError| error.to_string())
}

fn share(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|share| *share > 0.0 && *share <= 1.0)
        .ok_or_else(|| "it takes a number above 0, at most 1".to_owned())
}

fn latency(text: &str) -> Result<Latency, String> {
    text.parse()
        .map_err(|()| format!("it takes {}", Range::Words(Latency::WORDS)))
}
