//! A small glTF in which everything moves: a node from behind a wall, an arm that swings out of the box it has at rest, another that swings into view, and a ball that swells.

use antumbra_scene::icosphere;
use serde_json::{Value, json};

/// Seconds of the clip.
pub const SECONDS: f64 = 2.0;

/// Where the arm begins that lies beside the view at rest.
const ASIDE: f64 = 10.0;

/// The file, binary.
pub fn file() -> Vec<u8> {
    let mut file = GltfFile::default();
    let cube = file.mesh(&cube(), &[], None);
    let ball = icosphere(2, 0.4);
    let node_ball = file.mesh(&ball.positions, &ball.indices, None);
    let wall = json!({"mesh": cube, "scale": [6.0, 4.0, 0.2], "translation": [0.0, 0.0, 3.0]});
    file.nodes.push(wall);
    for column in -3..=3 {
        for row in -1..=1 {
            let at = [f64::from(column) * 0.6, f64::from(row) * 0.8, -3.0];
            file.nodes
                .push(json!({"mesh": node_ball, "translation": at, "name": "still"}));
        }
    }
    // A parent that moves along a spline and a child that turns about it.
    let parent = file.node(json!({"translation": [0.0, 0.0, 0.0], "name": "carrier"}));
    let child = file.nodes.len();
    file.nodes
        .push(json!({"mesh": node_ball, "translation": [0.5, 0.0, 0.0], "name": "carried"}));
    file.nodes[parent]["children"] = json!([child]);
    file.children.push(child);
    let still = [0.0_f32; 3];
    let way = [
        still,
        still,
        [3.0, 1.0, 0.0],
        still,
        [5.0, 2.5, 0.0],
        still,
        [-3.0, -1.0, 0.0],
        still,
        still,
    ];
    let (times, spline) = ([0.0, 1.0, 2.0], way.concat());
    file.channel(
        parent,
        "translation",
        "CUBICSPLINE",
        &times,
        &spline,
        "VEC3",
    );
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turns = [
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, half, half],
        [0.0, 0.0, 1.0, 0.0],
    ];
    file.channel(
        parent,
        "rotation",
        "LINEAR",
        &times,
        &turns.concat(),
        "VEC4",
    );
    let sizes = [[1.0_f32; 3], [1.5; 3], [0.5; 3]].concat();
    file.channel(child, "scale", "STEP", &times, &sizes, "VEC3");
    file.arm([-1.5, -0.5, 0.0], "arm");
    file.arm([ASIDE, 0.0, 0.0], "gate");
    file.swelling([1.5, -0.5, -1.0]);
    file.finish()
}

/// The corners of a cube's triangles, side 1.
fn cube() -> Vec<[f32; 3]> {
    let bounds = antumbra_scene::Aabb::new(glam::DVec3::splat(-0.5), glam::DVec3::splat(0.5));
    let geometry = antumbra_scene::Geometry::from_box(&bounds);
    let corner = |index: &u32| geometry.positions[*index as usize];
    geometry.indices.iter().map(corner).collect()
}

#[derive(Default)]
struct GltfFile {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    /// Nodes that hang on others.
    children: Vec<usize>,
    skins: Vec<Value>,
    channels: Vec<Value>,
    samplers: Vec<Value>,
}

impl GltfFile {
    fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, count: usize, shape: &str) -> usize {
        let offset = self.binary.len();
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.views
            .push(json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}));
        let view = self.views.len() - 1;
        self.accessors.push(
            json!({"bufferView": view, "componentType": component, "count": count, "type": shape}),
        );
        self.accessors.len() - 1
    }

    fn floats(&mut self, values: &[f32], width: usize, shape: &str) -> usize {
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        self.accessor(&bytes, 5126, values.len() / width, shape)
    }

    /// A mesh; its morph target moves every vertex by these displacements.
    fn mesh(
        &mut self,
        positions: &[[f32; 3]],
        indices: &[u32],
        target: Option<&[[f32; 3]]>,
    ) -> usize {
        let vertices = self.floats(positions.as_flattened(), 3, "VEC3");
        let mut primitive = json!({"attributes": {"POSITION": vertices}});
        if !indices.is_empty() {
            let bytes: Vec<u8> = indices
                .iter()
                .flat_map(|index| index.to_le_bytes())
                .collect();
            primitive["indices"] = json!(self.accessor(&bytes, 5125, indices.len(), "SCALAR"));
        }
        if let Some(target) = target {
            let deltas = self.floats(target.as_flattened(), 3, "VEC3");
            primitive["targets"] = json!([{"POSITION": deltas}]);
        }
        self.meshes.push(json!({"primitives": [primitive]}));
        self.meshes.len() - 1
    }

    fn channel(
        &mut self,
        node: usize,
        path: &str,
        how: &str,
        times: &[f32],
        values: &[f32],
        shape: &str,
    ) {
        let width = match shape {
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 1,
        };
        let input = self.floats(times, 1, "SCALAR");
        let output = self.floats(values, width, shape);
        let sampler = self.samplers.len();
        self.samplers
            .push(json!({"input": input, "output": output, "interpolation": how}));
        self.channels
            .push(json!({"sampler": sampler, "target": {"node": node, "path": path}}));
    }

    /// A tube along +x whose outer half turns upwards about its middle by more than a quarter, and back.
    fn arm(&mut self, at: [f64; 3], name: &str) {
        const RINGS: usize = 25;
        const SIDES: usize = 6;
        const LENGTH: f32 = 5.0;
        let (mut positions, mut joints, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        for ring in 0..RINGS {
            let along = ring as f32 / (RINGS - 1) as f32;
            // The second joint takes over in the middle third.
            let second = ((along - 1.0 / 3.0) * 3.0).clamp(0.0, 1.0);
            for side in 0..SIDES {
                let angle = std::f32::consts::TAU * side as f32 / SIDES as f32;
                let (sin, cos) = angle.sin_cos();
                positions.push([along * LENGTH - 1.5, cos * 0.2, sin * 0.2]);
                joints.extend([0_u8, 1, 0, 0]);
                weights.extend([1.0 - second, second, 0.0, 0.0]);
            }
        }
        let quads = (0..RINGS - 1).flat_map(|ring| (0..SIDES).map(move |side| (ring, side)));
        let corners = quads.flat_map(|(ring, side)| {
            let at = |ring: usize, side: usize| (ring * SIDES + side % SIDES) as u32;
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            [a, b, c, c, b, d]
        });
        let indices: Vec<u32> = corners.collect();
        let mesh = self.mesh(&positions, &indices, None);
        let vertices = positions.len();
        let joints = self.accessor(&joints, 5121, vertices, "VEC4");
        let weights = self.floats(&weights, 4, "VEC4");
        self.meshes[mesh]["primitives"][0]["attributes"]["JOINTS_0"] = json!(joints);
        self.meshes[mesh]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
        let (shoulder, elbow) = (self.nodes.len(), self.nodes.len() + 1);
        self.nodes.push(
            json!({"name": format!("{name} shoulder"), "translation": at, "children": [elbow]}),
        );
        self.nodes.push(json!({"name": format!("{name} elbow")}));
        self.children.push(elbow);
        let skin = self.skins.len();
        self.skins.push(json!({"joints": [shoulder, elbow]}));
        // The mesh's own node is elsewhere: joints alone place it.
        self.nodes.push(
            json!({"name": name, "mesh": mesh, "skin": skin, "translation": [0.0, 7.0, 0.0]}),
        );
        let turn = |angle: f32| [0.0, 0.0, (angle / 2.0).sin(), (angle / 2.0).cos()];
        let turns = [turn(0.0), turn(2.0), turn(0.0)].concat();
        self.channel(
            elbow,
            "rotation",
            "LINEAR",
            &[0.0, 1.0, 2.0],
            &turns,
            "VEC4",
        );
        if name == "gate" {
            let turns = [turn(0.0), turn(3.0), turn(0.0)].concat();
            self.channel(
                shoulder,
                "rotation",
                "LINEAR",
                &[0.0, 1.0, 2.0],
                &turns,
                "VEC4",
            );
        }
    }

    /// A ball that grows to seven times its size.
    fn swelling(&mut self, at: [f64; 3]) {
        let ball = icosphere(2, 0.5);
        let target: Vec<[f32; 3]> = (ball.positions.iter())
            .map(|position| position.map(|along| along * 6.0))
            .collect();
        let mesh = self.mesh(&ball.positions, &ball.indices, Some(&target));
        let node = self.node(json!({"name": "swelling", "mesh": mesh, "translation": at}));
        let weights = [0.0, 0.0, 1.0, 0.0];
        self.channel(
            node,
            "weights",
            "LINEAR",
            &[0.0, 0.4, 1.2, 2.0],
            &weights,
            "SCALAR",
        );
    }

    fn finish(self) -> Vec<u8> {
        let roots: Vec<usize> = (0..self.nodes.len())
            .filter(|node| !self.children.contains(node))
            .collect();
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": roots}],
            "buffers": [{"byteLength": self.binary.len()}],
            "bufferViews": self.views,
            "accessors": self.accessors,
            "meshes": self.meshes,
            "nodes": self.nodes,
            "skins": self.skins,
            "animations": [{"name": "all", "channels": self.channels, "samplers": self.samplers}],
        });
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + self.binary.len();
        let mut file = b"glTF".to_vec();
        file.extend(2_u32.to_le_bytes());
        file.extend((length as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &self.binary)] {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}
