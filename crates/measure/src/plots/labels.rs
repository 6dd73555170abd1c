//! Places labels beside points without overlaps: each label takes the first free position around its point, near ones first.
//!
//! The greedy placement is that of Jon Christensen, Joe Marks and Stuart Shieber, "An Empirical Study of Algorithms for Point-Feature Label
//! Placement", 1995.

/// A rectangle of the sheet: left, top, right, bottom.
pub(super) type Box4 = [i32; 4];

/// A point that gets a label.
#[derive(Debug, Clone, Copy)]
pub(super) struct Labelled {
    /// The point.
    pub(super) at: (i32, i32),
    /// The label's width.
    pub(super) width: i32,
}

/// The position of a label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    /// Its left edge.
    pub(super) left: i32,
    /// Its vertical middle.
    pub(super) middle: i32,
    /// Whether it is so far away that a line must connect it with its point.
    pub(super) far: bool,
}

/// Places labels of one `height`, inside of `bounds` and off the `obstacles`. `radius` is that of the points' marks.
pub(super) fn place(
    points: &[Labelled],
    height: i32,
    radius: i32,
    bounds: Box4,
    obstacles: &[Box4],
) -> Vec<Place> {
    let mark = |(x, y): (i32, i32)| [x - radius, y - radius, x + radius, y + radius];
    let mut taken: Vec<Box4> = points.iter().map(|point| mark(point.at)).collect();
    taken.extend_from_slice(obstacles);
    points
        .iter()
        .map(|&Labelled { at: point, width }| {
            let candidates = candidates(point, width, height, radius);
            let worth = |place: &Place| {
                let own = [
                    place.left,
                    place.middle - height / 2,
                    place.left + width,
                    place.middle + height / 2,
                ];
                let outside = area(own) - overlap(own, bounds);
                let hidden: i64 = taken.iter().map(|other| overlap(own, *other)).sum();
                // Text beyond the edge is lost, while overlapping text may still be readable.
                4 * outside + hidden
            };
            // The first of the best, since near positions come first.
            let best = candidates.min_by_key(worth).unwrap_or(Place {
                left: point.0,
                middle: point.1,
                far: false,
            });
            taken.push([
                best.left,
                best.middle - height / 2,
                best.left + width,
                best.middle + height / 2,
            ]);
            best
        })
        .collect()
}

fn candidates(
    (x, y): (i32, i32),
    width: i32,
    height: i32,
    radius: i32,
) -> impl Iterator<Item = Place> {
    (0..14).flat_map(move |ring| {
        let away = radius + radius / 2 + ring * height * 3 / 4;
        let rise = if ring == 0 { 0 } else { away };
        let far = ring > 1;
        let at = move |left, middle| Place { left, middle, far };
        [
            at(x + away.min(radius * 3), y - rise),
            at(x + away.min(radius * 3), y + rise),
            at(x - width - away.min(radius * 3), y - rise),
            at(x - width - away.min(radius * 3), y + rise),
            at(x - width / 2, y - away - height / 2),
            at(x - width / 2, y + away + height / 2),
        ]
    })
}

fn area([left, top, right, bottom]: Box4) -> i64 {
    i64::from((right - left).max(0)) * i64::from((bottom - top).max(0))
}

fn overlap(a: Box4, b: Box4) -> i64 {
    area([
        a[0].max(b[0]),
        a[1].max(b[1]),
        a[2].min(b[2]),
        a[3].min(b[3]),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_crowded_points_do_not_overlap() {
        let bounds = [0, 0, 1600, 900];
        // Nine strategies at almost the same speed and error.
        let points: Vec<_> = (0..9)
            .map(|i| Labelled {
                at: (800 + i * 6, 450 + (i % 3) * 4),
                width: 200,
            })
            .collect();
        let boxes: Vec<Box4> = place(&points, 32, 12, bounds, &[])
            .iter()
            .map(|p| [p.left, p.middle - 16, p.left + 200, p.middle + 16])
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            assert_eq!(overlap(*a, bounds), area(*a), "label {i} leaves the sheet");
            for (j, b) in boxes.iter().enumerate().skip(i + 1) {
                assert_eq!(overlap(*a, *b), 0, "labels {i} and {j}");
            }
        }
    }

    #[test]
    fn a_lone_label_stands_to_the_right_and_at_the_edge_to_the_left() {
        let bounds = [0, 0, 1000, 500];
        let at = |x| {
            let point = Labelled {
                at: (x, 250),
                width: 200,
            };
            place(&[point], 32, 12, bounds, &[])[0]
        };
        assert_eq!(
            at(500),
            Place {
                left: 518,
                middle: 250,
                far: false
            }
        );
        assert_eq!(
            at(990),
            Place {
                left: 990 - 218,
                middle: 250,
                far: false
            }
        );
    }
}
