//! The scene of Antumbra: entities with transforms, boxes, meshes, materials, lights and cameras, in memory.
//!
//! This crate uses no GPU and reads no files. The world is f64 metres, right-handed, with +Y up.
//!
//! - [`Scene`] keeps entities in slotmap arenas. [`Scene::update`] propagates transforms and boxes, and reports
//!   changes.
//! - [`Camera`], [`Stereo`] and [`Frustum`] give views. [`Frustum::cull`] tests many boxes ([`BoxArray`]) at once.
//! - [`hierarchy`] has trees of boxes for culling whole subtrees.
//! - [`animation`] moves nodes, bends skinned meshes and blends morph targets: clips, sampled into a scene's pose.
//! - [`Mesh`], [`Geometry`] and [`Raster`] are plain arrays. With the feature `simplify` (meshoptimizer, C++) a mesh
//!   gets a low-resolution proxy for visibility tests.
//!
//! ```
//! use antumbra_scene::{Camera, Drawable, Material, Mesh, Projection, Scene, icosphere};
//! use glam::{DAffine3, DVec3};
//!
//! let mut scene = Scene::new();
//! let mesh = scene.add_mesh(Mesh::new("sphere", icosphere(2, 1.0)))?;
//! let material = scene.add_material(Material::default());
//! for x in [0.0, 100.0] {
//!     let entity = scene.spawn(None, DAffine3::from_translation(DVec3::X * x))?;
//!     scene.set_drawable(entity, Drawable { mesh, material })?;
//! }
//! assert_eq!(scene.update().added.len(), 2);
//!
//! let projection = Projection::Perspective { fov_y: 0.8, near: 0.1 };
//! let camera = Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y, projection)?;
//! let frustum = camera.frustum(16.0 / 9.0);
//! let bounds = scene.drawables().filter_map(|(entity, _)| scene.world_bounds(entity));
//! assert_eq!(bounds.filter(|bounds| frustum.intersects(bounds)).count(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod animation;
pub mod bounds;
mod camera;
mod collapse_work;
mod environment;
mod error;
pub mod frustum;
mod hausdorff;
pub mod hierarchy;
mod icosphere;
mod keys;
mod light;
mod material;
mod mesh;
mod part_boxes;
mod raster;
mod scene;
#[cfg(feature = "simplify")]
mod simplify;
mod solid;
mod stereo;

pub use bounds::{Aabb, BoxArray};
pub use camera::{Camera, CameraError, ClipMatrix, Projection, is_invertible};
pub use environment::Environment;
pub use error::SceneError;
pub use frustum::Frustum;
pub use icosphere::icosphere;
pub use keys::{EntityKey, ImageKey, MaterialKey, MeshKey};
pub use light::Light;
pub use material::{AlphaMode, Filter, Image, Material, Sampler, Wrap};
pub use mesh::{Geometry, Mesh, Topology};
pub use part_boxes::{PartBox, PartBoxes};
pub use raster::Raster;
pub use scene::{Drawable, PlacedLight, Scene, SceneChanges};
#[cfg(feature = "simplify")]
pub use simplify::{ProxyOptions, proxy};
pub use solid::solid_part;
pub use stereo::{Stereo, StereoError};
