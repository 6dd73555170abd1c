//! What the file's animations move: their clips, and which nodes and meshes these change.
//!
//! A scene can do without its animations, so what is wrong with one is left out and noted; limits of the load hold for them as for all else.

use super::document::{Document, at, label};
use super::keyframes::{self, ChannelLoss, KeyShape};
use super::tree::Tree;
use crate::budget::Budget;
use crate::error::LoadProblem;
use crate::left_out::LostPart;
use antumbra_scene::animation::{Channel, Clip, Curve};
use gltf::json::Mesh;
use gltf::json::accessor::Type;
use gltf::json::animation::{Animation, Property, Sampler};
use gltf::json::validation::Checked;

/// The clips of a file, whose nodes are numbered as in the file.
pub(super) struct Motions {
    pub(super) clips: Vec<Clip>,
    /// By node, whether a clip moves it or what it hangs on.
    is_moved: Vec<bool>,
    /// By node, whether a clip or a joint changes the vertices of its mesh.
    deforms: Vec<bool>,
    /// By node, whether a clip drives its transform or its weights.
    pub(super) is_driven: Vec<bool>,
}

impl Motions {
    pub(super) fn read(
        document: &Document<'_>,
        tree: &Tree,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let count = document.root.nodes.len();
        let meshes = document.root.meshes.iter();
        let targets: Vec<usize> = meshes.map(most_targets).collect();
        let mut clips = Vec::new();
        for (index, animation) in document.root.animations.iter().enumerate() {
            let place = label("animation", index, animation.name.as_deref());
            budget.enter(place.as_str());
            let channels = channels(document, &targets, animation, &place, budget)?;
            if channels.is_empty() {
                let reason = "no channel of it can be played";
                budget.left_out.add(LostPart::Animation, reason, &place);
                continue;
            }
            let name = animation.name.clone().unwrap_or_default();
            budget.name(&name)?;
            clips.push(Clip::new(name, channels));
        }
        let mut this = Self {
            is_moved: vec![false; count],
            deforms: vec![false; count],
            is_driven: vec![false; count],
            clips,
        };
        if !this.clips.is_empty() {
            this.mark(document, tree);
        }
        Ok(this)
    }

    /// Whether a clip moves a node or what it hangs on.
    pub(super) fn moves(&self, node: usize) -> bool {
        self.is_moved.get(node).is_some_and(|moved| *moved)
    }

    /// Whether a clip changes the vertices of a node's mesh.
    pub(super) fn deforms(&self, node: usize) -> bool {
        self.deforms.get(node).is_some_and(|deforms| *deforms)
    }

    fn mark(&mut self, document: &Document<'_>, tree: &Tree) {
        for channel in self.clips.iter().flat_map(|clip| &clip.channels) {
            let marks = match channel.curve.moves_node() {
                true => &mut self.is_moved,
                false => &mut self.deforms,
            };
            for marks in [marks, &mut self.is_driven] {
                if let Some(mark) = marks.get_mut(channel.node) {
                    *mark = true;
                }
            }
        }
        tree.mark_descendants(&mut self.is_moved);
        // Many nodes may share a skin of many joints.
        let skins = document.root.skins.iter();
        let moves = skins.map(|skin| {
            let mut joints = skin.joints.iter();
            joints.any(|joint| self.moves(joint.value()))
        });
        let moves: Vec<bool> = moves.collect();
        for (index, node) in document.root.nodes.iter().enumerate() {
            let Some(skin) = at(node.skin.as_ref()) else {
                continue;
            };
            // A mesh that moves away from its joints is held by them too.
            let is_bent = moves.get(skin).is_some_and(|moves| *moves) || self.moves(index);
            if is_bent && let Some(deforms) = self.deforms.get_mut(index) {
                *deforms = true;
            }
        }
    }
}

/// The morph targets of that primitive of a mesh which has the most.
fn most_targets(mesh: &Mesh) -> usize {
    let targets = mesh.primitives.iter();
    let targets = targets.map(|one| one.targets.as_ref().map_or(0, Vec::len));
    targets.max().unwrap_or(0)
}

/// The channels that can be played; the others are noted. `targets` are the morph targets of each mesh.
fn channels(
    document: &Document<'_>,
    targets: &[usize],
    animation: &Animation,
    place: &str,
    budget: &mut Budget,
) -> Result<Vec<Channel>, LoadProblem> {
    let mut channels = Vec::new();
    for (index, channel) in animation.channels.iter().enumerate() {
        let node = channel.target.node.value();
        let target = (
            channel.target.path,
            animation.samplers.get(channel.sampler.value()),
        );
        budget.memory(size_of::<Channel>() as u64)?;
        let read = match target {
            (Checked::Valid(property), Some(sampler)) => {
                curve(document, targets, node, property, sampler, budget)
            }
            (Checked::Invalid, _) => {
                Err(ChannelLoss::reason("it moves a property that is not read"))
            }
            (_, None) => Err(ChannelLoss::reason("its sampler does not exist")),
        };
        match read {
            Ok(curve) => channels.push(Channel { node, curve }),
            Err(ChannelLoss::Refused(problem)) => return Err(*problem),
            Err(ChannelLoss::LeftOut { reason, detail }) => {
                let example = match detail {
                    Some(detail) => format!("channel {index} of {place}: {detail}"),
                    None => format!("channel {index} of {place}"),
                };
                budget.left_out.add(LostPart::Channel, &reason, &example);
            }
        }
    }
    Ok(channels)
}

fn curve(
    document: &Document<'_>,
    targets: &[usize],
    node: usize,
    property: Property,
    sampler: &Sampler,
    budget: &mut Budget,
) -> Result<Curve, ChannelLoss> {
    let Some(target) = document.root.nodes.get(node) else {
        return Err(ChannelLoss::reason("its node does not exist"));
    };
    let mut read = |element, rows| {
        let shape = KeyShape { element, rows };
        keyframes::read(document, sampler, shape, budget)
    };
    Ok(match property {
        Property::Translation => Curve::Translation(read(Type::Vec3, 1)?),
        Property::Rotation => Curve::Rotation(read(Type::Vec4, 1)?),
        Property::Scale => Curve::Scale(read(Type::Vec3, 1)?),
        Property::MorphTargetWeights => {
            let mesh = at(target.mesh.as_ref());
            match mesh.and_then(|mesh| targets.get(mesh).copied()) {
                None | Some(0) => {
                    return Err(ChannelLoss::reason("its node has no morph targets"));
                }
                Some(targets) => Curve::Weights(read(Type::Scalar, targets)?),
            }
        }
    })
}
