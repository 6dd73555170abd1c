//! The smallest enclosing circle of points: Welzl, "Smallest Enclosing Disks (Balls and Ellipsoids)", 1991, in its iterative form.

use glam::DVec2;

/// A circle in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Its middle, metres.
    pub middle: DVec2,
    /// Its radius, metres.
    pub radius: f64,
}

impl Circle {
    /// The smallest circle around some points, widened by a billionth for rounding. Give the points in random order: `n` sorted points take
    /// up to `n²` steps.
    #[must_use]
    pub fn enclosing(points: &[DVec2]) -> Self {
        let mut circle = Self {
            middle: points.first().copied().unwrap_or_default(),
            radius: 0.0,
        };
        for (i, &first) in points.iter().enumerate() {
            if circle.contains(first) {
                continue;
            }
            circle = Self {
                middle: first,
                radius: 0.0,
            };
            for (j, &second) in points[..i].iter().enumerate() {
                if circle.contains(second) {
                    continue;
                }
                circle = Self::with_diameter(first, second);
                for &third in &points[..j] {
                    if !circle.contains(third) {
                        circle = Self::through([first, second, third]);
                    }
                }
            }
        }
        circle.radius *= 1.0 + 1e-9;
        circle
    }

    /// Its area, square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }

    fn contains(&self, point: DVec2) -> bool {
        point.distance(self.middle) <= self.radius * (1.0 + 1e-10)
    }

    fn with_diameter(a: DVec2, b: DVec2) -> Self {
        Self {
            middle: (a + b) / 2.0,
            radius: a.distance(b) / 2.0,
        }
    }

    /// The circle through three points. Of collinear points, the circle around the two that are farthest apart.
    fn through([a, b, c]: [DVec2; 3]) -> Self {
        let (to_b, to_c) = (b - a, c - a);
        let turn = 2.0 * to_b.perp_dot(to_c);
        let offset = DVec2::new(
            to_c.y * to_b.length_squared() - to_b.y * to_c.length_squared(),
            to_b.x * to_c.length_squared() - to_c.x * to_b.length_squared(),
        ) / turn;
        if offset.is_finite() {
            return Self {
                middle: a + offset,
                radius: [b, c].into_iter().fold(offset.length(), |radius, point| {
                    radius.max(point.distance(a + offset))
                }),
            };
        }
        let pairs = [(a, b), (a, c), (b, c)].map(|(p, q)| Self::with_diameter(p, q));
        pairs.into_iter().fold(pairs[0], |widest, pair| {
            if pair.radius > widest.radius {
                pair
            } else {
                widest
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg32;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    #[test]
    fn no_circle_around_all_is_smaller() {
        for seed in 0..200 {
            let mut rng = Pcg32::seed_from_u64(seed);
            let mut number = || f64::from(rng.next_u32() % 64);
            let points: Vec<DVec2> = (0..40).map(|_| DVec2::new(number(), number())).collect();
            let circle = Circle::enclosing(&points);
            let farthest = |middle: DVec2| {
                let distances = points.iter().map(|point| point.distance(middle));
                distances.fold(0.0, f64::max)
            };
            assert!(farthest(circle.middle) <= circle.radius);
            for step in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
                assert!(farthest(circle.middle + step * 0.01) >= circle.radius - 1e-6);
            }
        }
    }

    #[test]
    fn few_places_and_places_in_a_row_have_one() {
        assert_eq!(Circle::enclosing(&[]).radius, 0.0);
        assert_eq!(Circle::enclosing(&[DVec2::ONE]).middle, DVec2::ONE);
        let line: Vec<DVec2> = (0..10).map(|i| DVec2::splat(f64::from(i))).collect();
        let circle = Circle::enclosing(&line);
        assert!(circle.middle.distance(DVec2::splat(4.5)) < 1e-9);
    }
}
