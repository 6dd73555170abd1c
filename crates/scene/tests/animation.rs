//! Animations: what is between keyframes, when clips begin again, and what deformed meshes and their boxes become.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::animation::{
    Animation, AnimationError, AnimationParts, Channel, Clip, Curve, DeformedMesh, Influence,
    Influences, Interpolation, Joint, Keyframes, KeyframesProblem, MorphTarget, NodeTransform,
    RigNode, Skin,
};
use antumbra_scene::{Drawable, EntityKey, Geometry, Material, Mesh, MeshKey, Scene, SceneError};
use glam::{DAffine3, DQuat, DVec3};

const POSITIONS: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn keys(how: Interpolation, times: &[f32], values: &[f32], width: usize) -> Keyframes {
    Keyframes::new(how, times.to_vec(), values.to_vec(), width).unwrap()
}

fn triangle() -> Mesh {
    let geometry = Geometry {
        positions: POSITIONS.to_vec(),
        indices: vec![0, 1, 2],
        ..Geometry::default()
    };
    Mesh::new("triangle", geometry)
}

/// A scene of one entity whose mesh deforms.
fn deforming() -> (Scene, EntityKey, MeshKey) {
    let mut scene = Scene::new();
    let mesh = scene.add_deforming_mesh(triangle()).unwrap();
    let material = scene.add_material(Material::default());
    let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    scene
        .set_drawable(entity, Drawable { mesh, material })
        .unwrap();
    scene.update();
    (scene, entity, mesh)
}

/// A deformed mesh without targets and skin.
fn plain(mesh: MeshKey) -> DeformedMesh {
    DeformedMesh {
        mesh,
        node: 0,
        skin: None,
        positions: POSITIONS.to_vec(),
        normals: Vec::new(),
        targets: Vec::new(),
        weights: Vec::new(),
        influences: Influences::default(),
    }
}

fn node(parent: Option<usize>, entity: Option<EntityKey>) -> RigNode {
    RigNode {
        parent,
        rest: NodeTransform::IDENTITY,
        entity,
    }
}

#[test]
fn each_interpolation_has_the_values_of_its_formula() {
    let times = [1.0, 3.0];
    let step = keys(Interpolation::Step, &times, &[2.0, 6.0], 1);
    let line = keys(Interpolation::Linear, &times, &[2.0, 6.0], 1);
    // In-tangent, value, out-tangent.
    let spline = keys(
        Interpolation::CubicSpline,
        &times,
        &[9.0, 2.0, 1.0, -1.0, 6.0, 9.0],
        1,
    );
    for (time, stepped, on_line) in [
        (0.0, 2.0, 2.0),
        (1.0, 2.0, 2.0),
        (1.5, 2.0, 3.0),
        (2.999, 2.0, 5.998),
        (3.0, 6.0, 6.0),
        (9.0, 6.0, 6.0),
    ] {
        assert_eq!(step.sample(time), [stepped], "{time}");
        assert!((line.sample(time)[0] - on_line).abs() < 1e-5, "{time}");
    }
    // A quarter of the way: h00 = 27/32, h10 = 9/64, h01 = 5/32, h11 = -3/64; tangents times 2 s.
    let at = 2.0 * 27.0 / 32.0 + 2.0 * 9.0 / 64.0 + 6.0 * 5.0 / 32.0 + 2.0 * 3.0 / 64.0;
    assert!((spline.sample(1.5)[0] - at).abs() < 1e-6);
    assert_eq!(
        [spline.sample(0.0), spline.sample(3.5)].concat(),
        [2.0, 6.0]
    );
}

#[test]
fn rotations_take_the_shortest_arc_and_have_unit_length() {
    let turn = |angle: f64| DQuat::from_rotation_z(angle).to_array().map(|v| v as f32);
    // The second is the same rotation with the opposite sign, and neither has unit length.
    let far = turn(1.0).map(|number| number * -3.0);
    let values = [turn(0.0).map(|number| number * 0.5), far].concat();
    let turning = keys(Interpolation::Linear, &[0.0, 1.0], &values, 4);
    let half = turning.rotation(0.5);
    assert!(half.angle_between(DQuat::from_rotation_z(0.5)) < 1e-6);
    for time in [0.0, 0.3, 1.0, 2.0] {
        assert!((turning.rotation(time).length() - 1.0).abs() < 1e-9);
    }
    let nothing = keys(Interpolation::Linear, &[0.0, 1.0], &[0.0; 8], 4);
    assert_eq!(nothing.rotation(0.5), DQuat::IDENTITY);
}

#[test]
fn keyframes_that_cannot_be_sampled_are_refused() {
    let new = |times: &[f32], values: &[f32]| {
        Keyframes::new(Interpolation::Linear, times.to_vec(), values.to_vec(), 1)
    };
    assert_eq!(new(&[], &[]), Err(KeyframesProblem::Empty));
    for times in [[1.0, 1.0], [1.0, 0.5]] {
        assert_eq!(new(&times, &[0.0; 2]), Err(KeyframesProblem::NotIncreasing));
    }
    for times in [[0.0, f32::NAN], [f32::NEG_INFINITY, 0.0]] {
        assert_eq!(new(&times, &[0.0; 2]), Err(KeyframesProblem::NotFinite));
    }
    let not_finite = new(&[0.0, 1.0], &[0.0, f32::INFINITY]);
    assert_eq!(not_finite, Err(KeyframesProblem::NotFinite));
    let length = KeyframesProblem::Length {
        values: 3,
        needed: 2,
    };
    assert_eq!(new(&[0.0, 1.0], &[0.0; 3]), Err(length));
    let endless = Keyframes::new(
        Interpolation::CubicSpline,
        vec![0.0, 1.0],
        vec![0.0; 6],
        usize::MAX,
    );
    let length = KeyframesProblem::Length {
        values: 6,
        needed: usize::MAX,
    };
    assert_eq!(endless, Err(length));
}

#[test]
fn clips_begin_again_after_their_last_key() {
    let way = keys(Interpolation::Linear, &[0.5, 2.0], &[0.0; 6], 3);
    let curve = Curve::Translation(way);
    let clip = Clip::new("way", vec![Channel { node: 0, curve }]);
    for (time, within) in [(-1.0, 0.0), (0.0, 0.0), (2.0, 2.0), (2.5, 0.5), (7.0, 1.0)] {
        assert_eq!(clip.time_within(time), within, "{time}");
    }
    assert_eq!(Clip::new("nothing", Vec::new()).time_within(4.0), 0.0);
}

#[test]
fn nodes_that_a_clip_leaves_alone_are_at_rest() {
    let mut scene = Scene::new();
    let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let way = |x: f32| Curve::Translation(keys(Interpolation::Step, &[0.0], &[x, 0.0, 0.0], 3));
    let clip = |x: f32| {
        Clip::new(
            "",
            vec![Channel {
                node: 0,
                curve: way(x),
            }],
        )
    };
    let rest = NodeTransform::from_parts(DVec3::Y, DQuat::IDENTITY, DVec3::splat(2.0));
    let animation = Animation::new(AnimationParts {
        nodes: vec![RigNode {
            rest,
            ..node(None, Some(entity))
        }],
        clips: vec![clip(3.0), Clip::new("still", Vec::new())],
        ..AnimationParts::default()
    })
    .unwrap();
    animation.pose(&mut scene, 0, 0.0).unwrap();
    // The scale is that at rest.
    let moved = DAffine3::from_scale_rotation_translation(
        DVec3::splat(2.0),
        DQuat::IDENTITY,
        DVec3::X * 3.0,
    );
    assert_eq!(scene.local(entity), Some(moved));
    animation.pose(&mut scene, 1, 0.0).unwrap();
    assert_eq!(scene.local(entity), Some(rest.affine));
    let unknown = animation.pose(&mut scene, 2, 0.0).unwrap_err();
    assert_eq!(unknown, AnimationError::UnknownClip { clip: 2, count: 2 });
    assert!(animation.pose(&mut scene, 0, f64::NAN).is_err());
    scene.despawn(entity);
    animation.pose(&mut scene, 0, 0.0).unwrap();
}

#[test]
fn skins_follow_their_joints_whatever_their_own_node_does() {
    let (mut scene, entity, mesh) = deforming();
    // Node 0 has the mesh and moves, node 1 is the joint.
    let way = keys(Interpolation::Step, &[0.0], &[0.0, 0.0, 7.0], 3);
    let lift = keys(Interpolation::Step, &[0.0], &[0.0, 4.0, 0.0], 3);
    let full = Influence {
        joint: 0,
        weight: 0.5,
    };
    let animation = Animation::new(AnimationParts {
        nodes: vec![node(None, Some(entity)), node(None, None)],
        skins: vec![Skin {
            joints: vec![Joint {
                node: 1,
                inverse_bind: DAffine3::from_translation(DVec3::X),
            }],
        }],
        meshes: vec![DeformedMesh {
            skin: Some(0),
            influences: Influences {
                per_vertex: 1,
                list: vec![full; 3],
            },
            ..plain(mesh)
        }],
        clips: vec![Clip::new(
            "lift",
            vec![
                Channel {
                    node: 0,
                    curve: Curve::Translation(way),
                },
                Channel {
                    node: 1,
                    curve: Curve::Translation(lift),
                },
            ],
        )],
    })
    .unwrap();
    animation.pose(&mut scene, 0, 0.0).unwrap();
    let changes = scene.update();
    assert_eq!(
        (changes.moved, changes.deformed),
        (vec![entity], vec![mesh])
    );
    // Weights that do not add up to 1 are shares.
    let bounds = scene.world_bounds(entity).unwrap();
    assert!(
        (bounds.min - DVec3::new(1.0, 4.0, 0.0)).length() < 1e-5,
        "{bounds:?}"
    );
    assert!(
        (bounds.max - DVec3::new(2.0, 5.0, 0.0)).length() < 1e-5,
        "{bounds:?}"
    );
    animation.rest(&mut scene).unwrap();
    scene.update();
    assert_eq!(
        scene.mesh(mesh).unwrap().levels[0].positions[1],
        [2.0, 0.0, 0.0]
    );
}

#[test]
fn a_skin_moves_each_mesh_as_its_own_node_sees_it() {
    let (mut scene, _, first) = deforming();
    let mut more = || scene.add_deforming_mesh(triangle()).unwrap();
    let (second, third, fourth) = (more(), more(), more());
    // Nodes 0 and 1 have meshes, node 2 is the joint of all.
    let aside = RigNode {
        rest: NodeTransform::from_parts(DVec3::new(0.0, 0.0, 7.0), DQuat::IDENTITY, DVec3::ONE),
        ..node(None, None)
    };
    let skinned = |mesh, node| DeformedMesh {
        node,
        skin: Some(0),
        influences: Influences {
            per_vertex: 1,
            list: vec![
                Influence {
                    joint: 0,
                    weight: 1.0
                };
                3
            ],
        },
        ..plain(mesh)
    };
    let lift = keys(
        Interpolation::Linear,
        &[0.0, 1.0],
        &[0.0, 4.0, 0.0, 0.0, 8.0, 0.0],
        3,
    );
    let animation = Animation::new(AnimationParts {
        nodes: vec![node(None, None), aside, node(None, None)],
        skins: vec![Skin {
            joints: vec![Joint {
                node: 2,
                inverse_bind: DAffine3::IDENTITY,
            }],
        }],
        meshes: vec![
            skinned(first, 0),
            skinned(second, 0),
            skinned(third, 1),
            skinned(fourth, 0),
        ],
        clips: vec![Clip::new(
            "lift",
            vec![Channel {
                node: 2,
                curve: Curve::Translation(lift),
            }],
        )],
    })
    .unwrap();
    for (time, height) in [(0.0, 4.0), (0.5, 6.0)] {
        animation.pose(&mut scene, 0, time).unwrap();
        let depths = [(first, 0.0), (second, 0.0), (third, -7.0), (fourth, 0.0)];
        for (mesh, depth) in depths {
            let positions = &scene.mesh(mesh).unwrap().levels[0].positions;
            let moved = POSITIONS.map(|[x, y, z]| [x, y + height, z + depth]);
            assert_eq!(*positions, moved, "{mesh:?} at {time}");
        }
    }
}

#[test]
fn morph_targets_are_weighed_and_equal_poses_change_nothing() {
    let (mut scene, entity, mesh) = deforming();
    let weights = keys(Interpolation::Linear, &[0.0, 1.0], &[0.0, 2.0], 1);
    let animation = Animation::new(AnimationParts {
        nodes: vec![node(None, Some(entity))],
        meshes: vec![DeformedMesh {
            targets: vec![MorphTarget {
                positions: vec![[0.0, 0.0, 1.0]; 3],
                normals: Vec::new(),
            }],
            weights: vec![0.5],
            ..plain(mesh)
        }],
        clips: vec![Clip::new(
            "swell",
            vec![Channel {
                node: 0,
                curve: Curve::Weights(weights),
            }],
        )],
        ..AnimationParts::default()
    })
    .unwrap();
    for (time, height) in [(0.5, 1.0), (1.0, 2.0), (0.0, 0.0)] {
        animation.pose(&mut scene, 0, time).unwrap();
        scene.update();
        let bounds = scene.world_bounds(entity).unwrap();
        assert!((bounds.max.z - height).abs() < 1e-6, "{time}: {bounds:?}");
        animation.pose(&mut scene, 0, time).unwrap();
        assert!(scene.update().is_empty());
    }
    animation.rest(&mut scene).unwrap();
    scene.update();
    assert_eq!(scene.mesh(mesh).unwrap().levels[0].positions[0][2], 0.5);
}

#[test]
fn parts_that_do_not_fit_are_refused() {
    let (_, _, mesh) = deforming();
    let good = AnimationParts {
        nodes: vec![node(None, None)],
        skins: vec![Skin::default()],
        meshes: vec![plain(mesh)],
        clips: Vec::new(),
    };
    assert!(Animation::new(good.clone()).is_ok());
    let refused = |change: &dyn Fn(&mut AnimationParts)| {
        let mut parts = good.clone();
        change(&mut parts);
        Animation::new(parts).unwrap_err().to_string()
    };
    let curve = Curve::Rotation(keys(Interpolation::Step, &[0.0], &[0.0; 3], 3));
    for (problem, words) in [
        (
            refused(&|parts| parts.nodes[0].parent = Some(0)),
            "come before it",
        ),
        (refused(&|parts| parts.meshes[0].node = 1), "node 1 of 1"),
        (refused(&|parts| parts.meshes[0].skin = Some(1)), "its skin"),
        (
            refused(&|parts| parts.meshes[0].normals = vec![[0.0; 3]]),
            "normals",
        ),
        (
            refused(&|parts| {
                let list = vec![
                    Influence {
                        joint: 0,
                        weight: 1.0
                    };
                    3
                ];
                parts.meshes[0].influences = Influences {
                    per_vertex: 1,
                    list,
                };
            }),
            "joint 0",
        ),
        (
            refused(&|parts| {
                let curve = curve.clone();
                parts.clips = vec![Clip::new("c", vec![Channel { node: 0, curve }])];
            }),
            "4 are needed",
        ),
    ] {
        assert!(problem.contains(words), "{problem}: {words}");
    }
}

#[test]
fn only_meshes_that_deform_take_new_vertices_and_only_whole_ones() {
    let (mut scene, _, mesh) = deforming();
    let rigid = scene.add_mesh(triangle()).unwrap();
    assert!(matches!(
        scene.set_vertices(rigid, POSITIONS.to_vec(), Vec::new()),
        Err(SceneError::UnknownAsset { .. })
    ));
    for positions in [vec![[0.0; 3]; 2], vec![[f32::NAN; 3]; 3]] {
        let refused = scene.set_vertices(mesh, positions, Vec::new());
        assert!(matches!(refused, Err(SceneError::BadMesh { .. })));
    }
    assert!(scene.update().is_empty());
    let two_levels = Mesh {
        levels: vec![Geometry::default(); 2],
        ..Mesh::default()
    };
    assert!(scene.add_deforming_mesh(two_levels).is_err());
    #[cfg(feature = "simplify")]
    {
        scene.ensure_proxies(&Default::default());
        assert!(scene.mesh(mesh).unwrap().proxy.is_none());
        assert!(scene.mesh(rigid).unwrap().proxy.is_some());
    }
}

#[test]
fn boxes_are_those_of_the_last_pose_where_meshes_deform_no_longer() {
    let (mut scene, entity, mesh) = deforming();
    let other = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    let drawable = scene.drawable(entity).unwrap();
    scene.set_drawable(other, drawable).unwrap();
    scene.update();
    let weights = keys(Interpolation::Step, &[0.0], &[1.0], 1);
    let animation = Animation::new(AnimationParts {
        nodes: vec![node(None, Some(entity))],
        meshes: vec![DeformedMesh {
            targets: vec![MorphTarget {
                positions: vec![[0.0, 0.0, 8.0]; 3],
                normals: Vec::new(),
            }],
            weights: vec![0.0],
            ..plain(mesh)
        }],
        clips: vec![Clip::new(
            "rise",
            vec![Channel {
                node: 0,
                curve: Curve::Weights(weights),
            }],
        )],
        ..AnimationParts::default()
    })
    .unwrap();
    animation.pose(&mut scene, 0, 0.0).unwrap();
    animation.stop(&mut scene);
    assert!(!scene.deforms(mesh));
    let changes = scene.update();
    assert_eq!(
        (changes.moved, changes.deformed),
        (vec![entity, other], vec![mesh])
    );
    for entity in [entity, other] {
        let bounds = scene.world_bounds(entity).unwrap();
        assert!((bounds.max.z - 8.0).abs() < 1e-5, "{bounds:?}");
    }
    assert!(scene.update().is_empty());
}

#[test]
fn entities_that_have_a_deforming_mesh_no_longer_do_not_move_with_it() {
    let (mut scene, entity, mesh) = deforming();
    let drawable = scene.drawable(entity).unwrap();
    let rigid = Drawable {
        mesh: scene.add_mesh(triangle()).unwrap(),
        ..drawable
    };
    let [cleared, gone, back] = [(); 3].map(|()| {
        let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
        scene.set_drawable(entity, drawable).unwrap();
        entity
    });
    scene.set_drawable(entity, rigid).unwrap();
    scene.clear_drawable(cleared);
    scene.despawn(gone);
    scene.set_drawable(back, rigid).unwrap();
    scene.set_drawable(back, drawable).unwrap();
    scene.update();
    let lifted = POSITIONS.map(|[x, y, _]| [x, y, 2.0]).to_vec();
    scene.set_vertices(mesh, lifted, Vec::new()).unwrap();
    assert_eq!(scene.update().moved, [back]);
}
