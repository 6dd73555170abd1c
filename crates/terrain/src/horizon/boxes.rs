//! Horizons of boxes: all lines of sight from any point of a box's top, in each sector, tested against walls of terrain beyond the box.
//!
//! What lies lower in a box is hidden where its top is. So the rectangle of the top is all that is tested. Terrain within the box or beside
//! it does not count: walls lie wholly ahead of it. So the result is the same whether the box stands on the ground, in it, or outside of
//! the field.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::bundle::{Bundle, WallPoints};
use super::crossing::{Crossing, resolve};
use super::rotated_edges::{PackedEdges, RotatedEdges};
use super::sectors::Sectors;
use super::value::{Horizon, WideHorizon};
use crate::field::Field;

/// Boxes farther from the origin than this have open horizons, metres: rounding would be as large as slopes are.
const FARTHEST: f64 = 1e6;

/// The four corners of a box's top, counter-clockwise, metres east, north and up of the field's origin.
pub(crate) type Top = [DVec3; 4];

/// Finds the horizons of tops, which hold for all points of a top. The result has a row of `tops.len()` horizons for each reach of each
/// sector. `done` is called once for each finished sector.
///
/// The edges are rotated to each direction once, whatever the number of tops.
pub(crate) fn find_boxes(
    field: &Field,
    sectors: Sectors,
    tops: &[Top],
    done: &(dyn Fn() + Sync),
) -> Vec<Horizon> {
    let mut table = vec![Horizon::OPEN; tops.len() * sectors.rows()];
    if tops.is_empty() {
        return table;
    }
    let edges = PackedEdges::new(field);
    table
        .par_chunks_mut(tops.len() * sectors.reaches() as usize)
        .enumerate()
        .for_each(|(sector, rows)| {
            let found = find_sector(field, &edges, &sectors, sector as u32, tops);
            for (reach, row) in rows.chunks_mut(tops.len()).enumerate() {
                for (stored, horizons) in row.iter_mut().zip(&found) {
                    let horizon = horizons.get(reach);
                    *stored = horizon.map_or(Horizon::OPEN, |horizon| horizon.rounded());
                }
            }
            done();
        });
    table
}

/// The horizons of all tops in one sector, one for each reach.
fn find_sector(
    field: &Field,
    edges: &PackedEdges,
    sectors: &Sectors,
    sector: u32,
    tops: &[Top],
) -> Vec<Vec<WideHorizon>> {
    let reaches = edges.reach_distances(sectors);
    let is_near = |top: &Top| {
        top.iter()
            .all(|at| at.is_finite() && at.abs().max_element() <= FARTHEST)
    };
    let first = |top: &Top| match is_near(top) {
        true => WideHorizon::ALL,
        false => WideHorizon::OPEN,
    };
    let first = |top| vec![first(top); reaches.len()];
    let mut horizons: Vec<Vec<WideHorizon>> = tops.iter().map(first).collect();
    let mut right = RotatedEdges::new(edges);
    let mut left = RotatedEdges::new(edges);
    right.rotate(field, sectors.sub_sector_start(sector, 0));
    for part in 0..sectors.parts() {
        let directions = [part, part + 1].map(|part| sectors.sub_sector_start(sector, part));
        left.rotate(field, directions[1]);
        for (top, horizons) in tops.iter().zip(&mut horizons) {
            let bundle = Bundle::from_rectangle(*top, directions);
            let rotated = [&mut right, &mut left];
            include_sub_sector(field, &bundle, rotated, top, &reaches, horizons);
        }
        std::mem::swap(&mut right, &mut left);
    }
    horizons
}

/// Lowers the horizons of a top, one for each reach, to what walls ahead of it block between two directions as well.
fn include_sub_sector(
    field: &Field,
    bundle: &Bundle,
    rotated: [&mut RotatedEdges<'_>; 2],
    top: &Top,
    reaches: &[f32],
    horizons: &mut [WideHorizon],
) {
    let middle = bundle.middle();
    let front = top.iter().map(|at| middle.dot(at.truncate()));
    let front = front.fold(f64::NEG_INFINITY, f64::max);
    let mut highest = |side: usize, from: DVec3, reach: f32| -> Option<Crossing> {
        let direction = bundle.directions()[side];
        // The distance along the line where all of the top lies behind.
        let beyond = (front - middle.dot(from.truncate())) / middle.dot(direction);
        let half_edge = rotated[side].highest_beyond(from, beyond, reach);
        resolve(field, from, direction, half_edge)
    };
    let [right, left] = bundle.starts().map(|start| top[start]);
    // The outermost lines of a wide top may miss the terrain that hides its middle.
    let centre = top.iter().sum::<DVec3>() / 4.0;
    let lines = [(0, right), (1, left), (0, centre), (1, centre)];
    let mut crossings: [Option<Crossing>; 4] = [None; 4];
    let mut found = None;
    for (horizon, &reach) in horizons.iter_mut().zip(reaches) {
        if horizon.slope == f64::NEG_INFINITY {
            continue;
        }
        for ((side, from), crossing) in lines.into_iter().zip(&mut crossings) {
            let distance = |crossing: Crossing| (crossing.at - from).truncate().length();
            if crossing.is_none_or(|crossing| distance(crossing) > f64::from(reach)) {
                *crossing = highest(side, from, reach);
                found = None;
            }
        }
        let [right, left, centre_right, centre_left] = crossings;
        let points = WallPoints {
            outermost: [right, left],
            other: [centre_right, centre_left],
        };
        let best = *found.get_or_insert_with(|| bundle.best_horizon(field, &points, horizon.slope));
        *horizon = horizon.and(best);
    }
}

/// The top of a box between two corners in the plan, `up` metres up.
pub(crate) fn top_of(low: DVec2, high: DVec2, up: f64) -> Top {
    [
        low.extend(up),
        DVec2::new(high.x, low.y).extend(up),
        high.extend(up),
        DVec2::new(low.x, high.y).extend(up),
    ]
}
