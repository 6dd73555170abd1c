//! Spheres of triangles, made by subdividing an icosahedron. Tests and benchmarks use them.

use std::collections::HashMap;

use glam::Vec3;

use crate::mesh::Geometry;

/// A sphere around the origin, `radius` metres: an icosahedron whose triangles are split in four `splits` times (at
/// most 8). It has 20 * 4^splits triangles, counter-clockwise from outside, with normals.
#[must_use]
pub fn icosphere(splits: u32, radius: f32) -> Geometry {
    let corners = ICOSAHEDRON_VERTICES.into_iter().map(Vec3::from_array);
    let mut directions: Vec<Vec3> = corners.map(Vec3::normalize).collect();
    let mut triangles = ICOSAHEDRON_TRIANGLES.to_vec();
    for _ in 0..splits.min(8) {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let ends = [a, b].map(|i| directions.get(i as usize).copied().unwrap_or(Vec3::X));
                directions.push(ends.into_iter().sum::<Vec3>().normalize());
                directions.len() as u32 - 1
            })
        };
        triangles = (triangles.into_iter())
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    Geometry {
        positions: directions
            .iter()
            .map(|d| (*d * radius).to_array())
            .collect(),
        normals: directions.iter().map(|d| d.to_array()).collect(),
        indices: triangles.into_flattened(),
        ..Geometry::default()
    }
}

/// The golden ratio.
const PHI: f32 = 1.618_034;

/// The icosahedron of edge length 2.
const ICOSAHEDRON_VERTICES: [[f32; 3]; 12] = [
    [0.0, -1.0, -PHI],
    [-1.0, -PHI, 0.0],
    [-PHI, 0.0, -1.0],
    [0.0, -1.0, PHI],
    [-1.0, PHI, 0.0],
    [PHI, 0.0, -1.0],
    [0.0, 1.0, -PHI],
    [1.0, -PHI, 0.0],
    [-PHI, 0.0, 1.0],
    [0.0, 1.0, PHI],
    [1.0, PHI, 0.0],
    [PHI, 0.0, 1.0],
];

const ICOSAHEDRON_TRIANGLES: [[u32; 3]; 20] = [
    [0, 1, 2],
    [0, 7, 1],
    [0, 2, 6],
    [0, 6, 5],
    [0, 5, 7],
    [1, 8, 2],
    [1, 7, 3],
    [1, 3, 8],
    [2, 4, 6],
    [2, 8, 4],
    [3, 7, 11],
    [3, 9, 8],
    [3, 11, 9],
    [4, 10, 6],
    [4, 8, 9],
    [4, 9, 10],
    [5, 6, 10],
    [5, 11, 7],
    [5, 10, 11],
    [9, 11, 10],
];
