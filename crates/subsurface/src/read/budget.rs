//! The memory that a file becomes: what is read, the surfaces, and what their preparation takes.

use std::fmt::Display;

use antumbra_files::{MemoryBudget, default_memory};

use super::options::ReadOptions;

/// Bytes of a surface without its vertices: names, meshes, an entity, a material.
const SURFACE: u64 = 4096;
/// Bytes of a vertex with its two triangles: as it is read, in the simplifier, and in tiles and levels.
const VERTEX: u64 = 512;
/// Bytes of a triangle beyond two a vertex: as it is read, in the tables of its edges and neighbours, in the simplifier, in tiles and levels.
const TRIANGLE: u64 = 256;
/// Bytes of a node of a grid: its cell's eight corners, and the heights that they are read from.
const NODE: u64 = 64;

/// What a file may still take.
pub(super) struct ReadBudget(MemoryBudget);

impl ReadBudget {
    /// The budget of a file of this length.
    pub(super) fn new(options: &ReadOptions, length: usize) -> Result<Self, String> {
        let mut budget = Self(MemoryBudget::new(
            options.max_memory.unwrap_or_else(default_memory),
        ));
        budget.take(length as u64, || "the file")?;
        Ok(budget)
    }

    pub(super) fn left(&self) -> u64 {
        self.0.left()
    }

    /// Takes memory for a part of the file.
    pub(super) fn take<P: Display>(
        &mut self,
        bytes: u64,
        part: impl FnOnce() -> P,
    ) -> Result<(), String> {
        self.0.take(bytes, part).map_err(|over| over.to_string())
    }

    /// Takes memory for surfaces of so many vertices each.
    pub(super) fn surfaces<P: Display>(
        &mut self,
        count: u64,
        vertices: u64,
        part: impl FnOnce() -> P,
    ) -> Result<(), String> {
        let each = vertices.saturating_mul(VERTEX).saturating_add(SURFACE);
        self.take(count.saturating_mul(each), part)
    }

    /// Takes memory for one more vertex of a surface.
    pub(super) fn vertex<P: Display>(&mut self, part: impl FnOnce() -> P) -> Result<(), String> {
        self.take(VERTEX, part)
    }

    /// Takes memory for one more triangle of a surface, besides the two of each vertex.
    pub(super) fn triangle<P: Display>(&mut self, part: impl FnOnce() -> P) -> Result<(), String> {
        self.take(TRIANGLE, part)
    }

    /// Takes memory for a horizon with a vertex at each node.
    pub(super) fn horizon(&mut self, columns: u32, rows: u32) -> Result<(), String> {
        let nodes = u64::from(columns) * u64::from(rows);
        self.surfaces(1, nodes, || {
            format!("the horizon of its {columns} x {rows} nodes")
        })
    }

    /// Takes memory for the nodes of a grid.
    pub(super) fn nodes(&mut self, size: [u32; 3]) -> Result<(), String> {
        let sides = size.map(|cells| u64::from(cells) + 1);
        let nodes = sides.into_iter().fold(1, u64::saturating_mul);
        let [nx, ny, nz] = size;
        self.take(nodes.saturating_mul(NODE), || {
            format!("its {nx} x {ny} x {nz} cells")
        })
    }
}
