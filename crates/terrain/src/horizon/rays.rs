//! Exact horizons along single directions, for all vertices of a field: a search for the highest edge, begun with what the neighbour
//! found and with what was found in the direction before.

use super::bearing::{Bearing, Edges};
use super::crossing::{resolve, slope};
use super::{Finder, Horizon, Row, Sectors};
use crate::field::{Field, NONE};

pub(super) struct Rays<'a> {
    field: &'a Field,
    edges: Edges,
}

impl<'a> Rays<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self {
            field,
            edges: Edges::new(field),
        }
    }
}

/// Replaces, for every vertex, the edge that stands highest in another direction by the one that does in the bearing's.
pub(super) fn look(bearing: &mut Bearing<'_>, seen: &mut [u32]) {
    let mut neighbour = NONE;
    for (vertex, seen) in seen.iter_mut().enumerate() {
        *seen = bearing.highest(vertex as u32, [*seen, neighbour]);
        neighbour = *seen;
    }
}

impl Finder for Rays<'_> {
    fn sector(&self, sectors: &Sectors, sector: u32, row: &mut Row<'_>) {
        let mut bearing = Bearing::new(&self.edges);
        let mut seen = vec![NONE; row.vertices.len()];
        row.vertices.fill(Horizon {
            slope: f32::INFINITY,
            distance: 0.0,
        });
        for part in 0..sectors.parts() {
            let way = sectors.middle(sector, part);
            bearing.turn(self.field, way);
            look(&mut bearing, &mut seen);
            for (vertex, horizon) in row.vertices.iter_mut().enumerate() {
                let from = self.field.point(vertex as u32);
                let found = resolve(self.field, from, way, seen[vertex]).map(|crossing| Horizon {
                    slope: slope(from, crossing.at) as f32,
                    distance: (crossing.at - from).truncate().length() as f32,
                });
                *horizon = horizon.and(found.unwrap_or(Horizon::OPEN));
            }
        }
        row.of_ends(self.field);
    }
}
