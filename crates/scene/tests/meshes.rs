//! Boxes, meshes and proxies: extending a box never shrinks it, errors name their cause, proxies have fewer triangles
//! than their meshes.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::{
    Aabb, Drawable, Geometry, Light, Material, Mesh, ProxyOptions, Scene, SceneError, Topology,
    icosphere, proxy,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
}

proptest! {
    #[test]
    fn transformed_boxes_hold_their_transformed_points(
        (a, b) in (vector(1e3), vector(1e3)),
        axes in prop::array::uniform3(vector(2.0)),
        far in vector(1e9),
        t in prop::array::uniform3(0.0..=1.0_f64),
    ) {
        let bounds = Aabb::new(a, b);
        let transform = DAffine3 {
            matrix3: DMat3::from_cols(axes[0], axes[1], axes[2]),
            translation: far,
        };
        let moved = bounds.transformed(&transform);
        let inside = bounds.min + (bounds.max - bounds.min) * DVec3::from_array(t);
        for point in bounds.corners().into_iter().chain([inside]) {
            prop_assert!(moved.contains(transform.transform_point3(point)));
        }
        let tight = Aabb::from_points(bounds.corners().map(|p| transform.transform_point3(p))).unwrap();
        prop_assert!(tight.grown(DVec3::splat(1e-4)).contains_box(&moved), "not much wider");
    }

    #[test]
    fn boxes_for_the_gpu_are_rounded_outwards(a in vector(1e9), b in vector(1e3), origin in vector(1e9)) {
        let bounds = Aabb::new(a, a + b);
        let (low, high) = bounds.to_f32_outward(origin);
        prop_assert!(low.as_dvec3().cmple(bounds.min - origin).all());
        prop_assert!(high.as_dvec3().cmpge(bounds.max - origin).all());
    }

    #[test]
    fn distance_is_to_the_nearest_point(a in vector(5.0), b in vector(5.0), p in vector(20.0)) {
        let bounds = Aabb::new(a, b);
        let nearest = p.clamp(bounds.min, bounds.max);
        prop_assert!((bounds.distance(p) - nearest.distance(p)).abs() < 1e-12);
        prop_assert_eq!(bounds.contains(p), bounds.distance(p) == 0.0);
    }

    /// Arbitrary triangles, also degenerate ones.
    #[test]
    fn a_proxy_has_never_more_triangles_and_lies_in_the_same_box(
        positions in prop::collection::vec(prop::array::uniform3(-4_i8..4), 1..60),
        corners in prop::collection::vec(any::<usize>(), 0..240),
        ratio in 0.0..1.0_f64,
    ) {
        let count = positions.len();
        let geometry = Geometry {
            positions: positions.into_iter().map(|p| p.map(f32::from)).collect(),
            indices: corners.as_chunks::<3>().0.as_flattened().iter().map(|c| (c % count) as u32).collect(),
            ..Geometry::default()
        };
        let options = ProxyOptions { ratio, min_triangles: 4, ..ProxyOptions::default() };
        let simplified = proxy(&geometry, &options);
        prop_assert_eq!(simplified.problem(), None);
        prop_assert!(simplified.triangle_count() <= geometry.triangle_count());
        prop_assert_eq!(&simplified, &proxy(&geometry, &options), "the same every time");
        if let Some(bounds) = simplified.bounds() {
            prop_assert!(geometry.bounds().unwrap().contains_box(&bounds));
        }
    }
}

#[test]
fn a_sphere_s_proxy_is_a_coarser_sphere() {
    let sphere = icosphere(5, 2.0);
    assert_eq!(sphere.triangle_count(), 20_480);
    let options = ProxyOptions {
        ratio: 0.02,
        ..ProxyOptions::default()
    };
    let coarse = proxy(&sphere, &options);
    assert!(
        (100..=410).contains(&coarse.triangle_count()),
        "{}",
        coarse.triangle_count()
    );
    // Collapsing edges cuts corners off. A closed proxy is grown to compensate, at most by what was lost.
    let lengths = coarse.positions.iter().map(|p| Vec3::from(*p).length());
    let (least, most) = lengths.fold((f32::MAX, 0.0f32), |(least, most), length| {
        (least.min(length), most.max(length))
    });
    assert!(least > 1.999 && most < 2.1, "{least} to {most}");
    assert!(most > 2.0001, "it was not grown: {most}");
    assert!(volume(&coarse) < volume(&sphere));
    assert!(volume(&coarse) > 0.97 * volume(&sphere));
}

#[test]
fn a_proxy_at_the_end_of_f32_stays_finite() {
    let mut huge = icosphere(4, 1.0);
    for value in huge.positions.as_flattened_mut() {
        *value *= 3.4e38;
    }
    let coarse = proxy(&huge, &ProxyOptions::default());
    assert!(coarse.triangle_count() < huge.triangle_count());
    assert_eq!(coarse.problem(), None);
}

/// Volume of a closed surface, as a sum over tetrahedra from the origin.
fn volume(geometry: &Geometry) -> f64 {
    let parts = geometry.triangles().map(|triangle| {
        let [a, b, c] = geometry.corners(triangle).unwrap();
        a.dot(b.cross(c)) / 6.0
    });
    parts.sum()
}

#[test]
fn triangles_that_share_no_vertices_are_welded_first() {
    let sphere = icosphere(3, 1.0);
    let loose = Geometry {
        positions: sphere
            .indices
            .iter()
            .map(|i| sphere.positions[*i as usize])
            .collect(),
        indices: (0..sphere.indices.len() as u32).collect(),
        ..Geometry::default()
    };
    let options = ProxyOptions::default();
    assert_eq!(
        proxy(&loose, &options).triangle_count(),
        proxy(&sphere, &options).triangle_count()
    );
}

#[test]
fn proxies_are_computed_once_and_only_of_triangles() {
    let mut mesh = Mesh::new("sphere", icosphere(3, 1.0));
    assert!(mesh.ensure_proxy(&ProxyOptions::default()));
    let first = mesh.proxy.clone();
    assert!(mesh.ensure_proxy(&ProxyOptions {
        ratio: 0.9,
        ..ProxyOptions::default()
    }));
    assert_eq!(mesh.proxy, first);
    let points = Geometry {
        topology: Topology::Points,
        positions: vec![[0.0; 3]],
        indices: vec![0],
        ..Geometry::default()
    };
    assert!(!Mesh::new("points", points).ensure_proxy(&ProxyOptions::default()));
}

#[test]
fn a_box_is_closed_and_faces_outwards() {
    let bounds = Aabb::new(DVec3::new(-1.0, 2.0, 3.0), DVec3::new(1.0, 5.0, 3.5));
    let geometry = Geometry::from_box(&bounds);
    assert_eq!(geometry.triangle_count(), 12);
    let mut volume = 0.0;
    for triangle in geometry.triangles() {
        let [a, b, c] = geometry.corners(triangle).unwrap();
        let normal = (b - a).cross(c - a);
        assert!(normal.dot(a - bounds.centre()) > 0.0);
        volume += (a - bounds.centre()).dot(normal) / 6.0;
    }
    assert!((volume - 2.0 * 3.0 * 0.5).abs() < 1e-9);
}

#[test]
fn normals_are_computed_where_there_are_none() {
    let sphere = Geometry {
        normals: Vec::new(),
        ..icosphere(2, 3.0)
    }
    .with_computed_normals();
    for (position, normal) in sphere.positions.iter().zip(&sphere.normals) {
        let (position, normal) = (Vec3::from(*position).normalize(), Vec3::from(*normal));
        assert!(position.dot(normal) > 0.99);
    }
    let kept = icosphere(1, 1.0);
    assert_eq!(kept.clone().with_computed_normals(), kept);
}

#[test]
fn meshes_that_do_not_fit_together_are_refused_by_name() {
    let good = icosphere(0, 1.0);
    let cases: [(&str, Geometry); 6] = [
        (
            "position 0 is not finite",
            Geometry {
                positions: vec![[f32::NAN; 3]; 12],
                ..good.clone()
            },
        ),
        (
            "normal 3 is not finite",
            Geometry {
                normals: (0..12)
                    .map(|i| [if i == 3 { f32::INFINITY } else { 0.0 }; 3])
                    .collect(),
                ..good.clone()
            },
        ),
        (
            "5 normals for 12 positions",
            Geometry {
                normals: vec![[0.0; 3]; 5],
                ..good.clone()
            },
        ),
        (
            "7 colours for 12",
            Geometry {
                colours: vec![[0; 4]; 7],
                ..good.clone()
            },
        ),
        (
            "index 2 is 12",
            Geometry {
                indices: vec![0, 1, 12],
                ..good.clone()
            },
        ),
        (
            "4 indices do not divide",
            Geometry {
                indices: vec![0; 4],
                ..good.clone()
            },
        ),
    ];
    let mut scene = Scene::new();
    for (expected, geometry) in cases {
        let text = scene
            .add_mesh(Mesh::new("wheel", geometry))
            .unwrap_err()
            .to_string();
        assert!(
            text.contains(expected) && text.contains("wheel") && text.contains("level 0"),
            "{text}"
        );
    }
    let none = Mesh {
        name: "none".into(),
        ..Mesh::default()
    };
    assert!(
        scene
            .add_mesh(none)
            .unwrap_err()
            .to_string()
            .contains("levels")
    );
    assert_eq!(scene.mesh_count(), 0);
}

#[test]
fn what_is_not_finite_is_refused_at_the_door_with_a_name() {
    let mut scene = Scene::new();
    let wheel = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    scene.set_entity_name(wheel, "wheel").unwrap();
    let bad = DAffine3::from_translation(DVec3::new(0.0, f64::NAN, 0.0));
    let error = scene.set_local(wheel, bad).unwrap_err();
    assert!(matches!(error, SceneError::NotFinite { .. }));
    assert!(error.to_string().contains("\"wheel\""), "{error}");
    assert_eq!(scene.local(wheel), Some(DAffine3::IDENTITY), "as before");
    let error = scene
        .spawn(Some(wheel), DAffine3::from_scale(DVec3::INFINITY))
        .unwrap_err();
    assert!(
        error.to_string().contains("below entity \"wheel\""),
        "{error}"
    );
    let light = Light::Point {
        colour: [1.0; 3],
        intensity: f32::NAN,
        range: None,
    };
    assert!(
        scene
            .set_light(wheel, light)
            .unwrap_err()
            .to_string()
            .contains("wheel")
    );
    assert_eq!(scene.len(), 1);
}

#[test]
fn unknown_keys_are_errors_that_say_so() {
    let mut scene = Scene::new();
    let gone = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    scene.despawn(gone);
    let again = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    assert_ne!(gone, again);
    assert!(matches!(
        scene.set_local(gone, DAffine3::IDENTITY),
        Err(SceneError::UnknownEntity { .. })
    ));
    assert!(matches!(
        scene.spawn(Some(gone), DAffine3::IDENTITY),
        Err(SceneError::UnknownEntity { .. })
    ));
    assert_eq!(scene.world(gone), None);
    assert_eq!(scene.entity_name(gone), "");
    assert_eq!(scene.despawn(gone), 0);
    let mut other = Scene::new();
    let mesh = other
        .add_mesh(Mesh::new("sphere", icosphere(0, 1.0)))
        .unwrap();
    let material = other.add_material(Material::default());
    let error = scene
        .set_drawable(again, Drawable { mesh, material })
        .unwrap_err();
    assert!(
        matches!(error, SceneError::UnknownAsset { what: "mesh", .. }),
        "{error}"
    );
}

#[test]
fn transforms_that_leave_the_range_of_f64_have_no_box() {
    let mut scene = Scene::new();
    let mesh = scene
        .add_mesh(Mesh::new("sphere", icosphere(0, 1.0)))
        .unwrap();
    let material = scene.add_material(Material::default());
    let huge = DAffine3::from_scale(DVec3::splat(1e300));
    let above = scene.spawn(None, huge).unwrap();
    let below = scene.spawn(Some(above), huge).unwrap();
    scene
        .set_drawable(below, Drawable { mesh, material })
        .unwrap();
    scene.update();
    assert_eq!(scene.world_bounds(below), None);
    assert_eq!(scene.bounds(), None);
    scene
        .set_local(above, DAffine3::from_scale(DVec3::ZERO))
        .unwrap();
    scene.update();
    assert!(
        scene.world_bounds(below).is_some(),
        "a scale of zero is a point"
    );
}

#[test]
fn the_boxes_of_entities_hold_the_proxies_that_their_meshes_are_given() {
    let mut scene = Scene::new();
    let sphere = icosphere(2, 1.0);
    let mesh = scene.add_mesh(Mesh::new("sphere", sphere)).unwrap();
    let material = scene.add_material(Material::default());
    let entity = scene
        .spawn(None, DAffine3::from_scale(DVec3::splat(3.0)))
        .unwrap();
    scene
        .set_drawable(entity, Drawable { mesh, material })
        .unwrap();
    scene.update();
    let before = scene.world_bounds(entity).unwrap();
    scene.ensure_proxies(&ProxyOptions::default());
    scene.update();
    let after = scene.world_bounds(entity).unwrap();
    let proxy = scene.mesh(mesh).unwrap().proxy.as_ref().unwrap();
    let reach = proxy.bounds().unwrap().max.max_element() * 3.0;
    // A closed proxy is grown, so that it extends beyond its mesh.
    assert!(reach > before.max.max_element(), "{reach} and {before:?}");
    assert!(
        after.max.max_element() >= reach * 0.999_999,
        "{reach} and {after:?}"
    );
}

#[cfg(feature = "simplify")]
#[test]
fn many_equal_triangles_and_many_at_one_vertex_are_no_endless_work() {
    let equal = Geometry {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        indices: [0, 1, 2, 1, 2, 0].repeat(50_000),
        ..Geometry::default()
    };
    assert!(!equal.is_collapsible());
    assert_eq!(proxy(&equal, &ProxyOptions::default()).triangle_count(), 1);
    let mut mesh = Mesh::new("equal", equal.clone());
    mesh.ensure_proxy(&ProxyOptions::default());
    assert!(mesh.proxy_hausdorff_distance() < 1e-3);
    // A triangle and its back are two.
    let both = Geometry {
        indices: vec![0, 1, 2, 0, 2, 1],
        ..equal
    };
    assert_eq!(proxy(&both, &ProxyOptions::default()).triangle_count(), 2);
    let spokes = 60_000_u32;
    let angle = |i: u32| i as f32 / spokes as f32 * std::f32::consts::TAU;
    let rim = (0..spokes).map(|i| [angle(i).cos(), 1.0, angle(i).sin()]);
    let fan = Geometry {
        positions: [[0.0; 3]].into_iter().chain(rim).collect(),
        indices: (1..spokes).flat_map(|i| [0, i + 1, i]).collect(),
        ..Geometry::default()
    };
    assert!(!fan.is_collapsible());
    let proxy = proxy(&fan, &ProxyOptions::default());
    assert!((1..=2_000).contains(&proxy.triangle_count()));
}
