//! The parts of a node's mesh: a mesh of the scene for each primitive, with its levels of detail, or with what deforms it.

use super::deformation::Deformation;
use super::document::{at, item, label};
use super::extras;
use super::geometry::{self, ReadGeometry, Request};
use super::material;
use super::nodes::SceneBuilder;
use super::skin::Pose;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use antumbra_scene::animation::DeformedMesh;
use antumbra_scene::{Drawable, Geometry, Mesh, MeshKey, Topology};
use glam::{DAffine3, Vec3};
use gltf::json::scene::Node;

/// The identity of a primitive with its levels of detail.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct PartKey {
    mesh: usize,
    primitive: usize,
    /// The meshes of its coarser levels.
    lods: Vec<usize>,
    /// The node, if the primitive's geometry depends on it.
    node: Option<usize>,
}

impl SceneBuilder<'_, '_> {
    /// The parts of a node's mesh. Each part is read once, for any number of nodes.
    pub(super) fn parts(
        &mut self,
        index: usize,
        node: &Node,
        mesh: usize,
    ) -> Result<Vec<Drawable>, LoadProblem> {
        let user = self.document.node_label(index);
        let source = item(&self.document.root.meshes, mesh, "mesh", &user)?;
        let mut lods = self.lods(index, node, source.primitives.len());
        let deforms = self.motions.deforms(index);
        if deforms {
            for _ in lods.drain(..) {
                let reason = "its mesh deforms";
                (self.budget.left_out).add(LostPart::Level, reason, &user);
            }
        }
        let moved = lods.iter().any(|lod| lod.relative.is_some());
        let alone = moved || deforms || node.weights.is_some() || node.skin.is_some();
        // Each node lists its mesh's parts, and each part its levels.
        let listed = source.primitives.len() as u64;
        self.budget
            .work(listed.saturating_mul(1 + lods.len() as u64))?;
        let pose = match source.primitives.is_empty() {
            true => None,
            false => self.skin_pose(index, node, deforms)?,
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
                    let part = self.part(index, pose.as_ref(), &key, &lods)?;
                    self.parts.insert(key, part);
                    part
                }
            };
            parts.extend(part);
        }
        Ok(parts)
    }

    fn part(
        &mut self,
        index: usize,
        pose: Option<&Pose>,
        key: &PartKey,
        lods: &[Lod],
    ) -> Result<Option<Drawable>, LoadProblem> {
        let node = item(&self.document.root.nodes, index, "node", "the scene")?;
        let mut shape = Shape {
            mesh: key.mesh,
            weights: node.weights.as_deref(),
            pose,
            deforms: self.motions.deforms(index),
        };
        let Some(ReadGeometry {
            geometry: full,
            deformation,
        }) = self.geometry(key.primitive, &shape)?
        else {
            return Ok(None);
        };
        let mut levels = vec![full];
        shape.weights = None;
        for lod in lods {
            shape.mesh = lod.mesh;
            let level = self.geometry(key.primitive, &shape)?;
            levels.extend(level.map(|level| match &lod.relative {
                None => level.geometry,
                Some(relative) => transformed(level.geometry, relative),
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
        let mesh = Mesh {
            name,
            levels,
            proxy,
        };
        let mesh = match deformation {
            None => self.scene.add_mesh(mesh)?,
            Some(deformation) => {
                let mesh = self.scene.add_deforming_mesh(mesh)?;
                self.deformed(index, node, key.mesh, mesh, deformation);
                mesh
            }
        };
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

    /// The joints of a node's skin at rest. Where the mesh deforms, they need no place at rest.
    fn skin_pose(
        &mut self,
        index: usize,
        node: &Node,
        deforms: bool,
    ) -> Result<Option<Pose>, LoadProblem> {
        if node.skin.is_none() {
            return Ok(None);
        }
        let skin = at(node.skin.as_ref()).and_then(|skin| self.document.root.skins.get(skin));
        let joints = skin.map_or(0, |skin| skin.joints.len());
        self.budget.work(joints as u64)?;
        let pose = Pose::of(self.document, index, &self.worlds, self.budget)?;
        if pose.is_placed() || deforms {
            return Ok(Some(pose));
        }
        let place = self.document.node_label(index);
        let reason = "its node's transform cannot be undone";
        self.budget.left_out.add(LostPart::Skin, reason, &place);
        Ok(None)
    }

    /// Keeps what deforms a mesh.
    fn deformed(
        &mut self,
        index: usize,
        node: &Node,
        source: usize,
        mesh: MeshKey,
        deformation: Deformation,
    ) {
        let source = self.document.root.meshes.get(source);
        let weights = node.weights.as_ref();
        let weights = weights.or(source.and_then(|mesh| mesh.weights.as_ref()));
        self.deformed.push(DeformedMesh {
            mesh,
            node: index,
            skin: at(node.skin.as_ref()),
            positions: deformation.positions,
            normals: deformation.normals,
            targets: deformation.targets,
            weights: weights.cloned().unwrap_or_default(),
            influences: deformation.influences,
        });
    }

    fn geometry(
        &mut self,
        primitive: usize,
        shape: &Shape<'_>,
    ) -> Result<Option<ReadGeometry>, LoadProblem> {
        let mesh = shape.mesh;
        let source = item(&self.document.root.meshes, mesh, "mesh", "a node")?;
        let weights = shape.weights.or(source.weights.as_deref());
        let source = item(&source.primitives, primitive, "primitive", "a node")?;
        let named = self.document.root.meshes.get(mesh);
        let named = label("mesh", mesh, named.and_then(|mesh| mesh.name.as_deref()));
        self.budget.enter(format!("{named}, primitive {primitive}"));
        let request = Request {
            mesh,
            primitive,
            uv_set: material::uv_set(self.document, at(source.material.as_ref())),
            weights: weights.unwrap_or_default(),
            pose: shape.pose,
            deforms: shape.deforms,
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

/// The shape in which a mesh is read.
struct Shape<'a> {
    mesh: usize,
    /// The weights of the morph targets; `None` for the mesh's own.
    weights: Option<&'a [f32]>,
    pose: Option<&'a Pose>,
    /// Whether an animation changes it.
    deforms: bool,
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
