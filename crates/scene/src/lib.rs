//! Antumbra's scenes: entities in slotmap arenas with transforms, bounds, cameras, lights and a hierarchy, and the files they
//! come from. This crate knows no GPU; the world is f64 metres, right-handed, +Y up.

mod attachment;
pub mod bounds;
pub mod builtin;
mod camera;
mod deviation;
mod environment;
mod error;
pub mod frustum;
pub mod hierarchy;
mod keys;
mod light;
mod load;
mod material;
mod mesh;
pub mod raster;
mod save;
mod scene;
mod simplify;
mod stereo;
mod whole_file;

pub use attachment::Attachment;
pub use bounds::{Aabb, BoxArray};
pub use camera::{Camera, CameraError, Projection};
pub use environment::Environment;
pub use error::SceneError;
pub use frustum::Frustum;
pub use keys::{EntityKey, ImageKey, MaterialKey, MeshKey};
pub use light::Light;
pub use load::{
    Format, LoadError, LoadOptions, LoadProblem, Loaded, load, load_gltf_slice, load_slice,
    load_slice_with, load_with,
};
pub use material::{AlphaMode, Filter, Image, Material, Sampler, Wrap};
pub use mesh::{Geometry, Mesh, Topology};
pub use raster::{Raster, RasterError, RasterFormat};
pub use save::{SaveError, SaveProblem, save_glb, save_glb_with};
pub use scene::{Changes, Drawable, Scene};
pub use simplify::{ProxyOptions, proxy};
pub use stereo::{Stereo, StereoError};
pub use whole_file::whole_file;
