//! What moves in a scene by itself: clips of keyframes that move nodes, bend skinned meshes and blend morph targets.
//!
//! [`Animation::pose`] samples one clip at one time into a [`Scene`]: the local transforms of entities, and the vertices of meshes that deform. All that follows from
//! them, boxes above all, is [`Scene::update`]'s and holds for this pose alone. A pose depends on clip and time alone, so that poses may be visited in any order.
//!
//! `keyframes` are values over time, `clip` is what they drive, `rig` the nodes and joints, `deform` the vertices. Interpolation, skins and morph targets are those of
//! glTF 2.0; skinning is linear blending (Magnenat-Thalmann, Laperriere and Thalmann, *Joint-Dependent Local Deformations for Hand Animation and Object Grasping*, 1988).

mod clip;
mod deform;
mod error;
mod keyframes;
mod rig;

pub use clip::{Channel, Clip, Curve};
pub use deform::{DeformedMesh, Influence, Influences, MorphTarget};
pub use error::{AnimationError, KeyframesProblem};
pub use keyframes::{Interpolation, Keyframes};
pub use rig::{Joint, NodeTransform, RigNode, Skin};

use std::collections::HashMap;

use glam::DAffine3;

use crate::keys::EntityKey;
use crate::scene::Scene;
use rig::Pose;

/// From a mesh as its file has it to its place with a joint, seen from the node that has the mesh.
pub type JointTransform = DAffine3;

/// The parts of an [`Animation`], before they are checked.
#[derive(Clone, Debug, Default)]
pub struct AnimationParts {
    /// The nodes; each after its parent.
    pub nodes: Vec<RigNode>,
    /// The skins.
    pub skins: Vec<Skin>,
    /// The meshes that deform.
    pub meshes: Vec<DeformedMesh>,
    /// The clips.
    pub clips: Vec<Clip>,
}

/// A rig, the meshes that it deforms, and the clips that it can play.
///
/// ```
/// use antumbra_scene::animation::{
///     Animation, AnimationParts, Channel, Clip, Curve, Interpolation, Keyframes, NodeTransform, RigNode,
/// };
/// use antumbra_scene::Scene;
/// use glam::{DAffine3, DVec3};
///
/// let mut scene = Scene::new();
/// let door = scene.spawn(None, DAffine3::IDENTITY)?;
/// let way = Keyframes::new(Interpolation::Linear, vec![0.0, 2.0], vec![0.0, 0.0, 0.0, 4.0, 0.0, 0.0], 3)?;
/// let animation = Animation::new(AnimationParts {
///     nodes: vec![RigNode { parent: None, rest: NodeTransform::IDENTITY, entity: Some(door) }],
///     clips: vec![Clip::new("open", vec![Channel { node: 0, curve: Curve::Translation(way) }])],
///     ..AnimationParts::default()
/// })?;
/// animation.pose(&mut scene, 0, 0.5)?;
/// assert_eq!(scene.local(door), Some(DAffine3::from_translation(DVec3::X)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Animation {
    parts: AnimationParts,
    /// By node, whether any clip moves it.
    is_driven: Vec<bool>,
}

impl Animation {
    /// An animation of these parts.
    ///
    /// # Errors
    /// [`AnimationError::BadPart`]: an index out of range, a node before its parent, keyframes of another width than what they drive, influences or displacements
    /// that are not one a vertex.
    pub fn new(parts: AnimationParts) -> Result<Self, AnimationError> {
        parts.validate()?;
        let mut is_driven = vec![false; parts.nodes.len()];
        let channels = parts.clips.iter().flat_map(|clip| &clip.channels);
        for channel in channels.filter(|channel| channel.curve.moves_node()) {
            if let Some(driven) = is_driven.get_mut(channel.node) {
                *driven = true;
            }
        }
        Ok(Self { parts, is_driven })
    }

    /// The clips.
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.parts.clips
    }

    /// The first clip of this name.
    #[must_use]
    pub fn clip_named(&self, name: &str) -> Option<usize> {
        self.parts.clips.iter().position(|clip| clip.name == name)
    }

    /// The meshes that deform.
    #[must_use]
    pub fn meshes(&self) -> &[DeformedMesh] {
        &self.parts.meshes
    }

    /// The entities that some clip moves. Those below them move along.
    pub fn moved_entities(&self) -> impl Iterator<Item = EntityKey> + '_ {
        let nodes = self.parts.nodes.iter().zip(&self.is_driven);
        nodes.filter_map(|(node, driven)| node.entity.filter(|_| *driven))
    }

    /// Brings the scene to a clip's pose at a time in seconds. A clip repeats: see [`Clip::time_within`]. What the clip does not drive is at rest. Entities and
    /// meshes that are no longer in the scene are skipped. [`Scene::update`] makes the boxes follow.
    ///
    /// # Errors
    /// An unknown clip; a time that is not finite; [`AnimationError::Scene`] for values that lead to a transform or a vertex which is not finite.
    pub fn pose(&self, scene: &mut Scene, clip: usize, time: f64) -> Result<(), AnimationError> {
        let known = self.parts.clips.get(clip);
        let clip = known.ok_or(AnimationError::UnknownClip {
            clip,
            count: self.parts.clips.len(),
        })?;
        if !time.is_finite() {
            return Err(AnimationError::BadTime { time });
        }
        self.show(scene, &clip.channels, clip.time_within(time))
    }

    /// Brings the scene to rest.
    ///
    /// # Errors
    /// As for [`Self::pose`].
    pub fn rest(&self, scene: &mut Scene) -> Result<(), AnimationError> {
        self.show(scene, &[], 0.0)
    }

    /// Leaves the scene as it is now, for good: its meshes no longer deform, so that all may be found out about their shapes.
    pub fn stop(self, scene: &mut Scene) {
        for deformed in self.parts.meshes {
            scene.stop_deforming(deformed.mesh);
        }
    }

    fn show(
        &self,
        scene: &mut Scene,
        channels: &[Channel],
        time: f64,
    ) -> Result<(), AnimationError> {
        let pose = Pose::new(&self.parts.nodes, channels, time);
        let driven = self.parts.nodes.iter().zip(&self.is_driven);
        let places = driven.zip(&pose.locals);
        for ((node, _), local) in places.filter(|((_, driven), _)| **driven) {
            if let Some(entity) = node.entity
                && scene.local(entity).is_some_and(|present| present != *local)
            {
                scene.set_local(entity, *local)?;
            }
        }
        let weights = channels.iter().filter_map(|channel| match &channel.curve {
            Curve::Weights(keyframes) => Some((channel.node, keyframes)),
            _ => None,
        });
        let weights: HashMap<usize, &Keyframes> = weights.collect();
        let mut palette = Palette::default();
        for deformed in &self.parts.meshes {
            if scene.mesh(deformed.mesh).is_none() {
                continue;
            }
            let weights = weights.get(&deformed.node).map(|keys| keys.sample(time));
            let weights = weights.as_deref().unwrap_or(&deformed.weights);
            let joints = palette.of(&self.parts.skins, &pose, deformed);
            let vertices = deformed.vertices(weights, joints);
            scene.set_vertices(deformed.mesh, vertices.positions, vertices.normals)?;
        }
        Ok(())
    }
}

/// The joints of the last mesh in a pose. The primitives of a mesh in glTF follow one another and share skin and node. Earlier ones are not kept: joints times nodes
/// may be many.
#[derive(Default)]
struct Palette {
    /// The skin and the node.
    user: Option<(usize, usize)>,
    transforms: Option<Vec<JointTransform>>,
}

impl Palette {
    /// The transforms of a mesh's joints; `None` for one without a skin, or as flat as its node.
    fn of(
        &mut self,
        skins: &[Skin],
        pose: &Pose,
        deformed: &DeformedMesh,
    ) -> Option<&[JointTransform]> {
        let (number, node) = (deformed.skin?, deformed.node);
        let skin = skins.get(number)?;
        if self.user != Some((number, node)) {
            self.user = Some((number, node));
            self.transforms = skin.transforms(&pose.worlds, node);
        }
        self.transforms.as_deref()
    }
}

impl AnimationParts {
    fn validate(&self) -> Result<(), AnimationError> {
        let bad = |part: String, problem: String| AnimationError::BadPart { part, problem };
        let count = self.nodes.len();
        for (index, node) in self.nodes.iter().enumerate() {
            if node.parent.is_some_and(|parent| parent >= index) {
                let problem = "its parent does not come before it".to_owned();
                return Err(bad(format!("node {index}"), problem));
            }
        }
        let known = |node: usize, part: &dyn Fn() -> String| match node < count {
            true => Ok(()),
            false => Err(bad(
                part(),
                format!("node {node} of {count} does not exist"),
            )),
        };
        for (index, skin) in self.skins.iter().enumerate() {
            let part = || format!("skin {index}");
            for joint in &skin.joints {
                known(joint.node, &part)?;
            }
        }
        for (index, mesh) in self.meshes.iter().enumerate() {
            let part = || format!("mesh {index}");
            known(mesh.node, &part)?;
            let skin = match mesh.skin.map(|skin| self.skins.get(skin)) {
                None => None,
                Some(Some(skin)) => Some(skin),
                Some(None) => return Err(bad(part(), "its skin does not exist".to_owned())),
            };
            let joints = skin.map_or(0, |skin| skin.joints.len());
            if let Some(problem) = mesh.problem(joints) {
                return Err(bad(part(), problem));
            }
        }
        for clip in &self.clips {
            for (index, channel) in clip.channels.iter().enumerate() {
                let part = || format!("channel {index} of clip \"{}\"", clip.name);
                known(channel.node, &part)?;
                let width = channel.curve.keyframes().width();
                if let Some(wanted) = channel.curve.width()
                    && width != wanted
                {
                    let problem = format!("{width} numbers a key; {wanted} are needed");
                    return Err(bad(part(), problem));
                }
            }
        }
        Ok(())
    }
}
