//! Skins.
//!
//! The vertices of a skinned mesh are at the positions of their joints. Where no animation moves these, the vertices are moved there once, and the result is placed
//! at the mesh's own node. If that node's transform is not invertible, such a skin is ignored.

use super::accessor::Accessor;
use super::document::{Document, at, item};
use super::geometry::Vertices;
use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::Geometry;
use antumbra_scene::animation::{Influence, Influences, Joint, JointTransform, Skin};
use glam::{DAffine3, DMat4};
use gltf::json::accessor::{ComponentType, Type};

/// A skin of the file. Its joints are the file's nodes.
pub(super) fn read(
    document: &Document<'_>,
    index: usize,
    user: &str,
    budget: &mut Budget,
) -> Result<Skin, LoadProblem> {
    let skin = item(&document.root.skins, index, "skin", user)?;
    let user = format!("skin {index}");
    let binds = match at(skin.inverse_bind_matrices.as_ref()) {
        None => None,
        Some(index) => {
            let binds = Accessor::open(document, index, &user, budget)?;
            let fits = binds.shape == Type::Mat4 && binds.component == ComponentType::F32;
            binds.expect(fits, "inverse bind matrices")?;
            if binds.count < skin.joints.len() {
                let problem = format!("{} matrices for {} joints", binds.count, skin.joints.len());
                return Err(binds.bad(problem));
            }
            Some(binds)
        }
    };
    let joint = |(i, joint): (usize, &gltf::json::Index<gltf::json::Node>)| {
        item(&document.root.nodes, joint.value(), "node", &user)?;
        let inverse_bind = match &binds {
            None => DAffine3::IDENTITY,
            Some(binds) => {
                let numbers = binds.finite::<16>(i)?.map(f64::from);
                DAffine3::from_mat4(DMat4::from_cols_array(&numbers))
            }
        };
        Ok(Joint {
            node: joint.value(),
            inverse_bind,
        })
    };
    let joints = skin.joints.iter().enumerate().map(joint);
    Ok(Skin {
        joints: joints.collect::<Result<_, LoadProblem>>()?,
    })
}

/// The joints of a node's skin at rest.
pub(super) struct Pose {
    /// Relative to the node that has the skin; `None` where that one's transform cannot be undone.
    transforms: Option<Vec<JointTransform>>,
    count: usize,
}

impl Pose {
    /// The rest pose of a node's skin.
    pub(super) fn of(
        document: &Document<'_>,
        node: usize,
        worlds: &[DAffine3],
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let user = document.node_label(node);
        let source = item(&document.root.nodes, node, "node", &user)?;
        let skin = match at(source.skin.as_ref()) {
            Some(index) => read(document, index, &user, budget)?,
            None => Skin::default(),
        };
        Ok(Self {
            transforms: skin.transforms(worlds, node),
            count: skin.joints.len(),
        })
    }

    /// Whether the joints have a place at rest.
    pub(super) fn is_placed(&self) -> bool {
        self.transforms.is_some()
    }

    /// The influences on vertices. `sets` are pairs of joints and weights.
    pub(super) fn influences(
        &self,
        sets: &[(Accessor<'_>, Accessor<'_>)],
        vertices: &Vertices<'_>,
        budget: &mut Budget,
    ) -> Result<Influences, LoadProblem> {
        let per_vertex = 4 * sets.len();
        let all = (vertices.count() as u64).saturating_mul(per_vertex as u64);
        budget.work(all)?;
        budget.memory(all.saturating_mul(size_of::<Influence>() as u64))?;
        let mut list = Vec::with_capacity(usize::try_from(all).unwrap_or_default());
        for vertex in vertices.iter() {
            for (joints, weights) in sets {
                let each = joints.integers::<4>(vertex).into_iter();
                for (joint, weight) in each.zip(weights.finite::<4>(vertex)?) {
                    if weight != 0.0 && joint as usize >= self.count {
                        return Err(LoadProblem::MissingReference {
                            place: "a skinned vertex".to_owned(),
                            what: "joint",
                            index: u64::from(joint),
                            count: self.count,
                        });
                    }
                    list.push(Influence { joint, weight });
                }
            }
        }
        Ok(Influences { per_vertex, list })
    }

    /// Moves vertices to their place at rest.
    pub(super) fn apply(&self, influences: &Influences, geometry: &mut Geometry) {
        if let Some(transforms) = &self.transforms {
            influences.apply(transforms, geometry);
        }
    }
}
