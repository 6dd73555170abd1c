//! Colour maps and amplitudes of samples.

use super::layout::VolumeLayout;

/// A colour map for samples. If the range of values includes zero, the map is symmetric around zero; otherwise it
/// spans the range.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ColourMap {
    /// Blue below zero, white at zero, red above; the strongest values are darker.
    #[default]
    Seismic,
    /// Black to white.
    Grey,
}

/// The colour of samples without a value, sRGB.
pub(crate) const UNKNOWN: [u8; 3] = [118, 116, 110];

impl ColourMap {
    /// The sRGB colour of every sample value of a volume. Index 0 is for samples without a value.
    #[must_use]
    pub fn table(self, layout: &VolumeLayout) -> [[u8; 3]; 256] {
        let [low, high] = ends(layout.range);
        let mut colours = [UNKNOWN; 256];
        for (sample, colour) in (0..=u8::MAX).zip(&mut colours) {
            if let Some(value) = layout.value(sample) {
                *colour = self.colour((f64::from(value) - low) / (high - low));
            }
        }
        colours
    }

    /// The colour at a fraction 0..1 of the map.
    fn colour(self, part: f64) -> [u8; 3] {
        let stops: &[[f64; 3]] = match self {
            Self::Seismic => &[
                [0.0, 0.0, 77.0],
                [0.0, 0.0, 255.0],
                [255.0, 255.0, 255.0],
                [255.0, 0.0, 0.0],
                [128.0, 0.0, 0.0],
            ],
            Self::Grey => &[[0.0; 3], [255.0; 3]],
        };
        let spans = stops.len() - 1;
        let place = part.clamp(0.0, 1.0) * spans as f64;
        let span = (place as usize).min(spans - 1);
        let (from, to) = (stops[span], stops[span + 1]);
        let mix = place - span as f64;
        std::array::from_fn(|i| (from[i] + (to[i] - from[i]) * mix).round() as u8)
    }
}

/// The values at the ends of the colour map. They are symmetric around zero if the range includes it.
fn ends([low, high]: [f32; 2]) -> [f64; 2] {
    let [low, high] = [low, high].map(f64::from);
    if low < 0.0 && high > 0.0 {
        let reach = high.max(-low);
        return [-reach, reach];
    }
    [low, high]
}

/// The amplitude of each sample value of a volume: its distance from zero, 0..=1, where 1 is the greatest; 0 for
/// samples without a value.
pub(crate) fn amplitudes(layout: &VolumeLayout) -> [f64; 256] {
    let [low, high] = layout.range.map(|end| f64::from(end).abs());
    let reach = low.max(high);
    let mut amplitudes = [0.0; 256];
    for (sample, amplitude) in (0..=u8::MAX).zip(&mut amplitudes) {
        if let Some(value) = layout.value(sample) {
            *amplitude = f64::from(value).abs() / reach;
        }
    }
    amplitudes
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn layout(range: [f32; 2]) -> VolumeLayout {
        VolumeLayout {
            size: [1; 3],
            brick: 1,
            origin: DVec3::ZERO,
            steps: [DVec3::X, DVec3::Z, DVec3::NEG_Y],
            range,
        }
    }

    #[test]
    fn zero_is_white_even_when_it_is_not_the_middle_of_the_range() {
        // 1 + 254 / 3 and so on: zero lies a third of the way up.
        let lopsided = layout([-127.0, 254.0]);
        let table = ColourMap::Seismic.table(&lopsided);
        let zero = 1 + 254 / 3;
        assert!(table[zero].into_iter().all(|part| part > 250));
        // The lower end is halfway to the end of the blues: pure blue. The upper is dark red.
        assert_eq!(table[1], [0, 0, 255]);
        assert_eq!(table[255], [128, 0, 0]);
        assert_eq!(table[0], UNKNOWN);
    }

    #[test]
    fn a_range_on_one_side_of_zero_gets_all_the_colours() {
        let table = ColourMap::Grey.table(&layout([10.0, 20.0]));
        assert_eq!([table[1], table[255]], [[0; 3], [255; 3]]);
        assert!(table[1..].is_sorted());
    }

    #[test]
    fn amplitudes_are_those_of_values() {
        let known = amplitudes(&layout([-127.0, 254.0]));
        assert_eq!([known[0], known[1], known[255]], [0.0, 0.5, 1.0]);
        let strong = amplitudes(&layout([10.0, 20.0]));
        assert_eq!([strong[0], strong[1], strong[255]], [0.0, 0.5, 1.0]);
    }
}
