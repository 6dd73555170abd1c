//! Horizons of boxes: all lines of sight from any place of a box's top, in each sector, against walls of terrain beyond it.
//!
//! What lies lower in a box is hidden where its top is, so that the top's rectangle stands for all of it. Terrain within the box or beside it does
//! not count: walls stand wholly ahead, so that it is the same whether the box stands on the ground, in it, or outside of the field.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::bearing::{Bearing, Edges};
use super::bundle::{Bundle, Claim};
use super::crossing::{Crossing, resolve};
use super::sound::rounded;
use super::{Horizon, Sectors};
use crate::field::Field;

/// Boxes farther from the origin than this are not looked from, metres: rounding would no longer be told from a slope.
const FARTHEST: f64 = 1e6;

/// The four corners of a rectangle's top, counter-clockwise.
pub(crate) type Top = [DVec3; 4];

/// Finds the horizon of all places of each top in each sector and reach, a row of tops a reach of a sector; `done` is told of every sector finished.
/// Each direction is turned to once, whatever the number of tops.
pub(crate) fn find(
    field: &Field,
    sectors: Sectors,
    tops: &[Top],
    done: &(dyn Fn() + Sync),
) -> Vec<Horizon> {
    let mut table = vec![Horizon::OPEN; tops.len() * sectors.rows()];
    if tops.is_empty() {
        return table;
    }
    let edges = Edges::new(field);
    table
        .par_chunks_mut(tops.len() * sectors.reaches() as usize)
        .enumerate()
        .for_each(|(sector, rows)| {
            let found = sector_of(field, &edges, &sectors, sector as u32, tops);
            for (reach, row) in rows.chunks_mut(tops.len()).enumerate() {
                for (horizon, claims) in row.iter_mut().zip(&found) {
                    *horizon = claims
                        .get(reach)
                        .map_or(Horizon::OPEN, |claim| rounded(*claim));
                }
            }
            done();
        });
    table
}

/// The claims of all tops in one sector, one a reach.
fn sector_of(
    field: &Field,
    edges: &Edges,
    sectors: &Sectors,
    sector: u32,
    tops: &[Top],
) -> Vec<Vec<Claim>> {
    let reaches = edges.reaches(sectors);
    let near = |top: &Top| {
        top.iter()
            .all(|at| at.is_finite() && at.abs().max_element() <= FARTHEST)
    };
    let all = |top: &Top| match near(top) {
        true => Claim::ALL,
        false => Claim::OPEN,
    };
    let all = |top| vec![all(top); reaches.len()];
    let mut claims: Vec<Vec<Claim>> = tops.iter().map(all).collect();
    let mut right = Bearing::new(edges);
    let mut left = Bearing::new(edges);
    right.turn(field, sectors.ray(sector, 0));
    for part in 0..sectors.parts() {
        let ways = [part, part + 1].map(|part| sectors.ray(sector, part));
        left.turn(field, ways[1]);
        for (top, claims) in tops.iter().zip(&mut claims) {
            let lines = Bundle::around(*top, ways);
            look(
                field,
                &lines,
                [&mut right, &mut left],
                top,
                &reaches,
                claims,
            );
        }
        std::mem::swap(&mut right, &mut left);
    }
    claims
}

/// Lowers the claims of a top to those of the walls that stand ahead of it, between two directions, within each reach.
fn look(
    field: &Field,
    lines: &Bundle,
    bearings: [&mut Bearing<'_>; 2],
    top: &Top,
    reaches: &[f32],
    claims: &mut [Claim],
) {
    let middle = lines.middle();
    let front = top.iter().map(|at| middle.dot(at.truncate()));
    let front = front.fold(f64::NEG_INFINITY, f64::max);
    let mut highest = |side: usize, from: DVec3, reach: f32| -> Option<Crossing> {
        let way = lines.ways()[side];
        // How far along the line all of the top lies behind.
        let beyond = (front - middle.dot(from.truncate())) / middle.dot(way);
        let half = bearings[side].highest_beyond(way, from, beyond, reach);
        resolve(field, from, way, half)
    };
    let [right, left] = lines.starts().map(|start| top[start]);
    // Of a wide top the outermost lines may pass what hides its middle.
    let centre = top.iter().sum::<DVec3>() / 4.0;
    let lookouts = [(0, right), (1, left), (0, centre), (1, centre)];
    let mut seen: [Option<Crossing>; 4] = [None; 4];
    let mut found = None;
    for (claim, &reach) in claims.iter_mut().zip(reaches) {
        if claim.slope == f64::NEG_INFINITY {
            continue;
        }
        for ((side, from), seen) in lookouts.into_iter().zip(&mut seen) {
            let far = |crossing: Crossing| (crossing.at - from).truncate().length();
            if seen.is_none_or(|seen| far(seen) > f64::from(reach)) {
                *seen = highest(side, from, reach);
                found = None;
            }
        }
        let [first, last, before, after] = seen;
        let same = *found
            .get_or_insert_with(|| lines.claim(field, [first, last], [before, after], claim.slope));
        *claim = claim.and(same);
    }
}

/// The top of a box between two corners in the plan.
pub(crate) fn top_of(low: DVec2, high: DVec2, up: f64) -> Top {
    [
        low.extend(up),
        DVec2::new(high.x, low.y).extend(up),
        high.extend(up),
        DVec2::new(low.x, high.y).extend(up),
    ]
}
