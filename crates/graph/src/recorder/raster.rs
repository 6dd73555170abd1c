//! Records a raster node: its attachments, and its body once for every 4,096 queries.

use super::{AttachmentOps, Iteration, Recorder, colour_attachment, depth_attachment};
use crate::access::Access;
use crate::body::RasterBody;
use crate::compile::device::MAX_COLOURS;
use crate::context::{QueryCursor, RasterContext};
use crate::error::ExecuteError;
use crate::frame::{HostReader, PassView};
use crate::handle::Raw;
use crate::queries::{Chunk, RESULT_BYTES, chunks};
use crate::timing::Recorded;

impl<'a> Recorder<'a, '_> {
    pub(super) fn raster(
        &mut self,
        pass: usize,
        at: Iteration,
        view: PassView<'a>,
        body: &mut RasterBody,
    ) -> Result<(), ExecuteError> {
        let mut nothing: RasterBody = Box::new(|_| Ok(()));
        let declared = &self.passes[pass];
        let body = match declared.is_idle(view) {
            true if !(at.first && self.prepared[pass].attachments.iter().any(|a| a.first)) => {
                return Ok(());
            }
            true => &mut nothing,
            false => body,
        };
        let count = declared
            .query_count
            .as_ref()
            .map_or(0, |count| count(&HostReader { view }));
        let answers = self.prepared[pass].queries;
        let capacity = answers.map_or(0, |raw| self.capacity(raw));
        if count > capacity {
            return Err(ExecuteError::TooManyQueries {
                pass: view.name.to_owned(),
                resource: answers
                    .map(|raw| self.frame.resources[raw.resource()].resource.name.clone())
                    .unwrap_or_default(),
                count,
                capacity,
            });
        }
        for chunk in chunks(count) {
            self.run_chunk(
                pass,
                at.first && chunk.number == 0,
                view,
                body,
                &chunk,
                capacity,
            )?;
        }
        Ok(())
    }

    fn capacity(&self, raw: Raw) -> u32 {
        u32::try_from(self.frame.buffer_size(raw) / RESULT_BYTES).unwrap_or(u32::MAX)
    }

    fn run_chunk(
        &mut self,
        pass: usize,
        clear: bool,
        view: PassView<'a>,
        body: &mut RasterBody,
        chunk: &Chunk,
        capacity: u32,
    ) -> Result<(), ExecuteError> {
        let set = (!chunk.range.is_empty()).then(|| {
            let device = self.frame.device;
            self.query_sets
                .get(device, view.name, pass, chunk, capacity)
        });
        let running = self
            .timing
            .begin(pass, Recorded::Pass(self.target.encoder()));
        let mut colours: [Option<wgpu::RenderPassColorAttachment<'_>>; MAX_COLOURS] =
            [const { None }; MAX_COLOURS];
        let mut colour_count = 0;
        let mut depth = None;
        for attachment in &self.prepared[pass].attachments {
            let Some((texture, part)) = self.attached(attachment) else {
                continue;
            };
            let ops = AttachmentOps {
                clear,
                // The body's next run continues with these contents.
                store: attachment.store || !chunk.last,
            };
            match attachment.access {
                Access::Colour if colour_count < MAX_COLOURS => {
                    colours[colour_count] = Some(colour_attachment(texture, part, attachment, ops));
                    colour_count += 1;
                }
                Access::Resolve => {
                    let last = colours[..colour_count].last_mut().and_then(Option::as_mut);
                    if let Some(colour) = last {
                        colour.resolve_target = Some(part);
                    }
                }
                Access::DepthRead if self.read_only_depth => {
                    depth = Some(wgpu::RenderPassDepthStencilAttachment {
                        view: part,
                        depth_ops: None,
                        stencil_ops: None,
                    });
                }
                Access::Depth | Access::DepthRead => {
                    depth = Some(depth_attachment(texture, part, attachment, ops));
                }
                _ => {}
            }
        }
        let encoder = self.target.encoder();
        let mut render_pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(view.name),
                color_attachments: &colours[..colour_count],
                depth_stencil_attachment: depth,
                timestamp_writes: running
                    .as_ref()
                    .and_then(|running| running.query.as_ref())
                    .and_then(|query| query.render_pass_timestamp_writes()),
                occlusion_query_set: set.as_ref(),
                multiview_mask: None,
            })
            .forget_lifetime();
        if let Some(port) = self.passes[pass].viewport {
            render_pass.set_viewport(port.x, port.y, port.width, port.height, 0.0, 1.0);
        }
        let mut context = RasterContext {
            view,
            pass: render_pass,
            queries: QueryCursor {
                range: chunk.range.clone(),
                next: chunk.range.start,
            },
        };
        let result = body(&mut context);
        let issued = context.queries.next - chunk.range.start;
        drop(context);
        let encoder = self.target.encoder();
        self.timing.end(pass, running, encoder);
        self.outcome(pass, result)?;
        let answers = self.prepared[pass].queries;
        let buffer = answers.and_then(|raw| self.frame.buffer(raw));
        if let (Some(set), Some(buffer), true) = (set, buffer, issued > 0) {
            // Exactly the queries that were issued: resolving others is deferred and splits the command buffer.
            self.target.encoder().resolve_query_set(
                &set,
                0..issued,
                buffer,
                u64::from(chunk.range.start) * RESULT_BYTES,
            );
        }
        Ok(())
    }
}
