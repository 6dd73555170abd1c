//! The model's seismic volume: at every border between two rocks a Ricker wavelet, and a little noise.
//!
//! The wavelet is that of Norman Ricker, *The form and laws of propagation of seismic wavelets*, 1953: 25 Hz at 2,500 m/s, 100 m
//! long. A sample depends on its place alone, so that bricks can be computed in any order and as often as one likes.

use super::fault::displace;
use super::{DEPTH, HALF, Model, world};
use antumbra_subsurface::{BrickSource, SubsurfaceError, VolumeLayout};
use glam::{DVec2, DVec3, UVec3};
use std::f64::consts::PI;

/// Samples of the full model along the inline, crossline and depth axis.
const FULL_SAMPLES: [f64; 3] = [525.0, 475.0, 751.0];
/// Samples along an edge of a brick.
const BRICK: u32 = 32;
/// Metres in which the wavelet's peak frequency goes through a period.
const WAVELENGTH: f64 = 100.0;
/// Metres from a border at which its wavelet has ended.
const SUPPORT: f64 = 125.0;
/// Entries of the wavelet's table a metre.
const FINENESS: f64 = 4.0;
/// Greatest amplitude of the noise.
const NOISE: f32 = 0.03;

/// A [`BrickSource`] that computes what it is asked for.
#[derive(Debug, Clone)]
pub struct ModelVolume {
    model: Model,
    layout: VolumeLayout,
    /// By distance from the border.
    wavelet: Vec<f32>,
}

impl ModelVolume {
    pub(super) fn new(model: Model) -> Self {
        let size =
            FULL_SAMPLES.map(|full| ((full - 1.0) * model.fineness()).round().max(1.0) + 1.0);
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
        let entries = 0..(SUPPORT * FINENESS) as u32;
        let ricker = |entry: u32| {
            let phase = (f64::from(entry) / FINENESS * PI / WAVELENGTH).powi(2);
            ((1.0 - 2.0 * phase) * (-phase).exp()) as f32
        };
        Self {
            layout,
            wavelet: entries.map(ricker).chain([0.0, 0.0]).collect(),
            model,
        }
    }

    /// Adds up the wavelets of a column of samples below a place; the first of them lies at `top` metres.
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
            if border.cut {
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
        let at = away * FINENESS;
        let entry = at as usize;
        let pair = self
            .wavelet
            .get(entry..)
            .and_then(<[f32]>::first_chunk::<2>);
        pair.map_or(0.0, |[a, b]| a + (b - a) * at.fract() as f32)
    }

    /// -1..1, by the sample's place.
    fn noise(&self, at: UVec3) -> f32 {
        let [x, y, z] = at.to_array().map(u64::from);
        // The finaliser of Sebastiano Vigna's SplitMix64, 2015: every bit in moves every bit out.
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
            // What lies beyond the end repeats the last samples.
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
