//! Arguments of `prepare`.

use std::path::PathBuf;

use antumbra::formats::Units;
use antumbra::terrain::Method;
use clap::{Args as ClapArgs, ValueEnum};

use super::load::LoadArgs;
use super::segy::SegyArgs;
use super::value::{Samples, method};

/// Arguments of `prepare`.
#[derive(Debug, ClapArgs)]
pub struct PrepareArgs {
    /// Horizons and faults: Irap surfaces (.gri, .irap), ZMAP+ (.zmap), CPS-3 (.cps3), ROFF and Eclipse grids (.roff, .grdecl, .egrid), GOCAD
    /// TSurfs (.ts), faultroom JSON, picks and points (.csv, .dat, .xyz), rasters (.asc, .grd, .npz, .tif). For a volume a SEG-Y file (.segy,
    /// .sgy), or a property of a grid's cells (.roff, .grdecl, .init, .unrst). For a terrain one raster or mesh (.glb, .gltf, .obj, .ply,
    /// .stl). Or a built-in model: subsurface, subsurface:200, terrain, terrain:20000:seed=3
    #[arg(required = true)]
    pub input: Vec<PathBuf>,
    /// The file to write: a scene (.glb) or a volume (.vol)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// What the input becomes: a terrain with its horizons, or horizons and faults below the ground. By default one raster alone, meshes and
    /// the built-in terrain become a terrain; several rasters and all else become sub-surface
    #[arg(long = "as", value_enum, value_name = "WHAT")]
    pub made: Option<Made>,
    /// The unit of places and heights in the files: m, ft, us-ft, degrees, or one for places and one for heights, as degrees,ft. By default what
    /// each file says; a line says what was assumed
    #[arg(long, value_name = "PLACES[,HEIGHTS]")]
    pub units: Option<Units>,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
    #[command(flatten, next_help_heading = "Scene files")]
    pub load: LoadArgs,
    #[command(flatten, next_help_heading = "Terrains")]
    pub terrain: TerrainArgs,
    #[command(flatten, next_help_heading = "Sub-surface models")]
    pub subsurface: SubsurfaceArgs,
    #[command(flatten, next_help_heading = "SEG-Y files")]
    pub segy: SegyArgs,
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
pub struct TerrainArgs {
    /// Vertices of the field over a raster; by default 100,000, unless --error is given
    #[arg(long, conflicts_with = "error")]
    pub vertices: Option<usize>,
    /// The largest vertical distance between the field and a raster's posts, in metres
    #[arg(long, value_name = "METRES")]
    pub error: Option<f64>,
    /// Sectors of directions, 4 to 1024; by default 32
    #[arg(long)]
    pub sectors: Option<u32>,
    /// Sub-sectors of each sector, 1 to 1024; by default 4
    #[arg(long)]
    pub parts: Option<u32>,
    /// Distances for which a horizon is computed, 1 to 8; by default 1
    #[arg(long)]
    pub reaches: Option<u32>,
    /// How horizons are computed: sound (the default), rays or thesis
    #[arg(long, value_parser = method)]
    pub method: Option<Method>,
    /// Seeds from which groups grow; by default one for every 200 triangles
    #[arg(long)]
    pub seeds: Option<u32>,
    /// The random seed that places those seeds, and that of the built-in landscape
    #[arg(long)]
    pub seed: Option<u64>,
}

/// How horizons, faults and volumes are made.
#[derive(Debug, ClapArgs)]
pub struct SubsurfaceArgs {
    /// Tiles along each side of a horizon, 1 to 64
    #[arg(long, default_value_t = 10)]
    pub tiles: u32,
    /// Triangles of a surface for each triangle of its low-resolution version
    #[arg(long, default_value_t = 100.0)]
    pub decimation: f64,
    /// Triangles of the source for each triangle of the high-resolution version
    #[arg(long, default_value_t = 1.0)]
    pub thinning: f64,
    /// Coarser levels of detail between the two, 0 to 4
    #[arg(long, default_value_t = 2)]
    pub levels: u32,
    /// The direction in which z grows in the files; by default that of the format
    #[arg(long, value_enum)]
    pub positive: Option<Way>,
    /// What triangle files (GOCAD, faultroom) hold; by default faults
    #[arg(long, value_enum)]
    pub kind: Option<Kind>,
    /// The longest edge of a triangle between picks, in metres; longer ones leave a hole. By default four times the median
    #[arg(long, value_name = "METRES")]
    pub longest_edge: Option<f64>,
    /// The column with the name of a pick's surface
    #[arg(long, value_name = "NAME")]
    pub surface_column: Option<String>,
    /// The grid whose cells a property belongs to: .roff, .grdecl or .egrid
    #[arg(long, value_name = "FILE")]
    pub grid: Option<PathBuf>,
    /// The property to take of a file that has several, such as PORO
    #[arg(long, value_name = "NAME")]
    pub property: Option<String>,
    /// Samples of a property's volume; by default two for each cell
    #[arg(long, value_name = "IxCxT")]
    pub samples: Option<Samples>,
}

/// The direction in which z grows.
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
