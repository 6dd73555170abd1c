//! Triangulated irregular networks (TINs) from rasters, by greedy insertion: the post farthest from the surface so far is inserted, until
//! the error or the number of vertices is as asked for. Garland, Heckbert, *Fast Polygonal Approximation of Terrains and Height Fields*,
//! 1995 ("Scape"), as implemented in the crate `delatin`. Edmondson's thesis makes its fields the same way. Edge collapse is faster, but
//! flips triangles in the plan.

use antumbra_scene::Raster;
use glam::{DVec2, DVec3};

use crate::error::TerrainError;
use crate::field::Field;
use crate::packed_tree::packed_order;

/// The level of detail of a field made from a raster.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RasterDetail {
    /// Every post.
    Full,
    /// About this number of vertices, within half a per cent where the posts allow it.
    Vertices(usize),
    /// No post farther than this above or below the surface, metres.
    Error(f64),
}

/// The most tries to reach a number of vertices.
const TRIES: usize = 24;
/// The relative error that is close enough to a number of vertices.
const CLOSE: f64 = 0.005;
/// The error that a search begins with, as a share of the relief: few vertices, and so a fast run.
const COARSE: f64 = 0.02;
/// How fast the number of vertices falls with the error, as powers of each other: a guess, which only decides how many runs a search takes.
const FALL: f64 = 1.4;
/// The greatest step of an error, as a logarithm.
const FARTHEST: f64 = 1.6;
/// The posts that a search begins with, about.
const PILOT: usize = 600_000;

impl Field {
    /// Makes a field from a raster. Where nodes are unknown the field has holes, whose rims keep every post.
    ///
    /// # Errors
    /// [`TerrainError::BadRaster`] for a raster without an area or a known cell, [`TerrainError::Setting`] for fewer than 4 vertices or an
    /// error that is negative or NaN.
    pub fn from_raster(raster: &Raster, detail: RasterDetail) -> Result<Self, TerrainError> {
        let bad = |problem: String| TerrainError::BadRaster { problem };
        if let Some(problem) = raster.problem() {
            return Err(bad(problem));
        }
        if raster.centre().is_none() {
            return Err(bad("every node is unknown".to_owned()));
        }
        let setting = |what, value: String, problem| {
            Err(TerrainError::Setting {
                what,
                value,
                problem,
            })
        };
        match detail {
            RasterDetail::Full => full(raster),
            RasterDetail::Error(error) if error >= 0.0 => Greedy::new(raster).field(error),
            RasterDetail::Error(error) => {
                setting("the error", error.to_string(), "give metres, 0 or more")
            }
            RasterDetail::Vertices(count) if count < 4 => setting(
                "the number of vertices",
                count.to_string(),
                "give 4 or more",
            ),
            RasterDetail::Vertices(count) if count >= raster.elevation.len() => full(raster),
            RasterDetail::Vertices(count) => Greedy::new(raster).search(count),
        }
    }
}

/// A field of all posts. Each cell is split along the diagonal that is shorter in space.
fn full(raster: &Raster) -> Result<Field, TerrainError> {
    let mut points = Vec::with_capacity(raster.elevation.len());
    for row in 0..raster.rows {
        points.extend((0..raster.columns).map(|column| post(raster, column, row)));
    }
    let at = |column: u32, row: u32| row * raster.columns + column;
    let mut triangles = Vec::new();
    for row in 0..raster.rows - 1 {
        for column in 0..raster.columns - 1 {
            let around = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let corners = around.map(|(u, v)| at(column + u, row + v));
            let [a, b, c, d] = corners.map(|corner| points[corner as usize]);
            let turn = usize::from(a.distance_squared(c) > b.distance_squared(d));
            for triangle in [[0, 1, 2], [0, 2, 3]] {
                let triangle = triangle.map(|corner| corners[(corner + turn) % 4]);
                if triangle
                    .iter()
                    .all(|corner| points[*corner as usize].is_finite())
                {
                    triangles.push(triangle);
                }
            }
        }
    }
    field_of_known(points, triangles)
}

/// The position of a post, metres east, north and up; its height is NaN where it is unknown.
fn post(raster: &Raster, column: u32, row: u32) -> DVec3 {
    let height = raster.elevation_at(column, row).map_or(f64::NAN, f64::from);
    raster.plan_position(column, row).extend(height)
}

/// A field of triangles whose corners are all known. Unknown points have no triangle.
fn field_of_known(mut points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Field, TerrainError> {
    if triangles.is_empty() {
        return Err(TerrainError::BadRaster {
            problem: "no three neighbouring nodes are known".to_owned(),
        });
    }
    for point in &mut points {
        // Points without a triangle are dropped, but must be finite.
        if !point.is_finite() {
            *point = DVec3::ZERO;
        }
    }
    // Greedy insertion numbers triangles in no useful order. Triangles that are near each other in memory are faster to process.
    let middle = |triangle: &[u32; 3]| {
        let corners = triangle.map(|corner| points[corner as usize].truncate());
        corners.into_iter().sum::<DVec2>() / 3.0
    };
    let middles: Vec<DVec2> = triangles.iter().map(middle).collect();
    let triangles = packed_order(&middles)
        .into_iter()
        .map(|at| triangles[at as usize])
        .collect();
    Field::new(points, triangles)
}

/// A mesh made by greedy insertion: points, some of them unknown, and triangles of known points.
#[derive(Default)]
struct GreedyMesh {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Greedy insertion over one raster.
struct Greedy<'a> {
    raster: &'a Raster,
    heights: Vec<f64>,
    /// The difference between the highest and the lowest post, metres.
    relief: f64,
}

impl<'a> Greedy<'a> {
    fn new(raster: &'a Raster) -> Self {
        let size = [raster.columns, raster.rows].map(|count| count as i64);
        let at = |column: i64, row: i64| {
            let inside = (0..size[0]).contains(&column) && (0..size[1]).contains(&row);
            inside
                .then(|| raster.elevation_at(column as u32, row as u32))
                .flatten()
        };
        let known = raster.elevation.iter().map(|height| f64::from(*height));
        let known = known.filter(|height| height.is_finite() && height.abs() <= 1e12);
        let (low, high) = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
            (low.min(height), high.max(height))
        });
        let relief = (high - low).max(f64::MIN_POSITIVE);
        // Unknown posts beside known ones become spikes, high and low in turn. No surface is close to them until all of them, and so all of
        // the rim, are its vertices.
        let height = |index: usize| {
            let (column, row) = (index as i64 % size[0], index as i64 / size[0]);
            if let Some(height) = at(column, row) {
                return f64::from(height);
            }
            let beside = (-1..=1).any(|v| (-1..=1).any(|u| at(column + u, row + v).is_some()));
            let spike = relief.max(1.0) * 1e6;
            match (beside, (column + row) % 2) {
                (false, _) => low,
                (true, 0) => low - spike,
                (true, _) => high + spike,
            }
        };
        Self {
            raster,
            heights: (0..raster.elevation.len()).map(height).collect(),
            relief,
        }
    }

    /// Inserts posts until none is farther than `error` metres from the surface.
    fn run(&self, error: f64) -> Result<GreedyMesh, TerrainError> {
        let size = (self.raster.columns as usize, self.raster.rows as usize);
        let (vertices, triangles) =
            delatin::triangulate(&self.heights, size, delatin::Error(error)).map_err(|error| {
                TerrainError::BadRaster {
                    problem: error.to_string(),
                }
            })?;
        let points: Vec<DVec3> = vertices
            .into_iter()
            .map(|(column, row)| post(self.raster, column as u32, row as u32))
            .collect();
        let triangles = triangles.into_iter().map(|(a, b, c)| [a, b, c]);
        let known = |corners: &[usize; 3]| corners.iter().all(|&at| points[at].is_finite());
        let triangles = triangles.filter(known);
        let triangles = triangles
            .map(|corners| corners.map(|corner| corner as u32))
            .collect();
        Ok(GreedyMesh { points, triangles })
    }

    fn field(&self, error: f64) -> Result<Field, TerrainError> {
        let made = self.run(error)?;
        field_of_known(made.points, made.triangles)
    }

    /// Finds the error that leaves about `wanted` vertices. A run takes the longer the more vertices it leaves, and the more posts there are: of many
    /// posts some are tried first.
    fn search(&self, wanted: usize) -> Result<Field, TerrainError> {
        let begin = match self.pilot(wanted) {
            Some(raster) => {
                Greedy::new(&raster)
                    .close(wanted, self.relief * COARSE)?
                    .error
            }
            None => self.relief * COARSE,
        };
        let GreedyMesh { points, triangles } = self.close(wanted, begin)?.mesh;
        field_of_known(points, triangles)
    }

    /// Every n-th post along each side, where those are few enough to be fast and many enough to tell.
    fn pilot(&self, wanted: usize) -> Option<Raster> {
        let Raster { columns, rows, .. } = *self.raster;
        let posts = self.raster.elevation.len();
        let stride = ((posts / PILOT) as f64).sqrt().ceil() as u32;
        let [across, down] = [columns, rows].map(|count| count.div_ceil(stride.max(1)));
        let kept = u64::from(across) * u64::from(down);
        if stride < 2 || kept < 4 * wanted as u64 || across.min(down) < 2 {
            return None;
        }
        let places = (0..down).flat_map(|row| (0..across).map(move |column| (column, row)));
        let height = |(column, row): (u32, u32)| {
            let height = self.raster.elevation_at(column * stride, row * stride);
            height.unwrap_or(f32::NAN)
        };
        Some(Raster {
            columns: across,
            rows: down,
            step_u: self.raster.step_u * f64::from(stride),
            step_v: self.raster.step_v * f64::from(stride),
            elevation: places.map(height).collect(),
            ..*self.raster
        })
    }

    /// Runs with one error after the other, from `error` on, until about `wanted` vertices are left: between two errors on both sides of it the
    /// logarithm of the number falls about evenly with that of the error.
    fn close(&self, wanted: usize, error: f64) -> Result<Run, TerrainError> {
        let target = (wanted as f64).ln();
        let bounds = [self.relief * 1e-9, self.relief * 2.0];
        // The nearest runs with too many and with too few vertices: the logarithms of their errors and numbers.
        let (mut many, mut few): (Option<DVec2>, Option<DVec2>) = (None, None);
        let mut best: Option<Run> = None;
        let mut error = error;
        for tried in 0..TRIES {
            let mesh = self.run(error)?;
            let count = mesh.points.iter().filter(|point| point.is_finite()).count();
            let at = DVec2::new(error.ln(), (count.max(1) as f64).ln());
            match count > wanted {
                true => many = Some(at),
                false => few = Some(at),
            }
            let missed = count.abs_diff(wanted);
            if best.as_ref().is_none_or(|best| missed < best.missed) {
                best = Some(Run {
                    error,
                    missed,
                    mesh,
                });
            }
            if missed as f64 <= wanted as f64 * CLOSE {
                break;
            }
            let next = match (many, few) {
                (Some(many), Some(few)) => {
                    let share = (many.y - target) / (many.y - few.y);
                    // Half-way now and then, where the numbers do not fall evenly.
                    let share = if tried % 3 == 2 { 0.5 } else { share };
                    many.x + (few.x - many.x) * share.clamp(0.05, 0.95)
                }
                _ => at.x + ((at.y - target) / FALL).clamp(-FARTHEST, FARTHEST),
            };
            let next = next.exp().clamp(bounds[0], bounds[1]);
            if next == error {
                break;
            }
            error = next;
        }
        Ok(best.unwrap_or_default())
    }
}

/// A run of greedy insertion.
#[derive(Default)]
struct Run {
    error: f64,
    /// How many vertices more or fewer than wanted are left.
    missed: usize,
    mesh: GreedyMesh,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(columns: u32, rows: u32) -> Raster {
        Raster {
            columns,
            rows,
            origin: DVec2::new(500.0, 4000.0),
            step_u: DVec2::new(10.0, 0.0),
            step_v: DVec2::new(0.0, -20.0),
            elevation: (0..columns * rows).map(|at| at as f32).collect(),
        }
    }

    #[test]
    fn many_posts_are_tried_few_at_a_time_first() {
        let whole = raster(1301, 1200);
        let greedy = Greedy::new(&whole);
        let Some(pilot) = greedy.pilot(8000) else {
            panic!("no pilot");
        };
        assert_eq!((pilot.columns, pilot.rows), (651, 600));
        assert!(pilot.elevation.len() <= PILOT);
        for (column, row) in [(0, 0), (1, 0), (0, 1), (650, 599)] {
            let of_whole = whole.elevation_at(2 * column, 2 * row);
            assert_eq!(pilot.elevation_at(column, row), of_whole);
            let place = whole.plan_position(2 * column, 2 * row);
            assert_eq!(pilot.plan_position(column, row), place);
        }
        // Too few posts would be left to tell, and few are fast as they are.
        assert!(greedy.pilot(pilot.elevation.len() / 4 + 1).is_none());
        assert!(Greedy::new(&raster(700, 800)).pilot(8000).is_none());
    }
}
