//! The groups that are visible from an observer: a traversal of the hierarchy from the top down that tests one position against one region
//! in each sector (Edmondson, sections 5.1 and 5.3). It needs no GPU queries, and so waits for no results.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::azimuth::AzimuthRange;
use crate::boundary_tree::BoundaryTree;
use crate::circle::Circle;
use crate::groups::GroupHierarchy;
use crate::region::Region;
use crate::sector_bound::SectorBound;

/// Rounding errors of directions, radians.
const ROUNDING: f64 = 1e-9;

/// An observer and the groups of a field that are tested from it.
#[derive(Debug, Clone)]
pub struct Observer<'a> {
    groups: &'a GroupHierarchy,
    at: DVec3,
    /// Its coordinate along the middle of each sector, metres.
    along: Vec<f64>,
    /// The sectors that matter: those whose opposite directions are in view.
    in_view: Vec<bool>,
    boundary: Option<Boundary<'a>>,
}

/// Where lines of sight may leave the surface.
#[derive(Debug, Clone, Copy)]
struct Boundary<'a> {
    tree: &'a BoundaryTree,
    /// The field's origin in the tree's coordinates.
    offset: DVec3,
}

/// What is tested from an observer: a group or a box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Occludee<'a> {
    /// A circle around it in the plan.
    pub circle: &'a Circle,
    /// Its lowest height, metres.
    pub lowest: f64,
    /// A bound of its regions for each sector.
    pub bounds: &'a [SectorBound],
    /// Its regions, for each sector one for each reach.
    pub regions: &'a [Region],
}

impl<'a> Observer<'a> {
    /// An observer above the surface at a position, metres east, north and up of the field's origin, that sees in the directions `azimuths`.
    /// Its lines of sight must not leave the surface: otherwise see [`Self::with_boundary`].
    #[must_use]
    pub fn new(groups: &'a GroupHierarchy, at: DVec3, azimuths: AzimuthRange) -> Self {
        let middles = groups.sector_lookup().middles();
        // What is seen in a direction sees the observer in the opposite one. A sector counts if any of its directions is such.
        let reach = groups.sectors().half_angle() + azimuths.half_angle + ROUNDING;
        let in_view =
            |middle: &DVec2| reach >= PI || middle.angle_to(-azimuths.middle).abs() <= reach;
        Self {
            groups,
            at,
            along: middles
                .iter()
                .map(|middle| middle.dot(at.truncate()))
                .collect(),
            in_view: middles.iter().map(in_view).collect(),
            boundary: None,
        }
    }

    /// The same observer with lines of sight that may cross a boundary or holes. A group is hidden from it only if no line leaves the
    /// surface from below. `offset` is the field's origin in the coordinates of the tree.
    #[must_use]
    pub fn with_boundary(self, tree: &'a BoundaryTree, offset: DVec3) -> Self {
        Self {
            boundary: Some(Boundary { tree, offset }),
            ..self
        }
    }

    /// Whether all of a group is hidden.
    #[must_use]
    pub fn is_hidden(&self, group: u32) -> bool {
        let found = &self.groups.groups()[group as usize];
        self.is_occluded(&Occludee {
            circle: &found.circle,
            lowest: found.heights[0],
            bounds: self.groups.bounds(group),
            regions: self.groups.regions(group),
        })
    }

    /// Whether an occludee is hidden: for each sector that a direction from its circle to the observer lies in, the observer is in a
    /// region, and all lines from the circle, no lower than the occludee, pass above the boundary.
    pub(crate) fn is_occluded(&self, occludee: &Occludee<'_>) -> bool {
        let Occludee {
            circle,
            lowest,
            bounds,
            regions,
        } = *occludee;
        let direction = self.at.truncate() - circle.middle;
        let square = direction.length_squared() - circle.radius * circle.radius;
        if !square.is_finite() || square <= 0.0 {
            return false;
        }
        let reaches = self.groups.sectors().reaches() as usize;
        let hides = |sector: usize| {
            let (along, up) = (self.along[sector], self.at.z);
            let inside = || {
                let mut regions = regions[sector * reaches..][..reaches].iter();
                regions.any(|region| region.contains(along, up))
            };
            !self.in_view[sector] || (bounds[sector].contains(along, up) && inside())
        };
        // Most groups are visible, and most of those are in the sector of the circle's middle.
        let lookup = self.groups.sector_lookup();
        if !hides(lookup.sector(direction)) {
            return false;
        }
        // The directions from the circle to the observer, between its two tangents.
        let [along, aside] = [square.sqrt(), circle.radius];
        let tangent = |aside: f64| lookup.sector(DVec2::new(along, aside).rotate(direction));
        let (mut sector, last) = (tangent(-aside), tangent(aside));
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
        let passes = |Boundary { tree, offset }: Boundary<'_>| {
            let circle = Circle {
                middle: circle.middle + offset.truncate(),
                ..*circle
            };
            tree.is_below_lines(self.at + offset, &circle, lowest + offset.z)
        };
        hidden && self.boundary.is_none_or(passes)
    }

    /// Calls `visible` for every leaf of the hierarchy that may be visible.
    pub fn each_visible(&self, mut visible: impl FnMut(u32)) {
        let mut open: Vec<u32> = self.groups.start().iter().rev().copied().collect();
        while let Some(group) = open.pop() {
            if self.is_hidden(group) {
                continue;
            }
            let found = &self.groups.groups()[group as usize];
            if found.is_leaf() {
                visible(group);
            } else {
                open.extend([found.children[1], found.children[0]]);
            }
        }
    }
}
