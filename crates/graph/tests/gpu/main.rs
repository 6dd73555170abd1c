//! Tests on a real adapter: lavapipe (Vulkan) or any GPU; the query tests on GL as well. Without an adapter they fail, loudly.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod attachments;
mod device;
mod embedded;
mod history;
mod late;
mod lifecycle;
mod loops;
mod queries;
mod sync;
mod timing;
