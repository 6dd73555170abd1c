//! Edmondson's horizons (sections 4.5.2 to 4.5.4), after Stewart 1998: the highest vertex of each sub-sector, for all vertices in O(n log² n).
//!
//! A vertex lies in a sub-sector of another exactly if it comes before it in the order along one end and after it in the order along the
//! other. Vertices are met in the first order; a tree over the second holds the upper convex hulls of those met so far, and the highest
//! one from a vertex touches the tangent to one of O(log n) hulls. The tree is Fenwick's: it stores the left children alone, as the thesis
//! does. Hulls keep their corners in a row, for they are short. Distances are measured along the middle of the sub-sector, as there.

use glam::DVec2;

use super::{Finder, Horizon, Row, Sectors};
use crate::field::Field;

pub(super) struct Thesis<'a> {
    field: &'a Field,
}

impl<'a> Thesis<'a> {
    pub fn new(field: &'a Field) -> Self {
        Self { field }
    }
}

/// The upper convex hull of places along a direction: `x` along it, `y` up.
type Hull = Vec<DVec2>;

/// Adds a place to a hull.
fn insert(hull: &mut Hull, place: DVec2) {
    let at = hull.partition_point(|corner| corner.x < place.x);
    let below = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) >= 0.0;
    match (at.checked_sub(1).map(|left| hull[left]), hull.get(at)) {
        (_, Some(right)) if right.x == place.x && right.y >= place.y => return,
        (Some(left), Some(&right)) if below(left, place, right) => return,
        _ => {}
    }
    let mut to = at;
    while hull.get(to).is_some_and(|right| {
        right.x == place.x
            || hull
                .get(to + 1)
                .is_some_and(|&next| below(place, *right, next))
    }) {
        to += 1;
    }
    let mut from = at;
    while from >= 2 && below(hull[from - 2], hull[from - 1], place) {
        from -= 1;
    }
    hull.splice(from..to, [place]);
}

/// The corner to which the line from a place left of all of them rises most steeply.
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

/// The vertices in order along a direction, from right to left; of those side by side, what `then` has first.
fn order(key: &[f64], then: &[f64]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..key.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        let [a, b] = [a, b].map(|vertex| vertex as usize);
        key[a]
            .total_cmp(&key[b])
            .then(then[a].total_cmp(&then[b]))
            .then(a.cmp(&b))
    });
    order
}

impl Thesis<'_> {
    fn part(&self, [first, middle, last]: [DVec2; 3], hulls: &mut [Hull], row: &mut [Horizon]) {
        let points = self.field.points();
        let along = |way: DVec2, sign: f64| -> Vec<f64> {
            let key = |point: &glam::DVec3| sign * way.perp_dot(point.truncate());
            points.iter().map(key).collect()
        };
        // A vertex is in the sub-sector of another if it is not right of its first end, and not left of its last.
        let (left, right) = (along(first, -1.0), along(last, 1.0));
        let mut rank = vec![0_u32; points.len()];
        for (place, &vertex) in order(&right, &left).iter().enumerate() {
            rank[vertex as usize] = place as u32 + 1;
        }
        for hull in hulls.iter_mut() {
            hull.clear();
        }
        for vertex in order(&left, &right) {
            let point = points[vertex as usize];
            let place = DVec2::new(middle.dot(point.truncate()), point.z);
            let own = rank[vertex as usize] as usize;
            let mut best: Option<DVec2> = None;
            let mut node = own;
            while node > 0 {
                if let Some(corner) = tangent(&hulls[node], place) {
                    let higher = |best: DVec2| (best - place).perp_dot(corner - place) > 0.0;
                    if corner.x > place.x && best.is_none_or(higher) {
                        best = Some(corner);
                    }
                }
                node &= node - 1;
            }
            let horizon = best.map_or(Horizon::OPEN, |corner| Horizon {
                slope: ((corner.y - place.y) / (corner.x - place.x)) as f32,
                distance: (corner.x - place.x) as f32,
            });
            row[vertex as usize] = row[vertex as usize].and(horizon);
            node = own;
            while node < hulls.len() {
                insert(&mut hulls[node], place);
                node += node & node.wrapping_neg();
            }
        }
    }
}

impl Finder for Thesis<'_> {
    fn sector(&self, sectors: &Sectors, sector: u32, rows: &mut [Row<'_>]) {
        // There is no more than one: hulls know of no reach.
        let Some(row) = rows.first_mut() else {
            return;
        };
        let mut hulls = vec![Hull::new(); row.vertices.len() + 1];
        row.vertices.fill(Horizon::ALL);
        for part in 0..sectors.parts() {
            let ways = [
                sectors.ray(sector, part),
                sectors.middle(sector, part),
                sectors.ray(sector, part + 1),
            ];
            self.part(ways, &mut hulls, row.vertices);
        }
        row.of_ends(self.field);
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
            let mut chance = Pcg32::seed_from_u64(seed);
            let mut number = |most: u32| f64::from(chance.next_u32() % most);
            let mut hull = Hull::new();
            let mut places = Vec::new();
            for _ in 0..60 {
                let place = DVec2::new(1.0 + number(20), number(15));
                insert(&mut hull, place);
                places.push(place);
                assert!(hull.windows(2).all(|pair| pair[0].x < pair[1].x));
                let turns = |c: &[DVec2]| (c[1] - c[0]).perp_dot(c[2] - c[0]) < 0.0;
                assert!(hull.windows(3).all(turns), "{hull:?}");
                let from = DVec2::new(0.0, number(30) - 10.0);
                let steep = |to: DVec2| (to.y - from.y) / (to.x - from.x);
                let steepest = places.iter().map(|&to| steep(to)).fold(f64::MIN, f64::max);
                let found = tangent(&hull, from).unwrap();
                assert!((steep(found) - steepest).abs() < 1e-12, "{hull:?} {from}");
            }
        }
    }
}
