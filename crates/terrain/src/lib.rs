//! Height fields and occlusion culling by their horizons. Preparation needs no GPU.
//!
//! The system follows Edmondson, *Hierarchical Occlusion Culling for Arbitrarily-Meshed Height Fields*, 2004, and Stewart, *Fast Horizon
//! Computation at All Points of a Terrain with Visibility and Shading Applications*, 1998.
//!
//! - [`Field`] is a triangle mesh that is single-valued over the plan. A mesh that is not single-valued is refused, with the position of
//!   every fault.
//! - [`Landscape`] is a field that is shown as it is, without horizons.
//! - [`horizon`] computes, for every vertex and every sector of directions, a slope and a distance: a viewpoint below that slope and beyond
//!   that distance does not see the vertex.
//! - [`GroupHierarchy`] holds groups of triangles that are hidden together, and the regions of viewpoints that they are hidden from.
//! - [`Terrain`] is a field with its groups. [`TerrainTiles`] are several terrains side by side.
//! - [`Observer`] tests groups from one position.
//! - The module `file` (feature `files`) stores a prepared terrain in the glTF file that shows it.
//! - `HorizonStrategy` (feature `strategy`) culls with all of this in a stage. It is the only part that needs a GPU.
//!
//! Coordinates are metres east, north and up, in f64. The *plan* is the horizontal plane: east and north.

mod azimuth;
mod boundary_tree;
mod box_regions;
mod circle;
mod crystal;
mod error;
mod fault;
pub mod field;
#[cfg(feature = "files")]
pub mod file;
mod flight;
mod from_scene;
mod ground;
mod group_builder;
mod groups;
pub mod horizon;
mod landscape;
mod line_of_sight;
mod observer;
mod packed_tree;
mod position_key;
#[cfg(feature = "strategy")]
mod prepared_entities;
mod region;
mod sector_bound;
mod show;
#[cfg(feature = "strategy")]
mod slot_filter;
#[cfg(feature = "strategy")]
mod strategy;
mod terrain;
#[cfg(feature = "strategy")]
mod terrain_entities;
mod tile;
mod tiles;
mod tin;
mod world;

pub use azimuth::AzimuthRange;
pub use boundary_tree::BoundaryTree;
pub use box_regions::BoxRegions;
pub use circle::Circle;
pub use crystal::{Crystals, GroupOptions, GroupPair};
pub use error::TerrainError;
pub use fault::FieldFault;
pub use field::{Boundary, Field, NONE};
#[cfg(feature = "files")]
pub use file::PreparedScene;
pub use flight::FlightStation;
pub use ground::{Ground, SurfacePoint};
pub use groups::{Group, GroupHierarchy};
pub use horizon::{Horizon, Horizons, Method, Scope, Sectors};
pub use landscape::Landscape;
pub use line_of_sight::LineOfSight;
pub use observer::Observer;
pub use region::{Region, VertexHorizon};
pub use show::{ShownGroup, ShownTerrain, ShownUngrouped, TerrainInScene};
#[cfg(feature = "strategy")]
pub use strategy::HorizonStrategy;
pub use terrain::{Terrain, TerrainOptions};
pub use tile::Tile;
pub use tiles::TerrainTiles;
pub use tin::RasterDetail;
pub use world::to_world;
