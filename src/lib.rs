//! Antumbra: a render graph on wgpu in which occlusion culling is a stage made of nodes.
//!
//! A culling strategy is a plug-in: it adds its passes to the graph and says what the shaded pass shall draw. Several published
//! strategies come with it, an oracle says what each of them got wrong, and a harness says what each of them cost.
//!
//! | module | what is in it | feature |
//! |---|---|---|
//! | [`graph`] | passes and resources, compiled into a checked plan and run as wgpu commands; read-back; timing | |
//! | [`scene`] | entities in arenas, transforms, bounds, cameras, meshes in memory; knows no GPU and no file | |
//! | [`shaders`] | WGSL, checked and reflected ahead of time | |
//! | [`cull`] | the contract: strategy, visible set, stage, renderer, entities, draw sources, audit, budget; [`cull::judge`], for engines that draw by themselves | |
//! | `strategies` | the built-in strategies and their registry | `strategies`, on by default |
//! | `draw` | the built-in renderer: meshes on the GPU, pipelines, passes | `draw`, on by default |
//! | `files` | regular files in, whole files out; one writer a folder | `files` |
//! | `formats` | scene files in and out: glTF, OBJ, PLY, STL, CityJSON, rasters | `formats` |
//! | `verify` | the oracle and the conformance kit | `verify` |
//! | `measure` | camera paths, comparisons, image errors, the report | `measure` |
//! | `subsurface` | horizons, faults, seismic slices and lenses made into a scene | `subsurface` |
//! | `terrain` | height fields, their horizons, groups of triangles that hide together | `terrain` |
//! | `demo_scenes` | the scenes that are built in to measure with | `demo-scenes` |
//!
//! The features `vulkan`, `gles`, `metal` and `dx12`, all on by default, and `webgpu` for browsers, are wgpu's backends; a host that names wgpu itself chooses there.
//! The feature `simplify` adds proxies made by mesh simplification; it needs a C++ compiler, as `verify`, `measure`, `subsurface` and `demo-scenes` do.
//!
//! Drawing a scene under a strategy:
//!
#![cfg_attr(feature = "draw", doc = "```no_run")]
#![cfg_attr(not(feature = "draw"), doc = "```ignore")]
//! use antumbra::prelude::*;
//! use antumbra::glam::{DAffine3, DVec3};
//! use antumbra::scene::{Drawable, Material, Mesh, icosphere};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let gpu = Gpu::open(&AdapterChoice::Auto)?;
//! let mut scene = Scene::new();
//! let mesh = scene.add_mesh(Mesh::new("ball", icosphere(2, 0.5)))?;
//! let material = scene.add_material(Material::default());
//! for x in 0..100 {
//!     let ball = scene.spawn(None, DAffine3::from_translation(DVec3::X * f64::from(x)))?;
//!     scene.set_drawable(ball, Drawable { mesh, material })?;
//! }
//! let mut on_gpu = GpuScene::new(&gpu, &mut scene)?;
//!
//! let views = vec![ViewSpec::main(1280, 1024)];
//! let mut stage = Stage::new(&on_gpu, Box::new(FrustumOnly), views, StageOptions::default())?;
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
//!
//! With the feature `strategies`, `antumbra::strategies::registry().parse("three-pass:latency=frame-late")` makes a strategy by name.

pub use antumbra_cull as cull;
#[cfg(feature = "demo-scenes")]
pub use antumbra_demo_scenes as demo_scenes;
#[cfg(feature = "draw")]
pub use antumbra_draw as draw;
#[cfg(feature = "files")]
pub use antumbra_files as files;
#[cfg(feature = "formats")]
pub use antumbra_formats as formats;
pub use antumbra_graph as graph;
#[cfg(feature = "measure")]
pub use antumbra_measure as measure;
pub use antumbra_scene as scene;
pub use antumbra_shaders as shaders;
#[cfg(feature = "strategies")]
pub use antumbra_strategies as strategies;
#[cfg(feature = "subsurface")]
pub use antumbra_subsurface as subsurface;
#[cfg(feature = "terrain")]
pub use antumbra_terrain as terrain;
#[cfg(feature = "verify")]
pub use antumbra_verify as verify;
pub use {glam, wgpu};

/// The programs of the page on strategies compile as they stand there.
#[cfg(all(doctest, feature = "measure", feature = "demo-scenes"))]
#[doc = include_str!("../docs/writing-a-strategy.md")]
mod writing_a_strategy {}

/// What a program that culls names most.
pub mod prelude {
    pub use antumbra_cull::{
        AdapterChoice, FrustumOnly, Gpu, ImportedTargets, Latency, Registry, Stage, StageError,
        StageOptions, StageScene, Strategy, Verdict, ViewInput, ViewSpec,
    };
    #[cfg(feature = "draw")]
    pub use antumbra_draw::GpuScene;
    pub use antumbra_graph::Mode;
    pub use antumbra_scene::{Camera, Projection, Scene};
}
