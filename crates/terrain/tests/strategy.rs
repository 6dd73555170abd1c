//! Entities that stand on a terrain, under the strategy: prepared, moved and prepared again, and those that are never culled.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::sync::Arc;

use Verdict::{Occluded, Untested};
use antumbra_cull::{Stage, StageOptions, Strategy, Tunable, Verdict, ViewInput};
use antumbra_draw::GpuScene;
use antumbra_scene::{
    Aabb, Drawable, EntityKey, Geometry, Material, Mesh, Projection, Scene, Topology,
};
use antumbra_strategies::registry;
use antumbra_terrain::{
    GroupOptions, HorizonStrategy, Sectors, ShownTerrain, Terrain, TerrainOptions,
};
use antumbra_testing::{add, drawable, look_at, perspective, stage_with, views, vulkan};
use glam::{DAffine3, DVec3};

/// A ridge from south to north, 60 metres high, along the middle of a plain.
fn ridge() -> Terrain {
    let mut heights = vec![vec![0.0; 33]; 33];
    for line in &mut heights {
        for (column, height) in line.iter_mut().enumerate() {
            *height = (60.0 - 30.0 * (column as f64 - 16.0).abs()).max(0.0);
        }
    }
    let options = TerrainOptions {
        sectors: Sectors::new(32, 4).unwrap(),
        groups: Some(GroupOptions {
            seeds: 4,
            max_groups: 8,
            ..GroupOptions::for_triangles(0)
        }),
        ..TerrainOptions::default()
    };
    let field = support::grid(&heights, 30.0, 1.0);
    Terrain::prepare(field, &options, &|| ()).unwrap()
}

struct Play {
    scene: Scene,
    gpu_scene: GpuScene,
    stage: Stage,
    shown: ShownTerrain,
    horizon: HorizonStrategy,
    house: Drawable,
    /// The middle of the field, at the height of the plain, in the world.
    middle: DVec3,
}

impl Play {
    fn new() -> Self {
        let terrain = ridge();
        let mut scene = Scene::new();
        let shown = terrain.show_lit(&mut scene).unwrap();
        let [low, high] = terrain.field().plan_bounds();
        let middle = ((low + high) / 2.0).extend(0.0) + terrain.field().origin();
        let base = Aabb::new(DVec3::new(-5.0, 0.0, -5.0), DVec3::new(5.0, 10.0, 5.0));
        let base = Geometry::from_box(&base);
        let house = drawable(&mut scene, "house", base, Material::default());
        let horizon = HorizonStrategy::new(Arc::new(terrain), &shown);
        let gpu_scene = GpuScene::new(vulkan(), &mut scene).unwrap();
        let views = views(&["main"], [64, 48]);
        let strategy = Box::new(horizon.clone());
        let stage = stage_with(&gpu_scene, strategy, views, StageOptions::default());
        Self {
            scene,
            gpu_scene,
            stage,
            shown,
            horizon,
            house,
            middle: DVec3::new(middle.x, 0.0, -middle.y),
        }
    }

    fn build(&mut self, what: Drawable, east: f64, up: f64) -> EntityKey {
        let place = self.middle + DVec3::new(east, up, 0.0);
        add(&mut self.scene, DAffine3::from_translation(place), what)
    }

    /// Prepares the entities. Returns how many were new or had moved.
    fn prepare(&mut self) -> usize {
        self.gpu_scene.sync(&mut self.scene).unwrap();
        self.horizon.prepare_entities(&self.scene, &|| ())
    }

    /// The verdicts for a camera in the west that looks east over the ridge.
    fn look(&mut self, entities: &[EntityKey]) -> Vec<Verdict> {
        let from = DVec3::new(-400.0, 5.0, 0.0);
        self.look_from(from, perspective(0.9, 0.5), entities)
    }

    fn look_from(
        &mut self,
        from: DVec3,
        projection: Projection,
        entities: &[EntityKey],
    ) -> Vec<Verdict> {
        self.gpu_scene.sync(&mut self.scene).unwrap();
        let (eye, target) = (self.middle + from, self.middle + DVec3::X * 200.0);
        let camera = look_at(eye, target, projection);
        let input = ViewInput::new(camera);
        self.stage.frame(&self.gpu_scene, &[input]).unwrap();
        let verdicts = self.stage.verdicts(0, &self.gpu_scene).unwrap();
        let table = self.gpu_scene.table();
        let slot = |entity: &EntityKey| {
            let mut slots = table.live_slots();
            let of = |slot: &u32| table.occupant(*slot).unwrap().key == *entity;
            slots.find(of).unwrap()
        };
        entities.iter().map(|one| verdicts.get(slot(one))).collect()
    }
}

#[test]
fn who_is_new_or_moves_is_drawn_until_prepared_anew() {
    let mut play = Play::new();
    let (behind, before) = (
        play.build(play.house, 200.0, 0.0),
        play.build(play.house, -200.0, 0.0),
    );
    let both = [behind, before];
    assert_eq!(play.look(&both), [Untested, Untested]);
    assert_eq!(play.prepare(), 2);
    assert_eq!(play.look(&both), [Occluded, Untested]);
    // Up to where it is visible, and back to a position where it is not prepared.
    for (up, anew) in [(95.0, Untested), (3.0, Occluded)] {
        let place = play.middle + DVec3::new(200.0, up, 0.0);
        let local = DAffine3::from_translation(place);
        play.scene.set_local(behind, local).unwrap();
        assert_eq!(play.look(&both), [Untested, Untested], "{up}");
        assert_eq!(play.prepare(), 1);
        assert_eq!(play.look(&both), [anew, Untested], "{up}");
        assert_eq!(play.prepare(), 0);
    }
    let another = play.build(play.house, 260.0, 0.0);
    assert_eq!(play.look(&[behind, another]), [Occluded, Untested]);
    play.scene.despawn(behind);
    assert_eq!(play.prepare(), 1);
    assert_eq!(play.look(&[another]), [Occluded]);
}

#[test]
fn nobody_is_culled_who_must_be_drawn() {
    let mut play = Play::new();
    let lines = Geometry {
        topology: Topology::Lines,
        positions: vec![[0.0; 3], [0.0, 5.0, 0.0]],
        indices: vec![0, 1],
        ..Geometry::default()
    };
    let wire = Drawable {
        mesh: play.scene.add_mesh(Mesh::new("wire", lines)).unwrap(),
        ..play.house
    };
    let made_of_wire = wire;
    let wire = play.build(wire, 200.0, 0.0);
    let slice = play.build(play.house, 200.0, 0.0);
    play.scene.set_tested(slice, false).unwrap();
    let house = play.build(play.house, 200.0, 0.0);
    assert_eq!(play.prepare(), 1);
    let all = [wire, slice, house];
    assert_eq!(play.look(&all), [Untested, Untested, Occluded]);
    // With parallel lines of sight, and from below the ground.
    let orthographic = Projection::Orthographic {
        height: 400.0,
        near: 0.5,
        far: 2000.0,
    };
    let west = DVec3::new(-400.0, 5.0, 0.0);
    assert_eq!(play.look_from(west, orthographic, &all), [Untested; 3]);
    let below = west.with_y(-5.0);
    assert_eq!(
        play.look_from(below, perspective(0.9, 0.5), &all),
        [Untested; 3]
    );
    // In its place the house becomes untested, then a wire. Then the ridge is moved.
    assert_eq!(play.look(&[house]), [Occluded]);
    play.scene.set_tested(house, false).unwrap();
    assert_eq!(play.look(&[house]), [Untested]);
    play.scene.set_tested(house, true).unwrap();
    assert_eq!(play.look(&[house]), [Occluded]);
    play.scene.set_drawable(house, made_of_wire).unwrap();
    assert_eq!(play.look(&[house]), [Untested]);
    play.scene.set_drawable(house, play.house).unwrap();
    assert_eq!(play.look(&[house]), [Occluded]);
    let down = DAffine3::from_translation(DVec3::new(0.0, -100.0, 0.0));
    play.scene.set_local(play.shown.root, down).unwrap();
    assert_eq!(play.look(&[house]), [Untested]);
}

#[test]
fn what_follows_from_the_other_strategy_is_said() {
    let mut horizon = HorizonStrategy::default().with_registry(Arc::new(registry()));
    assert!(horizon.conservative() && horizon.latency().is_none());
    assert_eq!(horizon.prepare_entities(&Scene::new(), &|| ()), 0);
    horizon.set_text("then", "three-pass").unwrap();
    assert!(!horizon.conservative() && horizon.latency().is_some());
    horizon.set_text("then", "ideal").unwrap();
    assert!(horizon.needs_reference() && horizon.clone().needs_reference());
}
