//! How much a world transform stretches lengths, at least and at most.

use glam::{DAffine3, DVec3};

/// The unit axes after a transform.
struct Axes {
    lengths: DVec3,
    /// Whether they stay at right angles.
    orthogonal: bool,
}

fn axes(world: &DAffine3) -> Axes {
    let axes = world.matrix3;
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
    let skew = [
        axes.x_axis.dot(axes.y_axis) / (x * y),
        axes.y_axis.dot(axes.z_axis) / (y * z),
        axes.z_axis.dot(axes.x_axis) / (z * x),
    ];
    // An axis without length gives NaN, which does not compare as less.
    let orthogonal = skew.iter().all(|cosine| cosine.abs() < 1e-6);
    Axes {
        lengths: DVec3::new(x, y, z),
        orthogonal,
    }
}

/// An upper bound of the length that a transform gives a unit vector: exact where its axes stay at right angles, elsewhere too large by
/// a factor of at most the square root of three.
pub(crate) fn greatest_scale(world: &DAffine3) -> f64 {
    let axes = axes(world);
    match axes.orthogonal {
        true => axes.lengths.max_element(),
        false => axes.lengths.length(),
    }
}

/// A lower bound of the length that a transform gives a unit vector: exact where its axes stay at right angles, elsewhere too small by
/// a factor of at most the square root of three; 0 for a transform that flattens.
pub(crate) fn least_scale(world: &DAffine3) -> f32 {
    let axes = axes(world);
    if axes.orthogonal {
        return axes.lengths.min_element() as f32 * 0.999_99;
    }
    let inverse = world.matrix3.inverse();
    let most = (inverse.x_axis.length_squared()
        + inverse.y_axis.length_squared()
        + inverse.z_axis.length_squared())
    .sqrt();
    let least = most.recip();
    if least.is_finite() {
        least as f32 * 0.999_99
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn the_least_scale_is_what_the_shortest_direction_keeps() {
        let turned = DQuat::from_rotation_x(0.4) * DQuat::from_rotation_z(1.1);
        let stretched = DAffine3::from_scale_rotation_translation(
            DVec3::new(2.0, 0.01, -5.0),
            turned,
            DVec3::ONE,
        );
        assert!((least_scale(&stretched) - 0.01).abs() < 1e-6);
        assert!((greatest_scale(&stretched) - 5.0).abs() < 1e-12);
        // A stretch after a turn: no axis stays at right angles.
        let sheared = DAffine3::from_scale(DVec3::new(1.0, 0.1, 1.0)) * stretched;
        // By how much the inverse stretches at most: power iteration.
        let inverse = sheared.matrix3.inverse();
        let grown = (0..200).fold(DVec3::new(0.3, 0.5, 0.7), |unit, _| {
            (inverse.transpose() * (inverse * unit)).normalize()
        });
        let least = (inverse * grown).length().recip();
        let bound = f64::from(least_scale(&sheared));
        assert!(bound <= least && bound > least / 1.8, "{bound} of {least}");
        let grown = (0..200).fold(DVec3::new(0.3, 0.5, 0.7), |unit, _| {
            (sheared.matrix3.transpose() * (sheared.matrix3 * unit)).normalize()
        });
        let (most, bound) = ((sheared.matrix3 * grown).length(), greatest_scale(&sheared));
        assert!(bound >= most && bound < most * 1.8, "{bound} of {most}");
        let flat = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
        assert_eq!(least_scale(&flat), 0.0);
    }
}
