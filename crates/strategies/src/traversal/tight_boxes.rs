//! The query geometry of an inner node: boxes some levels below it, which enclose less empty space than its own.
//!
//! Mattausch, Bittner, Wimmer, *CHC++: Coherent Hierarchical Culling Revisited*, 2008 (tighter bounding volumes).

use antumbra_scene::hierarchy::HierarchyNode;

use super::settings::TightBoxes;

/// The nodes whose boxes a query about a node draws.
#[derive(Debug, Clone, Default)]
pub(crate) struct TightNodes {
    nodes: Vec<u32>,
    /// Reused memory: the next level.
    below: Vec<u32>,
}

/// Most boxes of a node: beyond these, drawing them costs more than the node can save.
const MOST: usize = 64;

impl TightNodes {
    /// The nodes at most `tight.depth` levels below a node whose boxes have at most `tight.surface` times the surface of its own box. The node
    /// itself where there are none. `node_of`: the node of a number; `None` where nothing is to be tested below it.
    pub fn below<'a>(
        &mut self,
        node_of: impl Fn(u32) -> Option<&'a HierarchyNode>,
        number: u32,
        tight: TightBoxes,
    ) -> &[u32] {
        self.nodes.clear();
        self.nodes.push(number);
        let own = node_of(number).map_or(0.0, |node| node.bounds.half_area());
        for _ in 0..tight.depth {
            if !self.descend(&node_of, own * f64::from(tight.surface)) {
                break;
            }
        }
        &self.nodes
    }

    /// Replaces the nodes by their children where these are not too many, and of no more than this half surface. Returns whether there are levels
    /// left below them.
    fn descend<'a>(
        &mut self,
        node_of: &impl Fn(u32) -> Option<&'a HierarchyNode>,
        most: f64,
    ) -> bool {
        self.below.clear();
        let mut deeper = false;
        for number in &self.nodes {
            let Some(node) = node_of(*number) else {
                continue;
            };
            match node.is_leaf() {
                true => self.below.push(*number),
                // A child of which nothing is to be tested has no box.
                false => {
                    (self.below).extend(node.children().filter(|child| node_of(*child).is_some()))
                }
            }
            deeper |= !node.is_leaf();
            if self.below.len() > MOST {
                return false;
            }
        }
        let surfaces = (self.below.iter()).filter_map(|number| node_of(*number));
        let total = surfaces.map(|node| node.bounds.half_area()).sum::<f64>();
        if self.below.is_empty() || total > most {
            return false;
        }
        std::mem::swap(&mut self.nodes, &mut self.below);
        deeper
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_scene::Aabb;
    use antumbra_scene::hierarchy::{GroupTree, GroupedLeaf, Hierarchy, HierarchyShape, NONE};
    use glam::DVec3;

    /// A root of two groups of two unit cubes each: the cubes of a group are 1 m apart, the groups `apart` metres.
    fn two_groups(apart: f64) -> Hierarchy {
        let leaves =
            [(0, 1), (1, 1), (2, 2), (3, 2)].map(|(leaf, group)| GroupedLeaf { leaf, group });
        let tree = GroupTree {
            groups: &[NONE, 0, 0],
            leaves: &leaves,
        };
        let bounds = |leaf: u32| {
            let (group, cube) = (f64::from(leaf / 2), f64::from(leaf % 2));
            Aabb::from_centre(DVec3::X * (group * apart + cube * 2.0), DVec3::splat(0.5))
        };
        Hierarchy::new(tree, HierarchyShape::Groups, bounds).unwrap()
    }

    fn below(tree: &Hierarchy, depth: u32, surface: f32) -> usize {
        let mut nodes = TightNodes::default();
        nodes
            .below(|number| tree.node(number), 0, TightBoxes { depth, surface })
            .len()
    }

    #[test]
    fn it_descends_as_far_as_depth_and_surface_allow() {
        let tree = two_groups(10.0);
        // Half surfaces: the root 13 + 13 + 1 = 27, its two groups 7 each, the four cubes 3 each.
        assert_eq!(below(&tree, 0, 9.0), 1);
        assert_eq!(below(&tree, 1, 1.0), 2);
        assert_eq!(below(&tree, 2, 1.0), 4);
        assert_eq!(below(&tree, 8, 1.0), 4);
        assert_eq!(below(&tree, 8, 14.1 / 27.0), 4);
        assert_eq!(below(&tree, 8, 13.9 / 27.0), 1);
    }
}
