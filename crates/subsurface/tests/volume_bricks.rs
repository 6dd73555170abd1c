//! The brick cache: every sample is correct, the budget is kept, no brick is read again without need.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod volume_rule;

use std::sync::Arc;

use antumbra_subsurface::{Axis, BrickCache, SubsurfaceError};
use proptest::prelude::*;
use proptest::sample::select;
use volume_rule::{Rule, sample_at};

fn ranges(size: u32) -> impl Strategy<Value = std::ops::Range<u32>> {
    (0..=size, 0..=size).prop_map(|(a, b)| a.min(b)..a.max(b))
}

fn sections() -> impl Strategy<Value = ([u32; 3], Axis, u32, [std::ops::Range<u32>; 2])> {
    let size = [1u32..30, 1u32..30, 1u32..30];
    (size, select(Axis::ALL.as_slice())).prop_flat_map(|(size, axis)| {
        let [right, down] = axis.plane().map(|along| ranges(along.of(size)));
        (Just(size), Just(axis), 0..axis.of(size), [right, down])
    })
}

proptest! {
    #[test]
    fn a_section_is_its_samples((size, axis, index, [right, down]) in sections(), brick in 1u32..12, room in 1usize..20) {
        let rule = Arc::new(Rule::new(size, brick));
        let budget = rule.layout.brick_bytes() * room;
        let mut bricks = BrickCache::new(rule, budget).unwrap();
        let mut got = vec![0xaa; right.len() * down.len()];
        bricks.section(axis, index, [right.clone(), down.clone()], &mut got).unwrap();
        let expected: Vec<u8> = down
            .flat_map(|v| right.clone().map(move |u| sample_at(axis.place(index, [u, v]))))
            .collect();
        prop_assert_eq!(got, expected);
        prop_assert!(bricks.stats().peak_bytes <= budget);
    }
}

#[test]
fn memory_stays_within_the_budget_and_every_sample_is_right() {
    let rule = Arc::new(Rule::new([41, 23, 37], 5));
    let brick = rule.layout.brick_bytes();
    // A volume of 9 x 5 x 8 bricks, with a budget of slightly more than a tenth of them.
    let budget = brick * 36 + brick / 2;
    let mut bricks = BrickCache::new(rule, budget).unwrap();
    for (x, y, z) in
        (0..37).flat_map(|z| (0..23).flat_map(move |y| (0..41).map(move |x| (x, y, z))))
    {
        assert_eq!(bricks.sample([x, y, z]).unwrap(), sample_at([x, y, z]));
        assert!(bricks.stats().bytes <= budget);
    }
    let stats = bricks.stats();
    assert_eq!(stats.peak_bytes, brick * 36);
    assert_eq!((stats.resident, stats.bytes), (36, brick * 36));
    assert_eq!(stats.read, stats.evicted + 36);
    assert_eq!(stats.read + stats.hits, 41 * 23 * 37);
}

#[test]
fn what_was_not_used_for_longest_goes_first() {
    let rule = Arc::new(Rule::new([8, 1, 1], 2));
    let mut bricks = BrickCache::new(rule.clone(), 16).unwrap();
    for x in [0, 2, 0, 4, 0, 2] {
        bricks.sample([x, 0, 0]).unwrap();
    }
    // 2 was evicted for 4, 0 was used between; then 4 was evicted for 2.
    assert_eq!(
        *rule.asked.lock().unwrap(),
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 0, 0]]
    );
    let stats = bricks.stats();
    assert_eq!((stats.hits, stats.evicted), (2, 2));
}

#[test]
fn a_section_reads_each_of_its_bricks_once_and_no_other() {
    let rule = Arc::new(Rule::new([40, 40, 40], 8));
    let mut bricks = BrickCache::new(rule.clone(), 512 * 9).unwrap();
    let mut samples = vec![0; 16 * 16];
    let area = [8..24, 16..32];
    bricks
        .section(Axis::Time, 7, area.clone(), &mut samples)
        .unwrap();
    assert_eq!(
        rule.take_asked(),
        [[1, 2, 0], [1, 3, 0], [2, 2, 0], [2, 3, 0]]
    );
    bricks.section(Axis::Time, 0, area, &mut samples).unwrap();
    assert!(rule.take_asked().is_empty());
    assert_eq!(bricks.stats().hits, 4);
}

#[test]
fn what_is_not_there_is_refused_and_said() {
    let mut bricks = BrickCache::new(Arc::new(Rule::new([10, 20, 30], 4)), 64).unwrap();
    let said = bricks.sample([0, 20, 0]).unwrap_err().to_string();
    assert!(
        said.contains("crossline") && said.contains("0 to 19"),
        "{said}"
    );
    let mut four = [0; 4];
    let outside = bricks.section(Axis::Inline, 10, [0..2, 0..2], &mut four);
    assert!(matches!(
        outside,
        Err(SubsurfaceError::Outside {
            axis: Axis::Inline,
            ..
        })
    ));
    let outside = bricks.section(Axis::Inline, 9, [0..2, 29..31], &mut four);
    assert!(matches!(
        outside,
        Err(SubsurfaceError::Outside {
            axis: Axis::Time,
            ..
        })
    ));
    let wrong = bricks.section(Axis::Inline, 9, [0..2, 0..3], &mut four);
    assert!(matches!(
        wrong,
        Err(SubsurfaceError::BufferLength {
            expected: 6,
            actual: 4
        })
    ));
    assert_eq!(bricks.stats().read, 0);
}

#[test]
fn a_budget_below_a_brick_is_refused() {
    let small = BrickCache::new(Arc::new(Rule::new([10; 3], 4)), 63);
    assert!(matches!(
        small.err(),
        Some(SubsurfaceError::SmallBudget {
            budget: 63,
            brick: 64
        })
    ));
}
