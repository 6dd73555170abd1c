//! Occlusion regions of boxes that stand on a terrain, lie in it or hang over it, found in advance as for the terrain itself.
//!
//! This goes beyond Edmondson 2004, which covers terrain alone. A box is tested like a group: the top of the box is hidden from a region in
//! each sector.

use glam::DVec3;

use crate::circle::Circle;
use crate::horizon::Horizon;
use crate::horizon::boxes::{Top, find_boxes, top_of};
use crate::observer::{Observer, Occludee};
use crate::region::{Region, VertexHorizon};
use crate::sector_bound::SectorBound;
use crate::terrain::Terrain;

/// The regions that a box is hidden from by one terrain.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxRegions {
    /// A circle around the box in the plan, metres from the field's origin.
    circle: Circle,
    /// Its lowest height, metres up.
    lowest: f64,
    /// For each sector, one for each reach.
    regions: Vec<Region>,
    /// One for each sector.
    bounds: Vec<SectorBound>,
}

impl Terrain {
    /// Finds the regions that each of some boxes is hidden from by the terrain. A box is given as its lowest and its highest corner, metres
    /// east, north and up of the field's origin. `done` is called once for each finished sector; sectors run in parallel.
    ///
    /// A box may be anywhere, also outside of the field or partly below the surface. A box with a NaN or infinite corner, or farther away
    /// than a thousand kilometres, is hidden from nowhere.
    ///
    /// The terrain is searched in each direction once, which takes a second or two for 100,000 vertices, whether for one box or a few. A
    /// thousand boxes take about ten seconds.
    #[must_use]
    pub fn box_regions(&self, boxes: &[[DVec3; 2]], done: &(dyn Fn() + Sync)) -> Vec<BoxRegions> {
        let sectors = *self.groups().sectors();
        let top = |[low, high]: &[DVec3; 2]| top_of(low.truncate(), high.truncate(), high.z);
        let tops: Vec<Top> = boxes.iter().map(top).collect();
        let horizons = find_boxes(self.field(), sectors, &tops, done);
        let regions_of = |(at, top): (usize, &Top)| {
            let rows = horizons.iter().skip(at).step_by(tops.len());
            let region = |(row, horizon): (u32, &Horizon)| {
                let sector = row / sectors.reaches();
                let corners = top.map(|point| VertexHorizon {
                    point,
                    horizon: *horizon,
                });
                Region::of_vertices(corners, &sectors, sector)
            };
            let regions: Vec<Region> = (0..).zip(rows).map(region).collect();
            BoxRegions {
                lowest: boxes[at][0].z,
                circle: Circle::enclosing(&top.map(DVec3::truncate)),
                bounds: SectorBound::each(&regions, sectors.reaches()),
                regions,
            }
        };
        tops.iter().enumerate().map(regions_of).collect()
    }
}

impl Observer<'_> {
    /// Whether all of a box is hidden by the terrain that its regions were found for.
    #[must_use]
    pub fn is_box_hidden(&self, regions: &BoxRegions) -> bool {
        self.is_occluded(&Occludee {
            circle: &regions.circle,
            lowest: regions.lowest,
            bounds: &regions.bounds,
            regions: &regions.regions,
        })
    }
}
