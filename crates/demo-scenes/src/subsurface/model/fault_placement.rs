//! Placement of the faults: at random, with a distance between them, inside the volume.

use super::extent::{DEPTH, HALF};
use super::fault::{ModelFault, displace};
use super::layers::Layers;
use crate::random::{Random, Stream};
use glam::DVec2;
use std::f64::consts::TAU;

/// Least and greatest throw in metres.
const THROWS: [f64; 2] = [20.0, 150.0];
/// Number of places that are tried for a fault; the one farthest from the other faults is taken.
const TRIES: usize = 24;
/// Distance between a fault and the border of the volume, in metres.
const MARGIN: f64 = 60.0;
/// Distance between the centre of a fault and another fault, in metres.
const CLEARANCE: f64 = 100.0;

/// Places the faults, oldest and largest first.
pub(super) fn faults(seed: u64, layers: &Layers, horizons: usize, count: usize) -> Vec<ModelFault> {
    let random = &mut Random::new(seed, Stream::Faults);
    let mut faults: Vec<ModelFault> = Vec::with_capacity(count);
    for number in 0..count {
        let [least, greatest] = THROWS;
        let share = (number as f64 + random.between(0.1, 0.9)) / count as f64;
        // Many faults are small, few are large.
        let throw = least + (greatest - least) * (1.0 - share) * (1.0 - share);
        let mut fault = unplaced(random, throw);
        let room = (HALF - MARGIN - half_extent(&fault)).max(DVec2::ZERO);
        let mut best = f64::NEG_INFINITY;
        for _ in 0..TRIES {
            let centre = DVec2::new(
                random.between(-room.x, room.x),
                random.between(-room.y, room.y),
            );
            let horizon = random.pick(horizons);
            let before = displace(&faults, centre, layers.depth(horizon, centre));
            let tried = ModelFault {
                centre,
                horizon,
                depth: before.depth,
                ..fault
            };
            let others = faults.iter().map(|other| other.centre.distance(centre));
            let mut apart = others.fold(DEPTH, f64::min);
            let meets = |other: &ModelFault| {
                other.passes(centre, before.depth, CLEARANCE)
                    || tried.passes(other.centre, other.depth, CLEARANCE)
            };
            // Near the top and the bottom of the volume a fault has little room.
            let to_end = before.depth.min(DEPTH - before.depth);
            if before.in_gap || to_end < DEPTH * 0.25 || faults.iter().any(meets) {
                apart -= DEPTH * 10.0;
            }
            if apart > best {
                best = apart;
                fault = tried;
            }
        }
        let above_and_below = fault.depth.min(DEPTH - fault.depth) - MARGIN;
        let [sine, _] = fault.slope;
        let most = above_and_below.max(MARGIN) / sine;
        fault.half_height = fault.half_height.min(most);
        faults.push(fault);
    }
    faults
}

/// A fault with a throw of `throw` metres at its centre, not placed yet.
fn unplaced(random: &mut Random, throw: f64) -> ModelFault {
    // Most faults strike about north, some north-east.
    let family: f64 = if random.pick(4) == 0 { 52.0 } else { 8.0 };
    let reversed = if random.pick(2) == 0 { 0.0 } else { 180.0 };
    let strike: f64 = (family + reversed + random.between(-9.0, 9.0)).to_radians();
    let dip = random.between(52.0, 68.0).to_radians();
    let half_length = 650.0 + throw * 9.0 + random.between(0.0, 250.0);
    let ripple = TAU / random.between(500.0, 900.0);
    ModelFault {
        centre: DVec2::ZERO,
        depth: 0.0,
        horizon: 0,
        strike,
        dip,
        half_length,
        half_height: half_length * random.between(0.5, 0.62),
        throw,
        reach: 220.0 + 2.6 * throw,
        listric: random.between(0.0, 1.4e-4),
        bow: random.between(-6e-5, 6e-5),
        corrugation: [random.between(4.0, 12.0), ripple, random.angle()],
        axes: [
            DVec2::new(strike.sin(), strike.cos()),
            DVec2::new(strike.cos(), -strike.sin()),
        ],
        slope: [dip.sin(), dip.tan().recip()],
    }
}

/// Upper bound of half the extent of a fault in the plan, east and north, in metres.
fn half_extent(fault: &ModelFault) -> DVec2 {
    let [along, across] = fault.axes;
    let down = fault.half_depth();
    let [_, cotangent] = fault.slope;
    let [ripple, _, _] = fault.corrugation;
    let sideways = down * cotangent
        + fault.listric * down * down
        + fault.bow.abs() * fault.half_length.powi(2)
        + 2.0 * ripple;
    along.abs() * fault.half_length + across.abs() * sideways
}
