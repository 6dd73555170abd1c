//! From a declared graph to a plan, or to everything that is wrong with it.

use crate::compile::device::Capabilities;
use crate::compile::lifetimes::Layout;
use crate::compile::order::Step;
use crate::compile::versions::Versions;
use crate::error::{CompileError, CompileErrors};
use crate::graph::Graph;
use crate::pass::PassKind;
use crate::physical::{Physical, PhysicalTexture};
use crate::plan::Plan;
use crate::read_back::AnyRing;
use crate::resource::Kind;
use crate::store::Store;
use crate::sync::Staging;

pub(crate) mod check;
pub(crate) mod device;
pub(crate) mod flow;
pub(crate) mod lifetimes;
pub(crate) mod order;
pub(crate) mod prune;
pub(crate) mod versions;

/// Who submits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// The plan: [`Plan::execute`] submits, and may wait.
    Owned,
    /// Somebody else: [`Plan::record`] records into their encoder and never waits.
    Embedded,
}

/// What a plan is compiled for.
#[derive(Clone, Copy, Debug)]
pub struct CompileOptions<'a> {
    /// The device the plan will run on.
    pub device: &'a wgpu::Device,
    /// The adapter the device came from, if at hand: then its own limits are known, without it the backend's are assumed.
    pub adapter: Option<&'a wgpu::Adapter>,
    /// Who submits.
    pub mode: Mode,
    /// Measure passes from the start; see [`Plan::set_timing`].
    pub timing: bool,
    /// Slots of the ring of each frame-late read-back, at least 1.
    pub read_back_slots: usize,
}

impl<'a> CompileOptions<'a> {
    /// A plan that submits, no timing, rings of three slots.
    #[must_use]
    pub fn owned(device: &'a wgpu::Device) -> Self {
        Self {
            device,
            adapter: None,
            mode: Mode::Owned,
            timing: false,
            read_back_slots: 3,
        }
    }

    /// The same for a plan that records into somebody else's encoder.
    #[must_use]
    pub fn embedded(device: &'a wgpu::Device) -> Self {
        Self {
            mode: Mode::Embedded,
            ..Self::owned(device)
        }
    }

    /// With the adapter the device came from.
    #[must_use]
    pub fn adapter(mut self, adapter: &'a wgpu::Adapter) -> Self {
        self.adapter = Some(adapter);
        self
    }

    /// Measuring passes from the start.
    #[must_use]
    pub fn timing(mut self, timing: bool) -> Self {
        self.timing = timing;
        self
    }
}

impl Graph {
    /// Checks the graph, orders it, makes its resources.
    ///
    /// # Errors
    /// Everything that is wrong, at once: cycles, reads of what nobody wrote, writers without an order, uses the formats cannot have,
    /// features and limits the device lacks, and in embedded mode sync points and host loops.
    pub fn compile(mut self, options: &CompileOptions<'_>) -> Result<Plan, CompileErrors> {
        let mut errors = std::mem::take(&mut self.faults);
        let versions = Versions::new(&self);
        let edges = versions.edges(&self);
        check::declaration(&self, &versions, &edges, &mut errors);
        order::cycles(&self, &edges, &mut errors);
        let kept = prune::kept(&self, &versions);
        let capabilities = Capabilities::new(options.device, options.adapter);
        device::device(&self, &kept, &capabilities, &mut errors);
        if options.mode == Mode::Embedded {
            self.embeddable(&kept, &mut errors);
        }
        if !errors.is_empty() {
            return Err(self.refused(errors));
        }

        let steps = order::schedule(&self, None, &edges, &kept);
        let persistent = lifetimes::persistent(&self, &versions, &kept);
        let prepared = flow::prepare(&self, &steps, &persistent);
        let mut store = Store::default();
        let mut layout = lifetimes::place(&self, &versions, &kept, &steps, &persistent, &mut store);
        self.widen(&mut layout, &prepared, &capabilities, &mut errors);
        if !errors.is_empty() {
            return Err(self.refused(errors));
        }
        let made = guarded(options.device, || {
            Made::new(&self, &layout, &steps, options)
        });
        tracing::debug!(
            graph = self.name,
            passes = self.passes.len(),
            pruned = kept.iter().filter(|kept| !**kept).count(),
            textures = layout.textures.len(),
            buffers = layout.buffers.len(),
            "compiled"
        );
        match made {
            Ok(made) => Ok(Plan::assemble(
                self,
                options,
                crate::plan::Compiled {
                    steps,
                    prepared,
                    kept,
                    layout,
                    store,
                    made,
                    read_only_depth: capabilities.read_only_depth(),
                },
            )),
            Err(message) => Err(self.refused(vec![CompileError::Device { message }])),
        }
    }

    fn refused(&self, errors: Vec<CompileError>) -> CompileErrors {
        CompileErrors {
            graph: self.name.clone(),
            errors,
        }
    }

    /// An embedded plan can neither wait nor loop.
    fn embeddable(&self, kept: &[bool], errors: &mut Vec<CompileError>) {
        for (index, pass) in self.passes.iter().enumerate() {
            if !kept[index] {
                continue;
            }
            if pass.kind == PassKind::HostLoop {
                errors.push(CompileError::LoopInEmbedded {
                    pass: pass.name.clone(),
                });
            }
            for used in &pass.uses {
                if used.access == crate::access::Access::ReadBack {
                    errors.push(CompileError::SyncInEmbedded {
                        pass: pass.name.clone(),
                        resource: self.resources[used.resource()].name.clone(),
                    });
                }
            }
        }
    }

    /// Usages that follow from clears of their own and from outputs.
    fn widen(
        &self,
        layout: &mut Layout,
        prepared: &[flow::Prepared],
        capabilities: &Capabilities<'_>,
        errors: &mut Vec<CompileError>,
    ) {
        for (index, pass) in prepared.iter().enumerate() {
            for (raw, _, _) in &pass.clears {
                let resource = raw.resource();
                let Kind::Texture(desc) = self.resources[resource].kind else {
                    continue;
                };
                let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
                if capabilities.format_allows(desc.format, usage) {
                    layout.add_texture_usage(resource, usage);
                } else {
                    errors.push(CompileError::Usage {
                        pass: self.passes[index].name.clone(),
                        resource: self.resources[resource].name.clone(),
                        access: "a texture to be cleared",
                        format: desc.format,
                    });
                }
            }
        }
        for output in &self.outputs {
            if let Kind::Texture(desc) = self.resources[output.resource()].kind {
                for usage in [
                    wgpu::TextureUsages::COPY_SRC,
                    wgpu::TextureUsages::TEXTURE_BINDING,
                ] {
                    let single = desc.samples == 1 || usage != wgpu::TextureUsages::COPY_SRC;
                    if single && capabilities.format_allows(desc.format, usage) {
                        layout.add_texture_usage(output.resource(), usage);
                    }
                }
            }
        }
    }
}

/// The wgpu objects of a plan.
pub(crate) struct Made {
    pub physical: Physical,
    pub staging: Vec<Staging>,
    pub rings: Vec<Box<dyn AnyRing>>,
    /// By ring of the declaration: its place in `rings`, if kept.
    pub ring_places: Vec<Option<usize>>,
}

impl Made {
    fn new(graph: &Graph, layout: &Layout, steps: &[Step], options: &CompileOptions<'_>) -> Self {
        let device = options.device;
        let mut staging = Vec::new();
        Step::each(steps, false, &mut |pass, _| {
            for used in &graph.passes[pass].uses {
                if used.access == crate::access::Access::ReadBack {
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
        Step::each(steps, false, &mut |pass, _| kept[pass] = true);
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
                        options.read_back_slots,
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

/// Runs `make` and catches what the device says, where it says so at once (everywhere but in browsers).
fn guarded<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, String> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let said = [now(validation.pop()), now(memory.pop())];
    match said.into_iter().flatten().next() {
        Some(error) => Err(error.to_string()),
        None => Ok(made),
    }
}

fn now(future: impl Future<Output = Option<wgpu::Error>>) -> Option<wgpu::Error> {
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    match std::pin::pin!(future).poll(&mut context) {
        std::task::Poll::Ready(error) => error,
        std::task::Poll::Pending => None,
    }
}
