//! The vertices of meshes that deform: morph targets first, then skins.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::JointTransform;
use crate::keys::MeshKey;
use crate::mesh::Geometry;

/// A mesh whose vertices move.
#[derive(Clone, Debug, PartialEq)]
pub struct DeformedMesh {
    /// The mesh, added with [`Scene::add_deforming_mesh`](crate::Scene::add_deforming_mesh).
    pub mesh: MeshKey,
    /// The node that has it, by its place in the rig.
    pub node: usize,
    /// The skin, by its place in the rig.
    pub skin: Option<usize>,
    /// Positions before targets and skin, in metres.
    pub positions: Vec<[f32; 3]>,
    /// Normals before targets and skin; one a vertex or none.
    pub normals: Vec<[f32; 3]>,
    /// The morph targets.
    pub targets: Vec<MorphTarget>,
    /// The targets' weights at rest; missing ones are 0.
    pub weights: Vec<f32>,
    /// Which joints move the vertices.
    pub influences: Influences,
}

/// The displacements of one morph target, one a vertex or none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// Of positions, in metres.
    pub positions: Vec<[f32; 3]>,
    /// Of normals.
    pub normals: Vec<[f32; 3]>,
}

/// The joints of all vertices: the same number a vertex, as many as the file has, those without effect with the weight 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Influences {
    /// The number a vertex.
    pub per_vertex: usize,
    /// Vertex by vertex.
    pub list: Vec<Influence>,
}

/// A joint's part in a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// The joint, by its place in the skin.
    pub joint: u32,
    /// Its weight. Those of a vertex need not add up to 1.
    pub weight: f32,
}

/// The vertices of one pose.
pub(super) struct Vertices {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
}

/// Vertices from which the work is shared out among threads.
const PORTION: usize = 1024;

impl MorphTarget {
    /// Adds the displacements, times a weight.
    pub fn add_to(&self, weight: f32, positions: &mut [[f32; 3]], normals: &mut [[f32; 3]]) {
        let add = |values: &mut [[f32; 3]], deltas: &[[f32; 3]]| {
            for (value, delta) in values.iter_mut().zip(deltas) {
                *value = (Vec3::from(*value) + Vec3::from(*delta) * weight).to_array();
            }
        };
        add(positions, &self.positions);
        add(normals, &self.normals);
    }
}

impl Influences {
    /// Moves vertices with their joints. A vertex without a weight, and every vertex where there is no influence, stays.
    pub fn apply(&self, joints: &[JointTransform], geometry: &mut Geometry) {
        self.apply_to(joints, &mut geometry.positions, &mut geometry.normals);
    }

    fn apply_to(
        &self,
        joints: &[JointTransform],
        positions: &mut [[f32; 3]],
        normals: &mut [[f32; 3]],
    ) {
        let Some(each) = std::num::NonZeroUsize::new(self.per_vertex) else {
            return;
        };
        let place = |position: &mut [f32; 3], normal: Option<&mut [f32; 3]>, of: &[Influence]| {
            let own = Vec3::from(*position).as_dvec3();
            let own_normal = Vec3::from(normal.as_deref().copied().unwrap_or_default()).as_dvec3();
            let (mut total, mut moved, mut turned) = (0.0, DVec3::ZERO, DVec3::ZERO);
            for Influence { joint, weight } in of.iter().filter(|of| of.weight != 0.0) {
                let Some(joint) = joints.get(*joint as usize) else {
                    continue;
                };
                let weight = f64::from(*weight);
                moved += joint.transform_point3(own) * weight;
                turned += joint.transform_vector3(own_normal) * weight;
                total += weight;
            }
            if total > 0.0 {
                *position = (moved / total).as_vec3().to_array();
                if let Some(normal) = normal {
                    *normal = turned.normalize_or_zero().as_vec3().to_array();
                }
            }
        };
        let influences = self.list.par_chunks(each.get());
        let positions = positions.par_iter_mut().zip(influences);
        if normals.is_empty() {
            let places = positions.with_min_len(PORTION);
            places.for_each(|(position, of)| place(position, None, of));
        } else {
            let places = positions.zip(normals).with_min_len(PORTION);
            places.for_each(|((position, of), normal)| place(position, Some(normal), of));
        }
    }
}

impl DeformedMesh {
    /// The vertices with these weights and joints; without joints those of the targets alone.
    pub(super) fn vertices(&self, weights: &[f32], joints: Option<&[JointTransform]>) -> Vertices {
        let mut positions = self.positions.clone();
        let mut normals = self.normals.clone();
        let moving = self.targets.iter().zip(weights);
        for (target, weight) in moving.filter(|(_, weight)| **weight != 0.0) {
            target.add_to(*weight, &mut positions, &mut normals);
        }
        if let Some(joints) = joints {
            self.influences
                .apply_to(joints, &mut positions, &mut normals);
        }
        Vertices { positions, normals }
    }

    /// What does not fit, for a skin of so many joints.
    pub(super) fn problem(&self, joints: usize) -> Option<String> {
        let vertices = self.positions.len();
        let fits = |list: &[[f32; 3]]| list.is_empty() || list.len() == vertices;
        if !fits(&self.normals) {
            return Some("its normals are not one a vertex".to_owned());
        }
        let all_fit = |target: &MorphTarget| fits(&target.positions) && fits(&target.normals);
        if !self.targets.iter().all(all_fit) {
            return Some("the displacements of a target are not one a vertex".to_owned());
        }
        let Influences { per_vertex, list } = &self.influences;
        if list.len() != per_vertex.saturating_mul(vertices) {
            return Some("its influences are not as many for each vertex".to_owned());
        }
        let has_joint = |of: &Influence| of.weight == 0.0 || (of.joint as usize) < joints;
        let stray = list.iter().find(|of| !has_joint(of))?;
        Some(format!(
            "joint {} of a vertex is none of the skin's {joints}",
            stray.joint
        ))
    }
}
