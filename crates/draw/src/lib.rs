//! Meshes on the GPU, draw lists, pipelines, and the depth, shaded and transparent passes.
//!
//! - [`Gpu`] opens a device.
//! - [`GpuScene`] keeps a [`Scene`](antumbra_scene::Scene)'s drawables on it: shared vertex and index arenas, one instance
//!   buffer, and the [`SceneTable`] that culling reads.
//! - [`DrawList`] says what to draw; [`PassPipelines`] and [`Recorder`] draw it.

mod arena;
pub mod boxes;
mod class;
mod detail;
mod device;
mod environment;
mod error;
mod instance;
mod light;
mod list;
mod material;
mod mesh;
mod oriented;
pub mod passes;
pub mod patches;
mod pipeline;
mod ranges;
pub mod read_back;
mod record;
mod scale;
mod scene;
mod slot_groups;
mod table;
mod texture;
mod view;

pub use class::{Alpha, PipelineClass, PipelineTraits};
pub use detail::MeshDetail;
pub use device::{AdapterChoice, DeviceError, Gpu, WANTED_FEATURES, adapters, title};
pub use error::DrawError;
pub use instance::Instance;
pub use light::{GpuLights, LIGHTS_MOST, SceneLights};
pub use list::{DrawList, Run};
pub use oriented::OrientedBox;
pub use pipeline::{DEPTH_FORMAT, IDENTITY_FORMAT, PassPipelines, PipelineKind};
pub use ranges::{IndexRange, MeshRanges};
pub use record::{INDIRECT_DRAW_BYTES, Recorder, begin};
pub use scene::{GpuScene, SceneFrame, SceneLayout};
pub use slot_groups::SlotGroups;
pub use table::{Batch, Occupant, SceneTable};
pub use view::{GpuView, ViewFrame};
