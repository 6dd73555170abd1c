//! Transparent entities hide nothing, so a view draws them last: after all opaque entities, far before near.

use antumbra_cull::{CULL, FrameGraph, ListDraws, SceneTable, Verdicts, ViewFrame, ViewNodes};
use antumbra_graph::{BodyError, Host, HostContext};

use antumbra_cull::order::back_to_front;

/// The list of the visible transparent entities; `None` where the scene has no transparent entity.
pub(crate) fn transparent_list(g: &mut FrameGraph<'_>, view: &ViewNodes) -> Option<ListDraws> {
    let name = view.named("visible transparent set");
    g.scene_layout().transparent.then(|| g.unsubmitted(&name))
}

/// Fills the list with the transparent entities whose verdicts draw them, far before near.
pub(crate) fn submit_transparent(
    ctx: &mut HostContext<'_>,
    transparent: Option<ListDraws>,
    table: &SceneTable,
    view: &ViewFrame,
    verdicts: &Verdicts,
) -> Result<(), BodyError> {
    let Some(transparent) = transparent else {
        return Ok(());
    };
    let mut list = ctx.get_mut(transparent.list)?;
    let drawn = verdicts.drawn().filter(|slot| table.is_transparent(*slot));
    back_to_front(&mut list, table, view, drawn.map(|slot| (slot, 0)));
    ctx.upload(transparent.slots, 0, bytemuck::cast_slice(list.slots()))?;
    Ok(())
}

/// Shades the visible transparent entities, in nodes of their own, once the verdicts are final.
pub(crate) fn shade_transparent(
    g: &mut FrameGraph<'_>,
    view: &mut ViewNodes,
    verdicts: Host<Verdicts>,
) {
    let Some(list) = transparent_list(g, view) else {
        return;
    };
    let inputs = view.inputs();
    let mut node = g.graph().host_node(view.named("order the transparent"));
    node.group(CULL)
        .read(inputs.scene)
        .read(inputs.view)
        .read(verdicts);
    let list = list.written_by(&mut node);
    node.run(move |ctx| {
        let (scene, frame, verdicts) = (
            ctx.get(inputs.scene)?,
            ctx.get(inputs.view)?,
            ctx.get(verdicts)?,
        );
        submit_transparent(ctx, Some(list), &scene.table, &frame, &verdicts)
    });
    g.shade_list(view, "transparent", list);
}
