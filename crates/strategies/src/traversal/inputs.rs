//! What every host node of a walk reads, declared and opened in one place.

use antumbra_draw::boxes::BoxContents;
use antumbra_draw::passes::ViewInputs;
use antumbra_draw::{PipelineClass, ViewFrame};
use antumbra_graph::{BodyError, Host, HostBuilder, HostContext};
use antumbra_scene::Topology;
use antumbra_scene::hierarchy::HierarchyShape;

use super::context::TraversalContext;
use super::one_frame::TraversalSettings;
use super::remaining::Remaining;
use antumbra_cull::{CULL, FrameGraph, Tree, ViewNodes};

/// The scene, the view and the tree of a walk.
#[derive(Clone, Copy)]
pub(super) struct TraversalInputs {
    pub inputs: ViewInputs,
    pub how: TraversalSettings,
    tree: Host<Tree>,
    /// What an outer strategy has left of it.
    left: Option<Host<Remaining>>,
    /// What the boxes of the scene hold.
    contents: BoxContents,
}

impl TraversalInputs {
    pub fn new(
        g: &mut FrameGraph<'_>,
        view: &ViewNodes,
        shape: HierarchyShape,
        how: TraversalSettings,
    ) -> Self {
        let line_like = |class: PipelineClass| class.topology() != Topology::Triangles;
        let contents = match g.scene_layout().classes().any(line_like) {
            true => BoxContents::AnyTopology,
            false => BoxContents::Triangles,
        };
        let tree = g.tree(view, shape);
        Self {
            inputs: view.inputs(),
            how,
            tree,
            left: left_of(g, view, tree),
            contents,
        }
    }

    /// Declares that a node looks.
    pub fn declare(&self, node: &mut HostBuilder<'_>) {
        node.group(CULL)
            .read(self.inputs.scene)
            .read(self.inputs.view)
            .read(self.tree);
        if let Some(left) = self.left {
            node.read(left);
        }
    }

    /// Looks.
    pub fn look(
        &self,
        ctx: &HostContext<'_>,
        act: impl FnOnce(&TraversalContext<'_>, &ViewFrame) -> Result<(), BodyError>,
    ) -> Result<(), BodyError> {
        let (scene, frame, tree) = (
            ctx.get(self.inputs.scene)?,
            ctx.get(self.inputs.view)?,
            ctx.get(self.tree)?,
        );
        let left = self.left.map(|left| ctx.get(left)).transpose()?;
        let sight = TraversalContext::new(&scene.table, &tree, &frame, &self.how, self.contents);
        act(&sight.at_what_is(left.as_deref()), &frame)
    }
}

/// A host value that says what an outer strategy has left of a tree, where there is one.
fn left_of(g: &mut FrameGraph<'_>, view: &ViewNodes, tree: Host<Tree>) -> Option<Host<Remaining>> {
    let narrowed = view.narrowed_to()?;
    let scene = view.inputs().scene;
    let left = g.graph().host::<Remaining>(view.named("left of the tree"));
    let mut node = g.graph().host_node(view.named("find what is left"));
    node.group(CULL).read(scene).read(tree).read(narrowed);
    let left = node.write(left);
    node.run(move |ctx| {
        let (scene, tree) = (ctx.get(scene)?, ctx.get(tree)?);
        let slots = scene.table.slots();
        ctx.get_mut(left)?.take(&tree, slots, &*ctx.get(narrowed)?);
        Ok(())
    });
    Some(left)
}
