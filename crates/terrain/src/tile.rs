//! Fields cut into tiles, so that horizons are found tile by tile and are never all in memory at once. A field is cut along its edges, and
//! every tile keeps the field's origin: two tiles share a border bit for bit, and so pixel for pixel on every screen.
//!
//! A tile may have a margin of its neighbours' triangles. Horizons take the margin into account, and hold only beside those neighbours: see
//! [`TerrainTiles`](crate::TerrainTiles).

use glam::DVec3;

use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::packed_tree::{Extent, PackedTree};

/// The most columns and rows of tiles.
const MOST: u32 = 4096;

/// A tile of a field, and its margin of triangles around it.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// The tile's own triangles first, then those of its margin.
    field: Field,
    own_triangles: usize,
}

/// A tile without its margin, and with it.
pub(crate) struct SplitTile {
    /// The tile alone. Its vertices, edges and triangles are the first of `with_margin`.
    pub field: Field,
    /// The tile and its margin; `None` if it has no margin.
    pub with_margin: Option<Field>,
}

impl Tile {
    /// A whole field as one tile, without a margin.
    #[must_use]
    pub fn whole(field: Field) -> Self {
        Self {
            own_triangles: field.triangles().len(),
            field,
        }
    }

    /// A tile of some triangles of a field, with others as its margin.
    fn of_triangles(field: &Field, own: &[u32], margin: &[u32]) -> Result<Self, TerrainError> {
        Ok(Self {
            field: subset(field, own.iter().chain(margin).copied())?,
            own_triangles: own.len(),
        })
    }

    /// The tile with its margin, its own triangles first.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// The number of its own triangles.
    #[must_use]
    pub fn own_triangles(&self) -> usize {
        self.own_triangles
    }

    /// The tile as the GPU draws it: see [`Field::rounded`].
    ///
    /// # Errors
    /// As [`Field::rounded`].
    pub(crate) fn rounded(self) -> Result<Self, TerrainError> {
        Ok(Self {
            field: self.field.rounded()?,
            own_triangles: self.own_triangles,
        })
    }

    /// The tile without its margin, and with it.
    pub(crate) fn split(self) -> Result<SplitTile, TerrainError> {
        if self.own_triangles == self.field.triangles().len() {
            return Ok(SplitTile {
                field: self.field,
                with_margin: None,
            });
        }
        // Vertices are numbered in the order in which triangles use them, so the numbers are the same in both fields.
        Ok(SplitTile {
            field: subset(&self.field, 0..self.own_triangles as u32)?,
            with_margin: Some(self.field),
        })
    }
}

/// A field of some triangles of another one, in the given order, about the same origin.
fn subset(field: &Field, triangles: impl Iterator<Item = u32>) -> Result<Field, TerrainError> {
    let mut indices = vec![NONE; field.points().len()];
    let mut points: Vec<DVec3> = Vec::new();
    let renumbered = triangles.map(|triangle| {
        field.triangles()[triangle as usize].map(|corner| {
            let index = &mut indices[corner as usize];
            if *index == NONE {
                *index = points.len() as u32;
                points.push(field.point(corner));
            }
            *index
        })
    });
    let renumbered = renumbered.collect();
    Field::with_origin(field.origin(), points, renumbered)
}

impl Field {
    /// Cuts the field into tiles: columns from west to east and rows from south to north. A triangle belongs to the tile that its centroid is
    /// in. The margin of a tile consists of all triangles whose bounding boxes reach within `margin` metres of the tile's bounding box; with
    /// 0 there is none. Tiles without a triangle are left out.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] if `columns` or `rows` is not 1 to 4,096, or `margin` is negative, NaN or infinite.
    pub fn cut_into_tiles(
        &self,
        columns: u32,
        rows: u32,
        margin: f64,
    ) -> Result<Vec<Tile>, TerrainError> {
        for (what, count) in [("columns of tiles", columns), ("rows of tiles", rows)] {
            if !(1..=MOST).contains(&count) {
                return Err(TerrainError::Setting {
                    what,
                    value: count.to_string(),
                    problem: "give 1 to 4096",
                });
            }
        }
        if !(margin >= 0.0 && margin.is_finite()) {
            return Err(TerrainError::Setting {
                what: "the margin of tiles",
                value: margin.to_string(),
                problem: "give metres, 0 or more",
            });
        }
        let [low, high] = self.plan_bounds();
        let plan = |triangle| self.corners(triangle).map(DVec3::truncate);
        let all = || 0..self.triangles().len() as u32;
        let tile_of = |triangle: u32| {
            let [a, b, c] = plan(triangle);
            let share = ((a + b + c) / 3.0 - low) / (high - low);
            let [column, row] = [(share.x, columns), (share.y, rows)]
                .map(|(share, count)| ((share * f64::from(count)) as u32).min(count - 1));
            row * columns + column
        };
        let mut by_tile: Vec<(u32, u32)> = all()
            .map(|triangle| (tile_of(triangle), triangle))
            .collect();
        by_tile.sort_unstable();
        let extents: Vec<Extent> = all()
            .map(|triangle| Extent::around(plan(triangle)))
            .collect();
        let tree = PackedTree::new(&extents);
        let tiles = by_tile.chunk_by(|(a, _), (b, _)| a == b).map(|run| {
            let own: Vec<u32> = run.iter().map(|&(_, triangle)| triangle).collect();
            let around = own.iter().fold(Extent::EMPTY, |around, &triangle| {
                around.join(&extents[triangle as usize])
            });
            let reach = Extent {
                low: around.low - margin,
                high: around.high + margin,
            };
            let mut beside = Vec::new();
            if margin > 0.0 {
                tree.each_touching(&reach, |triangle| beside.push(triangle));
                beside.retain(|triangle| own.binary_search(triangle).is_err());
                beside.sort_unstable();
            }
            Tile::of_triangles(self, &own, &beside)
        });
        tiles.collect()
    }
}
