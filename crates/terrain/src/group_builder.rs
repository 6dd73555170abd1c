//! Builds the hierarchy of groups. Crystals are its leaves. Level by level, each group is joined with the one that it collided with most, as
//! long as the circle around both is small enough: a group that spans the map is hidden from nowhere.

use std::collections::BTreeMap;

use glam::DVec2;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use crate::circle::Circle;
use crate::crystal::{Crystals, GroupOptions, GroupPair};
use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::groups::{Group, GroupHierarchy, HierarchyParts};
use crate::horizon::{Horizons, Sectors};
use crate::region::{Region, VertexHorizon};

impl GroupHierarchy {
    /// Grows crystals over a field, joins them, and finds the regions that each group is hidden from.
    ///
    /// # Errors
    /// As [`GroupOptions::check`].
    pub fn build(
        field: &Field,
        horizons: &Horizons,
        options: &GroupOptions,
    ) -> Result<Self, TerrainError> {
        let crystals = Crystals::grow(field, horizons, options)?;
        Ok(Self::from_crystals(field, horizons, options, &crystals))
    }

    /// Joins crystals to larger and larger groups, and finds the regions that each group is hidden from.
    #[must_use]
    pub fn from_crystals(
        field: &Field,
        horizons: &Horizons,
        options: &GroupOptions,
        crystals: &Crystals,
    ) -> Self {
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); crystals.count as usize];
        for (triangle, &group) in crystals.group_of.iter().enumerate() {
            if group != NONE {
                members[group as usize].push(triangle as u32);
            }
        }
        let sectors = *horizons.sectors();
        let mut builder = Builder::new(field, members, options.seed);
        let [low, high] = field.plan_bounds();
        let max_area = options.max_area_share * (high - low).element_product();
        builder.join(crystals.collisions.clone(), max_area);
        let edge_indices = field.edge_indices();
        let leaf_regions: Vec<Vec<Region>> = builder.members[..crystals.count as usize]
            .par_iter()
            .map(|members| {
                let edges = edges(members, &edge_indices);
                let region = |row: u32| {
                    let [sector, reach] = [row / sectors.reaches(), row % sectors.reaches()];
                    let each = edges.iter().flat_map(|&edge| {
                        let horizon = horizons.of_edge(edge, sector, reach);
                        let ends = field.ends(field.edges()[edge as usize]);
                        ends.map(|point| VertexHorizon { point, horizon })
                    });
                    Region::of_vertices(each, &sectors, sector)
                };
                (0..sectors.rows() as u32).map(region).collect()
            })
            .collect();
        builder.finish(sectors, leaf_regions, crystals)
    }
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

/// The edges of some triangles, each once, in order. `edge_indices` has the edge of each half-edge.
fn edges(triangles: &[u32], edge_indices: &[u32]) -> Vec<u32> {
    let sides = triangles.iter().flat_map(|&triangle| {
        let first = triangle as usize * 3;
        edge_indices.get(first..first + 3).unwrap_or_default()
    });
    let mut edges: Vec<u32> = sides.copied().collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The group that another one collided with most.
#[derive(Clone, Copy)]
struct BestPartner {
    times: u32,
    group: u32,
}

/// A group that a traversal has not visited yet.
struct OpenGroup {
    group: u32,
    /// The index of its parent in the final order, or [`NONE`].
    parent: u32,
    /// Which of the parent's children it is.
    side: usize,
}

/// Groups while they are joined: crystals first, then each joined group after its children.
struct Builder<'a> {
    field: &'a Field,
    /// The triangles of the crystals.
    members: Vec<Vec<u32>>,
    /// The vertices of each group in the plan, in random order.
    points: Vec<Vec<DVec2>>,
    circles: Vec<Circle>,
    children: Vec<[u32; 2]>,
    has_parent: Vec<bool>,
}

impl<'a> Builder<'a> {
    fn new(field: &'a Field, members: Vec<Vec<u32>>, seed: u64) -> Self {
        let mut rng = Pcg32::seed_from_u64(seed);
        let points: Vec<Vec<DVec2>> = members
            .iter()
            .map(|members| {
                let mut points: Vec<DVec2> = vertices(field, members)
                    .into_iter()
                    .map(|vertex| field.point(vertex).truncate())
                    .collect();
                for at in (1..points.len()).rev() {
                    points.swap(at, rng.next_u32() as usize % (at + 1));
                }
                points
            })
            .collect();
        let circles: Vec<Circle> = points
            .iter()
            .map(|points| Circle::enclosing(points))
            .collect();
        Self {
            field,
            children: vec![[NONE; 2]; members.len()],
            has_parent: vec![false; members.len()],
            members,
            points,
            circles,
        }
    }

    /// Joins level by level, until no two groups are left that collided and whose circle has at most `max_area` square metres.
    fn join(&mut self, mut collisions: BTreeMap<GroupPair, u32>, max_area: f64) {
        loop {
            let mut best: BTreeMap<u32, BestPartner> = BTreeMap::new();
            for (&GroupPair { first, second }, &times) in &collisions {
                for (group, other) in [(first, second), (second, first)] {
                    let partner = BestPartner {
                        times,
                        group: other,
                    };
                    let most = best.entry(group).or_insert(partner);
                    if times > most.times {
                        *most = partner;
                    }
                }
            }
            let mut joined: BTreeMap<u32, u32> = BTreeMap::new();
            let mut too_large = Vec::new();
            for (&group, &BestPartner { group: other, .. }) in &best {
                if joined.contains_key(&group) || joined.contains_key(&other) {
                    continue;
                }
                let mut points = self.points[group as usize].clone();
                points.extend_from_slice(&self.points[other as usize]);
                let circle = Circle::enclosing(&points);
                if circle.area() > max_area {
                    too_large.push(GroupPair::new(group, other));
                    continue;
                }
                let new = self.circles.len() as u32;
                self.circles.push(circle);
                self.points.push(points);
                self.children.push([group, other]);
                self.has_parent.push(false);
                for child in [group, other] {
                    joined.insert(child, new);
                    self.has_parent[child as usize] = true;
                }
            }
            if joined.is_empty() && too_large.is_empty() {
                return;
            }
            for pair in too_large {
                collisions.remove(&pair);
            }
            let current = |group: u32| joined.get(&group).copied().unwrap_or(group);
            let mut next = BTreeMap::new();
            for (GroupPair { first, second }, times) in collisions {
                let [first, second] = [current(first), current(second)];
                if first != second {
                    *next.entry(GroupPair::new(first, second)).or_insert(0) += times;
                }
            }
            collisions = next;
        }
    }

    /// Puts groups and triangles into their final order.
    fn finish(
        self,
        sectors: Sectors,
        leaf_regions: Vec<Vec<Region>>,
        crystals: &Crystals,
    ) -> GroupHierarchy {
        let mut all = leaf_regions;
        for children in &self.children[all.len()..] {
            let [a, b] = children.map(|child| &all[child as usize]);
            let both = a.iter().zip(b).map(|(a, b)| Region::intersection([a, b]));
            let both = both.collect();
            all.push(both);
        }
        let mut groups: Vec<Group> = Vec::new();
        let mut regions = Vec::new();
        let mut order = Vec::new();
        let mut roots = Vec::new();
        let tops = (0..self.has_parent.len()).filter(|&group| !self.has_parent[group]);
        for top in tops {
            roots.push(groups.len() as u32);
            let mut open = vec![OpenGroup {
                group: top as u32,
                parent: NONE,
                side: 0,
            }];
            while let Some(OpenGroup {
                group,
                parent,
                side,
            }) = open.pop()
            {
                let number = groups.len() as u32;
                if let Some(parent) = groups.get_mut(parent as usize) {
                    parent.children[side] = number;
                }
                let first = order.len() as u32;
                let children = self.children[group as usize];
                if children == [NONE; 2] {
                    order.extend_from_slice(&self.members[group as usize]);
                } else {
                    for side in [1, 0] {
                        open.push(OpenGroup {
                            group: children[side],
                            parent: number,
                            side,
                        });
                    }
                }
                groups.push(Group {
                    triangles: first..order.len() as u32,
                    children: [NONE; 2],
                    circle: self.circles[group as usize],
                    heights: [f64::INFINITY, f64::NEG_INFINITY],
                });
                regions.extend_from_slice(&all[group as usize]);
            }
        }
        self.fill_ranges_and_heights(&mut groups, &order);
        let first = order.len() as u32;
        let free = crystals
            .group_of
            .iter()
            .enumerate()
            .filter(|(_, group)| **group == NONE);
        order.extend(free.map(|(triangle, _)| triangle as u32));
        let ungrouped = first..order.len() as u32;
        GroupHierarchy::from_parts(HierarchyParts {
            sectors,
            groups,
            regions,
            roots,
            order,
            ungrouped,
        })
    }

    /// Computes the triangles and the heights of all groups, children before their parents. Leaves have their triangles already.
    fn fill_ranges_and_heights(&self, groups: &mut [Group], order: &[u32]) {
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
    }
}
