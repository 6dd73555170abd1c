//! The lines of a seismic survey: positions numbered by inline and crossline, and the grid in the plan that they lie on.

use glam::{DMat2, DVec2};

/// The numbers of lines in one direction: evenly spaced, from the least to the greatest that occurs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LineNumbers {
    /// The least number.
    pub first: i32,
    /// The difference between neighbours; 1 for a single line.
    pub step: u32,
    /// How many there are.
    pub count: u64,
}

impl LineNumbers {
    /// The lines among which all of `numbers` are; `None` for no numbers.
    pub fn of(numbers: impl Iterator<Item = i32> + Clone) -> Option<Self> {
        let (low, high) = (numbers.clone().min()?, numbers.clone().max()?);
        let step = numbers.fold(0, |step, number| divisor(step, number.abs_diff(low)));
        let step = step.max(1);
        Some(Self {
            first: low,
            step,
            count: u64::from(high.abs_diff(low) / step) + 1,
        })
    }

    /// The greatest number.
    pub fn last(&self) -> f64 {
        f64::from(self.first) + f64::from(self.step) * (self.count - 1) as f64
    }

    /// The index of a line, from 0; `None` for a number between the lines.
    pub fn index(&self, number: i32) -> Option<u64> {
        let from = (number >= self.first).then(|| number.abs_diff(self.first))?;
        from.is_multiple_of(self.step)
            .then_some(u64::from(from / self.step))
    }
}

/// The greatest common divisor (Euclid).
fn divisor(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// The least-squares fit of places in the plan to a grid of lines, from sums alone: no place is kept.
#[derive(Debug, Clone, Default)]
pub(crate) struct GridFit {
    /// Where the sums begin, so that large coordinates lose no digits.
    base: Option<(DVec2, DVec2)>,
    count: f64,
    lines: DVec2,
    place: DVec2,
    lines_squared: DVec2,
    lines_product: f64,
    inline_place: DVec2,
    crossline_place: DVec2,
    place_squared: DVec2,
}

/// A grid in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlanGrid {
    /// The place of inline 0 and crossline 0.
    origin: DVec2,
    /// The step from an inline number to the next.
    pub inline: DVec2,
    /// The step from a crossline number to the next.
    pub crossline: DVec2,
    /// The root of the mean square of the places' distances from the grid.
    pub off: f64,
}

impl PlanGrid {
    /// The place of these line numbers.
    pub fn place(&self, inline: f64, crossline: f64) -> DVec2 {
        self.origin + self.inline * inline + self.crossline * crossline
    }
}

impl GridFit {
    /// Adds a place with its line numbers. What is not finite is left out.
    pub fn add(&mut self, inline: f64, crossline: f64, place: DVec2) {
        let lines = DVec2::new(inline, crossline);
        if !lines.is_finite() || !place.is_finite() {
            return;
        }
        let (first, from) = *self.base.get_or_insert((lines, place));
        let (lines, place) = (lines - first, place - from);
        self.count += 1.0;
        self.lines += lines;
        self.place += place;
        self.lines_squared += lines * lines;
        self.lines_product += lines.x * lines.y;
        self.inline_place += place * lines.x;
        self.crossline_place += place * lines.y;
        self.place_squared += place * place;
    }

    /// The grid; `None` where the places span none. A single line gets neighbours at a right angle, as far apart as its own places.
    pub fn grid(&self) -> Option<PlanGrid> {
        let (first, from) = self.base?;
        let n = self.count;
        let (mean_lines, mean_place) = (self.lines / n, self.place / n);
        let spread = self.lines_squared - self.lines * mean_lines;
        let product = self.lines_product - self.lines.x * mean_lines.y;
        let along = self.inline_place - mean_place * self.lines.x;
        let across = self.crossline_place - mean_place * self.lines.y;
        let (inline, crossline) = match (spread.x > 0.0, spread.y > 0.0) {
            (true, true) => {
                let matrix =
                    DMat2::from_cols(DVec2::new(spread.x, product), DVec2::new(product, spread.y));
                if matrix.determinant() <= 1e-9 * spread.x * spread.y {
                    return None;
                }
                let inverse = matrix.inverse();
                let [x, y] = [
                    inverse * DVec2::new(along.x, across.x),
                    inverse * DVec2::new(along.y, across.y),
                ];
                (DVec2::new(x.x, y.x), DVec2::new(x.y, y.y))
            }
            (true, false) => {
                let inline = along / spread.x;
                (inline, -inline.perp())
            }
            (false, true) => {
                let crossline = across / spread.y;
                (crossline.perp(), crossline)
            }
            (false, false) => return None,
        };
        let area = inline.perp_dot(crossline).abs();
        if area <= 1e-9 * inline.length() * crossline.length() || !area.is_finite() {
            return None;
        }
        let total = self.place_squared - self.place * mean_place;
        let fitted = inline * along + crossline * across;
        Some(PlanGrid {
            origin: from + mean_place
                - inline * (first.x + mean_lines.x)
                - crossline * (first.y + mean_lines.y),
            inline,
            crossline,
            off: ((total - fitted).max(DVec2::ZERO).element_sum() / n).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_the_even_steps_among_numbers() {
        let lines = LineNumbers::of([12, 4, 20].into_iter()).unwrap();
        let expected = LineNumbers {
            first: 4,
            step: 8,
            count: 3,
        };
        assert_eq!(lines, expected);
        assert_eq!(lines.index(20), Some(2));
        assert_eq!(lines.index(13), None);
        assert_eq!(lines.index(0), None);
        let all = LineNumbers::of([i32::MIN, i32::MAX].into_iter()).unwrap();
        assert_eq!((all.step, all.count), (u32::MAX, 2));
        assert_eq!(all.index(i32::MAX), Some(1));
        assert_eq!(LineNumbers::of(std::iter::empty()), None);
    }

    #[test]
    fn a_rotated_grid_is_found_far_from_zero() {
        let (inline, crossline) = (DVec2::new(7.0, 24.0), DVec2::new(-24.0, 7.0));
        let corner = DVec2::new(527_718.0, 6_740_475.0);
        let mut fit = GridFit::default();
        for i in 0..20 {
            for j in 0..30 {
                let place = corner + inline * f64::from(i) + crossline * f64::from(j);
                fit.add(f64::from(1100 + i), f64::from(1200 + 2 * j), place);
            }
        }
        let grid = fit.grid().unwrap();
        assert!(grid.inline.distance(inline) < 1e-6 && grid.off < 0.01);
        assert!(grid.crossline.distance(crossline * 0.5) < 1e-6);
        assert!(grid.place(1100.0, 1200.0).distance(corner) < 1e-3);
    }

    #[test]
    fn a_single_line_gets_neighbours_at_a_right_angle() {
        let mut fit = GridFit::default();
        for j in 0..5 {
            fit.add(7.0, f64::from(j), DVec2::new(0.0, 12.5 * f64::from(j)));
        }
        let grid = fit.grid().unwrap();
        assert!(grid.inline.dot(grid.crossline).abs() < 1e-9);
        assert!((grid.inline.length() - 12.5).abs() < 1e-9);
        assert_eq!(GridFit::default().grid(), None);
        let mut diagonal = GridFit::default();
        (0..5).for_each(|at| diagonal.add(at.into(), at.into(), DVec2::splat(at.into())));
        assert_eq!(diagonal.grid(), None);
    }
}
