//! How much of its bounding box a closed mesh fills for certain: the greatest box about the centre of its bounds that no surface of the mesh enters, and that lies inside.

use std::collections::HashMap;

use crate::bounds::Aabb;
use crate::mesh::{Geometry, Topology};
use glam::DVec3;

/// Smaller parts of a box hide nothing worth the search.
const LEAST: f64 = 0.02;
/// What is taken off for rounding, as a part of the box.
const ROUNDING: f64 = 1e-4;

/// The part of `bounds`, 0 to 1, that a mesh fills: the box with its centre and with that part of its size lies inside of the mesh. 0 for a mesh that is open, that is turned inside out, or
/// that has no inside about that centre.
///
/// A mesh counts as closed where each edge is run through as often one way as the other, by the positions of its ends. What a ray from outside that reaches the box crosses first is
/// then the front of a triangle.
#[must_use]
pub fn solid_part(geometry: &Geometry, bounds: &Aabb) -> f32 {
    let half = bounds.half_extents();
    if geometry.topology != Topology::Triangles || half.min_element() <= 0.0 {
        return 0.0;
    }
    let part = free_part(geometry, bounds.centre(), half) - ROUNDING;
    let is_solid = part >= LEAST && winding(geometry, bounds.centre()) > 0.5 && is_closed(geometry);
    match is_solid {
        true => crate::bounds::round_down(part.min(1.0 - ROUNDING)),
        false => 0.0,
    }
}

fn corners(geometry: &Geometry) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    let at = |index: u32| geometry.positions.get(index as usize).copied();
    let triangles = geometry.indices.chunks_exact(3);
    triangles.filter_map(move |corners| {
        let [a, b, c] = [at(corners[0])?, at(corners[1])?, at(corners[2])?];
        Some([a, b, c].map(|corner| DVec3::from_array(corner.map(f64::from))))
    })
}

/// The greatest part of the box that no triangle enters: the least distance of a triangle from the centre in the norm whose unit ball is the box.
fn free_part(geometry: &Geometry, centre: DVec3, half: DVec3) -> f64 {
    corners(geometry)
        .map(|triangle| distance(triangle.map(|corner| (corner - centre) / half)))
        .fold(1.0, f64::min)
}

/// The distance of a triangle from the origin in the maximum norm: the farthest that a plane between them can be, in the norm dual to it. It is one of those that may part a box and a triangle.
fn distance(triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle;
    let edges = [b - a, c - b, a - c];
    let crossed = DVec3::AXES.into_iter();
    let crossed = crossed.flat_map(|axis| edges.map(|edge| edge.cross(axis)));
    let normals = DVec3::AXES.into_iter().chain([edges[0].cross(edges[1])]);
    let apart = normals.chain(crossed).map(|normal| {
        let length = normal.abs().element_sum();
        let along = triangle.map(|corner| normal.dot(corner));
        let least = along.into_iter().fold(f64::INFINITY, f64::min);
        let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
        match length > 0.0 {
            true => least.max(-most) / length,
            false => 0.0,
        }
    });
    apart.fold(0.0, f64::max)
}

/// How often the mesh winds around a point, positive where its fronts face away from it. (Van Oosterom and Strackee, *The Solid Angle of a Plane Triangle*, 1983.)
fn winding(geometry: &Geometry, point: DVec3) -> f64 {
    let angles = corners(geometry).map(|triangle| {
        let [a, b, c] = triangle.map(|corner| corner - point);
        let lengths = [a, b, c].map(DVec3::length);
        let volume = a.dot(b.cross(c));
        let rest = lengths[0] * lengths[1] * lengths[2]
            + a.dot(b) * lengths[2]
            + b.dot(c) * lengths[0]
            + c.dot(a) * lengths[1];
        2.0 * volume.atan2(rest)
    });
    angles.sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Whether each edge is run through as often one way as the other.
fn is_closed(geometry: &Geometry) -> bool {
    // Zero has two bit patterns.
    let bits = |corner: [f32; 3]| corner.map(|number| (number + 0.0).to_bits());
    let mut numbers = HashMap::new();
    let places: Vec<u32> = geometry
        .positions
        .iter()
        .map(|corner| {
            let next = numbers.len() as u32;
            *numbers.entry(bits(*corner)).or_insert(next)
        })
        .collect();
    let mut runs: HashMap<(u32, u32), i32> = HashMap::new();
    for triangle in geometry.indices.chunks_exact(3) {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let ends = [triangle[from], triangle[to]].map(|end| places.get(end as usize).copied());
            let [Some(from), Some(to)] = ends else {
                return false;
            };
            match from.cmp(&to) {
                std::cmp::Ordering::Less => *runs.entry((from, to)).or_default() += 1,
                std::cmp::Ordering::Greater => *runs.entry((to, from)).or_default() -= 1,
                std::cmp::Ordering::Equal => {}
            }
        }
    }
    runs.values().all(|balance| *balance == 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::icosphere;

    fn part(geometry: &Geometry) -> f32 {
        let points = geometry
            .positions
            .iter()
            .map(|p| DVec3::from_array(p.map(f64::from)));
        solid_part(geometry, &Aabb::from_points(points).unwrap())
    }

    fn cuboid() -> Geometry {
        Geometry::from_box(&Aabb::new(
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(2.0, 6.0, 4.0),
        ))
    }

    #[test]
    fn a_box_is_solid_and_a_sphere_as_far_as_its_cube() {
        assert!(
            (0.999..1.0).contains(&part(&cuboid())),
            "{}",
            part(&cuboid())
        );
        let cube = part(&icosphere(3, 1.0));
        assert!((0.5..0.5774).contains(&cube), "{cube}");
    }

    #[test]
    fn what_is_open_or_inside_out_is_not() {
        let mut open = cuboid();
        open.indices.truncate(open.indices.len() - 3);
        assert_eq!(part(&open), 0.0);
        let mut turned = cuboid();
        turned.indices.reverse();
        assert_eq!(part(&turned), 0.0);
        let mut doubled = cuboid();
        let again = doubled.indices.clone();
        doubled.indices.extend(again.iter().rev());
        assert_eq!(
            part(&doubled),
            0.0,
            "a skin seen from both sides has no inside"
        );
    }

    #[test]
    fn a_surface_within_bounds_the_part() {
        let mut nested = cuboid();
        let centre = DVec3::new(1.5, 4.0, 3.5);
        let half = DVec3::new(0.5, 2.0, 0.5);
        let slit = Geometry::from_box(&Aabb::from_centre(centre + half * 0.5, half * 0.1));
        let base = nested.positions.len() as u32;
        nested.positions.extend(&slit.positions);
        nested
            .indices
            .extend(slit.indices.iter().rev().map(|index| index + base));
        assert!((0.399..0.4).contains(&part(&nested)), "{}", part(&nested));
    }

    #[test]
    fn a_ring_has_no_inside_about_its_centre() {
        // Four boxes around a hole.
        let mut ring = Geometry::default();
        for (x, y) in [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)] {
            let side = Aabb::from_centre(DVec3::new(x, y, 0.0), DVec3::new(0.4, 0.4, 0.2));
            let side = Geometry::from_box(&side);
            let base = ring.positions.len() as u32;
            ring.positions.extend(&side.positions);
            ring.indices
                .extend(side.indices.iter().map(|index| index + base));
        }
        assert_eq!(part(&ring), 0.0);
    }
}
