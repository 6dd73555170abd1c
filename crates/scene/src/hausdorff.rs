//! The error of a proxy: the Hausdorff distance between the proxy and its mesh.
//!
//! It is the greatest distance from the vertices of either surface to the other surface, as in Cignoni, Rocchini,
//! Scopigno, "Metro: Measuring Error on Simplified Surfaces", 1998, sampled at the vertices.

use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb as Box3;
use obvhs::bvh2::Bvh2;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::bounds::tell_apart;
use crate::mesh::{Geometry, Mesh, Topology};

/// The greatest number of vertices of a geometry that are measured.
const SAMPLES: usize = 4_096;

impl Mesh {
    /// The Hausdorff distance between the proxy's surface and the full geometry's, in the mesh's own units.
    ///
    /// It is 0 without a proxy, and the size of the mesh where either geometry does not consist of triangles. It is
    /// measured at the vertices of both geometries. Of more than 4,096 vertices, evenly spaced ones are measured.
    #[must_use]
    pub fn proxy_hausdorff_distance(&self) -> f64 {
        let (Some(full), Some(proxy)) = (self.full(), &self.proxy) else {
            return 0.0;
        };
        let Some(bounds) = self.bounds().filter(|bounds| !bounds.is_empty()) else {
            return 0.0;
        };
        let size = bounds.half_extents().length() * 2.0;
        // In units of the mesh's size, relative to its centre, f32 is precise enough for any coordinates.
        let (middle, scale) = (bounds.centre(), size.recip());
        let place =
            |at: [f32; 3]| Vec3A::from(((Vec3::from(at).as_dvec3() - middle) * scale).as_vec3());
        let surfaces = [full, proxy].map(|geometry| Surface::new(geometry, place));
        let [Some(of_full), Some(of_proxy)] = surfaces else {
            return size;
        };
        let there = of_proxy.farthest(full, place);
        let back = of_full.farthest(proxy, place);
        // Widened by the error of f32.
        f64::from(there.max(back)) * size * (1.0 + 1e-5)
    }
}

/// Triangles and a bounding volume hierarchy over them.
struct Surface {
    triangles: Vec<[Vec3A; 3]>,
    tree: Bvh2,
}

impl Surface {
    /// `None` for a geometry without triangles that have finite corners.
    fn new(geometry: &Geometry, place: impl Fn([f32; 3]) -> Vec3A) -> Option<Self> {
        if geometry.topology != Topology::Triangles {
            return None;
        }
        let corner = |index: u32| geometry.positions.get(index as usize).copied().map(&place);
        let triangles: Vec<[Vec3A; 3]> = geometry
            .triangles()
            .filter_map(|[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .filter(|corners| corners.iter().all(|corner| corner.is_finite()))
            .collect();
        if triangles.is_empty() {
            return None;
        }
        let mut boxes: Vec<Box3> = triangles
            .iter()
            .map(|corners| Box3::from_points(corners))
            .collect();
        tell_apart(&mut boxes);
        let tree = PlocBuilder::new().build(
            PlocSearchDistance::Minimum,
            &boxes,
            (0..boxes.len() as u32).collect(),
            SortPrecision::U64,
            0,
        );
        Some(Self { triangles, tree })
    }

    /// The greatest distance to this surface of the vertices that the geometry's primitives use.
    fn farthest(&self, geometry: &Geometry, place: impl Fn([f32; 3]) -> Vec3A) -> f32 {
        let step = geometry.indices.len().div_ceil(SAMPLES).max(1);
        let mut stack = Vec::new();
        let mut worst = 0.0_f32;
        for index in geometry.indices.iter().step_by(step) {
            if let Some(at) = geometry.positions.get(*index as usize) {
                worst = self.farther(place(*at), worst, &mut stack);
            }
        }
        worst.sqrt()
    }

    /// The greater of `worst` and the squared distance from a point to this surface. The search stops as soon as the
    /// point is known to be nearer than `worst`.
    fn farther(&self, point: Vec3A, worst: f32, stack: &mut Vec<(f32, u32)>) -> f32 {
        let mut nearest = f32::INFINITY;
        stack.clear();
        stack.push((0.0, 0));
        while let Some((distance, number)) = stack.pop() {
            let Some(node) = self.tree.nodes.get(number as usize) else {
                continue;
            };
            if distance >= nearest {
                continue;
            }
            let first = node.first_index;
            if node.is_leaf() {
                let primitives = first as usize..(first + node.prim_count) as usize;
                for primitive in self
                    .tree
                    .primitive_indices
                    .get(primitives)
                    .unwrap_or_default()
                {
                    if let Some(corners) = self.triangles.get(*primitive as usize) {
                        nearest = nearest.min(to_triangle(point, corners).distance_squared(point));
                    }
                }
                if nearest <= worst {
                    return worst;
                }
                continue;
            }
            let mut below = [first, first + 1].map(|child| {
                let bounds = self.tree.nodes.get(child as usize).map(|node| *node.aabb());
                let outside = bounds.map(|it| point.clamp(it.min, it.max).distance_squared(point));
                (outside.unwrap_or(f32::INFINITY), child)
            });
            if below[0].0 < below[1].0 {
                below.swap(0, 1);
            }
            stack.extend(below);
        }
        if nearest.is_finite() {
            nearest.max(worst)
        } else {
            worst
        }
    }
}

/// The point of a triangle that is nearest to `point` (Ericson, *Real-Time Collision Detection*, 2005, section
/// 5.1.5).
fn to_triangle(point: Vec3A, [a, b, c]: &[Vec3A; 3]) -> Vec3A {
    let (ab, ac, ap) = (*b - *a, *c - *a, point - *a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = point - *b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return *a + ab * (d1 / (d1 - d3));
    }
    let cp = point - *c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return *a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return *b + (*c - *b) * along;
    }
    let whole = va + vb + vc;
    // A triangle without an area equals one of its edges. The cases above cover it, except for rounding.
    if whole <= 0.0 {
        return *a;
    }
    *a + ab * (vb / whole) + ac * (vc / whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aabb;
    use crate::icosphere::icosphere;
    use glam::DVec3;

    fn deviation(full: Geometry, proxy: Geometry) -> f64 {
        let mut mesh = Mesh::new("it", full);
        mesh.proxy = Some(proxy);
        mesh.proxy_hausdorff_distance()
    }

    #[test]
    fn a_smaller_sphere_deviates_by_the_difference_of_the_radii() {
        let found = deviation(icosphere(4, 2.0), icosphere(4, 1.9));
        assert!((found - 0.1).abs() < 0.01, "{found}");
        assert!(deviation(icosphere(3, 2.0), icosphere(3, 2.0)) < 1e-5);
        assert_eq!(
            Mesh::new("alone", icosphere(1, 1.0)).proxy_hausdorff_distance(),
            0.0
        );
    }

    #[test]
    fn a_box_deviates_by_its_corners_and_a_sphere_that_is_missing_by_the_way_to_it() {
        let cube = Aabb::new(DVec3::splat(-1.0), DVec3::splat(1.0));
        let found = deviation(icosphere(4, 1.0), Geometry::from_box(&cube));
        assert!((found - (3.0_f64.sqrt() - 1.0)).abs() < 0.01, "{found}");
        // Two spheres, and a proxy of the first alone, far from the origin.
        let far = |geometry: Geometry, by: f32| Geometry {
            positions: geometry
                .positions
                .iter()
                .map(|at| [at[0] + by, at[1], at[2]])
                .collect(),
            ..geometry
        };
        let (first, second) = (
            far(icosphere(3, 1.0), 4096.0),
            far(icosphere(3, 1.0), 4106.0),
        );
        let mut both = first.clone();
        let shift = both.positions.len() as u32;
        both.positions.extend(&second.positions);
        both.indices
            .extend(second.indices.iter().map(|index| index + shift));
        let found = deviation(both, first);
        assert!((found - 10.0).abs() < 0.01, "{found}");
    }

    #[test]
    fn it_is_the_brute_force_distance() {
        let (full, proxy) = (icosphere(3, 1.0), icosphere(1, 0.9));
        let place = |at: [f32; 3]| Vec3A::from(at);
        let triangles: Vec<[Vec3A; 3]> = proxy
            .triangles()
            .map(|corners| corners.map(|at| place(proxy.positions[at as usize])))
            .collect();
        let nearest = |point: Vec3A| {
            let distances = triangles
                .iter()
                .map(|corners| to_triangle(point, corners).distance(point));
            distances.fold(f32::INFINITY, f32::min)
        };
        let worst = full
            .positions
            .iter()
            .map(|at| nearest(place(*at)))
            .fold(0.0, f32::max);
        let found = deviation(full, proxy);
        assert!(
            (found - f64::from(worst)).abs() < 1e-4,
            "{found}, not {worst}"
        );
    }

    #[test]
    fn lines_are_as_far_off_as_they_are_large() {
        let lines = Geometry {
            topology: Topology::Lines,
            positions: vec![[0.0; 3], [3.0, 4.0, 0.0]],
            indices: vec![0, 1],
            ..Geometry::default()
        };
        assert!((deviation(lines.clone(), lines) - 5.0).abs() < 1e-9);
    }
}
