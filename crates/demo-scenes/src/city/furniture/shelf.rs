//! Bookcases and books.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;

pub(in crate::city) const BOOKCASE: Prefab = Prefab {
    name: "bookcase",
    material: MaterialKind::Wood,
    make: bookcase,
};
pub(in crate::city) const BOOKS: Prefab = Prefab {
    name: "books",
    material: MaterialKind::Red,
    make: || books(3),
};
pub(in crate::city) const OTHER_BOOKS: Prefab = Prefab {
    name: "other books",
    material: MaterialKind::Blue,
    make: || books(8),
};

/// Half the width, and the heights of the upper sides of the shelves.
const HALF: f64 = 0.5;
const SHELVES: [f64; 6] = [0.1, 0.46, 0.82, 1.16, 1.49, 1.82];
const DEEP: f64 = 0.32;

fn bookcase() -> Solid {
    let mut solid = Solid::default();
    for x in [-HALF, HALF - 0.025] {
        solid.rounded_box([x, 0.0, 0.0], [x + 0.025, 2.15, DEEP], 0.004, 1);
    }
    for y in SHELVES {
        solid.rounded_box(
            [-HALF + 0.02, y - 0.025, 0.01],
            [HALF - 0.02, y, DEEP - 0.01],
            0.006,
            1,
        );
    }
    solid.rounded_box(
        [-HALF - 0.02, 2.14, -0.001],
        [HALF + 0.02, 2.18, 0.35],
        0.012,
        1,
    );
    solid.cuboid([-HALF + 0.02, 0.02, 0.004], [HALF - 0.02, 2.15, 0.012]);
    solid.cuboid([-HALF + 0.02, 0.0, 0.26], [HALF - 0.02, 0.08, 0.28]);
    solid
}

/// Rows of books of different height and thickness.
fn books(first: u32) -> Solid {
    let mut solid = Solid::default();
    let mut number = first;
    // A generator of its own, so that books are the same in every city.
    let mut next = |of: u32| {
        number = (number * 73 + 41) % 1009;
        f64::from(number % of) / f64::from(of)
    };
    for y in SHELVES {
        let mut x = -HALF + 0.035;
        let end = HALF - 0.05 - 0.3 * next(7);
        while x < end {
            let thick = 0.028 + 0.046 * next(11);
            let high = 0.2 + 0.09 * next(13);
            let deep = 0.15 + 0.07 * next(5);
            let back = 0.02 + 0.02 * next(3);
            let (left, right) = (x, x + thick);
            let low = [left, y - 0.001, back];
            solid.cuboid(low, [right, y + high, back + deep]);
            x = right + 0.0015;
        }
    }
    solid
}
