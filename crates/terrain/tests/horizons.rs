//! Horizons compared with lines of sight, and with their definitions.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use antumbra_terrain::{Field, Horizon, Horizons, LineOfSight, Method, Scope, Sectors};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Horizons in `sectors` sectors of `parts` sub-sectors, with one reach.
fn find(field: &Field, sectors: [u32; 2], method: Method, scope: Scope) -> Horizons {
    find_within(field, sectors, 1, method, scope)
}

fn find_within(
    field: &Field,
    [sectors, parts]: [u32; 2],
    reaches: u32,
    method: Method,
    scope: Scope,
) -> Horizons {
    let sectors = Sectors::new(sectors, parts).unwrap();
    let sectors = sectors.with_reaches(reaches).unwrap();
    Horizons::find(field, sectors, method, scope, &|| ())
}

/// Counts of pairs of a vertex and a camera: hidden ones, those of them that a table finds, and those that it culls wrongly.
#[derive(Debug, Default)]
struct Tally {
    hidden: usize,
    found: usize,
    wrong: usize,
}

fn tally(field: &Field, horizons: &Horizons, pairs: usize, seed: u64) -> Tally {
    let line_of_sight = LineOfSight::new(field);
    let mut rng = Pcg32::seed_from_u64(seed);
    let vertices = field.points().len() as u32;
    let mut tally = Tally::default();
    for _ in 0..pairs {
        let vertex = rng.next_u32() % vertices;
        let below = field.point(rng.next_u32() % vertices);
        let up = [0.5, 2.0, 20.0, 100.0][(rng.next_u32() % 4) as usize];
        let aside = DVec2::new(support::number(&mut rng), support::number(&mut rng)) - 0.5;
        let camera = below + (aside * 3.0).extend(up);
        let blocked = line_of_sight.is_blocked(field.point(vertex), camera);
        let culled = horizons.hides_vertex(field, vertex, camera);
        tally.hidden += usize::from(blocked);
        tally.found += usize::from(blocked && culled);
        tally.wrong += usize::from(!blocked && culled);
    }
    tally
}

#[test]
fn sound_horizons_cull_nothing_visible_and_find_most_of_what_is_hidden() {
    let field = support::shaken(5, 30.0, 200.0, 42);
    for (sectors, least) in [([8, 4], 0.55), ([16, 16], 0.7), ([64, 4], 0.8)] {
        let horizons = find(&field, sectors, Method::Sound, Scope::Vertices);
        let points = tally(&field, &horizons, 20_000, 1);
        assert_eq!(points.wrong, 0, "{sectors:?}");
        let share = points.found as f64 / points.hidden as f64;
        assert!(share > least, "{sectors:?}: {share}");
        let horizons = find(&field, sectors, Method::Sound, Scope::Surface);
        assert_eq!(tally(&field, &horizons, 2_000, 2).wrong, 0, "{sectors:?}");
        let edges = tally_edges(&field, &horizons, 20_000, 1);
        assert_eq!(edges.wrong, 0, "{sectors:?}");
        let share = edges.found as f64 / edges.hidden as f64;
        assert!(share > 0.6 * least, "{sectors:?}: {share}");
    }
}

#[test]
fn horizons_of_several_reaches_find_more_and_cull_nothing_visible() {
    let field = support::shaken(5, 30.0, 300.0, 42);
    let [near, far] = [4, 1].map(|reaches| {
        let scope = Scope::Surface;
        let horizons = find_within(&field, [16, 4], reaches, Method::Sound, scope);
        let points = tally(&field, &horizons, 20_000, 1);
        let edges = tally_edges(&field, &horizons, 20_000, 1);
        assert_eq!([points.wrong, edges.wrong], [0, 0], "{reaches}");
        [points.found, edges.found]
    });
    assert!(near[0] * 20 > far[0] * 21, "{near:?} {far:?}");
    assert!(near[1] > far[1], "{near:?} {far:?}");
}

#[test]
fn a_reach_holds_the_highest_of_what_is_nearer() {
    let field = support::shaken(4, 30.0, 120.0, 6);
    let sectors = Sectors::new(16, 1).unwrap().with_reaches(3).unwrap();
    let horizons = Horizons::find(&field, sectors, Method::Rays, Scope::Vertices, &|| ());
    let [low, high] = field.plan_bounds();
    for vertex in 0..field.points().len() as u32 {
        for (sector, reach) in (0..16).flat_map(|sector| (0..3).map(move |reach| (sector, reach))) {
            let most = sectors.reach_distance(reach, (high - low).length());
            let found = horizons.of_vertex(vertex, sector, reach);
            match steepest(&field, vertex, sectors.sub_sector_middle(sector, 0), most) {
                Some(Crossing { slope, .. }) => {
                    assert!(
                        (f64::from(found.slope) - slope).abs() < 1e-5,
                        "{found:?} {slope}"
                    );
                    assert!(f64::from(found.distance) < most + 0.01, "{found:?} {most}");
                }
                None => assert_eq!(found, Horizon::OPEN),
            }
        }
    }
}

/// The share of an edge at each end that is not tested: an end belongs to other edges too, and may be visible where the terrain that hides the
/// rest begins at it.
const BETWEEN: f64 = 1e-4;

/// Whether one of seven points of an edge is visible, `inset` from its ends, and just beside the edge as well: along a boundary, rounding decides
/// whether anything is in the way.
fn is_seen(
    field: &Field,
    line_of_sight: &LineOfSight<'_>,
    edge: u32,
    camera: DVec3,
    inset: f64,
) -> bool {
    let ends = field.ends(field.edges()[edge as usize]);
    let beside = (ends[1] - ends[0])
        .truncate()
        .normalize()
        .perp()
        .extend(0.0)
        * 1e-6;
    (0..=6)
        .map(|step| inset + (1.0 - 2.0 * inset) * f64::from(step) / 6.0)
        .map(|share| ends[0].lerp(ends[1], share))
        .any(|point| {
            [-1.0, 0.0, 1.0]
                .into_iter()
                .all(|side| !line_of_sight.is_blocked(point + beside * side, camera))
        })
}

/// As [`tally`], for edges.
fn tally_edges(field: &Field, horizons: &Horizons, pairs: usize, seed: u64) -> Tally {
    let line_of_sight = LineOfSight::new(field);
    let mut rng = Pcg32::seed_from_u64(seed);
    let mut tally = Tally::default();
    for _ in 0..pairs {
        let edge = rng.next_u32() % field.edges().len() as u32;
        let ends = field.ends(field.edges()[edge as usize]);
        let below = field.point(rng.next_u32() % field.points().len() as u32);
        let camera = below + DVec3::Z * [0.5, 2.0, 20.0, 100.0][(rng.next_u32() % 4) as usize];
        let away = ends.map(|end| (camera - end).truncate());
        let [first, last] = away.map(|away| horizons.sectors().containing(away));
        if first != last {
            continue;
        }
        let culled = horizons.hides_edge(field, edge, camera);
        let seen = is_seen(field, &line_of_sight, edge, camera, 0.0);
        tally.hidden += usize::from(!seen);
        tally.found += usize::from(!seen && culled);
        tally.wrong += usize::from(culled && is_seen(field, &line_of_sight, edge, camera, BETWEEN));
    }
    tally
}

#[test]
fn the_thesis_culls_what_is_visible_where_sectors_are_wide() {
    let field = support::shaken(5, 30.0, 200.0, 42);
    let horizons = find(&field, [8, 1], Method::Thesis, Scope::Vertices);
    let wide = tally(&field, &horizons, 20_000, 1);
    assert!(wide.wrong > 100, "{wide:?}");
    let horizons = find(&field, [8, 8], Method::Thesis, Scope::Vertices);
    let narrow = tally(&field, &horizons, 20_000, 1);
    assert!(narrow.wrong * 10 < wide.wrong, "{narrow:?} {wide:?}");
}

/// A crossing of a line and an edge.
struct Crossing {
    slope: f64,
    distance: f64,
}

/// The crossing with the greatest slope, along a direction from a vertex, within `most` metres.
fn steepest(field: &Field, vertex: u32, direction: DVec2, most: f64) -> Option<Crossing> {
    let from = field.point(vertex);
    let crossings = field.edges().iter().filter_map(|&half| {
        let [a, b] = field.ends(half);
        let [left, right] = [a, b].map(|end| direction.perp_dot((end - from).truncate()));
        if left * right > 0.0 || left == right {
            return None;
        }
        let at = a.lerp(b, left / (left - right)) - from;
        let distance = direction.dot(at.truncate());
        let slope = at.z / distance;
        (distance > 0.01 && distance <= most).then_some(Crossing { slope, distance })
    });
    crossings.max_by(|a, b| a.slope.total_cmp(&b.slope))
}

#[test]
fn rays_find_the_steepest_line_of_all() {
    let field = support::shaken(4, 30.0, 120.0, 3);
    let sectors = Sectors::new(37, 1).unwrap();
    let horizons = Horizons::find(&field, sectors, Method::Rays, Scope::Vertices, &|| ());
    for vertex in 0..field.points().len() as u32 {
        for sector in 0..37 {
            let found = horizons.of_vertex(vertex, sector, 0);
            match steepest(
                &field,
                vertex,
                sectors.sub_sector_middle(sector, 0),
                f64::INFINITY,
            ) {
                Some(Crossing { slope, distance }) => {
                    assert!(
                        (f64::from(found.slope) - slope).abs() < 1e-5,
                        "{found:?} {slope}"
                    );
                    let same = (f64::from(found.distance) - distance).abs() < 0.01;
                    assert!(same, "{found:?} {distance}");
                }
                None => assert_eq!(found, Horizon::OPEN),
            }
        }
    }
}

#[test]
fn the_thesis_finds_the_highest_vertex_of_each_sub_sector() {
    let field = support::shaken(4, 30.0, 120.0, 4);
    let sectors = Sectors::new(8, 3).unwrap();
    let horizons = Horizons::find(&field, sectors, Method::Thesis, Scope::Vertices, &|| ());
    for vertex in 0..field.points().len() as u32 {
        let from = field.point(vertex);
        for sector in 0..8 {
            let mut lowest = f64::INFINITY;
            for part in 0..3 {
                let [first, last] =
                    [part, part + 1].map(|part| sectors.sub_sector_start(sector, part));
                let middle = sectors.sub_sector_middle(sector, part);
                let others = (0..field.points().len() as u32).filter(|&other| other != vertex);
                // By the order along the ends, as in the method, so that rounding decides the same way for both.
                let beside = |direction: DVec2, to: DVec3| {
                    direction.perp_dot(to.truncate()) - direction.perp_dot(from.truncate())
                };
                let inside = others
                    .map(|other| field.point(other))
                    .filter(|&to| beside(first, to) >= 0.0 && beside(last, to) <= 0.0);
                let steep = inside.map(|to| {
                    (to.z - from.z) / (middle.dot(to.truncate()) - middle.dot(from.truncate()))
                });
                lowest = lowest.min(steep.fold(f64::NEG_INFINITY, f64::max));
            }
            let found = f64::from(horizons.of_vertex(vertex, sector, 0).slope);
            assert!(
                found == lowest || (found - lowest).abs() < 1e-5,
                "{found} {lowest}"
            );
        }
    }
}

#[test]
fn the_same_field_has_the_same_horizons() {
    let field = support::shaken(4, 30.0, 120.0, 5);
    for method in Method::ALL {
        let [first, second] =
            [(), ()].map(|()| find_within(&field, [16, 4], 3, method, Scope::Surface));
        assert!(first == second);
        let reaches = if method == Method::Thesis { 1 } else { 3 };
        assert_eq!(first.sectors().reaches(), reaches);
    }
}

/// Fields with special cases for rounding and geometry.
fn awkward(kind: u32, seed: u64) -> Field {
    let mut heights = support::fractal(4, 0.5, seed);
    let side = heights.len();
    let each = |heights: &mut Vec<Vec<f64>>, height: &dyn Fn(usize, usize) -> f64| {
        for (row, line) in heights.iter_mut().enumerate() {
            for (column, place) in line.iter_mut().enumerate() {
                *place = height(row, column);
            }
        }
    };
    match kind {
        0 => each(&mut heights, &|_, _| 1.0),
        1 => each(&mut heights, &|row, column| 0.1 * (row + 2 * column) as f64),
        2 => each(&mut heights, &|row, _| f64::from(row == side / 2)),
        3 => each(&mut heights, &|row, column| f64::from(row > column)),
        4 => each(&mut heights, &|row, column| {
            ((row / 3 + column / 3) % 2) as f64
        }),
        _ => {}
    }
    let regular = support::grid(&heights, 30.0, 120.0);
    match kind {
        // A cliff: one edge of a square moved to almost nothing.
        5 => {
            let points = regular.points().iter().map(|&point| {
                let high = point.x > 0.0;
                let x = if high { point.x - 29.999 } else { point.x };
                DVec3::new(x, point.y, point.z + f64::from(high) * 300.0)
            });
            Field::new(points.collect(), regular.triangles().to_vec()).unwrap()
        }
        6 => {
            let far = DVec3::new(732_441.123, 4_061_870.456, 812.7);
            let points = regular.points().iter().map(|&point| point * 0.01 + far);
            Field::new(points.collect(), regular.triangles().to_vec()).unwrap()
        }
        7 => {
            let triangles = regular.triangles().iter().filter(|corners| {
                corners
                    .iter()
                    .any(|&corner| regular.point(corner).truncate().length() > 70.0)
            });
            Field::new(regular.points().to_vec(), triangles.copied().collect()).unwrap()
        }
        8 => Field::new(
            vec![
                DVec3::ZERO,
                DVec3::new(9.0, 0.0, 4.0),
                DVec3::new(0.0, 9.0, 1.0),
            ],
            vec![[0, 1, 2]],
        )
        .unwrap(),
        _ => regular,
    }
}

/// Whether a camera is above the surface: horizons say nothing about positions below it.
fn is_above(field: &Field, camera: DVec3) -> bool {
    let below = antumbra_terrain::Ground::new(field).surface_at(field, camera.truncate());
    below.is_none_or(|below| below.height < camera.z)
}

/// Checks that vertices and edges of an awkward field that their horizons hide are not visible from random cameras.
fn is_sound(
    kind: u32,
    seed: u64,
    sectors: usize,
    reaches: u32,
    scope: Scope,
) -> Result<(), TestCaseError> {
    let field = awkward(kind, seed);
    let sectors = [[4, 1], [8, 3], [16, 4]][sectors];
    let horizons = find_within(&field, sectors, reaches, Method::Sound, scope);
    let line_of_sight = LineOfSight::new(&field);
    let mut rng = Pcg32::seed_from_u64(seed);
    let vertices = field.points().len() as u32;
    let size = (field.plan_bounds()[1] - field.plan_bounds()[0]).length();
    for _ in 0..2000 {
        let vertex = rng.next_u32() % vertices;
        // Straight above a vertex, and so in line with edges, or anywhere.
        let below = field.point(rng.next_u32() % vertices);
        let mut camera = below + DVec3::Z * size * 0.05 * support::number(&mut rng);
        if rng.next_u32().is_multiple_of(2) {
            let aside = DVec2::new(support::number(&mut rng), support::number(&mut rng)) - 0.5;
            camera += (aside * size * 0.1).extend(0.0);
        }
        if horizons.hides_vertex(&field, vertex, camera) && is_above(&field, camera) {
            let blocked = line_of_sight.is_blocked(field.point(vertex), camera);
            prop_assert!(
                blocked,
                "vertex {vertex} at {} is seen from {camera}",
                field.point(vertex)
            );
        }
        let edge = rng.next_u32() % field.edges().len() as u32;
        if scope == Scope::Surface
            && horizons.hides_edge(&field, edge, camera)
            && is_above(&field, camera)
        {
            let seen = is_seen(&field, &line_of_sight, edge, camera, BETWEEN);
            prop_assert!(!seen, "edge {edge} is seen from {camera}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn awkward_fields_have_sound_horizons(kind in 0_u32..10, seed in 0_u64..1000, sectors in 0_usize..3, reaches in 1_u32..5, surface: bool) {
        let scope = if surface { Scope::Surface } else { Scope::Vertices };
        is_sound(kind, seed, sectors, reaches, scope)?;
    }
}

#[test]
fn an_edge_may_be_hidden_up_to_an_end_that_is_seen() {
    // Another edge at the same end hides the edge. The end itself lies in front of it.
    is_sound(7, 611, 0, 1, Scope::Surface).unwrap();
}
