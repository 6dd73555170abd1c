//! The layers before faulting: conformable, gently folded, with reflection coefficients.
//!
//! The top horizon is the sum of a dip, a dome, long waves and a little roughness. Each layer below adds a thickness
//! that is positive everywhere, so that horizons never cross. Between horizons lie thinner beds that follow them in
//! proportion.

use crate::random::{Random, Stream};
use glam::DVec2;
use std::f64::consts::TAU;

/// Depth of the top horizon without its folds, in metres.
const TOP: f64 = 560.0;
/// Depth of the bottom horizon below the top horizon, in metres, without folds.
const THICKNESS: f64 = 1830.0;
/// Relative amplitude of the thickness of a layer.
const THINNING: f64 = 0.26;
/// Height by which the dome lifts the top horizon, in metres.
const DOME: f64 = 190.0;
/// Number of thin beds in a layer.
const BEDS: usize = 3;

/// A boundary between two rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Boundary {
    /// The horizon above it, or the horizon itself.
    pub(super) layer: usize,
    /// Relative position between this horizon and the next; 0 is the horizon itself.
    pub(super) share: f64,
    /// Reflection coefficient, -1..1.
    pub(super) coefficient: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Layers {
    dip: DVec2,
    dome: DVec2,
    dome_reach: f64,
    folds: Vec<Wave>,
    /// One fewer than the horizons.
    layers: Vec<Layer>,
    pub(super) boundaries: Vec<Boundary>,
}

#[derive(Debug, Clone)]
struct Layer {
    mean: f64,
    waves: Vec<Wave>,
}

/// A sine wave over the field.
#[derive(Debug, Clone, Copy)]
struct Wave {
    /// Radians per metre, east and north.
    along: DVec2,
    phase: f64,
    height: f64,
}

impl Wave {
    fn new(random: &mut Random, lengths: [f64; 2], height: f64) -> Self {
        let [short, long] = lengths;
        Self {
            along: DVec2::from_angle(random.angle()) * (TAU / random.between(short, long)),
            phase: random.angle(),
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
        let random = &mut Random::new(seed, Stream::Layers);
        let dip = DVec2::from_angle(random.angle()) * random.between(0.015, 0.03);
        let dome = DVec2::new(random.between(-900.0, 900.0), random.between(-900.0, 900.0));
        let dome_reach = random.between(1300.0, 1700.0);
        let long = [32.0, 18.0, 12.0].map(|height| Wave::new(random, [2200.0, 6000.0], height));
        let short = [2.6, 2.2, 1.8, 1.4, 1.1, 0.8, 0.6]
            .map(|height| Wave::new(random, [110.0, 620.0], height));
        let shares: Vec<f64> = (1..horizons).map(|_| random.between(0.65, 1.35)).collect();
        let whole: f64 = shares.iter().sum();
        let layer = |share: f64| Layer {
            mean: THICKNESS * share / whole,
            waves: [0.5, 0.3, 0.2]
                .map(|height| Wave::new(random, [1500.0, 5000.0], THINNING * height))
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

    /// Depth in metres of a horizon before faulting.
    pub(super) fn depth(&self, horizon: usize, place: DVec2) -> f64 {
        let above = self.layers.iter().take(horizon);
        self.top(place) + above.map(|layer| layer.at(place)).sum::<f64>()
    }

    /// Writes the depth of every horizon into `depths`, from the top down.
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
    /// Depth of the boundary, from the depths of all horizons at the same place.
    pub(super) fn depth(&self, horizons: &[f64]) -> Option<f64> {
        let above = *horizons.get(self.layer)?;
        if self.share == 0.0 {
            return Some(above);
        }
        let below = *horizons.get(self.layer + 1)?;
        Some(above + (below - above) * self.share)
    }
}

/// The boundaries from the top down: horizons and the beds between them. Signs are random; beds reflect weakly.
fn boundaries(seed: u64, horizons: usize) -> Vec<Boundary> {
    let random = &mut Random::new(seed, Stream::Beds);
    let mut all = Vec::new();
    for layer in 0..horizons {
        all.push(Boundary {
            layer,
            share: 0.0,
            coefficient: random.sign() * random.between(0.55, 0.9),
        });
        let beds = if layer + 1 < horizons { BEDS } else { 0 };
        for bed in 0..beds {
            let middle = (bed as f64 + 1.0) / (BEDS as f64 + 1.0);
            all.push(Boundary {
                layer,
                share: middle + random.between(-0.06, 0.06),
                coefficient: random.sign() * random.between(0.04, 0.13),
            });
        }
    }
    all
}
