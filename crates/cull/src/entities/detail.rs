//! Which geometry of a mesh a draw uses.

/// One of a mesh's geometries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshDetail {
    /// A level of detail: 0 is the full mesh. A mesh with fewer levels draws its coarsest.
    Level(u8),
    /// The proxy for tests; the full mesh where it has none.
    Proxy,
    /// The mesh's bounding box in its own space, slightly widened: twelve triangles.
    Box,
}
