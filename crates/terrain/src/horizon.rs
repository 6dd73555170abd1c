//! Horizons: for every vertex of a height field and every sector of directions, below which slope and beyond which distance nobody sees it.
//!
//! Seen from a vertex, the terrain rises to a horizon in every direction. Whoever is farther away than what makes that horizon, and lower
//! than the line over it, does not see the vertex, nor does the vertex see them: Stewart 1998. A [`Horizons`] table says so for whole
//! sectors of directions, and for several reaches. Three [`Method`]s fill it.

mod bearing;
mod bundle;
pub(crate) mod compass;
mod crossing;
mod rays;
mod sectors;
mod sound;
pub(crate) mod standing;
mod thesis;
mod walk;

use std::fmt;
use std::str::FromStr;

use glam::DVec3;
use rayon::prelude::*;

use crate::field::Field;

pub use sectors::Sectors;

/// Where nobody is seen from in one sector: farther away than `distance` and lower than a line that rises by `slope`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Horizon {
    /// Metres up a metre away.
    pub slope: f32,
    /// Metres in the plan.
    pub distance: f32,
}

impl Horizon {
    /// Hides nothing.
    pub const OPEN: Self = Self {
        slope: f32::NEG_INFINITY,
        distance: f32::INFINITY,
    };

    /// Hides everybody: before anything has been looked at.
    pub(crate) const ALL: Self = Self {
        slope: f32::INFINITY,
        distance: 0.0,
    };

    /// Whether somebody `far` metres away in the plan and `up` metres higher is hidden.
    #[must_use]
    pub fn hides(&self, far: f64, up: f64) -> bool {
        far >= f64::from(self.distance) && up < f64::from(self.slope) * far
    }

    /// What is hidden behind both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            slope: self.slope.min(other.slope),
            distance: self.distance.max(other.distance),
        }
    }
}

/// How horizons are found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Edmondson's, after Stewart: the highest vertex of each sub-sector, the lowest of those of a sector. It misses edges that cross a
    /// sub-sector between two vertices, and claims the highest vertex for directions in which the terrain is lower. It has one reach, whatever
    /// is asked for.
    Thesis,
    /// The exact horizon along the middle of each sub-sector, the lowest of those of a sector. It claims it for all directions between.
    Rays,
    /// What is hidden in every direction of the sector: exact horizons along the ends of each sub-sector, and between them the lowest place
    /// of a wall of terrain that every direction crosses. Nothing is claimed where a direction leaves the field.
    #[default]
    Sound,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Thesis, Self::Rays, Self::Sound];

    /// The sectors with as many of their reaches as it knows.
    fn of(self, sectors: Sectors) -> Sectors {
        match self {
            Self::Thesis => sectors.far(),
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

/// What horizons are found of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Scope {
    /// Each vertex.
    Vertices,
    /// Each vertex, and each edge with all its places: a triangle may be seen between corners that are not, but not between edges that
    /// are not. [`Method::Sound`] alone looks at edges; the others take what both ends have.
    #[default]
    Surface,
}

/// A horizon for every vertex, and perhaps every edge, sector and reach.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizons {
    sectors: Sectors,
    vertices: usize,
    /// Vertices and edges.
    places: usize,
    /// For each reach of each sector a row of vertices and then of edges.
    table: Vec<Horizon>,
}

impl Horizons {
    /// Finds the horizons of a field; `done` is told of every sector finished. Sectors run side by side. It takes eight bytes a vertex, sector and
    /// reach, and as many for each edge.
    pub fn find(
        field: &Field,
        sectors: Sectors,
        method: Method,
        scope: Scope,
        done: &(dyn Fn() + Sync),
    ) -> Self {
        let sectors = method.of(sectors);
        let vertices = field.points().len();
        let edges = match scope {
            Scope::Vertices => 0,
            Scope::Surface => field.edges().len(),
        };
        let places = vertices + edges;
        let mut table = vec![Horizon::OPEN; places * sectors.rows()];
        let finder: Box<dyn Finder> = match method {
            Method::Thesis => Box::new(thesis::Thesis::new(field)),
            Method::Rays => Box::new(rays::Rays::new(field)),
            Method::Sound => Box::new(sound::Sound::new(field)),
        };
        table
            .par_chunks_mut((places * sectors.reaches() as usize).max(1))
            .enumerate()
            .for_each(|(sector, reaches)| {
                let row = |row| Row::new(row, vertices);
                let mut rows: Vec<Row<'_>> = reaches.chunks_mut(places.max(1)).map(row).collect();
                finder.sector(&sectors, sector as u32, &mut rows);
                done();
            });
        Self {
            sectors,
            vertices,
            places,
            table,
        }
    }

    /// Those of a field that is the first part of this one: its triangles are the first here, and so are its vertices and edges.
    #[must_use]
    pub(crate) fn first(self, part: &Field) -> Self {
        let [vertices, edges] = [part.points().len(), part.edges().len()];
        let rows = self.table.chunks(self.places.max(1));
        let kept = rows.flat_map(|row| {
            let (points, sides) = row.split_at(self.vertices);
            points.iter().take(vertices).chain(sides.iter().take(edges))
        });
        Self {
            table: kept.copied().collect(),
            sectors: self.sectors,
            vertices,
            places: vertices + edges,
        }
    }

    /// The sectors, with as many reaches as the method knows.
    #[must_use]
    pub fn sectors(&self) -> &Sectors {
        &self.sectors
    }

    /// The horizon of a vertex in a sector and reach; [`Horizon::OPEN`] where there is no such. Whoever is hidden by that of any reach is hidden.
    #[must_use]
    pub fn at(&self, vertex: u32, sector: u32, reach: u32) -> Horizon {
        let known = (vertex as usize) < self.vertices;
        let row = self.row(sector, reach);
        let horizon = row.get(vertex as usize).filter(|_| known);
        horizon.copied().unwrap_or(Horizon::OPEN)
    }

    /// The horizon of an edge, by its number in [`Field::edges`]: it holds at each of its places, at that place's own height and distance.
    #[must_use]
    pub fn along(&self, edge: u32, sector: u32, reach: u32) -> Horizon {
        let row = self.row(sector, reach);
        let horizon = row.get(self.vertices + edge as usize);
        horizon.copied().unwrap_or(Horizon::OPEN)
    }

    /// Whether all of an edge of this field between its ends is hidden from somebody at `from`, metres east, north and up of the field's origin. An end may
    /// be seen where what hides the rest begins at it.
    ///
    /// Both ends do not speak for what lies between: somebody right before an edge is nearer to its middle than to its ends. So the nearest of its places is
    /// asked for, and the one that comes closest to the line over the horizon.
    #[must_use]
    pub fn hides_edge(&self, field: &Field, edge: u32, from: DVec3) -> bool {
        let Some(&half) = field.edges().get(edge as usize) else {
            return false;
        };
        let ends = field.ends(half);
        let [first, last] = ends.map(|end| self.sectors.containing((from - end).truncate()));
        let Some(sector) = first.filter(|_| first == last) else {
            return false;
        };
        let long = (ends[1] - ends[0]).truncate().length();
        let along = (ends[1] - ends[0]) / long;
        let away = (from - ends[0]).truncate();
        let (foot, aside) = (
            away.dot(along.truncate()),
            away.perp_dot(along.truncate()).abs(),
        );
        let nearest = (foot - foot.clamp(0.0, long)).hypot(aside);
        (0..self.sectors.reaches()).any(|reach| {
            let horizon = self.along(edge, sector, reach);
            // Where the edge rises as fast as the line over the horizon falls with a place that comes nearer; a falling line is lowest at an end.
            let turn = along.z / f64::from(horizon.slope);
            let lowest = foot - turn * aside / (1.0 - turn * turn).max(0.0).sqrt();
            let places = [
                0.0,
                long,
                if lowest.is_finite() {
                    lowest.clamp(0.0, long)
                } else {
                    0.0
                },
            ];
            nearest >= f64::from(horizon.distance)
                && places.into_iter().all(|place| {
                    let up = from.z - ends[0].z - along.z * place;
                    up < f64::from(horizon.slope) * (foot - place).hypot(aside)
                })
        })
    }

    fn row(&self, sector: u32, reach: u32) -> &[Horizon] {
        let reaches = self.sectors.reaches();
        if reach >= reaches {
            return &[];
        }
        let first = (sector as usize * reaches as usize + reach as usize) * self.places;
        let row = self.table.get(first..first + self.places);
        row.unwrap_or_default()
    }

    /// Whether a vertex of this field is hidden from somebody at `from`, metres east, north and up of the field's origin.
    #[must_use]
    pub fn hides(&self, field: &Field, vertex: u32, from: DVec3) -> bool {
        let away = from - field.point(vertex);
        let Some(sector) = self.sectors.containing(away.truncate()) else {
            return false;
        };
        let far = away.truncate().length();
        (0..self.sectors.reaches()).any(|reach| self.at(vertex, sector, reach).hides(far, away.z))
    }
}

/// Horizons in one reach of one sector, [`Horizon::OPEN`] until found.
struct Row<'a> {
    vertices: &'a mut [Horizon],
    /// Empty where edges are not asked for.
    edges: &'a mut [Horizon],
}

impl<'a> Row<'a> {
    fn new(row: &'a mut [Horizon], vertices: usize) -> Self {
        let (vertices, edges) = row.split_at_mut(vertices);
        Self { vertices, edges }
    }

    fn len(&self) -> usize {
        self.vertices.len() + self.edges.len()
    }

    /// Takes for each edge what both of its ends have.
    fn of_ends(&mut self, field: &Field) {
        for (horizon, &half) in self.edges.iter_mut().zip(field.edges()) {
            let [a, b] = [field.start(half), field.end(half)];
            *horizon = self.vertices[a as usize].and(self.vertices[b as usize]);
        }
    }
}

/// One of the three ways.
trait Finder: Sync {
    /// Fills in all horizons of one sector, a row a reach.
    fn sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]);
}
