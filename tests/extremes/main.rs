//! Tests at the extremes: of size, place, number, flatness, projection and order. Each scene is played to every strategy in conservative
//! settings, on Vulkan and on OpenGL, and compared with the oracle. The oracle is compared with a CPU twin in f64 where the twin is certain.
//!
//! `docs/accuracy.md`, "At the extremes", lists them. They do not repeat the kit's stories (`crates/verify/src/kit/stories`).
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod counts;
mod covers;
mod images;
mod lenses;
mod play;
mod refusals;
mod shapes;
mod sizes;
mod terrain;
mod time;
mod twin;
mod worlds;
