//! Which groups somebody may see: from the top of the hierarchy down, a place against a region a sector (Edmondson, sections 5.1 and 5.3).
//! No queries, no answers to wait for.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::circle::Circle;
use crate::field::NONE;
use crate::groups::{Group, Groups};
use crate::lid::Lid;
use crate::region::Region;
use crate::rim::Rim;

/// Radians that rounding may turn a direction by.
const ROUNDING: f64 = 1e-9;

/// Directions in the plan, from one counter-clockwise to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// The middle direction.
    middle: DVec2,
    /// Half the angle between its ends, radians.
    half: f64,
}

impl Arc {
    /// All directions.
    pub const ALL: Self = Self {
        middle: DVec2::X,
        half: PI,
    };

    /// Directions around a middle one, to `half` radians on either side.
    #[must_use]
    pub fn around(middle: DVec2, half: f64) -> Self {
        Self {
            middle,
            half: half.clamp(0.0, PI),
        }
    }
}

/// Somebody who looks at the groups of a field.
#[derive(Debug, Clone)]
pub struct Eye<'a> {
    groups: &'a Groups,
    at: DVec3,
    /// How far along the middle of each sector they are.
    along: Vec<f64>,
    /// Sectors that lie opposite to where they look.
    faced: Vec<bool>,
    /// Where their lines of sight may leave the surface, and where the field's origin is in its coordinates.
    rim: Option<(&'a Rim, DVec3)>,
}

impl<'a> Eye<'a> {
    /// Somebody above the surface at a place, metres east, north and up of the field's origin, who sees what lies in the directions of `sight`,
    /// and whose lines of sight leave the surface nowhere: see [`Self::past`].
    #[must_use]
    pub fn new(groups: &'a Groups, at: DVec3, sight: Arc) -> Self {
        let middles = groups.compass().middles();
        // What is seen in a direction sees the eye in the opposite one: a sector counts if it has any such.
        let reach = groups.sectors().half() + sight.half + ROUNDING;
        let faced = |middle: &DVec2| reach >= PI || middle.angle_to(-sight.middle).abs() <= reach;
        Self {
            groups,
            at,
            along: middles
                .iter()
                .map(|middle| middle.dot(at.truncate()))
                .collect(),
            faced: middles.iter().map(faced).collect(),
            rim: None,
        }
    }

    /// Somebody who may look in over a border, or across holes: nothing is hidden from them by a line that leaves the surface from below.
    /// The field's origin lies at `from` in the rim's coordinates.
    #[must_use]
    pub fn past(self, rim: &'a Rim, from: DVec3) -> Self {
        Self {
            rim: Some((rim, from)),
            ..self
        }
    }

    /// Whether all of a group is hidden.
    #[must_use]
    pub fn is_hidden(&self, group: u32) -> bool {
        let Group {
            circle, heights, ..
        } = &self.groups.groups()[group as usize];
        self.is_behind(
            circle,
            heights[0],
            (self.groups.lids(group), self.groups.regions(group)),
        )
    }

    /// Whether they are in a region of each of the sectors that the directions to them from places of a circle lie in, and lines from there, no lower than
    /// `low`, pass above the rim.
    pub(crate) fn is_behind(
        &self,
        circle: &Circle,
        low: f64,
        (lids, regions): (&[Lid], &[Region]),
    ) -> bool {
        let way = self.at.truncate() - circle.middle;
        let square = way.length_squared() - circle.radius * circle.radius;
        if !square.is_finite() || square <= 0.0 {
            return false;
        }
        let reaches = self.groups.sectors().reaches() as usize;
        let hides = |sector: usize| {
            let (along, up) = (self.along[sector], self.at.z);
            let inside = || {
                let mut regions = regions[sector * reaches..][..reaches].iter();
                regions.any(|region| region.hides(along, up))
            };
            !self.faced[sector] || (lids[sector].covers(along, up) && inside())
        };
        // Most groups are seen, and most of those are in the middle's sector.
        let compass = self.groups.compass();
        if !hides(compass.sector(way)) {
            return false;
        }
        // The directions from the circle to the eye, between the lines along its sides.
        let [along, aside] = [square.sqrt(), circle.radius];
        let side = |aside: f64| compass.sector(DVec2::new(along, aside).rotate(way));
        let (mut sector, last) = (side(-aside), side(aside));
        let hidden = loop {
            if !hides(sector) {
                break false;
            }
            if sector == last {
                break true;
            }
            sector = if sector + 1 == self.along.len() {
                0
            } else {
                sector + 1
            };
        };
        let passed = |(rim, from): (&Rim, DVec3)| {
            let circle = Circle {
                middle: circle.middle + from.truncate(),
                ..*circle
            };
            rim.is_passed(self.at + from, &circle, low + from.z)
        };
        hidden && self.rim.is_none_or(passed)
    }

    /// Calls for every crystal that may be seen.
    pub fn each_seen(&self, mut seen: impl FnMut(u32)) {
        let mut open: Vec<u32> = self.groups.begin().iter().rev().copied().collect();
        while let Some(group) = open.pop() {
            if self.is_hidden(group) {
                continue;
            }
            let children = self.groups.groups()[group as usize].children;
            if children == [NONE; 2] {
                seen(group);
            } else {
                open.extend([children[1], children[0]]);
            }
        }
    }
}
