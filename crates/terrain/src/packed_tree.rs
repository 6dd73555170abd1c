//! A packed R-tree: bounding boxes in the plan, four to a node, in a tree without pointers.
//!
//! The items are sorted so that every run of 4, of 16, of 64 and so on lies close together. A node is then just the number of its run. Runs
//! are made by halving along the longer side, in the spirit of Leutenegger, Lopez, Edgington, "STR: A Simple and Efficient Algorithm for
//! R-Tree Packing", 1997.

use glam::DVec2;

/// Children of a node.
pub const WIDTH: usize = 4;

/// A box in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Its lower left corner.
    pub low: DVec2,
    /// Its upper right corner.
    pub high: DVec2,
}

impl Extent {
    /// The empty box, which touches no box.
    pub const EMPTY: Self = Self {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
    };

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = DVec2>) -> Self {
        points.into_iter().fold(Self::EMPTY, |extent, at| Self {
            low: extent.low.min(at),
            high: extent.high.max(at),
        })
    }

    /// The smallest box around both.
    pub fn join(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Whether the boxes have a point in common. Their borders belong to them.
    pub fn touches(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    fn middle(&self) -> DVec2 {
        (self.low + self.high) / 2.0
    }
}

/// The indices of items in packed order, sorted by the items' middles.
pub fn packed_order(middles: &[DVec2]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..middles.len() as u32).collect();
    let mut run = WIDTH;
    while run < order.len() {
        run *= WIDTH;
    }
    halve(&mut order, run, middles);
    order
}

/// Divides items that fill at most one run of `run` into runs a quarter as long.
fn halve(items: &mut [u32], mut run: usize, middles: &[DVec2]) {
    while items.len() <= run {
        run /= WIDTH;
        if run < WIDTH {
            return;
        }
    }
    let runs = items.len().div_ceil(run);
    let extent = Extent::around(items.iter().map(|&item| middles[item as usize]));
    let size = extent.high - extent.low;
    let axis = usize::from(size.y > size.x);
    let middle = runs.div_ceil(2) * run;
    items.select_nth_unstable_by(middle, |&a, &b| {
        let (a, b) = (middles[a as usize], middles[b as usize]);
        a[axis].total_cmp(&b[axis])
    });
    let (low, high) = items.split_at_mut(middle);
    for half in [low, high] {
        halve(half, run * WIDTH, middles);
    }
}

/// A tree of boxes in the plan.
#[derive(Debug, Clone)]
pub struct PackedTree {
    order: Vec<u32>,
    /// The items' boxes in packed order, then a box around each run of them, and so on up to one box.
    levels: Vec<Vec<Extent>>,
}

impl PackedTree {
    /// A tree over these boxes.
    pub fn new(extents: &[Extent]) -> Self {
        let middles: Vec<DVec2> = extents.iter().map(Extent::middle).collect();
        let order = packed_order(&middles);
        let mut level: Vec<Extent> = order.iter().map(|&item| extents[item as usize]).collect();
        let mut levels = Vec::new();
        while level.len() > 1 {
            let join = |run: &[Extent]| {
                run.iter()
                    .fold(Extent::EMPTY, |extent, next| extent.join(next))
            };
            let above = level.chunks(WIDTH).map(join).collect();
            levels.push(std::mem::replace(&mut level, above));
        }
        levels.push(level);
        Self { order, levels }
    }

    /// Calls `found` for every item whose box touches `extent`.
    pub fn each_touching(&self, extent: &Extent, mut found: impl FnMut(u32)) {
        self.each_while(
            |own| own.touches(extent),
            |item| {
                found(item);
                true
            },
        );
    }

    /// Calls `found` for every item whose box is `wanted`, as are all boxes around it, until `found` returns `false`. Returns whether it
    /// never did.
    pub fn each_while(
        &self,
        wanted: impl Fn(&Extent) -> bool,
        mut found: impl FnMut(u32) -> bool,
    ) -> bool {
        let mut open = vec![(self.levels.len() - 1, 0)];
        while let Some((level, node)) = open.pop() {
            if !self.levels[level].get(node).is_some_and(&wanted) {
                continue;
            }
            if level > 0 {
                open.extend((0..WIDTH).map(|child| (level - 1, node * WIDTH + child)));
            } else if !found(self.order[node]) {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg32;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    #[test]
    fn every_box_that_touches_is_found_once() {
        let mut rng = Pcg32::seed_from_u64(7);
        let mut number = || f64::from(rng.next_u32()) / f64::from(u32::MAX);
        for count in [0, 1, 2, 4, 5, 17, 64, 300] {
            let extents: Vec<Extent> = (0..count)
                .map(|_| {
                    let low = DVec2::new(number(), number());
                    let high = low + DVec2::new(number(), number()) * 0.2;
                    Extent { low, high }
                })
                .collect();
            let tree = PackedTree::new(&extents);
            for query in &extents {
                let mut found = Vec::new();
                tree.each_touching(query, |item| found.push(item));
                found.sort_unstable();
                let touching = (0..count).filter(|&i| extents[i as usize].touches(query));
                assert_eq!(found, touching.collect::<Vec<u32>>());
            }
        }
    }

    #[test]
    fn runs_lie_close_together() {
        let points: Vec<DVec2> = (0..4096)
            .map(|i| DVec2::new(f64::from(i % 64), f64::from(i / 64)))
            .collect();
        let order = packed_order(&points);
        for (run, side) in [(4, 1.0), (16, 3.0), (64, 7.0), (256, 15.0), (1024, 31.0)] {
            for items in order.chunks(run) {
                let extent = Extent::around(items.iter().map(|&item| points[item as usize]));
                let size = extent.high - extent.low;
                assert_eq!(size.max_element(), side, "a run of {run}");
            }
        }
    }
}
