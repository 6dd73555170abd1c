//! How many patches a frame looks at, and which: as many of each kind as the budget of triangles pays for, one by lot out of each of as many
//! equal parts of all there are.

use rand::{Rng, RngExt};

use super::strata::{DOUBTFUL, Moments, PLAIN, Patches, STRATA};

/// The most patches of a kind that a frame looks at.
pub(super) const MOST: u32 = 64;
/// What a draw costs, in triangles.
const A_DRAW: f64 = 64.0;
/// What a node of the tree costs that is met on the way to a patch's entities, in triangles,
const A_NODE: f64 = 0.25;
/// and an entity that is held against the depth.
const AN_ENTRY: f64 = 4.0;
/// No kind gets less of the budget than this part of it,
const LEAST: f64 = 0.15;
/// nor fewer patches than this in a frame that is looked at, whatever the budget: what is looked at too seldom bounds nothing, and a hit there drowns all
/// others.
const FEWEST: f64 = 1.0;
/// What a patch is believed to cost before any was looked at, in triangles, as if from so many patches.
const BELIEVED: f64 = 2_000.0;
const BELIEF: f64 = 4.0;
const FADES: f64 = 0.98;

/// What a patch takes, by kind, in triangles.
#[derive(Debug, Clone, Default)]
pub(super) struct Costs {
    sums: [f64; STRATA],
    weights: [f64; STRATA],
}

impl Costs {
    pub fn fade(&mut self) {
        for number in self.sums.iter_mut().chain(&mut self.weights) {
            *number *= FADES;
        }
    }

    /// Takes in what a patch came to.
    pub fn note(&mut self, kind: usize, triangles: f64) {
        if let (Some(sum), Some(weight)) = (self.sums.get_mut(kind), self.weights.get_mut(kind)) {
            *sum += triangles;
            *weight += 1.0;
        }
    }

    fn of(&self, kind: usize) -> f64 {
        let of = |numbers: &[f64; STRATA]| numbers.get(kind).copied().unwrap_or(0.0);
        (of(&self.sums) + BELIEF * BELIEVED) / (of(&self.weights) + BELIEF)
    }
}

/// What it takes to find what may be seen through a patch and to hold it against the depth, in triangles.
pub(super) fn overhead(nodes: u32, entries: usize, draws: u32) -> f64 {
    f64::from(nodes) * A_NODE + entries as f64 * AN_ENTRY + f64::from(draws) * A_DRAW
}

/// The patches of one frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Lots {
    /// Patch and kind, in the order of drawing.
    pub drawn: Vec<(u32, usize)>,
    /// How many patches each one of a kind stands for; 0 where there are none of the kind.
    pub weights: [f64; STRATA],
    /// Whether the frame is looked at.
    pub looked: bool,
}

impl Lots {
    /// Every patch, each for itself.
    pub fn all(patches: &Patches) -> Self {
        Self {
            drawn: (0..patches.number()).map(|patch| (patch, PLAIN)).collect(),
            weights: [1.0, 0.0],
            looked: true,
        }
    }

    /// Draws lots: whether the frame is looked at, which of so many are, and then where. How many patches rests on earlier frames alone, never on what this
    /// one would show: that keeps the estimate unbiased.
    pub fn draw(
        patches: &Patches,
        (budget, costs, moments): (f64, &Costs, &Moments),
        often: f64,
        random: &mut impl Rng,
    ) -> Self {
        let there = [PLAIN, DOUBTFUL].map(|kind| patches.of_kind(kind).len() as u32);
        let expected = expected(there, budget / often, costs, moments);
        let mut lots = Self {
            looked: random.random_bool(often),
            ..Self::default()
        };
        for kind in [DOUBTFUL, PLAIN] {
            let number = there[kind];
            if number == 0 {
                continue;
            }
            let expected = expected[kind];
            lots.weights[kind] = f64::from(number) / (expected * often);
            if !lots.looked {
                continue;
            }
            let whole = expected.floor();
            let count =
                whole as u32 + u32::from(random.random_bool((expected - whole).clamp(0.0, 1.0)));
            for part in 0..count {
                let share = (f64::from(part) + random.random::<f64>()) / f64::from(count);
                let at = ((share * f64::from(number)) as usize).min(number as usize - 1);
                let patch = patches.of_kind(kind).get(at).copied();
                lots.drawn.extend(patch.map(|patch| (patch, kind)));
            }
        }
        lots
    }

    /// The most patches that one stands for.
    pub fn heaviest(&self) -> f64 {
        self.weights.iter().copied().fold(0.0, f64::max)
    }
}

/// How many patches of each kind to look at in a frame that is looked at, on average.
fn expected(there: [u32; STRATA], budget: f64, costs: &Costs, moments: &Moments) -> [f64; STRATA] {
    let wanted = [PLAIN, DOUBTFUL].map(|kind| {
        let gain = f64::from(there[kind]) * moments.spread(kind) * costs.of(kind).sqrt();
        if there[kind] == 0 { 0.0 } else { gain }
    });
    let all: f64 = wanted.iter().sum();
    let alone = there.contains(&0);
    // A patch may be drawn twice by chance, and counts twice then: no more than there are keeps that rare.
    let most = [PLAIN, DOUBTFUL].map(|kind| f64::from(there[kind].min(MOST)));
    let paid = [PLAIN, DOUBTFUL].map(|kind| {
        let part = if all > 0.0 { wanted[kind] / all } else { 0.0 };
        let part = if alone {
            part
        } else {
            part.clamp(LEAST, 1.0 - LEAST)
        };
        budget * part / costs.of(kind)
    });
    // What one kind has no patches for is left to the other.
    [(PLAIN, DOUBTFUL), (DOUBTFUL, PLAIN)].map(|(kind, other)| {
        let left = (paid[other] - most[other]).max(0.0) * costs.of(other) / costs.of(kind);
        (paid[kind] + left).max(FEWEST).min(most[kind])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_pcg::Pcg64Mcg;

    /// A made-up truth a patch: few are wrong, and those in part.
    fn wrong(patch: u32) -> f64 {
        if patch.is_multiple_of(37) {
            f64::from(patch % 64 + 1)
        } else {
            0.0
        }
    }

    #[test]
    fn the_mean_of_many_lots_is_the_truth() {
        let mut patches = Patches::default();
        patches.reset([640, 480]);
        // Some of those that are wrong, and some that are not, in ascending order.
        patches.mark((0..patches.number()).filter(|patch| patch % 74 < 3));
        let truth: f64 = (0..patches.number()).map(wrong).sum();
        let mut random = Pcg64Mcg::seed_from_u64(7);
        for (budget, often) in [
            (1_000.0, 1.0),
            (1_000.0, 0.3),
            (20_000.0, 1.0),
            (20_000.0, 0.2),
            (500_000.0, 1.0),
        ] {
            let mut sum = 0.0;
            let mut squares = 0.0;
            let rounds = 20_000;
            for _ in 0..rounds {
                let lots = Lots::draw(
                    &patches,
                    (budget, &Costs::default(), &Moments::default()),
                    often,
                    &mut random,
                );
                let found: f64 = lots
                    .drawn
                    .iter()
                    .map(|(patch, kind)| wrong(*patch) * lots.weights[*kind])
                    .sum();
                sum += found;
                squares += found * found;
            }
            let mean = sum / f64::from(rounds);
            let error = (squares / f64::from(rounds)).sqrt() / f64::from(rounds).sqrt();
            assert!(
                (mean - truth).abs() < 4.0 * error,
                "{budget}, {often}: {mean} of {truth}, +- {error}"
            );
        }
    }

    #[test]
    fn no_more_patches_than_the_budget_pays_for_on_average() {
        let mut patches = Patches::default();
        patches.reset([640, 480]);
        let mut random = Pcg64Mcg::seed_from_u64(8);
        for often in [1.0, 0.25] {
            let mut costs = Costs::default();
            let (mut drawn, mut looked) = (0, 0);
            for _ in 0..4_000 {
                let known = (30_000.0, &costs, &Moments::default());
                let lots = Lots::draw(&patches, known, often, &mut random);
                looked += u32::from(lots.looked);
                assert!(lots.looked || lots.drawn.is_empty());
                if lots.looked {
                    costs.fade();
                }
                for (_, kind) in &lots.drawn {
                    costs.note(*kind, 10_000.0);
                }
                drawn += lots.drawn.len();
            }
            let triangles = drawn as f64 * 10_000.0 / 4_000.0;
            assert!((20_000.0..40_000.0).contains(&triangles), "{triangles}");
            let part = f64::from(looked) / 4_000.0;
            assert!((part - often).abs() < 0.03, "{part} of {often}");
        }
    }
}
