//! Meshes on the GPU, draw lists, pipelines, and the depth, shaded and transparent passes.
//!
//! - [`Gpu`] opens a device.
//! - [`GpuScene`] keeps a [`Scene`](antumbra_scene::Scene)'s drawables on it: shared vertex and index arenas, one instance
//!   buffer, and the [`SceneTable`] that culling reads.
//! - [`DrawList`] says what to draw; [`PassPipelines`] and [`Recorder`] draw it.

mod arena;
pub mod boxes;
mod device;
mod environment;
mod error;
mod groups;
mod instance;
mod light;
mod list;
mod material;
mod mesh;
mod oriented;
pub mod passes;
pub mod patches;
mod pipeline;
pub mod read_back;
mod record;
mod scene;
mod table;
mod texture;
mod view;

pub use device::{AdapterChoice, DeviceError, Gpu, WANTED_FEATURES, adapters, title};
pub use error::DrawError;
pub use groups::Groups;
pub use instance::Instance;
pub use light::{GpuLights, LIGHTS_MOST, SceneLights};
pub use list::{Detail, DrawList, Run};
pub use oriented::OrientedBox;
pub use pipeline::{DEPTH_FORMAT, IDENTITY_FORMAT, PassPipelines, PipelineKind};
pub use record::{INDIRECT_DRAW_BYTES, Recorder, begin};
pub use scene::{GpuScene, SceneFrame, SceneLayout};
pub use table::{Alpha, Batch, Class, MeshRanges, Occupant, Range, SceneTable};
pub use view::{GpuView, ViewFrame};
