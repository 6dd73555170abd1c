//! What the command line takes.

use std::path::PathBuf;
use std::str::FromStr;

use antumbra::cull::Latency;
use antumbra::draw::AdapterChoice;
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

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
    /// Draw one image
    Render(RenderArgs),
    /// Print the graph of a strategy
    Graph(GraphArgs),
    /// List adapters, their features and limits, and which ways of counting each allows
    Doctor,
}

/// What decides a scene and how it is looked at.
#[derive(Debug, Clone, ClapArgs)]
pub struct ViewArgs {
    /// A file (.glb, .gltf, .obj, .ply, .stl) or a built-in scene (grid), with a size if need be (grid:12)
    pub scene: Option<String>,
    /// The camera path: orbit, flight, or a JSON file of poses
    #[arg(long, default_value = "orbit")]
    pub path: String,
    /// Poses of the path
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: Option<u32>,
    /// Width and height of the image in pixels
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
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
    /// Where report.json and report.html go
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
    /// The image to write, a PNG
    #[arg(short, long)]
    pub output: PathBuf,
    /// The strategy, NAME or NAME:key=value
    #[arg(long, default_value = "frustum")]
    pub strategy: String,
    /// Which pose of the path, from 0
    #[arg(long, default_value_t = 0)]
    pub pose: u32,
    /// Show what was culled, shining through in magenta
    #[arg(long)]
    pub show_culled: bool,
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

fn latency(text: &str) -> Result<Latency, String> {
    text.parse()
        .map_err(|()| format!("it takes {}", antumbra::cull::LATENCY_RANGE))
}
