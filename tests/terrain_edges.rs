//! Terrain seen from outside, from over a hole, and in blocks: `horizon` culls, and no pixel is wrong.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use antumbra::measure::compare::{CompareOptions, Contender, compare};
use antumbra::measure::path::{CameraPath, Pose};
use antumbra::measure::report::StrategyReport;
use antumbra::scene::{Material, Scene};
use antumbra::strategies::registry;
use antumbra::terrain::{
    Field, GroupOptions, HorizonStrategy, Sectors, ShownTerrain, Terrain, TerrainInScene,
    TerrainOptions, Tile,
};
use antumbra_testing::{auto, perspective};
use glam::{DVec2, DVec3};

/// Posts along each side, 30 m apart.
const POSTS: u32 = 41;

/// An island with ridges from west to east that fall to its shore, and a hole of radius `hole` in metres in its central valley; 0 for none.
fn island(hole: f64) -> Field {
    let middle = DVec2::splat(f64::from(POSTS - 1) / 2.0);
    let posts = || (0..POSTS).flat_map(|row| (0..POSTS).map(move |column| (row, column)));
    let points = posts().map(|(row, column)| {
        let at = DVec2::new(f64::from(column), f64::from(row));
        let inland = (middle - (at - middle).abs()).min_element();
        let ridge = 0.5 - 0.5 * ((at.y - middle.y) * 0.55).cos();
        let bumps = 0.15 * (at.x * 1.3).sin() * (at.y * 0.9 + at.x * 0.4).cos();
        let height = (ridge + bumps + 0.15) * (inland / 5.0).min(1.0);
        (at * 30.0).extend(height * 130.0)
    });
    let cells = posts().filter(|(row, column)| row.max(column) < &(POSTS - 1));
    let triangles = cells.flat_map(|(row, column)| {
        let at = |r: u32, c: u32| (row + r) * POSTS + column + c;
        let cell = DVec2::new(f64::from(column), f64::from(row)) + 0.5;
        let both = [
            [at(0, 0), at(0, 1), at(1, 1)],
            [at(0, 0), at(1, 1), at(1, 0)],
        ];
        let there = cell.distance(middle) * 30.0 >= hole;
        both.into_iter().filter(move |_| there)
    });
    Field::new(points.collect(), triangles.collect()).unwrap()
}

fn prepared(tile: Tile) -> Arc<Terrain> {
    let triangles = tile.own_triangles();
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: triangles as u32 / 8,
            max_groups: triangles as u32 / 4,
            min_triangles: 1,
            ..GroupOptions::for_triangles(triangles)
        }),
        ..TerrainOptions::default()
    };
    Arc::new(Terrain::prepare_tile(tile, &options, &|| ()).unwrap())
}

fn show(scene: &mut Scene, terrain: &Terrain, double_sided: bool) -> ShownTerrain {
    let material = scene.add_material(Material {
        double_sided,
        unlit: true,
        ..Material::default()
    });
    terrain.show(scene, material).unwrap()
}

/// Compares `frustum` with `horizon`. Each look is an eye and a target, in metres east, north and up.
fn compared(
    mut scene: Scene,
    horizon: HorizonStrategy,
    looks: &[[[f64; 3]; 2]],
) -> [StrategyReport; 2] {
    // In the world, Y is up and Z is south.
    let world = |[east, north, up]: [f64; 3]| DVec3::new(east, up, -north);
    let poses = looks
        .iter()
        .map(|&[eye, target]| Pose::look_at(world(eye), world(target), None).unwrap());
    let path = CameraPath::new("looks", perspective(0.9, 1.0), poses.collect()).unwrap();
    let contenders = [
        Contender::of("", &Arc::new(registry()), "frustum").unwrap(),
        Contender::new("", move || Box::new(horizon.clone())),
    ];
    let options = CompareOptions {
        size: [160, 120],
        least_seconds: 0.0,
        ..CompareOptions::default()
    };
    let found = compare(
        auto(),
        &mut scene,
        &path,
        &contenders,
        &options,
        &mut |_| (),
    );
    found.unwrap().report.strategies.try_into().unwrap()
}

/// Looks from all sides, low and high.
fn from_outside() -> Vec<[[f64; 3]; 2]> {
    let around = [
        [-200.0, 600.0],
        [600.0, -300.0],
        [1500.0, 900.0],
        [500.0, 1900.0],
    ];
    let looks = around.into_iter().flat_map(|[east, north]| {
        [-20.0, 90.0].map(|up| [[east, north, up], [600.0, 600.0, 60.0]])
    });
    looks.collect()
}

fn is_right(found: &StrategyReport) {
    assert_eq!(found.name, "horizon");
    assert_eq!(found.error.wrong_pixels_percent.max, 0.0);
    assert_eq!(found.error.false_culls.entities, 0);
}

#[test]
fn from_outside_and_over_a_hole_no_pixel_is_wrong() {
    let over_the_hole = [-40.0, 70.0, 110.0].into_iter().flat_map(|up| {
        [[600.0, 1200.0], [1200.0, 500.0], [0.0, 0.0]]
            .map(|[east, north]| [[600.0, 605.0, up], [east, north, 0.0]])
    });
    let over_the_hole: Vec<_> = over_the_hole.collect();
    let terrain = prepared(Tile::whole(island(70.0)));
    let looks = [
        (from_outside(), false),
        (over_the_hole.clone(), false),
        (over_the_hole, true),
    ];
    for (looks, double_sided) in looks {
        let mut scene = Scene::new();
        let shown = show(&mut scene, &terrain, double_sided);
        let horizon = HorizonStrategy::new(terrain.clone(), &shown);
        let [all, found] = compared(scene, horizon, &looks);
        is_right(&found);
        let [all, found] = [all, found].map(|strategy| strategy.drawn.triangles);
        assert!(found < 0.9 * all, "{found} of {all}");
    }
}

#[test]
fn blocks_are_drawn_as_one_and_without_one_of_them_as_what_is_left() {
    let field = island(0.0);
    let drawn = [0.0, 200.0].map(|margin| {
        let tiles = field.cut_into_tiles(2, 2, margin).unwrap();
        let tiles: Vec<Arc<Terrain>> = tiles.into_iter().map(prepared).collect();
        [None, Some(0), Some(3)].map(|gone| {
            let mut scene = Scene::new();
            let shown = tiles.iter().map(|tile| TerrainInScene {
                terrain: Arc::clone(tile),
                shown: show(&mut scene, tile, false),
            });
            let shown: Vec<TerrainInScene> = shown.collect();
            let horizon = HorizonStrategy::for_tiles(&shown);
            if let Some(gone) = gone {
                // Removing a third of its groups is enough.
                for group in shown[gone].shown.groups.iter().step_by(3) {
                    scene.despawn(group.entity);
                }
            }
            let [all, found] = compared(scene, horizon, &from_outside());
            is_right(&found);
            found.drawn.triangles / all.drawn.triangles
        })
    });
    let [bare, wide] = drawn;
    assert!(bare[0] < 0.95 && wide[0] < bare[0], "{drawn:?}");
    // The remaining blocks still hide their own groups; those prepared with a margin depend on the removed block and hide nothing.
    assert!(bare[1] < 1.0 && bare[2] < 1.0, "{drawn:?}");
    assert!(wide[1] == 1.0 && wide[2] == 1.0, "{drawn:?}");
}
