//! Faults: fractures along which one side moved down.
//!
//! A fault is a dipping, curved surface that ends at an elliptic tip line. Its throw decreases from the centre to the
//! tip line as in J. J. Walsh and J. Watterson, *Distributions of cumulative displacement and seismic slip on a
//! single normal fault surface*, 1987. Away from the surface the displacement decreases to zero within a few hundred
//! metres. A fault changes depths only, so that horizons stay height fields.

use glam::DVec2;

/// The part of the throw by which the hanging wall (the side above the fault) moves down; the other side moves up by
/// the rest.
const HANGING: f64 = 0.6;
/// Throw in metres below which a horizon bends over the fault instead of breaking.
pub(super) const BREAKING: f64 = 2.0;

/// A normal fault. Places are metres east and north of the model's centre, depths are metres (positive down), angles
/// are radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelFault {
    /// Centre of the surface, east and north.
    pub centre: DVec2,
    /// Depth of the centre.
    pub depth: f64,
    /// The horizon that passes through the centre, where the fault displaces it by `throw`.
    pub horizon: usize,
    /// Strike: the direction along the fault, clockwise from north. The fault dips to the right of it.
    pub strike: f64,
    /// Dip at the centre: the angle from the horizontal.
    pub dip: f64,
    /// Length from the centre to the tip line along the strike, in metres.
    pub half_length: f64,
    /// Length from the centre to the tip line along the dip, in metres.
    pub half_height: f64,
    /// Throw at the centre: the vertical offset of its two sides, in metres.
    pub throw: f64,
    /// Distance from the surface, in metres, at which the displacement is zero.
    pub reach: f64,
    /// Curvature in depth (the fault flattens downwards): metres across per square metre of depth.
    pub(super) listric: f64,
    /// Curvature along the strike: metres across per square metre of length.
    pub(super) bow: f64,
    /// Ripples along the strike: amplitude in metres, radians per metre, phase.
    pub(super) corrugation: [f64; 3],
    /// Unit vectors (east, north) along the strike and in the direction of the dip.
    pub(super) axes: [DVec2; 2],
    /// Sine and cotangent of the dip.
    pub(super) slope: [f64; 2],
}

/// A place in the coordinates of a fault, in metres: along the strike, and across it in the direction of the dip.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaultCoordinates {
    pub(super) along: f64,
    pub(super) across: f64,
}

impl ModelFault {
    /// Half the extent of the surface in depth, in metres.
    pub(super) fn half_depth(&self) -> f64 {
        let [sine, _] = self.slope;
        self.half_height * sine
    }

    pub(super) fn local(&self, place: DVec2) -> FaultCoordinates {
        let from = place - self.centre;
        let [along, across] = self.axes.map(|axis| axis.dot(from));
        FaultCoordinates { along, across }
    }

    /// Offset of the surface across the strike, in metres, at a position along the strike and a depth.
    pub(super) fn across(&self, along: f64, depth: f64) -> f64 {
        let down = depth - self.depth;
        let [_, cotangent] = self.slope;
        let [height, wave, phase] = self.corrugation;
        down * cotangent
            + self.listric * down * down
            + self.bow * along * along
            + height * ((wave * along + phase).sin() - phase.sin())
    }

    /// Throw in metres at a point of the surface; 0 outside the tip line.
    pub(super) fn throw_at(&self, along: f64, depth: f64) -> f64 {
        let height = (depth - self.depth) / self.half_depth();
        let radius = ((along / self.half_length).powi(2) + height * height).sqrt();
        if radius >= 1.0 {
            return 0.0;
        }
        let rest = 1.0 - radius;
        self.throw * rest * (rest * (1.0 + 3.0 * radius)).sqrt()
    }

    /// Whether the surface lies within `within` metres of a point.
    pub(super) fn passes(&self, place: DVec2, depth: f64, within: f64) -> bool {
        let local = self.local(place);
        let [sine, _] = self.slope;
        let distance = (local.across - self.across(local.along, depth)) * sine;
        local.along.abs() < self.half_length
            && (depth - self.depth).abs() < self.half_depth()
            && distance.abs() < within
    }

    /// Whether the fault may displace any point above or below a place.
    pub(super) fn reaches(&self, place: DVec2) -> bool {
        let local = self.local(place);
        let half = self.half_depth();
        let [top, bottom] = [-half, half].map(|down| self.across(local.along, self.depth + down));
        let [sine, _] = self.slope;
        let margin = self.reach / sine;
        local.along.abs() < self.half_length
            && (top.min(bottom) - margin..=top.max(bottom) + margin).contains(&local.across)
    }

    /// The displacement of a point by this fault.
    pub(super) fn displacement(&self, local: FaultCoordinates, depth: f64) -> FaultDisplacement {
        let mut displaced = FaultDisplacement {
            depth,
            throw: 0.0,
            hanging: false,
            in_gap: false,
        };
        if local.along.abs() >= self.half_length + self.reach {
            return displaced;
        }
        let distance = local.across - self.across(local.along, depth);
        displaced.hanging = distance > 0.0;
        displaced.throw = self.throw_at(local.along, depth);
        let [sine, _] = self.slope;
        let far = distance.abs() * sine / self.reach;
        if displaced.throw == 0.0 || far >= 1.0 {
            return displaced;
        }
        let dying = (1.0 - far) * (1.0 - far) * (1.0 + 2.0 * far);
        let share = if displaced.hanging {
            HANGING
        } else {
            HANGING - 1.0
        };
        displaced.depth += share * displaced.throw * dying;
        let after = local.across - self.across(local.along, displaced.depth);
        displaced.in_gap = (after > 0.0) != displaced.hanging;
        displaced
    }
}

/// The displacement of a point by one fault.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaultDisplacement {
    /// Depth of the displaced point.
    pub(super) depth: f64,
    /// The throw of the fault next to the point.
    pub(super) throw: f64,
    /// Whether the point lies in the hanging wall, the side that moved down.
    pub(super) hanging: bool,
    /// Whether the point would cross the fault. Such points lie in the gap between the edges of a broken horizon.
    pub(super) in_gap: bool,
}

/// A point displaced by all faults.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct DisplacedPoint {
    pub(super) depth: f64,
    /// See [`FaultDisplacement::in_gap`].
    pub(super) in_gap: bool,
    /// A bit for each fault that breaks the rock at this point.
    pub(super) broken: u64,
    /// A bit for each fault in whose hanging wall the point lies.
    pub(super) hanging: u64,
}

/// Applies the faults, oldest first: a younger fault displaces the result of the older ones.
pub(super) fn displace(faults: &[ModelFault], place: DVec2, depth: f64) -> DisplacedPoint {
    let mut moved = DisplacedPoint {
        depth,
        ..DisplacedPoint::default()
    };
    for (number, fault) in faults.iter().enumerate() {
        let displaced = fault.displacement(fault.local(place), moved.depth);
        moved.depth = displaced.depth;
        moved.in_gap |= displaced.in_gap;
        let bit = 1u64.checked_shl(number as u32).unwrap_or(0);
        if displaced.throw > BREAKING {
            moved.broken |= bit;
        }
        if displaced.hanging {
            moved.hanging |= bit;
        }
    }
    moved
}

/// Whether a fault passes between the four points of a horizon.
pub(super) fn broken_between(points: &[Option<DisplacedPoint>; 4]) -> bool {
    let known = || points.iter().flatten();
    let broken = known().fold(0, |all, point| all | point.broken);
    let hanging = known().fold(0, |all, point| all | point.hanging);
    let standing = known().fold(0, |all, point| all | !point.hanging);
    broken & hanging & standing != 0
}
