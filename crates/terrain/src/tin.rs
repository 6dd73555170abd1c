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

    /// Finds the error that leaves about `wanted` vertices, by bisection of its logarithm.
    fn search(&self, wanted: usize) -> Result<Field, TerrainError> {
        let (mut low, mut high) = (self.relief * 1e-9, self.relief * 2.0);
        let mut best: Option<(usize, GreedyMesh)> = None;
        for _ in 0..TRIES {
            let error = (low * high).sqrt();
            let made = self.run(error)?;
            let count = made.points.iter().filter(|point| point.is_finite()).count();
            if count > wanted {
                low = error;
            } else {
                high = error;
            }
            let missed = count.abs_diff(wanted);
            if best.as_ref().is_none_or(|(least, _)| missed < *least) {
                best = Some((missed, made));
            }
            if missed as f64 <= wanted as f64 * CLOSE {
                break;
            }
        }
        let (_, made) = best.unwrap_or_default();
        field_of_known(made.points, made.triangles)
    }
}
