//! A field cut into blocks, so that horizons are found block by block and never lie in memory all at once. It is cut along its edges, and every
//! block keeps the field's origin: the border that two of them share is the same in both, bit for bit, and on every screen.
//!
//! A block may have a margin of its neighbours' triangles. What they hide of it is found with it, and true only beside them: see
//! [`Blocks`](crate::Blocks).

use glam::DVec3;

use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::packed::{Boxes, Extent};

/// The most columns and rows of blocks.
const MOST: u32 = 4096;

/// A block of a field, and triangles around it.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The block's own triangles first, then those of its margin.
    field: Field,
    own: usize,
}

impl Part {
    /// All of a field.
    #[must_use]
    pub fn whole(field: Field) -> Self {
        Self {
            own: field.triangles().len(),
            field,
        }
    }

    /// Some triangles of a field and others around them.
    fn of(field: &Field, own: &[u32], margin: &[u32]) -> Result<Self, TerrainError> {
        Ok(Self {
            field: some(field, own.iter().chain(margin).copied())?,
            own: own.len(),
        })
    }

    /// The block with its margin, its own triangles first.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// How many triangles are its own.
    #[must_use]
    pub fn own(&self) -> usize {
        self.own
    }

    /// As it is drawn: see [`Field::rounded`].
    ///
    /// # Errors
    /// As there.
    pub(crate) fn rounded(self) -> Result<Self, TerrainError> {
        Ok(Self {
            field: self.field.rounded()?,
            own: self.own,
        })
    }

    /// The block alone, whose vertices are the part's first, and the part.
    pub(crate) fn split(self) -> Result<(Field, Option<Field>), TerrainError> {
        if self.own == self.field.triangles().len() {
            return Ok((self.field, None));
        }
        // Vertices are numbered as triangles name them, and so the same way in both.
        let own = some(&self.field, 0..self.own as u32)?;
        Ok((own, Some(self.field)))
    }
}

/// Some triangles of a field about the same origin, in this order.
fn some(field: &Field, triangles: impl Iterator<Item = u32>) -> Result<Field, TerrainError> {
    let mut names = vec![NONE; field.points().len()];
    let mut points: Vec<DVec3> = Vec::new();
    let named = triangles.map(|triangle| {
        field.triangles()[triangle as usize].map(|corner| {
            let name = &mut names[corner as usize];
            if *name == NONE {
                *name = points.len() as u32;
                points.push(field.point(corner));
            }
            *name
        })
    });
    let named = named.collect();
    Field::about(field.origin(), points, named)
}

impl Field {
    /// Cuts the field into columns from west to east and rows from south to north; a triangle belongs to the block that its middle is in. Each block
    /// has a margin of all triangles that reach within `margin` metres of the box around it; none for 0. Blocks without a
    /// triangle are left out.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for no columns or rows or more than 4,096, and a margin that is no length.
    pub fn cut(&self, columns: u32, rows: u32, margin: f64) -> Result<Vec<Part>, TerrainError> {
        for (what, count) in [("columns of blocks", columns), ("rows of blocks", rows)] {
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
                what: "the margin of blocks",
                value: margin.to_string(),
                problem: "give metres, 0 or more",
            });
        }
        let [low, high] = self.plan_bounds();
        let plan = |triangle| self.corners(triangle).map(DVec3::truncate);
        let all = || 0..self.triangles().len() as u32;
        let block = |triangle: u32| {
            let [a, b, c] = plan(triangle);
            let share = ((a + b + c) / 3.0 - low) / (high - low);
            let [column, row] = [(share.x, columns), (share.y, rows)]
                .map(|(share, count)| ((share * f64::from(count)) as u32).min(count - 1));
            row * columns + column
        };
        let mut blocks: Vec<(u32, u32)> = all().map(|at| (block(at), at)).collect();
        blocks.sort_unstable();
        let extents: Vec<Extent> = all().map(|at| Extent::around(plan(at))).collect();
        let boxes = Boxes::new(extents.clone());
        let parts = blocks.chunk_by(|(a, _), (b, _)| a == b).map(|run| {
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
                boxes.each_touching(&reach, |triangle| beside.push(triangle));
                beside.retain(|triangle| own.binary_search(triangle).is_err());
                beside.sort_unstable();
            }
            Part::of(self, &own, &beside)
        });
        parts.collect()
    }
}
