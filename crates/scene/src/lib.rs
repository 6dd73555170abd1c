//! Antumbra's scenes: entities in slotmap arenas with transforms, bounds, cameras, lights and a hierarchy, in memory. This crate knows no GPU and no file; the world is f64 metres, right-handed, +Y up.

pub mod bounds;
mod camera;
mod deviation;
mod environment;
mod error;
pub mod frustum;
pub mod hierarchy;
mod icosphere;
mod keys;
mod light;
mod material;
mod mesh;
mod raster;
mod scene;
#[cfg(feature = "simplify")]
mod simplify;
mod stereo;

pub use bounds::{Aabb, BoxArray};
pub use camera::{Camera, CameraError, Projection};
pub use environment::Environment;
pub use error::SceneError;
pub use frustum::Frustum;
pub use icosphere::icosphere;
pub use keys::{EntityKey, ImageKey, MaterialKey, MeshKey};
pub use light::Light;
pub use material::{AlphaMode, Filter, Image, Material, Sampler, Wrap};
pub use mesh::{Geometry, Mesh, Topology};
pub use raster::Raster;
pub use scene::{Drawable, PlacedLight, Scene, SceneChanges};
#[cfg(feature = "simplify")]
pub use simplify::{ProxyOptions, proxy};
pub use stereo::{Stereo, StereoError};
