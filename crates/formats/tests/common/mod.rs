//! Small files for the tests of the loaders and as seeds of the fuzzer.
#![allow(dead_code, reason = "every user takes some of them")]

/// A binary glTF of these chunks.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// Little-endian bytes.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Little-endian bytes.
pub fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// The corners of a unit square in the xy plane, then the indices 0 1 2 2 1 3 as shorts: 48 + 12 bytes.
pub fn square() -> Vec<u8> {
    let mut bytes = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    bytes.extend(shorts(&[0, 1, 2, 2, 1, 3]));
    bytes
}

/// [`square`]'s accessors and views: accessor 0 the positions, 1 the indices.
pub const SQUARE: &str = r#""buffers":[{"byteLength":60}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}]"#;

/// A glTF whose mesh 0 is [`square`], with this `nodes` array and further members.
pub fn scene(nodes: &str, more: &str) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},{SQUARE},"meshes":[{{"name":"square","primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{nodes}]{more}}}"#
    );
    glb(&json, &square())
}

/// A glTF of one mesh whose one primitive is this JSON, over this buffer.
pub fn primitive(primitive: &str, views: &str, accessors: &str, binary: &[u8]) -> Vec<u8> {
    let length = binary.len();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length}}}],"bufferViews":[{views}],"accessors":[{accessors}],"meshes":[{{"primitives":[{primitive}]}}],"nodes":[{{"mesh":0}}]}}"#
    );
    glb(&json, binary)
}

/// An OBJ of one square with all vertex attributes.
pub const OBJ: &str = "mtllib none.mtl\no square\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/1/1 3/2/1 4/2/1\nf -1 -2 -3\n";

/// An ASCII PLY of one square.
pub const PLY: &str = "ply\nformat ascii 1.0\ncomment made here\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 255\n1 0 0 0\n1 1 0 1\n0 1 0 2\n4 0 1 2 3\n";

/// A binary PLY of one triangle.
pub fn ply_binary() -> Vec<u8> {
    let mut file = b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar uint vertex_indices\nend_header\n".to_vec();
    file.extend(floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]));
    file.push(3);
    file.extend([0_u32, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
    file
}

/// An ASCII STL of one triangle.
pub const STL: &str = "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid one\n";

/// A binary STL of these many equal triangles whose header begins with these bytes.
pub fn stl_binary(header: &[u8], triangles: u32) -> Vec<u8> {
    let mut file = header.to_vec();
    file.resize(80, 0);
    file.extend(triangles.to_le_bytes());
    for _ in 0..triangles {
        file.extend(floats(&[0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.]));
        file.extend([0, 0]);
    }
    file
}

/// A CityJSON sequence of one building, whose part is a cube of 10 m at level 1 and a cube with a square hole in its
/// roof at level 2.
pub const CITY: &str = concat!(
    r#"{"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[85000.0,446000.0,-2.0]},"CityObjects":{},"vertices":[]}"#,
    "\n",
    r#"{"type":"CityJSONFeature","id":"a","CityObjects":{"#,
    r#""a":{"type":"Building","attributes":{"built":1652,"tags":["x",{"y":null}]},"children":["a-0"],"geometry":[{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}]},"#,
    r#""a-0":{"type":"BuildingPart","parents":["a"],"geometry":["#,
    r#"{"type":"Solid","lod":"1","boundaries":[[[[3,2,1,0]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]]]]},"#,
    r#"{"type":"MultiSurface","lod":"2","boundaries":[[[3,2,1,0]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7],[8,11,10,9]]],"#,
    r#""semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"WallSurface"},{"type":"RoofSurface"}],"values":[0,1,1,1,null,2]}}]}},"#,
    r#""vertices":[[0,0,0],[10000,0,0],[10000,10000,0],[0,10000,0],[0,0,10000],[10000,0,10000],[10000,10000,10000],[0,10000,10000],[2000,2000,10000],[8000,2000,10000],[8000,8000,10000],[2000,8000,10000]]}"#,
    "\n"
);

/// A CityJSON sequence of the bridge "b" with these geometries over the vertices of [`CITY`].
pub fn bridge(geometries: &str) -> String {
    let (head, feature) = CITY.split_once('\n').unwrap();
    let vertices = feature.find(r#""vertices""#).unwrap();
    format!(
        "{head}\n{{\"type\":\"CityJSONFeature\",\"CityObjects\":{{\"b\":{{\"type\":\"Bridge\",\"geometry\":[{geometries}]}}}},{}",
        &feature[vertices..]
    )
}

/// A PNG of 2 x 1 pixels: red, and half-transparent green.
pub const PNG: &[u8] = &[
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 2, 0, 0, 0, 1, 8, 6, 0,
    0, 0, 244, 34, 127, 138, 0, 0, 0, 15, 73, 68, 65, 84, 120, 156, 99, 248, 207, 192, 240, 31, 8,
    27, 0, 16, 121, 3, 126, 125, 99, 206, 215, 0, 0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130,
];
