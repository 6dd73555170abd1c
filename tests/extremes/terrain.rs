//! Terrain by size and place: the strategy `horizon` on terrain a millimetre wide, a thousand kilometres wide, and ten thousand kilometres from
//! the origin.

use std::sync::Arc;

use antumbra::cull::Verdict;
use antumbra::scene::{Material, Scene};
use antumbra::terrain::{Field, GroupOptions, HorizonStrategy, Sectors, Terrain, TerrainOptions};
use antumbra_testing::{gpus, look_at, perspective_degrees};
use glam::DVec3;

use crate::play::Play;

/// Posts along each side.
const POSTS: u32 = 33;

/// Ridges from west to east, with one post a unit. A unit is `metre` metres.
fn ridges(metre: f64, origin: DVec3) -> Field {
    let posts = (0..POSTS).flat_map(|row| (0..POSTS).map(move |column| [column, row]));
    let points = posts.map(|at| {
        let [x, y] = at.map(f64::from);
        let height = ((y * 0.7).sin() * 2.0).max(0.0) + (x * 0.9 + y * 0.3).cos() * 0.25;
        origin + DVec3::new(x, y, (height * 1024.0).round() / 1024.0) * metre
    });
    let cells = (0..POSTS - 1).flat_map(|row| (0..POSTS - 1).map(move |column| (row, column)));
    let triangles = cells.flat_map(|(row, column)| {
        let at = |r: u32, c: u32| (row + r) * POSTS + column + c;
        [
            [at(0, 0), at(0, 1), at(1, 1)],
            [at(0, 0), at(1, 1), at(1, 0)],
        ]
    });
    Field::new(points.collect(), triangles.collect()).unwrap()
}

/// Asserts that `horizon` gets every pixel right from a valley and from above, and culls. Returns, of the first frame, how many groups are drawn
/// and how many are in the frustum.
fn holds(metre: f64, origin: DVec3) -> [usize; 2] {
    let field = ridges(metre, origin);
    let count = field.triangles().len();
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: count as u32 / 8,
            max_groups: count as u32 / 4,
            min_triangles: 1,
            ..GroupOptions::for_triangles(count)
        }),
        ..TerrainOptions::default()
    };
    let terrain = Terrain::prepare(field, &options, &|| ()).unwrap();
    let mut scene = Scene::new();
    let material = scene.add_material(Material {
        unlit: true,
        ..Material::default()
    });
    let shown = terrain.show(&mut scene, material).unwrap();
    let horizon = HorizonStrategy::new(Arc::new(terrain), &shown);
    // East, north, up. In the world, Y is up and Z is south.
    let world = |east: f64, north: f64, up: f64| {
        let at = origin + DVec3::new(east, north, up) * metre;
        DVec3::new(at.x, at.z, -at.y)
    };
    let projection = perspective_degrees(50.0, 0.03125 * metre);
    let frames = vec![
        look_at(world(16.0, 6.0, 1.0), world(16.0, 16.0, 1.0), projection),
        look_at(world(14.0, -3.0, 1.5), world(16.0, 16.0, 1.0), projection),
        look_at(world(14.0, 4.0, 9.0), world(16.0, 16.0, 0.0), projection),
    ];
    let play = Play::new(scene, frames);
    let mut drawn = [0, 0];
    for gpu in gpus() {
        let outcome = play.by(gpu, "horizon", || Box::new(horizon.clone()));
        let frames = outcome.unwrap_or_else(|failure| panic!("{failure}"));
        let first = &frames[0][0];
        let outside = |slot: &u32| first.get(*slot) != Verdict::OutsideFrustum;
        let inside = (0..shown.groups.len() as u32).filter(outside).count();
        drawn = [first.drawn().count(), inside];
        assert!(drawn[0] < drawn[1], "nothing was culled: {drawn:?}");
    }
    drawn
}

#[test]
fn horizons_of_a_world_of_millimetres_and_of_a_thousand_kilometres() {
    let metres = holds(1.0, DVec3::ZERO);
    for power in [-15, 15] {
        let found = holds(2_f64.powi(power), DVec3::ZERO);
        // Rims allow for rounding in metres, not relative to the scale: the verdict of a group that is just hidden may differ.
        assert_eq!(found[1], metres[1]);
        assert!(
            found[0].abs_diff(metres[0]) <= 2,
            "2^{power}: {found:?}, {metres:?}"
        );
    }
}

#[test]
fn horizons_ten_thousand_kilometres_away() {
    holds(1.0, DVec3::new(1e7, -1e7, 1e4));
}
