//! Optimisation of triangle and vertex order for the GPU's vertex cache and vertex fetch, by meshoptimizer (Arseny
//! Kapoulkine).

use antumbra_scene::Geometry;

/// The geometry with its triangles in an order that suits the vertex cache, and its vertices in the order of use.
pub(super) fn optimised(mut geometry: Geometry) -> Geometry {
    let count = geometry.positions.len();
    // Where very many triangles share a vertex, the order would take as long to find as a simplification.
    if geometry.indices.is_empty() || count == 0 || !geometry.is_collapsible() {
        return geometry;
    }
    meshopt::optimize_vertex_cache_in_place(&mut geometry.indices, count);
    super::split::compact(&geometry, &geometry.indices)
}
