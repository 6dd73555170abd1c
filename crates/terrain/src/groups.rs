//! A hierarchy of groups of triangles that hide together: ranges of one row of triangles, and for each the regions that hide it
//! (Edmondson, sections 4.6 and 5.2.3).
//!
//! Crystals are the leaves. Level by level, each group is joined with the one that it ran into most, as long as the circle around both
//! is not too wide: a group that reaches across the map is hidden from nowhere.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec2;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use crate::circle::Circle;
use crate::crystal::{Crystals, GroupOptions};
use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::horizon::compass::Compass;
use crate::horizon::{Horizons, Sectors};
use crate::lid::Lid;
use crate::region::Region;

/// A group of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Its triangles, in the row of [`Groups::order`].
    pub triangles: Range<u32>,
    /// The two groups it is made of; [`NONE`] twice for a crystal.
    pub children: [u32; 2],
    /// The circle around it.
    pub circle: Circle,
    /// Its lowest and its highest place, metres up.
    pub heights: [f64; 2],
}

impl Group {
    /// Whether it is a crystal.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.children == [NONE; 2]
    }
}

/// The groups of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    sectors: Sectors,
    groups: Vec<Group>,
    /// A row of sectors, with all reaches of each, for each group.
    regions: Vec<Region>,
    tops: Vec<u32>,
    order: Vec<u32>,
    always: Range<u32>,
    compass: Compass,
    /// A row of sectors for each group.
    lids: Vec<Lid>,
    /// Where a walk begins: the tops, and in place of a group that nothing hides from anywhere its parts.
    begin: Vec<u32>,
}

impl Groups {
    /// Grows crystals over a field, joins them, and finds what hides each group.
    ///
    /// # Errors
    /// As [`GroupOptions::check`].
    pub fn make(
        field: &Field,
        horizons: &Horizons,
        options: &GroupOptions,
    ) -> Result<Self, TerrainError> {
        let crystals = Crystals::grow(field, horizons, options)?;
        Ok(Self::join(field, horizons, options, &crystals))
    }

    /// Joins crystals to larger and larger groups.
    #[must_use]
    pub fn join(
        field: &Field,
        horizons: &Horizons,
        options: &GroupOptions,
        crystals: &Crystals,
    ) -> Self {
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); crystals.count as usize];
        for (triangle, &group) in crystals.of.iter().enumerate() {
            if group != NONE {
                members[group as usize].push(triangle as u32);
            }
        }
        let sectors = *horizons.sectors();
        let mut tree = Tree::new(field, members, options.seed);
        let [low, high] = field.plan_bounds();
        let widest = options.widest * (high - low).element_product();
        tree.join(crystals.collisions.clone(), widest);
        let numbers = field.edge_numbers();
        let leaf_regions: Vec<Vec<Region>> = tree.members[..crystals.count as usize]
            .par_iter()
            .map(|members| {
                let edges = edges(members, &numbers);
                let region = |row: u32| {
                    let [sector, reach] = [row / sectors.reaches(), row % sectors.reaches()];
                    let each = edges.iter().flat_map(|&edge| {
                        let horizon = horizons.along(edge, sector, reach);
                        let ends = field.ends(field.edges()[edge as usize]);
                        ends.map(|end| (end, horizon))
                    });
                    Region::around(each, &sectors, sector)
                };
                (0..sectors.rows() as u32).map(region).collect()
            })
            .collect();
        tree.finish(sectors, leaf_regions, crystals)
    }

    /// The sectors of the regions.
    #[must_use]
    pub fn sectors(&self) -> &Sectors {
        &self.sectors
    }

    /// All groups, a group before its children.
    #[must_use]
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The groups that are part of no other.
    #[must_use]
    pub fn tops(&self) -> &[u32] {
        &self.tops
    }

    /// The field's triangles, group after group, and those of no group at the end.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The triangles of no group, which are always drawn.
    #[must_use]
    pub fn always(&self) -> Range<u32> {
        self.always.clone()
    }

    /// The triangles of a group.
    #[must_use]
    pub fn triangles(&self, group: &Group) -> &[u32] {
        let range = group.triangles.start as usize..group.triangles.end as usize;
        self.order.get(range).unwrap_or_default()
    }

    /// What was made before, and is known to fit together.
    pub(crate) fn from_parts(
        sectors: Sectors,
        groups: Vec<Group>,
        regions: Vec<Region>,
        tops: Vec<u32>,
        order: Vec<u32>,
        always: Range<u32>,
    ) -> Self {
        Self {
            compass: Compass::new(&sectors),
            lids: Lid::each(&regions, sectors.reaches()),
            begin: begin(&groups, &regions, sectors.rows(), &tops),
            sectors,
            groups,
            regions,
            tops,
            order,
            always,
        }
    }

    /// The sectors by direction.
    pub(crate) fn compass(&self) -> &Compass {
        &self.compass
    }

    /// What lies on the regions of a group, sector by sector.
    pub(crate) fn lids(&self, group: u32) -> &[Lid] {
        let count = self.sectors.count() as usize;
        let first = group as usize * count;
        self.lids.get(first..first + count).unwrap_or_default()
    }

    /// The groups that a walk from the top begins with, in order: those above them are hidden from nowhere.
    pub(crate) fn begin(&self) -> &[u32] {
        &self.begin
    }

    /// What hides a group, sector by sector, and in each reach by reach: whoever is in any of a sector's regions is hidden in that sector.
    #[must_use]
    pub fn regions(&self, group: u32) -> &[Region] {
        let rows = self.sectors.rows();
        let first = group as usize * rows;
        self.regions.get(first..first + rows).unwrap_or_default()
    }
}

/// Where a walk over groups, each before its children, has to begin.
fn begin(groups: &[Group], regions: &[Region], rows: usize, tops: &[u32]) -> Vec<u32> {
    let mut reached = vec![false; groups.len()];
    let reach = |reached: &mut [bool], group: u32| {
        if let Some(reached) = reached.get_mut(group as usize) {
            *reached = true;
        }
    };
    tops.iter().for_each(|top| reach(&mut reached, *top));
    let mut found = Vec::new();
    for ((number, group), row) in groups.iter().enumerate().zip(regions.chunks(rows)) {
        if !reached[number] {
            continue;
        }
        if group.is_leaf() || row.iter().any(|region| !region.is_open()) {
            found.push(number as u32);
        } else {
            group
                .children
                .iter()
                .for_each(|child| reach(&mut reached, *child));
        }
    }
    found
}

/// The corners of some triangles, each once, in order.
fn vertices(field: &Field, triangles: &[u32]) -> Vec<u32> {
    let corners = triangles
        .iter()
        .flat_map(|&triangle| field.triangles()[triangle as usize]);
    let mut corners: Vec<u32> = corners.collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// The edges of some triangles, each once, in order.
fn edges(triangles: &[u32], numbers: &[u32]) -> Vec<u32> {
    let sides = triangles.iter().flat_map(|&triangle| {
        let first = triangle as usize * 3;
        numbers.get(first..first + 3).unwrap_or_default()
    });
    let mut edges: Vec<u32> = sides.copied().collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Groups while they are joined: crystals first, each joined one after its parts.
struct Tree<'a> {
    field: &'a Field,
    /// The triangles of crystals.
    members: Vec<Vec<u32>>,
    /// The corners of each group's triangles, in chance order.
    places: Vec<Vec<DVec2>>,
    circles: Vec<Circle>,
    children: Vec<[u32; 2]>,
    joined: Vec<bool>,
}

impl<'a> Tree<'a> {
    fn new(field: &'a Field, members: Vec<Vec<u32>>, seed: u64) -> Self {
        let mut chance = Pcg32::seed_from_u64(seed);
        let places: Vec<Vec<DVec2>> = members
            .iter()
            .map(|members| {
                let mut places: Vec<DVec2> = vertices(field, members)
                    .into_iter()
                    .map(|vertex| field.point(vertex).truncate())
                    .collect();
                for at in (1..places.len()).rev() {
                    places.swap(at, chance.next_u32() as usize % (at + 1));
                }
                places
            })
            .collect();
        let circles: Vec<Circle> = places.iter().map(|places| Circle::around(places)).collect();
        Self {
            field,
            children: vec![[NONE; 2]; members.len()],
            joined: vec![false; members.len()],
            members,
            places,
            circles,
        }
    }

    /// Joins level by level, until no two groups are left that met and are near enough.
    fn join(&mut self, mut met: BTreeMap<(u32, u32), u32>, widest: f64) {
        loop {
            let mut best: BTreeMap<u32, (u32, u32)> = BTreeMap::new();
            for (&(a, b), &times) in &met {
                for (group, other) in [(a, b), (b, a)] {
                    let most = best.entry(group).or_insert((times, other));
                    if times > most.0 {
                        *most = (times, other);
                    }
                }
            }
            let mut names: BTreeMap<u32, u32> = BTreeMap::new();
            let mut apart = Vec::new();
            for (&group, &(_, other)) in &best {
                if names.contains_key(&group) || names.contains_key(&other) {
                    continue;
                }
                let mut places = self.places[group as usize].clone();
                places.extend_from_slice(&self.places[other as usize]);
                let circle = Circle::around(&places);
                if circle.area() > widest {
                    apart.push((group.min(other), group.max(other)));
                    continue;
                }
                let new = self.circles.len() as u32;
                self.circles.push(circle);
                self.places.push(places);
                self.children.push([group, other]);
                self.joined.push(false);
                for part in [group, other] {
                    names.insert(part, new);
                    self.joined[part as usize] = true;
                }
            }
            if names.is_empty() && apart.is_empty() {
                return;
            }
            for pair in apart {
                met.remove(&pair);
            }
            let name = |group: u32| names.get(&group).copied().unwrap_or(group);
            let mut next = BTreeMap::new();
            for ((a, b), times) in met {
                let [a, b] = [name(a), name(b)];
                if a != b {
                    *next.entry((a.min(b), a.max(b))).or_insert(0) += times;
                }
            }
            met = next;
        }
    }

    /// Puts groups and triangles into their final order.
    fn finish(self, sectors: Sectors, regions: Vec<Vec<Region>>, crystals: &Crystals) -> Groups {
        let mut all = regions;
        for children in &self.children[all.len()..] {
            let [a, b] = children.map(|child| &all[child as usize]);
            let both = a.iter().zip(b).map(|(a, b)| Region::all([a, b]));
            let both = both.collect();
            all.push(both);
        }
        let mut groups: Vec<Group> = Vec::new();
        let mut flat = Vec::new();
        let mut order = Vec::new();
        let mut tops = Vec::new();
        let roots = (0..self.joined.len()).filter(|&group| !self.joined[group]);
        for root in roots {
            tops.push(groups.len() as u32);
            // A group, whose child it is, and which of the two.
            let mut open = vec![(root as u32, NONE, 0)];
            while let Some((group, parent, side)) = open.pop() {
                let number = groups.len() as u32;
                if let Some(parent) = groups.get_mut(parent as usize) {
                    parent.children[side] = number;
                }
                let first = order.len() as u32;
                let children = self.children[group as usize];
                if children == [NONE; 2] {
                    order.extend_from_slice(&self.members[group as usize]);
                } else {
                    open.push((children[1], number, 1));
                    open.push((children[0], number, 0));
                }
                groups.push(Group {
                    triangles: first..order.len() as u32,
                    children: [NONE; 2],
                    circle: self.circles[group as usize],
                    heights: [f64::INFINITY, f64::NEG_INFINITY],
                });
                flat.extend_from_slice(&all[group as usize]);
            }
        }
        for at in (0..groups.len()).rev() {
            let group = &groups[at];
            let (triangles, heights) = if group.is_leaf() {
                let heights = order[group.triangles.start as usize..group.triangles.end as usize]
                    .iter()
                    .flat_map(|&triangle| self.field.corners(triangle))
                    .fold(group.heights, |[low, high], corner| {
                        [low.min(corner.z), high.max(corner.z)]
                    });
                (group.triangles.clone(), heights)
            } else {
                let [a, b] = group.children.map(|child| &groups[child as usize]);
                let heights = [
                    a.heights[0].min(b.heights[0]),
                    a.heights[1].max(b.heights[1]),
                ];
                (a.triangles.start..b.triangles.end, heights)
            };
            groups[at].triangles = triangles;
            groups[at].heights = heights;
        }
        let first = order.len() as u32;
        let free = crystals
            .of
            .iter()
            .enumerate()
            .filter(|(_, group)| **group == NONE);
        order.extend(free.map(|(triangle, _)| triangle as u32));
        let always = first..order.len() as u32;
        Groups::from_parts(sectors, groups, flat, tops, order, always)
    }
}
