//! Construction of entities from the node tree: one per node, one more per primitive if a mesh has several, and one
//! per instance of a repeated mesh. All walks use queues, so the tree may have any depth.

use super::document::{Document, at, item};
use super::extras;
use super::lights_and_cameras::{projection, punctual};
use super::material::Materials;
use super::motions::Motions;
use super::parts::PartKey;
use super::tree::Tree;
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::file_resolver::FileResolver;
use crate::left_out::LostPart;
use antumbra_scene::animation::DeformedMesh;
use antumbra_scene::{Camera, Drawable, EntityKey, Scene};
use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json::scene::Node;
use std::collections::{HashMap, VecDeque};

/// Builds the file's scene, with the entity of each of its nodes.
pub(super) fn build(
    document: &Document<'_>,
    tree: &Tree,
    motions: &Motions,
    files: &FileResolver<'_>,
    budget: &mut Budget,
) -> Result<NodeScene, LoadProblem> {
    let mut builder = SceneBuilder {
        document,
        files,
        budget,
        scene: Scene::new(),
        materials: Materials::default(),
        parts: HashMap::new(),
        locals: &tree.locals,
        worlds: tree.worlds(),
        motions,
        deformed: Vec::new(),
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
        deformed: builder.deformed,
    })
}

/// A scene, and the entities of its nodes.
pub(super) struct NodeScene {
    pub(super) scene: Scene,
    pub(super) entities: Entities,
    /// The meshes that deform, with nodes and skins as the file numbers them.
    pub(super) deformed: Vec<DeformedMesh>,
}

/// Entities by their nodes.
pub(super) type Entities = HashMap<usize, EntityKey>;

pub(super) struct SceneBuilder<'a, 'b> {
    pub(super) document: &'a Document<'b>,
    pub(super) files: &'a FileResolver<'a>,
    pub(super) budget: &'a mut Budget,
    pub(super) scene: Scene,
    pub(super) materials: Materials,
    pub(super) parts: HashMap<PartKey, Option<Drawable>>,
    pub(super) locals: &'a [DAffine3],
    /// The world transforms of nodes.
    pub(super) worlds: Vec<DAffine3>,
    pub(super) motions: &'a Motions,
    /// The meshes that deform so far.
    pub(super) deformed: Vec<DeformedMesh>,
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
            let is_nothing = world.is_some_and(|world| world.matrix3 == DMat3::ZERO);
            if is_nothing && !self.motions.moves(index) {
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
        parts: &[Drawable],
        tested: bool,
    ) -> Result<(), LoadProblem> {
        if let [only] = parts {
            self.scene.set_drawable(entity, *only)?;
            return Ok(());
        }
        for part in parts {
            let mesh = self.scene.mesh(part.mesh);
            let name = mesh.map_or_else(String::new, |mesh| mesh.name.clone());
            let child = self.spawn(Some(entity), DAffine3::IDENTITY, &name)?;
            self.scene.set_drawable(child, *part)?;
            self.set_tested(child, tested)?;
        }
        Ok(())
    }
}
