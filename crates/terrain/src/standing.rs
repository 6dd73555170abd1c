//! Boxes that stand on a terrain, lie in it or hang over it: from where nobody sees them, found beforehand as it is for the terrain itself.
//!
//! Beyond Edmondson 2004, whose system knows nothing but terrain. A box is a group of one: what hides its top from one sector is a region,
//! held against the place of whoever looks.

use glam::DVec3;

use crate::circle::Circle;
use crate::cull::Eye;
use crate::horizon::Horizon;
use crate::horizon::standing::{find, top_of};
use crate::lid::Lid;
use crate::region::Region;
use crate::terrain::Terrain;

/// From where nobody sees a box.
#[derive(Debug, Clone, PartialEq)]
pub struct Stand {
    circle: Circle,
    /// Its lowest place, metres up.
    low: f64,
    /// One for each reach of each sector.
    regions: Vec<Region>,
    /// One for each sector.
    lids: Vec<Lid>,
}

impl Terrain {
    /// Finds what of the terrain hides some boxes, each from its lowest corner to its highest, metres east, north and up of the field's origin.
    /// Where they are does not matter, nor what of them is below the surface; what is no box, or farther away than a thousand kilometres, nothing hides.
    ///
    /// All directions are turned to once, which takes a second or two for 100,000 vertices, whether there is one box or a few; a thousand boxes take
    /// about ten. `done` is told of every sector finished; sectors run side by side.
    #[must_use]
    pub fn stand(&self, boxes: &[[DVec3; 2]], done: &(dyn Fn() + Sync)) -> Vec<Stand> {
        let sectors = *self.groups().sectors();
        let top = |[low, high]: &[DVec3; 2]| top_of(low.truncate(), high.truncate(), high.z);
        let tops: Vec<_> = boxes.iter().map(top).collect();
        let horizons = find(self.field(), sectors, &tops, done);
        let stand = |(at, top): (usize, &[DVec3; 4])| {
            let rows = horizons.iter().skip(at).step_by(tops.len());
            let region = |(row, horizon): (u32, &Horizon)| {
                let sector = row / sectors.reaches();
                Region::around(top.map(|corner| (corner, *horizon)), &sectors, sector)
            };
            let regions: Vec<Region> = (0..).zip(rows).map(region).collect();
            Stand {
                low: boxes[at][0].z,
                circle: Circle::around(&top.map(DVec3::truncate)),
                lids: Lid::each(&regions, sectors.reaches()),
                regions,
            }
        };
        tops.iter().enumerate().map(stand).collect()
    }
}

impl Eye<'_> {
    /// Whether all of a box is hidden by the terrain that it was prepared for.
    #[must_use]
    pub fn misses(&self, stand: &Stand) -> bool {
        self.is_behind(&stand.circle, stand.low, (&stand.lids, &stand.regions))
    }
}
