//! Construction of a glTF from a scene: the tree of nodes, and the meshes and materials that they use.

use super::binary::Binary;
use super::convert::{self, PlacedCamera};
use super::error::SaveProblem;
use super::json::{
    Asset, Attributes, Buffer, LightIndex, Lights, Lod, Mesh, Node, NodeExtensions, NodeExtras,
    Primitive, Root, RootExtensions, SceneNodes,
};
use super::materials::MaterialTable;
use crate::gltf::attachment::Attachment;
use antumbra_scene::{
    Camera, Drawable, EntityKey, Geometry, MaterialKey, MeshKey, PlacedLight, Scene, Topology,
};
use glam::DAffine3;
use slotmap::SecondaryMap;
use std::collections::{BTreeMap, HashMap};

/// The extensions that scenes themselves use.
const OWN: [&str; 5] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "MSFT_lod",
];

type Attached<'a> = BTreeMap<&'a str, super::json::Attachment<'a>>;

/// The contents of a GLB file.
pub(super) struct Glb<'a> {
    pub(super) root: Root<'a>,
    pub(super) binary: Binary<'a>,
}

/// Builds the contents of the file.
pub(super) fn build<'a>(
    scene: &'a Scene,
    attachments: &'a [Attachment],
) -> Result<Glb<'a>, SaveProblem> {
    let entities = in_order(scene);
    let mut numbers = SecondaryMap::with_capacity(entities.len());
    for (number, entity) in (0..).zip(&entities) {
        numbers.insert(*entity, number);
    }
    let mut builder = Builder {
        scene,
        nodes: Vec::with_capacity(entities.len()),
        lights: Vec::new(),
        cameras: Vec::new(),
        meshes: Vec::new(),
        known_meshes: HashMap::new(),
        known_parts: HashMap::new(),
        materials: MaterialTable::default(),
        binary: Binary::default(),
    };
    for entity in &entities {
        let children = scene.children(*entity);
        builder.nodes.push(Node {
            name: scene.entity_name(*entity),
            transform: scene
                .local(*entity)
                .map(|local| convert::transform(&local))
                .unwrap_or_default(),
            children: children
                .filter_map(|child| numbers.get(child).copied())
                .collect(),
            extras: (!scene.is_tested(*entity)).then_some(NodeExtras { tested: false }),
            ..Node::default()
        });
    }
    // Nodes beyond one per entity follow those of all entities.
    for (number, entity) in entities.iter().enumerate() {
        if let Some(drawable) = scene.drawable(*entity) {
            builder.set_mesh(number, drawable)?;
        }
    }
    builder.add_lights(&numbers);
    for (number, entity) in entities.iter().enumerate() {
        if let Some(camera) = scene.camera(*entity) {
            builder.add_camera(number, *entity, &camera)?;
        }
    }
    let roots = scene.roots().filter_map(|root| numbers.get(root).copied());
    let roots = roots.collect();
    let attached = builder.attach(attachments, &numbers)?;
    Ok(builder.finish(roots, attached))
}

/// All entities, parents first.
fn in_order(scene: &Scene) -> Vec<EntityKey> {
    let mut entities: Vec<EntityKey> = scene.roots().collect();
    let mut next = 0;
    while let Some(&entity) = entities.get(next) {
        next += 1;
        entities.extend(scene.children(entity));
    }
    entities
}

struct Builder<'a> {
    scene: &'a Scene,
    nodes: Vec<Node<'a>>,
    lights: Vec<super::json::Light>,
    cameras: Vec<super::json::Camera>,
    meshes: Vec<Mesh>,
    known_meshes: HashMap<(MeshKey, MaterialKey), Option<Levels>>,
    known_parts: HashMap<(MeshKey, GeometryId), Accessors>,
    materials: MaterialTable<'a>,
    binary: Binary<'a>,
}

/// The file's meshes for one of the scene's meshes with one material.
#[derive(Clone)]
struct Levels {
    full: u32,
    /// The coarser levels, and last the proxy.
    coarser: Vec<u32>,
}

/// The accessors of a geometry.
#[derive(Clone, Copy)]
struct Accessors {
    attributes: Attributes,
    indices: u32,
}

/// One of a mesh's geometries.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum GeometryId {
    Level(usize),
    Proxy,
}

impl<'a> Builder<'a> {
    /// Sets a node's mesh, and adds nodes for its coarser levels.
    fn set_mesh(&mut self, number: usize, drawable: Drawable) -> Result<(), SaveProblem> {
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
            // A level replaces the node's mesh, so it has the node's transform.
            self.nodes
                .extend(levels.coarser.into_iter().map(|mesh| Node {
                    transform: transform.clone(),
                    mesh: Some(mesh),
                    ..Node::default()
                }));
        }
        Ok(())
    }

    /// Adds a mesh with a material; `None` if it has nothing to draw.
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
            .materials
            .material(scene, drawable.material, &mut self.binary)?;
        let full = parts.remove(0);
        let mut write = |(which, geometry): (GeometryId, &'a Geometry)| {
            let Accessors {
                attributes,
                indices,
            } = self.part((drawable.mesh, which), geometry);
            self.meshes.push(Mesh {
                name: match which {
                    _ if source.name.is_empty() => String::new(),
                    GeometryId::Level(0) => source.name.clone(),
                    GeometryId::Level(level) => format!("{}, level {level}", source.name),
                    GeometryId::Proxy => format!("{}, proxy", source.name),
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

    /// The accessors of a geometry, shared by all its materials.
    fn part(&mut self, key: (MeshKey, GeometryId), geometry: &'a Geometry) -> Accessors {
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
        let part = Accessors {
            attributes,
            indices: binary.indices(&geometry.indices),
        };
        self.known_parts.insert(key, part);
        part
    }

    fn add_lights(&mut self, numbers: &SecondaryMap<EntityKey, u32>) {
        for PlacedLight { entity, light, .. } in self.scene.lights() {
            let node = numbers
                .get(entity)
                .and_then(|number| self.nodes.get_mut(*number as usize));
            if let Some(node) = node {
                let light_index = self.lights.len() as u32;
                extensions(node).light = Some(LightIndex { light: light_index });
                self.lights.push(convert::light(&light));
            }
        }
    }

    fn add_camera(
        &mut self,
        number: usize,
        entity: EntityKey,
        camera: &Camera,
    ) -> Result<(), SaveProblem> {
        let PlacedCamera { camera, place } = convert::camera(camera).ok_or_else(|| SaveProblem::BadCamera {
            entity: self.scene.entity_name(entity).to_owned(),
            problem: "glTF has no off-axis projection: save the camera between the eyes, and derive the eyes when drawing"
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
            transform: convert::transform(&place),
            camera: index,
            ..Node::default()
        });
        Ok(())
    }

    /// Adds the attachments, by name.
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
                return bad("its name is empty or already in use; give it another name");
            }
            if [Attachment::NODES, Attachment::BUFFER_VIEW]
                .iter()
                .any(|fact| attachment.properties.contains_key(*fact))
            {
                return bad("the properties `nodes` and `bufferView` are reserved; rename them");
            }
            let nodes = attachment.entities.iter();
            let nodes: Option<Vec<u32>> = nodes.map(|&key| numbers.get(key).copied()).collect();
            let Some(nodes) = nodes else {
                return bad("it refers to an entity that is not in the scene; remove that entity");
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

    fn finish(self, roots: Vec<u32>, attachments: Attached<'a>) -> Glb<'a> {
        let mut binary = self.binary;
        let materials = self.materials;
        let info = |material: &super::json::Material<'_>| {
            let texture = &material.pbr_metallic_roughness.base_color_texture;
            texture
                .as_ref()
                .is_some_and(|texture| texture.extensions.is_some())
        };
        let extended = || {
            let all = materials.materials.iter();
            all.filter_map(|material| material.extensions.as_ref())
        };
        let used = [
            !self.lights.is_empty(),
            extended().any(|extensions| extensions.strength.is_some()),
            extended().any(|extensions| extensions.unlit.is_some()),
            materials.materials.iter().any(info),
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
        // A glTF scene needs at least one node, so an empty scene is a file without a scene.
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
            materials: materials.materials,
            textures: materials.textures,
            images: materials.images,
            samplers: materials.samplers,
            cameras: self.cameras,
            accessors: std::mem::take(&mut binary.accessors),
            buffer_views: std::mem::take(&mut binary.views),
            buffers,
            extensions: (lights.is_some() || !attachments.is_empty()).then_some(RootExtensions {
                lights,
                attachments,
            }),
        };
        Glb { root, binary }
    }
}

fn extensions<'n>(node: &'n mut Node<'_>) -> &'n mut NodeExtensions {
    node.extensions.get_or_insert_default()
}

/// The geometries of a mesh that can be drawn: level 0, the further levels, and last the proxy, as a reader expects.
fn parts(mesh: &antumbra_scene::Mesh) -> Vec<(GeometryId, &Geometry)> {
    let is_there =
        |geometry: &Geometry| !geometry.positions.is_empty() && !geometry.indices.is_empty();
    if !mesh.full().is_some_and(is_there) {
        return Vec::new();
    }
    let levels = mesh.levels.iter().enumerate();
    let levels = levels.filter(|(_, level)| is_there(level));
    let mut parts: Vec<(GeometryId, &Geometry)> = levels
        .map(|(at, level)| (GeometryId::Level(at), level))
        .collect();
    let is_proxy = |proxy: &&Geometry| is_there(proxy) && proxy.topology == Topology::Triangles;
    if let Some(proxy) = mesh.proxy.as_ref().filter(is_proxy) {
        parts.push((GeometryId::Proxy, proxy));
    } else if let [full, .., (_, last)] = parts.as_slice()
        && last.topology == Topology::Triangles
    {
        // Without this the last level would be read as the proxy. A mesh without a proxy is tested with its full
        // geometry.
        parts.push(*full);
    }
    parts
}
