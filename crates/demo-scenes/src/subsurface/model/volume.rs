//! The seismic volume of the model: a Ricker wavelet at every boundary between two rocks, and a little noise.
//!
//! The wavelet is that of Norman Ricker, *The form and laws of propagation of seismic wavelets*, 1953: 25 Hz at 2,500
//! m/s, 100 m long. A sample depends on its position only, so that bricks can be computed in any order and
//! repeatedly.

use super::Model;
use super::extent::{DEPTH, HALF, world};
use super::fault::displace;
use antumbra_subsurface::{BrickSource, SubsurfaceError, VolumeLayout};
use glam::{DVec2, DVec3, UVec3};
use std::f64::consts::PI;

/// Samples of the full model along the inline, crossline and depth axis.
const FULL_SAMPLES: [f64; 3] = [525.0, 475.0, 751.0];
/// Samples along an edge of a brick.
const BRICK: u32 = 32;
/// Wavelength of the wavelet's peak frequency, in metres.
const WAVELENGTH: f64 = 100.0;
/// Distance from a boundary, in metres, at which the wavelet is cut off.
const SUPPORT: f64 = 125.0;
/// Entries of the wavelet table per metre.
const ENTRIES_PER_METRE: f64 = 4.0;
/// Greatest amplitude of the noise.
const NOISE: f32 = 0.03;

/// A [`BrickSource`] that computes bricks when they are read.
#[derive(Debug, Clone)]
pub struct ModelVolume {
    model: Model,
    layout: VolumeLayout,
    /// The wavelet by distance from the boundary.
    wavelet: Vec<f32>,
}

impl Model {
    /// The seismic volume. Its bricks are computed when they are read.
    #[must_use]
    pub fn volume(&self) -> ModelVolume {
        ModelVolume::new(self.clone())
    }
}

impl ModelVolume {
    fn new(model: Model) -> Self {
        let size = FULL_SAMPLES.map(|full| {
            ((full - 1.0) * model.options.relative_resolution())
                .round()
                .max(1.0)
                + 1.0
        });
        let [inlines, crosslines, samples] = size;
        let layout = VolumeLayout {
            size: size.map(|side| side as u32),
            brick: BRICK,
            origin: world(-HALF, 0.0),
            steps: [
                DVec3::X * (HALF.x * 2.0 / (inlines - 1.0)),
                DVec3::NEG_Z * (HALF.y * 2.0 / (crosslines - 1.0)),
                DVec3::NEG_Y * (DEPTH / (samples - 1.0)),
            ],
            range: [-1.0, 1.0],
        };
        let entries = 0..(SUPPORT * ENTRIES_PER_METRE) as u32;
        let ricker = |entry: u32| {
            let phase = (f64::from(entry) / ENTRIES_PER_METRE * PI / WAVELENGTH).powi(2);
            ((1.0 - 2.0 * phase) * (-phase).exp()) as f32
        };
        Self {
            layout,
            wavelet: entries.map(ricker).chain([0.0, 0.0]).collect(),
            model,
        }
    }

    /// Sums the wavelets of a column of samples at a place; the first sample lies at a depth of `top` metres.
    fn trace(&self, place: DVec2, top: f64, horizons: &mut Vec<f64>, trace: &mut [f32]) {
        trace.fill(0.0);
        let [.., step] = self.layout.steps.map(DVec3::length);
        let [from, to] = [top - SUPPORT, top + step * trace.len() as f64 + SUPPORT];
        self.model.layers.depths(place, horizons);
        let faults: Vec<_> = self
            .model
            .faults
            .iter()
            .filter(|fault| fault.reaches(place))
            .copied()
            .collect();
        let moved: f64 = faults.iter().map(|fault| fault.throw).sum();
        for boundary in &self.model.layers.boundaries {
            let Some(depth) = boundary.depth(horizons) else {
                continue;
            };
            if depth < from - moved || depth > to + moved {
                continue;
            }
            let border = displace(&faults, place, depth);
            if border.in_gap {
                continue;
            }
            let first = ((border.depth - SUPPORT - top) / step).ceil().max(0.0);
            let last = ((border.depth + SUPPORT - top) / step).floor();
            for at in first as usize..trace.len().min((last + 1.0).max(0.0) as usize) {
                let away = (top + at as f64 * step - border.depth).abs();
                if let Some(sample) = trace.get_mut(at) {
                    *sample += boundary.coefficient as f32 * self.wavelet_at(away);
                }
            }
        }
    }

    fn wavelet_at(&self, away: f64) -> f32 {
        let at = away * ENTRIES_PER_METRE;
        let entry = at as usize;
        let pair = self
            .wavelet
            .get(entry..)
            .and_then(<[f32]>::first_chunk::<2>);
        pair.map_or(0.0, |[a, b]| a + (b - a) * at.fract() as f32)
    }

    /// Noise of a sample, -1..1, a hash of its position.
    fn noise(&self, at: UVec3) -> f32 {
        let [x, y, z] = at.to_array().map(u64::from);
        // The finaliser of Sebastiano Vigna's SplitMix64, 2015: every input bit changes every output bit.
        let mut bits = (x << 42 | y << 21 | z) ^ self.model.options.seed.rotate_left(17);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (bits >> 40) as f32 / (1u32 << 23) as f32 - 1.0
    }
}

impl BrickSource for ModelVolume {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        self.layout.check_read(brick, samples)?;
        let first = brick.map(|at| at * BRICK);
        let [.., top] = first;
        let [.., deepest] = self.layout.size;
        let mut trace = [0.0; BRICK as usize];
        let known = (deepest - top).min(BRICK) as usize;
        let mut horizons = Vec::new();
        let columns = BRICK as usize * BRICK as usize;
        for column in 0..columns {
            // Samples beyond the end of the volume repeat the last sample.
            let within = [column as u32 % BRICK, column as u32 / BRICK, 0];
            let at = UVec3::from(first) + UVec3::from(within);
            let at = at.min(UVec3::from(self.layout.size) - 1);
            let position = self.layout.position(at.as_dvec3());
            let place = DVec2::new(position.x, -position.z);
            let (known, beyond) = trace.split_at_mut(known);
            self.trace(place, -position.y, &mut horizons, known);
            let mut last = 0.0;
            for (down, sample) in (0..).zip(known) {
                *sample += NOISE * self.noise(at + UVec3::Z * down);
                last = *sample;
            }
            beyond.fill(last);
            let slots = samples.iter_mut().skip(column).step_by(columns);
            for (slot, sample) in slots.zip(&trace) {
                *slot = (128.5 + sample * 127.0).clamp(1.0, 255.0) as u8;
            }
        }
        Ok(())
    }
}
