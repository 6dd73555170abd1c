//! Camera paths, the oracle, image errors, and the report.
//!
//! A comparison flies a [`path`], holds every frame against the reference ([`image_error`]),
//! reduces the times ([`stats`]) and lands in one [`report`]; the terminal [`table`], the
//! [`verdict`]s, the [`trade`] of a sweep, the [`plots`] and the page ([`html`]) are drawn from that report alone. A frame has one of the [`views`] or,
//! in stereo, two, whose pictures [`stereo_picture`] joins.

pub mod audit_summary;
pub mod compare;
mod error;
mod files;
mod format;
pub mod html;
pub mod image_error;
pub mod path;
pub mod plots;
pub mod report;
pub mod stats;
pub mod stereo_picture;
pub mod summary;
pub mod table;
pub mod trade_off;
pub mod traversal_picture;
pub mod views;

pub use error::MeasureError;
