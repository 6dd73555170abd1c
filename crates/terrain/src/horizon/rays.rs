//! The method `rays`: the exact horizon along the middle of each sub-sector, for all vertices of a field.
//!
//! Each search for the highest edge starts with the edges found for the vertex before and in the direction before.

use super::crossing::{resolve, slope};
use super::finder::{Finder, Row};
use super::rotated_edges::{PackedEdges, RotatedEdges};
use super::sectors::Sectors;
use super::value::Horizon;
use crate::field::{Field, NONE};

/// The method `rays` over a field.
pub(super) struct Rays<'a> {
    field: &'a Field,
    edges: PackedEdges,
}

impl<'a> Rays<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self {
            field,
            edges: PackedEdges::new(field),
        }
    }
}

impl Finder for Rays<'_> {
    fn find_sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        let mut rotated = RotatedEdges::new(&self.edges);
        let reaches = self.edges.reach_distances(sectors);
        let mut highest = vec![NONE; self.field.points().len() * reaches.len()];
        for row in rows.iter_mut() {
            row.vertices.fill(Horizon::ALL);
        }
        for part in 0..sectors.parts() {
            let direction = sectors.sub_sector_middle(sector, part);
            rotated.rotate(self.field, direction);
            rotated.update_highest(&reaches, &mut highest);
            for (vertex, highest) in highest.chunks_exact(reaches.len()).enumerate() {
                let from = self.field.point(vertex as u32);
                for (row, &half_edge) in rows.iter_mut().zip(highest) {
                    let crossing = resolve(self.field, from, direction, half_edge);
                    let found = crossing.map(|crossing| Horizon {
                        slope: slope(from, crossing.at) as f32,
                        distance: (crossing.at - from).truncate().length() as f32,
                    });
                    let horizon = &mut row.vertices[vertex];
                    *horizon = horizon.and(found.unwrap_or(Horizon::OPEN));
                }
            }
        }
        for row in rows {
            row.fill_edges_from_ends(self.field);
        }
    }
}
