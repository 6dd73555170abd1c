//! The rocks before anything broke: conformable layers, gently folded, and what they reflect.
//!
//! The top horizon is a dip, a dome, long waves and a little roughness; each layer below adds a thickness that is positive everywhere,
//! so no two horizons can cross. Between horizons lie thinner beds that follow them in proportion.

use super::chance::{Chance, Part};
use glam::DVec2;
use std::f64::consts::TAU;

/// Depth of the top horizon without its folds, in metres.
const TOP: f64 = 560.0;
/// From the top horizon to the bottom one, in metres, without folds.
const THICKNESS: f64 = 1830.0;
/// By what share a layer thickens and thins.
const THINNING: f64 = 0.26;
/// How high the dome lifts the top horizon, in metres.
const DOME: f64 = 190.0;
/// Thin beds in a layer.
const BEDS: usize = 3;

/// A border between two rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Boundary {
    /// The horizon above it, or at it.
    pub(super) layer: usize,
    /// Its share of the way to the next horizon; 0 is the horizon itself.
    pub(super) share: f64,
    /// How strongly it reflects, -1..1.
    pub(super) coefficient: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Layers {
    dip: DVec2,
    dome: DVec2,
    dome_reach: f64,
    folds: Vec<Wave>,
    /// One less than there are horizons.
    layers: Vec<Layer>,
    pub(super) boundaries: Vec<Boundary>,
}

#[derive(Debug, Clone)]
struct Layer {
    mean: f64,
    waves: Vec<Wave>,
}

/// An undulation.
#[derive(Debug, Clone, Copy)]
struct Wave {
    /// Radians a metre, east and north.
    along: DVec2,
    phase: f64,
    height: f64,
}

impl Wave {
    fn new(chance: &mut Chance, lengths: [f64; 2], height: f64) -> Self {
        let [short, long] = lengths;
        Self {
            along: DVec2::from_angle(chance.angle()) * (TAU / chance.between(short, long)),
            phase: chance.angle(),
            height,
        }
    }

    fn at(&self, place: DVec2) -> f64 {
        self.height * (self.along.dot(place) + self.phase).sin()
    }
}

fn sum(waves: &[Wave], place: DVec2) -> f64 {
    waves.iter().map(|wave| wave.at(place)).sum()
}

impl Layers {
    pub(super) fn new(seed: u64, horizons: usize) -> Self {
        let chance = &mut Chance::new(seed, Part::Layers);
        let dip = DVec2::from_angle(chance.angle()) * chance.between(0.015, 0.03);
        let dome = DVec2::new(chance.between(-900.0, 900.0), chance.between(-900.0, 900.0));
        let dome_reach = chance.between(1300.0, 1700.0);
        let long = [32.0, 18.0, 12.0].map(|height| Wave::new(chance, [2200.0, 6000.0], height));
        let short = [2.6, 2.2, 1.8, 1.4, 1.1, 0.8, 0.6]
            .map(|height| Wave::new(chance, [110.0, 620.0], height));
        let shares: Vec<f64> = (1..horizons).map(|_| chance.between(0.65, 1.35)).collect();
        let whole: f64 = shares.iter().sum();
        let layer = |share: f64| Layer {
            mean: THICKNESS * share / whole,
            waves: [0.5, 0.3, 0.2]
                .map(|height| Wave::new(chance, [1500.0, 5000.0], THINNING * height))
                .to_vec(),
        };
        Self {
            dip,
            dome,
            dome_reach,
            folds: long.into_iter().chain(short).collect(),
            layers: shares.into_iter().map(layer).collect(),
            boundaries: boundaries(seed, horizons),
        }
    }

    /// Depth in metres of a horizon before the faults moved it.
    pub(super) fn depth(&self, horizon: usize, place: DVec2) -> f64 {
        let above = self.layers.iter().take(horizon);
        self.top(place) + above.map(|layer| layer.at(place)).sum::<f64>()
    }

    /// The same of every horizon from the top down, into `depths`.
    pub(super) fn depths(&self, place: DVec2, depths: &mut Vec<f64>) {
        depths.clear();
        let mut depth = self.top(place);
        depths.push(depth);
        for layer in &self.layers {
            depth += layer.at(place);
            depths.push(depth);
        }
    }

    fn top(&self, place: DVec2) -> f64 {
        let from_dome = (place - self.dome).length_squared() / self.dome_reach.powi(2);
        TOP + self.dip.dot(place) - DOME * (-0.5 * from_dome).exp() + sum(&self.folds, place)
    }
}

impl Layer {
    fn at(&self, place: DVec2) -> f64 {
        self.mean * (1.0 + sum(&self.waves, place))
    }
}

impl Boundary {
    /// Its depth, given that of every horizon in the same place.
    pub(super) fn depth(&self, horizons: &[f64]) -> Option<f64> {
        let above = *horizons.get(self.layer)?;
        if self.share == 0.0 {
            return Some(above);
        }
        let below = *horizons.get(self.layer + 1)?;
        Some(above + (below - above) * self.share)
    }
}

/// The horizons and, between them, the beds, from the top down. Signs alternate at random; beds are weak.
fn boundaries(seed: u64, horizons: usize) -> Vec<Boundary> {
    let chance = &mut Chance::new(seed, Part::Beds);
    let mut all = Vec::new();
    for layer in 0..horizons {
        all.push(Boundary {
            layer,
            share: 0.0,
            coefficient: chance.sign() * chance.between(0.55, 0.9),
        });
        let beds = if layer + 1 < horizons { BEDS } else { 0 };
        for bed in 0..beds {
            let middle = (bed as f64 + 1.0) / (BEDS as f64 + 1.0);
            all.push(Boundary {
                layer,
                share: middle + chance.between(-0.06, 0.06),
                coefficient: chance.sign() * chance.between(0.04, 0.13),
            });
        }
    }
    all
}
