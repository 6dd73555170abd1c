//! Shapes of houses, furniture and vehicles: rounded boxes, solids of revolution, flat walls with openings, lofts.

use crate::solid::{Sheet, Solid};
use glam::{DAffine3, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// An opening in a wall: range across and range in height.
#[derive(Clone, Copy)]
pub(super) struct Opening {
    pub x: [f64; 2],
    pub y: [f64; 2],
}

impl Solid {
    /// Adds a box with bevelled edges, whose normals make it look rounded.
    pub(super) fn bevelled_box(&mut self, low: [f64; 3], high: [f64; 3], radius: f64) {
        let (low, high) = (DVec3::from(low), DVec3::from(high));
        let radius = radius.min(0.49 * (high - low).min_element());
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        // Each corner of the box is one vertex on each of three faces: number 3 * corner + axis.
        let mut corners = Vec::with_capacity(24);
        for corner in 0..8 {
            let upper = [1, 2, 4].map(|bit| corner & bit != 0);
            let pick = |i: usize, inset: f64| match upper[i] {
                true => high[i] - inset,
                false => low[i] + inset,
            };
            for face in 0..3 {
                let place = |i: usize| pick(i, if i == face { 0.0 } else { radius });
                let normal = axes[face] * if upper[face] { 1.0 } else { -1.0 };
                corners.push([DVec3::new(place(0), place(1), place(2)), normal]);
            }
        }
        let mut triangles = Vec::with_capacity(44);
        let mut quad = |quad: [u32; 4], flip: bool| {
            let [a, b, c, d] = quad;
            let both = [[a, b, c], [a, c, d]];
            triangles.extend(both.map(|[a, b, c]| if flip { [a, c, b] } else { [a, b, c] }));
        };
        let at = |corner: usize, face: usize| (3 * corner + face) as u32;
        for face in 0..3 {
            let (next, last) = ((face + 1) % 3, (face + 2) % 3);
            let [a, b, c] = [face, next, last].map(|axis| 1 << axis);
            for side in [0, a] {
                let ring = [side, side | b, side | b | c, side | c].map(|k| at(k, face));
                quad(ring, side == 0);
            }
            // The four edges along this axis, between the two other faces.
            for (k, flip) in [(0, false), (b, true), (b | c, false), (c, true)] {
                let edge = [at(k, next), at(k, last), at(k | a, last), at(k | a, next)];
                quad(edge, flip);
            }
        }
        for k in 0..8_usize {
            let triangle = [at(k, 0), at(k, 1), at(k, 2)];
            let [a, b, c] = triangle;
            triangles.push(if k.count_ones() % 2 == 1 {
                triangle
            } else {
                [a, c, b]
            });
        }
        self.patch(&corners, &triangles);
    }

    /// Adds a box with edges rounded in `steps` steps (at least two); one step gives bevelled edges.
    pub(super) fn rounded_box(&mut self, low: [f64; 3], high: [f64; 3], radius: f64, steps: usize) {
        if steps < 2 {
            return self.bevelled_box(low, high, radius);
        }
        let steps = steps - 1;
        let (low, high) = (DVec3::from(low), DVec3::from(high));
        let radius = radius.min(0.49 * (high - low).min_element());
        let cells = 2 * steps + 1;
        // Distance of a vertex from the middle of the edge, so that the angles between vertices are equal.
        let reach = |i: usize| radius * (FRAC_PI_4 * (steps - i) as f64 / steps as f64).tan();
        let along = |part: f64, low: f64, high: f64| {
            let i = (part * cells as f64).round() as usize;
            if i <= steps {
                low + radius - reach(i)
            } else {
                high - radius + reach(cells - i)
            }
        };
        self.block([cells; 3], |u, v, w| {
            let place = DVec3::new(
                along(u, low.x, high.x),
                along(v, low.y, high.y),
                along(w, low.z, high.z),
            );
            let inner = place.clamp(low + radius, high - radius);
            inner + (place - inner).normalize_or_zero() * radius
        });
    }

    /// Adds an upright solid of revolution at `foot`. The profile is [height, radius], the top first, both ends on
    /// the axis.
    pub(super) fn revolve_upright(&mut self, foot: [f64; 3], profile: &[[f64; 2]], sides: usize) {
        let mut solid = Solid::default();
        solid.revolve(profile, sides);
        self.add(&solid, along_y(foot));
    }

    /// Adds a solid of revolution along +Z from `back`. The profile is [distance, radius], the front first, both ends
    /// on the axis.
    pub(super) fn revolve_forward(&mut self, back: [f64; 3], profile: &[[f64; 2]], sides: usize) {
        let mut solid = Solid::default();
        solid.revolve(profile, sides);
        self.add(&solid, along_z(back));
    }

    /// Adds an upright post between two heights.
    pub(super) fn post(&mut self, foot: [f64; 3], radius: f64, height: f64, sides: usize) {
        let profile = [[height, 0.0], [height, radius], [0.0, radius], [0.0, 0.0]];
        self.revolve_upright(foot, &profile, sides);
    }

    /// Adds a round bar.
    pub(super) fn bar(&mut self, from: [f64; 3], to: [f64; 3], radius: f64, sides: usize) {
        self.tube(&[DVec3::from(from), DVec3::from(to)], radius, sides);
    }

    /// Adds a torus around the vertical axis through `middle`.
    pub(super) fn upright_torus(
        &mut self,
        middle: [f64; 3],
        radius: f64,
        thick: f64,
        steps: [usize; 2],
    ) {
        let mut solid = Solid::default();
        solid.torus(0.0, radius, thick, steps);
        self.add(&solid, along_y(middle));
    }

    /// Adds a flat wall between two planes z, divided into cells at `xs` and `ys`; only cells for which `keep` is
    /// true, named by their lower corner.
    pub(super) fn cell_wall(
        &mut self,
        xs: &[f64],
        ys: &[f64],
        z: [f64; 2],
        keep: impl Fn(usize, usize) -> bool,
    ) {
        let (wide, high) = (xs.len() - 1, ys.len() - 1);
        let edge = Sheet::open(2, 2);
        for i in 0..wide {
            for j in (0..high).filter(|&j| keep(i, j)) {
                let (x, y) = (|k: usize| xs[i + k], |k: usize| ys[j + k]);
                self.sheet(edge, |r, c| DVec3::new(x(r), y(c), z[1]));
                self.sheet(edge, |r, c| DVec3::new(x(c), y(r), z[0]));
                if i + 1 == wide || !keep(i + 1, j) {
                    self.sheet(edge, |r, c| DVec3::new(x(1), y(r), z[c]));
                }
                if i == 0 || !keep(i - 1, j) {
                    self.sheet(edge, |r, c| DVec3::new(x(0), y(c), z[r]));
                }
                if j + 1 == high || !keep(i, j + 1) {
                    self.sheet(edge, |r, c| DVec3::new(x(c), y(1), z[r]));
                }
                if j == 0 || !keep(i, j - 1) {
                    self.sheet(edge, |r, c| DVec3::new(x(r), y(0), z[c]));
                }
            }
        }
    }

    /// Adds a flat wall with openings.
    pub(super) fn wall_with_openings(
        &mut self,
        x: [f64; 2],
        y: [f64; 2],
        z: [f64; 2],
        openings: &[Opening],
    ) {
        let cuts = |ends: [f64; 2], of: fn(&Opening) -> [f64; 2]| {
            let mut cuts: Vec<f64> = openings.iter().flat_map(of).chain(ends).collect();
            cuts.retain(|cut| (ends[0]..=ends[1]).contains(cut));
            cuts.sort_by(f64::total_cmp);
            cuts.dedup();
            cuts
        };
        let (xs, ys) = (cuts(x, |o| o.x), cuts(y, |o| o.y));
        let within = |[from, to]: [f64; 2], cuts: &[f64], i: usize| {
            let middle = 0.5 * (cuts[i] + cuts[i + 1]);
            from < middle && middle < to
        };
        self.cell_wall(&xs, &ys, z, |i, j| {
            !(openings.iter()).any(|hole| within(hole.x, &xs, i) && within(hole.y, &ys, j))
        });
    }

    /// Adds a frame of four mitred bars around an opening, `wide` metres in the plane of the wall, between two planes
    /// z.
    pub(super) fn frame(&mut self, opening: Opening, wide: f64, z: [f64; 2]) {
        let Opening { x, y } = opening;
        let outer = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(DVec2::from);
        let inwards = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(DVec2::from);
        for side in 0..4 {
            let next = (side + 1) % 4;
            self.block([1; 3], |u, v, w| {
                let corner = |i: usize| outer[i] + inwards[i] * wide * v;
                let place = corner(side).lerp(corner(next), u);
                place.extend(z[0] + (z[1] - z[0]) * w)
            });
        }
    }

    /// Adds a loft between sections along +Y, or along any direction from whose end the vertices of a section run
    /// counter-clockwise. Both ends are closed and flat.
    pub(super) fn loft(&mut self, sections: &[Vec<DVec3>]) {
        let (Some(first), Some(last)) = (sections.first(), sections.last()) else {
            return;
        };
        let sheet = Sheet::round(sections.len(), first.len());
        let back: Vec<&Vec<DVec3>> = sections.iter().rev().collect();
        self.sheet(sheet, |row, column| back[row][column]);
        self.fan(last);
        let turned: Vec<DVec3> = first.iter().rev().copied().collect();
        self.fan(&turned);
    }

    /// Adds a loft with flat sides and sharp edges.
    pub(super) fn faceted_loft(&mut self, sections: &[Vec<DVec3>]) {
        let (Some(first), Some(last)) = (sections.first(), sections.last()) else {
            return;
        };
        for pair in sections.windows(2) {
            for i in 0..first.len() {
                let next = (i + 1) % first.len();
                let corner =
                    |row: usize, column: usize| pair[1 - row][if column == 0 { i } else { next }];
                self.sheet(Sheet::open(2, 2), corner);
            }
        }
        self.fan(last);
        let turned: Vec<DVec3> = first.iter().rev().copied().collect();
        self.fan(&turned);
    }

    /// Adds a prism between two planes z. Its outline is star-shaped around its centre and runs counter-clockwise
    /// seen from +Z.
    pub(super) fn extrude(&mut self, outline: &[[f64; 2]], z: [f64; 2]) {
        let face = |z: f64| -> Vec<DVec3> {
            let corners = outline.iter().map(|&[x, y]| DVec3::new(x, y, z));
            corners.collect()
        };
        let (far, near) = (face(z[0]), face(z[1]));
        for i in 0..outline.len() {
            let next = (i + 1) % outline.len();
            let corner = |near_it: bool, at: usize| if near_it { near[at] } else { far[at] };
            self.sheet(Sheet::open(2, 2), |row, column| {
                corner(column == 1, if row == 0 { i } else { next })
            });
        }
        self.fan(&near);
        let turned: Vec<DVec3> = far.iter().rev().copied().collect();
        self.fan(&turned);
    }

    /// Adds another solid at a position.
    pub(super) fn add_at(&mut self, other: &Solid, place: [f64; 3]) {
        self.add(other, DAffine3::from_translation(place.into()));
    }
}

/// Vertices of a superellipse, counter-clockwise seen from above; `power` 2 is an ellipse, larger powers approach a
/// rectangle.
pub(super) fn superellipse(
    middle: [f64; 3],
    [wide, deep]: [f64; 2],
    power: f64,
    sides: usize,
) -> Vec<DVec3> {
    let bent = |part: f64| part.signum() * part.abs().powf(2.0 / power);
    let corner = |side: usize| {
        let (sin, cos) = (TAU * side as f64 / sides as f64).sin_cos();
        DVec3::from(middle) + DVec3::new(wide * bent(cos), 0.0, -deep * bent(sin))
    };
    (0..sides).map(corner).collect()
}

/// The rotation from the X axis to the Z axis at a position.
pub(super) fn along_z(back: [f64; 3]) -> DAffine3 {
    DAffine3::from_translation(back.into()) * DAffine3::from_rotation_y(-FRAC_PI_2)
}

/// The rotation from the X axis to the Y axis at a position.
pub(super) fn along_y(foot: [f64; 3]) -> DAffine3 {
    DAffine3::from_translation(foot.into()) * DAffine3::from_rotation_z(FRAC_PI_2)
}
