//! The method `sound`: a horizon is claimed only where every direction of the sector is blocked, whatever the terrain does between the
//! directions that are searched.
//!
//! The highest edges are found along both ends of every sub-sector. Between the two, a wall is walked over the terrain. See [`Bundle`].

use super::bundle::{Bundle, WallPoints};
use super::crossing::{Crossing, resolve};
use super::finder::{Finder, Row};
use super::rotated_edges::{PackedEdges, RotatedEdges};
use super::sectors::Sectors;
use super::value::WideHorizon;
use crate::field::{Field, NONE};

/// The method `sound` over a field.
pub(super) struct Sound<'a> {
    field: &'a Field,
    edges: PackedEdges,
}

/// One sub-sector.
#[derive(Clone, Copy)]
struct SubSector {
    sector: u32,
    part: u32,
}

/// The highest edge on a line of a bundle.
#[derive(Clone, Copy, PartialEq)]
struct Highest {
    /// The direction of the line: 0 for the rightmost, 1 for the leftmost.
    side: usize,
    /// The end of the bundle's edge that the line starts at.
    end: usize,
    /// The highest edge on it, as a half-edge, or [`NONE`].
    half_edge: u32,
}

impl<'a> Sound<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self {
            field,
            edges: PackedEdges::new(field),
        }
    }

    /// Lowers the horizons of all bundles, one for each reach, to what is blocked in one sub-sector as well. `highest` has the highest
    /// edges of all vertices and reaches along the right and the left end of the sub-sector.
    fn include_sub_sector(
        &self,
        sectors: &Sectors,
        SubSector { sector, part }: SubSector,
        highest: [&[u32]; 2],
        horizons: &mut [WideHorizon],
    ) {
        let field = self.field;
        let reaches = sectors.reaches() as usize;
        let directions = [part, part + 1].map(|part| sectors.sub_sector_start(sector, part));
        for (index, horizons) in horizons.chunks_exact_mut(reaches).enumerate() {
            // Vertices first, then edges.
            let vertices = match index.checked_sub(field.points().len()) {
                None => [index as u32; 2],
                Some(edge) => {
                    let half_edge = field.edges()[edge];
                    [field.start(half_edge), field.end(half_edge)]
                }
            };
            let points = vertices.map(|vertex| field.point(vertex));
            let bundle = Bundle::from_edge(points, directions);
            let (starts, front) = (bundle.starts(), bundle.front());
            let lines = [(0, starts[0]), (1, starts[1]), (0, front), (1, front)];
            let mut found = [WideHorizon::OPEN; Sectors::MOST_REACHES as usize];
            let mut farther = None;
            for ((reach, horizon), new) in horizons.iter().enumerate().zip(&mut found) {
                if horizon.slope == f64::NEG_INFINITY {
                    continue;
                }
                let highest = lines.map(|(side, end)| Highest {
                    side,
                    end,
                    half_edge: highest[side][vertices[end] as usize * reaches + reach],
                });
                *new = match farther {
                    // The same edges are highest as within the farther reach, so the walls are the same.
                    Some((same, found)) if same == highest => found,
                    _ => self.best_wall(&bundle, vertices, highest, horizon.slope),
                };
                farther = Some((highest, *new));
            }
            // A wall through lower edges may be higher between its ends, and the terrain of a nearer reach is part of the farther ones.
            let mut nearer = WideHorizon::OPEN;
            for (horizon, found) in horizons.iter_mut().zip(found).rev() {
                if found.slope > nearer.slope {
                    nearer = found;
                }
                *horizon = horizon.and(nearer);
            }
        }
    }

    /// The horizon of the best wall through the highest edges: on the bundle's outermost lines, then on the lines from its front end.
    fn best_wall(
        &self,
        bundle: &Bundle,
        vertices: [u32; 2],
        highest: [Highest; 4],
        enough: f64,
    ) -> WideHorizon {
        let [right, left, front_right, front_left] = highest;
        let crossing = |line: Highest| -> Option<Crossing> {
            let from = self.field.point(vertices[line.end]);
            let direction = bundle.directions()[line.side];
            resolve(self.field, from, direction, line.half_edge)
        };
        let other = |line: Highest| {
            // Not for a vertex, and not where this line is an outermost one.
            let new = vertices[0] != vertices[1] && bundle.starts()[line.side] != line.end;
            new.then(|| crossing(line)).flatten()
        };
        let points = WallPoints {
            outermost: [right, left].map(crossing),
            other: [front_right, front_left].map(other),
        };
        bundle.best_horizon(self.field, &points, enough)
    }
}

impl Finder for Sound<'_> {
    fn find_sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        let field = self.field;
        let mut rotated = RotatedEdges::new(&self.edges);
        let reaches = self.edges.reach_distances(sectors);
        let none = vec![NONE; field.points().len() * reaches.len()];
        let mut highest = [none.clone(), none];
        let count: usize = rows.iter().map(Row::len).sum();
        let mut horizons = vec![WideHorizon::ALL; count];
        rotated.rotate(field, sectors.sub_sector_start(sector, 0));
        rotated.update_highest(&reaches, &mut highest[0]);
        for part in 0..sectors.parts() {
            let [right, left] = &mut highest;
            left.copy_from_slice(right);
            rotated.rotate(field, sectors.sub_sector_start(sector, part + 1));
            rotated.update_highest(&reaches, left);
            let sub_sector = SubSector { sector, part };
            self.include_sub_sector(sectors, sub_sector, [right, left], &mut horizons);
            highest.swap(0, 1);
        }
        for (reach, row) in rows.iter_mut().enumerate() {
            let stored = row.vertices.iter_mut().chain(row.edges.iter_mut());
            let found = horizons.iter().skip(reach).step_by(reaches.len());
            for (stored, found) in stored.zip(found) {
                *stored = found.rounded();
            }
        }
    }
}
