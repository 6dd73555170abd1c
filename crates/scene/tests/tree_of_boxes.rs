//! The bounding volume hierarchy: each leaf occurs once, every box contains its children after insertions, removals
//! and moves, and invalid trees are rejected.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::Aabb;
use antumbra_scene::hierarchy::{
    GroupTree, GroupedLeaf, Hierarchy, HierarchyError, HierarchyShape, NONE,
};
use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// A leaf in a group.
fn grouped_leaf(leaf: u32, group: u32) -> GroupedLeaf {
    GroupedLeaf { leaf, group }
}

fn cube(at: DVec3, half: f64) -> Aabb {
    Aabb::from_centre(at, DVec3::splat(half))
}

/// Whether the tree is valid and contains exactly these leaves.
fn check(tree: &Hierarchy, leaves: &BTreeMap<u32, Aabb>) {
    let mut found = Vec::new();
    for (node, number) in tree.nodes().iter().zip(0u32..) {
        let below: Vec<u32> = tree.leaves_below(number).collect();
        if node.is_leaf() {
            let own: Vec<u32> = tree.leaf(number).into_iter().collect();
            assert_eq!(own, below);
            for leaf in own {
                assert_eq!(tree.node_of(leaf), Some(number));
                assert_eq!(node.bounds, leaves[&leaf]);
                found.push(leaf);
            }
            continue;
        }
        assert!(node.children().len() >= 2);
        let mut of_children = Vec::new();
        let mut around = Aabb::EMPTY;
        for child in node.children() {
            let inner = tree.node(child).unwrap();
            assert!(child > number && inner.parent == number);
            around = around.union(&inner.bounds);
            of_children.extend(tree.leaves_below(child));
        }
        assert_eq!(around, node.bounds);
        assert_eq!(of_children, below);
    }
    found.sort_unstable();
    assert_eq!(found, leaves.keys().copied().collect::<Vec<_>>());
    let mut rooted: Vec<u32> = tree.roots().flat_map(|r| tree.leaves_below(r)).collect();
    rooted.sort_unstable();
    assert_eq!(rooted, found);
}

prop_compose! {
    fn boxes()(at in prop::array::uniform3(-100.0..100.0f64), half in 0.0..4.0f64) -> Aabb {
        cube(DVec3::from_array(at), half)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn every_shape_holds_everything_once_and_keeps_doing_so(
        around in prop::collection::vec(any::<prop::sample::Index>(), 0..12),
        placed in prop::collection::vec((boxes(), any::<prop::sample::Index>(), any::<bool>()), 0..80),
        later in prop::collection::vec((0..100u32, prop::option::of(boxes())), 0..40),
        shape in prop::sample::select(HierarchyShape::ALL.to_vec()),
    ) {
        // The parent of a group is a group before it, or none.
        let groups: Vec<u32> = around.iter().enumerate().map(|(i, at)| match at.index(i + 1) {
            0 => NONE,
            before => before as u32 - 1,
        }).collect();
        let mut leaves = BTreeMap::new();
        let mut hung = Vec::new();
        for ((bounds, group, grouped), leaf) in placed.iter().zip((0u32..).step_by(2)) {
            let group = if *grouped && !groups.is_empty() { group.index(groups.len()) as u32 } else { NONE };
            hung.push(grouped_leaf(leaf, group));
            leaves.insert(leaf, *bounds);
        }
        let branches = GroupTree { groups: &groups, leaves: &hung };
        let mut tree = Hierarchy::new(branches, shape, |leaf| leaves[&leaf]).unwrap();
        check(&tree, &leaves);
        for change in later.chunks(7) {
            tree.refit(change.iter().map(|(leaf, bounds)| (*leaf, bounds.unwrap_or(Aabb::EMPTY))));
            for (leaf, bounds) in change {
                match bounds {
                    Some(bounds) => leaves.insert(*leaf, *bounds),
                    None => leaves.remove(leaf),
                };
            }
            check(&tree, &leaves);
        }
    }
}

#[test]
fn a_flat_scene_is_divided_and_a_nested_one_is_not() {
    let leaves: Vec<GroupedLeaf> = (0..1000).map(|leaf| grouped_leaf(leaf, NONE)).collect();
    let bounds = |leaf: u32| {
        cube(
            DVec3::new(
                f64::from(leaf % 10),
                f64::from(leaf / 100),
                f64::from(leaf / 10 % 10),
            ),
            0.4,
        )
    };
    let widest = |shape| {
        let branches = GroupTree {
            groups: &[],
            leaves: &leaves,
        };
        let tree = Hierarchy::new(branches, shape, bounds).unwrap();
        let widest = tree.nodes().iter().map(|node| node.children().len()).max();
        (
            widest.unwrap(),
            tree.nodes()
                .iter()
                .map(|node| node.bounds.half_extents().element_product())
                .sum::<f64>(),
        )
    };
    assert_eq!(widest(HierarchyShape::Groups).0, 1000);
    let (children, _) = widest(HierarchyShape::Divided);
    assert!(children <= HierarchyShape::MAX_UNDIVIDED);
    assert_eq!(widest(HierarchyShape::Divided), widest(HierarchyShape::Bvh));
    // Eight leaves of each group do not change.
    let nested: Vec<GroupedLeaf> = (0..80).map(|leaf| grouped_leaf(leaf, leaf % 10)).collect();
    let branches = GroupTree {
        groups: &[NONE; 10],
        leaves: &nested,
    };
    let tree = Hierarchy::new(branches, HierarchyShape::Divided, bounds).unwrap();
    assert_eq!(tree.nodes().len(), 1 + 10 + 80);
}

#[test]
fn neighbours_come_together() {
    // Two distant clouds of leaves, alternating.
    let leaves: Vec<GroupedLeaf> = (0..64).map(|leaf| grouped_leaf(leaf, NONE)).collect();
    let bounds = |leaf: u32| {
        cube(
            DVec3::new(f64::from(leaf % 2) * 1e6, f64::from(leaf), 0.0),
            0.5,
        )
    };
    let tree = Hierarchy::new(
        GroupTree {
            groups: &[],
            leaves: &leaves,
        },
        HierarchyShape::Bvh,
        bounds,
    )
    .unwrap();
    let root = tree.node(0).unwrap();
    for child in root.children() {
        assert!(tree.node(child).unwrap().bounds.half_extents().x < 1e3);
    }
}

#[test]
fn a_hundred_thousand_deep_is_no_deeper_than_another() {
    let deep = 100_000u32;
    // A chain with one leaf at its end, and a comb with a leaf at every step.
    let groups: Vec<u32> = (0..deep)
        .map(|i| i.checked_sub(1).unwrap_or(NONE))
        .collect();
    let bounds = |leaf: u32| cube(DVec3::X * f64::from(leaf), 1.0);
    let chain = GroupTree {
        groups: &groups,
        leaves: &[grouped_leaf(7, deep - 1)],
    };
    let tree = Hierarchy::new(chain, HierarchyShape::Divided, bounds).unwrap();
    assert_eq!(tree.nodes().len(), 1);
    let hung: Vec<GroupedLeaf> = (0..deep).map(|leaf| grouped_leaf(leaf, leaf)).collect();
    let comb = GroupTree {
        groups: &groups,
        leaves: &hung,
    };
    let mut tree = Hierarchy::new(comb, HierarchyShape::Groups, bounds).unwrap();
    assert_eq!(tree.nodes().len(), deep as usize * 2 - 1);
    assert_eq!(tree.leaves_below(0).count(), deep as usize);
    tree.refit([(deep - 1, cube(DVec3::NEG_X, 5.0))]);
    assert_eq!(tree.node(0).unwrap().bounds.min.x, -6.0);
}

#[test]
fn what_is_no_tree_is_refused_by_number() {
    let fine = |_| cube(DVec3::ZERO, 1.0);
    let refused = |groups: &[u32], leaves: &[(u32, u32)]| {
        let leaves: Vec<_> = leaves.iter().map(|at| grouped_leaf(at.0, at.1)).collect();
        let leaves = &leaves;
        Hierarchy::new(GroupTree { groups, leaves }, HierarchyShape::Divided, fine).unwrap_err()
    };
    assert_eq!(refused(&[0], &[]), HierarchyError::Cycle { group: 0 });
    // 3 and 4 are parents of each other; 0 is a child of 3 and not part of the cycle.
    let error = refused(&[3, NONE, 1, 4, 3], &[(0, 0)]);
    assert!(
        matches!(error, HierarchyError::Cycle { group: 3 | 4 }),
        "{error}"
    );
    assert!(error.to_string().contains("lies within itself"));
    assert!(matches!(
        refused(&[NONE], &[(5, 1)]),
        HierarchyError::UnknownGroup {
            what: "leaf",
            number: 5,
            group: 1,
            groups: 1
        }
    ));
    assert!(matches!(
        refused(&[9], &[]),
        HierarchyError::UnknownGroup { what: "group", .. }
    ));
    assert_eq!(
        refused(&[NONE], &[(5, 0), (5, NONE)]),
        HierarchyError::DuplicateLeaf { leaf: 5 }
    );
    for bad in [
        Aabb {
            min: DVec3::ONE,
            max: DVec3::ZERO,
        },
        Aabb {
            min: DVec3::NAN,
            max: DVec3::ONE,
        },
        Aabb {
            min: DVec3::ZERO,
            max: DVec3::INFINITY,
        },
    ] {
        let branches = GroupTree {
            groups: &[],
            leaves: &[grouped_leaf(3, NONE)],
        };
        let error = Hierarchy::new(branches, HierarchyShape::Bvh, |_| bad).unwrap_err();
        assert!(
            matches!(error, HierarchyError::InvalidBounds { leaf: 3, .. }),
            "{error}"
        );
    }
    // An empty tree is valid.
    let branches = GroupTree {
        groups: &[NONE, 0],
        leaves: &[grouped_leaf(3, 1)],
    };
    let tree = Hierarchy::new(branches, HierarchyShape::Divided, |_| Aabb::EMPTY).unwrap();
    assert_eq!((tree.nodes().len(), tree.roots().count()), (0, 0));
}

#[test]
fn it_says_when_it_is_worn() {
    let leaves: Vec<GroupedLeaf> = (0..1000).map(|leaf| grouped_leaf(leaf, NONE)).collect();
    let bounds = |leaf: u32| cube(DVec3::X * f64::from(leaf), 0.5);
    let make = || {
        Hierarchy::new(
            GroupTree {
                groups: &[],
                leaves: &leaves,
            },
            HierarchyShape::Bvh,
            bounds,
        )
        .unwrap()
    };
    let mut tree = make();
    tree.refit((0..10).map(|leaf| (leaf, cube(DVec3::X * f64::from(leaf), 0.6))));
    assert!(!tree.needs_rebuild());
    tree.refit((0..200).map(|leaf| (leaf + 1000, bounds(leaf))));
    assert!(tree.needs_rebuild());
    let mut tree = make();
    tree.refit((0..200).map(|leaf| (leaf, Aabb::EMPTY)));
    assert!(tree.needs_rebuild());
    let mut tree = make();
    tree.refit((0..1000).map(|leaf| (leaf, bounds(leaf * 7919 % 1000))));
    assert!(tree.needs_rebuild());
}

#[test]
fn many_equal_boxes_are_no_endless_work() {
    let many = 100_000_u32;
    let leaves: Vec<GroupedLeaf> = (0..many).map(|leaf| grouped_leaf(leaf, NONE)).collect();
    let all = GroupTree {
        groups: &[],
        leaves: &leaves,
    };
    let tree = Hierarchy::new(all, HierarchyShape::Bvh, |_| cube(DVec3::ONE, 2.0)).unwrap();
    assert_eq!(tree.leaves_below(0).count(), many as usize);
    // The boxes themselves are what they were.
    let same = |node: u32| tree.node(node).unwrap().bounds == cube(DVec3::ONE, 2.0);
    assert!((0..tree.nodes().len() as u32).all(same));
}
