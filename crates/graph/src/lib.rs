//! Passes and resources, compiled into a checked plan and executed as wgpu commands, with read-back and timing.
//!
//! The shape is that of Filament's frame graph: build, compile, execute, with versioned handles. [`Graph`] records what each node
//! reads and writes, [`Graph::compile`] answers with a [`Plan`] or with everything that is wrong, [`Plan::execute`] runs a frame,
//! [`Plan::record`] records one into somebody else's encoder. The crate knows no scene.
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
//! Owns: order, clears, loads, stores, transient resources and their reuse, histories, read-back rings, query sets, timestamps.
//! Does not own: pipelines, bind group layouts, the device, imported resources.
//!
//! Common mistakes: reading a handle instead of the one a write returned; leaving a pass that only changes captured state without
//! `side_effect` (it is pruned); expecting counts from occlusion queries (they answer zero or not zero).

mod access;
mod bind;
mod builder;
mod compile;
mod compute;
mod copy;
mod draw;
mod error;
mod execute;
mod frame;
mod graph;
mod handle;
mod host;
mod pass;
mod physical;
mod picture;
mod plan;
mod queries;
mod raster;
mod read_back;
mod recorder;
mod resource;
mod store;
mod sync;
mod timing;

pub use bind::{Bind, External};
pub use compile::{CompileOptions, Mode};
pub use compute::{ComputeBuilder, ComputeContext};
pub use copy::{CopyBuilder, CopyContext, Copyable};
pub use error::{AccessError, BodyError, CompileError, CompileErrors, ExecuteError};
pub use execute::FrameReport;
pub use frame::{HostMut, HostRef};
pub use graph::{Graph, LoopOptions};
pub use handle::{Buffer, Handle, Host, PassId, ReadBack, Texture};
pub use host::{HostBuilder, HostContext, HostReader, HostUpdatable};
pub use pass::PassKind;
pub use picture::Picture;
pub use plan::{Memory, PassInfo, Plan};
pub use raster::{RasterBuilder, RasterContext};
pub use read_back::Late;
pub use resource::{BufferDesc, Clear, TextureDesc};
pub use timing::{GroupTiming, PassTiming, Timings};
