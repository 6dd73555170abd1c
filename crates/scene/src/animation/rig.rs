//! The rig: nodes with their transforms at rest, the joints of skins, and the pose that channels give them.

use glam::{DAffine3, DQuat, DVec3};

use super::JointTransform;
use super::clip::{Channel, Curve};
use crate::keys::EntityKey;

/// A node of a rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigNode {
    /// The parent's place in the rig, before this one's own.
    pub parent: Option<usize>,
    /// The transform relative to the parent, at rest.
    pub rest: NodeTransform,
    /// The entity that moves with it; `None` for a joint that is not in the scene.
    pub entity: Option<EntityKey>,
}

/// A transform, and the parts of which channels replace some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeTransform {
    /// All of it.
    pub affine: DAffine3,
    /// Its translation in metres.
    pub translation: DVec3,
    /// Its rotation, of unit length.
    pub rotation: DQuat,
    /// Its scale; may be zero.
    pub scale: DVec3,
}

impl NodeTransform {
    /// No transform.
    pub const IDENTITY: Self = Self {
        affine: DAffine3::IDENTITY,
        translation: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        scale: DVec3::ONE,
    };

    /// A transform of its parts.
    #[must_use]
    pub fn from_parts(translation: DVec3, rotation: DQuat, scale: DVec3) -> Self {
        Self {
            affine: DAffine3::from_scale_rotation_translation(scale, rotation, translation),
            translation,
            rotation,
            scale,
        }
    }

    /// A transform that was given as a whole. Its parts leave out shear; a flat one has no rotation.
    #[must_use]
    pub fn from_affine(affine: DAffine3) -> Self {
        let (scale, rotation, translation) = match affine.matrix3.determinant() == 0.0 {
            false => affine.to_scale_rotation_translation(),
            true => (DVec3::ONE, DQuat::IDENTITY, affine.translation),
        };
        let is_finite = scale.is_finite() && rotation.is_finite();
        let (scale, rotation) = match is_finite {
            true => (scale, rotation),
            false => (DVec3::ONE, DQuat::IDENTITY),
        };
        Self {
            affine,
            translation,
            rotation,
            scale,
        }
    }
}

/// The joints of a skin.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// The joints, in the order in which vertices count them.
    pub joints: Vec<Joint>,
}

impl Skin {
    /// The transforms of the joints, as seen from the node that has the mesh. `worlds` are the transforms of all nodes relative to the same origin.
    ///
    /// `None` where that node's own transform cannot be undone, since the mesh is then as flat as it, and for a node that does not exist.
    #[must_use]
    pub fn transforms(&self, worlds: &[DAffine3], node: usize) -> Option<Vec<JointTransform>> {
        let own = worlds.get(node)?.inverse();
        let joint = |joint: &Joint| Some(own * *worlds.get(joint.node)? * joint.inverse_bind);
        let joints = own.is_finite().then(|| self.joints.iter().map(joint))?;
        joints.collect()
    }
}

/// A joint of a skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The node that is the joint.
    pub node: usize,
    /// From the mesh's space to the joint's, as the mesh was bound.
    pub inverse_bind: DAffine3,
}

/// All nodes at one time.
pub(super) struct Pose {
    /// Relative to the parents.
    pub(super) locals: Vec<DAffine3>,
    /// Relative to the rig's origin.
    pub(super) worlds: Vec<DAffine3>,
}

impl Pose {
    pub(super) fn new(nodes: &[RigNode], channels: &[Channel], time: f64) -> Self {
        let mut driven: Vec<Option<NodeTransform>> = vec![None; nodes.len()];
        for channel in channels.iter().filter(|channel| channel.curve.moves_node()) {
            let (Some(place), Some(node)) = (driven.get_mut(channel.node), nodes.get(channel.node))
            else {
                continue;
            };
            let parts = place.get_or_insert(node.rest);
            match &channel.curve {
                Curve::Translation(keys) => parts.translation = keys.vector(time),
                Curve::Rotation(keys) => parts.rotation = keys.rotation(time),
                Curve::Scale(keys) => parts.scale = keys.vector(time),
                Curve::Weights(_) => {}
            }
        }
        let local = |(node, driven): (&RigNode, Option<NodeTransform>)| match driven {
            None => node.rest.affine,
            Some(NodeTransform {
                translation,
                rotation,
                scale,
                ..
            }) => DAffine3::from_scale_rotation_translation(scale, rotation, translation),
        };
        let locals: Vec<DAffine3> = nodes.iter().zip(driven).map(local).collect();
        let mut worlds: Vec<DAffine3> = Vec::with_capacity(nodes.len());
        for (node, local) in nodes.iter().zip(&locals) {
            let above = node.parent.and_then(|parent| worlds.get(parent));
            worlds.push(above.map_or(*local, |above| *above * *local));
        }
        Self { locals, worlds }
    }
}
