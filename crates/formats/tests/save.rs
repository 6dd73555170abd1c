//! Saved scenes are read back unchanged, and other readers accept them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "save/any.rs"]
mod any;
#[path = "save/same.rs"]
mod same;

use antumbra_demo_scenes::{GridOptions, grid};
use antumbra_formats::save_glb;
use antumbra_scene::{
    AlphaMode, Camera, Drawable, EntityKey, Filter, Geometry, Image, Light, Material, Mesh,
    Projection, Sampler, Scene, Topology, Wrap, icosphere,
};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use same::{assert_same, round_trip};

fn square(size: f32) -> Geometry {
    Geometry {
        positions: vec![
            [0.0; 3],
            [size, 0.0, 0.0],
            [0.0, size, 0.0],
            [size, size, 0.0],
        ],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.1, 0.3]],
        colours: vec![
            [255, 0, 0, 255],
            [0, 255, 3, 1],
            [7, 0, 255, 254],
            [9, 8, 7, 0],
        ],
        indices: vec![0, 1, 2, 2, 1, 3],
        ..Geometry::default()
    }
}

fn spawn(
    scene: &mut Scene,
    parent: Option<EntityKey>,
    name: &str,
    at: DAffine3,
    drawable: Drawable,
) -> EntityKey {
    let entity = scene.spawn(parent, at).unwrap();
    scene.set_entity_name(entity, name).unwrap();
    scene.set_drawable(entity, drawable).unwrap();
    entity
}

#[test]
fn a_grid_comes_back_with_its_shared_mesh_and_its_sun() {
    let scene = grid(GridOptions {
        per_side: 3,
        ..GridOptions::default()
    })
    .unwrap();
    let (again, document, _folder) = round_trip(&scene);
    assert_same(&scene, &again);
    assert_eq!(again.mesh_count(), 1);
    assert_eq!(document.accessors().count(), 3, "one mesh is written once");
    assert_eq!(
        document.extensions_used().collect::<Vec<_>>(),
        ["KHR_lights_punctual"]
    );
}

#[test]
fn levels_and_proxies_come_back_in_their_places() {
    let mut scene = Scene::new();
    let material = scene.add_material(Material {
        name: "grey".into(),
        ..Material::default()
    });
    let lines = Geometry {
        topology: Topology::Lines,
        indices: vec![0, 1, 2, 3],
        ..square(3.0)
    };
    let meshes = [
        (
            "levels and proxy",
            vec![icosphere(2, 1.0), icosphere(1, 1.0), square(1.0)],
            Some(icosphere(0, 1.2)),
        ),
        ("proxy alone", vec![icosphere(1, 1.0)], Some(square(2.0))),
        ("nothing else", vec![square(1.0)], None),
        ("lines last", vec![square(1.0), square(0.5), lines], None),
    ];
    for (at, (name, levels, proxy)) in meshes.into_iter().enumerate() {
        let mesh = scene
            .add_mesh(Mesh {
                name: name.into(),
                levels,
                proxy,
            })
            .unwrap();
        let drawable = Drawable { mesh, material };
        let turned = DQuat::from_rotation_y(at as f64);
        for far in [0.5, 900.25] {
            let at = DAffine3::from_rotation_translation(turned, DVec3::new(far, 1.0, 2.0));
            spawn(&mut scene, None, name, at, drawable);
        }
    }
    let (again, document, _folder) = round_trip(&scene);
    assert_same(&scene, &again);
    assert_eq!(again.mesh_count(), 4, "entities share their meshes");
    assert!(document.extensions_used().any(|name| name == "MSFT_lod"));
}

#[test]
fn levels_without_a_proxy_are_all_kept() {
    let mut scene = Scene::new();
    let material = scene.add_material(Material::default());
    let levels = vec![icosphere(1, 1.0), icosphere(0, 1.0)];
    let mesh = Mesh {
        name: "ball".into(),
        levels,
        proxy: None,
    };
    let drawable = Drawable {
        mesh: scene.add_mesh(mesh.clone()).unwrap(),
        material,
    };
    spawn(&mut scene, None, "ball", DAffine3::IDENTITY, drawable);
    let (again, document, _folder) = round_trip(&scene);
    let (_, read) = again.meshes().next().unwrap();
    assert_eq!(read.levels, mesh.levels);
    assert_eq!(
        read.proxy,
        Some(mesh.levels[0].clone()),
        "what is tested without a proxy"
    );
    assert_eq!(
        document.accessors().count(),
        6,
        "and it is not written twice"
    );
}

#[test]
fn materials_and_images_come_back() {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh(Mesh::new("square", square(1.0))).unwrap();
    let rgba = (0..48).map(|at| (at * 37 % 256) as u8).collect();
    let clamped = Sampler {
        wrap_u: Wrap::Clamp,
        wrap_v: Wrap::Mirror,
        magnify: Filter::Nearest,
        minify: Filter::Nearest,
        mipmaps: Some(Filter::Linear),
    };
    let image = Image {
        name: "noise".into(),
        width: 4,
        height: 3,
        rgba,
        sampler: clamped,
    };
    let plain = Image {
        name: "plain".into(),
        sampler: Sampler::default(),
        ..image.clone()
    };
    let images = [image, plain].map(|image| scene.add_image(image).unwrap());
    let (sin, cos) = 0.7_f32.sin_cos();
    let turned = [
        [cos * 2.0, sin * -0.5, 0.25],
        [-sin * 2.0, cos * -0.5, -3.0],
    ];
    let default = Material::default();
    let materials = [
        Material {
            name: "textured".into(),
            base_colour_image: Some(images[0]),
            ..default.clone()
        },
        Material {
            name: "turned".into(),
            base_colour_image: Some(images[1]),
            uv_transform: turned,
            ..default.clone()
        },
        Material {
            name: "again".into(),
            base_colour_image: Some(images[0]),
            unlit: true,
            double_sided: true,
            ..default.clone()
        },
        Material {
            name: "blend".into(),
            base_colour: [0.1, 0.2, 0.3, 0.4],
            metallic: 0.875,
            roughness: 0.1,
            alpha: AlphaMode::Blend,
            ..default.clone()
        },
        Material {
            name: "mask".into(),
            alpha: AlphaMode::Mask { cutoff: 0.37 },
            ..default
        },
    ];
    for material in materials {
        let name = material.name.clone();
        let material = scene.add_material(material);
        spawn(
            &mut scene,
            None,
            &name,
            DAffine3::IDENTITY,
            Drawable { mesh, material },
        );
    }
    let (again, document, _folder) = round_trip(&scene);
    assert_same(&scene, &again);
    assert_eq!(again.images().count(), 2);
    assert_eq!(document.images().count(), 2);
    assert_eq!(
        document.accessors().count(),
        5,
        "five materials share the arrays of one mesh"
    );
    assert_eq!(document.meshes().count(), 5);
}

#[test]
fn trees_and_transforms_come_back() {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh(Mesh::new("square", square(1.0))).unwrap();
    let material = scene.add_material(Material::default());
    let drawable = Drawable { mesh, material };
    let place = DAffine3::from_scale_rotation_translation(
        DVec3::new(2.0, -3.0, 0.25),
        DQuat::from_euler(glam::EulerRot::XYZ, 1.0, 2.0, 3.0),
        DVec3::new(10.5, -20.25, 30.0),
    );
    let above = spawn(
        &mut scene,
        None,
        "above \"quoted\" \u{1f30b}\n",
        place,
        drawable,
    );
    let bare = scene
        .spawn(Some(above), DAffine3::from_translation(DVec3::X))
        .unwrap();
    let sheared = DMat3::from_cols(DVec3::X, DVec3::new(0.5, 1.0, 0.25), DVec3::ZERO);
    let sheared = DAffine3::from_mat3_translation(sheared, DVec3::Y);
    spawn(
        &mut scene,
        Some(bare),
        "sheared and flat",
        sheared,
        drawable,
    );
    spawn(
        &mut scene,
        Some(bare),
        "second",
        DAffine3::IDENTITY,
        drawable,
    );
    let empty = scene
        .add_mesh(Mesh::new("empty", Geometry::default()))
        .unwrap();
    let nothing = scene.spawn(Some(above), DAffine3::IDENTITY).unwrap();
    scene
        .set_drawable(
            nothing,
            Drawable {
                mesh: empty,
                material,
            },
        )
        .unwrap();
    let (again, document, _folder) = round_trip(&scene);
    let count = again.drawable_count();
    assert_eq!(count, 3, "what has no geometry has no mesh");
    scene.clear_drawable(nothing);
    assert_same(&scene, &again);
    let transforms = document.nodes().map(|node| node.transform());
    let matrices =
        transforms.filter(|transform| matches!(transform, gltf::scene::Transform::Matrix { .. }));
    // The `gltf` crate reports nodes without a transform as decomposed.
    assert_eq!(matrices.count(), 1);
}

#[test]
fn coordinates_are_written_as_f64() {
    let mut scene = Scene::new();
    let far = DVec3::new(460_123.456_789, -1_234.000_001, 5_934_567.890_123);
    scene.spawn(None, DAffine3::from_translation(far)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("far.glb");
    save_glb(&scene, &path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(
        text.contains("[460123.456789,-1234.000001,5934567.890123]"),
        "{text}"
    );
}

#[test]
fn coordinates_come_back_to_the_bit() {
    let mut scene = Scene::new();
    let far = DVec3::new(456_000.123_456_789, -1_234.567_89, -5_926_000.987_654_321);
    let root = scene.spawn(None, DAffine3::from_translation(far)).unwrap();
    // Numbers whose seventeen digits an imprecise reader rounds to the next f64.
    let mut odd = 0x9E37_79B9_7F4A_7C15_u64;
    let mut number = || {
        odd = odd.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(1);
        ((odd >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 1e7
    };
    let sheared = DMat3::from_cols(DVec3::X, DVec3::new(0.1, 1.0, 0.0), DVec3::Z);
    let turned = DMat3::from_quat(DQuat::from_rotation_y(0.7)) * 1.5;
    for at in 0..300 {
        let place = DVec3::new(number(), number(), number());
        let matrix = [DMat3::IDENTITY, turned, sheared][at % 3];
        let local = DAffine3::from_mat3_translation(matrix, place);
        scene.spawn(Some(root), local).unwrap();
    }
    let (again, _, _folder) = round_trip(&scene);
    assert_same(&scene, &again);
    let bits = |scene: &Scene| -> Vec<[u64; 3]> {
        let locals = scene.entities().map(|e| scene.local(e).unwrap());
        locals
            .map(|local| local.translation.to_array().map(f64::to_bits))
            .collect()
    };
    let (was, is) = (bits(&scene), bits(&again));
    assert_eq!(was.first(), Some(&far.to_array().map(f64::to_bits)));
    assert_eq!(was, is);
}

#[test]
fn lights_and_cameras_come_back() {
    let mut scene = Scene::new();
    let colour = [1.0, 0.9, 0.1];
    let lights = [
        (
            "sun",
            Light::Directional {
                colour,
                illuminance: 3.5,
            },
        ),
        (
            "lamp",
            Light::Point {
                colour,
                intensity: 1.6e8,
                range: Some(2e4),
            },
        ),
        (
            "bulb",
            Light::Point {
                colour,
                intensity: 7.0,
                range: None,
            },
        ),
        (
            "spot",
            Light::Spot {
                colour,
                intensity: 7.0,
                range: None,
                inner: 0.1,
                outer: 0.7,
            },
        ),
    ];
    for (name, light) in lights {
        let entity = scene
            .spawn(None, DAffine3::from_translation(DVec3::Y))
            .unwrap();
        scene.set_entity_name(entity, name).unwrap();
        scene.set_light(entity, light).unwrap();
    }
    let perspective = Projection::Perspective {
        fov_y: 0.75,
        near: 0.125,
    };
    let behind = Projection::Orthographic {
        height: 8.0,
        near: -2.0,
        far: 6.0,
    };
    let turned = DQuat::from_rotation_x(0.5);
    let above =
        DAffine3::from_rotation_translation(DQuat::from_rotation_y(1.0), DVec3::new(1.0, 2.0, 3.0));
    let cameras = [
        (perspective, DVec3::ZERO, DQuat::IDENTITY),
        (perspective, DVec3::X, turned),
        (behind, DVec3::ZERO, turned),
    ];
    for (projection, position, rotation) in cameras {
        let entity = scene.spawn(None, above).unwrap();
        scene
            .set_camera(
                entity,
                Camera {
                    projection,
                    position,
                    rotation,
                },
            )
            .unwrap();
    }
    scene.update();
    let (mut again, document, _folder) = round_trip(&scene);
    again.update();
    assert_eq!(document.cameras().count(), 3);
    // One more node for each camera beside its entity.
    assert_eq!(again.len(), scene.len() + 2);
    let seen =
        |scene: &Scene| -> Vec<Camera> { scene.cameras().map(|(_, camera)| camera).collect() };
    let (was, is) = (seen(&scene), seen(&again));
    assert_eq!(was.len(), is.len());
    for was in was {
        // A box two metres ahead of the camera, and which of its corners are inside the frustum.
        let same = |is: &&Camera| {
            let turned = is.rotation.dot(was.rotation).abs() > 1.0 - 1e-6;
            let off = is.position - was.position;
            let (sideways, along) = (off.cross(was.forward()).length(), off.dot(was.forward()));
            turned && sideways < 1e-5 && (is.near() + along - was.near()).abs() < 1e-5
        };
        assert!(is.iter().any(|is| same(&is)), "{was:?} is none of {is:?}");
    }
    let names = |scene: &Scene| -> Vec<(String, Light)> {
        scene
            .lights()
            .map(|placed| (scene.entity_name(placed.entity).to_owned(), placed.light))
            .collect()
    };
    assert_eq!(names(&scene), names(&again));
}

#[test]
fn a_camera_that_the_format_cannot_say_is_refused_with_its_entity() {
    let mut scene = Scene::new();
    let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
    scene.set_entity_name(entity, "left eye").unwrap();
    let projection = Projection::OffAxis {
        fov_y: 1.0,
        near: 0.1,
        shift: glam::DVec2::X * 0.1,
    };
    let camera = Camera::new(projection, DVec3::ZERO, DQuat::IDENTITY).unwrap();
    scene.set_camera(entity, camera).unwrap();
    scene.update();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("eye.glb");
    let error = save_glb(&scene, &file).unwrap_err().to_string();
    assert!(
        error.contains("left eye") && error.contains("off-axis"),
        "{error}"
    );
    assert!(!file.exists());
}

#[test]
fn indices_are_as_narrow_as_they_can_be() {
    use gltf::accessor::DataType;
    let widths = [
        (255, DataType::U8),
        (256, DataType::U16),
        (65_535, DataType::U16),
        (65_536, DataType::U32),
    ];
    for (vertices, expected) in widths {
        let mut scene = Scene::new();
        let points = Geometry {
            topology: Topology::Points,
            positions: (0..vertices).map(|at| [at as f32, 0.0, 1.0]).collect(),
            indices: (0..vertices).rev().collect(),
            ..Geometry::default()
        };
        let drawable = Drawable {
            mesh: scene.add_mesh(Mesh::new("points", points)).unwrap(),
            material: scene.add_material(Material::default()),
        };
        spawn(&mut scene, None, "points", DAffine3::IDENTITY, drawable);
        let (again, document, _folder) = round_trip(&scene);
        assert_same(&scene, &again);
        let mesh = document.meshes().next().unwrap();
        let primitive = mesh.primitives().next().unwrap();
        assert_eq!(
            primitive.indices().unwrap().data_type(),
            expected,
            "{vertices}"
        );
        let bounds = primitive.bounding_box();
        assert_eq!(
            (bounds.min, bounds.max),
            ([0.0, 0.0, 1.0], [vertices as f32 - 1.0, 0.0, 1.0])
        );
        let targets: Vec<_> = document.views().map(|view| view.target()).collect();
        use gltf::buffer::Target::{ArrayBuffer, ElementArrayBuffer};
        assert_eq!(targets, [Some(ArrayBuffer), Some(ElementArrayBuffer)]);
    }
}

#[test]
fn entities_that_are_not_tested_say_so() {
    let mut scene = Scene::new();
    for name in ["tested", "untested"] {
        let entity = scene.spawn(None, DAffine3::IDENTITY).unwrap();
        scene.set_entity_name(entity, name).unwrap();
        scene.set_tested(entity, name == "tested").unwrap();
    }
    let mesh = scene.add_mesh(Mesh::new("square", square(1.0))).unwrap();
    let material = scene.add_material(Material::default());
    let drawable = Drawable { mesh, material };
    let drawn = spawn(&mut scene, None, "drawn", DAffine3::IDENTITY, drawable);
    scene.set_tested(drawn, false).unwrap();
    spawn(
        &mut scene,
        Some(drawn),
        "below",
        DAffine3::IDENTITY,
        drawable,
    );
    let (again, document, _folder) = round_trip(&scene);
    assert_same(&scene, &again);
    let untested = again.entities().filter(|entity| !again.is_tested(*entity));
    assert_eq!(
        untested.map(|e| again.entity_name(e)).collect::<Vec<_>>(),
        ["untested", "drawn"]
    );
    let extras: Vec<_> = document
        .nodes()
        .map(|node| node.extras().as_ref().map(|json| json.get().to_owned()))
        .collect();
    let untested = Some(r#"{"tested":false}"#.to_owned());
    assert_eq!(extras, [None, untested.clone(), untested, None]);
}

#[test]
fn a_scene_without_anything_is_a_file_too() {
    let (again, _, _folder) = round_trip(&Scene::new());
    assert!(again.is_empty());
}

#[test]
fn a_failure_leaves_what_was_there() {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh(Mesh::new("square", square(1.0))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.glb");
    std::fs::write(&path, "before").unwrap();
    let pixel = Image {
        name: "pixel".into(),
        width: 1,
        height: 1,
        rgba: vec![0; 4],
        sampler: Sampler::default(),
    };
    let image = Some(scene.add_image(pixel).unwrap());
    let default = Material {
        name: "odd".into(),
        base_colour_image: image,
        ..Material::default()
    };
    let bad = [
        Material {
            base_colour: [f32::NAN, 0.0, 0.0, 1.0],
            ..default.clone()
        },
        Material {
            alpha: AlphaMode::Mask {
                cutoff: f32::INFINITY,
            },
            ..default.clone()
        },
        Material {
            metallic: f32::NAN,
            ..default.clone()
        },
        Material {
            roughness: f32::NEG_INFINITY,
            ..default.clone()
        },
        Material {
            uv_transform: [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0]],
            ..default.clone()
        },
        Material {
            uv_transform: [[1.0, 0.0, f32::NAN], [0.0, 1.0, 0.0]],
            ..default
        },
    ];
    for material in bad {
        let drawable = Drawable {
            mesh,
            material: scene.add_material(material),
        };
        let entity = spawn(&mut scene, None, "odd", DAffine3::IDENTITY, drawable);
        let error = save_glb(&scene, &path).unwrap_err().to_string();
        assert!(error.contains("scene.glb: material \"odd\""), "{error}");
        scene.despawn(entity);
    }
    assert_eq!(std::fs::read(&path).unwrap(), b"before");
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    let nowhere = folder.path().join("no such folder").join("scene.glb");
    let error = save_glb(&scene, &nowhere).unwrap_err().to_string();
    assert!(
        error.contains("no such folder") && error.contains("cannot write"),
        "{error}"
    );
    save_glb(&scene, &path).unwrap();
    assert!(std::fs::read(&path).unwrap().starts_with(b"glTF"));
}
