//! The built-in renderer: meshes on the GPU, draw lists, pipelines, and the passes that draw.
//!
//! - [`Gpu`] opens a device.
//! - [`GpuScene`] holds a [`Scene`](antumbra_scene::Scene)'s drawable entities on the device: shared vertex and index arenas, one instance
//!   buffer, and the [`SceneTable`] that culling reads.
//! - [`DrawList`] says what to draw. [`PassPipelines`] and [`Recorder`] draw it; [`passes`] are graph nodes that do so.

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
pub use device::{AdapterChoice, DeviceError, Gpu, WANTED_FEATURES, adapter_title, adapters};
pub use error::DrawError;
pub use instance::Instance;
pub use light::{GpuLights, MAX_LIGHTS, SceneLights};
pub use list::{DrawList, Run};
pub use oriented::OrientedBox;
pub use pipeline::{DEPTH_FORMAT, IDENTITY_FORMAT, PassPipelines, PipelineKind};
pub use ranges::{IndexRange, MeshRanges};
pub use record::{INDIRECT_DRAW_BYTES, Recorder, begin};
pub use scene::{GpuScene, SceneFrame, SceneLayout};
pub use slot_groups::SlotGroups;
pub use table::{Batch, Occupant, SceneTable};
pub use view::{GpuView, ViewAxes, ViewFrame};
