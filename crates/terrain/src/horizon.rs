//! Horizons: for every vertex of a height field and every sector of directions, a slope and a distance. A viewpoint below that slope and
//! beyond that distance does not see the vertex.
//!
//! Seen from a vertex, the terrain rises to a horizon in every direction. A viewpoint that is farther away than the terrain that forms the
//! horizon, and lower than the line over it, does not see the vertex (Stewart 1998). A [`Horizons`] table states this for whole sectors of
//! directions, and for several reaches. One of three [`Method`]s fills it.

pub(crate) mod boxes;
mod bundle;
mod crossing;
mod finder;
mod rays;
mod rotated_edges;
pub(crate) mod sector_lookup;
mod sectors;
mod sound;
mod thesis;
mod value;
mod walk;

use std::fmt;
use std::str::FromStr;

use glam::DVec3;
use rayon::prelude::*;

use crate::field::Field;
use finder::{Finder, Row};

pub use sectors::Sectors;
pub use value::Horizon;

/// The method that finds horizons.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Edmondson's, after Stewart: the highest vertex of each sub-sector, and the lowest of those of a sector. It misses edges that cross a
    /// sub-sector between two vertices, and claims the highest vertex for directions in which the terrain is lower. It has one reach,
    /// whatever the number of reaches asked for.
    Thesis,
    /// The exact horizon along the middle of each sub-sector, and the lowest of those of a sector. It is claimed for all directions of the
    /// sector.
    Rays,
    /// What is hidden in every direction of the sector. It takes exact horizons along the ends of each sub-sector, and between them the
    /// lowest point of a wall of terrain that every direction crosses. Nothing is claimed where a direction leaves the field.
    #[default]
    Sound,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::Thesis, Self::Rays, Self::Sound];

    /// The sectors with the reaches that the method supports.
    fn supported(self, sectors: Sectors) -> Sectors {
        match self {
            Self::Thesis => sectors.first_reach(),
            Self::Rays | Self::Sound => sectors,
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Thesis => "thesis",
            Self::Rays => "rays",
            Self::Sound => "sound",
        })
    }
}

impl FromStr for Method {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let named = |method: &Self| method.to_string() == text;
        Self::ALL.into_iter().find(named).ok_or(())
    }
}

/// What horizons are found for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Scope {
    /// For each vertex.
    Vertices,
    /// For each vertex and for each edge. A triangle may be visible between corners that are hidden, but not between edges that are hidden.
    /// [`Method::Sound`] alone searches from edges. With the other methods an edge has what the horizons of both its ends hide.
    #[default]
    Surface,
}

/// The horizons of all vertices of a field, and of all edges in [`Scope::Surface`], for each sector and reach.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizons {
    sectors: Sectors,
    /// The number of vertices.
    vertices: usize,
    /// The number of vertices and edges.
    row_length: usize,
    /// For each reach of each sector a row: the vertices, then the edges.
    table: Vec<Horizon>,
}

impl Horizons {
    /// Finds the horizons of a field. `done` is called once for each finished sector. Sectors run in parallel. The table takes eight bytes
    /// for each vertex, sector and reach, and as many for each edge.
    pub fn find(
        field: &Field,
        sectors: Sectors,
        method: Method,
        scope: Scope,
        done: &(dyn Fn() + Sync),
    ) -> Self {
        let sectors = method.supported(sectors);
        let vertices = field.points().len();
        let edges = match scope {
            Scope::Vertices => 0,
            Scope::Surface => field.edges().len(),
        };
        let row_length = vertices + edges;
        let mut table = vec![Horizon::OPEN; row_length * sectors.rows()];
        let finder: Box<dyn Finder> = match method {
            Method::Thesis => Box::new(thesis::Thesis::new(field)),
            Method::Rays => Box::new(rays::Rays::new(field)),
            Method::Sound => Box::new(sound::Sound::new(field)),
        };
        table
            .par_chunks_mut((row_length * sectors.reaches() as usize).max(1))
            .enumerate()
            .for_each(|(sector, reaches)| {
                let row = |row| Row::new(row, vertices);
                let mut rows: Vec<Row<'_>> =
                    reaches.chunks_mut(row_length.max(1)).map(row).collect();
                finder.find_sector(&sectors, sector as u32, &mut rows);
                done();
            });
        Self {
            sectors,
            vertices,
            row_length,
            table,
        }
    }

    /// The horizons of a part of this field whose vertices, edges and triangles are the first of this field.
    #[must_use]
    pub(crate) fn of_first(self, part: &Field) -> Self {
        let [vertices, edges] = [part.points().len(), part.edges().len()];
        let rows = self.table.chunks(self.row_length.max(1));
        let kept = rows.flat_map(|row| {
            let (of_vertices, of_edges) = row.split_at(self.vertices);
            of_vertices
                .iter()
                .take(vertices)
                .chain(of_edges.iter().take(edges))
        });
        Self {
            table: kept.copied().collect(),
            sectors: self.sectors,
            vertices,
            row_length: vertices + edges,
        }
    }

    /// The sectors, with the reaches that the method supports.
    #[must_use]
    pub fn sectors(&self) -> &Sectors {
        &self.sectors
    }

    /// The horizon of a vertex in a sector and reach; [`Horizon::OPEN`] if one of these does not exist. A vertex is hidden if the horizon of
    /// any reach hides it.
    #[must_use]
    pub fn of_vertex(&self, vertex: u32, sector: u32, reach: u32) -> Horizon {
        let known = (vertex as usize) < self.vertices;
        let row = self.row(sector, reach);
        let horizon = row.get(vertex as usize).filter(|_| known);
        horizon.copied().unwrap_or(Horizon::OPEN)
    }

    /// The horizon of an edge, by its index in [`Field::edges`]. It holds at each point of the edge, with that point's height and distance.
    #[must_use]
    pub fn of_edge(&self, edge: u32, sector: u32, reach: u32) -> Horizon {
        let row = self.row(sector, reach);
        let horizon = row.get(self.vertices + edge as usize);
        horizon.copied().unwrap_or(Horizon::OPEN)
    }

    /// Whether an edge of this field is hidden between its ends from a viewpoint at `from`, metres east, north and up of the field's
    /// origin. An end may be visible if the terrain that hides the rest begins at it.
    ///
    /// The ends alone do not decide about the points between: a viewpoint just before an edge is nearer to its middle than to its ends. So
    /// the nearest point of the edge is tested against the distance, and the point that comes closest to the line over the horizon against
    /// the slope.
    #[must_use]
    pub fn hides_edge(&self, field: &Field, edge: u32, from: DVec3) -> bool {
        let Some(&half_edge) = field.edges().get(edge as usize) else {
            return false;
        };
        let ends = field.ends(half_edge);
        let [first, last] = ends.map(|end| self.sectors.containing((from - end).truncate()));
        let Some(sector) = first.filter(|_| first == last) else {
            return false;
        };
        let length = (ends[1] - ends[0]).truncate().length();
        let along = (ends[1] - ends[0]) / length;
        let away = (from - ends[0]).truncate();
        let (foot, aside) = (
            away.dot(along.truncate()),
            away.perp_dot(along.truncate()).abs(),
        );
        let nearest = (foot - foot.clamp(0.0, length)).hypot(aside);
        (0..self.sectors.reaches()).any(|reach| {
            let horizon = self.of_edge(edge, sector, reach);
            // The point where the edge rises as fast as the line over the horizon falls. A falling line is lowest at an end.
            let turn = along.z / f64::from(horizon.slope);
            let lowest = foot - turn * aside / (1.0 - turn * turn).max(0.0).sqrt();
            let points = [
                0.0,
                length,
                if lowest.is_finite() {
                    lowest.clamp(0.0, length)
                } else {
                    0.0
                },
            ];
            nearest >= f64::from(horizon.distance)
                && points.into_iter().all(|at| {
                    let up = from.z - ends[0].z - along.z * at;
                    up < f64::from(horizon.slope) * (foot - at).hypot(aside)
                })
        })
    }

    fn row(&self, sector: u32, reach: u32) -> &[Horizon] {
        let reaches = self.sectors.reaches();
        if reach >= reaches {
            return &[];
        }
        let first = (sector as usize * reaches as usize + reach as usize) * self.row_length;
        let row = self.table.get(first..first + self.row_length);
        row.unwrap_or_default()
    }

    /// Whether a vertex of this field is hidden from a viewpoint at `from`, metres east, north and up of the field's origin.
    #[must_use]
    pub fn hides_vertex(&self, field: &Field, vertex: u32, from: DVec3) -> bool {
        let away = from - field.point(vertex);
        let Some(sector) = self.sectors.containing(away.truncate()) else {
            return false;
        };
        let distance = away.truncate().length();
        (0..self.sectors.reaches()).any(|reach| {
            let horizon = self.of_vertex(vertex, sector, reach);
            horizon.hides(distance, away.z)
        })
    }
}
