//! Colours that distinguish the surfaces of a model.

use crate::surface::SurfaceKind;

/// Colours of horizons in sRGB, from the top down.
const HORIZONS: [[u8; 3]; 11] = [
    [236, 205, 112],
    [214, 222, 128],
    [159, 204, 128],
    [98, 186, 144],
    [64, 168, 168],
    [72, 148, 194],
    [96, 128, 206],
    [132, 116, 200],
    [168, 124, 190],
    [150, 140, 150],
    [178, 160, 140],
];
/// Colours of faults in sRGB.
const FAULTS: [[u8; 3]; 4] = [[206, 62, 48], [224, 94, 52], [186, 44, 72], [214, 78, 96]];

/// The linear RGBA colour of a surface: the spectrum from the top horizon down, and reds for faults.
pub(crate) fn colour(kind: SurfaceKind, index: usize) -> [f32; 4] {
    let palette: &[[u8; 3]] = match kind {
        SurfaceKind::Horizon => &HORIZONS,
        SurfaceKind::Fault => &FAULTS,
    };
    let colour = palette.get(index % palette.len()).copied();
    let [r, g, b] = colour.unwrap_or([255; 3]).map(linear);
    [r, g, b, 1.0]
}

/// Converts an sRGB component to linear.
fn linear(component: u8) -> f32 {
    let component = f32::from(component) / 255.0;
    if component <= 0.040_45 {
        component / 12.92
    } else {
        ((component + 0.055) / 1.055).powf(2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn colours_tell_neighbours_apart() {
        let bits = |kind, index| colour(kind, index).map(f32::to_bits);
        let horizons: HashSet<_> = (0..11).map(|k| bits(SurfaceKind::Horizon, k)).collect();
        assert_eq!(horizons.len(), 11);
        for fault in 0..16 {
            let own = bits(SurfaceKind::Fault, fault);
            assert_ne!(own, bits(SurfaceKind::Fault, fault + 1));
            assert!(!horizons.contains(&own));
        }
        let any = colour(SurfaceKind::Horizon, usize::MAX);
        assert!(any.iter().all(|c| (0.0..=1.0).contains(c)));
    }
}
