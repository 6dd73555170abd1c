//! Records the steps of a plan: passes, sync points, loops.

mod raster;

use std::cell::RefCell;

use web_time::Instant;

use crate::access::Access;
use crate::bind::Caches;
use crate::body::Body;
use crate::compile::flow::{Attachment, Prepared, Subresource};
use crate::compile::order::Step;
use crate::context::{ComputeContext, CopyContext, HostContext};
use crate::error::{AccessError, BodyError, ExecuteError};
use crate::frame::{Frame, PassView};
use crate::pass::Pass;
use crate::physical::PhysicalTexture;
use crate::queries::QuerySets;
use crate::report::FrameReport;
use crate::sync::{Arrival, Staging};
use crate::timing::{Recorded, Timing};

/// The encoder that commands are recorded into.
pub(crate) enum Target<'e> {
    /// The plan's own, which it submits.
    Own(wgpu::CommandEncoder),
    /// The caller's.
    Caller(&'e mut wgpu::CommandEncoder),
}

impl Target<'_> {
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        match self {
            Self::Own(encoder) => encoder,
            Self::Caller(encoder) => encoder,
        }
    }
}

/// Where in the host loops a step runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iteration {
    /// The iteration of the innermost loop; 0 outside of loops.
    pub number: u32,
    /// It is the first iteration of all loops around the step.
    pub first: bool,
}

impl Iteration {
    /// Outside of all loops.
    pub const OUTSIDE: Self = Self {
        number: 0,
        first: true,
    };
}

/// Whether an attachment is cleared before a pass and stored after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AttachmentOps {
    /// Cleared, if the pass is the attachment's first writer.
    pub clear: bool,
    /// Stored; else discarded.
    pub store: bool,
}

/// A frame under recording.
pub(crate) struct Recorder<'a, 'e> {
    pub frame: &'a Frame<'a>,
    pub passes: &'a [Pass],
    pub prepared: &'a [Prepared],
    pub caches: &'a Caches,
    pub bodies: &'a mut [Body],
    pub staging: &'a mut [Staging],
    pub query_sets: &'a mut QuerySets,
    pub belt: &'a mut wgpu::util::StagingBelt,
    pub timing: &'a mut Timing,
    pub target: Target<'e>,
    pub read_only_depth: bool,
    pub fault: &'a RefCell<Option<AccessError>>,
    pub report: FrameReport,
}

impl<'a> Recorder<'a, '_> {
    /// Records steps.
    pub fn steps(&mut self, steps: &[Step], at: Iteration) -> Result<(), ExecuteError> {
        for step in steps {
            match step {
                Step::Pass(pass) => self.pass(*pass, at)?,
                Step::Sync(passes) => {
                    self.sync(passes, at)?;
                    for pass in passes {
                        self.pass(*pass, at)?;
                    }
                    self.staging.iter_mut().for_each(Staging::close);
                }
                Step::Loop(pass, steps) => self.host_loop(*pass, steps, at.first)?,
            }
        }
        Ok(())
    }

    fn view(&self, pass: usize, at: Iteration) -> PassView<'a> {
        let declared = &self.passes[pass];
        PassView {
            frame: self.frame,
            name: &declared.name,
            uses: &declared.uses,
            index: pass,
            iteration: at.number,
            cache: &self.caches[pass],
            fault: self.fault,
        }
    }

    /// The error of a body with the pass's name, or a misuse that the body got no error for.
    fn outcome(&self, pass: usize, result: Result<(), BodyError>) -> Result<(), ExecuteError> {
        let fault = self.fault.borrow_mut().take().map(BodyError::from);
        match result.err().or(fault) {
            None => Ok(()),
            Some(error) => Err(ExecuteError::Body {
                pass: self.passes[pass].name.clone(),
                source: error.into_inner(),
            }),
        }
    }

    fn pass(&mut self, pass: usize, at: Iteration) -> Result<(), ExecuteError> {
        if at.first {
            self.clear_before(pass);
        }
        let view = self.view(pass, at);
        let declared = &self.passes[pass];
        // The body is taken out so that the recorder can be borrowed. It is put back in every case.
        let mut body = std::mem::replace(&mut self.bodies[pass], Body::None);
        let result = match &mut body {
            Body::None => Ok(()),
            Body::Raster(run) => self.raster(pass, at, view, run),
            Body::Compute(_) if declared.is_idle(view) => Ok(()),
            Body::Compute(run) => {
                let running = self
                    .timing
                    .begin(pass, Recorded::Pass(self.target.encoder()));
                let writes = running
                    .as_ref()
                    .and_then(|running| running.query.as_ref())
                    .and_then(|query| query.compute_pass_timestamp_writes());
                let encoder = self.target.encoder();
                let mut context = ComputeContext {
                    view,
                    pass: encoder
                        .begin_compute_pass(&wgpu::ComputePassDescriptor {
                            label: Some(view.name),
                            timestamp_writes: writes,
                        })
                        .forget_lifetime(),
                };
                let result = run(&mut context);
                drop(context);
                self.timing.end(pass, running, encoder);
                self.outcome(pass, result)
            }
            Body::Copy(run) => {
                let running = self
                    .timing
                    .begin(pass, Recorded::Commands(self.target.encoder()));
                let encoder = self.target.encoder();
                let result = run(&mut CopyContext { view, encoder });
                self.timing.end(pass, running, self.target.encoder());
                self.outcome(pass, result)
            }
            Body::Host(run) => {
                let running = self.timing.begin(pass, Recorded::Nothing);
                let result = run(&mut HostContext {
                    view,
                    encoder: self.target.encoder(),
                    belt: self.belt,
                    staging: self.staging,
                });
                self.timing.end(pass, running, self.target.encoder());
                self.outcome(pass, result)
            }
        };
        self.bodies[pass] = body;
        result
    }

    /// Submits the commands so far, with copies of the buffers that the host nodes read back, and waits. Does nothing where they read no
    /// bytes this time.
    fn sync(&mut self, passes: &[usize], at: Iteration) -> Result<(), ExecuteError> {
        let lost = |pass: usize| ExecuteError::DeviceLost {
            what: format!("waiting at the sync point of `{}`", self.passes[pass].name),
        };
        let mut wanted = 0;
        for &pass in passes {
            let view = self.view(pass, at);
            for (index, used) in view.uses.iter().enumerate() {
                if used.access != Access::ReadBack {
                    continue;
                }
                let bytes = self.passes[pass].wanted_bytes(index, view);
                let size = self.frame.buffer_size(used.raw);
                let bytes = bytes.saturating_add(3).min(size) & !3;
                wanted += bytes;
                let staging = self
                    .staging
                    .iter_mut()
                    .find(|staging| staging.serves(pass, used.raw));
                if let (Some(staging), Some(source)) = (staging, self.frame.buffer(used.raw)) {
                    staging.request(self.target.encoder(), source, bytes);
                }
            }
        }
        if wanted == 0 {
            // No bytes are wanted, so there is nothing to wait for.
            return Ok(());
        }
        let Target::Own(encoder) = &mut self.target else {
            // `compile` refuses sync points in embedded plans.
            return Ok(());
        };
        self.belt.finish_and_recall_on_submit(encoder);
        self.timing.resolve(encoder);
        let fresh = self
            .frame
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: None });
        let recorded = std::mem::replace(encoder, fresh);
        let submission = self.frame.queue.submit([recorded.finish()]);
        let started = Instant::now();
        let waited = self.frame.device.poll(wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: None,
        });
        self.report.waited += started.elapsed();
        self.report.sync_points += 1;
        let first = passes.first().copied().unwrap_or_default();
        if waited.is_err() {
            return Err(lost(first));
        }
        for staging in self
            .staging
            .iter_mut()
            .filter(|staging| passes.contains(&staging.pass))
        {
            match staging.open() {
                Arrival::Here => {}
                Arrival::Lost => return Err(lost(staging.pass)),
                Arrival::NotYet => {
                    return Err(ExecuteError::CannotWait {
                        pass: self.passes[first].name.clone(),
                    });
                }
            }
        }
        Ok(())
    }

    fn host_loop(&mut self, pass: usize, steps: &[Step], first: bool) -> Result<(), ExecuteError> {
        let Some(looped) = self.passes[pass].looped else {
            return Ok(());
        };
        for number in 0..looped.limit {
            let at = Iteration {
                number,
                first: first && number == 0,
            };
            self.steps(steps, at)?;
            self.report.loop_iterations += 1;
            let done = self
                .frame
                .store
                .get::<bool>(self.frame.slot(looped.condition))
                .is_ok_and(|done| *done);
            if done {
                return Ok(());
            }
        }
        Err(ExecuteError::LoopLimit {
            pass: self.passes[pass].name.clone(),
            limit: looped.limit,
        })
    }

    fn clear_before(&mut self, pass: usize) {
        let prepared = &self.prepared[pass];
        for raw in &prepared.zeroes {
            if let Some(buffer) = self.frame.buffer(*raw) {
                let size = self.frame.buffer_size(*raw);
                self.target.encoder().clear_buffer(buffer, 0, Some(size));
            }
        }
        for part in &prepared.clears {
            self.clear_part(*part);
        }
    }

    /// Clears a part of a texture by a render pass of its own.
    fn clear_part(&mut self, part: Subresource) {
        let attachment = Attachment {
            raw: part.raw,
            access: Access::Colour,
            mip: part.mip,
            layer: part.layer,
            first: true,
            store: true,
        };
        let Some((texture, view)) = self.attached(&attachment) else {
            return;
        };
        let depth = texture.desc.format.is_depth_stencil_format();
        let ops = AttachmentOps {
            clear: true,
            store: true,
        };
        let colour = [(!depth).then(|| colour_attachment(texture, view, &attachment, ops))];
        let depth_stencil_attachment =
            depth.then(|| depth_attachment(texture, view, &attachment, ops));
        drop(
            self.target
                .encoder()
                .begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("clear"),
                    color_attachments: if depth { &[] } else { &colour },
                    depth_stencil_attachment,
                    ..Default::default()
                }),
        );
    }

    /// The texture of an attachment and the view to attach.
    fn attached(
        &self,
        attachment: &Attachment,
    ) -> Option<(&'a PhysicalTexture, &'a wgpu::TextureView)> {
        let frame = self.frame;
        let texture = frame.texture(attachment.raw)?;
        Some((texture, texture.part(attachment.mip, attachment.layer)?))
    }
}

/// A colour attachment with its load and store operations.
fn colour_attachment<'v>(
    texture: &PhysicalTexture,
    view: &'v wgpu::TextureView,
    attachment: &Attachment,
    ops: AttachmentOps,
) -> wgpu::RenderPassColorAttachment<'v> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            // A first writer without a clear value clears too: it is cheaper than loading, and defined.
            load: load(ops.clear && attachment.first, texture.desc.colour_clear()),
            store: store_op(ops.store),
        },
    }
}

/// A depth attachment with its load and store operations.
fn depth_attachment<'v>(
    texture: &PhysicalTexture,
    view: &'v wgpu::TextureView,
    attachment: &Attachment,
    ops: AttachmentOps,
) -> wgpu::RenderPassDepthStencilAttachment<'v> {
    let clear = ops.clear && attachment.first;
    let format = texture.desc.format;
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: format.has_depth_aspect().then(|| wgpu::Operations {
            load: load(clear, texture.desc.depth_clear()),
            store: store_op(ops.store),
        }),
        stencil_ops: format.has_stencil_aspect().then(|| wgpu::Operations {
            load: load(clear, texture.desc.stencil_clear()),
            store: store_op(ops.store),
        }),
    }
}

fn load<V>(clear: bool, value: V) -> wgpu::LoadOp<V> {
    if clear {
        wgpu::LoadOp::Clear(value)
    } else {
        wgpu::LoadOp::Load
    }
}

fn store_op(store: bool) -> wgpu::StoreOp {
    if store {
        wgpu::StoreOp::Store
    } else {
        wgpu::StoreOp::Discard
    }
}
