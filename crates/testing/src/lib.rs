//! What the workspace's integration tests share: devices, cameras, scenes and frames.
//!
//! A test takes a device of [`devices`], which is opened once per test program; puts a scene on it (of [`scenes`], or its own, with the help of
//! [`add`] and [`drawable`]); and plays frames with [`stage`], [`frame`] and [`settled`]. Everything panics on failure, as a test does.
//!
//! This crate is never published. Crates name it by path alone among their dev-dependencies, so that `cargo package` leaves it out.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod cameras;
pub mod devices;
pub mod engine;
pub mod frames;
pub mod scenes;
pub mod targets;

pub use cameras::{look_at, over_pixels, perspective, perspective_degrees};
pub use devices::{auto, gl, gpus, is_swiftshader, vulkan};
pub use frames::{Settled, frame, settled, stage, stage_with, views, wrong_pixels_percent};
pub use scenes::{
    SceneBuilder, add, balls, balls_with_proxies, cuboid, drawable, glass, holes, placed,
};
pub use targets::HostTargets;
