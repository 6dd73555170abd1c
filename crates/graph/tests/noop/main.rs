//! Tests on wgpu's noop device: the decisions and errors of `compile`. They need no adapter.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod access;
mod declare;
mod device_errors;
mod errors;
mod imports;
mod inherit;
mod loops;
mod order;
mod pictures;
mod pruning;
mod reuse;
