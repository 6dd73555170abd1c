//! The options of reading, for what a file does not specify.

use antumbra_formats::Units;

use crate::surface::SurfaceKind;

/// The direction of a file's third coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ZPositive {
    /// It is a depth, positive downwards.
    Down,
    /// It is an elevation, positive upwards.
    Up,
}

impl ZPositive {
    /// The elevation of a coordinate of the file, in metres.
    pub(crate) fn up(self, z: f64) -> f64 {
        match self {
            Self::Up => z,
            Self::Down => -z,
        }
    }
}

/// The options of reading, for what a file does not specify.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// The direction of z. `None` means the format's convention: down in Irap, ZMAP+, CPS-3, IJXYZ, grid and faultroom
    /// files and in picks whose column is called a depth; as specified by the file in GOCAD; up in rasters, other picks
    /// and points.
    pub z_positive: Option<ZPositive>,
    /// The kind of the surfaces of a triangle file (GOCAD, faultroom). `None` means faults. Horizons must be height
    /// fields.
    pub kind: Option<SurfaceKind>,
    /// Triangles between picks with a longer edge, in metres, are left out, so that holes and a concave outline stay.
    /// `None` means four times the median of the triangles' longest edges.
    pub longest_edge: Option<f64>,
    /// The column with the name of a pick's surface. `None` finds it: see [`surfaces`](super::surfaces).
    pub surface_column: Option<String>,
    /// Bytes of memory of everything that the file becomes, up to the prepared surfaces and their proxies. They are estimated, and taken before
    /// they are allocated. `None` means half of what the machine has free.
    pub max_memory: Option<u64>,
    /// Units that replace those that the file names.
    pub units: Units,
    /// The latitude, in degrees, about which degrees are taken to metres. `None` means the middle of the file's own;
    /// files that shall lie beside each other need one.
    pub latitude: Option<f64>,
}
