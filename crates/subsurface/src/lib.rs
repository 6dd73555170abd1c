//! Sub-surface models: horizons, faults, seismic slices and lenses made into a scene. Nothing here needs a GPU.
//!
//! The system is that of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific
//! Applications*, 2004.
//!
//! - [`read`] takes surfaces and cell properties out of files; a [`Surface`] is a horizon or a fault at full resolution, wherever it came from.
//! - [`prepare_surface`] cuts horizons into tiles, each with levels of detail and a stand-in for tests; [`PreparedSurface::spawn`] puts them into a scene.
//! - [`VolumeFile`], [`BrickCache`]: seismic volumes of any size under a budget; [`Slice`] and [`Lens`] show sections of them, [`VolumeSections`] several.
//!
//! ```no_run
//! use antumbra_subsurface::{PrepareOptions, add_default_lights, prepare_surfaces, read, surface_material};
//!
//! let surfaces = read::surfaces("top.gri".as_ref(), &Default::default(), &mut |_, _| ())?;
//! let prepared = prepare_surfaces(&surfaces, &PrepareOptions::default(), &|_| ())?;
//! let mut scene = antumbra_scene::Scene::new();
//! for (index, surface) in prepared.into_iter().enumerate() {
//!     let material = scene.add_material(surface_material(&surface.name, surface.kind, index));
//!     let shown = surface.spawn(&mut scene, None, material)?;
//!     // Moving or removing shown.root moves or removes the whole surface, while the program runs.
//!     println!("{} in {} tiles", shown.name, shown.tiles.len());
//! }
//! add_default_lights(&mut scene)?;
//! # Ok::<(), antumbra_subsurface::SubsurfaceError>(())
//! ```

mod assemble;
mod colour;
pub mod corner_point;
mod error;
mod height_field;
mod lens;
mod prepare;
mod progress;
#[cfg(feature = "read")]
pub mod read;
mod sections;
mod show;
mod slice;
mod surface;
mod volume;

pub use error::SubsurfaceError;
pub use lens::{AxisEnd, Lens, LensOptions, StackOrientation};
pub use prepare::{
    PrepareOptions, PreparedSurface, SurfaceTile, prepare_surface, prepare_surfaces,
};
pub use sections::{SectionPositions, SlicePosition, VolumeSections};
pub use show::{SurfaceEntities, add_default_lights, surface_material};
pub use slice::{PagingReport, Slice, SliceOptions, SliceTile};
pub use surface::{Surface, SurfaceKind};
pub use volume::{
    Axis, BrickCache, BrickCacheStats, BrickSource, ColourMap, SampleBox, VolumeFile, VolumeLayout,
    write_volume,
};
