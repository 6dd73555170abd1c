//! The city's measures in metres, and where quarters, blocks and streets lie.

use super::kit::at;
use glam::DAffine3;
use std::ops::RangeInclusive;

/// Blocks along an edge.
pub(super) const SIZES: RangeInclusive<u32> = 1..=16;
/// Blocks along a quarter's edge.
const QUARTER: usize = 4;

/// Half a lot's width and depth: lots are squares, five along a block's edge.
pub(super) const LOT: f64 = 7.0;
/// Half a block's width.
pub(super) const BLOCK: f64 = 5.0 * LOT;
/// Half a roadway's width, parked vehicles included.
pub(super) const ROADWAY: f64 = 6.0;
/// Half a street's width, pavements included.
pub(super) const STREET: f64 = 11.0;
/// From the middle of a block, and of a street, to that of the next.
pub(super) const PITCH: f64 = 2.0 * (BLOCK + STREET);
/// How high the pavements lie above the roads, and the houses' ground floors.
pub(super) const PAVEMENT: f64 = 0.15;
pub(super) const GROUND_FLOOR: f64 = 0.2;
/// From floor to floor, and how thick a floor is.
pub(super) const STOREY: f64 = 3.0;
pub(super) const FLOOR: f64 = 0.25;
/// From a house's middle to the inner face of its outer walls, and to that of the walls to its neighbours.
pub(super) const INSIDE: f64 = 6.7;
pub(super) const PARTY: f64 = 6.8;
/// Half a hall's width, to the middle of its walls, and how thick walls between rooms are.
pub(super) const HALL: f64 = 1.4;
pub(super) const THIN: f64 = 0.12;
/// Where rooms have their middles, across from the hall and away from the wall between them.
pub(super) const ROOM: [f64; 2] = [4.08, 3.38];
/// Half a room's width and depth.
pub(super) const ROOM_HALF: [f64; 2] = [2.62, 3.32];

/// How many blocks there are along an edge.
pub(super) struct Plan {
    pub blocks: usize,
}

/// A square of blocks and the streets on its lower sides.
pub(super) struct Quarter {
    pub number: usize,
    across: [usize; 2],
    along: [usize; 2],
}

/// A block within its quarter.
pub(super) struct BlockPlace {
    /// Counted through the city.
    pub number: usize,
    pub at: DAffine3,
}

/// What of a street lies in a quarter.
pub(super) struct StreetPlace {
    pub name: String,
    /// Along Z, or along X.
    pub along_z: bool,
    /// Stretches between crossings: the number of each, counted through the city, and its middle in the quarter.
    pub stretches: Vec<(usize, DAffine3)>,
    /// Crossings: where streets along Z have theirs, those along X have none.
    pub crossings: Vec<DAffine3>,
}

impl Plan {
    pub fn new(blocks: usize) -> Self {
        Self { blocks }
    }

    /// How many blocks, and how many stretches of street, there are.
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

    /// Where a quarter's node stands: on the middle between its outermost streets.
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

    /// The streets on the lower sides of a quarter's blocks; the last quarters have the outermost ones as well.
    pub fn streets(&self, quarter: &Quarter) -> Vec<StreetPlace> {
        let [x, z] = self.middle(quarter);
        let lines = |[from, to]: [usize; 2]| from..to + usize::from(to == self.blocks);
        let stretches = |[from, to]: [usize; 2]| from..to;
        let mut streets = Vec::new();
        for line in lines(quarter.across) {
            let stretch = |j: usize| {
                let number = line * self.blocks + j;
                let place = at(self.line(line, 0.0) - x, 0.0, self.line(j, 0.5) - z);
                (number, place)
            };
            let crossing = |j: usize| at(self.line(line, 0.0) - x, 0.0, self.line(j, 0.0) - z);
            streets.push(StreetPlace {
                name: format!("street {}", line + 1),
                along_z: true,
                stretches: stretches(quarter.along).map(stretch).collect(),
                crossings: lines(quarter.along).map(crossing).collect(),
            });
        }
        for line in lines(quarter.along) {
            let stretch = |i: usize| {
                let number = (self.blocks + 1 + line) * self.blocks + i;
                let place = at(self.line(i, 0.5) - x, 0.0, self.line(line, 0.0) - z);
                (number, place)
            };
            streets.push(StreetPlace {
                name: format!("cross street {}", line + 1),
                along_z: false,
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

    /// Where the street before a block runs, or `part` of the way to the next.
    fn line(&self, block: usize, part: f64) -> f64 {
        (block as f64 + part - 0.5 * self.blocks as f64) * PITCH
    }
}
