//! Walks the steps of a plan and records them: passes, sync points, loops.

use std::cell::RefCell;
use std::time::Instant;

use crate::access::Access;
use crate::compile::flow::{Attachment, Prepared};
use crate::compile::order::Step;
use crate::compute::ComputeContext;
use crate::copy::CopyContext;
use crate::error::{AccessError, BodyError, ExecuteError};
use crate::execute::{Caches, FrameReport};
use crate::frame::{Frame, PassView};
use crate::handle::Raw;
use crate::host::{HostContext, HostReader};
use crate::pass::{Body, Pass};
use crate::physical::PhysicalTexture;
use crate::queries::QuerySets;
use crate::sync::{Arrival, Staging};
use crate::timing::Timing;

/// Where commands go.
pub(crate) enum Target<'e> {
    Own(wgpu::CommandEncoder),
    Foreign(&'e mut wgpu::CommandEncoder),
}

impl Target<'_> {
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        match self {
            Self::Own(encoder) => encoder,
            Self::Foreign(encoder) => encoder,
        }
    }
}

/// A frame being recorded.
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
    /// Records steps; `first` on the first turn of every loop around them.
    pub fn steps(&mut self, steps: &[Step], first: bool, turn: u32) -> Result<(), ExecuteError> {
        for step in steps {
            match step {
                Step::Pass(pass) => self.pass(*pass, first, turn)?,
                Step::Sync(passes) => {
                    self.sync(passes, turn)?;
                    for pass in passes {
                        self.pass(*pass, first, turn)?;
                    }
                    self.staging.iter_mut().for_each(Staging::close);
                }
                Step::Loop(pass, steps) => self.host_loop(*pass, steps, first)?,
            }
        }
        Ok(())
    }

    pub fn view(&self, pass: usize, turn: u32) -> PassView<'a> {
        PassView {
            frame: self.frame,
            pass: &self.passes[pass],
            index: pass,
            turn,
            cache: &self.caches[pass],
            fault: self.fault,
        }
    }

    /// An error of a body, with the pass's name; also a misuse the body was not told of.
    pub fn outcome(&self, pass: usize, result: Result<(), BodyError>) -> Result<(), ExecuteError> {
        let fault = self.fault.borrow_mut().take().map(BodyError::from);
        match result.err().or(fault) {
            None => Ok(()),
            Some(error) => Err(ExecuteError::Body {
                pass: self.passes[pass].name.clone(),
                source: error.into_inner(),
            }),
        }
    }

    fn pass(&mut self, pass: usize, first: bool, turn: u32) -> Result<(), ExecuteError> {
        if first {
            self.clear_before(pass);
        }
        let view = self.view(pass, turn);
        // The body is taken out so that the recorder stays free; it comes back whatever happens.
        let mut body = std::mem::replace(&mut self.bodies[pass], Body::None);
        let result = match &mut body {
            Body::None => Ok(()),
            Body::Raster(run) => self.raster(pass, first, view, run),
            Body::Compute(_) if view.is_idle() => Ok(()),
            Body::Compute(run) => {
                let running = self
                    .timing
                    .begin(pass, Some((self.target.encoder(), false)));
                let writes = running
                    .as_ref()
                    .and_then(|running| running.query.as_ref())
                    .and_then(|query| query.compute_pass_timestamp_writes());
                let encoder = self.target.encoder();
                let mut context = ComputeContext {
                    view,
                    pass: encoder
                        .begin_compute_pass(&wgpu::ComputePassDescriptor {
                            label: Some(&view.pass.name),
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
                let running = self.timing.begin(pass, Some((self.target.encoder(), true)));
                let encoder = self.target.encoder();
                let result = run(&mut CopyContext { view, encoder });
                self.timing.end(pass, running, self.target.encoder());
                self.outcome(pass, result)
            }
            Body::Host(run) => {
                let running = self.timing.begin(pass, None);
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

    /// Submits what is recorded, with copies of what the host nodes read back, and waits for it; or goes on, where they read nothing this time.
    fn sync(&mut self, passes: &[usize], turn: u32) -> Result<(), ExecuteError> {
        let lost = |pass: usize| ExecuteError::DeviceLost {
            what: format!("waiting at the sync point of `{}`", self.passes[pass].name),
        };
        let mut wanted = 0;
        for &pass in passes {
            let view = self.view(pass, turn);
            for used in &view.pass.uses {
                if used.access != Access::ReadBack {
                    continue;
                }
                let bytes = used
                    .bytes
                    .as_ref()
                    .map_or(u64::MAX, |bytes| bytes(&HostReader { view }));
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
            // Nothing was asked, so there is nothing to wait for.
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
        for turn in 0..looped.limit {
            self.steps(steps, first && turn == 0, turn)?;
            self.report.loop_turns += 1;
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
        for (raw, mip, layer) in &prepared.clears {
            self.clear_part(*raw, *mip, *layer);
        }
    }

    /// Clears what no attachment of the pass would clear.
    fn clear_part(&mut self, raw: Raw, mip: u32, layer: u32) {
        let attachment = Attachment {
            raw,
            access: Access::Colour,
            mip,
            layer,
            first: true,
            store: true,
        };
        let Some((texture, view)) = self.attached(&attachment) else {
            return;
        };
        let depth = texture.desc.format.is_depth_stencil_format();
        let colour = [(!depth).then(|| colour_attachment(texture, view, &attachment, true, true))];
        let depth_stencil_attachment =
            depth.then(|| depth_attachment(texture, view, &attachment, true, true));
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

    pub fn attached(
        &self,
        attachment: &Attachment,
    ) -> Option<(&'a PhysicalTexture, &'a wgpu::TextureView)> {
        let frame = self.frame;
        let texture = frame.texture(attachment.raw)?;
        Some((texture, texture.part(attachment.mip, attachment.layer)?))
    }
}

/// How a colour target is loaded and stored.
pub(crate) fn colour_attachment<'v>(
    texture: &PhysicalTexture,
    view: &'v wgpu::TextureView,
    attachment: &Attachment,
    clear: bool,
    store: bool,
) -> wgpu::RenderPassColorAttachment<'v> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            // A first writer without a clear value may clear too: it is cheaper than loading, and defined.
            load: load(clear && attachment.first, texture.desc.colour_clear()),
            store: store_op(store),
        },
    }
}

/// How a depth target is loaded and stored.
pub(crate) fn depth_attachment<'v>(
    texture: &PhysicalTexture,
    view: &'v wgpu::TextureView,
    attachment: &Attachment,
    clear: bool,
    store: bool,
) -> wgpu::RenderPassDepthStencilAttachment<'v> {
    let clear = clear && attachment.first;
    let format = texture.desc.format;
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: format.has_depth_aspect().then(|| wgpu::Operations {
            load: load(clear, texture.desc.depth_clear()),
            store: store_op(store),
        }),
        stencil_ops: format.has_stencil_aspect().then(|| wgpu::Operations {
            load: load(clear, texture.desc.stencil_clear()),
            store: store_op(store),
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
