//! Construction of entities from the node tree: one per node, one more per primitive if a mesh has several, and one
//! per instance of a repeated mesh. All walks use queues, so the tree may have any depth.

use super::document::{Document, at, item, label};
use super::extras;
use super::geometry::{self, Request};
use super::lights_and_cameras::{projection, punctual};
use super::material::{self, Materials};
use super::skin::Pose;
use super::tree::Tree;
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::file_resolver::FileResolver;
use crate::left_out::LostPart;
use antumbra_scene::{Camera, Drawable, EntityKey, Geometry, Mesh, Scene, Topology};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};
use gltf::json::scene::Node;
use std::collections::{HashMap, VecDeque};

/// Builds the file's scene, with the entity of each of its nodes.
pub(super) fn build(
    document: &Document<'_>,
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<NodeScene, LoadProblem> {
    let tree = Tree::read(document)?;
    let mut builder = SceneBuilder {
        document,
        files,
        budget,
        scene: Scene::new(),
        materials: Materials::default(),
        parts: HashMap::new(),
        locals: &tree.locals,
        worlds: tree.worlds(),
    };
    let mut entities = Entities::new();
    let mut queue: VecDeque<(usize, Option<EntityKey>)> = VecDeque::new();
    queue.extend(tree.roots.iter().map(|root| (*root, None)));
    while let Some((index, parent)) = queue.pop_front() {
        let node = item(&document.root.nodes, index, "node", "the scene")?;
        let local = *item(&tree.locals, index, "node", "the scene")?;
        let name = node.name.as_deref().unwrap_or_default();
        builder.budget.enter(document.node_label(index));
        let entity = builder.spawn(parent, local, name)?;
        entities.insert(index, entity);
        builder.add_components(index, node, entity)?;
        let children = node.children.iter().flatten().map(|child| child.value());
        let shown = children.filter(|child| !tree.is_lod.get(*child).is_some_and(|lod| *lod));
        queue.extend(shown.map(|child| (child, Some(entity))));
    }
    Ok(NodeScene {
        scene: builder.scene,
        entities,
    })
}

/// A scene, and the entities of its nodes.
pub(super) struct NodeScene {
    pub(super) scene: Scene,
    pub(super) entities: Entities,
}

/// Entities by their nodes.
pub(super) type Entities = HashMap<usize, EntityKey>;

/// The identity of a primitive with its levels of detail.
#[derive(PartialEq, Eq, Hash)]
struct PartKey {
    mesh: usize,
    primitive: usize,
    /// The meshes of its coarser levels.
    lods: Vec<usize>,
    /// The node, if the primitive's geometry depends on it.
    node: Option<usize>,
}

/// A primitive of a node's mesh.
struct MeshPart {
    drawable: Drawable,
}

struct SceneBuilder<'a, 'b> {
    document: &'a Document<'b>,
    files: &'a FileResolver<'a>,
    budget: &'a mut Budget,
    scene: Scene,
    materials: Materials,
    parts: HashMap<PartKey, Option<Drawable>>,
    locals: &'a [DAffine3],
    /// The world transforms of nodes.
    worlds: Vec<DAffine3>,
}

impl SceneBuilder<'_, '_> {
    fn spawn(
        &mut self,
        parent: Option<EntityKey>,
        local: DAffine3,
        name: &str,
    ) -> Result<EntityKey, LoadProblem> {
        self.budget.entities(1)?;
        self.budget.name(name)?;
        let entity = self.scene.spawn(parent, local)?;
        if !name.is_empty() {
            self.scene.set_entity_name(entity, name)?;
        }
        Ok(entity)
    }

    /// Sets that an entity is not tested. The default is that it is.
    fn set_tested(&mut self, entity: EntityKey, tested: bool) -> Result<(), LoadProblem> {
        if !tested {
            self.scene.set_tested(entity, false)?;
        }
        Ok(())
    }

    /// Adds a node's mesh, camera and light to its entity.
    fn add_components(
        &mut self,
        index: usize,
        node: &Node,
        entity: EntityKey,
    ) -> Result<(), LoadProblem> {
        let tested = extras::tested(node);
        // This also applies to an entity without a mesh, which may get one later.
        self.set_tested(entity, tested)?;
        if let Some(mesh) = at(node.mesh.as_ref()) {
            let world = self.worlds.get(index);
            if world.is_some_and(|world| world.matrix3 == DMat3::ZERO) {
                let place = self.document.node_label(index);
                let reason = "scaled to nothing";
                (self.budget.left_out).add(LostPart::Entity, reason, &place);
            }
            let parts = self.parts(index, node, mesh)?;
            match extras::instances(self.document, index, node, self.budget)? {
                None => self.set_parts(entity, &parts, tested)?,
                Some(instances) => {
                    for local in instances {
                        let instance = self.scene.spawn(Some(entity), local)?;
                        self.set_tested(instance, tested)?;
                        self.set_parts(instance, &parts, tested)?;
                    }
                }
            }
        }
        let user = || self.document.node_label(index);
        if let Some(camera) = at(node.camera.as_ref()) {
            let camera = item(&self.document.root.cameras, camera, "camera", &user())?;
            let projection = projection(camera);
            if projection.is_none() {
                let reason = "a camera without a projection";
                (self.budget.left_out).add(LostPart::Element, reason, &user());
            }
            if let Some(projection) = projection {
                let camera = Camera {
                    projection,
                    position: DVec3::ZERO,
                    rotation: DQuat::IDENTITY,
                };
                self.scene.set_camera(entity, camera)?;
            }
        }
        let light = node
            .extensions
            .as_ref()
            .and_then(|e| e.khr_lights_punctual.as_ref());
        if let Some(light) = light {
            let all = self.document.root.extensions.as_ref();
            let all = all.and_then(|e| e.khr_lights_punctual.as_ref());
            let all = all.map_or(&[][..], |lights| lights.lights.as_slice());
            let light = punctual(item(all, light.light.value(), "light", &user())?);
            if light.is_none() {
                let reason = "a light of an unknown kind";
                (self.budget.left_out).add(LostPart::Element, reason, &user());
            }
            if let Some(light) = light {
                self.scene.set_light(entity, light)?;
            }
        }
        Ok(())
    }

    /// A single part becomes the entity's own drawable. Several parts become children.
    fn set_parts(
        &mut self,
        entity: EntityKey,
        parts: &[MeshPart],
        tested: bool,
    ) -> Result<(), LoadProblem> {
        if let [only] = parts {
            self.scene.set_drawable(entity, only.drawable)?;
            return Ok(());
        }
        for part in parts {
            let mesh = self.scene.mesh(part.drawable.mesh);
            let name = mesh.map_or_else(String::new, |mesh| mesh.name.clone());
            let child = self.spawn(Some(entity), DAffine3::IDENTITY, &name)?;
            self.scene.set_drawable(child, part.drawable)?;
            self.set_tested(child, tested)?;
        }
        Ok(())
    }

    /// The parts of a node's mesh. Each part is read once, for any number of nodes.
    fn parts(
        &mut self,
        index: usize,
        node: &Node,
        mesh: usize,
    ) -> Result<Vec<MeshPart>, LoadProblem> {
        let user = self.document.node_label(index);
        let source = item(&self.document.root.meshes, mesh, "mesh", &user)?;
        let lods = self.lods(index, node, source.primitives.len());
        let moved = lods.iter().any(|lod| lod.relative.is_some());
        let alone = moved || node.weights.is_some() || node.skin.is_some();
        // Each node lists its mesh's parts, and each part its levels.
        let listed = source.primitives.len() as u64;
        self.budget
            .work(listed.saturating_mul(1 + lods.len() as u64))?;
        let pose = match node.skin {
            Some(_) if !source.primitives.is_empty() => Pose::of(
                self.document,
                index,
                &self.worlds,
                &mut self.budget.left_out,
            )?,
            _ => None,
        };
        let mut parts = Vec::with_capacity(source.primitives.len());
        for primitive in 0..source.primitives.len() {
            let key = PartKey {
                mesh,
                primitive,
                lods: lods.iter().map(|lod| lod.mesh).collect(),
                node: alone.then_some(index),
            };
            let part = match self.parts.get(&key) {
                Some(part) => *part,
                None => {
                    let list = size_of::<PartKey>() + key.lods.len() * size_of::<usize>();
                    self.budget.memory(list as u64)?;
                    let part = self.part(node, pose.as_ref(), &key, &lods)?;
                    self.parts.insert(key, part);
                    part
                }
            };
            if let Some(drawable) = part {
                parts.push(MeshPart { drawable });
            }
        }
        Ok(parts)
    }

    fn part(
        &mut self,
        node: &Node,
        pose: Option<&Pose>,
        key: &PartKey,
        lods: &[Lod],
    ) -> Result<Option<Drawable>, LoadProblem> {
        let weights = node.weights.as_deref();
        let Some(full) = self.geometry(key.mesh, key.primitive, weights, pose)? else {
            return Ok(None);
        };
        let mut levels = vec![full];
        for lod in lods {
            let level = self.geometry(lod.mesh, key.primitive, None, pose)?;
            levels.extend(level.map(|level| match &lod.relative {
                None => level,
                Some(relative) => transformed(level, relative),
            }));
        }
        let is_proxy = levels.len() > 1
            && levels
                .last()
                .is_some_and(|l| l.topology == Topology::Triangles);
        let proxy = if is_proxy { levels.pop() } else { None };
        let source = item(&self.document.root.meshes, key.mesh, "mesh", "a node")?;
        let primitive = item(&source.primitives, key.primitive, "primitive", "a node")?;
        let mut name = match source.name.as_deref() {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => label("mesh", key.mesh, None),
        };
        if source.primitives.len() > 1 {
            name = format!("{name}, primitive {}", key.primitive);
            // As long as it is paid for: a text that grows takes twice its length.
            name.shrink_to_fit();
        }
        self.budget.mesh(&name)?;
        let mesh = self.scene.add_mesh(Mesh {
            name,
            levels,
            proxy,
        })?;
        let material = at(primitive.material.as_ref());
        let material = (self.materials).get(
            material,
            self.document,
            &mut self.scene,
            self.files,
            self.budget,
        )?;
        Ok(Some(Drawable { mesh, material }))
    }

    fn geometry(
        &mut self,
        mesh: usize,
        primitive: usize,
        weights: Option<&[f32]>,
        pose: Option<&Pose>,
    ) -> Result<Option<Geometry>, LoadProblem> {
        let source = item(&self.document.root.meshes, mesh, "mesh", "a node")?;
        let weights = weights.or(source.weights.as_deref()).unwrap_or_default();
        let source = item(&source.primitives, primitive, "primitive", "a node")?;
        let named = self.document.root.meshes.get(mesh);
        let named = label("mesh", mesh, named.and_then(|mesh| mesh.name.as_deref()));
        self.budget.enter(format!("{named}, primitive {primitive}"));
        let request = Request {
            mesh,
            primitive,
            uv_set: material::uv_set(self.document, at(source.material.as_ref())),
            weights,
            pose,
        };
        geometry::read(self.document, source, &request, self.budget)
    }

    /// The coarser levels of a node's mesh. A level whose primitives do not correspond is ignored.
    fn lods(&mut self, index: usize, node: &Node, primitives: usize) -> Vec<Lod> {
        let mut lods = Vec::new();
        for id in extras::lods(node) {
            let nodes = &self.document.root.nodes;
            let mesh = nodes.get(id).and_then(|node| at(node.mesh.as_ref()));
            let source = mesh.and_then(|mesh| self.document.root.meshes.get(mesh));
            let place = || format!("node {id} of {}", self.document.node_label(index));
            let (Some(mesh), Some(source)) = (mesh, source) else {
                let reason = "a node that is not there or has no mesh";
                (self.budget.left_out).add(LostPart::Level, reason, &place());
                continue;
            };
            let (own, other) = (self.locals.get(index), self.locals.get(id));
            let relative = if own == other {
                None
            } else {
                own.zip(other).map(|(own, other)| own.inverse() * *other)
            };
            let undone = relative.is_none_or(|relative| relative.is_finite());
            if source.primitives.len() == primitives && undone {
                lods.push(Lod { mesh, relative });
            } else {
                let reason = "it does not correspond to its node";
                (self.budget.left_out).add(LostPart::Level, reason, &place());
            }
        }
        lods
    }
}

/// A coarser level of a mesh.
struct Lod {
    mesh: usize,
    /// The transform from the level's node to the full mesh's node, if they differ.
    relative: Option<DAffine3>,
}

fn transformed(mut geometry: Geometry, transform: &DAffine3) -> Geometry {
    for position in &mut geometry.positions {
        let moved = transform.transform_point3(Vec3::from(*position).as_dvec3());
        *position = moved.as_vec3().to_array();
    }
    for normal in &mut geometry.normals {
        let turned = transform.transform_vector3(Vec3::from(*normal).as_dvec3());
        *normal = turned.normalize_or_zero().as_vec3().to_array();
    }
    geometry
}
