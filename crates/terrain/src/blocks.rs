//! Terrains that lie beside each other, prepared one by one and looked at as one.
//!
//! What a block's own surface hides it hides beside any other, and what its margin hides of it, it hides where the margin is: if every triangle of that
//! is some other block's, in the same place. A block of whose margin something is missing is drawn whole, and still hides what it hides.
//!
//! Where two blocks have an edge in common the surface goes on; all other borders are one [`Rim`]. Edges are the same if their ends are, bit for
//! bit, about the same origin: about two origins the same numbers are rounded differently on the way to the screen, and between
//! the blocks there may be a crack. Such blocks have rims there, and lines of sight have to pass above.

use std::collections::HashSet;
use std::sync::Arc as Shared;

use glam::{DVec2, DVec3};

use crate::cull::{Arc, Eye};
use crate::rim::{Rim, border};
use crate::terrain::Terrain;

/// Terrains that are shown together.
#[derive(Debug, Clone)]
pub struct Blocks {
    terrains: Vec<Shared<Terrain>>,
    /// Whether all of each one's margin is there.
    sure: Vec<bool>,
    /// Where the rim's coordinates begin.
    origin: DVec3,
    rim: Rim,
}

impl Blocks {
    /// Finds out which edges they share, and whether their margins are there.
    #[must_use]
    pub fn join(terrains: Vec<Shared<Terrain>>) -> Self {
        let all = || terrains.iter().map(AsRef::as_ref);
        let mut edges = HashSet::new();
        for terrain in all() {
            let origin = bits(terrain.field().origin());
            edges.extend(border(terrain.field()).map(|edge| (origin, edge.map(bits))));
        }
        let first = terrains.first().map(|terrain| terrain.field().origin());
        let origin = first.unwrap_or_default();
        let mut rim = Vec::new();
        for terrain in all() {
            let field = terrain.field();
            let alone = |[a, b]: &[DVec3; 2]| {
                !edges.contains(&(bits(field.origin()), [bits(*b), bits(*a)]))
            };
            let shift = field.origin() - origin;
            let left = border(field).filter(alone);
            rim.extend(left.map(|edge| edge.map(|end| end + shift)));
        }
        let is_there = |terrain: &Terrain, corners: &[DVec3; 3]| {
            let same = |other: &&Terrain| other.field().origin() == terrain.field().origin();
            all().filter(same).any(|other| other.has(corners))
        };
        let sure = all().map(|terrain| {
            let mut margin = terrain.margin().iter();
            margin.all(|corners| is_there(terrain, corners))
        });
        Self {
            sure: sure.collect(),
            rim: Rim::new(rim),
            origin,
            terrains,
        }
    }

    /// The terrains, in the order they were given in.
    #[must_use]
    pub fn terrains(&self) -> &[Shared<Terrain>] {
        &self.terrains
    }

    /// Whether all of a block's margin is there, so that its horizons may be believed.
    #[must_use]
    pub fn is_sure(&self, block: usize) -> bool {
        self.sure.get(block) == Some(&true)
    }

    /// The border of them all, in metres of the first one's origin.
    #[must_use]
    pub fn rim(&self) -> &Rim {
        &self.rim
    }

    /// The highest place of the surface within some metres of a place in the plan, metres east and north: see
    /// [`Ground::highest_near`](crate::Ground::highest_near).
    #[must_use]
    pub fn highest_near(&self, place: DVec2, reach: f64) -> Option<f64> {
        let each = self.terrains.iter().filter_map(|terrain| {
            let origin = terrain.field().origin();
            let highest = terrain.highest_near(place - origin.truncate(), reach);
            highest.map(|highest| highest + origin.z)
        });
        each.reduce(f64::max)
    }

    /// Somebody at a place, metres east, north and up, who looks in some directions, for each block in turn; `None` where all of it is to be
    /// drawn: see [`Terrain::trusts`], which asks the same of all blocks together.
    pub fn eyes(
        &self,
        at: DVec3,
        sight: Arc,
        clearance: f64,
    ) -> impl Iterator<Item = Option<Eye<'_>>> {
        let above =
            |terrain: &Shared<Terrain>| terrain.is_below(at - terrain.field().origin(), clearance);
        let over =
            |terrain: &Shared<Terrain>| terrain.is_over((at - terrain.field().origin()).truncate());
        let trusted = self.terrains.iter().all(above);
        let within = trusted && self.rim.is_whole() && self.terrains.iter().any(over);
        let each = self.terrains.iter().zip(&self.sure);
        each.map(move |(terrain, sure)| {
            let eye = || {
                let eye = Eye::new(terrain.groups(), at - terrain.field().origin(), sight);
                let from = terrain.field().origin() - self.origin;
                if within {
                    eye
                } else {
                    eye.past(&self.rim, from)
                }
            };
            (trusted && *sure).then(eye)
        })
    }
}

/// The same for the same place: zero has two signs.
pub(crate) fn bits(at: DVec3) -> [u64; 3] {
    (at + DVec3::ZERO).to_array().map(f64::to_bits)
}
