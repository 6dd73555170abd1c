//! The contract of occlusion culling as a stage of a render graph: strategies that plug in, visible sets, sample counts, audits and budgets.
//!
//! A [`Strategy`] declares nodes on a [`FrameGraph`] for each view and returns a [`VisibleSet`]. A [`Stage`] compiles the nodes and runs frames. When a query's answer is
//! used is one edge of the graph: read a frame late by a host node, read in the same frame by a host node (a sync point), or read by a compute node that writes indirect
//! draws ([`Latency`]).
//!
//! - To write a strategy: [`Strategy`], the steps of [`FrameGraph`], [`indirect`] for strategies on the GPU, [`Tunable`] for settings.
//! - To run one: [`Stage`], [`ViewInput`], [`Registry`].
//! - To bound its error or time without settings: [`Budget`], which goes by the [`Audit`].
//!
//! The built-in strategies are in `antumbra-strategies`, the oracle and the conformance kit in `antumbra-verify`.

mod adaptive_threshold;
mod arrival;
mod audit;
mod box_test;
pub mod boxes;
mod budget;
mod candidates;
mod chain;
mod compaction;
mod compute_pipeline;
mod count_layout;
mod counting;
mod device;
mod dial;
mod draw_source;
mod entities;
mod frame_graph;
pub mod guard;
pub mod indirect;
pub mod judge;
mod latency;
mod narrowing;
pub mod order;
mod pipelines;
mod proxies;
mod query_detail;
pub mod read_back;
mod registry;
mod render_passes;
mod renderer;
mod resident_scene;
mod sample_rule;
mod samples;
mod self_test;
mod split_point;
mod stage;
mod stage_scene;
mod strategy;
mod subpixel;
mod tree;
mod trust;
mod tuning;
mod verdict;
mod view;
mod view_nodes;
mod visible_on_gpu;
mod visible_samples;
mod waiting;
mod yardsticks;

pub use audit::{AUDIT, Audit, AuditOptions, Estimate, FrameAudit};
pub use box_test::{BoxTest, TestDetail, TestRules, TestShape, UnknownEntities, ViewBoxes};
pub use budget::{Budget, BudgetError, BudgetState};
pub use candidates::{Candidates, Queried, Query, Stamp};
pub use chain::Chain;
pub use compute_pipeline::{ComputePipeline, rows_of};
pub use count_layout::CountLayout;
pub use counting::{Counting, Counts};
pub use device::{AdapterChoice, DeviceError, Gpu, WANTED_FEATURES, adapter_title, adapters};
pub use dial::Dial;
pub use draw_source::{
    DrawList, DrawSource, INDIRECT_DRAW_BYTES, IndirectDraws, ListDraws, Run, patches,
};
pub use entities::{
    Alpha, Batch, GpuPartBox, IndexRange, MeshDetail, MeshRanges, NewOccupant, NewShape, Occupant,
    OrientedBox, PipelineClass, PipelineTraits, SceneTable, SlotGroups,
};
pub use frame_graph::{CULL, Chosen, DRAW, FrameGraph};
pub use latency::Latency;
pub use proxies::{AtNearPlane, Proxies, ProxyLimits, ProxySource};
pub use query_detail::query_detail;
pub use registry::{Registry, RegistryError};
pub use renderer::{
    DEPTH_FORMAT, DepthTest, IDENTITY_FORMAT, IdTargets, Pass, Renderer, ShadeTargets, Targets,
    TestRenderer, ViewInputs,
};
pub use resident_scene::ResidentScene;
pub use sample_rule::{Allowance, SampleRule};
pub use samples::Samples;
pub use self_test::{Capability, Failure, Outcome, SelfTestReport};
pub use split_point::SplitPoint;
pub use stage::{
    Distrust, DistrustCause, DistrustOptions, Draws, ImportedTargets, Instead, Rebuilt, Stage,
    StageError, StageOptions, StageOutput, StageReport, ViewInput, ViewSpec,
};
pub use stage_scene::{SceneFrame, SceneLayout, StageScene, WithRenderer, next_scene_number};
pub use strategy::{DeclareError, Role, Strategy, VisibleSet};
pub use tree::Tree;
pub use tuning::{
    Parameter, Setting, SettingError, SettingRange, Step, Tunable, Value, assign, describe,
    shortest,
};
pub use verdict::{Verdict, Verdicts};
pub use view::{GpuView, ViewAxes, ViewFrame};
pub use view_nodes::ViewNodes;
pub use yardsticks::{Everything, FrustumOnly, Ideal};
