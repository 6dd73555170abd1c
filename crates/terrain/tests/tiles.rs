//! Terrain in tiles: what they hide together, compared with visibility by brute force over the whole.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::collections::HashMap;
use std::sync::{Arc, LazyLock};

use antumbra_scene::{Material, Scene};
use antumbra_terrain::{
    AzimuthRange, Field, GroupOptions, Horizons, Method, Scope, Sectors, Terrain, TerrainOptions,
    TerrainTiles, Tile,
};
use glam::{DVec3, Vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use support::brute_force::BruteForce;

/// The distance of the near plane, metres.
const NEAR: f64 = 0.2;

static ISLAND: LazyLock<Field> =
    LazyLock::new(|| support::island(5, 30.0, 150.0, 1).rounded().unwrap());

/// Four tiles, without and with a margin.
static TILES: LazyLock<[Vec<Arc<Terrain>>; 2]> = LazyLock::new(|| [0.0, 250.0].map(cut));

fn cut(margin: f64) -> Vec<Arc<Terrain>> {
    let tiles = ISLAND.cut_into_tiles(2, 2, margin).unwrap();
    tiles
        .into_iter()
        .map(|tile| Arc::new(prepared(tile)))
        .collect()
}

fn prepared(tile: Tile) -> Terrain {
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: 150,
            max_groups: 300,
            min_triangles: 1,
            ..GroupOptions::for_triangles(512)
        }),
        ..TerrainOptions::default()
    };
    Terrain::prepare_tile(tile, &options, &|| ()).unwrap()
}

/// Viewpoints over the land, outside, and over the lines between tiles.
fn eyes(count: usize, seed: u64) -> Vec<DVec3> {
    let mut rng = Pcg32::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low + support::number(&mut rng) * (high - low);
    let eye = |kind: usize| match kind % 3 {
        0 => DVec3::new(
            between(-450.0, 450.0),
            between(-450.0, 450.0),
            between(0.0, 160.0),
        ),
        1 => DVec3::new(between(-2000.0, 2000.0), 500.0, between(-100.0, 200.0)),
        _ => DVec3::new(0.0, between(-450.0, 450.0), between(0.0, 160.0)),
    };
    (0..count).map(eye).collect()
}

/// The number of triangles that are culled. None of those that are compared may be visible.
fn culled(tiles: &TerrainTiles, eyes: &[DVec3]) -> usize {
    let fields = || tiles.terrains().iter().map(|terrain| terrain.field());
    let brute_force = BruteForce::of(fields());
    let mut rng = Pcg32::seed_from_u64(5);
    let mut culled = 0;
    for &at in eyes {
        let each = tiles.observers(at + ISLAND.origin(), AzimuthRange::ALL, NEAR);
        for (terrain, observer) in tiles.terrains().iter().zip(each) {
            let Some(observer) = observer else { continue };
            for triangle in support::culled(terrain, &observer) {
                culled += 1;
                if rng.next_u32() % 4 > 0 {
                    continue;
                }
                let shift = terrain.field().origin() - ISLAND.origin();
                for point in support::points(terrain.field(), triangle, &mut rng) {
                    let hidden = brute_force.hides(at, point + shift, NEAR);
                    assert!(hidden, "triangle {triangle} is seen from {at}");
                }
            }
        }
    }
    culled
}

#[test]
fn a_field_is_cut_into_all_its_triangles_and_blocks_know_their_neighbours() {
    let tiles = ISLAND.cut_into_tiles(3, 2, 100.0).unwrap();
    assert_eq!(tiles.len(), 6);
    let own: usize = tiles.iter().map(Tile::own_triangles).sum();
    assert_eq!(own, ISLAND.triangles().len());
    let mut corners = Vec::new();
    for tile in &tiles {
        assert_eq!(tile.field().origin(), ISLAND.origin());
        assert!(tile.own_triangles() < tile.field().triangles().len());
        corners.extend(
            (0..tile.own_triangles() as u32).map(|triangle| tile.field().corners(triangle)),
        );
    }
    let sorted_len = |corners: &mut Vec<[DVec3; 3]>| {
        corners.sort_by(|a, b| a[0].to_array().partial_cmp(&b[0].to_array()).unwrap());
        corners.len()
    };
    let expected: Vec<[DVec3; 3]> = (0..ISLAND.triangles().len() as u32)
        .map(|triangle| ISLAND.corners(triangle))
        .collect();
    assert!(expected.iter().all(|triangle| corners.contains(triangle)));
    assert_eq!(sorted_len(&mut corners), expected.len());
    // Together they have the boundary of the whole, which is convex.
    let tiles = TerrainTiles::join(TILES[0].clone());
    assert_eq!(
        tiles.boundary().edges().len(),
        ISLAND.boundary().rings[0].len()
    );
    assert!(tiles.boundary().is_convex());
    for bad in [
        ISLAND.cut_into_tiles(0, 1, 0.0),
        ISLAND.cut_into_tiles(1, 5000, 0.0),
        ISLAND.cut_into_tiles(1, 1, f64::NAN),
    ] {
        let error = bad.unwrap_err().to_string();
        assert!(error.contains("give"), "{error}");
    }
}

#[test]
fn a_block_with_a_margin_as_wide_as_the_field_has_the_horizons_of_the_whole() {
    let tile = ISLAND.cut_into_tiles(2, 1, 2000.0).unwrap().swap_remove(1);
    let sectors = Sectors::new(16, 4).unwrap();
    let find =
        |field: &Field| Horizons::find(field, sectors, Method::Sound, Scope::Vertices, &|| ());
    let [whole, wide] = [&*ISLAND, tile.field()].map(find);
    let mut claims = 0;
    for (vertex, point) in tile.field().points().iter().enumerate() {
        let same = ISLAND
            .points()
            .iter()
            .position(|other| other == point)
            .unwrap();
        for sector in 0..16 {
            let [a, b] = [
                whole.of_vertex(same as u32, sector, 0),
                wide.of_vertex(vertex as u32, sector, 0),
            ];
            claims += usize::from(a.slope.is_finite());
            assert!(
                a.slope == b.slope || (a.slope - b.slope).abs() < 0.05,
                "{a:?} {b:?}"
            );
        }
    }
    assert!(claims > 1000);
}

#[test]
fn blocks_cull_nothing_that_is_seen_and_more_with_a_margin() {
    let eyes = eyes(24, 1);
    let [bare, wide] = [0, 1].map(|margin| {
        let tiles = TerrainTiles::join(TILES[margin].clone());
        assert!((0..4).all(|tile| tiles.has_whole_margin(tile)));
        culled(&tiles, &eyes)
    });
    let whole = Arc::new(prepared(Tile::whole(ISLAND.clone())));
    let whole = culled(&TerrainTiles::join(vec![whole]), &eyes);
    assert!(bare > 500, "{bare} {wide} {whole}");
    assert!(wide * 10 > bare * 12, "{bare} {wide} {whole}");
    assert!(wide * 10 > whole * 7, "{bare} {wide} {whole}");
}

#[test]
fn where_blocks_meet_light_goes_on() {
    let steps = |tiles: &[Arc<Terrain>]| {
        let mut scene = Scene::new();
        let material = scene.add_material(Material::default());
        let mut normals: HashMap<[u32; 3], Vec3> = HashMap::new();
        let mut steps = 0;
        for tile in tiles {
            let shown = tile.show(&mut scene, material).unwrap();
            for group in shown.groups {
                let mesh = scene.drawable(group.entity).unwrap().mesh;
                let geometry = &scene.mesh(mesh).unwrap().levels[0];
                for (at, normal) in geometry.positions.iter().zip(&geometry.normals) {
                    let normal = Vec3::from(*normal);
                    let other = *normals.entry(at.map(f32::to_bits)).or_insert(normal);
                    steps += usize::from(other.distance(normal) > 1e-5);
                }
            }
        }
        steps
    };
    assert!(steps(&TILES[0]) > 10);
    assert_eq!(steps(&TILES[1]), 0);
}

#[test]
fn a_block_is_believed_only_beside_all_that_it_rests_on() {
    let eyes = eyes(24, 2);
    for (margin, sure) in [(0, [true; 3]), (1, [false; 3])] {
        let some = TerrainTiles::join(TILES[margin][..3].to_vec());
        assert_eq!([0, 1, 2].map(|tile| some.has_whole_margin(tile)), sure);
        assert!(!some.boundary().is_convex());
        let found = culled(&some, &eyes);
        assert_eq!(found > 0, sure[0], "{found}");
    }
    let alone = &TILES[1][0];
    assert!(
        alone
            .observer(DVec3::Z * 5000.0, AzimuthRange::ALL, NEAR)
            .is_none()
    );
    // A tile without a margin depends on no other, even alone or apart.
    let [first, last] = [0, 3].map(|tile| TILES[0][tile].clone());
    assert!(culled(&TerrainTiles::join(vec![first.clone()]), &eyes) > 0);
    assert!(culled(&TerrainTiles::join(vec![first, last]), &eyes) > 0);
}

/// What stays the same about another origin.
#[derive(Clone, Copy)]
enum Kept {
    /// The positions.
    Positions,
    /// The coordinates.
    Coordinates,
}

/// A terrain about an origin that is shifted.
fn about(field: &Field, shift: DVec3, kept: Kept) -> Arc<Terrain> {
    let back = match kept {
        Kept::Positions => shift,
        Kept::Coordinates => DVec3::ZERO,
    };
    let points = field.points().iter().map(|point| *point - back);
    let points = points.collect();
    let field = Field::with_origin(field.origin() + shift, points, field.triangles().to_vec());
    Arc::new(prepared(Tile::whole(field.unwrap())))
}

#[test]
fn blocks_about_other_origins_share_no_edge() {
    let ends = |terrains: &[Arc<Terrain>]| {
        let border = |terrain: &Arc<Terrain>| terrain.field().boundary().rings[0].len();
        terrains.iter().map(border).sum::<usize>()
    };
    let shift = DVec3::new(0.0, 512.0, 0.0);
    let halves: Vec<Arc<Terrain>> = TILES[0][..2].to_vec();
    let joined = TerrainTiles::join(halves.clone()).boundary().edges().len();
    assert!(joined < ends(&halves));
    for kept in [Kept::Positions, Kept::Coordinates] {
        let apart = vec![halves[0].clone(), about(halves[1].field(), shift, kept)];
        assert_eq!(
            TerrainTiles::join(apart.clone()).boundary().edges().len(),
            ends(&apart)
        );
    }
    let far = about(
        halves[0].field(),
        DVec3::new(9e3, 1e4, -3e3),
        Kept::Coordinates,
    );
    let island = Arc::new(prepared(Tile::whole(ISLAND.clone())));
    // The same beside another one, whose coordinates the boundary is in.
    let [alone, beside] =
        [vec![island.clone()], vec![far.clone(), island.clone()]].map(TerrainTiles::join);
    let mut seen = 0;
    for at in eyes(30, 3) {
        let last = |tiles: &TerrainTiles| {
            let observer = tiles
                .observers(at + ISLAND.origin(), AzimuthRange::ALL, NEAR)
                .last();
            observer
                .unwrap()
                .map(|observer| support::culled(&island, &observer))
        };
        let [a, b] = [&alone, &beside].map(last);
        assert_eq!(a, b);
        seen += a.map_or(0, |culled| culled.len());
    }
    assert!(seen > 1000, "{seen}");
    let high = |tiles: &TerrainTiles| tiles.highest_near(ISLAND.origin().truncate(), 2000.0);
    assert_eq!(high(&alone), high(&beside));
    let expected = ISLAND
        .points()
        .iter()
        .map(|point| point.z)
        .fold(f64::MIN, f64::max);
    assert_eq!(high(&alone), Some(expected + ISLAND.origin().z));
}
