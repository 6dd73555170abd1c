//! How many patches of a frame are sampled, and which: as many of each kind as the budget of triangles pays for, one at random out of each of as
//! many equal parts of all patches of that kind.

use rand::{Rng, RngExt};

use super::strata::{Moments, PLAIN, Patches, STRATA, UNCERTAIN};

/// The most patches of a kind that are sampled in a frame.
pub(super) const MOST: u32 = 64;
/// Cost of a draw, in triangles.
const A_DRAW: f64 = 64.0;
/// Cost of visiting a node of the tree on the way to a patch's entities, in triangles.
const A_NODE: f64 = 0.25;
/// Cost of testing an entity against the depth, in triangles.
const AN_ENTRY: f64 = 4.0;
/// No kind gets less than this part of the budget.
const LEAST: f64 = 0.15;
/// Each kind gets at least this many patches in a sampled frame, whatever the budget: a kind that is sampled too seldom has no useful bound, and one hit in it outweighs
/// all others.
const FEWEST: f64 = 1.0;
/// The assumed cost of a patch before any was sampled, in triangles; it weighs as much as `BELIEF` patches.
const BELIEVED: f64 = 2_000.0;
const BELIEF: f64 = 4.0;
const FADES: f64 = 0.98;

/// The cost of a patch, by kind, in triangles.
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

    /// Adds the cost of a patch.
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

/// The cost of finding a patch's entities and of testing them against the depth, in triangles.
pub(super) fn overhead(nodes: u32, entries: usize, draws: u32) -> f64 {
    f64::from(nodes) * A_NODE + entries as f64 * AN_ENTRY + f64::from(draws) * A_DRAW
}

/// What a plan rests on.
pub(super) struct PlanInputs<'a> {
    /// Triangles that the audit may draw a frame, on average over all frames.
    pub budget: f64,
    /// The part of the frames that are sampled.
    pub frame_share: f64,
    /// What patches took in earlier frames.
    pub costs: &'a Costs,
    /// How much of patches was wrong in earlier frames.
    pub moments: &'a Moments,
}

/// Which patches of a frame are sampled.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct SamplePlan {
    /// Patch and kind, in the order of drawing.
    pub drawn: Vec<(u32, usize)>,
    /// How many patches each one of a kind stands for; 0 where there are none of the kind.
    pub weights: [f64; STRATA],
    /// Whether the frame is sampled at all.
    pub sampled: bool,
}

impl SamplePlan {
    /// Every patch, each standing for itself alone.
    pub fn all(patches: &Patches) -> Self {
        Self {
            drawn: (0..patches.number()).map(|patch| (patch, PLAIN)).collect(),
            weights: [1.0, 0.0],
            sampled: true,
        }
    }

    /// Draws a plan at random: whether the frame is sampled, and which patches. Their number depends on earlier frames alone, never on what this frame would show;
    /// that keeps the estimate unbiased.
    pub fn draw(patches: &Patches, known: &PlanInputs<'_>, random: &mut impl Rng) -> Self {
        let there = [PLAIN, UNCERTAIN].map(|kind| patches.of_kind(kind).len() as u32);
        let expected = expected(there, known);
        let mut plan = Self {
            sampled: random.random_bool(known.frame_share),
            ..Self::default()
        };
        for kind in [UNCERTAIN, PLAIN] {
            let number = there[kind];
            if number == 0 {
                continue;
            }
            let expected = expected[kind];
            plan.weights[kind] = f64::from(number) / (expected * known.frame_share);
            if !plan.sampled {
                continue;
            }
            let whole = expected.floor();
            let count =
                whole as u32 + u32::from(random.random_bool((expected - whole).clamp(0.0, 1.0)));
            for part in 0..count {
                let share = (f64::from(part) + random.random::<f64>()) / f64::from(count);
                let at = ((share * f64::from(number)) as usize).min(number as usize - 1);
                let patch = patches.of_kind(kind).get(at).copied();
                plan.drawn.extend(patch.map(|patch| (patch, kind)));
            }
        }
        plan
    }

    /// The largest number of patches that one patch stands for.
    pub fn heaviest(&self) -> f64 {
        self.weights.iter().copied().fold(0.0, f64::max)
    }
}

/// The mean number of patches of each kind in a sampled frame.
fn expected(there: [u32; STRATA], known: &PlanInputs<'_>) -> [f64; STRATA] {
    let PlanInputs { costs, moments, .. } = known;
    let budget = known.budget / known.frame_share;
    let wanted = [PLAIN, UNCERTAIN].map(|kind| {
        let gain = f64::from(there[kind]) * moments.spread(kind) * costs.of(kind).sqrt();
        if there[kind] == 0 { 0.0 } else { gain }
    });
    let all: f64 = wanted.iter().sum();
    let alone = there.contains(&0);
    // A patch may be drawn twice by chance, and then counts twice. No more patches than there are keeps that rare.
    let most = [PLAIN, UNCERTAIN].map(|kind| f64::from(there[kind].min(MOST)));
    let paid = [PLAIN, UNCERTAIN].map(|kind| {
        let part = if all > 0.0 { wanted[kind] / all } else { 0.0 };
        let part = if alone {
            part
        } else {
            part.clamp(LEAST, 1.0 - LEAST)
        };
        budget * part / costs.of(kind)
    });
    // The part of the budget for which one kind has no patches goes to the other.
    [(PLAIN, UNCERTAIN), (UNCERTAIN, PLAIN)].map(|(kind, other)| {
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
                let known = PlanInputs {
                    budget,
                    frame_share: often,
                    costs: &Costs::default(),
                    moments: &Moments::default(),
                };
                let plan = SamplePlan::draw(&patches, &known, &mut random);
                let found: f64 = plan
                    .drawn
                    .iter()
                    .map(|(patch, kind)| wrong(*patch) * plan.weights[*kind])
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
            let (mut drawn, mut sampled) = (0, 0);
            for _ in 0..4_000 {
                let known = PlanInputs {
                    budget: 30_000.0,
                    frame_share: often,
                    costs: &costs,
                    moments: &Moments::default(),
                };
                let plan = SamplePlan::draw(&patches, &known, &mut random);
                sampled += u32::from(plan.sampled);
                assert!(plan.sampled || plan.drawn.is_empty());
                if plan.sampled {
                    costs.fade();
                }
                for (_, kind) in &plan.drawn {
                    costs.note(*kind, 10_000.0);
                }
                drawn += plan.drawn.len();
            }
            let triangles = drawn as f64 * 10_000.0 / 4_000.0;
            assert!((20_000.0..40_000.0).contains(&triangles), "{triangles}");
            let part = f64::from(sampled) / 4_000.0;
            assert!((part - often).abs() < 0.03, "{part} of {often}");
        }
    }
}
