//! Whether groups out of a file can be any: a hierarchy over a row of all triangles, with circles and heights that hold what they are said to.

use rayon::prelude::*;

use super::bad;
use crate::error::TerrainError;
use crate::field::{Field, NONE};
use crate::groups::{Group, Groups};

/// The deepest hierarchy; every vertex is held against the circles of all groups that it is in.
const DEEPEST: u32 = 1024;
/// How far beyond its circle rounding may put a vertex, for each metre of the circle's distance and radius.
const ROUNDING: f64 = 1e-12;

/// Everything about groups but the regions that hide them.
pub(super) fn groups(field: &Field, groups: &Groups) -> Result<(), TerrainError> {
    let all = groups.groups();
    let triangles = field.triangles().len();
    if !is_each_once(groups.order(), triangles) {
        return Err(bad("its order does not have every triangle once"));
    }
    tree(all, groups.tops())?;
    let mut end = 0;
    for (number, group) in all.iter().enumerate() {
        let range = &group.triangles;
        let fits = match parts(all, group) {
            None => {
                let begin = std::mem::replace(&mut end, range.end);
                range.start == begin && range.start < range.end
            }
            Some([a, b]) => {
                let [a, b] = [a, b].map(|part| &part.triangles);
                range.start == a.start && a.end == b.start && b.end == range.end
            }
        };
        if !fits {
            return Err(bad(format!(
                "group {number} has the triangles {range:?}, which are not those after the group before it, or not those of its parts"
            )));
        }
    }
    if end != groups.always().start || groups.always().end as usize != triangles {
        return Err(bad(format!(
            "its groups have {end} triangles of {triangles}, and {} are in none",
            groups.always().len()
        )));
    }
    let wrong = all.par_iter().position_first(|group| {
        !circle_holds(field, group, groups.triangles(group)) || !heights_hold(field, groups, group)
    });
    wrong.map_or(Ok(()), |number| {
        Err(bad(format!(
            "group {number} reaches beyond the circle or the heights it is said to have"
        )))
    })
}

/// The triangles that each node shows of those in no group.
pub(super) fn always(
    groups: &Groups,
    row: &[u32],
    ends: &[u32],
) -> Result<Vec<Vec<u32>>, TerrainError> {
    let range = groups.always();
    let rest = groups.order().get(range.start as usize..range.end as usize);
    let [mut there, mut said] = [rest.unwrap_or_default(), row].map(<[u32]>::to_vec);
    there.sort_unstable();
    said.sort_unstable();
    if there != said {
        return Err(bad("what is always drawn is not what is in no group"));
    }
    let mut begin = 0;
    let mut shown = Vec::with_capacity(ends.len());
    for &end in ends {
        let part = row.get(begin..end as usize).filter(|part| !part.is_empty());
        let part = part.ok_or_else(|| bad("a node shows none of what is always drawn"))?;
        shown.push(part.to_vec());
        begin = end as usize;
    }
    if begin != row.len() {
        return Err(bad("no node shows some of what is always drawn"));
    }
    Ok(shown)
}

fn is_each_once(row: &[u32], count: usize) -> bool {
    let mut seen = vec![false; count];
    row.len() == count
        && row.iter().all(|&at| {
            let seen = seen.get_mut(at as usize);
            seen.is_some_and(|seen| !std::mem::replace(seen, true))
        })
}

/// The two that a group is made of; `None` for a crystal.
fn parts<'a>(all: &'a [Group], group: &Group) -> Option<[&'a Group; 2]> {
    let [a, b] = group.children;
    all.get(a as usize)
        .zip(all.get(b as usize))
        .map(<[_; 2]>::from)
}

/// Every group behind the one that it is part of, and part of one at most; those of none are the tops.
fn tree(all: &[Group], tops: &[u32]) -> Result<(), TerrainError> {
    let mut depths = vec![0_u32; all.len()];
    for (number, group) in all.iter().enumerate() {
        if group.is_leaf() {
            continue;
        }
        let depth = depths.get(number).copied().unwrap_or_default() + 1;
        if depth > DEEPEST {
            return Err(bad(format!("its groups are more than {DEEPEST} deep")));
        }
        for child in group.children {
            let behind = child as usize > number && child != NONE;
            let own = depths.get_mut(child as usize);
            let own = own.filter(|own| behind && **own == 0);
            let own = own.ok_or_else(|| {
                bad(format!(
                    "group {number} cannot be made of group {child}: parts come behind the whole, and are parts once"
                ))
            })?;
            *own = depth;
        }
    }
    let free = (0..all.len() as u32).filter(|&group| depths.get(group as usize) == Some(&0));
    if !free.eq(tops.iter().copied()) {
        return Err(bad("its tops are not the groups that are part of no other"));
    }
    Ok(())
}

fn circle_holds(field: &Field, group: &Group, triangles: &[u32]) -> bool {
    let circle = group.circle;
    let slack = (circle.middle.abs().max_element() + circle.radius) * ROUNDING;
    let reach = circle.radius + slack;
    circle.middle.is_finite()
        && reach.is_finite()
        && triangles.iter().all(|&triangle| {
            let corners = field.corners(triangle);
            let mut far = corners
                .iter()
                .map(|at| at.truncate().distance(circle.middle));
            far.all(|far| far <= reach)
        })
}

/// Whether the heights are those of the triangles, or of the parts, which are held against theirs.
fn heights_hold(field: &Field, groups: &Groups, group: &Group) -> bool {
    let empty = [f64::INFINITY, f64::NEG_INFINITY];
    let join =
        |[low, high]: [f64; 2], [lower, higher]: [f64; 2]| [low.min(lower), high.max(higher)];
    let heights = match parts(groups.groups(), group) {
        Some([a, b]) => join(a.heights, b.heights),
        None => {
            let corners = groups.triangles(group).iter();
            let corners = corners.flat_map(|&triangle| field.corners(triangle));
            corners.map(|at| [at.z, at.z]).fold(empty, join)
        }
    };
    heights == group.heights
}
