//! Clipping of triangles at the tiles' borders in the plan, first into columns, then into rows (Sutherland and
//! Hodgman, *Reentrant Polygon Clipping*, 1974).
//!
//! The intersection of an edge with a border is computed from the edge's ends in a fixed order. The pieces on both
//! sides, and those of the triangle across the edge, therefore get the same bits, and there are no cracks.

use antumbra_scene::Geometry;
use std::cmp::Ordering;
use std::collections::HashMap;

/// A corner: its position in the plan, then its position in space.
type Corner = [f64; 5];

/// The parts of a mesh in each of `n` x `n` tiles, row by row.
pub(super) fn to_tiles(
    positions: &[[f32; 3]],
    plan: &[[f32; 2]],
    indices: &[u32],
    n: u32,
) -> Vec<Geometry> {
    let mut tiles: Vec<Builder> = (0..n * n).map(|_| Builder::default()).collect();
    let corner = |index: u32| -> Option<Corner> {
        let [u, v] = *plan.get(index as usize)?;
        let [x, y, z] = *positions.get(index as usize)?;
        Some([u, v, x, y, z].map(f64::from))
    };
    for triangle in indices.as_chunks::<3>().0 {
        let [Some(a), Some(b), Some(c)] = triangle.map(corner) else {
            continue;
        };
        slice(vec![a, b, c], 0, n, |column, strip| {
            slice(strip, 1, n, |row, part| {
                if let Some(tile) = tiles.get_mut((row * n + column) as usize) {
                    tile.add(&part);
                }
            });
        });
    }
    tiles.into_iter().map(|tile| tile.geometry).collect()
}

/// Cuts a polygon at every border it crosses along an axis, and passes the part in each tile to `part`. Borders are
/// taken in ascending order, and each cut is made in the remainder of the previous one. Two polygons with a common
/// edge are thus cut at the same points. The outermost tiles extend beyond the plan.
fn slice(polygon: Vec<Corner>, axis: usize, n: u32, mut part: impl FnMut(u32, Vec<Corner>)) {
    let ends = polygon.iter().map(|corner| corner[axis]);
    let (least, most) = ends.fold((f64::MAX, f64::MIN), |(least, most), end| {
        (least.min(end), most.max(end))
    });
    let tile = |place: f64| ((place * f64::from(n)).max(0.0) as u32).min(n - 1);
    let mut rest = polygon;
    for number in tile(least)..tile(most) {
        let (below, above) = split(&rest, axis, f64::from(number + 1) / f64::from(n));
        part(number, below);
        rest = above;
    }
    part(tile(most), rest);
}

/// The parts of a convex polygon below and above a border.
fn split(polygon: &[Corner], axis: usize, border: f64) -> (Vec<Corner>, Vec<Corner>) {
    let (mut below, mut above) = (Vec::new(), Vec::new());
    let next = polygon.iter().cycle().skip(1);
    for (from, to) in polygon.iter().zip(next) {
        let (start, end) = (from[axis] - border, to[axis] - border);
        if start <= 0.0 {
            below.push(*from);
        }
        if start >= 0.0 {
            above.push(*from);
        }
        if start * end < 0.0 {
            let crossing = crossing(from, to, axis, border);
            below.push(crossing);
            above.push(crossing);
        }
    }
    (below, above)
}

fn crossing(a: &Corner, b: &Corner, axis: usize, border: f64) -> Corner {
    let ordered = a.partial_cmp(b).unwrap_or(Ordering::Equal);
    let (a, b) = if ordered == Ordering::Greater {
        (b, a)
    } else {
        (a, b)
    };
    let share = (border - a[axis]) / (b[axis] - a[axis]);
    let mut at: Corner = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share);
    at[axis] = border;
    at
}

/// A tile under construction.
#[derive(Default)]
struct Builder {
    geometry: Geometry,
    names: HashMap<[u32; 3], u32>,
}

impl Builder {
    /// Adds a convex polygon as a fan.
    fn add(&mut self, polygon: &[Corner]) {
        let corners: Vec<u32> = polygon.iter().map(|corner| self.name(corner)).collect();
        let Some((first, rest)) = corners.split_first() else {
            return;
        };
        for pair in rest.windows(2) {
            if let [b, c] = pair
                && first != b
                && b != c
                && c != first
            {
                self.geometry.indices.extend([*first, *b, *c]);
            }
        }
    }

    fn name(&mut self, corner: &Corner) -> u32 {
        let [_, _, x, y, z] = *corner;
        let position = [x as f32, y as f32, z as f32];
        let next = self.geometry.positions.len() as u32;
        let name = *self
            .names
            .entry(position.map(|v| (v + 0.0).to_bits()))
            .or_insert(next);
        if name == next {
            self.geometry.positions.push(position);
        }
        name
    }
}
