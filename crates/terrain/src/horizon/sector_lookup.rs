//! The sector of a direction without computing an angle: a table over the border of the square |x| + |y| = 1. A division finds the part of
//! the border that a direction crosses, and one side test decides between the two sectors that may begin in that part.

use glam::DVec2;

use super::sectors::Sectors;

/// Parts of the square's border for each sector. A part must be shorter than the shortest piece of the border that a sector cuts out,
/// which is 0.78 of the mean.
const PARTS: u32 = 2;

/// A lookup table from directions to sectors, with the sectors' directions that every frame needs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SectorLookup {
    /// The sector that each part of the border begins in, counter-clockwise from the east.
    parts: Vec<u16>,
    /// The end of each sector.
    ends: Vec<DVec2>,
    /// The middle of each sector.
    middles: Vec<DVec2>,
}

impl SectorLookup {
    pub fn new(sectors: &Sectors) -> Self {
        let count = sectors.count();
        let begin = |part: u32| {
            let at = f64::from(part) / f64::from(count * PARTS) * 4.0;
            let [quarter, along] = [at.floor(), at.fract()];
            let mut direction = DVec2::new(1.0 - along, along);
            for _ in 0..quarter as u32 {
                direction = direction.perp();
            }
            sectors.containing(direction).unwrap_or_default() as u16
        };
        Self {
            parts: (0..count * PARTS).map(begin).collect(),
            ends: (0..count)
                .map(|sector| sectors.sub_sector_start(sector, sectors.parts()))
                .collect(),
            middles: (0..count)
                .map(|sector| sectors.sector_middle(sector))
                .collect(),
        }
    }

    /// The unit directions of the middles of all sectors.
    pub fn middles(&self) -> &[DVec2] {
        &self.middles
    }

    /// The sector that a direction of any length lies in. For a direction that two sectors share it is one of them, up to rounding.
    pub fn sector(&self, direction: DVec2) -> usize {
        let east = direction.x / (direction.x.abs() + direction.y.abs());
        let at = if direction.y < 0.0 {
            3.0 + east
        } else {
            1.0 - east
        };
        let part = (at * (self.parts.len() as f64 / 4.0)) as usize;
        let part = part.min(self.parts.len() - 1);
        let sector = usize::from(self.parts[part]);
        let beyond = self.ends[sector].perp_dot(direction) > 0.0;
        let next = sector + usize::from(beyond);
        if next == self.ends.len() { 0 } else { next }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn every_direction_is_told_its_sector() {
        for (count, parts) in [(4, 1), (5, 3), (7, 1), (16, 4), (64, 1), (1024, 2)] {
            let sectors = Sectors::new(count, parts).unwrap();
            let lookup = SectorLookup::new(&sectors);
            let steps = 40_000;
            for step in 0..steps {
                let angle = (f64::from(step) + 0.3137) / f64::from(steps) * TAU;
                for length in [1e-6, 1.0, 3e7] {
                    let direction = DVec2::from_angle(angle) * length;
                    let found = lookup.sector(direction) as u32;
                    assert_eq!(
                        Some(found),
                        sectors.containing(direction),
                        "{count}: {angle}"
                    );
                }
            }
            for sector in 0..count {
                let found = lookup.sector(sectors.sub_sector_start(sector, 0)) as u32;
                assert!(found == sector || found == (sector + count - 1) % count);
            }
        }
    }
}
