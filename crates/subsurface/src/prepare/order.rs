//! The order of triangles and vertices that draws fastest: each vertex is transformed once where the cache allows, and fetched in order.
//! (meshoptimizer's, Arseny Kapoulkine.)

use antumbra_scene::Geometry;

/// The same geometry, its triangles in an order that uses the vertex cache well, its vertices in the order of use.
pub(super) fn for_drawing(mut geometry: Geometry) -> Geometry {
    let count = geometry.positions.len();
    if geometry.indices.is_empty() || count == 0 {
        return geometry;
    }
    meshopt::optimize_vertex_cache_in_place(&mut geometry.indices, count);
    super::cut::compact(&geometry, &geometry.indices)
}
