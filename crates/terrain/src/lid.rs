//! A line that lies on the regions of a sector: whoever is above it, or before it begins, is in none of them.
//!
//! Most groups are seen, and a line tells so of most of them: twelve bytes are read in place of 36 for each reach.

use crate::region::Region;

/// Where the regions of one sector begin, and a line that none of them rises above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lid {
    /// Along the sector's middle, metres.
    begin: f32,
    /// How high it is there, and how steeply it goes on.
    up: f32,
    slope: f32,
}

impl Lid {
    /// Over all regions of a sector.
    pub fn over(regions: &[Region]) -> Self {
        let closed = || regions.iter().filter(|region| !region.is_open());
        let begin = closed().map(|region| region.corners()[0][0]);
        let begin = begin.fold(f32::INFINITY, f32::min);
        let slopes = closed().flat_map(|region| region.lines().map(|line| line.slope));
        let slope = (slopes.fold(f64::NEG_INFINITY, f64::max) as f32).next_up();
        // No region rises more steeply than that from where it begins.
        let up = closed().map(|region| {
            let [x, z] = region.corners()[0].map(f64::from);
            z + f64::from(slope) * (f64::from(begin) - x)
        });
        let up = (up.fold(f64::NEG_INFINITY, f64::max) as f32).next_up();
        Self { begin, up, slope }
    }

    /// Over those of each sector, which have so many reaches.
    pub fn each(regions: &[Region], reaches: u32) -> Vec<Self> {
        let sectors = regions.chunks(reaches as usize);
        sectors.map(Self::over).collect()
    }

    /// Whether somebody may be in one of the regions.
    pub fn covers(&self, along: f64, up: f64) -> bool {
        let from = along - f64::from(self.begin);
        from >= 0.0 && up < f64::from(self.up) + f64::from(self.slope) * from
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::horizon::{Horizon, Sectors};

    #[test]
    fn whoever_is_in_a_region_is_below_its_lid() {
        let sectors = Sectors::new(8, 1).unwrap();
        let mut state = 7_u32;
        let mut chance = |most: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (f64::from(state) / f64::from(u32::MAX) * 2.0 - 1.0) * most
        };
        let (mut inside, mut told) = (0, 0);
        for _ in 0..2000 {
            let regions: Vec<Region> = (0..3)
                .map(|_| {
                    let vertices: Vec<(DVec3, Horizon)> = (0..6)
                        .map(|_| {
                            let point = DVec3::new(chance(400.0), chance(400.0), chance(60.0));
                            let horizon = Horizon {
                                slope: chance(0.4) as f32,
                                distance: chance(300.0).abs() as f32,
                            };
                            (point, horizon)
                        })
                        .collect();
                    Region::around(vertices, &sectors, 2)
                })
                .collect();
            let lid = Lid::over(&regions);
            for _ in 0..20 {
                let (along, up) = (chance(2000.0), chance(400.0));
                let hidden = regions.iter().any(|region| region.hides(along, up));
                assert!(!hidden || lid.covers(along, up), "{regions:?} {along} {up}");
                inside += u32::from(hidden);
                told += u32::from(!lid.covers(along, up));
            }
        }
        // Both answers are common.
        assert!(inside > 2000 && told > 10_000, "{inside} {told}");
        let open = Lid::over(&[Region::OPEN]);
        assert!(!open.covers(1e9, -1e9));
    }
}
