//! Crystals: triangles that are hidden together, grown from chance seeds (Edmondson, sections 5.2.3 and 6.3).
//!
//! Every seed grows triangle by triangle, breadth first, all at the same pace, until it meets others or would grow over a ridge: a
//! triangle joins only if none of its corners lies beyond the horizons of the edges at the lowest vertex so far. So crystals grow away from ridges, which
//! stay behind as orphans; fewer seeds are cast over those, and so on. What is too small in the end is joined to another of its kind that it
//! met, or left to what is always drawn.

use std::collections::{BTreeMap, VecDeque};

use glam::DVec3;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::horizon::Horizons;

/// How crystals are grown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupOptions {
    /// Seeds of the first pass.
    pub seeds: u32,
    /// The most groups.
    pub most: u32,
    /// The most passes over orphans.
    pub passes: u32,
    /// Triangles below which a group is joined to another or given up.
    pub smallest: u32,
    /// Two groups are not joined where the circle around both is larger than this part of the field's area.
    pub widest: f64,
    /// The seed of all chance.
    pub seed: u64,
}

impl GroupOptions {
    /// The thesis's numbers for a field of so many triangles: a seed for every 200 at first, groups of 30 triangles at least.
    #[must_use]
    pub fn for_triangles(triangles: usize) -> Self {
        let seeds = (triangles / 200).clamp(1, 1 << 20) as u32;
        Self {
            seeds,
            most: seeds * 2,
            passes: 10,
            smallest: 30,
            widest: 0.25,
            seed: 1,
        }
    }

    /// The same from so many seeds.
    #[must_use]
    pub fn of_seeds(seeds: u32) -> Self {
        Self {
            seeds,
            most: seeds.saturating_mul(2),
            ..Self::for_triangles(0)
        }
    }

    /// Whether the numbers can be.
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
        if self.most < self.seeds {
            let value = self.most.to_string();
            return refuse("the most groups", value, "give at least as many as seeds");
        }
        if !(self.widest > 0.0 && self.widest <= 1e6) {
            let value = self.widest.to_string();
            return refuse("the widest group", value, "give more than 0, at most 1e6");
        }
        Ok(())
    }
}

/// What came of growing.
#[derive(Debug, Clone, PartialEq)]
pub struct Crystals {
    /// The group of each triangle; [`NONE`] for those that are always drawn.
    pub of: Vec<u32>,
    /// How many groups there are.
    pub count: u32,
    /// How often two groups ran into each other; the smaller number first.
    pub collisions: BTreeMap<(u32, u32), u32>,
    /// Passes over orphans.
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
            of: vec![NONE; triangles],
            around: Spokes::new(field),
            lowest: Vec::new(),
            collisions: BTreeMap::new(),
        };
        let mut chance = Pcg32::seed_from_u64(options.seed);
        let mut orphans: Vec<u32> = (0..triangles as u32).collect();
        let mut passes = 0;
        loop {
            let share = orphans.len() as f64 / triangles as f64;
            let room = options.most - growth.lowest.len() as u32;
            let seeds = (f64::from(options.seeds) * share).ceil() as u32;
            let before = growth.lowest.len();
            let largest = growth.pass(&mut orphans, seeds.min(room), &mut chance);
            let whole = growth.lowest.len() == before || largest < options.smallest;
            orphans.retain(|&triangle| growth.of[triangle as usize] == NONE);
            if whole || orphans.is_empty() || passes == options.passes {
                break;
            }
            passes += 1;
        }
        let Growth {
            of,
            lowest,
            collisions,
            ..
        } = growth;
        let mut crystals = Self {
            of,
            count: lowest.len() as u32,
            collisions,
            passes,
        };
        crystals.join_small(options.smallest);
        Ok(crystals)
    }

    /// How many triangles each group has.
    #[must_use]
    pub fn sizes(&self) -> Vec<u32> {
        let mut sizes = vec![0; self.count as usize];
        for &group in self.of.iter().filter(|group| **group != NONE) {
            sizes[group as usize] += 1;
        }
        sizes
    }

    /// Triangles of no group.
    #[must_use]
    pub fn orphans(&self) -> usize {
        self.of.iter().filter(|group| **group == NONE).count()
    }

    /// Joins groups that are too small with others of their kind that they met most, frees those that met none, and numbers the rest anew.
    fn join_small(&mut self, smallest: u32) {
        let mut sizes = self.sizes();
        let mut names: Vec<u32> = (0..self.count).collect();
        let mut met: Vec<((u32, u32), u32)> = self
            .collisions
            .iter()
            .map(|(&pair, &times)| (pair, times))
            .collect();
        met.sort_by_key(|&(pair, times)| (std::cmp::Reverse(times), pair));
        for ((a, b), _) in met {
            let [a, b] = [a, b].map(|group| stands_for(&names, group));
            let small = |group: u32| sizes[group as usize] < smallest;
            if a != b && small(a) && small(b) {
                sizes[a as usize] += sizes[b as usize];
                sizes[b as usize] = 0;
                names[b as usize] = a;
            }
        }
        let mut count = 0;
        let kept: Vec<u32> = sizes
            .iter()
            .map(|&size| {
                let kept = size >= smallest.max(1);
                count += u32::from(kept);
                if kept { count - 1 } else { NONE }
            })
            .collect();
        let name = |group: u32| kept[stands_for(&names, group) as usize];
        for group in self.of.iter_mut().filter(|group| **group != NONE) {
            *group = name(*group);
        }
        let mut collisions = BTreeMap::new();
        for (&(a, b), &times) in &self.collisions {
            let [a, b] = [name(a), name(b)];
            if a != b && a != NONE && b != NONE {
                *collisions.entry((a.min(b), a.max(b))).or_insert(0) += times;
            }
        }
        self.collisions = collisions;
        self.count = count;
    }
}

/// The group that one has become.
fn stands_for(names: &[u32], mut group: u32) -> u32 {
    while names[group as usize] != group {
        group = names[group as usize];
    }
    group
}

/// Crystals while they grow.
struct Growth<'a> {
    field: &'a Field,
    horizons: &'a Horizons,
    of: Vec<u32>,
    /// The edges at each vertex.
    around: Spokes,
    /// The lowest vertex of each group.
    lowest: Vec<u32>,
    collisions: BTreeMap<(u32, u32), u32>,
}

impl Growth<'_> {
    /// Casts seeds over orphans and lets them grow; says how large the largest has become.
    fn pass(&mut self, orphans: &mut [u32], seeds: u32, chance: &mut Pcg32) -> u32 {
        let first = self.lowest.len() as u32;
        let mut fronts: Vec<VecDeque<u32>> = Vec::new();
        let mut sizes = Vec::new();
        for cast in 0..(seeds as usize).min(orphans.len()) {
            let left = orphans.len() - cast;
            let other = cast + chance.next_u32() as usize % left;
            orphans.swap(cast, other);
            let seed = orphans[cast];
            let corners = self.field.triangles()[seed as usize];
            let group = self.lowest.len() as u32;
            self.lowest.push(self.lower(corners));
            self.of[seed as usize] = group;
            fronts.push((0..3).map(|side| 3 * seed + side).collect());
            sizes.push(1_u32);
        }
        let mut grows = true;
        while grows {
            grows = false;
            for (at, front) in fronts.iter_mut().enumerate() {
                let group = first + at as u32;
                // One triangle each, so that all grow at the same pace.
                while let Some(half) = front.pop_front() {
                    let across = self.field.across(half);
                    if across != NONE && self.join(group, across / 3) {
                        let sides = (0..3).map(|side| across / 3 * 3 + side);
                        front.extend(sides.filter(|&side| side != across));
                        sizes[at] += 1;
                        grows = true;
                        break;
                    }
                }
            }
        }
        sizes.into_iter().max().unwrap_or_default()
    }

    /// Lets a triangle join a group, if it is free and lies before the group's horizon.
    fn join(&mut self, group: u32, triangle: u32) -> bool {
        let other = self.of[triangle as usize];
        if other != NONE {
            if other != group {
                let pair = (group.min(other), group.max(other));
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
        self.of[triangle as usize] = group;
        let lower = self.lower(corners);
        if self.field.point(lower).z < self.field.point(lowest).z {
            self.lowest[group as usize] = lower;
        }
        true
    }

    /// Whether a place is hidden from all edges at a vertex. What the vertex alone does not see is beyond any ripple of the ground.
    fn is_beyond(&self, vertex: u32, place: DVec3) -> bool {
        let away = place - self.field.point(vertex);
        let far = away.truncate().length();
        let sector = self.horizons.sectors().containing(away.truncate());
        sector.is_some_and(|sector| {
            let hides = |&edge: &u32| self.horizons.along(edge, sector, 0).hides(far, away.z);
            self.around.of(vertex).iter().all(hides)
        })
    }

    fn lower(&self, [a, b, c]: [u32; 3]) -> u32 {
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
struct Spokes {
    /// Where each vertex's edges begin, and one more.
    first: Vec<u32>,
    edges: Vec<u32>,
}

impl Spokes {
    fn new(field: &Field) -> Self {
        let ends = |half: &u32| [field.start(*half), field.end(*half)];
        let mut first = vec![0; field.points().len() + 1];
        for end in field.edges().iter().flat_map(ends) {
            first[end as usize + 1] += 1;
        }
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let mut free = first.clone();
        let mut edges = vec![NONE; field.edges().len() * 2];
        for (edge, half) in (0..).zip(field.edges()) {
            for end in ends(half) {
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
