//! Arbitrary scenes survive saving and loading.

use super::same::{assert_same, round_trip};
use super::spawn;
use antumbra_scene::{Drawable, EntityKey, Geometry, Material, Mesh, Scene, Topology};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;

fn numbers() -> impl Strategy<Value = f32> {
    prop_oneof![
        -1e3f32..1e3,
        Just(-0.0),
        Just(f32::MAX),
        Just(f32::MIN_POSITIVE)
    ]
}

prop_compose! {
    fn geometries()(count in 1usize..40, topology in 0..3)(
        positions in prop::collection::vec([numbers(), numbers(), numbers()], count),
        uvs in prop_oneof![Just(Vec::new()), prop::collection::vec([numbers(), numbers()], count)],
        colours in prop_oneof![Just(Vec::new()), prop::collection::vec(any::<[u8; 4]>(), count)],
        more in prop::collection::vec(0..count as u32, 6),
        topology in Just([Topology::Triangles, Topology::Lines, Topology::Points][topology as usize]),
    ) -> Geometry {
        // Every vertex is used, because a reader may drop others.
        let mut indices: Vec<u32> = (0..positions.len() as u32).collect();
        indices.extend(&more);
        indices.truncate(positions.len().next_multiple_of(topology.indices_per_primitive()));
        Geometry { topology, positions, normals: Vec::new(), uvs, colours, indices }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_scene_comes_back(
        meshes in prop::collection::vec((geometries(), ".{1,8}"), 1..5),
        entities in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<[i16; 3]>(), ".{0,8}"), 0..20),
    ) {
        let mut scene = Scene::new();
        let material = scene.add_material(Material { name: "one".into(), ..Material::default() });
        let drawables: Vec<_> = meshes.into_iter().map(|(geometry, name)| {
            Drawable { mesh: scene.add_mesh(Mesh::new(name, geometry)).unwrap(), material }
        }).collect();
        let mut spawned: Vec<EntityKey> = Vec::new();
        for (drawable, parent, place, name) in entities {
            let parent = (!spawned.is_empty()).then(|| spawned.get(parent.index(spawned.len() + 1)).copied()).flatten();
            let at = DAffine3::from_translation(DVec3::from(place.map(f64::from)) / 8.0);
            spawned.push(spawn(&mut scene, parent, &name, at, *drawable.get(&drawables)));
        }
        let (again, _, _folder) = round_trip(&scene);
        assert_same(&scene, &again);
    }
}
