//! Skins at rest.
//!
//! The vertices of a skinned mesh are at the positions of their joints. Animations are not read, so the vertices are
//! moved there once, and the result is placed at the mesh's own node. If that node's transform is not invertible, the
//! skin is ignored.

use super::accessor::Accessor;
use super::document::{Document, at, item};
use crate::error::LoadProblem;
use crate::left_out::{LeftOut, LostPart};
use antumbra_scene::Geometry;
use glam::{DAffine3, DMat4, DVec3, Vec3};
use gltf::json::accessor::{ComponentType, Type};

/// The transforms of the joints, relative to the node that has the skin.
pub(super) struct Pose {
    joints: Vec<DAffine3>,
}

impl Pose {
    /// The rest pose of a node's skin; `None` if it has none or its transform is not invertible.
    pub(super) fn of(
        document: &Document<'_>,
        node: usize,
        worlds: &[DAffine3],
        left_out: &mut LeftOut,
    ) -> Result<Option<Self>, LoadProblem> {
        let user = document.node_label(node);
        let source = item(&document.root.nodes, node, "node", &user)?;
        let Some(index) = at(source.skin.as_ref()) else {
            return Ok(None);
        };
        let skin = item(&document.root.skins, index, "skin", &user)?;
        let user = format!("skin {index}");
        let binds = match at(skin.inverse_bind_matrices.as_ref()) {
            None => None,
            Some(index) => {
                let binds = Accessor::open(document, index, &user)?;
                let fits = binds.shape == Type::Mat4 && binds.component == ComponentType::F32;
                binds.expect(fits, "inverse bind matrices")?;
                if binds.count < skin.joints.len() {
                    let problem =
                        format!("{} matrices for {} joints", binds.count, skin.joints.len());
                    return Err(binds.bad(problem));
                }
                Some(binds)
            }
        };
        let own = item(worlds, node, "node", &user)?.inverse();
        if !own.is_finite() {
            let place = document.node_label(node);
            let reason = "its node's transform cannot be undone";
            left_out.add(LostPart::Skin, reason, &place);
            return Ok(None);
        }
        let mut joints = Vec::with_capacity(skin.joints.len());
        for (i, joint) in skin.joints.iter().enumerate() {
            let world = item(worlds, joint.value(), "node", &user)?;
            let bind = match &binds {
                None => DAffine3::IDENTITY,
                Some(binds) => {
                    let numbers = binds.finite::<16>(i)?.map(f64::from);
                    DAffine3::from_mat4(DMat4::from_cols_array(&numbers))
                }
            };
            joints.push(own * *world * bind);
        }
        Ok(Some(Self { joints }))
    }

    /// Moves the vertices. `sets` are pairs of joints and weights. `vertices` are the accessors' elements for the
    /// geometry's vertices.
    pub(super) fn apply(
        &self,
        sets: &[(Accessor<'_>, Accessor<'_>)],
        vertices: impl Iterator<Item = usize>,
        geometry: &mut Geometry,
    ) -> Result<(), LoadProblem> {
        let mut normals = geometry.normals.iter_mut();
        for (position, vertex) in geometry.positions.iter_mut().zip(vertices) {
            let normal = normals.next();
            let mut total = 0.0;
            let mut moved = DVec3::ZERO;
            let mut turned = DVec3::ZERO;
            let own = Vec3::from(*position).as_dvec3();
            let own_normal = Vec3::from(normal.as_deref().copied().unwrap_or_default()).as_dvec3();
            for (joints, weights) in sets {
                let each = joints.integers::<4>(vertex).into_iter();
                for (joint, weight) in each.zip(weights.finite::<4>(vertex)?) {
                    if weight == 0.0 {
                        continue;
                    }
                    let transform =
                        item(&self.joints, joint as usize, "joint", "a skinned vertex")?;
                    moved += transform.transform_point3(own) * f64::from(weight);
                    turned += transform.transform_vector3(own_normal) * f64::from(weight);
                    total += f64::from(weight);
                }
            }
            if total > 0.0 {
                *position = (moved / total).as_vec3().to_array();
                if let Some(normal) = normal {
                    *normal = turned.normalize_or_zero().as_vec3().to_array();
                }
            }
        }
        Ok(())
    }
}
