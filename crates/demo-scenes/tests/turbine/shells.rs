//! The closed shells of a geometry; vertices at one position count as one.

use antumbra_scene::{Geometry, Mesh};
use glam::DVec3;
use std::collections::HashMap;

/// Number of triangle edges without an opposite edge.
fn open_edges(geometry: &Geometry) -> usize {
    let names = welded(geometry);
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for triangle in geometry.triangles() {
        let [a, b, c] = triangle.map(|i| names[i as usize]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let way = if from < to { 1 } else { -1 };
            *edges.entry((from.min(to), from.max(to))).or_default() += way;
        }
    }
    edges.values().filter(|sum| **sum != 0).count()
}

/// Volume of each shell in cubic metres; positive if its triangles face outwards.
fn volumes(geometry: &Geometry) -> Vec<f64> {
    let names = welded(geometry);
    let mut above: Vec<u32> = (0..geometry.positions.len() as u32).collect();
    for triangle in geometry.triangles() {
        let [a, b, c] = triangle.map(|i| top(&mut above, names[i as usize]));
        above[b as usize] = a;
        let c = top(&mut above, c);
        above[c as usize] = a;
    }
    let mut sums: HashMap<u32, f64> = HashMap::new();
    for triangle in geometry.triangles() {
        let [a, b, c] = geometry.corners(triangle).unwrap();
        let shell = top(&mut above, names[triangle[0] as usize]);
        *sums.entry(shell).or_default() += a.dot(b.cross(c)) / 6.0;
    }
    sums.into_values().collect()
}

fn top(above: &mut [u32], mut name: u32) -> u32 {
    while above[name as usize] != name {
        let next = above[above[name as usize] as usize];
        above[name as usize] = next;
        name = next;
    }
    name
}

/// For each position the first one equal to it.
fn welded(geometry: &Geometry) -> Vec<u32> {
    let mut first = HashMap::new();
    let places = geometry.positions.iter().enumerate();
    let named = places.map(|(i, position)| {
        // Adding zero changes -0 to 0.
        let place = position.map(|p| (p + 0.0).to_bits());
        *first.entry(place).or_insert(i as u32)
    });
    named.collect()
}

/// Asserts that a mesh is closed, that every shell and every normal faces outwards, and that every triangle has an
/// area.
pub fn assert_closed_and_outward(mesh: &Mesh) {
    mesh.validate().unwrap();
    let (name, geometry) = (&mesh.name, mesh.full().unwrap());
    assert_eq!(open_edges(geometry), 0, "{name} is closed");
    for volume in volumes(geometry) {
        assert!(volume > 0.0, "{name} has a shell of {volume} m3");
    }
    assert_eq!(geometry.normals.len(), geometry.positions.len());
    for triangle in geometry.triangles() {
        let [a, b, c] = geometry.corners(triangle).unwrap();
        let face = (b - a).cross(c - a);
        assert!(face.length() > 0.0, "{name} has a triangle without area");
        let normals = triangle.map(|i| {
            let normal = DVec3::from(geometry.normals[i as usize].map(f64::from));
            assert!((normal.length() - 1.0).abs() < 1e-5, "{name}: {normal}");
            normal
        });
        let sum: DVec3 = normals.into_iter().sum();
        assert!(face.dot(sum) > 0.0, "{name} has a normal turned inwards");
    }
}
