//! Camera paths, the oracle, image errors, and the report.
//!
//! A comparison flies a [`path`], holds every frame against the reference ([`image_error`]),
//! reduces the times ([`stats`]) and lands in one [`report`]; the terminal [`table`], the
//! [`verdict`]s, the [`plots`] and the page ([`html`]) are drawn from that report alone.

pub mod compare;
mod error;
pub mod html;
pub mod image_error;
pub mod path;
pub mod plots;
pub mod report;
pub mod stats;
mod store;
pub mod table;
pub mod verdict;
pub mod views;
mod words;

pub use error::MeasureError;
