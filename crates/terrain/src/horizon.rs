//! Horizons: for every vertex of a height field and every sector of directions, below which slope and beyond which distance nobody sees it.
//!
//! Seen from a vertex, the terrain rises to a horizon in every direction. Whoever is farther away than what makes that horizon, and lower
//! than the line over it, does not see the vertex, nor does the vertex see them: Stewart 1998. A [`Horizons`] table says so for whole
//! sectors of directions. Three [`Method`]s fill it.

mod bearing;
mod bundle;
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
    /// sub-sector between two vertices, and claims the highest vertex for directions in which the terrain is lower.
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

/// What a horizon is said of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Scope {
    /// Each vertex alone.
    Vertices,
    /// Each vertex with its edges: where both ends of an edge are hidden from somebody, so is every place of the edge, and where all three
    /// corners of a triangle are, so is the triangle. [`Method::Sound`] alone can say so.
    #[default]
    Surface,
}

/// A horizon for every vertex and sector.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizons {
    sectors: Sectors,
    vertices: usize,
    /// A row of vertices for each sector.
    table: Vec<Horizon>,
}

impl Horizons {
    /// Finds the horizons of all vertices; `done` is told of every sector finished. Sectors run side by side.
    pub fn find(
        field: &Field,
        sectors: Sectors,
        method: Method,
        scope: Scope,
        done: &(dyn Fn() + Sync),
    ) -> Self {
        let vertices = field.points().len();
        let mut table = vec![Horizon::OPEN; vertices * sectors.count() as usize];
        let finder: Box<dyn Finder> = match method {
            Method::Thesis => Box::new(thesis::Thesis::new(field)),
            Method::Rays => Box::new(rays::Rays::new(field)),
            Method::Sound => Box::new(sound::Sound::new(field, scope)),
        };
        table
            .par_chunks_mut(vertices.max(1))
            .enumerate()
            .for_each(|(sector, row)| {
                finder.sector(&sectors, sector as u32, row);
                done();
            });
        Self {
            sectors,
            vertices,
            table,
        }
    }

    /// The sectors.
    #[must_use]
    pub fn sectors(&self) -> &Sectors {
        &self.sectors
    }

    /// The horizon of a vertex in a sector; [`Horizon::OPEN`] where there is no such.
    #[must_use]
    pub fn at(&self, vertex: u32, sector: u32) -> Horizon {
        let row = sector as usize * self.vertices;
        let known = (vertex as usize) < self.vertices;
        let horizon = self.table.get(row + vertex as usize).filter(|_| known);
        horizon.copied().unwrap_or(Horizon::OPEN)
    }

    /// Whether a vertex of this field is hidden from somebody at `from`, metres east, north and up of the field's origin.
    #[must_use]
    pub fn hides(&self, field: &Field, vertex: u32, from: DVec3) -> bool {
        let away = from - field.point(vertex);
        let Some(sector) = self.sectors.containing(away.truncate()) else {
            return false;
        };
        self.at(vertex, sector)
            .hides(away.truncate().length(), away.z)
    }
}

/// One of the three ways.
trait Finder: Sync {
    /// Fills in the horizons of all vertices in one sector.
    fn sector(&self, sectors: &Sectors, sector: u32, row: &mut [Horizon]);
}
