//! Boxes around the parts of a mesh, which enclose less empty space than the one box around it all: the top and the legs of a table, the pieces of a pipe that bends.
//!
//! The mesh is cut along a grid of cells, each of which has a tight box around what lies in it; then, over and over, those two boxes are merged whose union adds the least
//! surface, until few are left. The surface of a box is how often a ray hits it (Goldsmith and Salmon, *Automatic Creation of Object Hierarchies for Ray Tracing*, 1987).

use glam::{BVec3, DVec3};

use crate::bounds::Aabb;
use crate::mesh::{Geometry, Mesh, Topology};

/// The boxes around a mesh's parts. All triangles of its levels lie in them; a mesh with lines or points has none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PartBoxes {
    /// None where boxes of parts say no more than the one box.
    pub boxes: Vec<PartBox>,
    /// The axes along which every box reaches from end to end, since the mesh is flat there.
    pub flat: BVec3,
}

/// A box around a part: where it begins and ends along each axis of the mesh's bounds, from 0 to [`PartBox::STEPS`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PartBox {
    low: [u16; 3],
    high: [u16; 3],
}

impl PartBox {
    /// The step at the far end of the bounds.
    pub const STEPS: u16 = 1023;

    /// Where it begins: rounded down, and a step less.
    #[must_use]
    pub fn low(&self) -> [u16; 3] {
        self.low
    }

    /// Where it ends, at most [`Self::STEPS`]: rounded up, and a step more.
    #[must_use]
    pub fn high(&self) -> [u16; 3] {
        self.high
    }
}

/// Meshes of fewer triangles are drawn as fast as their parts would be tested.
const LEAST_TRIANGLES: usize = 64;
/// The most cells along the longest axis.
const MOST_CELLS: usize = 8;
/// A mesh is flat along an axis whose extent is no more than this part of its largest.
const FLAT: f64 = 0.01;
/// Boxes whose surfaces together exceed this part of that of the bounds gain too little.
const WORTHWHILE: f64 = 0.75;

impl PartBoxes {
    /// The boxes around at most `most` parts of a mesh with these bounds.
    #[must_use]
    pub fn new(mesh: &Mesh, bounds: &Aabb, most: usize) -> Self {
        let size = bounds.max - bounds.min;
        let largest = size.max_element();
        let triangles = mesh.triangle_count();
        let are_triangles = |level: &Geometry| level.topology == Topology::Triangles;
        if triangles < LEAST_TRIANGLES
            || !mesh.levels.iter().all(are_triangles)
            || !(largest > 0.0 && largest.is_finite())
        {
            return Self::default();
        }
        let flat = size.cmple(DVec3::splat(largest * FLAT));
        let mut cells = Cells::new(bounds, cell_counts(size / largest, triangles));
        for level in &mesh.levels {
            let triangles = level.triangles();
            triangles
                .filter_map(|triangle| level.corners(triangle))
                .for_each(|corners| cells.add(corners));
        }
        let mut boxes: Vec<_> = cells.boxes.into_iter().flatten().collect();
        merge(&mut boxes, most);
        boxes.sort_by(|a, b| b.half_area().total_cmp(&a.half_area()));
        let surface: f64 = boxes.iter().map(Aabb::half_area).sum();
        if boxes.len() < 2 || surface > WORTHWHILE * bounds.half_area() {
            return Self::default();
        }
        let boxes = boxes.iter().map(|part| steps(part, bounds, flat)).collect();
        Self { boxes, flat }
    }
}

/// A part's box in steps of the bounds.
fn steps(part: &Aabb, bounds: &Aabb, flat: BVec3) -> PartBox {
    let last = f64::from(PartBox::STEPS);
    let scale = (bounds.max - bounds.min).recip() * last;
    let low = ((part.min - bounds.min) * scale).floor() - 1.0;
    let high = ((part.max - bounds.min) * scale).ceil() + 1.0;
    let low = DVec3::select(
        flat,
        DVec3::ZERO,
        low.clamp(DVec3::ZERO, DVec3::splat(last)),
    );
    let high = DVec3::select(
        flat,
        DVec3::splat(last),
        high.clamp(DVec3::ZERO, DVec3::splat(last)),
    );
    PartBox {
        low: low.to_array().map(|step| step as u16),
        high: high.to_array().map(|step| step as u16),
    }
}

/// The cells along each axis of a mesh whose extents are these shares of its largest: as many as [`MOST_CELLS`] allows, but no more in all than it has triangles, since
/// to merge them takes time by the square of their number.
fn cell_counts(shares: DVec3, triangles: usize) -> [usize; 3] {
    let counts = |along: usize| {
        let counts = (shares * along as f64).to_array();
        counts.map(|cells| (cells.ceil() as usize).clamp(1, along))
    };
    let is_allowed = |counts: &[usize; 3]| counts.iter().product::<usize>() <= triangles;
    let mut finest_first = (1..=MOST_CELLS).rev().map(counts);
    finest_first.find(is_allowed).unwrap_or([1; 3])
}

/// A grid over a mesh's bounds, with the box around what lies in each cell.
struct Cells {
    origin: DVec3,
    /// The size of a cell.
    size: DVec3,
    counts: [usize; 3],
    boxes: Vec<Option<Aabb>>,
}

impl Cells {
    fn new(bounds: &Aabb, counts: [usize; 3]) -> Self {
        Self {
            origin: bounds.min,
            size: (bounds.max - bounds.min) / DVec3::from_array(counts.map(|count| count as f64)),
            counts,
            boxes: vec![None; counts.iter().product()],
        }
    }

    /// The first and the last cell that something reaches along an axis.
    fn span(&self, axis: usize, low: f64, high: f64) -> [usize; 2] {
        let cell = |at: f64| {
            let number = (at - self.origin[axis]) / self.size[axis];
            // Along an axis without extent all is in the only cell.
            (number.max(0.0) as usize).min(self.counts[axis] - 1)
        };
        [cell(low), cell(high)]
    }

    /// Where a cell begins and ends along an axis.
    fn slab(&self, axis: usize, cell: usize) -> [f64; 2] {
        [cell, cell + 1].map(|edge| self.origin[axis] + edge as f64 * self.size[axis])
    }

    /// Adds a triangle to the cells that it reaches.
    fn add(&mut self, corners: [DVec3; 3]) {
        self.cut(&Polygon::new(&corners), 0, [0; 3]);
    }

    /// Cuts a polygon along one axis after the other. `cell`: the cell that it lies in along the axes before `axis`.
    fn cut(&mut self, polygon: &Polygon, axis: usize, mut cell: [usize; 3]) {
        let bounds = polygon.bounds();
        if axis == 3 {
            let [x, y, z] = cell;
            let number = (z * self.counts[1] + y) * self.counts[0] + x;
            if let Some(held) = self.boxes.get_mut(number) {
                *held = Some(held.map_or(bounds, |held| held.union(&bounds)));
            }
            return;
        }
        let [first, last] = self.span(axis, bounds.min[axis], bounds.max[axis]);
        if first == last {
            cell[axis] = first;
            return self.cut(polygon, axis + 1, cell);
        }
        for number in first..=last {
            let [low, high] = self.slab(axis, number);
            // What lies beyond the ends by rounding belongs to the cells there.
            let above = if number == first {
                f64::NEG_INFINITY
            } else {
                low
            };
            let below = if number == last { f64::INFINITY } else { high };
            let part = polygon.above(axis, above, 1.0).above(axis, below, -1.0);
            if !part.corners().is_empty() {
                cell[axis] = number;
                self.cut(&part, axis + 1, cell);
            }
        }
    }
}

/// A convex polygon: a triangle cut by up to six planes.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec3; 9],
    count: usize,
}

impl Polygon {
    fn new(corners: &[DVec3]) -> Self {
        let mut made = Self {
            corners: [DVec3::ZERO; 9],
            count: 0,
        };
        corners.iter().for_each(|corner| made.push(*corner));
        made
    }

    fn push(&mut self, corner: DVec3) {
        if let Some(place) = self.corners.get_mut(self.count) {
            *place = corner;
            self.count += 1;
        }
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_points(self.corners().iter().copied()).unwrap_or(Aabb::EMPTY)
    }

    /// What lies at or above `plane` along an axis, or below it for a `sign` of -1. (Sutherland and Hodgman, *Reentrant Polygon Clipping*, 1974.)
    fn above(&self, axis: usize, plane: f64, sign: f64) -> Self {
        if plane.is_infinite() {
            return *self;
        }
        let height = |corner: &DVec3| sign * (corner[axis] - plane);
        let mut made = Self::new(&[]);
        let corners = self.corners();
        for (number, corner) in corners.iter().enumerate() {
            let next = &corners[(number + 1) % corners.len()];
            let (here, there) = (height(corner), height(next));
            if here >= 0.0 {
                made.push(*corner);
            }
            if here * there < 0.0 {
                let mut cut = corner.lerp(*next, here / (here - there));
                cut[axis] = plane;
                made.push(cut);
            }
        }
        made
    }
}

/// Merges boxes, those first whose union adds the least surface, until there are at most `most` and merging any two would add some.
fn merge(boxes: &mut Vec<Aabb>, most: usize) {
    let cost = |a: &Aabb, b: &Aabb| a.union(b).half_area() - a.half_area() - b.half_area();
    let nearest = |boxes: &[Aabb], of: usize| {
        let others = boxes.iter().enumerate().filter(|(other, _)| *other != of);
        let costs = others.map(|(other, other_box)| (cost(&boxes[of], other_box), other));
        costs.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut best: Vec<_> = (0..boxes.len()).map(|of| nearest(boxes, of)).collect();
    while boxes.len() > 1 {
        let pairs = best.iter().enumerate();
        let pairs = pairs.filter_map(|(one, best)| best.map(|(cost, other)| (cost, one, other)));
        let Some((added, one, other)) = pairs.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return;
        };
        if boxes.len() <= most && added > 0.0 {
            return;
        }
        let (kept, removed) = (one.min(other), one.max(other));
        boxes[kept] = boxes[kept].union(&boxes[removed]);
        boxes.swap_remove(removed);
        best.swap_remove(removed);
        let moved = boxes.len();
        for of in 0..boxes.len() {
            let known = best[of].map(|(_, other)| other);
            if of == kept || known.is_none_or(|other| other == kept || other == removed) {
                best[of] = nearest(boxes, of);
                continue;
            }
            if let Some(best) = &mut best[of] {
                if best.1 == moved {
                    best.1 = removed;
                }
                let to_kept = cost(&boxes[of], &boxes[kept]);
                if to_kept < best.0 {
                    *best = (to_kept, kept);
                }
            }
        }
    }
}
