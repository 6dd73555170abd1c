//! The sector of a direction without an angle: a table over the square |x| + |y| = 1, whose border a division finds the place on, and a
//! side of the one ray that may cross that part of the border.

use glam::DVec2;

use super::sectors::Sectors;

/// Parts of the square's border a sector. They must be shorter than the shortest that a sector cuts out of it, which has 0.78 of the mean length.
const FINE: u32 = 2;

/// The sectors by direction, with what a frame asks of each.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Compass {
    /// The sector that each part of the border begins in, from the east on.
    parts: Vec<u16>,
    /// Where each sector ends.
    ends: Vec<DVec2>,
    /// The middle of each.
    middles: Vec<DVec2>,
}

impl Compass {
    pub fn new(sectors: &Sectors) -> Self {
        let count = sectors.count();
        let begin = |part: u32| {
            let at = f64::from(part) / f64::from(count * FINE) * 4.0;
            let [quarter, along] = [at.floor(), at.fract()];
            let mut way = DVec2::new(1.0 - along, along);
            for _ in 0..quarter as u32 {
                way = way.perp();
            }
            sectors.containing(way).unwrap_or_default() as u16
        };
        Self {
            parts: (0..count * FINE).map(begin).collect(),
            ends: (0..count)
                .map(|sector| sectors.ray(sector, sectors.parts()))
                .collect(),
            middles: (0..count).map(|sector| sectors.central(sector)).collect(),
        }
    }

    /// The middles of all sectors.
    pub fn middles(&self) -> &[DVec2] {
        &self.middles
    }

    /// The sector that a direction of any length lies in; at an end one of the two, give or take what rounding does to a place on the square.
    pub fn sector(&self, way: DVec2) -> usize {
        let east = way.x / (way.x.abs() + way.y.abs());
        let at = if way.y < 0.0 { 3.0 + east } else { 1.0 - east };
        let part = (at * (self.parts.len() as f64 / 4.0)) as usize;
        let part = part.min(self.parts.len() - 1);
        let sector = usize::from(self.parts[part]);
        let beyond = self.ends[sector].perp_dot(way) > 0.0;
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
            let compass = Compass::new(&sectors);
            let steps = 40_000;
            for step in 0..steps {
                let angle = (f64::from(step) + 0.3137) / f64::from(steps) * TAU;
                for far in [1e-6, 1.0, 3e7] {
                    let way = DVec2::from_angle(angle) * far;
                    let found = compass.sector(way) as u32;
                    assert_eq!(Some(found), sectors.containing(way), "{count}: {angle}");
                }
            }
            for sector in 0..count {
                let found = compass.sector(sectors.ray(sector, 0)) as u32;
                assert!(found == sector || found == (sector + count - 1) % count);
            }
        }
    }
}
