//! Where a mesh's geometries lie in the shared vertex and index arenas.

use antumbra_scene::Aabb;

#[cfg(doc)]
use super::OrientedBox;
use super::detail::MeshDetail;

/// One geometry in the shared vertex and index arenas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IndexRange {
    /// First index in the index arena.
    pub first_index: u32,
    /// Number of indices.
    pub index_count: u32,
    /// Added to every index.
    pub base_vertex: i32,
    /// Indices a primitive: 3, 2 or 1.
    pub corners: u32,
}

impl IndexRange {
    /// Triangles, lines or points.
    pub fn primitives(&self) -> u32 {
        self.index_count / self.corners.max(1)
    }
}

/// A mesh's geometries in the arenas.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshRanges {
    /// Levels of detail, the full one first; never empty.
    pub levels: Vec<IndexRange>,
    /// The proxy for tests; the full level where the mesh has none.
    pub proxy: IndexRange,
    /// The widened bounding box.
    pub boxed: IndexRange,
    /// By how much `boxed` is wider than `bounds` on every side, in the mesh's own units.
    pub box_margin: f64,
    /// By how much the proxy's surface deviates from the full mesh's, at most, in the mesh's own units.
    pub deviation: f64,
    /// The mesh lies in the ellipsoid whose half axes are those of `bounds` times this: 1 for a sphere, [`OrientedBox::ANGULAR`] for what reaches a corner.
    pub roundness: f32,
    /// The box with this part of the size of `bounds`, about the same centre, lies inside of the mesh ([`solid_part`](antumbra_scene::solid_part)); 0: there is none.
    pub solid: f32,
    /// The bounding box itself, in the mesh's own space.
    pub bounds: Aabb,
}

/// What is true of a mesh's new vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewShape {
    /// As [`MeshRanges::bounds`].
    pub bounds: Aabb,
    /// As [`MeshRanges::box_margin`].
    pub box_margin: f64,
}

impl MeshRanges {
    /// Where the geometry for some detail lies.
    pub fn range(&self, detail: MeshDetail) -> IndexRange {
        match detail {
            MeshDetail::Level(level) => {
                let coarsest = self.levels.len().saturating_sub(1);
                let level = self.levels.get(usize::from(level).min(coarsest));
                level.copied().unwrap_or_default()
            }
            MeshDetail::Proxy => self.proxy,
            MeshDetail::Box => self.boxed,
        }
    }
}
