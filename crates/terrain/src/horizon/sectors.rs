//! Sectors of directions, the sub-sectors that they are found by, and the reaches within which they are looked for.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::error::TerrainError;

/// How many times nearer each reach is than the one before it: what found most with three to six of them.
const NEARER: f64 = 2.25;

/// Directions in the plan divided into equal sectors, each of equal sub-sectors. Sector 0 begins in the east; they follow each other
/// counter-clockwise, towards the north.
///
/// In each sector a horizon is found for one or several *reaches*: for the first out of all there is, for the others out of what lies nearer.
/// The highest ridge is often a far one, and says nothing of whoever is nearer than that; the highest of the near ones does.
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

    /// So many sectors of so many sub-sectors each, with one reach.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for fewer than 4 sectors or more than 1024, no sub-sector or more than 1024 of them.
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

    /// The same with so many reaches.
    ///
    /// # Errors
    /// [`TerrainError::Setting`] for none, or more than [`Self::MOST_REACHES`].
    pub fn with_reaches(self, reaches: u32) -> Result<Self, TerrainError> {
        if !(1..=Self::MOST_REACHES).contains(&reaches) {
            return refuse("the number of reaches", reaches, "give 1 to 8");
        }
        Ok(Self { reaches, ..self })
    }

    /// How many sectors there are.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// How many sub-sectors a sector has.
    #[must_use]
    pub fn parts(&self) -> u32 {
        self.parts
    }

    /// The same with the first reach alone.
    pub(crate) fn far(self) -> Self {
        Self { reaches: 1, ..self }
    }

    /// How many reaches there are.
    #[must_use]
    pub fn reaches(&self) -> u32 {
        self.reaches
    }

    /// How far a reach goes, metres, in a field that is `across` metres from corner to corner: the first, 0, goes everywhere, the next as far as
    /// four ninths of that, and so on.
    #[must_use]
    pub fn reach(&self, reach: u32, across: f64) -> f64 {
        match reach {
            0 => f64::INFINITY,
            _ => across / NEARER.powi(reach as i32),
        }
    }

    /// How many rows a table has that has one for each reach of each sector.
    pub(crate) fn rows(&self) -> usize {
        self.count as usize * self.reaches as usize
    }

    /// Half a sector, radians.
    #[must_use]
    pub fn half(&self) -> f64 {
        TAU / f64::from(self.count) / 2.0
    }

    /// Where a sub-sector of a sector begins; one beyond the last is where the next sector does.
    #[must_use]
    pub fn ray(&self, sector: u32, part: u32) -> DVec2 {
        let all = self.count * self.parts;
        // The same end has the same direction, to the last bit, whichever sector it is asked for.
        self.way(2 * ((sector * self.parts + part) % all))
    }

    /// The middle of a sub-sector.
    #[must_use]
    pub fn middle(&self, sector: u32, part: u32) -> DVec2 {
        self.way(2 * (sector * self.parts + part) + 1)
    }

    /// The middle of a sector.
    #[must_use]
    pub fn central(&self, sector: u32) -> DVec2 {
        self.way((2 * sector + 1) * self.parts)
    }

    /// The direction of so many half sub-sectors.
    fn way(&self, halves: u32) -> DVec2 {
        let turn = f64::from(halves) / f64::from(2 * self.count * self.parts);
        DVec2::from_angle(turn * TAU)
    }

    /// The sector that a direction lies in; at an end one of the two, give or take what rounding does to an angle.
    fn about(&self, way: DVec2) -> u32 {
        let turn = way.to_angle().rem_euclid(TAU) / TAU;
        (turn * f64::from(self.count)) as u32 % self.count
    }

    /// The sector that a direction lies in, its ends included; `None` for no direction.
    #[must_use]
    pub fn containing(&self, way: DVec2) -> Option<u32> {
        if way == DVec2::ZERO || !way.is_finite() {
            return None;
        }
        let guess = self.about(way);
        // The angle is rounded; what counts is on which side of a sector's ends a direction lies.
        let holds = |sector: &u32| {
            let [first, last] = [0, self.parts].map(|part| self.ray(*sector, part));
            first.perp_dot(way) >= 0.0 && last.perp_dot(way) <= 0.0
        };
        [guess, guess + 1, guess + self.count - 1]
            .map(|sector| sector % self.count)
            .into_iter()
            .find(holds)
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
                    sectors.containing(sectors.central(sector) * 3e4),
                    Some(sector)
                );
                for part in 0..parts {
                    let middle = sectors.containing(sectors.middle(sector, part));
                    assert_eq!(middle, Some(sector));
                    let end = sectors.containing(sectors.ray(sector, part) * 1e3).unwrap();
                    let before = (sector + count - 1) % count;
                    assert!(end == sector || (part == 0 && end == before));
                }
                let next = sectors.ray((sector + 1) % count, 0);
                assert_eq!(sectors.ray(sector, parts), next);
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
