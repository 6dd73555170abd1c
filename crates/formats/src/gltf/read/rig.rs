//! The rig of a file's animations: the nodes that they move, and the joints of the skins that they bend.

use super::document::{Document, item};
use super::motions::Motions;
use super::nodes::Entities;
use super::tree::Tree;
use super::{skin, transform};
use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::animation::{Animation, AnimationParts, DeformedMesh, Joint, RigNode, Skin};
use std::collections::HashMap;

/// The file's animations; `None` where nothing is played.
pub(super) fn build(
    document: &Document<'_>,
    tree: &Tree,
    motions: Motions,
    entities: &Entities,
    mut meshes: Vec<DeformedMesh>,
    budget: &mut Budget,
) -> Result<Option<Animation>, LoadProblem> {
    if motions.clips.is_empty() {
        return Ok(None);
    }
    let mut skins = Skins::default();
    for mesh in &mut meshes {
        let place = document.node_label(mesh.node);
        if let Some(skin) = &mut mesh.skin {
            *skin = skins.number(document, *skin, &place, budget)?;
        }
    }
    // Nodes whose place decides the place of a vertex, and those above them.
    let mut needed = vec![false; tree.locals.len()];
    let joints = skins.list.iter().flat_map(|skin| &skin.joints);
    let nodes = joints.map(|joint| joint.node);
    for node in nodes.chain(meshes.iter().map(|mesh| mesh.node)) {
        if let Some(needed) = needed.get_mut(node) {
            *needed = true;
        }
    }
    tree.mark_ancestors(&mut needed);
    for (needed, driven) in needed.iter_mut().zip(&motions.is_driven) {
        *needed |= driven;
    }
    let Rig { nodes, places } = Rig::of(document, tree, &needed, entities, budget)?;
    let place = |node: usize| places.get(node).copied().flatten();
    let mut clips = motions.clips;
    for channel in clips.iter_mut().flat_map(|clip| &mut clip.channels) {
        channel.node = place(channel.node).unwrap_or_default();
    }
    for mesh in &mut meshes {
        mesh.node = place(mesh.node).unwrap_or_default();
    }
    let joints = skins.list.iter_mut().flat_map(|skin| &mut skin.joints);
    for joint in joints {
        joint.node = place(joint.node).unwrap_or_default();
    }
    let animation = Animation::new(AnimationParts {
        nodes,
        skins: skins.list,
        meshes,
        clips,
    });
    Ok(Some(animation?))
}

/// The skins that are bent, each once.
#[derive(Default)]
struct Skins {
    list: Vec<Skin>,
    numbers: HashMap<usize, usize>,
}

impl Skins {
    /// The place of a file's skin in the list.
    fn number(
        &mut self,
        document: &Document<'_>,
        skin: usize,
        place: &str,
        budget: &mut Budget,
    ) -> Result<usize, LoadProblem> {
        if let Some(number) = self.numbers.get(&skin) {
            return Ok(*number);
        }
        let read = skin::read(document, skin, place, budget)?;
        budget.memory((read.joints.len() * size_of::<Joint>()) as u64)?;
        let number = self.list.len();
        self.list.push(read);
        self.numbers.insert(skin, number);
        Ok(number)
    }
}

/// The nodes of a rig.
struct Rig {
    nodes: Vec<RigNode>,
    /// Their places, by the numbers of the file's nodes.
    places: Vec<Option<usize>>,
}

impl Rig {
    fn of(
        document: &Document<'_>,
        tree: &Tree,
        needed: &[bool],
        entities: &Entities,
        budget: &mut Budget,
    ) -> Result<Self, LoadProblem> {
        let mut nodes = Vec::new();
        let mut places = vec![None; needed.len()];
        for &index in &tree.order {
            if needed.get(index) != Some(&true) {
                continue;
            }
            budget.memory(size_of::<RigNode>() as u64)?;
            let node = item(&document.root.nodes, index, "node", "the rig")?;
            let json = item(&document.nodes, index, "node", "the rig")?;
            let rest = transform::parts(node, json).map_err(|problem| LoadProblem::BadNode {
                node: document.node_label(index),
                problem,
            })?;
            let parent = tree.parents.get(index).copied().flatten();
            if let Some(place) = places.get_mut(index) {
                *place = Some(nodes.len());
            }
            nodes.push(RigNode {
                parent: parent.and_then(|parent| places.get(parent).copied().flatten()),
                rest,
                entity: entities.get(&index).copied(),
            });
        }
        Ok(Self { nodes, places })
    }
}
