//! Shapes come out as they are in the file: concave polygons, every solid, strips, and coordinates far from the origin.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use antumbra_formats::{
    LoadOptions, LostPart, SceneFormat, load_slice, load_slice_with_attachments,
};
use antumbra_scene::{Geometry, Scene, Topology};
use glam::DVec3;

fn read(format: SceneFormat, bytes: &[u8]) -> Scene {
    load_slice(format, bytes, None, &LoadOptions::default()).unwrap()
}

/// The area of all triangles.
fn area(scene: &Scene) -> f64 {
    let meshes = scene.meshes().map(|(_, mesh)| &mesh.levels[0]);
    meshes.map(area_of).sum()
}

fn area_of(geometry: &Geometry) -> f64 {
    let corners = geometry.triangles().map(|t| geometry.corners(t).unwrap());
    corners
        .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
        .sum()
}

/// The world positions of all vertices.
fn positions(scene: &Scene) -> Vec<DVec3> {
    let mut all = Vec::new();
    for (entity, drawable) in scene.drawables() {
        let world = scene.world(entity).unwrap();
        let mesh = scene.mesh(drawable.mesh).unwrap();
        let points = mesh.levels[0].positions.iter();
        all.extend(points.map(|p| world.transform_point3(glam::Vec3::from(*p).as_dvec3())));
    }
    all
}

/// A U of 28 square metres. A fan from its first corner would cover 33.
const U: [[i32; 2]; 8] = [
    [-3, -3],
    [3, -3],
    [3, 3],
    [1, 3],
    [1, -1],
    [-1, -1],
    [-1, 3],
    [-3, 3],
];

#[test]
fn concave_polygons_keep_their_area_from_any_corner() {
    for first in 0..U.len() {
        let corner = |i: usize| U[(first + i) % U.len()];
        let lines: String = (0..8)
            .map(|i| format!("v {} {} 0\n", corner(i)[0], corner(i)[1]))
            .collect();
        let obj = format!("{lines}f 1 2 3 4 5 6 7 8\n");
        assert_eq!(
            area(&read(SceneFormat::Obj, obj.as_bytes())),
            28.0,
            "{first}"
        );
        let points: String = (0..8)
            .map(|i| format!("{} {} 0\n", corner(i)[0], corner(i)[1]))
            .collect();
        let ply = format!(
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n{points}8 0 1 2 3 4 5 6 7\n"
        );
        assert_eq!(
            area(&read(SceneFormat::Ply, ply.as_bytes())),
            28.0,
            "{first}"
        );
    }
}

#[test]
fn polygons_keep_their_winding() {
    // The U, clockwise: every triangle faces -Z.
    let lines: String = U
        .iter()
        .rev()
        .map(|[x, y]| format!("v {x} {y} 0\n"))
        .collect();
    let scene = read(
        SceneFormat::Obj,
        format!("{lines}f 1 2 3 4 5 6 7 8\n").as_bytes(),
    );
    let (_, mesh) = scene.meshes().next().unwrap();
    for triangle in mesh.levels[0].triangles() {
        let [a, b, c] = mesh.levels[0].corners(triangle).unwrap();
        assert!((b - a).cross(c - a).z < 0.0);
    }
}

#[test]
fn convex_polygons_keep_corners_within_their_edges() {
    // The second corner lies on an edge, where a neighbour may have one.
    let obj = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n";
    let scene = read(SceneFormat::Obj, obj.as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].positions.len(), 5);
    assert_eq!(area(&scene), 4.0);
}

#[test]
fn map_coordinates_keep_their_centimetres() {
    let corners: [[f64; 3]; 4] = [
        [450_000.01, 5_412_345.03, 310.0],
        [450_020.01, 5_412_345.03, 310.0],
        [450_020.01, 5_412_345.28, 310.0],
        [450_000.01, 5_412_345.28, 310.0],
    ];
    let obj: String = corners
        .iter()
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"))
        .collect();
    let facet = |[a, b, c]: [usize; 3]| {
        let vertex = |i: usize| {
            let [x, y, z] = corners[i];
            format!("vertex {x} {y} {z}\n")
        };
        let corners = [vertex(a), vertex(b), vertex(c)].concat();
        format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let stl = format!(
        "solid a\n{}{}endsolid a\n",
        facet([0, 1, 2]),
        facet([0, 2, 3])
    );
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let mut ply = header.as_bytes().to_vec();
    ply.extend(corners.iter().flatten().flat_map(|c| c.to_le_bytes()));
    ply.push(4);
    ply.extend((0..4_i32).flat_map(i32::to_le_bytes));
    let files = [
        (SceneFormat::Obj, format!("{obj}f 1 2 3 4\n").into_bytes()),
        (SceneFormat::Ply, ply),
        (SceneFormat::Stl, stl.into_bytes()),
    ];
    for (format, bytes) in files {
        let mut scene = read(format, &bytes);
        scene.update();
        let found = positions(&scene);
        assert_eq!(found.len(), 4, "{format:?}");
        for (found, wanted) in found.iter().zip(corners) {
            let off = (*found - DVec3::from(wanted)).length();
            assert!(off < 1e-5, "{format:?}: {found} for {wanted:?}");
        }
        assert!((area(&scene) - 5.0).abs() < 1e-4, "{format:?}");
    }
}

#[test]
fn what_is_near_the_origin_keeps_its_own_coordinates() {
    let scene = read(
        SceneFormat::Obj,
        b"v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n",
    );
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].positions[1], [0.1, 0.0, 0.0]);
}

#[test]
fn every_solid_of_an_stl_is_an_entity() {
    let two = common::STL.to_owned() + &common::STL.replace("one", "two halves");
    let scene = read(SceneFormat::Stl, two.as_bytes());
    let names: Vec<_> = scene
        .drawables()
        .map(|(entity, _)| scene.entity_name(entity))
        .collect();
    assert_eq!(names, ["one", "two halves"]);
    assert_eq!(scene.triangle_count(), 2);
}

#[test]
fn strips_of_a_ply_alternate_and_end_at_negative_numbers() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n-3 -3 0\n3 -3 0\n3 3 0\n-3 3 0\n8 0 1 3 2 -1 0 1 2\n";
    let scene = read(SceneFormat::Ply, ply.as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    assert_eq!(mesh.levels[0].topology, Topology::Triangles);
    assert_eq!(area(&scene), 36.0 + 18.0);
    for triangle in mesh.levels[0].triangles() {
        let [a, b, c] = mesh.levels[0].corners(triangle).unwrap();
        assert!((b - a).cross(c - a).z > 0.0, "counter-clockwise");
    }
}

#[test]
fn lines_and_points_of_an_obj_are_shown() {
    let obj = "v -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nl 1 2 3 4 1\np 1 2\n";
    let scene = read(SceneFormat::Obj, obj.as_bytes());
    let all: Vec<_> = scene
        .meshes()
        .map(|(_, mesh)| (mesh.levels[0].topology, mesh.levels[0].indices.clone()))
        .collect();
    let lines = vec![0, 1, 1, 2, 2, 3, 3, 0];
    assert_eq!(
        all,
        [(Topology::Lines, lines), (Topology::Points, vec![0, 1])]
    );
}

#[test]
fn faces_in_a_smoothing_group_are_smooth_and_others_flat() {
    let shape = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";
    let normals = |text: &str| {
        let scene = read(SceneFormat::Obj, text.as_bytes());
        let (_, mesh) = scene.meshes().next().unwrap();
        mesh.levels[0].normals.len()
    };
    assert_eq!(normals(shape), 0);
    assert_eq!(normals(&format!("s 1\n{shape}")), 4);
    // The last face has corners of its own.
    let mixed = shape.replace("f 1 3 4", "s off\nf 1 3 4");
    assert_eq!(normals(&format!("s 1\n{mixed}")), 6);
}

/// A box without normals, with this statement before each face.
fn box_with(before: impl Fn(usize) -> String) -> Geometry {
    let corners: String = (0..8)
        .map(|i| format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2))
        .collect();
    let faces = [
        "1 5 7 3", "2 4 8 6", "1 2 6 5", "3 7 8 4", "1 3 4 2", "5 6 8 7",
    ];
    let faces = faces.iter().enumerate();
    let faces: String = faces
        .map(|(i, face)| format!("{}f {face}\n", before(i)))
        .collect();
    let scene = read(SceneFormat::Obj, (corners + &faces).as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    mesh.levels[0].clone()
}

/// The number of triangles whose corners all have the normal of the triangle's plane.
fn flat_triangles(geometry: &Geometry) -> usize {
    let is_flat = |triangle: &[u32; 3]| {
        let [a, b, c] = geometry.corners(*triangle).unwrap();
        let plane = (b - a).cross(c - a).normalize().as_vec3();
        let mut normals = triangle.iter().map(|i| geometry.normals[*i as usize]);
        normals.all(|normal| plane.distance(normal.into()) < 1e-6)
    };
    geometry.triangles().filter(is_flat).count()
}

#[test]
fn each_smoothing_group_is_smooth_by_itself() {
    let cube = box_with(|i| format!("s {}\n", i + 1));
    assert_eq!((cube.positions.len(), flat_triangles(&cube)), (24, 12));
    let round = box_with(|_| "s on\n".to_owned());
    assert_eq!((round.positions.len(), flat_triangles(&round)), (8, 0));
    // A flat lid, twice: as a group of its own and as a face of none.
    for lid in ["s 2\n", "s off\n"] {
        let can = box_with(|i| if i == 5 { lid } else { "s 1\n" }.to_owned());
        assert_eq!((can.positions.len(), flat_triangles(&can)), (12, 2));
    }
}

#[test]
fn a_face_without_attributes_costs_those_of_the_others_nothing() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0.5 0.25\nvn 0 0.6 0.8\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n";
    let loaded = load_slice_with_attachments(
        SceneFormat::Obj,
        obj.as_bytes(),
        None,
        &LoadOptions::default(),
        &[],
    )
    .unwrap();
    let (_, mesh) = loaded.scene.meshes().next().unwrap();
    let geometry = &mesh.levels[0];
    let [first, second]: [[u32; 3]; 2] =
        geometry.triangles().collect::<Vec<_>>().try_into().unwrap();
    for corner in first {
        assert_eq!(geometry.normals[corner as usize], [0.0, 0.6, 0.8]);
        assert_eq!(geometry.uvs[corner as usize], [0.5, 0.75]);
    }
    for corner in second {
        assert_eq!(geometry.normals[corner as usize], [1.0, 0.0, 0.0]);
    }
    let [loss] = loaded.left_out.losses() else {
        panic!("{}", loaded.left_out)
    };
    assert_eq!((loss.part, loss.count), (LostPart::Attribute, 3));
    assert!(loss.reason.contains("texture coordinates"), "{loss}");
}

#[test]
fn normals_of_an_obj_without_a_direction_are_those_of_its_triangles() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 0 0.6 0.8\nf 1//1 2//2 3//2\n";
    let scene = read(SceneFormat::Obj, obj.as_bytes());
    let (_, mesh) = scene.meshes().next().unwrap();
    let tilted = [0.0, 0.6, 0.8];
    assert_eq!(mesh.levels[0].normals, [[0.0, 0.0, 1.0], tilted, tilted]);
}

#[test]
fn what_has_no_finite_place_is_left_out_and_said() {
    let nan = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\nnan nan nan\n-3 -3 0\n3 -3 0\n3 3 0\n-3 3 0\n4 1 2 3 4\n3 0 1 2\n";
    let obj = "v nan 0 0\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nf 2 3 4 5\nf 1 2 3\n";
    let stl = common::STL.to_owned()
        + "solid b\nfacet normal 0 0 1\nouter loop\nvertex inf 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    let files = [
        (SceneFormat::Ply, nan, 36.0, 1),
        (SceneFormat::Obj, obj, 36.0, 0),
        (SceneFormat::Stl, stl.as_str(), 0.5, 0),
    ];
    for (format, text, wanted, points) in files {
        let loaded = load_slice_with_attachments(
            format,
            text.as_bytes(),
            None,
            &LoadOptions::default(),
            &[],
        )
        .unwrap();
        assert_eq!(area(&loaded.scene), wanted, "{format:?}");
        let count = |part: LostPart| -> u64 {
            let losses = loaded.left_out.losses().iter();
            losses
                .filter(|loss| loss.part == part)
                .map(|loss| loss.count)
                .sum()
        };
        assert_eq!(count(LostPart::Face), 1, "{format:?}");
        assert_eq!(count(LostPart::Point), points, "{format:?}");
    }
}
