//! The shape of all blades and vanes: a twisted, cambered airfoil section swept from root to tip.

use crate::solid::{Sheet, Solid, polar};
use std::f64::consts::TAU;

/// A twisted airfoil along angle 0, centred at x = 0. Pairs are [root, tip].
pub(super) struct Airfoil {
    /// Distance from the axis in metres.
    pub radius: [f64; 2],
    /// Chord length in metres.
    pub chord: [f64; 2],
    /// Angle between chord and axis, in radians.
    pub stagger: [f64; 2],
    /// Maximum thickness relative to the chord.
    pub thickness: [f64; 2],
    /// Maximum camber relative to the chord.
    pub camber: f64,
    /// Sweep: distance of the tip behind the root, in metres.
    pub sweep: f64,
    /// Cells along the span and around the section; the latter is even.
    pub cells: [usize; 2],
}

impl Airfoil {
    /// Adds the airfoil, closed at both ends.
    pub fn add_to(&self, solid: &mut Solid) {
        let [out, around] = self.cells;
        let at = |row: usize, corner: usize| {
            let height = row as f64 / out as f64;
            let mix = |[root, tip]: [f64; 2]| root + (tip - root) * height;
            let radius = mix(self.radius);
            // From the trailing edge over the suction side to the leading edge and back.
            let (sin, along) = (TAU * corner as f64 / around as f64).sin_cos();
            let thick = mix(self.thickness) * 0.5 * sin * (0.75 - 0.45 * along);
            let (x, side) = (0.5 * along, self.camber * (1.0 - along * along) + thick);
            let (turn, straight) = mix(self.stagger).sin_cos();
            let chord = mix(self.chord);
            // A section lies on the cylinder of its radius, so that the tip follows the casing.
            polar(
                chord * (x * straight - side * turn) + self.sweep * height * height,
                radius,
                chord * (x * turn + side * straight) / radius,
            )
        };
        // The trailing edge is sharp: the sheet ends there.
        solid.sheet(Sheet::open(out + 1, around + 1), |row, corner| {
            at(row, corner % around)
        });
        let half = around / 2;
        let across = |row: usize, i: usize, lower: bool| {
            at(row, if lower { (around - i) % around } else { i })
        };
        let end = Sheet::open(half + 1, 2);
        solid.sheet(end, |i, side| across(0, i, side == 1));
        solid.sheet(end, |i, side| across(out, i, side == 0));
    }

    /// Upper bound of its extent along the axis, before and behind its centre.
    pub fn half_depth(&self) -> f64 {
        let depths = [0, 1].map(|end| self.chord[end] * self.stagger[end].cos());
        0.5 * depths[0].max(depths[1]) + self.sweep.abs()
    }
}

/// Adds a segment of a ring: axial range, [inner, outer] radius at both ends, and angle to either side, in `steps`
/// cells around.
pub(super) fn platform(
    solid: &mut Solid,
    x: [f64; 2],
    radius: [[f64; 2]; 2],
    half_angle: f64,
    steps: usize,
) {
    solid.block([1, 1, steps], |u, v, w| {
        let mix = |[from, to]: [f64; 2], part: f64| from + (to - from) * part;
        let [inner, outer] = radius;
        let reach = mix(inner, u) * (1.0 - v) + mix(outer, u) * v;
        polar(mix(x, u), reach, half_angle * (2.0 * w - 1.0))
    });
}
