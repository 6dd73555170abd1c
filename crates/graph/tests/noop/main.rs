//! Tests on wgpu's noop device: what compiling decides and refuses. No adapter is needed.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod access;
mod declare;
mod device_errors;
mod errors;
mod imports;
mod loops;
mod order;
mod pictures;
mod pruning;
mod reuse;
