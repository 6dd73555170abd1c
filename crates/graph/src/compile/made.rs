//! Makes the wgpu objects of a plan: textures, buffers, staging buffers, read-back rings.

use crate::access::Access;
use crate::compile::flow::Prepared;
use crate::compile::lifetimes::Layout;
use crate::compile::order::Step;
use crate::graph::Graph;
use crate::options::CompileOptions;
use crate::physical::{Physical, PhysicalTexture};
use crate::read_back::AnyRing;
use crate::store::Store;
use crate::sync::Staging;

/// What compiling has found, on its way into a plan.
pub(crate) struct Compiled {
    pub steps: Vec<Step>,
    pub prepared: Vec<Prepared>,
    pub kept: Vec<bool>,
    pub layout: Layout,
    pub store: Store,
    pub made: Made,
    pub read_only_depth: bool,
}

/// The wgpu objects of a plan.
pub(crate) struct Made {
    pub physical: Physical,
    pub staging: Vec<Staging>,
    pub rings: Vec<Box<dyn AnyRing>>,
    /// By declared ring: its index in `rings`, if its pass is kept.
    pub ring_places: Vec<Option<usize>>,
}

impl Made {
    pub fn new(
        graph: &Graph,
        layout: &Layout,
        steps: &[Step],
        options: &CompileOptions<'_>,
    ) -> Self {
        let device = options.device;
        let mut staging = Vec::new();
        Step::each(steps, &mut |pass, _| {
            for used in &graph.passes[pass].uses {
                if used.access == Access::ReadBack {
                    let placed = &layout.placed[used.resource()];
                    staging.push(Staging::new(
                        device,
                        &placed.resource.name,
                        pass,
                        used.raw,
                        placed.bytes(),
                    ));
                }
            }
        });
        let mut kept = vec![false; graph.passes.len()];
        Step::each(steps, &mut |pass, _| kept[pass] = true);
        let mut rings = Vec::new();
        let ring_places = graph
            .rings
            .iter()
            .map(|decl| {
                kept[decl.pass].then(|| {
                    let placed = &layout.placed[decl.buffer];
                    rings.push(decl.make(
                        device,
                        &placed.resource.name,
                        placed.bytes(),
                        options.ring_slots(),
                    ));
                    rings.len() - 1
                })
            })
            .collect();
        Self {
            physical: make_physical(device, layout),
            staging,
            rings,
            ring_places,
        }
    }
}

fn make_physical(device: &wgpu::Device, layout: &Layout) -> Physical {
    Physical {
        textures: layout
            .textures
            .iter()
            .map(|plan| {
                plan.as_ref().map(|plan| {
                    PhysicalTexture::create(device, &plan.label, plan.desc, plan.usages)
                })
            })
            .collect(),
        buffers: layout
            .buffers
            .iter()
            .map(|plan| plan.as_ref().map(|plan| plan.create(device)))
            .collect(),
    }
}
