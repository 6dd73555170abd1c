//! Camera paths, the oracle, image errors, and the report.
//!
//! A comparison flies a [`path`], holds every frame against the reference ([`image_error`]),
//! reduces the times ([`stats`]) and lands in one [`report`]; the terminal [`table`], the
//! [`verdict`]s, the [`trade`] of a sweep, the [`plots`] and the page ([`html`]) are drawn from that report alone. A frame has one of the [`views`] or,
//! in stereo, two, whose pictures [`stereo_picture`] joins.

pub mod compare;
mod error;
pub mod html;
pub mod image_error;
pub mod keeping;
pub mod path;
pub mod plots;
pub mod report;
pub mod sketch_picture;
pub mod stats;
pub mod stereo_picture;
mod store;
pub mod table;
pub mod trade;
pub mod verdict;
pub mod views;
mod words;

pub use error::MeasureError;
