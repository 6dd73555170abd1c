//! The commands, one file each.

pub mod compare;
pub mod doctor;
pub mod graph;
pub mod prepare;
pub mod render;
pub mod strategies;
pub mod sweep;
