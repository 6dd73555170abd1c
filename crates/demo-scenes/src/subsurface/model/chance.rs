//! Seeded chance: the same seed draws the same numbers everywhere.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;
use std::f64::consts::TAU;

/// Which part of the model the numbers are for: each has a sequence of its own, so that more of one leaves the others as they are.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part {
    Layers = 1,
    Beds = 2,
    Faults = 3,
    Wells = 4,
    Outlines = 5,
}

#[derive(Debug, Clone)]
pub(super) struct Chance(Pcg32);

impl Chance {
    pub(super) fn new(seed: u64, part: Part) -> Self {
        Self(Pcg32::new(seed, part as u64))
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }

    /// An angle in radians, all round.
    pub(super) fn angle(&mut self) -> f64 {
        self.between(0.0, TAU)
    }

    /// 1 or -1.
    pub(super) fn sign(&mut self) -> f64 {
        if self.0.next_u32() & 1 == 0 {
            1.0
        } else {
            -1.0
        }
    }

    /// One of `0..count`; 0 for none.
    pub(super) fn pick(&mut self, count: usize) -> usize {
        let count = u64::try_from(count).unwrap_or(u64::MAX);
        // The upper half of the product: a share of the count, at most `count - 1`.
        let share = u64::from(self.0.next_u32()).saturating_mul(count) >> 32;
        usize::try_from(share).unwrap_or(0)
    }
}
