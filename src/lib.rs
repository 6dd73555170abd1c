//! Antumbra: a render graph on wgpu in which occlusion culling is a stage made of nodes.
//!
//! A culling strategy is a plug-in: it adds its passes to the graph and says what the shaded pass shall draw. Several published
//! strategies come with it, an oracle says what each of them got wrong, and a harness says what each of them cost.
//!
//! | room | what is in it |
//! |---|---|
//! | [`graph`] | passes and resources, compiled into a checked plan and run as wgpu commands; read-back; timing |
//! | [`scene`] | entities in arenas, transforms, bounds, cameras, scene files; knows no GPU |
//! | [`shaders`] | WGSL, checked and reflected |
//! | [`draw`] | meshes on the GPU, draw lists, pipelines, passes |
//! | [`cull`] | strategies, visible sets, sample counts, the conformance kit |
//! | [`measure`] | camera paths, comparisons, image errors, the report |
//! | [`subsurface`] | horizons, faults, seismic slices and lenses made into a scene |
//! | [`terrain`] | height fields, their horizons, groups of triangles that hide together |
//!
//! Drawing a scene under a strategy:
//!
//! ```no_run
//! use antumbra::cull::{Registry, Stage, StageOptions, ViewInput, ViewSpec};
//! use antumbra::draw::{AdapterChoice, Gpu, GpuScene};
//! use antumbra::scene::{Camera, Projection, builtin};
//! use glam::DVec3;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let gpu = Gpu::open(&AdapterChoice::Auto)?;
//! let mut scene = builtin::by_name("grid", Some(8))?;
//! scene.ensure_proxies(&Default::default());
//! let mut on_gpu = GpuScene::new(&gpu, &mut scene)?;
//!
//! let strategy = Registry::built_in().parse("three-pass:latency=frame-late")?;
//! let mut stage = Stage::new(&on_gpu, strategy, vec![ViewSpec::main(1280, 1024)], StageOptions::default())?;
//! let projection = Projection::Perspective { fov_y: 0.8, near: 0.1 };
//! for frame in 0..60 {
//!     let eye = DVec3::new(20.0, 5.0, 20.0 - f64::from(frame) * 0.1);
//!     let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y, projection)?;
//!     on_gpu.sync(&mut scene)?;
//!     stage.frame(&on_gpu, &[ViewInput::new(camera)])?;
//! }
//! # Ok(())
//! # }
//! ```

pub use antumbra_cull as cull;
pub use antumbra_draw as draw;
pub use antumbra_graph as graph;
pub use antumbra_measure as measure;
pub use antumbra_scene as scene;
pub use antumbra_shaders as shaders;
pub use antumbra_subsurface as subsurface;
pub use antumbra_terrain as terrain;
