//! Sub-surface models: horizons, faults, seismic slices and lenses in a scene. Nothing here needs a GPU.
//!
//! The system is that of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in
//! Geo-Scientific Applications*, 2004.
//!
//! - `read` (feature `read`, on by default) reads surfaces and cell properties from files. A [`Surface`] is a horizon
//!   or a fault at full resolution, from any source.
//! - `segy` (feature `read`) reads seismic volumes from SEG-Y files.
//! - [`prepare_surface`] cuts horizons into tiles with levels of detail and a proxy for visibility tests.
//!   [`PreparedSurface::spawn`] adds them to a scene.
//! - [`VolumeFile`] and [`BrickCache`] read seismic volumes of any size within a memory budget. [`Slice`] and
//!   [`Lens`] show sections of them, [`VolumeSections`] shows several.
//!
//! ```
//! use antumbra_scene::{Raster, Scene};
//! use antumbra_subsurface::{PrepareOptions, Surface, add_default_lights, prepare_surfaces, surface_material};
//! use glam::DVec2;
//!
//! let raster = Raster {
//!     columns: 65,
//!     rows: 65,
//!     origin: DVec2::ZERO,
//!     step_u: DVec2::new(25.0, 0.0),
//!     step_v: DVec2::new(0.0, 25.0),
//!     elevation: (0..65 * 65).map(|node| -1000.0 + (node % 65) as f32).collect(),
//! };
//! // With the feature `read`: read::surfaces("top.gri".as_ref(), &Default::default(), &mut |_, _| ())?
//! let surfaces = [Surface::from_raster(&raster, "top")?];
//!
//! let prepared = prepare_surfaces(&surfaces, &PrepareOptions::default(), &|_| ())?;
//! let mut scene = Scene::new();
//! for (index, surface) in prepared.into_iter().enumerate() {
//!     let material = scene.add_material(surface_material(&surface.name, surface.kind, index));
//!     let entities = surface.spawn(&mut scene, None, material)?;
//!     // Moving or removing entities.root moves or removes the whole surface, at any time.
//!     assert_eq!(entities.tiles.len(), 100);
//! }
//! add_default_lights(&mut scene)?;
//! # Ok::<(), antumbra_subsurface::SubsurfaceError>(())
//! ```

mod assemble;
pub mod corner_point;
mod error;
mod height_field;
mod image;
mod lens;
mod paging;
mod palette;
mod prepare;
mod progress;
#[cfg(feature = "read")]
pub mod read;
mod sections;
#[cfg(feature = "read")]
pub mod segy;
mod slice;
mod surface;
mod surface_entities;
#[cfg(feature = "read")]
mod survey;
mod volume;

pub use error::SubsurfaceError;
pub use lens::{AxisEnd, Lens, LensOptions, StackOrientation};
pub use paging::PagingReport;
pub use prepare::{
    PrepareOptions, PreparedSurface, SurfaceTile, prepare_surface, prepare_surfaces,
};
pub use progress::ProgressFn;
pub use sections::{SectionPositions, SlicePosition, VolumeSections};
pub use slice::{Slice, SliceOptions, SliceTile};
pub use surface::{Surface, SurfaceKind};
pub use surface_entities::{SurfaceEntities, add_default_lights, surface_material};
pub use volume::{
    Axis, BrickCache, BrickCacheStats, BrickSource, ColourMap, SampleBox, VolumeFile, VolumeLayout,
    write_volume,
};
