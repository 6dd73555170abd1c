//! What the three methods have in common: each fills the horizons of one sector.

use super::sectors::Sectors;
use super::value::Horizon;
use crate::field::Field;

/// The horizons of one reach of one sector, [`Horizon::OPEN`] until they are found.
pub(super) struct Row<'a> {
    pub vertices: &'a mut [Horizon],
    /// Empty where no horizons of edges are wanted.
    pub edges: &'a mut [Horizon],
}

impl<'a> Row<'a> {
    /// Splits a row into the horizons of `vertices` vertices and those of edges.
    pub fn new(row: &'a mut [Horizon], vertices: usize) -> Self {
        let (vertices, edges) = row.split_at_mut(vertices);
        Self { vertices, edges }
    }

    pub fn len(&self) -> usize {
        self.vertices.len() + self.edges.len()
    }

    /// Sets the horizon of each edge to what the horizons of both its ends hide.
    pub fn fill_edges_from_ends(&mut self, field: &Field) {
        for (horizon, &half_edge) in self.edges.iter_mut().zip(field.edges()) {
            let [a, b] = [field.start(half_edge), field.end(half_edge)];
            *horizon = self.vertices[a as usize].and(self.vertices[b as usize]);
        }
    }
}

/// A method that finds horizons.
pub(super) trait Finder: Sync {
    /// Finds all horizons of one sector. `rows` has one row for each reach.
    fn find_sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]);
}
