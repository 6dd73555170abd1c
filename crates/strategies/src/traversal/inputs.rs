//! What every host node of a traversal reads, declared and opened in one place.

use antumbra_cull::boxes::BoxContents;
use antumbra_cull::{CULL, FrameGraph, PipelineClass, Tree, ViewFrame, ViewInputs, ViewNodes};
use antumbra_graph::{BodyError, Host, HostBuilder, HostContext};
use antumbra_scene::Topology;
use antumbra_scene::hierarchy::HierarchyShape;

use super::context::TraversalContext;
use super::remaining::Remaining;
use super::settings::TraversalSettings;

/// The scene, the view, the tree and the settings of a traversal.
#[derive(Clone, Copy)]
pub(super) struct TraversalInputs {
    pub view: ViewInputs,
    pub settings: TraversalSettings,
    tree: Host<Tree>,
    /// What an outer strategy has left of the tree.
    remaining: Option<Host<Remaining>>,
    /// What the boxes of the scene's entities hold.
    contents: BoxContents,
}

impl TraversalInputs {
    pub fn new(
        g: &mut FrameGraph<'_>,
        view: &ViewNodes,
        shape: HierarchyShape,
        settings: TraversalSettings,
    ) -> Self {
        let line_like = |class: PipelineClass| class.topology() != Topology::Triangles;
        let contents = match g.scene_layout().classes().any(line_like) {
            true => BoxContents::AnyTopology,
            false => BoxContents::Triangles,
        };
        let tree = g.tree(view, shape);
        Self {
            view: view.inputs(),
            settings,
            tree,
            remaining: remaining_of(g, view, tree),
            contents,
        }
    }

    /// Declares on a host node that it reads the inputs.
    pub fn read_by(&self, node: &mut HostBuilder<'_>) {
        node.group(CULL)
            .read(self.view.scene)
            .read(self.view.view)
            .read(self.tree);
        if let Some(remaining) = self.remaining {
            node.read(remaining);
        }
    }

    /// Opens the inputs in a node's body and runs `body` on them.
    pub fn with_context(
        &self,
        ctx: &HostContext<'_>,
        body: impl FnOnce(&TraversalContext<'_>, &ViewFrame) -> Result<(), BodyError>,
    ) -> Result<(), BodyError> {
        let (scene, frame, tree) = (
            ctx.get(self.view.scene)?,
            ctx.get(self.view.view)?,
            ctx.get(self.tree)?,
        );
        let remaining = self.remaining.map(|value| ctx.get(value)).transpose()?;
        let context =
            TraversalContext::new(&scene.table, &tree, &frame, &self.settings, self.contents);
        body(&context.restricted_to(remaining.as_deref()), &frame)
    }
}

/// What an outer strategy has left of a tree; `None` where there is no outer strategy.
fn remaining_of(
    g: &mut FrameGraph<'_>,
    view: &ViewNodes,
    tree: Host<Tree>,
) -> Option<Host<Remaining>> {
    let narrowed = view.narrowed_to()?;
    let scene = view.inputs().scene;
    let remaining = g.graph().host::<Remaining>(view.named("remaining nodes"));
    let mut node = g.graph().host_node(view.named("find remaining nodes"));
    node.group(CULL).read(scene).read(tree).read(narrowed);
    let remaining = node.write(remaining);
    node.run(move |ctx| {
        let (scene, tree) = (ctx.get(scene)?, ctx.get(tree)?);
        let slots = scene.table.slots();
        ctx.get_mut(remaining)?
            .update(&tree, slots, &*ctx.get(narrowed)?);
        Ok(())
    });
    Some(remaining)
}
