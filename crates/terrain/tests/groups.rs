//! Groups: those that an observer does not see are compared with lines of sight to points all over them.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use antumbra_terrain::{
    AzimuthRange, Circle, Crystals, Field, GroupHierarchy, GroupOptions, Horizon, Horizons,
    LineOfSight, Method, NONE, Observer, Region, Scope, Sectors, VertexHorizon,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn options() -> GroupOptions {
    GroupOptions {
        seeds: 60,
        max_groups: 200,
        min_triangles: 4,
        ..GroupOptions::for_triangles(2048)
    }
}

fn built(field: &Field, sectors: Sectors, method: Method) -> (Horizons, GroupHierarchy) {
    let horizons = Horizons::find(field, sectors, method, Scope::Surface, &|| ());
    let groups = GroupHierarchy::build(field, &horizons, &options()).unwrap();
    (horizons, groups)
}

/// Which triangles are drawn for an observer.
fn drawn(groups: &GroupHierarchy, eye: DVec3, azimuths: AzimuthRange) -> Vec<bool> {
    let mut drawn = vec![false; groups.order().len()];
    let mut draw = |triangles: std::ops::Range<u32>| {
        for at in triangles {
            drawn[groups.order()[at as usize] as usize] = true;
        }
    };
    Observer::new(groups, eye, azimuths)
        .each_visible(|group| draw(groups.groups()[group as usize].triangles.clone()));
    draw(groups.ungrouped());
    drawn
}

#[test]
fn no_place_of_a_hidden_group_is_seen() {
    let field = support::ridged(5, 30.0, 150.0, 42);
    let line_of_sight = LineOfSight::new(&field);
    let culled = [1, 3].map(|reaches| {
        let sectors = Sectors::new(32, 4).unwrap().with_reaches(reaches).unwrap();
        let (_, groups) = built(&field, sectors, Method::Sound);
        count_culled(&field, &line_of_sight, &groups)
    });
    // Crystals grow by the first reach, so the groups are similar.
    assert!(culled[1] > culled[0], "{culled:?}");
}

/// The number of triangles that are culled from random viewpoints. None of them is visible.
fn count_culled(field: &Field, line_of_sight: &LineOfSight<'_>, groups: &GroupHierarchy) -> usize {
    let mut rng = Pcg32::seed_from_u64(1);
    let (mut culled, mut hidden) = (0, 0);
    for _ in 0..30 {
        let below = field.point(rng.next_u32() % field.points().len() as u32);
        let eye = below + DVec3::Z * (0.5 + 20.0 * support::number(&mut rng));
        for (triangle, drawn) in drawn(groups, eye, AzimuthRange::ALL)
            .into_iter()
            .enumerate()
        {
            let points = support::points(field, triangle as u32, &mut rng);
            let visible = points
                .iter()
                .any(|&point| !line_of_sight.is_blocked(eye, point));
            assert!(drawn || !visible, "triangle {triangle} is seen from {eye}");
            culled += usize::from(!drawn);
            hidden += usize::from(!visible);
        }
    }
    assert!(culled * 20 > hidden, "{culled} of {hidden}");
    culled
}

/// A wall with a notch narrower than any triangle behind it.
fn notched() -> Field {
    let points = [
        [-300, -2100, 0],
        [300, -2100, 0],
        [-300, 0, 50],
        [-5, 0, 50],
        [0, 0, 0],
        [5, 0, 50],
        [300, 0, 50],
        [-100, 20, 0],
        [100, 20, 0],
        [-100, 60, 0],
        [100, 60, 0],
    ];
    let triangles = [
        [0, 1, 4],
        [0, 4, 3],
        [0, 3, 2],
        [1, 6, 5],
        [1, 5, 4],
        [4, 8, 7],
        [3, 4, 7],
        [2, 3, 7],
        [4, 5, 8],
        [5, 6, 8],
        [7, 8, 10],
        [7, 10, 9],
    ];
    let points = points.map(|at| DVec3::from(at.map(f64::from)));
    Field::new(points.to_vec(), triangles.to_vec()).unwrap()
}

#[test]
fn a_triangle_seen_between_its_hidden_corners_is_drawn() {
    let field = notched();
    let behind = |at: DVec3| at.y + field.origin().y >= 20.0;
    let eye = DVec3::new(0.0, -2000.0, 100.0) - field.origin();
    let place = DVec3::new(0.0, 21.0, 0.0) - field.origin();
    assert!(!LineOfSight::new(&field).is_blocked(eye, place));
    let alone = GroupOptions {
        seeds: 12,
        max_groups: 12,
        min_triangles: 1,
        ..options()
    };
    let [corners, sound] = [Method::Rays, Method::Sound].map(|method| {
        let sectors = Sectors::new(32, 4).unwrap();
        let horizons = Horizons::find(&field, sectors, method, Scope::Surface, &|| ());
        let groups = GroupHierarchy::build(&field, &horizons, &alone).unwrap();
        let drawn = drawn(&groups, eye, AzimuthRange::ALL);
        (0..12)
            .filter(|&triangle| field.corners(triangle).into_iter().all(behind))
            .map(|triangle| drawn[triangle as usize])
            .collect::<Vec<_>>()
    });
    // All corners are hidden. Horizons of corners alone draw neither of the two triangles behind.
    assert_eq!(corners, [false, false]);
    assert!(sound.contains(&true), "{sound:?}");
}

#[test]
fn whoever_looks_one_way_sees_no_less_of_it() {
    let field = support::shaken(4, 30.0, 150.0, 7);
    let line_of_sight = LineOfSight::new(&field);
    let (_, groups) = built(&field, Sectors::new(16, 4).unwrap(), Method::Sound);
    let mut rng = Pcg32::seed_from_u64(2);
    for _ in 0..50 {
        let below = field.point(rng.next_u32() % field.points().len() as u32);
        let eye = below + DVec3::Z * 3.0;
        let around = drawn(&groups, eye, AzimuthRange::ALL);
        let middle = DVec2::from_angle(support::number(&mut rng) * 7.0);
        let half = support::number(&mut rng) * 2.0;
        let ahead = drawn(&groups, eye, AzimuthRange::around(middle, half));
        for (triangle, (around, ahead)) in around.into_iter().zip(ahead).enumerate() {
            let within = support::points(&field, triangle as u32, &mut rng)
                .iter()
                .filter(|point| middle.angle_to((*point - eye).truncate()).abs() <= half)
                .any(|&point| !line_of_sight.is_blocked(eye, point));
            assert!(ahead || !around || !within, "triangle {triangle}");
        }
    }
}

#[test]
fn groups_hold_every_triangle_once_and_their_parts() {
    let field = support::shaken(5, 30.0, 300.0, 11);
    let (_, groups) = built(&field, Sectors::new(8, 2).unwrap(), Method::Sound);
    let mut order = groups.order().to_vec();
    order.sort_unstable();
    assert!(order.into_iter().eq(0..2048));
    let mut parents = vec![0; groups.groups().len()];
    for (number, group) in groups.groups().iter().enumerate() {
        let corners = groups.order()[group.triangles.start as usize..group.triangles.end as usize]
            .iter()
            .flat_map(|&triangle| field.corners(triangle));
        for corner in corners {
            let distance = corner.truncate().distance(group.circle.middle);
            assert!(distance <= group.circle.radius);
            assert!((group.heights[0]..=group.heights[1]).contains(&corner.z));
        }
        if let [first, second] = group.children
            && !group.is_leaf()
        {
            let [a, b] = [first, second].map(|child| groups.groups()[child as usize].clone());
            assert_eq!(a.triangles.start, group.triangles.start);
            assert_eq!(a.triangles.end, b.triangles.start);
            assert_eq!(b.triangles.end, group.triangles.end);
            parents[first as usize] += 1;
            parents[second as usize] += 1;
            assert!(first as usize > number && second as usize > number);
        } else {
            assert!(group.triangles.len() >= 4);
        }
    }
    // Each group has one parent or is a root.
    for &root in groups.roots() {
        parents[root as usize] += 1;
    }
    assert!(parents.into_iter().all(|parents| parents == 1));
    let covered: usize = groups
        .roots()
        .iter()
        .map(|&root| groups.groups()[root as usize].triangles.len())
        .sum();
    assert_eq!(covered, groups.ungrouped().start as usize);
}

#[test]
fn crystals_stay_on_their_side_of_a_ridge() {
    let mut heights = vec![vec![0.0; 33]; 33];
    for (row, line) in heights.iter_mut().enumerate() {
        line.fill(300.0 - 20.0 * (row as f64 - 16.0).abs());
    }
    let field = support::grid(&heights, 30.0, 1.0);
    let sectors = Sectors::new(16, 4).unwrap();
    let horizons = Horizons::find(&field, sectors, Method::Sound, Scope::Surface, &|| ());
    let few = GroupOptions {
        seeds: 6,
        ..options()
    };
    let crystals = Crystals::grow(&field, &horizons, &few).unwrap();
    let middle_north = |triangle: usize| {
        field
            .corners(triangle as u32)
            .iter()
            .map(|corner| corner.y)
            .sum::<f64>()
            / 3.0
    };
    let mut sides = vec![[0_u32; 2]; crystals.count as usize];
    for (triangle, &group) in crystals
        .group_of
        .iter()
        .enumerate()
        .filter(|(_, group)| **group != NONE)
    {
        sides[group as usize][usize::from(middle_north(triangle) > 0.0)] += 1;
    }
    // A few triangles extend over the crest.
    let of_one_side = |[south, north]: &[u32; 2]| south.min(north) * 10 <= *south.max(north);
    assert!(sides.iter().all(of_one_side), "{sides:?}");
}

#[test]
fn the_same_seed_grows_the_same_groups_and_bad_numbers_are_refused() {
    let field = support::shaken(4, 30.0, 150.0, 9);
    let sectors = Sectors::new(8, 2).unwrap();
    let (horizons, first) = built(&field, sectors, Method::Sound);
    let second = GroupHierarchy::build(&field, &horizons, &options()).unwrap();
    assert!(first == second);
    let other = GroupOptions {
        seed: 2,
        ..options()
    };
    assert!(first != GroupHierarchy::build(&field, &horizons, &other).unwrap());
    for bad in [
        GroupOptions {
            seeds: 0,
            ..options()
        },
        GroupOptions {
            max_groups: 3,
            ..options()
        },
        GroupOptions {
            max_area_share: f64::NAN,
            ..options()
        },
        GroupOptions {
            max_area_share: 0.0,
            ..options()
        },
    ] {
        let error = GroupHierarchy::build(&field, &horizons, &bad)
            .unwrap_err()
            .to_string();
        assert!(error.contains("give"), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn what_a_region_hides_is_hidden_from_each_of_its_vertices(seed in 0_u64..10_000, count in 1_usize..60) {
        let mut rng = Pcg32::seed_from_u64(seed);
        let sectors = Sectors::new(8, 1).unwrap();
        let mut number = |low: f64, high: f64| low + (high - low) * support::number(&mut rng);
        let vertices: Vec<VertexHorizon> = (0..count)
            .map(|_| {
                let point = DVec3::new(number(-500.0, 500.0), number(-500.0, 500.0), number(0.0, 200.0));
                let horizon = Horizon {
                    slope: number(-0.5, 0.8) as f32,
                    distance: number(1.0, 900.0) as f32,
                };
                VertexHorizon { point, horizon }
            })
            .collect();
        let region = Region::of_vertices(vertices.clone(), &sectors, 3);
        let halves: Vec<Region> = [&vertices[..count / 2], &vertices[count / 2..]]
            .into_iter()
            .filter(|half| !half.is_empty())
            .map(|half| Region::of_vertices(half.to_vec(), &sectors, 3))
            .collect();
        let both = Region::intersection(&halves);
        let circle = Circle::enclosing(&vertices.iter().map(|vertex| vertex.point.truncate()).collect::<Vec<_>>());
        for _ in 0..400 {
            let eye = DVec3::new(number(-6000.0, 1000.0), number(-1000.0, 6000.0), number(-500.0, 800.0));
            // Seen from all vertices, the viewpoint is in the sector.
            let inside = vertices.iter().all(|vertex| sectors.containing((eye - vertex.point).truncate()) == Some(3));
            prop_assert!(circle.radius < 1000.0);
            let along = sectors.sector_middle(3).dot(eye.truncate());
            for region in [&region, &both] {
                if inside && region.contains(along, eye.z) {
                    for VertexHorizon { point, horizon } in &vertices {
                        let to = eye - *point;
                        prop_assert!(horizon.hides(to.truncate().length(), to.z));
                    }
                }
            }
        }
    }
}
