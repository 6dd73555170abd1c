//! Faults: breaks in the rocks along which one side went down.
//!
//! A fault is a dipping, curved surface that ends at an elliptic tip line. How far its sides moved against each other falls from the
//! centre to the tip line as in J. J. Walsh and J. Watterson, *Distributions of cumulative displacement and seismic slip on a single
//! normal fault surface*, 1987; away from the surface the movement dies out over a few hundred metres. Only depths change, so that
//! horizons stay height fields.

use glam::DVec2;

/// The share of the throw by which the side above the fault goes down; the other side goes up by the rest.
const HANGING: f64 = 0.6;
/// A throw in metres below which a horizon bends over the fault instead of breaking.
pub(super) const BREAKING: f64 = 2.0;

/// A normal fault. Places are metres east and north of the model's middle, depths metres positive down, angles radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelFault {
    /// Middle of the surface, east and north.
    pub centre: DVec2,
    /// Depth of the middle.
    pub depth: f64,
    /// The horizon that passes through the middle: this fault throws it by `throw` there.
    pub horizon: usize,
    /// Where it runs, clockwise from north. It dips to the right of that.
    pub strike: f64,
    /// How steep it is in the middle, from the horizontal.
    pub dip: f64,
    /// From the middle to the tip line along the strike, in metres.
    pub half_length: f64,
    /// From the middle to the tip line along the dip, in metres.
    pub half_height: f64,
    /// By how many metres it moved its sides against each other in the middle.
    pub throw: f64,
    /// Metres from the surface after which the rocks have not moved.
    pub reach: f64,
    /// How it flattens downwards: metres sideways a square metre of depth.
    pub(super) listric: f64,
    /// How it bends along the strike: metres sideways a square metre.
    pub(super) bow: f64,
    /// How it ripples along the strike: height in metres, radians a metre, phase.
    pub(super) corrugation: [f64; 3],
    /// Unit vectors east and north: along the strike, and to where it dips.
    pub(super) axes: [DVec2; 2],
    /// Sine and cotangent of the dip.
    pub(super) slope: [f64; 2],
}

/// Where a place lies as the fault sees it: metres along the strike, and across it towards the dip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    pub(super) along: f64,
    pub(super) across: f64,
}

impl ModelFault {
    /// Half the extent of the surface in depth, in metres.
    pub(super) fn half_depth(&self) -> f64 {
        let [sine, _] = self.slope;
        self.half_height * sine
    }

    pub(super) fn local(&self, place: DVec2) -> Local {
        let from = place - self.centre;
        let [along, across] = self.axes.map(|axis| axis.dot(from));
        Local { along, across }
    }

    /// How far across the strike the surface lies, in metres, at this place along it and this depth.
    pub(super) fn across(&self, along: f64, depth: f64) -> f64 {
        let down = depth - self.depth;
        let [_, cotangent] = self.slope;
        let [height, wave, phase] = self.corrugation;
        down * cotangent
            + self.listric * down * down
            + self.bow * along * along
            + height * ((wave * along + phase).sin() - phase.sin())
    }

    /// By how many metres the sides have moved against each other here on the surface; 0 from the tip line on.
    pub(super) fn throw_at(&self, along: f64, depth: f64) -> f64 {
        let height = (depth - self.depth) / self.half_depth();
        let radius = ((along / self.half_length).powi(2) + height * height).sqrt();
        if radius >= 1.0 {
            return 0.0;
        }
        let rest = 1.0 - radius;
        self.throw * rest * (rest * (1.0 + 3.0 * radius)).sqrt()
    }

    /// Whether the surface passes a point within so many metres.
    pub(super) fn passes(&self, place: DVec2, depth: f64, within: f64) -> bool {
        let local = self.local(place);
        let [sine, _] = self.slope;
        let distance = (local.across - self.across(local.along, depth)) * sine;
        local.along.abs() < self.half_length
            && (depth - self.depth).abs() < self.half_depth()
            && distance.abs() < within
    }

    /// Whether this fault may move anything above or below a place.
    pub(super) fn reaches(&self, place: DVec2) -> bool {
        let local = self.local(place);
        let half = self.half_depth();
        let [top, bottom] = [-half, half].map(|down| self.across(local.along, self.depth + down));
        let [sine, _] = self.slope;
        let margin = self.reach / sine;
        local.along.abs() < self.half_length
            && (top.min(bottom) - margin..=top.max(bottom) + margin).contains(&local.across)
    }

    /// What this fault does to a point.
    pub(super) fn act(&self, local: Local, depth: f64) -> Action {
        let mut action = Action {
            depth,
            throw: 0.0,
            hanging: false,
            cut: false,
        };
        if local.along.abs() >= self.half_length + self.reach {
            return action;
        }
        let distance = local.across - self.across(local.along, depth);
        action.hanging = distance > 0.0;
        action.throw = self.throw_at(local.along, depth);
        let [sine, _] = self.slope;
        let far = distance.abs() * sine / self.reach;
        if action.throw == 0.0 || far >= 1.0 {
            return action;
        }
        let dying = (1.0 - far) * (1.0 - far) * (1.0 + 2.0 * far);
        let share = if action.hanging {
            HANGING
        } else {
            HANGING - 1.0
        };
        action.depth += share * action.throw * dying;
        let after = local.across - self.across(local.along, action.depth);
        action.cut = (after > 0.0) != action.hanging;
        action
    }
}

/// What a fault did to a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Action {
    /// Where the point is now.
    pub(super) depth: f64,
    /// The throw of the fault next to the point.
    pub(super) throw: f64,
    /// Whether the point lies on the side that went down.
    pub(super) hanging: bool,
    /// Whether the point would have to pass through the fault: between the edges of a broken horizon there is none of it.
    pub(super) cut: bool,
}

/// A point after all faults acted on it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Moved {
    pub(super) depth: f64,
    /// See [`Action::cut`].
    pub(super) cut: bool,
    /// A bit for each fault that breaks what is here.
    pub(super) broken: u64,
    /// A bit for each fault on whose sunken side this is.
    pub(super) hanging: u64,
}

/// Lets the faults act, oldest first: a younger one displaces what older ones left.
pub(super) fn displace(faults: &[ModelFault], place: DVec2, depth: f64) -> Moved {
    let mut moved = Moved {
        depth,
        ..Moved::default()
    };
    for (number, fault) in faults.iter().enumerate() {
        let action = fault.act(fault.local(place), moved.depth);
        moved.depth = action.depth;
        moved.cut |= action.cut;
        let bit = 1u64.checked_shl(number as u32).unwrap_or(0);
        if action.throw > BREAKING {
            moved.broken |= bit;
        }
        if action.hanging {
            moved.hanging |= bit;
        }
    }
    moved
}

/// Whether a fault passes between points of a horizon.
pub(super) fn broken_between(points: &[Option<Moved>; 4]) -> bool {
    let known = || points.iter().flatten();
    let broken = known().fold(0, |all, point| all | point.broken);
    let hanging = known().fold(0, |all, point| all | point.hanging);
    let standing = known().fold(0, |all, point| all | !point.hanging);
    broken & hanging & standing != 0
}
