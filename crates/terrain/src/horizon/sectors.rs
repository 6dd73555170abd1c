//! Sectors of directions, their sub-sectors, and the reaches of their horizons.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::error::TerrainError;

/// The ratio of each reach to the next nearer one. Of the ratios tried with three to six reaches, this one found most.
const REACH_RATIO: f64 = 2.25;

/// The division of the directions in the plan into equal sectors, and of each sector into equal sub-sectors. Sector 0 begins in the east.
/// Sectors follow each other counter-clockwise, towards the north.
///
/// In each sector a horizon is found for one or several *reaches*: for the first from all terrain, for the others from the terrain within
/// a distance. The highest ridge is often far away, and its horizon says nothing about viewpoints nearer than that ridge. The horizon of a
/// nearer reach does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sectors {
    count: u32,
    parts: u32,
    reaches: u32,
}

impl Default for Sectors {
    fn default() -> Self {
        Self {
            count: 32,
            parts: 4,
            reaches: 1,
        }
    }
}

impl Sectors {
    /// The most reaches.
    pub const MOST_REACHES: u32 = 8;

    /// `count` sectors of `parts` sub-sectors each, with one reach.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] if `count` is not 4 to 1024, or `parts` is not 1 to 1024.
    pub fn new(count: u32, parts: u32) -> Result<Self, TerrainError> {
        if !(4..=1024).contains(&count) {
            return refuse("the number of sectors", count, "give 4 to 1024");
        }
        if !(1..=1024).contains(&parts) {
            return refuse("the number of sub-sectors", parts, "give 1 to 1024");
        }
        Ok(Self {
            count,
            parts,
            reaches: 1,
        })
    }

    /// The same sectors with another number of reaches.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] if `reaches` is not 1 to [`Self::MOST_REACHES`].
    pub fn with_reaches(self, reaches: u32) -> Result<Self, TerrainError> {
        if !(1..=Self::MOST_REACHES).contains(&reaches) {
            return refuse("the number of reaches", reaches, "give 1 to 8");
        }
        Ok(Self { reaches, ..self })
    }

    /// The number of sectors.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// The number of sub-sectors of each sector.
    #[must_use]
    pub fn parts(&self) -> u32 {
        self.parts
    }

    /// The same sectors with the first reach alone.
    pub(crate) fn first_reach(self) -> Self {
        Self { reaches: 1, ..self }
    }

    /// The number of reaches.
    #[must_use]
    pub fn reaches(&self) -> u32 {
        self.reaches
    }

    /// The distance of a reach, metres, in a field whose plan bounds have a diagonal of `diagonal` metres: infinite for the first, 0; four
    /// ninths of the diagonal for the second; four ninths of that for the third; and so on.
    #[must_use]
    pub fn reach_distance(&self, reach: u32, diagonal: f64) -> f64 {
        match reach {
            0 => f64::INFINITY,
            _ => diagonal / REACH_RATIO.powi(reach as i32),
        }
    }

    /// The number of rows of a table with one row for each reach of each sector.
    pub(crate) fn rows(&self) -> usize {
        self.count as usize * self.reaches as usize
    }

    /// Half the angle of a sector, radians.
    #[must_use]
    pub fn half_angle(&self) -> f64 {
        TAU / f64::from(self.count) / 2.0
    }

    /// The unit direction that a sub-sector starts at. The one after the last starts where the next sector does.
    #[must_use]
    pub fn sub_sector_start(&self, sector: u32, part: u32) -> DVec2 {
        let all = self.count * self.parts;
        // A direction that two sectors share is the same for both, to the last bit.
        self.direction(2 * ((sector * self.parts + part) % all))
    }

    /// The unit direction of the middle of a sub-sector.
    #[must_use]
    pub fn sub_sector_middle(&self, sector: u32, part: u32) -> DVec2 {
        self.direction(2 * (sector * self.parts + part) + 1)
    }

    /// The unit direction of the middle of a sector.
    #[must_use]
    pub fn sector_middle(&self, sector: u32) -> DVec2 {
        self.direction((2 * sector + 1) * self.parts)
    }

    /// The unit direction that lies `halves` half sub-sectors from the east.
    fn direction(&self, halves: u32) -> DVec2 {
        let turn = f64::from(halves) / f64::from(2 * self.count * self.parts);
        DVec2::from_angle(turn * TAU)
    }

    /// The sector that a direction lies in, up to the rounding of its angle.
    fn approximate(&self, direction: DVec2) -> u32 {
        let turn = direction.to_angle().rem_euclid(TAU) / TAU;
        (turn * f64::from(self.count)) as u32 % self.count
    }

    /// The sector that a direction of any length lies in. A direction that two sectors share lies in one of them. `None` for zero, NaN and
    /// infinity.
    #[must_use]
    pub fn containing(&self, direction: DVec2) -> Option<u32> {
        if direction == DVec2::ZERO || !direction.is_finite() {
            return None;
        }
        let guess = self.approximate(direction);
        // The angle is rounded. The side of the sector's ends that the direction lies on decides.
        let contains = |sector: &u32| {
            let [first, last] = [0, self.parts].map(|part| self.sub_sector_start(*sector, part));
            first.perp_dot(direction) >= 0.0 && last.perp_dot(direction) <= 0.0
        };
        [guess, guess + 1, guess + self.count - 1]
            .map(|sector| sector % self.count)
            .into_iter()
            .find(contains)
    }
}

fn refuse<T>(what: &'static str, value: u32, problem: &'static str) -> Result<T, TerrainError> {
    Err(TerrainError::Setting {
        what,
        value: value.to_string(),
        problem,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_lies_in_a_sector_and_ends_in_one_beside_them() {
        for (count, parts) in [(4, 1), (8, 3), (16, 16), (64, 1), (1024, 2)] {
            let sectors = Sectors::new(count, parts).unwrap();
            for sector in 0..count {
                assert_eq!(
                    sectors.containing(sectors.sector_middle(sector) * 3e4),
                    Some(sector)
                );
                for part in 0..parts {
                    let middle = sectors.containing(sectors.sub_sector_middle(sector, part));
                    assert_eq!(middle, Some(sector));
                    let start = sectors.sub_sector_start(sector, part) * 1e3;
                    let found = sectors.containing(start).unwrap();
                    let before = (sector + count - 1) % count;
                    assert!(found == sector || (part == 0 && found == before));
                }
                let next = sectors.sub_sector_start((sector + 1) % count, 0);
                assert_eq!(sectors.sub_sector_start(sector, parts), next);
            }
            assert_eq!(sectors.containing(DVec2::ZERO), None);
            assert_eq!(sectors.containing(DVec2::new(f64::NAN, 1.0)), None);
        }
    }

    #[test]
    fn numbers_that_make_no_sectors_are_refused() {
        for (count, parts) in [(0, 1), (3, 1), (1025, 1), (16, 0), (16, 1025)] {
            let error = Sectors::new(count, parts).unwrap_err().to_string();
            assert!(error.contains("1024"), "{error}");
        }
        for reaches in [0, 9, u32::MAX] {
            let error = Sectors::default().with_reaches(reaches).unwrap_err();
            assert!(error.to_string().contains("1 to 8"), "{error}");
        }
    }
}
