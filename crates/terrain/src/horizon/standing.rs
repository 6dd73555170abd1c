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

/// Finds the horizon of all places of each top in each sector, a row of tops a sector; `done` is told of every sector finished. Each direction is
/// turned to once, whatever the number of tops.
pub(crate) fn find(
    field: &Field,
    sectors: Sectors,
    tops: &[Top],
    done: &(dyn Fn() + Sync),
) -> Vec<Horizon> {
    let mut table = vec![Horizon::OPEN; tops.len() * sectors.count() as usize];
    if tops.is_empty() {
        return table;
    }
    let edges = Edges::new(field);
    table
        .par_chunks_mut(tops.len())
        .enumerate()
        .for_each(|(sector, row)| {
            let found = sector_of(field, &edges, &sectors, sector as u32, tops);
            for (horizon, claim) in row.iter_mut().zip(found) {
                *horizon = rounded(claim);
            }
            done();
        });
    table
}

/// The claims of all tops in one sector.
fn sector_of(
    field: &Field,
    edges: &Edges,
    sectors: &Sectors,
    sector: u32,
    tops: &[Top],
) -> Vec<Claim> {
    let near = |top: &Top| {
        top.iter()
            .all(|at| at.is_finite() && at.abs().max_element() <= FARTHEST)
    };
    let all = |top: &Top| match near(top) {
        true => Claim::ALL,
        false => Claim::OPEN,
    };
    let mut claims: Vec<Claim> = tops.iter().map(all).collect();
    let mut right = Bearing::new(edges);
    let mut left = Bearing::new(edges);
    right.turn(field, sectors.ray(sector, 0));
    for part in 0..sectors.parts() {
        let ways = [part, part + 1].map(|part| sectors.ray(sector, part));
        left.turn(field, ways[1]);
        for (top, claim) in tops.iter().zip(&mut claims) {
            if claim.slope > f64::NEG_INFINITY {
                let lines = Bundle::around(*top, ways);
                let found = look(field, &lines, [&mut right, &mut left], top, claim.slope);
                *claim = claim.and(found);
            }
        }
        std::mem::swap(&mut right, &mut left);
    }
    claims
}

/// The claim of the walls that stand ahead of a top, between two directions.
fn look(
    field: &Field,
    lines: &Bundle,
    bearings: [&mut Bearing<'_>; 2],
    top: &Top,
    enough: f64,
) -> Claim {
    let middle = lines.middle();
    let front = top.iter().map(|at| middle.dot(at.truncate()));
    let front = front.fold(f64::NEG_INFINITY, f64::max);
    let mut highest = |side: usize, from: DVec3| -> Option<Crossing> {
        let way = lines.ways()[side];
        // How far along the line all of the top lies behind.
        let beyond = (front - middle.dot(from.truncate())) / middle.dot(way);
        let half = bearings[side].highest_beyond(way, from, beyond);
        resolve(field, from, way, half)
    };
    let starts = lines.starts();
    let at = [0, 1].map(|side| highest(side, top[starts[side]]));
    // Of a wide top the outermost lines may pass what hides its middle.
    let centre = top.iter().sum::<DVec3>() / 4.0;
    let ahead = [0, 1].map(|side| highest(side, centre));
    lines.claim(field, at, ahead, enough)
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
