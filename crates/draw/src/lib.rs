//! The built-in renderer: meshes on the GPU, pipelines, and the passes that draw what a stage decides to draw.
//!
//! - [`GpuScene`] holds a [`Scene`](antumbra_scene::Scene)'s drawable entities on the device: shared vertex and index arenas, one instance
//!   buffer, and the [`SceneTable`](antumbra_cull::SceneTable) that culling reads. It is the [`StageScene`](antumbra_cull::StageScene) of a stage.
//! - [`BuiltinRenderer`] is its [`Renderer`](antumbra_cull::Renderer): [`PassPipelines`] and [`Recorder`] draw a list; [`passes`] are graph nodes that do so.

mod arena;
mod builtin;
mod environment;
mod error;
mod instance;
mod light;
mod material;
mod mesh;
pub mod passes;
mod pipeline;
mod record;
mod scene;
mod texture;

pub use builtin::BuiltinRenderer;
pub use error::DrawError;
pub use instance::Instance;
pub use light::{GpuLights, MAX_LIGHTS, SceneLights};
pub use pipeline::{PassPipelines, PipelineKind, SAMPLE_IDENTITY_FORMAT};
pub use record::{Recorder, begin};
pub use scene::{GpuScene, SceneBuffers};
