//! Measures culling strategies: camera paths, comparisons, image errors, statistics and reports.
//!
//! A [comparison](compare) runs strategies along a camera [`path`], compares every frame with the reference ([`image_error`]), reduces the
//! times ([`stats`]) and writes one [`report`]. The terminal [`table`], the [`summary`] sentences, the [`trade_off`] of a sweep, the
//! [`plots`] and the page ([`html`]) are made from that report alone. A frame has one of the [`views`] or, in stereo, two, whose pictures
//! [`stereo_picture`] combines.

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
