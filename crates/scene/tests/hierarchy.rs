//! The scene against a simple model: random sequences of changes, compared after every update.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::{
    Aabb, Drawable, EntityKey, Geometry, Material, Mesh, MeshKey, Scene, SceneChanges,
};
use glam::{DAffine3, DQuat, DVec3};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Debug)]
enum Step {
    Spawn(usize, [i8; 3]),
    Despawn(usize),
    Move(usize, [i8; 3]),
    Reparent(usize, usize),
    Dress(usize, bool),
    Undress(usize),
    Update,
}

#[derive(Clone)]
struct Twin {
    parent: Option<EntityKey>,
    local: DAffine3,
    drawable: Option<Drawable>,
}

fn local(numbers: [i8; 3]) -> DAffine3 {
    let [x, y, z] = numbers.map(f64::from);
    // A few have a scale of zero, which must work.
    let scale = DVec3::new(1.0, if y > 100.0 { 0.0 } else { 1.0 }, 0.5);
    DAffine3::from_scale_rotation_translation(
        scale,
        DQuat::from_rotation_y(x * 0.1),
        DVec3::new(x, y, z),
    )
}

fn mesh(size: f32) -> Mesh {
    let half = DVec3::splat(f64::from(size));
    Mesh::new("box", Geometry::from_box(&Aabb::new(-half, half)))
}

struct Pair {
    scene: Scene,
    twins: BTreeMap<EntityKey, Twin>,
    order: Vec<EntityKey>,
    reported: BTreeMap<EntityKey, (Drawable, DAffine3)>,
    reparented: BTreeSet<EntityKey>,
    looks: [Drawable; 2],
    sizes: BTreeMap<MeshKey, f64>,
}

impl Pair {
    fn new() -> Self {
        let mut scene = Scene::new();
        let material = scene.add_material(Material::default());
        let mut sizes = BTreeMap::new();
        let looks = [1.0, 3.0].map(|size| {
            let mesh = scene.add_mesh(mesh(size)).unwrap();
            sizes.insert(mesh, f64::from(size));
            Drawable { mesh, material }
        });
        Self {
            scene,
            twins: BTreeMap::new(),
            order: Vec::new(),
            reported: BTreeMap::new(),
            reparented: BTreeSet::new(),
            looks,
            sizes,
        }
    }

    fn pick(&self, index: usize) -> Option<EntityKey> {
        (!self.order.is_empty()).then(|| self.order[index % self.order.len()])
    }

    fn is_below(&self, mut entity: EntityKey, above: EntityKey) -> bool {
        loop {
            if entity == above {
                return true;
            }
            match self.twins[&entity].parent {
                Some(parent) => entity = parent,
                None => return false,
            }
        }
    }

    fn world(&self, entity: EntityKey) -> DAffine3 {
        let twin = &self.twins[&entity];
        match twin.parent {
            Some(parent) => self.world(parent) * twin.local,
            None => twin.local,
        }
    }

    fn step(&mut self, step: &Step) {
        match *step {
            Step::Spawn(parent, numbers) => {
                let parent = if parent % 4 == 0 {
                    None
                } else {
                    self.pick(parent)
                };
                let entity = self.scene.spawn(parent, local(numbers)).unwrap();
                let twin = Twin {
                    parent,
                    local: local(numbers),
                    drawable: None,
                };
                assert!(
                    self.twins.insert(entity, twin).is_none(),
                    "keys are never used twice"
                );
                self.order.push(entity);
            }
            Step::Despawn(index) => {
                let Some(entity) = self.pick(index) else {
                    return;
                };
                let gone: Vec<_> = (self.order.iter().copied())
                    .filter(|below| self.is_below(*below, entity))
                    .collect();
                assert_eq!(self.scene.despawn(entity), gone.len());
                self.order.retain(|kept| !gone.contains(kept));
                for gone in gone {
                    self.twins.remove(&gone);
                    assert!(!self.scene.contains(gone));
                }
            }
            Step::Move(index, numbers) => {
                let Some(entity) = self.pick(index) else {
                    return;
                };
                self.scene.set_local(entity, local(numbers)).unwrap();
                self.twins.get_mut(&entity).unwrap().local = local(numbers);
            }
            Step::Reparent(index, parent) => {
                let Some(entity) = self.pick(index) else {
                    return;
                };
                let parent = if parent % 5 == 0 {
                    None
                } else {
                    self.pick(parent)
                };
                let cycle = parent.is_some_and(|parent| self.is_below(parent, entity));
                assert_eq!(self.scene.set_parent(entity, parent).is_err(), cycle);
                if !cycle {
                    self.reparented.insert(entity);
                    self.twins.get_mut(&entity).unwrap().parent = parent;
                }
            }
            Step::Dress(index, large) => {
                let Some(entity) = self.pick(index) else {
                    return;
                };
                let drawable = self.looks[usize::from(large)];
                self.scene.set_drawable(entity, drawable).unwrap();
                self.twins.get_mut(&entity).unwrap().drawable = Some(drawable);
            }
            Step::Undress(index) => {
                let Some(entity) = self.pick(index) else {
                    return;
                };
                let had = self.twins.get_mut(&entity).unwrap().drawable.take();
                assert_eq!(self.scene.clear_drawable(entity), had);
            }
            Step::Update => self.check(),
        }
    }

    fn check(&mut self) {
        let worlds: Vec<_> = self.order.iter().map(|e| (*e, self.world(*e))).collect();
        for (entity, world) in &worlds {
            assert_eq!(self.scene.world(*entity), Some(*world), "before the update");
        }
        let changes = self.scene.update();
        let reparented = std::mem::take(&mut self.reparented);
        let mut expected = SceneChanges {
            reparented: reparented
                .into_iter()
                .filter(|entity| self.twins.contains_key(entity))
                .collect(),
            ..SceneChanges::default()
        };
        let mut now = BTreeMap::new();
        for (entity, world) in worlds {
            assert_eq!(self.scene.world(entity), Some(world));
            if let Some(drawable) = self.twins[&entity].drawable {
                now.insert(entity, (drawable, world));
            }
        }
        for (entity, (drawable, world)) in &self.reported {
            match now.get(entity) {
                Some((same, there)) if same == drawable => {
                    if there != world {
                        expected.moved.push(*entity);
                    }
                }
                _ => expected.removed.push(*entity),
            }
        }
        for (entity, (drawable, _)) in &now {
            if self.reported.get(entity).map(|(before, _)| before) != Some(drawable) {
                expected.added.push(*entity);
            }
        }
        assert_eq!(changes, expected);
        self.reported = now;
        self.check_bounds();
        assert!(self.scene.update().is_empty(), "nothing happened since");
    }

    fn check_bounds(&self) {
        let mut all = Aabb::EMPTY;
        let mut subtrees: BTreeMap<EntityKey, Aabb> = BTreeMap::new();
        for (entity, (drawable, world)) in &self.reported {
            let half = DVec3::splat(self.sizes[&drawable.mesh]);
            let corners = Aabb::new(-half, half).corners();
            let tight = Aabb::from_points(corners.map(|c| world.transform_point3(c))).unwrap();
            let found = self.scene.world_bounds(*entity).unwrap();
            assert!(found.contains_box(&tight));
            assert!(tight.grown(DVec3::splat(1e-9)).contains_box(&found));
            all = all.union(&found);
            let mut above = Some(*entity);
            while let Some(entity) = above {
                let subtree = subtrees.entry(entity).or_insert(Aabb::EMPTY);
                *subtree = subtree.union(&found);
                above = self.twins[&entity].parent;
            }
        }
        for entity in &self.order {
            assert_eq!(
                self.scene.subtree_bounds(*entity),
                subtrees.get(entity).copied()
            );
            assert_eq!(self.scene.parent(*entity), self.twins[entity].parent);
        }
        assert_eq!(self.scene.bounds(), (!all.is_empty()).then_some(all));
    }
}

fn step() -> impl Strategy<Value = Step> {
    let numbers = any::<[i8; 3]>();
    prop_oneof![
        5 => (any::<usize>(), numbers).prop_map(|(p, n)| Step::Spawn(p, n)),
        1 => any::<usize>().prop_map(Step::Despawn),
        2 => (any::<usize>(), numbers).prop_map(|(i, n)| Step::Move(i, n)),
        2 => any::<(usize, usize)>().prop_map(|(i, p)| Step::Reparent(i, p)),
        5 => any::<(usize, bool)>().prop_map(|(i, l)| Step::Dress(i, l)),
        1 => any::<usize>().prop_map(Step::Undress),
        1 => Just(Step::Update),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]
    #[test]
    fn a_scene_is_its_model(steps in prop::collection::vec(step(), 1..220)) {
        let mut pair = Pair::new();
        for step in &steps {
            pair.step(step);
        }
        pair.check();
    }
}

/// The scene is large enough and the changes small enough that the paths for few changes, for many changes, and for a
/// new layout are all taken.
#[test]
fn large_scenes_take_every_path() {
    let mut pair = Pair::new();
    for i in 0..3000_usize {
        let parent = if i < 8 { 0 } else { (i * 7919) | 1 };
        pair.step(&Step::Spawn(
            parent,
            [(i % 90) as i8, (i % 50) as i8, (i % 70) as i8],
        ));
        if i % 2 == 0 {
            pair.step(&Step::Dress(i, i % 4 == 0));
        }
    }
    pair.check();
    for round in 0..12_usize {
        for i in 0..20 {
            pair.step(&Step::Move(round * 131 + i * 37, [i as i8, round as i8, 1]));
            pair.step(&Step::Reparent(
                round * 71 + i * 13,
                round * 17 + i * 101 + 1,
            ));
            pair.step(&Step::Dress(round * 29 + i, i % 2 == 0));
        }
        pair.step(&Step::Despawn(2000 + round * 17));
        pair.check();
    }
}

#[test]
fn a_tree_as_deep_as_it_has_entities_is_no_deeper_than_the_stack() {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let mesh = scene.add_mesh(mesh(1.0)).unwrap();
    let mut deepest = None;
    for _ in 0..100_000 {
        deepest = Some(
            scene
                .spawn(deepest, DAffine3::from_translation(DVec3::X))
                .unwrap(),
        );
    }
    let deepest = deepest.unwrap();
    scene
        .set_drawable(deepest, Drawable { mesh, material })
        .unwrap();
    scene.update();
    assert_eq!(scene.world(deepest).unwrap().translation.x, 100_000.0);
    let root = scene.roots().next().unwrap();
    assert!(scene.subtree_bounds(root).unwrap().max.x > 100_000.9);
    scene.set_local(deepest, DAffine3::IDENTITY).unwrap();
    assert_eq!(scene.update().moved, [deepest]);
    assert!(scene.bounds().unwrap().max.x < 100_000.1);
    assert_eq!(scene.despawn(root), 100_000);
    assert_eq!(scene.update().removed, [deepest]);
}

/// An entity that gets another parent without moving counts in the box of its new parent, and no longer in that of
/// the old one.
#[test]
fn boxes_follow_an_entity_that_does_not_move() {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let mesh = scene.add_mesh(mesh(1.0)).unwrap();
    // Enough unchanged entities, so that the change of one entity counts as small.
    for _ in 0..100 {
        scene.spawn(None, DAffine3::IDENTITY).unwrap();
    }
    let [from, to] = [(); 2].map(|()| scene.spawn(None, DAffine3::IDENTITY).unwrap());
    let between = scene.spawn(Some(from), DAffine3::IDENTITY).unwrap();
    let leaf = scene.spawn(Some(between), DAffine3::IDENTITY).unwrap();
    scene
        .set_drawable(leaf, Drawable { mesh, material })
        .unwrap();
    scene.update();
    let bounds = scene.subtree_bounds(from);
    assert!(bounds.is_some());
    scene.set_parent(between, Some(to)).unwrap();
    let changes = scene.update();
    assert_eq!(changes.reparented, [between]);
    assert!(changes.moved.is_empty(), "nothing drawable moved");
    assert_eq!(scene.subtree_bounds(from), None);
    assert_eq!(scene.subtree_bounds(to), bounds);
    assert_eq!(scene.bounds(), bounds);
}
