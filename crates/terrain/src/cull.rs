//! Which groups somebody may see: from the top of the hierarchy down, a place against a region a sector (Edmondson, sections 5.1 and 5.3).
//! No queries, no answers to wait for.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::field::NONE;
use crate::groups::Groups;
use crate::horizon::Sectors;

/// Directions in the plan, from one counter-clockwise to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// The middle direction.
    middle: DVec2,
    /// The cosine and the sine of half the angle between its ends.
    half: [f64; 2],
}

impl Arc {
    /// All directions.
    pub const ALL: Self = Self {
        middle: DVec2::X,
        half: [-1.0, 0.0],
    };

    /// Directions around a middle one, to `half` radians on either side.
    #[must_use]
    pub fn around(middle: DVec2, half: f64) -> Self {
        let half = half.clamp(0.0, PI);
        Self {
            middle: middle.normalize_or(DVec2::X),
            half: [half.cos(), half.sin()],
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
}

impl<'a> Eye<'a> {
    /// Somebody above the surface at a place, metres east, north and up of the field's origin, who sees what lies in the directions of `sight`.
    #[must_use]
    pub fn new(groups: &'a Groups, at: DVec3, sight: Arc) -> Self {
        let sectors = groups.sectors();
        let each = || 0..sectors.count();
        // What is seen in a direction sees the eye in the opposite one: a sector counts if it has any such.
        let faced = |sector| {
            let width = 2.0 * sectors.half();
            let back = -sight.middle;
            let turn = sectors.central(sector).angle_to(back).abs();
            turn <= sectors.half() + sight.half[1].atan2(sight.half[0]) + 1e-9 * width
        };
        Self {
            groups,
            at,
            along: each()
                .map(|sector| sectors.central(sector).dot(at.truncate()))
                .collect(),
            faced: each().map(faced).collect(),
        }
    }

    /// Whether all of a group is hidden.
    #[must_use]
    pub fn is_hidden(&self, group: u32) -> bool {
        let groups = self.groups;
        let circle = groups.groups()[group as usize].circle;
        let way = self.at.truncate() - circle.middle;
        let far = way.length();
        if far <= circle.radius {
            return false;
        }
        // The directions from the circle to the eye, between the lines along its sides.
        let sine = circle.radius / far;
        let cosine = (1.0 - sine * sine).sqrt();
        let side = |sine: f64| DVec2::new(cosine, sine).rotate(way);
        let regions = groups.regions(group);
        let sectors = groups.sectors();
        let [first, last] = [side(-sine), side(sine)].map(|way| sector(sectors, way));
        let count = regions.len();
        let span = (last + count - first) % count;
        (0..=span).all(|step| {
            let sector = (first + step) % count;
            !self.faced[sector] || regions[sector].hides(self.along[sector], self.at.z)
        })
    }

    /// Calls for every group that may be seen: crystals, and whole groups of groups where nothing of them was hidden would be told one by one.
    pub fn each_seen(&self, mut seen: impl FnMut(u32)) {
        let mut open: Vec<u32> = self.groups.tops().iter().rev().copied().collect();
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

/// The sector of a direction; at an end one of the two, give or take what rounding does.
fn sector(sectors: &Sectors, way: DVec2) -> usize {
    let turn = way.to_angle().rem_euclid(TAU) / TAU;
    ((turn * f64::from(sectors.count())) as usize).min(sectors.count() as usize - 1)
}
