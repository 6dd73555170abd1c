//! The tree of nodes: a check for cycles, the nodes' transforms, and the nodes that are only levels of detail.

use super::document::{Document, item};
use super::extras;
use super::transform::local;
use crate::error::LoadProblem;
use glam::DAffine3;

/// The checked tree.
pub(super) struct Tree {
    /// The root nodes of the scene.
    pub(super) roots: Vec<usize>,
    /// The transform of each node relative to its parent.
    pub(super) locals: Vec<DAffine3>,
    /// Whether each node is only a level of detail of another.
    pub(super) is_lod: Vec<bool>,
    pub(super) parents: Vec<Option<usize>>,
    /// All nodes, parents first.
    pub(super) order: Vec<usize>,
}

impl Tree {
    pub(super) fn read(document: &Document<'_>) -> Result<Self, LoadProblem> {
        let nodes = &document.root.nodes;
        let name = |index: usize| document.node_label(index);
        let mut parents = vec![None; nodes.len()];
        let mut is_lod = vec![false; nodes.len()];
        let mut locals = Vec::with_capacity(nodes.len());
        for (index, node) in nodes.iter().enumerate() {
            let json = item(&document.nodes, index, "node", "the file")?;
            locals.push(local(node, json).map_err(|problem| LoadProblem::BadNode {
                node: name(index),
                problem,
            })?);
            for child in node.children.iter().flatten().map(|child| child.value()) {
                item(nodes, child, "node", &name(index))?;
                if let Some(parent) = parents.get_mut(child)
                    && let Some(first) = parent.replace(index)
                {
                    return Err(LoadProblem::TwoParents {
                        node: name(child),
                        first: name(first),
                        second: name(index),
                    });
                }
            }
            for id in extras::lods(node) {
                item(nodes, id, "node", &format!("MSFT_lod of {}", name(index)))?;
                if let Some(is_lod) = is_lod.get_mut(id) {
                    *is_lod = id != index;
                }
            }
        }
        let mut order: Vec<usize> = Vec::with_capacity(nodes.len());
        order.extend((0..nodes.len()).filter(|node| parents.get(*node) == Some(&None)));
        let mut next = 0;
        while let Some(node) = order.get(next).and_then(|index| nodes.get(*index)) {
            next += 1;
            order.extend(node.children.iter().flatten().map(|child| child.value()));
        }
        if order.len() < nodes.len() {
            let mut reached = vec![false; nodes.len()];
            for index in order {
                if let Some(reached) = reached.get_mut(index) {
                    *reached = true;
                }
            }
            let lost = reached
                .iter()
                .position(|reached| !reached)
                .unwrap_or_default();
            return Err(LoadProblem::NodeCycle { node: name(lost) });
        }
        let mut roots = roots(document, &parents)?;
        roots.retain(|root| is_lod.get(*root) == Some(&false));
        Ok(Self {
            roots,
            locals,
            is_lod,
            parents,
            order,
        })
    }

    /// Marks all that is below marked nodes.
    pub(super) fn mark_descendants(&self, marked: &mut [bool]) {
        for &index in &self.order {
            let parent = self.parents.get(index).copied().flatten();
            let above = parent.and_then(|parent| marked.get(parent)).copied();
            if above == Some(true)
                && let Some(mark) = marked.get_mut(index)
            {
                *mark = true;
            }
        }
    }

    /// Marks all that is above marked nodes.
    pub(super) fn mark_ancestors(&self, marked: &mut [bool]) {
        for &index in self.order.iter().rev() {
            let parent = self.parents.get(index).copied().flatten();
            if marked.get(index) == Some(&true)
                && let Some(mark) = parent.and_then(|parent| marked.get_mut(parent))
            {
                *mark = true;
            }
        }
    }

    /// The world transform of every node.
    pub(super) fn worlds(&self) -> Vec<DAffine3> {
        let mut worlds = self.locals.clone();
        for &index in &self.order {
            let parent = self.parents.get(index).copied().flatten();
            let above = parent.and_then(|parent| worlds.get(parent)).copied();
            if let (Some(above), Some(world)) = (above, worlds.get_mut(index)) {
                *world = above * *world;
            }
        }
        worlds
    }
}

/// The root nodes of the file's scene, or of the first scene if none is chosen, or every node without a parent if
/// there is no scene.
fn roots(document: &Document<'_>, parents: &[Option<usize>]) -> Result<Vec<usize>, LoadProblem> {
    let root = &document.root;
    let scene = match root.scene {
        Some(index) => Some(item(&root.scenes, index.value(), "scene", "the file")?),
        None => root.scenes.first(),
    };
    let Some(scene) = scene else {
        return Ok((0..parents.len())
            .filter(|node| parents.get(*node) == Some(&None))
            .collect());
    };
    let mut roots: Vec<usize> = Vec::with_capacity(scene.nodes.len());
    let mut listed = vec![false; parents.len()];
    for index in scene.nodes.iter().map(|node| node.value()) {
        let parent = *item(parents, index, "node", "the scene")?;
        let twice = listed
            .get_mut(index)
            .is_some_and(|listed| std::mem::replace(listed, true));
        if parent.is_some() || twice {
            return Err(LoadProblem::TwoParents {
                node: document.node_label(index),
                first: parent.map_or("the scene".into(), |parent| document.node_label(parent)),
                second: "the scene".into(),
            });
        }
        roots.push(index);
    }
    Ok(roots)
}
