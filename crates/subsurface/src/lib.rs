//! Sub-surface models: horizons, faults, seismic slices and lenses made into a scene. Nothing here needs a GPU.
//!
//! The system is that of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific
//! Applications*, 2004.
//!
//! - [`Surface`] is a horizon or a fault at full resolution, wherever it came from.

mod assemble;
mod built_in;
pub mod corner_point;
mod error;
mod height_field;
mod lens;
mod model;
mod prepare;
pub mod read;
mod sections;
mod show;
mod slice;
mod surface;
mod volume;

pub use built_in::{BuiltIn, BuiltInOptions};
pub use error::SubsurfaceError;
pub use height_field::HeightField;
pub use lens::{Facing, Lens, LensOptions};
pub use model::{Fault, Model, ModelOptions, ModelVolume, View, Well};
pub use prepare::{PrepareOptions, Prepared, Tile, prepare, prepare_all};
pub use sections::{SectionPlaces, Sections};
pub use show::{ShownSurface, add_lamps, surface_material};
pub use slice::{Paged, Slice, SliceOptions, SliceTile};
pub use surface::{Surface, SurfaceKind};
pub use volume::{
    Axis, BrickCounters, BrickSource, Bricks, ColourMap, SampleBox, VolumeFile, VolumeLayout,
    write_volume,
};
