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

/// Replaces, for every vertex and each reach of it, the farthest first, the edge that stands highest in another direction by the one that does in
/// the bearing's.
pub(super) fn look(bearing: &mut Bearing<'_>, reaches: &[f32], seen: &mut [u32]) {
    let mut neighbours = vec![NONE; reaches.len()];
    for (vertex, seen) in (0..).zip(seen.chunks_exact_mut(reaches.len())) {
        let mut farther = None;
        for ((seen, neighbour), &reach) in seen.iter_mut().zip(&mut neighbours).zip(reaches) {
            *seen = match farther {
                // Most of what is highest is near.
                Some(half) if half == NONE || bearing.is_within(vertex, half, reach) => half,
                _ => bearing.highest(vertex, reach, [*seen, *neighbour]),
            };
            *neighbour = *seen;
            farther = Some(*seen);
        }
    }
}

impl Finder for Rays<'_> {
    fn sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        let mut bearing = Bearing::new(&self.edges);
        let reaches = self.edges.reaches(sectors);
        let mut seen = vec![NONE; self.field.points().len() * reaches.len()];
        for row in rows.iter_mut() {
            row.vertices.fill(Horizon::ALL);
        }
        for part in 0..sectors.parts() {
            let way = sectors.middle(sector, part);
            bearing.turn(self.field, way);
            look(&mut bearing, &reaches, &mut seen);
            for (vertex, seen) in seen.chunks_exact(reaches.len()).enumerate() {
                let from = self.field.point(vertex as u32);
                for (row, &half) in rows.iter_mut().zip(seen) {
                    let found = resolve(self.field, from, way, half).map(|crossing| Horizon {
                        slope: slope(from, crossing.at) as f32,
                        distance: (crossing.at - from).truncate().length() as f32,
                    });
                    let horizon = &mut row.vertices[vertex];
                    *horizon = horizon.and(found.unwrap_or(Horizon::OPEN));
                }
            }
        }
        for row in rows {
            row.of_ends(self.field);
        }
    }
}
