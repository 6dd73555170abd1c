//! What the executor does to the resources of each pass besides calling its body: the first writer clears, the last user discards.

use std::collections::HashSet;

use crate::access::Access;
use crate::compile::order::Step;
use crate::graph::Graph;
use crate::handle::Raw;
use crate::resource::Kind;

/// One attachment of a raster pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attachment {
    pub raw: Raw,
    pub access: Access,
    pub mip: u32,
    pub layer: u32,
    /// The pass is the first writer of the frame, so it clears; in a loop, in the first iteration.
    pub first: bool,
    /// The contents are used later.
    pub store: bool,
}

/// One mip and layer of a texture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subresource {
    pub raw: Raw,
    pub mip: u32,
    pub layer: u32,
}

/// What the executor does for a pass besides calling its body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Prepared {
    /// Buffers set to zero before the pass.
    pub zeroes: Vec<Raw>,
    /// Mips and layers that are cleared by render passes of their own, since this pass does not attach them.
    pub clears: Vec<Subresource>,
    pub attachments: Vec<Attachment>,
    /// The buffer that takes the results of its queries.
    pub queries: Option<Raw>,
}

/// By pass. `persistent` says by resource whether its contents are read after its last use in the schedule.
pub(crate) fn prepare(graph: &Graph, steps: &[Step], persistent: &[bool]) -> Vec<Prepared> {
    let mut order = Vec::new();
    Step::each(steps, &mut |pass, looped| order.push((pass, looped)));
    let mut last_use = vec![usize::MAX; graph.resources.len()];
    for &(pass, _) in &order {
        for used in &graph.passes[pass].uses {
            last_use[used.resource()] = pass;
        }
    }
    let mut prepared = vec![Prepared::default(); graph.passes.len()];
    let mut begun = HashSet::new();
    for (pass, looped) in order {
        let mine = &mut prepared[pass];
        for used in &graph.passes[pass].uses {
            let resource = used.resource();
            let declared = &graph.resources[resource];
            if used.raw.is_previous() || used.access.is_late() {
                if used.access.is_attachment() {
                    mine.attachments.push(Attachment {
                        raw: used.raw,
                        access: used.access,
                        mip: used.mip,
                        layer: used.layer,
                        first: false,
                        store: true,
                    });
                }
                continue;
            }
            match declared.kind {
                Kind::Buffer(desc) => {
                    if used.access == Access::Queries {
                        mine.queries = Some(used.raw);
                    }
                    let first = used.access.writes() && begun.insert((resource, 0, 0));
                    if first && desc.zeroed && !used.access.updates() {
                        mine.zeroes.push(used.raw);
                    }
                }
                Kind::Texture(desc) if used.access.is_attachment() => {
                    let fresh = begun.insert((resource, used.mip, used.layer));
                    let defined = declared.import && desc.clear.is_none();
                    mine.attachments.push(Attachment {
                        raw: used.raw,
                        access: used.access,
                        mip: used.mip,
                        layer: used.layer,
                        first: fresh && !defined && used.access.writes(),
                        store: looped
                            || declared.import
                            || persistent[resource]
                            || last_use[resource] != pass
                            || desc.mips * desc.layers > 1,
                    });
                }
                Kind::Texture(desc) if used.access.writes() => {
                    for (mip, layer) in
                        (0..desc.mips).flat_map(|m| (0..desc.layers).map(move |l| (m, l)))
                    {
                        if begun.insert((resource, mip, layer)) && desc.clear.is_some() {
                            mine.clears.push(Subresource {
                                raw: used.raw,
                                mip,
                                layer,
                            });
                        }
                    }
                }
                _ => {}
            }
        }
    }
    prepared
}
