//! Seeded random numbers: one seed gives the same numbers on every platform.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;
use std::f64::consts::TAU;

/// What random numbers are for. Each purpose has a stream of its own, so that drawing more numbers for one purpose does
/// not change the others.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stream {
    /// Routes of the engine's pipes.
    Pipes,
    /// Places of the engine's brackets.
    Brackets,
    /// Lots of the city's blocks.
    Blocks,
    /// Styles of the city's houses.
    Houses,
    /// Furniture of the city's rooms.
    Rooms,
    /// Vehicles in the city's streets.
    Streets,
    /// Plants of the city's courtyards.
    Gardens,
    /// Folds of the sub-surface model.
    Layers,
    /// Reflectivity of the sub-surface model's beds.
    Beds,
    /// Faults of the sub-surface model.
    Faults,
    /// Wells of the sub-surface model.
    Wells,
    /// Outlines of the sub-surface model's horizons.
    Outlines,
    /// Boxes on the terrain.
    Boxes,
}

impl Stream {
    /// The number of the PCG stream. Streams of different scenes may have one number.
    fn number(self) -> u64 {
        match self {
            Self::Pipes | Self::Layers => 1,
            Self::Brackets | Self::Beds => 2,
            Self::Blocks | Self::Faults => 3,
            Self::Houses | Self::Wells => 4,
            Self::Rooms | Self::Outlines => 5,
            Self::Streets => 6,
            Self::Gardens | Self::Boxes => 7,
        }
    }
}

/// A sequence of random numbers (PCG32).
#[derive(Debug, Clone)]
pub(crate) struct Random(Pcg32);

impl Random {
    /// The sequence of a seed and a purpose.
    pub fn new(seed: u64, stream: Stream) -> Self {
        Self(Pcg32::new(seed, stream.number()))
    }

    /// A number from `low` to `high`, both included.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }

    /// An angle from 0 to 2 pi, in radians.
    pub fn angle(&mut self) -> f64 {
        self.between(0.0, TAU)
    }

    /// 1 or -1.
    pub fn sign(&mut self) -> f64 {
        if self.0.next_u32() & 1 == 0 {
            1.0
        } else {
            -1.0
        }
    }

    /// A number below `count`; 0 if `count` is 0.
    pub fn pick(&mut self, count: usize) -> usize {
        // The upper 32 bits of the product are at most `count - 1`.
        ((u64::from(self.0.next_u32()) * count as u64) >> 32) as usize
    }

    /// `count` values: the given values repeated in turn, then shuffled. Every seed gives the same number of each.
    pub fn shuffled_deck<T: Copy>(&mut self, count: usize, values: &[T]) -> Vec<T> {
        let mut deck: Vec<T> = values.iter().copied().cycle().take(count).collect();
        self.shuffle(&mut deck);
        deck
    }

    /// Shuffles the values (Fisher-Yates).
    pub fn shuffle<T>(&mut self, values: &mut [T]) {
        for last in (1..values.len()).rev() {
            values.swap(last, self.pick(last + 1));
        }
    }
}
