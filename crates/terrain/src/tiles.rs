//! Several terrains side by side, prepared one by one and culled together.
//!
//! What a tile's own surface hides, it hides beside any other tile. What its margin hides of it, it hides where the margin is: where every
//! triangle of the margin is another tile's, at the same position. A tile with an incomplete margin is drawn whole, and still hides what its
//! own surface hides.
//!
//! Where two tiles share an edge the surface goes on. All other boundary edges are in one [`BoundaryTree`]. Edges are shared if their ends are
//! equal bit for bit and the tiles have the same origin: about two origins the same numbers are rounded differently on the way to the
//! screen, and there may be a crack between the tiles. Such tiles have boundaries there, and lines of sight have to pass above.

use std::collections::HashSet;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::azimuth::AzimuthRange;
use crate::boundary_tree::{BoundaryTree, boundary_edges};
use crate::observer::Observer;
use crate::position_key::position_key;
use crate::terrain::Terrain;

/// Terrains that are shown together.
#[derive(Debug, Clone)]
pub struct TerrainTiles {
    terrains: Vec<Arc<Terrain>>,
    /// For each terrain, whether its whole margin belongs to other tiles.
    has_whole_margin: Vec<bool>,
    /// The origin of the boundary's coordinates.
    origin: DVec3,
    boundary: BoundaryTree,
}

impl TerrainTiles {
    /// Joins terrains: finds the edges that they share, and the margins that are complete.
    #[must_use]
    pub fn join(terrains: Vec<Arc<Terrain>>) -> Self {
        let all = || terrains.iter().map(AsRef::as_ref);
        let mut edges = HashSet::new();
        for terrain in all() {
            let origin = position_key(terrain.field().origin());
            let own = boundary_edges(terrain.field());
            edges.extend(own.map(|edge| (origin, edge.map(position_key))));
        }
        let first = terrains.first().map(|terrain| terrain.field().origin());
        let origin = first.unwrap_or_default();
        let mut boundary = Vec::new();
        for terrain in all() {
            let field = terrain.field();
            let is_unshared = |[a, b]: &[DVec3; 2]| {
                let opposite = [position_key(*b), position_key(*a)];
                !edges.contains(&(position_key(field.origin()), opposite))
            };
            let shift = field.origin() - origin;
            let unshared = boundary_edges(field).filter(is_unshared);
            boundary.extend(unshared.map(|edge| edge.map(|end| end + shift)));
        }
        let has_triangle = |terrain: &Terrain, corners: &[DVec3; 3]| {
            let same = |other: &&Terrain| other.field().origin() == terrain.field().origin();
            all().filter(same).any(|other| other.has_triangle(corners))
        };
        let has_whole_margin = all().map(|terrain| {
            let mut margin = terrain.margin().iter();
            margin.all(|corners| has_triangle(terrain, corners))
        });
        Self {
            has_whole_margin: has_whole_margin.collect(),
            boundary: BoundaryTree::new(boundary),
            origin,
            terrains,
        }
    }

    /// The terrains, in the order they were given in.
    #[must_use]
    pub fn terrains(&self) -> &[Arc<Terrain>] {
        &self.terrains
    }

    /// Whether all of a tile's margin belongs to other tiles, so that its horizons hold. `tile` is an index of [`Self::terrains`].
    #[must_use]
    pub fn has_whole_margin(&self, tile: usize) -> bool {
        self.has_whole_margin.get(tile) == Some(&true)
    }

    /// The boundary of all terrains together, metres from the first terrain's origin.
    #[must_use]
    pub fn boundary(&self) -> &BoundaryTree {
        &self.boundary
    }

    /// An upper bound of the surface's height near a position in the plan, metres east and north: see
    /// [`Ground::highest_near`](crate::Ground::highest_near).
    #[must_use]
    pub fn highest_near(&self, at: DVec2, reach: f64) -> Option<f64> {
        let each = self.terrains.iter().filter_map(|terrain| {
            let origin = terrain.field().origin();
            let highest = terrain.highest_near(at - origin.truncate(), reach);
            highest.map(|highest| highest + origin.z)
        });
        each.reduce(f64::max)
    }

    /// An observer over each tile in turn, from a position in metres east, north and up, that sees in the directions `azimuths`. `None` for
    /// tiles of which everything must be drawn. All tiles together must be lower than the position: see [`Terrain::is_valid_observer`].
    pub fn observers(
        &self,
        at: DVec3,
        azimuths: AzimuthRange,
        clearance: f64,
    ) -> impl Iterator<Item = Option<Observer<'_>>> {
        let is_lower = |terrain: &Arc<Terrain>| {
            terrain.is_lower_than(at - terrain.field().origin(), clearance)
        };
        let is_over =
            |terrain: &Arc<Terrain>| terrain.is_over((at - terrain.field().origin()).truncate());
        let valid = self.terrains.iter().all(is_lower);
        let within = valid && self.boundary.is_convex() && self.terrains.iter().any(is_over);
        let each = self.terrains.iter().zip(&self.has_whole_margin);
        each.map(move |(terrain, has_whole_margin)| {
            let observer = || {
                let origin = terrain.field().origin();
                let observer = Observer::new(terrain.groups(), at - origin, azimuths);
                if within {
                    observer
                } else {
                    observer.with_boundary(&self.boundary, origin - self.origin)
                }
            };
            (valid && *has_whole_margin).then(observer)
        })
    }
}
