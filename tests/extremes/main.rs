//! Extremes are tests, not hopes: of size, place, number, flatness, optics and order. Each is played to every strategy in settings that promise
//! no wrong pixel, on Vulkan and on GL, and held against the oracle; what the oracle shows is held against a twin in f64 where one can say it.
//!
//! `docs/accuracy.md`, "At the extremes", lists them. What the kit plays to every strategy is not played again here: `crates/verify/src/kit/stories`.
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
