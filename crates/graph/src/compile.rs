//! Compiles a declared graph into a plan, or into a list of everything that is wrong with it.

pub use crate::compile::device::reads_drawn_samples;

use crate::access::Access;
use crate::compile::device::Capabilities;
use crate::compile::lifetimes::Layout;
use crate::compile::made::{Compiled, Made};
use crate::compile::versions::Versions;
use crate::error::{CompileError, CompileErrors};
use crate::graph::Graph;
use crate::options::{CompileOptions, Mode};
use crate::pass::PassKind;
use crate::plan::Plan;
use crate::resource::Kind;
use crate::store::Store;

pub(crate) mod check;
pub(crate) mod device;
pub(crate) mod flow;
pub(crate) mod lifetimes;
pub(crate) mod made;
pub(crate) mod order;
pub(crate) mod prune;
pub(crate) mod versions;

impl Graph {
    /// Checks the graph, orders its passes and makes its resources.
    ///
    /// # Errors
    /// Everything that is wrong, at once: cycles, reads before any write, writers without an order, uses that a format does not allow,
    /// features and limits that the device lacks, in embedded mode sync points and host loops, and in a browser sync points.
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
            self.check_embedded(&kept, &mut errors);
        } else if !can_wait(options.device) {
            self.check_browser(&kept, &mut errors);
        }
        if !errors.is_empty() {
            return Err(self.refused(errors));
        }

        let steps = order::schedule(&self, None, &edges, &kept);
        let persistent = lifetimes::persistent(&self, &versions, &kept);
        let prepared = flow::prepare(&self, &steps, &persistent);
        let mut store = Store::default();
        let mut layout = lifetimes::place(&self, &versions, &kept, &steps, &persistent, &mut store);
        self.add_usages(&mut layout, &prepared, &capabilities, &mut errors);
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
                Compiled {
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

    /// Refuses what an embedded plan cannot do: wait for the GPU, and loop.
    fn check_embedded(&self, kept: &[bool], errors: &mut Vec<CompileError>) {
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
                if used.access == Access::ReadBack {
                    errors.push(CompileError::SyncInEmbedded {
                        pass: pass.name.clone(),
                        resource: self.resources[used.resource()].name.clone(),
                    });
                }
            }
        }
    }

    /// Refuses what waits for the GPU.
    fn check_browser(&self, kept: &[bool], errors: &mut Vec<CompileError>) {
        let kept = self.passes.iter().zip(kept).filter(|(_, kept)| **kept);
        for (pass, used) in
            kept.flat_map(|(pass, _)| pass.uses.iter().map(move |used| (pass, used)))
        {
            if used.access == Access::ReadBack {
                errors.push(CompileError::SyncInBrowser {
                    pass: pass.name.clone(),
                    resource: self.resources[used.resource()].name.clone(),
                });
            }
        }
    }

    /// Adds the texture usages that clears outside of the passes, and outputs, need.
    fn add_usages(
        &self,
        layout: &mut Layout,
        prepared: &[flow::Prepared],
        capabilities: &Capabilities<'_>,
        errors: &mut Vec<CompileError>,
    ) {
        for (index, pass) in prepared.iter().enumerate() {
            for part in &pass.clears {
                let resource = part.raw.resource();
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

/// Whether the host can wait for this device: everywhere but in browsers.
fn can_wait(device: &wgpu::Device) -> bool {
    device.adapter_info().backend != wgpu::Backend::BrowserWebGpu
}

/// Runs `make` and returns the error that the device reports meanwhile. In a browser it reports later, to whoever listens to its errors.
fn guarded<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, String> {
    if !can_wait(device) {
        return Ok(make());
    }
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let [validation, memory] = [now(validation.pop()), now(memory.pop())];
    // What there is no memory for is also invalid, which says less.
    match memory.or(validation) {
        Some(error) => Err(error.to_string()),
        None => Ok(made),
    }
}

/// The future's value, if it has one already.
fn now(future: impl Future<Output = Option<wgpu::Error>>) -> Option<wgpu::Error> {
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    match std::pin::pin!(future).poll(&mut context) {
        std::task::Poll::Ready(error) => error,
        std::task::Poll::Pending => None,
    }
}
