//! What of a scene goes into the file: the tree of nodes, and the meshes and looks that they use.

use super::SaveProblem;
use super::binary::Binary;
use super::json::{
    Asset, Attributes, Buffer, LightIndex, Lights, Lod, Mesh, Node, NodeExtensions, NodeExtras,
    Primitive, Root, RootExtensions, SceneNodes,
};
use super::looks::Looks;
use super::nodes;
use crate::attachment::Attachment;
use antumbra_scene::{
    Camera, Drawable, EntityKey, Geometry, MaterialKey, MeshKey, PlacedLight, Scene, Topology,
};
use glam::DAffine3;
use slotmap::SecondaryMap;
use std::collections::{BTreeMap, HashMap};

/// The extensions that scenes themselves need.
const OWN: [&str; 4] = [
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "MSFT_lod",
];

type Attached<'a> = BTreeMap<&'a str, super::json::Attachment<'a>>;

/// Everything of the file.
pub(super) fn gather<'a>(
    scene: &'a Scene,
    attachments: &'a [Attachment],
) -> Result<(Root<'a>, Binary<'a>), SaveProblem> {
    let entities = in_order(scene);
    let mut numbers = SecondaryMap::with_capacity(entities.len());
    for (number, entity) in (0..).zip(&entities) {
        numbers.insert(*entity, number);
    }
    let mut gathering = Gathering {
        scene,
        nodes: Vec::with_capacity(entities.len()),
        lights: Vec::new(),
        cameras: Vec::new(),
        meshes: Vec::new(),
        known_meshes: HashMap::new(),
        known_parts: HashMap::new(),
        looks: Looks::default(),
        binary: Binary::default(),
    };
    for entity in &entities {
        let children = scene.children(*entity);
        gathering.nodes.push(Node {
            name: scene.entity_name(*entity),
            transform: scene
                .local(*entity)
                .map(|local| nodes::transform(&local))
                .unwrap_or_default(),
            children: children
                .filter_map(|child| numbers.get(child).copied())
                .collect(),
            extras: (!scene.is_tested(*entity)).then_some(NodeExtras { tested: false }),
            ..Node::default()
        });
    }
    // What is more than a node an entity comes behind those of all entities.
    for (number, entity) in entities.iter().enumerate() {
        if let Some(drawable) = scene.drawable(*entity) {
            gathering.dress(number, drawable)?;
        }
    }
    gathering.place_lights(&numbers);
    for (number, entity) in entities.iter().enumerate() {
        if let Some(camera) = scene.camera(*entity) {
            gathering.place_camera(number, *entity, &camera)?;
        }
    }
    let roots = scene.roots().filter_map(|root| numbers.get(root).copied());
    let roots = roots.collect();
    let attached = gathering.attach(attachments, &numbers)?;
    Ok(gathering.finish(roots, attached))
}

/// Every entity, those above first.
fn in_order(scene: &Scene) -> Vec<EntityKey> {
    let mut entities: Vec<EntityKey> = scene.roots().collect();
    let mut next = 0;
    while let Some(&entity) = entities.get(next) {
        next += 1;
        entities.extend(scene.children(entity));
    }
    entities
}

struct Gathering<'a> {
    scene: &'a Scene,
    nodes: Vec<Node<'a>>,
    lights: Vec<super::json::Light>,
    cameras: Vec<super::json::Camera>,
    meshes: Vec<Mesh>,
    known_meshes: HashMap<(MeshKey, MaterialKey), Option<Levels>>,
    known_parts: HashMap<(MeshKey, Which), (Attributes, u32)>,
    looks: Looks<'a>,
    binary: Binary<'a>,
}

/// The file's meshes for one of the scene's in one material.
#[derive(Clone)]
struct Levels {
    full: u32,
    /// The coarser levels, and last the proxy.
    coarser: Vec<u32>,
}

/// One of a mesh's geometries.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Which {
    Level(usize),
    Proxy,
}

impl<'a> Gathering<'a> {
    /// Gives a node its mesh, and further nodes to the coarser versions of it.
    fn dress(&mut self, number: usize, drawable: Drawable) -> Result<(), SaveProblem> {
        let key = (drawable.mesh, drawable.material);
        let known = match self.known_meshes.get(&key) {
            Some(known) => known.clone(),
            None => {
                let made = self.levels(drawable)?;
                self.known_meshes.insert(key, made.clone());
                made
            }
        };
        let Some(levels) = known else {
            return Ok(());
        };
        let first = self.nodes.len() as u32;
        let ids: Vec<u32> = (first..).take(levels.coarser.len()).collect();
        if let Some(node) = self.nodes.get_mut(number) {
            node.mesh = Some(levels.full);
            let transform = node.transform.clone();
            if !ids.is_empty() {
                extensions(node).lod = Some(Lod { ids });
            }
            // A level stands in the node's stead, so it stands where the node does.
            self.nodes
                .extend(levels.coarser.into_iter().map(|mesh| Node {
                    transform: transform.clone(),
                    mesh: Some(mesh),
                    ..Node::default()
                }));
        }
        Ok(())
    }

    /// Writes a mesh in a material; `None` if nothing of it can be drawn.
    fn levels(&mut self, drawable: Drawable) -> Result<Option<Levels>, SaveProblem> {
        let scene = self.scene;
        let Some(source) = scene.mesh(drawable.mesh) else {
            return Ok(None);
        };
        let mut parts = parts(source);
        if parts.is_empty() {
            return Ok(None);
        }
        let material = self
            .looks
            .material(scene, drawable.material, &mut self.binary)?;
        let full = parts.remove(0);
        let mut write = |(which, geometry): (Which, &'a Geometry)| {
            let (attributes, indices) = self.part((drawable.mesh, which), geometry);
            self.meshes.push(Mesh {
                name: match which {
                    _ if source.name.is_empty() => String::new(),
                    Which::Level(0) => source.name.clone(),
                    Which::Level(level) => format!("{}, level {level}", source.name),
                    Which::Proxy => format!("{}, proxy", source.name),
                },
                primitives: [Primitive {
                    attributes,
                    indices,
                    mode: match geometry.topology {
                        Topology::Points => 0,
                        Topology::Lines => 1,
                        Topology::Triangles => 4,
                    },
                    material,
                }],
            });
            self.meshes.len() as u32 - 1
        };
        let full = write(full);
        let coarser = parts.into_iter().map(write).collect();
        Ok(Some(Levels { full, coarser }))
    }

    /// The accessors of a geometry, whatever materials it is shown in.
    fn part(&mut self, key: (MeshKey, Which), geometry: &'a Geometry) -> (Attributes, u32) {
        if let Some(known) = self.known_parts.get(&key) {
            return *known;
        }
        let binary = &mut self.binary;
        let has = |length: usize| length == geometry.positions.len();
        let attributes = Attributes {
            positions: binary.positions(geometry),
            normals: has(geometry.normals.len()).then(|| binary.floats(&geometry.normals, "VEC3")),
            uvs: has(geometry.uvs.len()).then(|| binary.floats(&geometry.uvs, "VEC2")),
            colours: has(geometry.colours.len()).then(|| binary.colours(&geometry.colours)),
        };
        let part = (attributes, binary.indices(&geometry.indices));
        self.known_parts.insert(key, part);
        part
    }

    fn place_lights(&mut self, numbers: &SecondaryMap<EntityKey, u32>) {
        for PlacedLight { entity, light, .. } in self.scene.lights() {
            let node = numbers
                .get(entity)
                .and_then(|number| self.nodes.get_mut(*number as usize));
            if let Some(node) = node {
                let light_index = self.lights.len() as u32;
                extensions(node).light = Some(LightIndex { light: light_index });
                self.lights.push(nodes::light(&light));
            }
        }
    }

    fn place_camera(
        &mut self,
        number: usize,
        entity: EntityKey,
        camera: &Camera,
    ) -> Result<(), SaveProblem> {
        let (camera, place) = nodes::camera(camera).ok_or_else(|| SaveProblem::BadCamera {
            entity: self.scene.entity_name(entity).to_owned(),
            problem: "glTF has no off-axis projection: save the camera on its axis, and make the eyes when drawing"
                .to_owned(),
        })?;
        let index = Some(self.cameras.len() as u32);
        let next = self.nodes.len() as u32;
        let Some(node) = self.nodes.get_mut(number) else {
            return Ok(());
        };
        self.cameras.push(camera);
        if place == DAffine3::IDENTITY {
            node.camera = index;
            return Ok(());
        }
        node.children.push(next);
        self.nodes.push(Node {
            name: "camera",
            transform: nodes::transform(&place),
            camera: index,
            ..Node::default()
        });
        Ok(())
    }

    /// What is somebody else's, by name.
    fn attach(
        &mut self,
        attachments: &'a [Attachment],
        numbers: &SecondaryMap<EntityKey, u32>,
    ) -> Result<Attached<'a>, SaveProblem> {
        let mut attached = Attached::new();
        for attachment in attachments {
            let name = attachment.name.as_str();
            let bad = |problem| {
                Err(SaveProblem::BadAttachment {
                    attachment: name.to_owned(),
                    problem,
                })
            };
            if name.is_empty() || OWN.contains(&name) || attached.contains_key(name) {
                return bad("its name is empty or somebody else's; give it one of its own");
            }
            if [Attachment::NODES, Attachment::BUFFER_VIEW]
                .iter()
                .any(|fact| attachment.properties.contains_key(*fact))
            {
                return bad(
                    "its nodes and its bufferView are written here; name its facts otherwise",
                );
            }
            let nodes = attachment.entities.iter();
            let nodes: Option<Vec<u32>> = nodes.map(|&key| numbers.get(key).copied()).collect();
            let Some(nodes) = nodes else {
                return bad("it speaks of an entity that is not in the scene; leave that out");
            };
            let bytes = attachment.bytes.as_slice();
            let buffer_view = (!bytes.is_empty()).then(|| self.binary.bytes(bytes));
            let written = super::json::Attachment {
                properties: &attachment.properties,
                nodes,
                buffer_view,
            };
            attached.insert(name, written);
        }
        Ok(attached)
    }

    fn finish(self, roots: Vec<u32>, attachments: Attached<'a>) -> (Root<'a>, Binary<'a>) {
        let mut binary = self.binary;
        let looks = self.looks;
        let info = |material: &super::json::Material<'_>| {
            let texture = &material.pbr_metallic_roughness.base_color_texture;
            texture
                .as_ref()
                .is_some_and(|texture| texture.extensions.is_some())
        };
        let used = [
            !self.lights.is_empty(),
            looks.materials.iter().any(|m| m.extensions.is_some()),
            looks.materials.iter().any(info),
            self.nodes
                .iter()
                .any(|n| n.extensions.as_ref().is_some_and(|e| e.lod.is_some())),
        ];
        let lights = (!self.lights.is_empty()).then_some(Lights {
            lights: self.lights,
        });
        let buffers = match binary.length() {
            0 => Vec::new(),
            byte_length => vec![Buffer { byte_length }],
        };
        // A scene has a node at least; a file without one is a file without a scene.
        let scenes = match roots.is_empty() {
            true => Vec::new(),
            false => vec![SceneNodes {
                name: self.scene.name(),
                nodes: roots,
            }],
        };
        let root = Root {
            asset: Asset {
                version: "2.0",
                generator: concat!("Antumbra ", env!("CARGO_PKG_VERSION")),
            },
            extensions_used: OWN
                .into_iter()
                .zip(used)
                .filter_map(|(name, used)| used.then_some(name))
                .chain(attachments.keys().copied())
                .collect(),
            scene: (!scenes.is_empty()).then_some(0),
            scenes,
            nodes: self.nodes,
            meshes: self.meshes,
            materials: looks.materials,
            textures: looks.textures,
            images: looks.images,
            samplers: looks.samplers,
            cameras: self.cameras,
            accessors: std::mem::take(&mut binary.accessors),
            buffer_views: std::mem::take(&mut binary.views),
            buffers,
            extensions: (lights.is_some() || !attachments.is_empty()).then_some(RootExtensions {
                lights,
                attachments,
            }),
        };
        (root, binary)
    }
}

fn extensions<'n>(node: &'n mut Node<'_>) -> &'n mut NodeExtensions {
    node.extensions.get_or_insert_default()
}

/// A mesh's geometries that can be drawn: level 0, the further ones, and the proxy last, as a reader expects it.
fn parts(mesh: &antumbra_scene::Mesh) -> Vec<(Which, &Geometry)> {
    let is_there =
        |geometry: &Geometry| !geometry.positions.is_empty() && !geometry.indices.is_empty();
    if !mesh.full().is_some_and(is_there) {
        return Vec::new();
    }
    let levels = mesh.levels.iter().enumerate();
    let levels = levels.filter(|(_, level)| is_there(level));
    let mut parts: Vec<(Which, &Geometry)> = levels
        .map(|(at, level)| (Which::Level(at), level))
        .collect();
    let is_proxy = |proxy: &&Geometry| is_there(proxy) && proxy.topology == Topology::Triangles;
    if let Some(proxy) = mesh.proxy.as_ref().filter(is_proxy) {
        parts.push((Which::Proxy, proxy));
    } else if let [full, .., (_, last)] = parts.as_slice()
        && last.topology == Topology::Triangles
    {
        // Else the last level would be taken for the proxy; without one, the full geometry is what is tested.
        parts.push(*full);
    }
    parts
}
