//! Checks the groups of a file: that they are a hierarchy over a list of all triangles, and that their circles and heights hold what they
//! should.

use rayon::prelude::*;

use super::problem::bad;
use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::groups::{Group, GroupHierarchy};

/// The deepest hierarchy. Every vertex is tested against the circles of all groups that it is in.
const DEEPEST: u32 = 1024;
/// How far beyond its circle rounding may move a vertex, for each metre of the circle's distance and radius.
const ROUNDING: f64 = 1e-12;

/// Checks everything about groups except their regions.
pub(super) fn check_groups(field: &Field, groups: &GroupHierarchy) -> Result<(), TerrainError> {
    let all = groups.groups();
    let triangles = field.triangles().len();
    if !is_each_once(groups.order(), triangles) {
        return Err(bad("its order does not have every triangle once"));
    }
    check_tree(all, groups.roots())?;
    let mut end = 0;
    for (number, group) in all.iter().enumerate() {
        let range = &group.triangles;
        let fits = match children(all, group) {
            None => {
                let begin = std::mem::replace(&mut end, range.end);
                range.start == begin && range.start < range.end
            }
            Some([a, b]) => {
                let [a, b] = [a, b].map(|child| &child.triangles);
                range.start == a.start && a.end == b.start && b.end == range.end
            }
        };
        if !fits {
            return Err(bad(format!(
                "group {number} has the triangles {range:?}, which do not follow those of the group before it, or are not those of its children"
            )));
        }
    }
    if end != groups.ungrouped().start || groups.ungrouped().end as usize != triangles {
        return Err(bad(format!(
            "its groups have {end} of {triangles} triangles, and {} are in no group",
            groups.ungrouped().len()
        )));
    }
    let wrong = all.par_iter().position_first(|group| {
        !is_in_circle(field, group, groups.triangles(group)) || !has_heights(field, groups, group)
    });
    wrong.map_or(Ok(()), |number| {
        Err(bad(format!(
            "group {number} extends beyond its circle or its heights"
        )))
    })
}

/// Checks the ungrouped triangles of all nodes and divides them: `ends` has the end of each node's triangles in `row`.
pub(super) fn check_ungrouped(
    groups: &GroupHierarchy,
    row: &[u32],
    ends: &[u32],
) -> Result<Vec<Vec<u32>>, TerrainError> {
    let [mut expected, mut found] = [groups.ungrouped_triangles(), row].map(<[u32]>::to_vec);
    expected.sort_unstable();
    found.sort_unstable();
    if expected != found {
        return Err(bad(
            "the triangles that are always drawn are not those of no group",
        ));
    }
    let mut begin = 0;
    let mut shown = Vec::with_capacity(ends.len());
    for &end in ends {
        let part = row.get(begin..end as usize).filter(|part| !part.is_empty());
        let part =
            part.ok_or_else(|| bad("a node shows none of the triangles that are always drawn"))?;
        shown.push(part.to_vec());
        begin = end as usize;
    }
    if begin != row.len() {
        return Err(bad(
            "no node shows some of the triangles that are always drawn",
        ));
    }
    Ok(shown)
}

/// Whether a row has each of the numbers below `count` once.
fn is_each_once(row: &[u32], count: usize) -> bool {
    let mut seen = vec![false; count];
    row.len() == count
        && row.iter().all(|&at| {
            let seen = seen.get_mut(at as usize);
            seen.is_some_and(|seen| !std::mem::replace(seen, true))
        })
}

/// The children of a group; `None` for a leaf.
fn children<'a>(all: &'a [Group], group: &Group) -> Option<[&'a Group; 2]> {
    let [a, b] = group.children;
    all.get(a as usize)
        .zip(all.get(b as usize))
        .map(<[_; 2]>::from)
}

/// Checks that every group comes after its parent and has one parent at most, and that those without a parent are the roots.
fn check_tree(all: &[Group], roots: &[u32]) -> Result<(), TerrainError> {
    let mut depths = vec![0_u32; all.len()];
    for (number, group) in all.iter().enumerate() {
        if group.is_leaf() {
            continue;
        }
        let depth = depths.get(number).copied().unwrap_or_default() + 1;
        if depth > DEEPEST {
            return Err(bad(format!(
                "its groups are nested more than {DEEPEST} deep"
            )));
        }
        for child in group.children {
            let after = child as usize > number && child != NONE;
            let own = depths.get_mut(child as usize);
            let own = own.filter(|own| after && **own == 0);
            let own = own.ok_or_else(|| {
                bad(format!(
                    "group {number} cannot have the child {child}: a child comes after its parent, and has one parent"
                ))
            })?;
            *own = depth;
        }
    }
    let parentless = (0..all.len() as u32).filter(|&group| depths.get(group as usize) == Some(&0));
    if !parentless.eq(roots.iter().copied()) {
        return Err(bad("its tops are not the groups without a parent"));
    }
    Ok(())
}

/// Whether all triangles of a group lie in its circle.
fn is_in_circle(field: &Field, group: &Group, triangles: &[u32]) -> bool {
    let circle = group.circle;
    let slack = (circle.middle.abs().max_element() + circle.radius) * ROUNDING;
    let reach = circle.radius + slack;
    circle.middle.is_finite()
        && reach.is_finite()
        && triangles.iter().all(|&triangle| {
            let corners = field.corners(triangle);
            let mut distances = corners
                .iter()
                .map(|at| at.truncate().distance(circle.middle));
            distances.all(|distance| distance <= reach)
        })
}

/// Whether the heights of a leaf are those of its triangles, and the heights of another group those of its children.
fn has_heights(field: &Field, groups: &GroupHierarchy, group: &Group) -> bool {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    let join = |[low, high]: [f64; 2], [other_low, other_high]: [f64; 2]| {
        [low.min(other_low), high.max(other_high)]
    };
    let heights = match children(groups.groups(), group) {
        Some([a, b]) => join(a.heights, b.heights),
        None => {
            let corners = groups.triangles(group).iter();
            let corners = corners.flat_map(|&triangle| field.corners(triangle));
            corners.map(|at| [at.z, at.z]).fold(empty, join)
        }
    };
    heights == group.heights
}
