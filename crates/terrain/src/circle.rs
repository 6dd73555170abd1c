//! The smallest circle around places: Welzl, "Smallest Enclosing Disks (Balls and Ellipsoids)", 1991, without its recursion.

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
    /// The smallest around some places, and a little wider than rounding can make of it. Places should come in no particular order: a sorted row
    /// of `n` takes up to `n²` steps.
    #[must_use]
    pub fn around(places: &[DVec2]) -> Self {
        let mut circle = Self {
            middle: places.first().copied().unwrap_or_default(),
            radius: 0.0,
        };
        for (i, &first) in places.iter().enumerate() {
            if circle.holds(first) {
                continue;
            }
            circle = Self {
                middle: first,
                radius: 0.0,
            };
            for (j, &second) in places[..i].iter().enumerate() {
                if circle.holds(second) {
                    continue;
                }
                circle = Self::over(first, second);
                for &third in &places[..j] {
                    if !circle.holds(third) {
                        circle = Self::through([first, second, third]);
                    }
                }
            }
        }
        circle.radius *= 1.0 + 1e-9;
        circle
    }

    /// Square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }

    fn holds(&self, place: DVec2) -> bool {
        place.distance(self.middle) <= self.radius * (1.0 + 1e-10)
    }

    fn over(a: DVec2, b: DVec2) -> Self {
        Self {
            middle: (a + b) / 2.0,
            radius: a.distance(b) / 2.0,
        }
    }

    /// The circle through three places; around the farthest two of those in a row.
    fn through([a, b, c]: [DVec2; 3]) -> Self {
        let (to_b, to_c) = (b - a, c - a);
        let turn = 2.0 * to_b.perp_dot(to_c);
        let rise = DVec2::new(
            to_c.y * to_b.length_squared() - to_b.y * to_c.length_squared(),
            to_b.x * to_c.length_squared() - to_c.x * to_b.length_squared(),
        ) / turn;
        if rise.is_finite() {
            return Self {
                middle: a + rise,
                radius: [b, c].into_iter().fold(rise.length(), |radius, place| {
                    radius.max(place.distance(a + rise))
                }),
            };
        }
        let pairs = [(a, b), (a, c), (b, c)].map(|(p, q)| Self::over(p, q));
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
            let mut chance = Pcg32::seed_from_u64(seed);
            let mut number = || f64::from(chance.next_u32() % 64);
            let places: Vec<DVec2> = (0..40).map(|_| DVec2::new(number(), number())).collect();
            let circle = Circle::around(&places);
            let farthest = |middle: DVec2| {
                let far = places.iter().map(|place| place.distance(middle));
                far.fold(0.0, f64::max)
            };
            assert!(farthest(circle.middle) <= circle.radius);
            for step in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
                assert!(farthest(circle.middle + step * 0.01) >= circle.radius - 1e-6);
            }
        }
    }

    #[test]
    fn few_places_and_places_in_a_row_have_one() {
        assert_eq!(Circle::around(&[]).radius, 0.0);
        assert_eq!(Circle::around(&[DVec2::ONE]).middle, DVec2::ONE);
        let row: Vec<DVec2> = (0..10).map(|i| DVec2::splat(f64::from(i))).collect();
        let circle = Circle::around(&row);
        assert!(circle.middle.distance(DVec2::splat(4.5)) < 1e-9);
    }
}
