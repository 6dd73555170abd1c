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
mod audit;
mod budget;
mod candidates;
mod chain;
mod compute_pipeline;
mod count_layout;
mod counting;
mod dial;
mod frame_graph;
pub mod indirect;
mod latency;
mod narrowing;
pub mod order;
mod pipelines;
mod proxies;
mod query_detail;
mod registry;
mod sample_rule;
mod samples;
mod stage;
mod strategy;
mod tree;
mod tuning;
mod verdict;
mod view_nodes;
mod visible_on_gpu;
mod visible_samples;
mod yardsticks;

pub use antumbra_draw::passes::Targets;
pub use antumbra_draw::{AdapterChoice, Gpu, GpuScene};
pub use audit::{AUDIT, Audit, AuditOptions, Estimate, FrameAudit};
pub use budget::{Budget, BudgetError, BudgetState};
pub use candidates::{Candidates, Queried, Query, Stamp};
pub use chain::Chain;
pub use compute_pipeline::ComputePipeline;
pub use count_layout::CountLayout;
pub use counting::{Counting, Counts};
pub use dial::Dial;
pub use frame_graph::{CULL, Chosen, DRAW, FrameGraph};
pub use latency::Latency;
pub use proxies::{AtNearPlane, Proxies, ProxyLimits, ProxySource};
pub use query_detail::query_detail;
pub use registry::{Registry, RegistryError};
pub use sample_rule::{Allowance, SampleRule};
pub use samples::Samples;
pub use stage::{ImportedTargets, Stage, StageError, StageOptions, ViewInput, ViewSpec};
pub use strategy::{DeclareError, Role, Strategy, VisibleSet};
pub use tree::Tree;
pub use tuning::{
    Parameter, Setting, SettingError, SettingRange, Step, Tunable, Value, assign, describe,
    shortest,
};
pub use verdict::{Verdict, Verdicts};
pub use view_nodes::ViewNodes;
pub use yardsticks::{Everything, FrustumOnly, Ideal};
