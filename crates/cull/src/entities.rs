//! What culling knows of entities: bounds, pipeline classes, where their geometry lies, and how they are grouped, by slot.

mod class;
mod detail;
mod oriented;
mod part_table;
mod ranges;
mod scale;
mod slot_groups;
mod table;

pub use class::{Alpha, PipelineClass, PipelineTraits};
pub use detail::MeshDetail;
pub use oriented::OrientedBox;
pub use part_table::GpuPartBox;
pub use ranges::{IndexRange, MeshRanges, NewShape};
pub use slot_groups::SlotGroups;
pub use table::{Batch, NewOccupant, Occupant, SceneTable};
