//! What every host node of a walk reads, declared and opened in one place.

use antumbra_draw::passes::ViewInputs;
use antumbra_draw::{Class, ViewFrame};
use antumbra_graph::{BodyError, Host, HostBuilder, HostContext};
use antumbra_scene::Topology;
use antumbra_scene::hierarchy::Shape;

use super::sight::Sight;
use super::walk::How;
use crate::frame_graph::{CULL, FrameGraph};
use crate::tree::Tree;
use crate::view_nodes::ViewNodes;

/// The scene, the view and the tree of a walk.
#[derive(Clone, Copy)]
pub(super) struct Looking {
    pub inputs: ViewInputs,
    pub how: How,
    tree: Host<Tree>,
    /// Whether any entity is made of lines or points.
    thin: bool,
}

impl Looking {
    pub fn new(g: &mut FrameGraph<'_>, view: &ViewNodes, shape: Shape, how: How) -> Self {
        let line_like = |class: Class| class.topology() != Topology::Triangles;
        let thin = g.topology().classes().any(line_like);
        Self {
            inputs: view.inputs(),
            how,
            tree: g.tree(view, shape),
            thin,
        }
    }

    /// Declares that a node looks.
    pub fn declare(&self, node: &mut HostBuilder<'_>) {
        node.group(CULL)
            .read(self.inputs.scene)
            .read(self.inputs.view)
            .read(self.tree);
    }

    /// Looks.
    pub fn look(
        &self,
        ctx: &HostContext<'_>,
        act: impl FnOnce(&Sight<'_>, &ViewFrame) -> Result<(), BodyError>,
    ) -> Result<(), BodyError> {
        let (scene, frame, tree) = (
            ctx.get(self.inputs.scene)?,
            ctx.get(self.inputs.view)?,
            ctx.get(self.tree)?,
        );
        let sight = Sight::new(&scene.table, &tree, &frame, &self.how, self.thin);
        act(&sight, &frame)
    }
}
