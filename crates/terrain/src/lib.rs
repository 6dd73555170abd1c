//! Height fields and their horizons. Nothing here needs a GPU.
//!
//! The system is that of Edmondson, *Hierarchical Occlusion Culling for Arbitrarily-Meshed Height Fields*, 2004, after Stewart, *Fast
//! Horizon Computation at All Points of a Terrain with Visibility and Shading Applications*, 1998.
//!
//! - [`Field`] is a triangle mesh that is single-valued over the plan; what is not is refused with the place of every fault.
//! - [`horizon`] finds, for every vertex and sector of directions, below which slope and beyond which distance nobody sees it.
//! - A [`Terrain`] is a field with its horizons and groups; [`Blocks`] are several that lie beside each other.
//! - [`mod@file`] keeps all that is known of a terrain in the glTF that shows it.

mod blocks;
mod circle;
mod crystal;
mod cull;
mod cut;
mod error;
pub mod field;
#[cfg(feature = "files")]
pub mod file;
mod flight;
mod from_scene;
mod ground;
mod groups;
pub mod horizon;
mod lid;
mod packed;
mod region;
mod rim;
#[cfg(feature = "strategy")]
mod seen;
mod show;
mod sight;
mod standing;
#[cfg(feature = "strategy")]
mod stood;
#[cfg(feature = "strategy")]
mod strategy;
mod terrain;
mod tin;

pub use blocks::Blocks;
pub use circle::Circle;
pub use crystal::{Crystals, GroupOptions};
pub use cull::{Arc, Eye};
pub use cut::Part;
pub use error::TerrainError;
pub use field::{Fault, Field, NONE, Outline};
#[cfg(feature = "files")]
pub use file::PreparedScene;
pub use ground::Ground;
pub use groups::{Group, Groups};
pub use horizon::{Horizon, Horizons, Method, Scope, Sectors};
pub use region::Region;
pub use rim::Rim;
pub use show::{ShownTerrain, to_world};
pub use sight::Sights;
pub use standing::Stand;
#[cfg(feature = "strategy")]
pub use strategy::Horizon as HorizonStrategy;
pub use terrain::{Terrain, TerrainOptions};
pub use tin::Detail;
