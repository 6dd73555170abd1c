//! A render graph on wgpu: passes and resources, compiled into a checked plan and executed as wgpu commands, with read-back and timing.
//!
//! [`Graph`] records what each pass reads and writes. [`Graph::compile`] returns a [`Plan`], or everything that is wrong with the graph.
//! [`Plan::execute`] runs and submits a frame; [`Plan::record`] records one into the caller's encoder. The phases (build, compile,
//! execute) and the versioned handles are those of Filament's frame graph. The crate knows no scene and no other crate of Antumbra.
//!
//! ```
//! use antumbra_graph::{BufferDesc, CompileOptions, Graph};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let (device, queue) = wgpu::Device::noop(&wgpu::DeviceDescriptor::default());
//! let mut g = Graph::new("double");
//! let numbers = g.import_host::<Vec<u32>>("numbers");
//! let input = g.buffer("input", BufferDesc::new(1024));
//! let output = g.buffer("output", BufferDesc::new(1024));
//!
//! let mut node = g.host_node("upload");
//! node.read(numbers);
//! let input = node.upload(input);
//! node.run(move |ctx| {
//!     let bytes: Vec<u8> = ctx.get(numbers)?.iter().flat_map(|n| n.to_le_bytes()).collect();
//!     ctx.upload(input, 0, &bytes)?;
//!     Ok(())
//! });
//!
//! let mut node = g.copy("copy");
//! node.copy_src(input);
//! let output = node.copy_dst(output);
//! node.run(move |ctx| {
//!     let (from, to) = (ctx.buffer(input)?, ctx.buffer(output)?);
//!     ctx.encoder().copy_buffer_to_buffer(from, 0, to, 0, 1024);
//!     Ok(())
//! });
//! g.output(output);
//!
//! let mut plan = g.compile(&CompileOptions::owned(&device))?;
//! plan.set(numbers, vec![1, 2, 3])?;
//! let report = plan.execute(&device, &queue)?;
//! assert_eq!((report.frame, report.sync_points), (0, 0));
//! # Ok(())
//! # }
//! ```
//!
//! **Owns:** the order of passes, clears, loads and stores, transient resources and their reuse, histories, read-back rings, query sets,
//! timestamps.
//!
//! **Does not own:** the device and the queue, pipelines and bind group layouts, imported resources, and what passes draw.
//!
//! Common mistakes:
//!
//! - Reading a handle other than the one that the last write returned. The pass then runs before that write.
//! - Leaving out [`side_effect`](HostBuilder::side_effect) on a pass that changes only captured state. The pass is pruned.
//! - Expecting counts from occlusion queries. Their results are zero or not zero.

mod access;
mod bind;
mod body;
mod builder;
mod compile;
mod compute;
mod context;
mod copy;
mod error;
mod execute;
mod export;
mod frame;
mod graph;
mod handle;
mod host;
mod options;
mod pass;
mod physical;
mod plan;
mod queries;
mod raster;
mod read_back;
mod recorder;
mod report;
mod resource;
mod store;
mod sync;
mod timing;

pub use bind::{Bind, External};
pub use compile::reads_drawn_samples;
pub use compute::ComputeBuilder;
pub use context::{ComputeContext, CopyContext, HostContext, RasterContext};
pub use copy::{CopyBuilder, Copyable};
pub use error::{AccessError, BodyError, CompileError, CompileErrors, ExecuteError};
pub use export::PlanFormat;
pub use frame::{HostMut, HostReader, HostRef};
pub use graph::{Graph, LoopOptions};
pub use handle::{Buffer, Handle, Host, PassId, ReadBack, Texture};
pub use host::{HostBuilder, HostUpdatable};
pub use options::{CompileOptions, LateResults, Mode};
pub use pass::PassKind;
pub use plan::{LoopSyncPoints, Memory, PassInfo, Plan};
pub use raster::RasterBuilder;
pub use read_back::{Late, ReadBackCopy, ReadBackRing};
pub use report::{FrameReport, LateResult};
pub use resource::{BufferDesc, Clear, TextureDesc};
pub use timing::{GroupTiming, PassTiming, Timings};
