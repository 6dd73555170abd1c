//! Fields, and meshes that are not height fields.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use antumbra_terrain::{Field, FieldFault, Ground, NONE, TerrainError};
use glam::DVec3;
use proptest::prelude::*;

fn faults(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<FieldFault> {
    let points = points.iter().map(|&point| DVec3::from(point)).collect();
    match Field::new(points, triangles.to_vec()) {
        Err(TerrainError::NotAHeightField { faults, total }) => {
            assert_eq!(faults.len(), total.min(10));
            faults
        }
        other => panic!("{other:?}"),
    }
}

const SQUARE: [[f64; 3]; 4] = [
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 2.0],
    [1.0, 1.0, 3.0],
    [0.0, 1.0, 4.0],
];

#[test]
fn a_field_knows_its_neighbours_and_its_border() {
    let field = support::shaken(3, 10.0, 20.0, 1);
    assert_eq!(field.points().len(), 81);
    assert_eq!(field.triangles().len(), 128);
    // Euler: vertices - edges + triangles = 1 for a disc.
    assert_eq!(81 + 128 - field.edges().len(), 1);
    for half_edge in 0..3 * 128 {
        let opposite = field.opposite(half_edge);
        if opposite != NONE {
            assert_eq!(field.opposite(opposite), half_edge);
            assert_eq!(field.start(half_edge), field.end(opposite));
        }
    }
    let boundary = field.boundary();
    assert_eq!(boundary.rings.len(), 1);
    assert_eq!(boundary.rings[0].len(), 32);
    assert!(boundary.convex);
    for pair in boundary.rings[0].windows(2) {
        assert_eq!(field.end(pair[0]), field.start(pair[1]));
    }
}

#[test]
fn fields_far_from_zero_keep_their_places() {
    let far = DVec3::new(732_441.25, 4_061_870.5, 1000.0);
    let points = SQUARE.map(|point| DVec3::from(point) + far);
    let field = Field::new(points.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    for (given, kept) in points.iter().zip([0, 1, 2, 3]) {
        assert_eq!(field.point(kept) + field.origin(), *given);
    }
    assert!(field.points().iter().all(|point| point.length() < 10.0));
}

#[test]
fn triangles_that_all_look_down_are_turned_and_corners_at_one_place_made_one() {
    let mut points = SQUARE.to_vec();
    points.extend([SQUARE[0], SQUARE[2], [9.0, 9.0, 9.0]]);
    let points = points.into_iter().map(DVec3::from).collect();
    let field = Field::new(points, vec![[0, 2, 1], [4, 3, 5]]).unwrap();
    assert_eq!(field.points().len(), 4);
    assert_eq!(field.edges().len(), 5);
}

#[test]
fn holes_and_dents_are_seen_in_the_outline() {
    let whole = support::shaken(3, 10.0, 20.0, 2);
    let without = |dropped: &dyn Fn([DVec3; 3]) -> bool| {
        let triangles = (0..128).filter(|&triangle| !dropped(whole.corners(triangle)));
        let triangles = triangles.map(|triangle| whole.triangles()[triangle as usize]);
        Field::new(whole.points().to_vec(), triangles.collect()).unwrap()
    };
    let hole = without(&|corners| {
        corners
            .iter()
            .all(|corner| corner.truncate().length() < 20.0)
    });
    assert_eq!(hole.boundary().rings.len(), 2);
    assert!(!hole.boundary().convex);
    let dent = without(&|corners| {
        corners
            .iter()
            .all(|corner| corner.x > 15.0 && corner.y > 15.0)
    });
    assert_eq!(dent.boundary().rings.len(), 1);
    assert!(!dent.boundary().convex);
}

#[test]
fn every_fault_is_named_with_its_place() {
    let mut wall = SQUARE.to_vec();
    wall[3] = [0.5, 0.0, 7.0];
    let at = DVec3::new(0.5, 0.0, 10.0 / 3.0);
    let vertical = FieldFault::Vertical { triangle: 1, at };
    assert_eq!(faults(&wall, &[[0, 1, 2], [0, 1, 3]]), [vertical]);

    let mut cliff = SQUARE.to_vec();
    cliff.push([1.0, 1.0, 30.0]);
    let at = DVec3::new(1.0, 1.0, 3.0);
    let two = FieldFault::TwoHeights { at, other: 30.0 };
    assert_eq!(faults(&cliff, &[[0, 1, 2], [0, 4, 3]]), [two]);

    let mut nowhere = SQUARE.to_vec();
    nowhere[2][2] = f64::NAN;
    assert!(matches!(
        faults(&nowhere, &[[0, 1, 2], [0, 2, 9]])[..],
        [
            FieldFault::Nowhere { corner: 2, .. },
            FieldFault::NoSuchCorner {
                triangle: 1,
                corner: 9
            }
        ]
    ));

    let flipped = faults(&SQUARE, &[[0, 1, 2], [0, 3, 2], [0, 1, 3]]);
    assert!(matches!(
        flipped[..],
        [FieldFault::Flipped { triangle: 1, .. }]
    ));

    let overhang = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, 5.0],
        [2.0, 1.0, 5.0],
        [1.0, 2.0, 5.0],
    ];
    let above = faults(&overhang, &[[0, 1, 2], [3, 4, 5]]);
    assert!(matches!(
        above[..],
        [FieldFault::Overhang {
            triangles: [0, 1],
            ..
        }]
    ));

    let three = faults(&SQUARE, &[[0, 1, 2], [0, 1, 3]]);
    assert!(matches!(three[..], [FieldFault::Fan { triangle: 1, .. }]));

    let point = faults(&SQUARE, &[[0, 1, 2], [3, 3, 3]]);
    assert!(matches!(point[..], [FieldFault::Empty { triangle: 1, .. }]));

    let none = Field::new(Vec::new(), Vec::new()).unwrap_err();
    assert!(none.to_string().contains("at least one"), "{none}");
    let text = Field::new(wall.into_iter().map(DVec3::from).collect(), vec![[0, 1, 3]]);
    let text = text.unwrap_err().to_string();
    assert!(
        text.contains("vertical wall") && text.contains("0.5"),
        "{text}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn the_ground_is_below_every_place_of_a_triangle(seed in 0_u64..1000, u in 0.01..0.98_f64, v in 0.01..0.98_f64) {
        let field = support::shaken(3, 10.0, 20.0, seed);
        let ground = Ground::new(&field);
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        for triangle in 0..128 {
            let [a, b, c] = field.corners(triangle);
            let point = a + (b - a) * u + (c - a) * v;
            let surface = ground.surface_at(&field, point.truncate()).unwrap();
            prop_assert!((surface.height - point.z).abs() < 1e-9);
            let highest = ground.highest_near(&field, point.truncate(), 3.0).unwrap();
            for corner in field.corners(triangle) {
                if (corner - point).truncate().abs().max_element() <= 3.0 {
                    prop_assert!(highest >= corner.z - 1e-9);
                }
            }
            prop_assert!(highest >= point.z - 1e-9);
        }
        let [low, high] = field.plan_bounds();
        prop_assert!(ground.surface_at(&field, low - 1.0).is_none());
        prop_assert!(ground.surface_at(&field, high + 1.0).is_none());
    }
}
