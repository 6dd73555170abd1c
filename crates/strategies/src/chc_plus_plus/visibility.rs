//! What is known of the nodes of a tree from the frames before: which were visible, since when others are hidden, and when a visible node is
//! tested again.
//!
//! Mattausch, Bittner, Wimmer, *CHC++: Coherent Hierarchical Culling Revisited*, 2008. A node is visible if anything below it is (pull-up, from
//! Bittner, Wimmer, Piringer, Purgathofer, *Coherent Hierarchical Culling*, 2004).

use antumbra_scene::hierarchy::Hierarchy;

use crate::traversal::{TraversalSettings, TreeVersion};

/// What is known of a node. Frames are the view's own count, from 1; 0 is never.
#[derive(Debug, Clone, Copy, Default)]
struct NodeHistory {
    /// The last frame in which something below it was visible.
    visible: u32,
    /// The last frame in which a query found it hidden.
    hidden: u32,
    /// The first of the frames in a row in which it was found hidden.
    hidden_since: u32,
    /// A leaf that is visible is tested again from this frame on.
    test_from: u32,
    /// Until this frame the node is opened although everything below it is hidden.
    open_until: u32,
}

/// The histories of one view's nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct Visibility {
    nodes: Vec<NodeHistory>,
    frame: u32,
    version: Option<TreeVersion>,
}

/// Frames for which a node that a query found visible is opened although everything below it is hidden: its own box would be found visible again.
const HOLD: u32 = 32;

impl Visibility {
    /// Starts a frame. What is known of another tree, or from before a camera cut, is dropped.
    pub fn begin(&mut self, version: TreeVersion) {
        self.frame += 1;
        if self.version.replace(version) != Some(version) {
            self.nodes.clear();
        }
    }

    /// Whether a node was visible in the last frame, or is held open.
    pub fn was_visible(&self, node: u32) -> bool {
        let history = self.of(node);
        let visible = history.visible > 0 && history.visible + 1 >= self.frame;
        visible || history.open_until >= self.frame
    }

    /// The frames for which a node has been hidden; 0 where it was not found hidden in the last frame.
    pub fn hidden_for(&self, node: u32) -> u32 {
        let history = self.of(node);
        match history.hidden > 0 && history.hidden + 1 >= self.frame {
            true => history.hidden - history.hidden_since + 1,
            false => 0,
        }
    }

    /// Whether a visible leaf is to be tested again.
    pub fn is_due(&self, node: u32) -> bool {
        self.of(node).test_from <= self.frame
    }

    /// Takes a leaf for visible in this frame, and with it all nodes above it. One that was not visible before is tested for the first time some frames
    /// later.
    pub fn show(&mut self, tree: &Hierarchy, settings: &TraversalSettings, leaf: u32) {
        if !self.was_visible(leaf) {
            self.schedule(settings, leaf, true);
        }
        self.pull_up(tree, leaf);
    }

    /// Takes the answer "visible" about a leaf that is visible already.
    pub fn confirm(&mut self, settings: &TraversalSettings, leaf: u32) {
        self.schedule(settings, leaf, false);
    }

    /// Takes a node and all nodes above it for visible in this frame.
    pub fn pull_up(&mut self, tree: &Hierarchy, node: u32) {
        let mut at = node;
        while let Some(above) = tree.node(at).map(|node| node.parent) {
            let frame = self.frame;
            let history = self.of_mut(at);
            if std::mem::replace(&mut history.visible, frame) == frame {
                break;
            }
            at = above;
        }
    }

    /// Chooses the frame in which a visible leaf is tested again.
    fn schedule(&mut self, settings: &TraversalSettings, leaf: u32, first: bool) {
        let (lifetime, frame) = (settings.lifetime.visible, self.frame);
        let frames = (settings.retests).frames_to_next(lifetime, leaf, frame, first);
        self.of_mut(leaf).test_from = frame + frames;
    }

    /// Takes the answer "hidden" about a node.
    pub fn found_hidden(&mut self, node: u32) {
        let since = match self.hidden_for(node) {
            0 => self.frame,
            frames => self.frame - frames,
        };
        let frame = self.frame;
        let history = self.of_mut(node);
        (history.visible, history.hidden, history.hidden_since) = (0, frame, since);
    }

    /// Takes the answer "visible" about an inner node, which is opened for some frames.
    pub fn open(&mut self, node: u32) {
        let until = self.frame + HOLD;
        self.of_mut(node).open_until = until;
    }

    fn of(&self, node: u32) -> NodeHistory {
        self.nodes.get(node as usize).copied().unwrap_or_default()
    }

    fn of_mut(&mut self, node: u32) -> &mut NodeHistory {
        let at = node as usize;
        if self.nodes.len() <= at {
            self.nodes.resize(at + 1, NodeHistory::default());
        }
        &mut self.nodes[at]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::traversal::Retests;
    use antumbra_scene::Aabb;
    use antumbra_scene::hierarchy::{GroupTree, GroupedLeaf, HierarchyShape, NONE};
    use glam::DVec3;

    const SETTINGS: TraversalSettings = {
        let mut settings = TraversalSettings::PAPER;
        settings.lifetime.visible = 5;
        settings.retests = Retests::Regular;
        settings
    };

    /// A root of two groups of two leaves each, and the nodes of the four leaves.
    fn tree() -> (Hierarchy, [u32; 4]) {
        let leaves =
            [(0, 1), (1, 1), (2, 2), (3, 2)].map(|(leaf, group)| GroupedLeaf { leaf, group });
        let groups = GroupTree {
            groups: &[NONE, 0, 0],
            leaves: &leaves,
        };
        let bounds = |leaf: u32| Aabb::from_centre(DVec3::X * f64::from(leaf), DVec3::splat(0.1));
        let tree = Hierarchy::new(groups, HierarchyShape::Groups, bounds).unwrap();
        let nodes = [0, 1, 2, 3].map(|leaf| tree.node_of(leaf).unwrap());
        (tree, nodes)
    }

    #[test]
    fn a_visible_leaf_makes_the_nodes_above_it_visible_for_one_frame() {
        let (tree, [leaf, .., other]) = tree();
        let group = |leaf: u32| tree.node(leaf).unwrap().parent;
        let mut visibility = Visibility::default();
        visibility.begin(TreeVersion::default());
        visibility.show(&tree, &SETTINGS, leaf);
        visibility.begin(TreeVersion::default());
        let visible = [leaf, group(leaf), 0, group(other), other];
        let visible = visible.map(|node| visibility.was_visible(node));
        assert_eq!(visible, [true, true, true, false, false]);
        visibility.begin(TreeVersion::default());
        assert!(
            ![leaf, group(leaf), 0]
                .iter()
                .any(|node| visibility.was_visible(*node))
        );
    }

    #[test]
    fn a_leaf_is_due_at_the_end_of_its_period_and_again_after_it_was_confirmed() {
        let (tree, [leaf, ..]) = tree();
        let mut visibility = Visibility::default();
        let mut due = Vec::new();
        for frame in 1..=20 {
            visibility.begin(TreeVersion::default());
            if visibility.was_visible(leaf) && visibility.is_due(leaf) {
                due.push(frame);
                visibility.confirm(&SETTINGS, leaf);
            }
            visibility.show(&tree, &SETTINGS, leaf);
        }
        assert_eq!(due, [6, 11, 16]);
    }

    #[test]
    fn frames_in_a_row_are_counted_and_a_gap_or_a_cut_ends_them() {
        let (_, [leaf, ..]) = tree();
        let mut visibility = Visibility::default();
        let cut = |cuts| TreeVersion {
            cuts,
            ..TreeVersion::default()
        };
        let mut hidden_for = Vec::new();
        for (cuts, found) in [
            (0, true),
            (0, true),
            (0, true),
            (0, false),
            (0, true),
            (0, true),
            (1, true),
        ] {
            visibility.begin(cut(cuts));
            hidden_for.push(visibility.hidden_for(leaf));
            if found {
                visibility.found_hidden(leaf);
            }
        }
        assert_eq!(hidden_for, [0, 1, 2, 3, 0, 1, 0]);
    }
}
