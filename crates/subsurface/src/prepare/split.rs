//! Splitting of a mesh along its own edges. Each triangle goes whole to the tile that contains its centroid. Border
//! vertices are copied unchanged, so neighbouring tiles meet exactly.

use antumbra_scene::Geometry;

/// The triangles in each of `n` x `n` tiles, row by row.
pub(super) fn by_centroid(geometry: &Geometry, plan: &[[f32; 2]], n: u32) -> Vec<Geometry> {
    let mut indices: Vec<Vec<u32>> = vec![Vec::new(); (n * n) as usize];
    for triangle in geometry.triangles() {
        let corners = triangle.map(|corner| plan.get(corner as usize).copied());
        let [Some(a), Some(b), Some(c)] = corners else {
            continue;
        };
        let tile = |axis: usize| {
            let middle = (f64::from(a[axis]) + f64::from(b[axis]) + f64::from(c[axis])) / 3.0;
            ((middle * f64::from(n)) as u32).min(n - 1)
        };
        if let Some(piece) = indices.get_mut((tile(1) * n + tile(0)) as usize) {
            piece.extend(triangle);
        }
    }
    let pieces = indices.into_iter();
    pieces.map(|piece| compact(geometry, &piece)).collect()
}

/// A geometry with these indices and only the vertices that they use, in the order of first use.
pub(super) fn compact(geometry: &Geometry, indices: &[u32]) -> Geometry {
    let mut renamed = std::collections::HashMap::with_capacity(indices.len() / 4);
    let mut kept = Geometry::default();
    for index in indices {
        let next = kept.positions.len() as u32;
        let name = *renamed.entry(*index).or_insert(next);
        if name == next {
            let at = *index as usize;
            let Some(position) = geometry.positions.get(at) else {
                continue;
            };
            kept.positions.push(*position);
            kept.normals.extend(geometry.normals.get(at));
            kept.uvs.extend(geometry.uvs.get(at));
            kept.colours.extend(geometry.colours.get(at));
        }
        kept.indices.push(name);
    }
    kept
}
