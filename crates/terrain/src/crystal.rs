//! Crystals, in the thesis's word: groups of triangles that are hidden together, grown from random seed triangles (Edmondson, sections 5.2.3 and 6.3). A crystal is
//! one such group before groups are joined.
//!
//! Every seed grows breadth first, one triangle at a time and all seeds at the same pace, until it meets others or would grow over a ridge.
//! A triangle joins only if none of its corners lies beyond the horizons of the edges at the group's lowest vertex so far. So crystals grow
//! away from ridges, and the triangles of the ridges remain: they are called orphans. Fewer seeds are then placed on the orphans, and so on.
//! In the end a group that is too small is joined with another small one that it collided with, or its triangles are left ungrouped and are
//! always drawn.

use std::collections::{BTreeMap, VecDeque};

use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::horizon::Horizons;

/// How groups are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupOptions {
    /// The number of seeds of the first pass.
    pub seeds: u32,
    /// The most crystals, counted before small ones are joined. At least `seeds`.
    pub max_groups: u32,
    /// The most passes over orphans.
    pub max_passes: u32,
    /// A group with fewer triangles is joined with another one, or dissolved.
    pub min_triangles: u32,
    /// Two groups are not joined if the area of the circle around both is larger than this share of the area of the field's plan bounds.
    pub max_area_share: f64,
    /// The seed of the random numbers.
    pub seed: u64,
}

impl GroupOptions {
    /// The thesis's numbers for a field of `triangles` triangles: at first one seed for 200 triangles, and groups of at least 30 triangles.
    #[must_use]
    pub fn for_triangles(triangles: usize) -> Self {
        let seeds = (triangles / 200).clamp(1, 1 << 20) as u32;
        Self {
            seeds,
            max_groups: seeds * 2,
            max_passes: 10,
            min_triangles: 30,
            max_area_share: 0.25,
            seed: 1,
        }
    }

    /// The thesis's numbers with `seeds` seeds, and at most twice as many groups.
    #[must_use]
    pub fn of_seeds(seeds: u32) -> Self {
        Self {
            seeds,
            max_groups: seeds.saturating_mul(2),
            ..Self::for_triangles(0)
        }
    }

    /// Checks the ranges of the options.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] with the range.
    pub fn check(&self) -> Result<(), TerrainError> {
        let refuse = |what, value: String, problem| {
            Err(TerrainError::Setting {
                what,
                value,
                problem,
            })
        };
        if self.seeds == 0 {
            return refuse("the number of seeds", "0".to_owned(), "give at least 1");
        }
        if self.max_groups < self.seeds {
            let value = self.max_groups.to_string();
            return refuse("the most groups", value, "give at least as many as seeds");
        }
        if !(self.max_area_share > 0.0 && self.max_area_share <= 1e6) {
            let value = self.max_area_share.to_string();
            return refuse(
                "the area share of the largest group",
                value,
                "give more than 0, at most 1e6",
            );
        }
        Ok(())
    }
}

/// Two different groups. Pairs are sorted by `first`, then by `second`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroupPair {
    /// The group with the smaller number.
    pub first: u32,
    /// The group with the larger number.
    pub second: u32,
}

impl GroupPair {
    /// The pair of two groups, given in any order.
    #[must_use]
    pub fn new(a: u32, b: u32) -> Self {
        Self {
            first: a.min(b),
            second: a.max(b),
        }
    }
}

/// The crystals of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Crystals {
    /// The group of each triangle; [`NONE`] for triangles that are always drawn.
    pub group_of: Vec<u32>,
    /// The number of groups.
    pub count: u32,
    /// How often two groups collided while they grew.
    pub collisions: BTreeMap<GroupPair, u32>,
    /// The number of passes over orphans.
    pub passes: u32,
}

impl Crystals {
    /// Grows crystals over a field.
    ///
    /// # Errors
    /// As [`GroupOptions::check`].
    pub fn grow(
        field: &Field,
        horizons: &Horizons,
        options: &GroupOptions,
    ) -> Result<Self, TerrainError> {
        options.check()?;
        let triangles = field.triangles().len();
        let mut growth = Growth {
            field,
            horizons,
            group_of: vec![NONE; triangles],
            edges_at: VertexEdges::new(field),
            lowest: Vec::new(),
            collisions: BTreeMap::new(),
        };
        let mut rng = Pcg32::seed_from_u64(options.seed);
        let mut orphans: Vec<u32> = (0..triangles as u32).collect();
        let mut passes = 0;
        loop {
            let share = orphans.len() as f64 / triangles as f64;
            let room = options.max_groups - growth.lowest.len() as u32;
            let seeds = (f64::from(options.seeds) * share).ceil() as u32;
            let before = growth.lowest.len();
            let largest = growth.pass(&mut orphans, seeds.min(room), &mut rng);
            let finished = growth.lowest.len() == before || largest < options.min_triangles;
            orphans.retain(|&triangle| growth.group_of[triangle as usize] == NONE);
            if finished || orphans.is_empty() || passes == options.max_passes {
                break;
            }
            passes += 1;
        }
        let Growth {
            group_of,
            lowest,
            collisions,
            ..
        } = growth;
        let mut crystals = Self {
            group_of,
            count: lowest.len() as u32,
            collisions,
            passes,
        };
        crystals.join_small(options.min_triangles);
        Ok(crystals)
    }

    /// The number of triangles of each group.
    #[must_use]
    pub fn sizes(&self) -> Vec<u32> {
        let mut sizes = vec![0; self.count as usize];
        for &group in self.group_of.iter().filter(|group| **group != NONE) {
            sizes[group as usize] += 1;
        }
        sizes
    }

    /// The number of triangles of no group.
    #[must_use]
    pub fn orphans(&self) -> usize {
        self.group_of.iter().filter(|group| **group == NONE).count()
    }

    /// Joins each group that is too small with the small group that it collided with most, dissolves those that stay too small, and
    /// renumbers the rest.
    fn join_small(&mut self, min_triangles: u32) {
        let mut sizes = self.sizes();
        let mut joined_to: Vec<u32> = (0..self.count).collect();
        let mut met: Vec<(GroupPair, u32)> = self
            .collisions
            .iter()
            .map(|(&pair, &times)| (pair, times))
            .collect();
        met.sort_by_key(|&(pair, times)| (std::cmp::Reverse(times), pair));
        for (GroupPair { first, second }, _) in met {
            let [a, b] = [first, second].map(|group| representative(&joined_to, group));
            let small = |group: u32| sizes[group as usize] < min_triangles;
            if a != b && small(a) && small(b) {
                sizes[a as usize] += sizes[b as usize];
                sizes[b as usize] = 0;
                joined_to[b as usize] = a;
            }
        }
        let mut count = 0;
        let kept: Vec<u32> = sizes
            .iter()
            .map(|&size| {
                let kept = size >= min_triangles.max(1);
                count += u32::from(kept);
                if kept { count - 1 } else { NONE }
            })
            .collect();
        let renumbered = |group: u32| kept[representative(&joined_to, group) as usize];
        for group in self.group_of.iter_mut().filter(|group| **group != NONE) {
            *group = renumbered(*group);
        }
        let mut collisions = BTreeMap::new();
        for (&GroupPair { first, second }, &times) in &self.collisions {
            let [a, b] = [renumbered(first), renumbered(second)];
            if a != b && a != NONE && b != NONE {
                *collisions.entry(GroupPair::new(a, b)).or_insert(0) += times;
            }
        }
        self.collisions = collisions;
        self.count = count;
    }
}

/// The group that a group has been joined to, directly or through others.
fn representative(joined_to: &[u32], mut group: u32) -> u32 {
    while joined_to[group as usize] != group {
        group = joined_to[group as usize];
    }
    group
}

/// Crystals while they grow.
struct Growth<'a> {
    field: &'a Field,
    horizons: &'a Horizons,
    /// The group of each triangle.
    group_of: Vec<u32>,
    edges_at: VertexEdges,
    /// The lowest vertex of each group.
    lowest: Vec<u32>,
    collisions: BTreeMap<GroupPair, u32>,
}

impl Growth<'_> {
    /// Places seeds on orphans and lets them grow. Returns the number of triangles of the largest new group.
    fn pass(&mut self, orphans: &mut [u32], seeds: u32, rng: &mut Pcg32) -> u32 {
        let first = self.lowest.len() as u32;
        let mut fronts: Vec<VecDeque<u32>> = Vec::new();
        let mut sizes = Vec::new();
        for placed in 0..(seeds as usize).min(orphans.len()) {
            let left = orphans.len() - placed;
            let other = placed + rng.next_u32() as usize % left;
            orphans.swap(placed, other);
            let seed = orphans[placed];
            let corners = self.field.triangles()[seed as usize];
            let group = self.lowest.len() as u32;
            self.lowest.push(self.lowest_of(corners));
            self.group_of[seed as usize] = group;
            fronts.push((0..3).map(|side| 3 * seed + side).collect());
            sizes.push(1_u32);
        }
        let mut grows = true;
        while grows {
            grows = false;
            for (at, front) in fronts.iter_mut().enumerate() {
                let group = first + at as u32;
                // One triangle each, so that all grow at the same pace.
                while let Some(half_edge) = front.pop_front() {
                    let opposite = self.field.opposite(half_edge);
                    if opposite != NONE && self.join(group, opposite / 3) {
                        let sides = (0..3).map(|side| opposite / 3 * 3 + side);
                        front.extend(sides.filter(|&side| side != opposite));
                        sizes[at] += 1;
                        grows = true;
                        break;
                    }
                }
            }
        }
        sizes.into_iter().max().unwrap_or_default()
    }

    /// Adds a triangle to a group if it is in no group and is not beyond the group's horizon. Returns whether it was added.
    fn join(&mut self, group: u32, triangle: u32) -> bool {
        let other = self.group_of[triangle as usize];
        if other != NONE {
            if other != group {
                let pair = GroupPair::new(group, other);
                *self.collisions.entry(pair).or_insert(0) += 1;
            }
            return false;
        }
        let lowest = self.lowest[group as usize];
        let corners = self.field.triangles()[triangle as usize];
        let beyond = |corner: u32| self.is_beyond(lowest, self.field.point(corner));
        if corners.into_iter().any(beyond) {
            return false;
        }
        self.group_of[triangle as usize] = group;
        let lower = self.lowest_of(corners);
        if self.field.point(lower).z < self.field.point(lowest).z {
            self.lowest[group as usize] = lower;
        }
        true
    }

    /// Whether a point is hidden from all edges at a vertex. The vertex alone does not suffice: any ripple of the ground hides points from it.
    fn is_beyond(&self, vertex: u32, point: DVec3) -> bool {
        let away = point - self.field.point(vertex);
        let distance = away.truncate().length();
        let sector = self.horizons.sectors().containing(away.truncate());
        sector.is_some_and(|sector| {
            let hides = |&edge: &u32| {
                let horizon = self.horizons.of_edge(edge, sector, 0);
                horizon.hides(distance, away.z)
            };
            self.edges_at.of(vertex).iter().all(hides)
        })
    }

    /// The lowest of a triangle's corners.
    fn lowest_of(&self, [a, b, c]: [u32; 3]) -> u32 {
        let lower = |a: u32, b: u32| {
            if self.field.point(b).z < self.field.point(a).z {
                b
            } else {
                a
            }
        };
        lower(lower(a, b), c)
    }
}

/// The edges that meet at each vertex.
#[derive(Debug)]
struct VertexEdges {
    /// The index of each vertex's first edge in `edges`, and the length of `edges`.
    first: Vec<u32>,
    edges: Vec<u32>,
}

impl VertexEdges {
    fn new(field: &Field) -> Self {
        let ends = |half_edge: &u32| [field.start(*half_edge), field.end(*half_edge)];
        let mut first = vec![0; field.points().len() + 1];
        for end in field.edges().iter().flat_map(ends) {
            first[end as usize + 1] += 1;
        }
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let mut free = first.clone();
        let mut edges = vec![NONE; field.edges().len() * 2];
        for (edge, half_edge) in (0..).zip(field.edges()) {
            for end in ends(half_edge) {
                edges[free[end as usize] as usize] = edge;
                free[end as usize] += 1;
            }
        }
        Self { first, edges }
    }

    fn of(&self, vertex: u32) -> &[u32] {
        let [first, last] = [vertex, vertex + 1].map(|at| self.first[at as usize] as usize);
        &self.edges[first..last]
    }
}
