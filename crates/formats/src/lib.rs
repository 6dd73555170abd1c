//! Scene files in and out: glTF, OBJ, PLY, STL and CityJSON, and rasters of elevations. One folder or file a format.
//!
//! Files are hostile until read: what they declare is held against how long they are before any memory is asked for, and every
//! error names the file and what to do.
//!
//! ```no_run
//! use antumbra_formats::{LoadOptions, load, save_glb};
//!
//! let mut scene = load("model.obj".as_ref(), &LoadOptions::default())?;
//! scene.update();
//! save_glb(&scene, "model.glb".as_ref())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attachment;
mod budget;
mod cityjson;
mod error;
mod files;
mod gltf;
mod load;
mod obj;
mod ply;
pub mod raster;
mod stl;

pub use attachment::Attachment;
pub use error::{LoadError, LoadProblem};
pub use files::read_whole_file;
pub use gltf::{SaveError, SaveProblem, save_glb, save_glb_with_attachments};
pub use load::{
    LoadOptions, LoadedScene, SceneFormat, load, load_gltf_slice, load_slice,
    load_slice_with_attachments, load_with_attachments,
};
pub use raster::{RasterError, RasterFormat, load_raster, load_raster_slice};
