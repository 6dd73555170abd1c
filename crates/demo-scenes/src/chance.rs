//! Seeded chance: the same seed draws the same numbers everywhere.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// What the numbers are for: each has a sequence of its own, so that more of one leaves the others as they are.
#[derive(Clone, Copy)]
pub(super) enum For {
    Pipes = 1,
    Brackets = 2,
    Blocks = 3,
    Houses = 4,
    Rooms = 5,
    Streets = 6,
    Gardens = 7,
}

pub(super) struct Chance(Pcg32);

impl Chance {
    pub fn new(seed: u64, what: For) -> Self {
        Self(Pcg32::new(seed, what as u64))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }

    /// One of `0..count`; 0 for none.
    pub fn pick(&mut self, count: usize) -> usize {
        // The upper half of the product: a share of the count, at most `count - 1`.
        ((u64::from(self.0.next_u32()) * count as u64) >> 32) as usize
    }

    /// `count` things, the given ones over and over, in another order: every seed deals out as many of each.
    pub fn dealt<T: Copy>(&mut self, count: usize, things: &[T]) -> Vec<T> {
        let mut deck: Vec<T> = things.iter().copied().cycle().take(count).collect();
        self.shuffle(&mut deck);
        deck
    }

    /// Puts things into another order.
    pub fn shuffle<T>(&mut self, things: &mut [T]) {
        for last in (1..things.len()).rev() {
            things.swap(last, self.pick(last + 1));
        }
    }
}
