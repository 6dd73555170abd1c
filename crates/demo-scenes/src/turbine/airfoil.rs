//! The one shape of all blades and vanes: a twisted, cambered section drawn out from root to tip.

use crate::solid::{Sheet, Solid, polar};
use std::f64::consts::TAU;

/// A twisted airfoil that stands outwards at angle 0, around x = 0. Pairs are of root and tip.
pub(super) struct Airfoil {
    /// Metres from the axis.
    pub radius: [f64; 2],
    /// Length of the section in metres.
    pub chord: [f64; 2],
    /// Radians between the section and the axis.
    pub stagger: [f64; 2],
    /// Greatest thickness in parts of the chord.
    pub thickness: [f64; 2],
    /// Height of the section's bow in parts of the chord.
    pub camber: f64,
    /// How far the tip lies behind the root, in metres.
    pub sweep: f64,
    /// Cells outwards and around the section; the latter is even.
    pub cells: [usize; 2],
}

impl Airfoil {
    /// Adds it, closed at both ends.
    pub fn add_to(&self, solid: &mut Solid) {
        let [out, around] = self.cells;
        let at = |row: usize, corner: usize| {
            let height = row as f64 / out as f64;
            let mix = |[root, tip]: [f64; 2]| root + (tip - root) * height;
            let radius = mix(self.radius);
            // From the trailing edge over the upper side to the leading edge and back.
            let (sin, along) = (TAU * corner as f64 / around as f64).sin_cos();
            let thick = mix(self.thickness) * 0.5 * sin * (0.75 - 0.45 * along);
            let (x, side) = (0.5 * along, self.camber * (1.0 - along * along) + thick);
            let (turn, straight) = mix(self.stagger).sin_cos();
            let chord = mix(self.chord);
            // The section lies on the cylinder of its radius, so that tips follow their casing.
            polar(
                chord * (x * straight - side * turn) + self.sweep * height * height,
                radius,
                chord * (x * turn + side * straight) / radius,
            )
        };
        // The trailing edge is sharp: a border, not a bend.
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

    /// How far it reaches along the axis before and behind its middle, at most.
    pub fn half_depth(&self) -> f64 {
        let depths = [0, 1].map(|end| self.chord[end] * self.stagger[end].cos());
        0.5 * depths[0].max(depths[1]) + self.sweep.abs()
    }
}

/// Adds a part of a ring: from x to x, radius to radius (each at both x), angle to angle, in `steps` cells around.
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
