//! Scene files: reading of glTF, OBJ, PLY, STL and CityJSON, writing of glTF, and reading of rasters of elevations.
//!
//! Files are treated as hostile: sizes that a file declares are checked against its length before memory is
//! allocated, within the limits of [`LoadOptions`]. Every error names the file and the remedy.
//!
//! What a reader can do without, such as an image, is left out, and [`LoadedScene::left_out`] says so: nothing is lost in
//! silence.
//!
//! There is one folder or file per format (`gltf`, `obj`, `ply`, `stl`, `cityjson`, `raster`). `load` chooses among
//! the scene formats. `options` and `budget` limit what a file may use, `file_resolver` and `image` read what it
//! refers to, `text`, `polygon`, `local_origin` and `emission` are what several formats share.
//!
//! ```
//! use antumbra_formats::{LoadOptions, SceneFormat, load, load_slice, save_glb};
//!
//! let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
//! let mut scene = load_slice(SceneFormat::Obj, text, None, &LoadOptions::default())?;
//! scene.update();
//! assert_eq!(scene.triangle_count(), 1);
//!
//! let file = std::env::temp_dir().join("antumbra-formats-example.glb");
//! save_glb(&scene, &file)?;
//! assert_eq!(load(&file, &LoadOptions::default())?.triangle_count(), 1);
//! # std::fs::remove_file(&file)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod budget;
mod cityjson;
mod emission;
mod error;
mod file_resolver;
mod gltf;
mod image;
#[cfg(feature = "basisu")]
mod ktx2;
mod left_out;
mod load;
mod local_origin;
mod normals;
mod obj;
mod options;
mod ply;
mod polygon;
pub mod raster;
mod read_scene;
mod single;
mod stl;
mod text;
pub mod units;

pub use error::{LoadError, LoadProblem};
pub use gltf::{Attachment, SaveError, SaveProblem, save_glb, save_glb_with_attachments};
pub use left_out::{LeftOut, Loss, LostPart};
pub use load::{
    LoadedScene, SceneFormat, load, load_slice, load_slice_with_attachments, load_with_attachments,
};
pub use options::LoadOptions;
pub use raster::{
    LoadedRaster, RasterError, RasterFormat, RasterOptions, load_raster, load_raster_slice,
    load_raster_slice_with, load_raster_with,
};
pub use units::{LengthUnit, PlanUnit, SaidUnits, Units};
