//! The method `thesis`: Edmondson's horizons (sections 4.5.2 to 4.5.4), after Stewart 1998. It finds the highest vertex of each sub-sector, for
//! all vertices in O(n log² n).
//!
//! A vertex lies in a sub-sector of another one exactly if it comes before it in the order along one end of the sub-sector and after it in
//! the order along the other end. Vertices are visited in the first order. A tree over the second order holds the upper convex hulls of the
//! visited vertices. The highest vertex lies on the tangent to one of O(log n) hulls. The tree is a Fenwick tree: it stores left children
//! alone, as the thesis does. Hulls are sorted arrays, because they are short. Distances are measured along the middle of the sub-sector, as
//! in the thesis.

use glam::{DVec2, DVec3};

use super::finder::{Finder, Row};
use super::sectors::Sectors;
use super::value::Horizon;
use crate::field::Field;

/// The method `thesis` over a field.
pub(super) struct Thesis<'a> {
    field: &'a Field,
}

impl<'a> Thesis<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self { field }
    }
}

/// The upper convex hull of points in a vertical section along a direction: `x` along it, `y` up.
type Hull = Vec<DVec2>;

/// Adds a point to a hull.
fn insert(hull: &mut Hull, point: DVec2) {
    let at = hull.partition_point(|corner| corner.x < point.x);
    let below = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) >= 0.0;
    match (at.checked_sub(1).map(|left| hull[left]), hull.get(at)) {
        (_, Some(right)) if right.x == point.x && right.y >= point.y => return,
        (Some(left), Some(&right)) if below(left, point, right) => return,
        _ => {}
    }
    let mut to = at;
    while hull.get(to).is_some_and(|right| {
        right.x == point.x
            || hull
                .get(to + 1)
                .is_some_and(|&next| below(point, *right, next))
    }) {
        to += 1;
    }
    let mut from = at;
    while from >= 2 && below(hull[from - 2], hull[from - 1], point) {
        from -= 1;
    }
    hull.splice(from..to, [point]);
}

/// The corner that the line from a point left of all corners rises most steeply to.
fn tangent(hull: &Hull, from: DVec2) -> Option<DVec2> {
    let (mut low, mut high) = (0, hull.len().checked_sub(1)?);
    while low < high {
        let middle = usize::midpoint(low, high);
        let steeper = (hull[middle] - from).perp_dot(hull[middle + 1] - from) > 0.0;
        if steeper {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    Some(hull[low])
}

/// The vertices sorted by `key`. Of equal keys, the vertex with the smaller `tie_break` comes first.
fn sorted(key: &[f64], tie_break: &[f64]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..key.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        let [a, b] = [a, b].map(|vertex| vertex as usize);
        key[a]
            .total_cmp(&key[b])
            .then(tie_break[a].total_cmp(&tie_break[b]))
            .then(a.cmp(&b))
    });
    order
}

/// The directions of a sub-sector.
struct Directions {
    start: DVec2,
    middle: DVec2,
    end: DVec2,
}

impl Thesis<'_> {
    /// Lowers the horizons of all vertices to those in one sub-sector.
    fn include_sub_sector(&self, sub_sector: &Directions, hulls: &mut [Hull], row: &mut [Horizon]) {
        let points = self.field.points();
        let across = |direction: DVec2, sign: f64| -> Vec<f64> {
            let key = |point: &DVec3| sign * direction.perp_dot(point.truncate());
            points.iter().map(key).collect()
        };
        // A vertex is in the sub-sector of another one if it is not right of its start, and not left of its end.
        let (left, right) = (across(sub_sector.start, -1.0), across(sub_sector.end, 1.0));
        let mut rank = vec![0_u32; points.len()];
        for (position, &vertex) in sorted(&right, &left).iter().enumerate() {
            rank[vertex as usize] = position as u32 + 1;
        }
        for hull in hulls.iter_mut() {
            hull.clear();
        }
        for vertex in sorted(&left, &right) {
            let position = points[vertex as usize];
            let along = sub_sector.middle.dot(position.truncate());
            let point = DVec2::new(along, position.z);
            let own = rank[vertex as usize] as usize;
            let mut best: Option<DVec2> = None;
            let mut node = own;
            while node > 0 {
                if let Some(corner) = tangent(&hulls[node], point) {
                    let higher = |best: DVec2| (best - point).perp_dot(corner - point) > 0.0;
                    if corner.x > point.x && best.is_none_or(higher) {
                        best = Some(corner);
                    }
                }
                node &= node - 1;
            }
            let horizon = best.map_or(Horizon::OPEN, |corner| Horizon {
                slope: ((corner.y - point.y) / (corner.x - point.x)) as f32,
                distance: (corner.x - point.x) as f32,
            });
            row[vertex as usize] = row[vertex as usize].and(horizon);
            node = own;
            while node < hulls.len() {
                insert(&mut hulls[node], point);
                node += node & node.wrapping_neg();
            }
        }
    }
}

impl Finder for Thesis<'_> {
    fn find_sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        // Hulls have no reach: there is one row.
        let Some(row) = rows.first_mut() else {
            return;
        };
        let mut hulls = vec![Hull::new(); row.vertices.len() + 1];
        row.vertices.fill(Horizon::ALL);
        for part in 0..sectors.parts() {
            let sub_sector = Directions {
                start: sectors.sub_sector_start(sector, part),
                middle: sectors.sub_sector_middle(sector, part),
                end: sectors.sub_sector_start(sector, part + 1),
            };
            self.include_sub_sector(&sub_sector, &mut hulls, row.vertices);
        }
        row.fill_edges_from_ends(self.field);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg32;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    #[test]
    fn a_hull_is_above_all_places_and_its_tangent_the_steepest_line() {
        for seed in 0..300 {
            let mut rng = Pcg32::seed_from_u64(seed);
            let mut number = |most: u32| f64::from(rng.next_u32() % most);
            let mut hull = Hull::new();
            let mut points = Vec::new();
            for _ in 0..60 {
                let point = DVec2::new(1.0 + number(20), number(15));
                insert(&mut hull, point);
                points.push(point);
                assert!(hull.windows(2).all(|pair| pair[0].x < pair[1].x));
                let turns_right = |c: &[DVec2]| (c[1] - c[0]).perp_dot(c[2] - c[0]) < 0.0;
                assert!(hull.windows(3).all(turns_right), "{hull:?}");
                let from = DVec2::new(0.0, number(30) - 10.0);
                let slope = |to: DVec2| (to.y - from.y) / (to.x - from.x);
                let steepest = points.iter().map(|&to| slope(to)).fold(f64::MIN, f64::max);
                let found = tangent(&hull, from).unwrap();
                assert!((slope(found) - steepest).abs() < 1e-12, "{hull:?} {from}");
            }
        }
    }
}
