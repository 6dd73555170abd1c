//! Dimensions of the city in metres, and positions of quarters, blocks and streets.

use super::city_builder::at;
use glam::DAffine3;
use std::ops::RangeInclusive;

/// Blocks along an edge of the city.
pub(super) const SIZES: RangeInclusive<u32> = 1..=16;
/// Blocks along an edge of a quarter.
const QUARTER: usize = 4;

/// Half the edge of a lot. Lots are squares, five along an edge of a block.
pub(super) const LOT: f64 = 7.0;
/// Half the edge of a block.
pub(super) const BLOCK: f64 = 5.0 * LOT;
/// Half the width of a roadway, with parking lanes.
pub(super) const ROADWAY: f64 = 6.0;
/// Half the width of a street, with pavements.
pub(super) const STREET: f64 = 11.0;
/// Distance between the centres of neighbouring blocks, and of neighbouring streets.
pub(super) const PITCH: f64 = 2.0 * (BLOCK + STREET);
/// Height of the pavements above the roads, and of the ground floors.
pub(super) const PAVEMENT: f64 = 0.15;
pub(super) const GROUND_FLOOR: f64 = 0.2;
/// Height of a storey, and thickness of a floor.
pub(super) const STOREY: f64 = 3.0;
pub(super) const FLOOR: f64 = 0.25;
/// Distance from the centre of a house to the inner face of its outer walls, and to that of its party walls.
pub(super) const INSIDE: f64 = 6.7;
pub(super) const PARTY: f64 = 6.8;
/// Half the width of a hall, to the centre of its walls, and thickness of walls between rooms.
pub(super) const HALL: f64 = 1.4;
pub(super) const THIN: f64 = 0.12;
/// Centre of a room: distance across from the centre of the house, and distance from the wall between rooms.
pub(super) const ROOM: [f64; 2] = [4.08, 3.38];
/// Half the width and half the depth of a room.
pub(super) const ROOM_HALF: [f64; 2] = [2.62, 3.32];

/// Position of a lot along an edge of its block.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LotPosition {
    Middle,
    Corner,
}

/// The direction of a street.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum StreetDirection {
    AlongX,
    AlongZ,
}

/// A part of a street between two crossings.
pub(super) struct Stretch {
    /// Its number in the city.
    pub number: usize,
    /// Its centre in the quarter.
    pub at: DAffine3,
}

/// The layout of a city.
pub(super) struct Plan {
    pub blocks: usize,
}

/// A square of blocks with the streets on its lower sides.
pub(super) struct Quarter {
    pub number: usize,
    across: [usize; 2],
    along: [usize; 2],
}

/// Position of a block in its quarter.
pub(super) struct BlockPlace {
    /// Its number in the city.
    pub number: usize,
    pub at: DAffine3,
}

/// The part of a street that lies in a quarter.
pub(super) struct StreetPlace {
    pub name: String,
    pub direction: StreetDirection,
    /// The parts between crossings.
    pub stretches: Vec<Stretch>,
    /// Crossings. They belong to the streets along Z; streets along X have none.
    pub crossings: Vec<DAffine3>,
}

impl Plan {
    pub fn new(blocks: usize) -> Self {
        Self { blocks }
    }

    /// Number of blocks, and of stretches of street, in the city.
    pub fn counts(&self) -> [usize; 2] {
        let side = self.blocks;
        [side * side, 2 * side * (side + 1)]
    }

    pub fn quarters(&self) -> Vec<Quarter> {
        let side = self.blocks.div_ceil(QUARTER);
        let from_to = |i: usize| [i * QUARTER, ((i + 1) * QUARTER).min(self.blocks)];
        let quarter = |number: usize| Quarter {
            number: number + 1,
            across: from_to(number % side),
            along: from_to(number / side),
        };
        (0..side * side).map(quarter).collect()
    }

    /// Position of a quarter: the centre between its outermost streets.
    pub fn quarter_place(&self, quarter: &Quarter) -> DAffine3 {
        let [x, z] = self.middle(quarter);
        at(x, 0.0, z)
    }

    pub fn blocks(&self, quarter: &Quarter) -> Vec<BlockPlace> {
        let [x, z] = self.middle(quarter);
        let ([left, right], [far, near]) = (quarter.across, quarter.along);
        let places = (far..near).flat_map(|j| (left..right).map(move |i| (i, j)));
        let block = |(i, j): (usize, usize)| BlockPlace {
            number: j * self.blocks + i,
            at: at(self.line(i, 0.5) - x, 0.0, self.line(j, 0.5) - z),
        };
        places.map(block).collect()
    }

    /// The streets on the lower sides of the blocks of a quarter. The last quarters also have the outermost streets.
    pub fn streets(&self, quarter: &Quarter) -> Vec<StreetPlace> {
        let [x, z] = self.middle(quarter);
        let lines = |[from, to]: [usize; 2]| from..to + usize::from(to == self.blocks);
        let stretches = |[from, to]: [usize; 2]| from..to;
        let mut streets = Vec::new();
        for line in lines(quarter.across) {
            let stretch = |j: usize| {
                let number = line * self.blocks + j;
                let place = at(self.line(line, 0.0) - x, 0.0, self.line(j, 0.5) - z);
                Stretch { number, at: place }
            };
            let crossing = |j: usize| at(self.line(line, 0.0) - x, 0.0, self.line(j, 0.0) - z);
            streets.push(StreetPlace {
                name: format!("street {}", line + 1),
                direction: StreetDirection::AlongZ,
                stretches: stretches(quarter.along).map(stretch).collect(),
                crossings: lines(quarter.along).map(crossing).collect(),
            });
        }
        for line in lines(quarter.along) {
            let stretch = |i: usize| {
                let number = (self.blocks + 1 + line) * self.blocks + i;
                let place = at(self.line(i, 0.5) - x, 0.0, self.line(line, 0.0) - z);
                Stretch { number, at: place }
            };
            streets.push(StreetPlace {
                name: format!("cross street {}", line + 1),
                direction: StreetDirection::AlongX,
                stretches: stretches(quarter.across).map(stretch).collect(),
                crossings: Vec::new(),
            });
        }
        streets
    }

    fn middle(&self, quarter: &Quarter) -> [f64; 2] {
        [quarter.across, quarter.along]
            .map(|[from, to]| 0.5 * (self.line(from, 0.0) + self.line(to, 0.0)))
    }

    /// Coordinate of the street before a block, or of a point `part` of the way to the next street.
    fn line(&self, block: usize, part: f64) -> f64 {
        (block as f64 + part - 0.5 * self.blocks as f64) * PITCH
    }
}
