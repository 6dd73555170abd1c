//! What the command line takes.

mod load;
mod motion;
mod prepare;
mod segy;
mod value;
mod view;

use std::path::PathBuf;

use antumbra::cull::Latency;
use antumbra::measure::stereo_picture::StereoLayout;
use antumbra::measure::trade_off::ErrorLimit;
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

pub use load::LoadArgs;
pub use motion::MotionArgs;
pub use prepare::{Kind, Made, PrepareArgs, TerrainArgs, Way};
pub use value::{PathArg, SceneSetting};
pub use view::ViewArgs;

use crate::strategies::listed;

/// Compares occlusion culling strategies: what each costs, and what each gets wrong.
///
/// Without a command, `compare` runs with the options below.
#[derive(Debug, Parser)]
#[command(name = "antumbra", version, args_conflicts_with_subcommands = true)]
pub struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    compare: CompareArgs,
}

impl Args {
    /// The command; `compare` where none is named.
    pub fn command(self) -> Command {
        self.command.unwrap_or(Command::Compare(self.compare))
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a scene with several strategies along a camera path; report the cost and the errors of each
    Compare(CompareArgs),
    /// Draw a scene with many settings of a strategy; report the trade of speed against error
    Sweep(SweepArgs),
    /// Draw one image as a strategy draws it
    Render(RenderArgs),
    /// Print the render graph of a strategy, with the time of each pass
    Graph(GraphArgs),
    /// Convert rasters and meshes to terrains, horizons and faults to scenes, cell properties to seismic volumes
    Prepare(PrepareArgs),
    /// List the strategies: what each promises, and its settings with range, default and meaning
    Strategies(StrategiesArgs),
    /// List the graphics adapters, their features and limits, and the ways of counting that each supports
    Doctor(DoctorArgs),
}

/// Arguments of `compare`.
#[derive(Debug, Clone, ClapArgs)]
pub struct CompareArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "A,B",
        help = listed("The strategies to compare, each NAME or NAME:key=value:key=value. Without this option, a standard selection")
    )]
    pub strategies: Vec<String>,
    /// A setting of every strategy of that name
    #[arg(long, value_name = "STRATEGY.KEY=VALUE")]
    pub set: Vec<String>,
    /// When the results of queries are used, for strategies that issue queries: frame-late, same-frame or on-gpu
    #[arg(long, value_parser = value::latency)]
    pub latency: Option<Latency>,
    /// The frames in flight: late answers are used exactly so many frames after their own
    #[arg(long, default_value_t = 1, value_name = "FRAMES", value_parser = clap::value_parser!(u32).range(1..=8))]
    pub in_flight: u32,
    /// Run each strategy once more with an audit: its own estimate of its wrong pixels, next to the measured value, and the cost of the
    /// audit. SHARE is the part of its triangles that an audit may draw again
    #[arg(long, value_name = "SHARE", num_args = 0..=1, require_equals = true, value_parser = value::share)]
    pub audit: Option<Option<f64>>,
    /// Run each strategy that supports it once more with a budget instead of fixed settings: wrong_pixels=0.02% or frame_time=16ms
    #[arg(long, value_name = "WHAT=MOST")]
    pub budget: Vec<antumbra::cull::Budget>,
    /// The folder for report.json and report.html
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub out: PathBuf,
}

/// Arguments of `sweep`.
#[derive(Debug, Clone, ClapArgs)]
pub struct SweepArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "A,B",
        required = true,
        help = listed("The strategies whose settings are varied, each NAME or NAME:key=value:key=value")
    )]
    pub strategy: Vec<String>,
    /// A setting and the values it takes, of every strategy named or, as STRATEGY.KEY, of one alone; several settings take all
    /// combinations. 1..8 is each whole number from 1 to 8, 0..1+0.25 are steps of a quarter, 1..256*4 is four times more each time (from 0:
    /// 0, 1, 4, ...)
    #[arg(long, value_name = "KEY=V1,V2", required = true)]
    pub vary: Vec<String>,
    /// A fixed setting of every strategy of that name
    #[arg(long, value_name = "STRATEGY.KEY=VALUE")]
    pub set: Vec<String>,
    /// A limit of error; the fastest setting within it is named: wrong_pixels=0.05%, wrong_of_owned=0.05%, false_culls=3 or flip=0.01
    #[arg(long, alias = "budget", value_name = "ERROR=MOST", value_parser = value::limit)]
    pub limit: Vec<ErrorLimit>,
    /// The frames in flight: late answers are used exactly so many frames after their own
    #[arg(long, default_value_t = 1, value_name = "FRAMES", value_parser = clap::value_parser!(u32).range(1..=8))]
    pub in_flight: u32,
    /// The folder for report.json, report.html and trade.svg
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub out: PathBuf,
}

/// Arguments of `render`.
#[derive(Debug, ClapArgs)]
pub struct RenderArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// The image to write, a PNG; with separate eyes NAME-left.png and NAME-right.png
    #[arg(short, long, value_name = "FILE.png")]
    pub output: PathBuf,
    /// How the images of two eyes are put together: side-by-side (the default with --stereo), separate or red-cyan. Implies --stereo
    #[arg(long)]
    pub layout: Option<StereoLayout>,
    #[arg(
        long,
        default_value = "frustum",
        value_name = "NAME",
        help = listed("The strategy, NAME or NAME:key=value:key=value")
    )]
    pub strategy: String,
    /// The pose of the path, from 0
    #[arg(long, default_value_t = 0)]
    pub pose: u32,
    /// Overlay the culled entities in magenta
    #[arg(long)]
    pub show_culled: bool,
    /// Write a second picture, an SVG: the occupancy map, and each visited node with its batch and its query's result; for strategies with
    /// the setting `sketch`
    #[arg(long, value_name = "FILE.svg")]
    pub sketch: Option<PathBuf>,
}

/// Arguments of `graph`.
#[derive(Debug, ClapArgs)]
pub struct GraphArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    #[arg(
        long,
        value_name = "NAME",
        help = listed("The strategy, NAME or NAME:key=value:key=value")
    )]
    pub strategy: String,
    /// The output format
    #[arg(long, value_enum, default_value_t = Format::Dot)]
    pub format: Format,
}

/// The formats of a graph.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Format {
    /// For Graphviz
    Dot,
    /// For Markdown pages
    Mermaid,
    /// For programs
    Json,
}

/// Arguments of `strategies`.
#[derive(Debug, ClapArgs)]
pub struct StrategiesArgs {
    /// One strategy alone
    pub name: Option<String>,
}

/// Arguments of `doctor`.
#[derive(Debug, Clone, ClapArgs)]
pub struct DoctorArgs {
    /// Try each driver: draw, count, query and test a small picture whose answers are known. Exit status 1 if any is wrong
    #[arg(long)]
    pub self_test: bool,
}
