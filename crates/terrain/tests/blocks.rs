//! Terrain in blocks: what they hide together, against the truth of the whole.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::collections::HashMap;
use std::sync::{Arc as Shared, LazyLock};

use antumbra_scene::{Material, Scene};
use antumbra_terrain::{
    Arc, Blocks, Field, GroupOptions, Horizons, Method, Part, Scope, Sectors, Terrain,
    TerrainOptions,
};
use glam::{DVec3, Vec3};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};

use support::truth::Truth;

/// How near to the eye nothing is drawn, metres.
const NEAR: f64 = 0.2;

static ISLAND: LazyLock<Field> =
    LazyLock::new(|| support::island(5, 30.0, 150.0, 1).rounded().unwrap());

/// Four blocks without and with a margin.
static BLOCKS: LazyLock<[Vec<Shared<Terrain>>; 2]> = LazyLock::new(|| [0.0, 250.0].map(cut));

fn cut(margin: f64) -> Vec<Shared<Terrain>> {
    let parts = ISLAND.cut(2, 2, margin).unwrap();
    parts
        .into_iter()
        .map(|part| Shared::new(prepared(part)))
        .collect()
}

fn prepared(part: Part) -> Terrain {
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: 150,
            most: 300,
            smallest: 1,
            ..GroupOptions::for_triangles(512)
        }),
        ..TerrainOptions::default()
    };
    Terrain::prepare_part(part, &options, &|| ()).unwrap()
}

/// Eyes over the land, outside, and over the lines between blocks.
fn eyes(count: usize, seed: u64) -> Vec<DVec3> {
    let mut chance = Pcg32::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low + support::number(&mut chance) * (high - low);
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

/// How many triangles are culled; none of those that are held against the truth may be seen.
fn culled(blocks: &Blocks, eyes: &[DVec3]) -> usize {
    let fields = || blocks.terrains().iter().map(|terrain| terrain.field());
    let truth = Truth::of(fields());
    let mut chance = Pcg32::seed_from_u64(5);
    let mut culled = 0;
    for &at in eyes {
        let each = blocks.eyes(at + ISLAND.origin(), Arc::ALL, NEAR);
        for (terrain, eye) in blocks.terrains().iter().zip(each) {
            let Some(eye) = eye else { continue };
            for triangle in support::culled(terrain, &eye) {
                culled += 1;
                if chance.next_u32() % 4 > 0 {
                    continue;
                }
                let shift = terrain.field().origin() - ISLAND.origin();
                for place in support::places(terrain.field(), triangle, &mut chance) {
                    let place = place + shift;
                    let hidden = truth.hides(at, place, NEAR);
                    assert!(hidden, "triangle {triangle} is seen from {at}");
                }
            }
        }
    }
    culled
}

#[test]
fn a_field_is_cut_into_all_its_triangles_and_blocks_know_their_neighbours() {
    let parts = ISLAND.cut(3, 2, 100.0).unwrap();
    assert_eq!(parts.len(), 6);
    let own: usize = parts.iter().map(Part::own).sum();
    assert_eq!(own, ISLAND.triangles().len());
    let mut corners = Vec::new();
    for part in &parts {
        assert_eq!(part.field().origin(), ISLAND.origin());
        assert!(part.own() < part.field().triangles().len());
        corners.extend((0..part.own() as u32).map(|triangle| part.field().corners(triangle)));
    }
    let all = |corners: &mut Vec<[DVec3; 3]>| {
        corners.sort_by(|a, b| a[0].to_array().partial_cmp(&b[0].to_array()).unwrap());
        corners.len()
    };
    let truth: Vec<[DVec3; 3]> = (0..ISLAND.triangles().len() as u32)
        .map(|triangle| ISLAND.corners(triangle))
        .collect();
    assert!(truth.iter().all(|triangle| corners.contains(triangle)));
    assert_eq!(all(&mut corners), truth.len());
    // Together they have the border of the whole, and that is whole.
    let blocks = Blocks::join(BLOCKS[0].clone());
    assert_eq!(blocks.rim().edges().len(), ISLAND.outline().rings[0].len());
    assert!(blocks.rim().is_whole());
    for bad in [
        ISLAND.cut(0, 1, 0.0),
        ISLAND.cut(1, 5000, 0.0),
        ISLAND.cut(1, 1, f64::NAN),
    ] {
        let error = bad.unwrap_err().to_string();
        assert!(error.contains("give"), "{error}");
    }
}

#[test]
fn a_block_with_a_margin_as_wide_as_the_field_has_the_horizons_of_the_whole() {
    let part = ISLAND.cut(2, 1, 2000.0).unwrap().swap_remove(1);
    let sectors = Sectors::new(16, 4).unwrap();
    let find =
        |field: &Field| Horizons::find(field, sectors, Method::Sound, Scope::Vertices, &|| ());
    let [whole, wide] = [&*ISLAND, part.field()].map(find);
    let mut claims = 0;
    for (vertex, point) in part.field().points().iter().enumerate() {
        let same = ISLAND
            .points()
            .iter()
            .position(|other| other == point)
            .unwrap();
        for sector in 0..16 {
            let [a, b] = [
                whole.at(same as u32, sector, 0),
                wide.at(vertex as u32, sector, 0),
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
        let blocks = Blocks::join(BLOCKS[margin].clone());
        assert!((0..4).all(|block| blocks.is_sure(block)));
        culled(&blocks, &eyes)
    });
    let whole = Shared::new(prepared(Part::whole(ISLAND.clone())));
    let whole = culled(&Blocks::join(vec![whole]), &eyes);
    assert!(bare > 500, "{bare} {wide} {whole}");
    assert!(wide * 10 > bare * 12, "{bare} {wide} {whole}");
    assert!(wide * 10 > whole * 7, "{bare} {wide} {whole}");
}

#[test]
fn where_blocks_meet_light_goes_on() {
    let steps = |blocks: &[Shared<Terrain>]| {
        let mut scene = Scene::new();
        let material = scene.add_material(Material::default());
        let mut normals: HashMap<[u32; 3], Vec3> = HashMap::new();
        let mut steps = 0;
        for block in blocks {
            let shown = block.show(&mut scene, material).unwrap();
            for (entity, _) in shown.groups {
                let mesh = scene.drawable(entity).unwrap().mesh;
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
    assert!(steps(&BLOCKS[0]) > 10);
    assert_eq!(steps(&BLOCKS[1]), 0);
}

#[test]
fn a_block_is_believed_only_beside_all_that_it_rests_on() {
    let eyes = eyes(24, 2);
    for (margin, sure) in [(0, [true; 3]), (1, [false; 3])] {
        let some = Blocks::join(BLOCKS[margin][..3].to_vec());
        assert_eq!([0, 1, 2].map(|block| some.is_sure(block)), sure);
        assert!(!some.rim().is_whole());
        let found = culled(&some, &eyes);
        assert_eq!(found > 0, sure[0], "{found}");
    }
    let alone = &BLOCKS[1][0];
    assert!(alone.eye(DVec3::Z * 5000.0, Arc::ALL, NEAR).is_none());
    // Without a margin each stands for itself, even alone, or apart.
    let [first, last] = [0, 3].map(|block| BLOCKS[0][block].clone());
    assert!(culled(&Blocks::join(vec![first.clone()]), &eyes) > 0);
    assert!(culled(&Blocks::join(vec![first, last]), &eyes) > 0);
}

/// The same place, or the same numbers, about an origin elsewhere.
fn about(field: &Field, shift: DVec3, stays: bool) -> Shared<Terrain> {
    let back = if stays { shift } else { DVec3::ZERO };
    let points = field.points().iter().map(|point| *point - back);
    let points = points.collect();
    let field = Field::about(field.origin() + shift, points, field.triangles().to_vec());
    Shared::new(prepared(Part::whole(field.unwrap())))
}

#[test]
fn blocks_about_other_origins_share_no_edge() {
    let ends = |terrains: &[Shared<Terrain>]| {
        let border = |terrain: &Shared<Terrain>| terrain.field().outline().rings[0].len();
        terrains.iter().map(border).sum::<usize>()
    };
    let shift = DVec3::new(0.0, 512.0, 0.0);
    let halves: Vec<Shared<Terrain>> = BLOCKS[0][..2].to_vec();
    let joined = Blocks::join(halves.clone()).rim().edges().len();
    assert!(joined < ends(&halves));
    for stays in [true, false] {
        let apart = vec![halves[0].clone(), about(halves[1].field(), shift, stays)];
        assert_eq!(
            Blocks::join(apart.clone()).rim().edges().len(),
            ends(&apart)
        );
    }
    let far = about(halves[0].field(), DVec3::new(9e3, 1e4, -3e3), false);
    let island = Shared::new(prepared(Part::whole(ISLAND.clone())));
    // The same from beside another, in whose coordinates the rims are.
    let [alone, beside] =
        [vec![island.clone()], vec![far.clone(), island.clone()]].map(Blocks::join);
    let mut seen = 0;
    for at in eyes(30, 3) {
        let last = |blocks: &Blocks| {
            let eye = blocks.eyes(at + ISLAND.origin(), Arc::ALL, NEAR).last();
            eye.unwrap().map(|eye| support::culled(&island, &eye))
        };
        let [a, b] = [&alone, &beside].map(last);
        assert_eq!(a, b);
        seen += a.map_or(0, |culled| culled.len());
    }
    assert!(seen > 1000, "{seen}");
    let high = |blocks: &Blocks| blocks.highest_near(ISLAND.origin().truncate(), 2000.0);
    assert_eq!(high(&alone), high(&beside));
    let truth = ISLAND
        .points()
        .iter()
        .map(|point| point.z)
        .fold(f64::MIN, f64::max);
    assert_eq!(high(&alone), Some(truth + ISLAND.origin().z));
}
