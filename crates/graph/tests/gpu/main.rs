//! Tests on an adapter: lavapipe (Vulkan) or any GPU; the query tests also on OpenGL. They fail without an adapter.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod attachments;
mod device;
mod embedded;
mod history;
mod late;
mod lifecycle;
mod loops;
mod mips;
mod queries;
mod sync;
mod timing;
