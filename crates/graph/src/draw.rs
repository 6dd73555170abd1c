//! Records a raster node: its attachments, and its body once for every 4,096 queries.

use crate::access::Access;
use crate::compile::device::MAX_COLOURS;
use crate::error::ExecuteError;
use crate::frame::PassView;
use crate::handle::Raw;
use crate::host::HostReader;
use crate::pass::RasterBody;
use crate::queries::{ANSWER, Chunk, chunks};
use crate::raster::{QueryCursor, RasterContext};
use crate::recorder::{Recorder, colour_attachment, depth_attachment};

impl<'a> Recorder<'a, '_> {
    pub(crate) fn raster(
        &mut self,
        pass: usize,
        first: bool,
        view: PassView<'a>,
        body: &mut RasterBody,
    ) -> Result<(), ExecuteError> {
        let mut nothing: RasterBody = Box::new(|_| Ok(()));
        let body = match view.is_idle() {
            true if !(first && self.prepared[pass].attachments.iter().any(|a| a.first)) => {
                return Ok(());
            }
            true => &mut nothing,
            false => body,
        };
        let count = view
            .pass
            .query_count
            .as_ref()
            .map_or(0, |count| count(&HostReader { view }));
        let answers = self.prepared[pass].queries;
        let capacity = answers.map_or(0, |raw| self.capacity(raw));
        if count > capacity {
            return Err(ExecuteError::TooManyQueries {
                pass: view.pass.name.clone(),
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
                first && chunk.number == 0,
                view,
                body,
                &chunk,
                capacity,
            )?;
        }
        Ok(())
    }

    fn capacity(&self, raw: Raw) -> u32 {
        u32::try_from(self.frame.buffer_size(raw) / ANSWER).unwrap_or(u32::MAX)
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
                .get(device, &view.pass.name, pass, chunk, capacity)
        });
        let running = self
            .timing
            .begin(pass, Some((self.target.encoder(), false)));
        let mut colours: [Option<wgpu::RenderPassColorAttachment<'_>>; MAX_COLOURS] =
            [const { None }; MAX_COLOURS];
        let mut colour_count = 0;
        let mut depth = None;
        for attachment in &self.prepared[pass].attachments {
            let Some((texture, part)) = self.attached(attachment) else {
                continue;
            };
            // A later run of the body goes on where this one ends.
            let store = attachment.store || !chunk.last;
            match attachment.access {
                Access::Colour if colour_count < MAX_COLOURS => {
                    colours[colour_count] =
                        Some(colour_attachment(texture, part, attachment, clear, store));
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
                    depth = Some(depth_attachment(texture, part, attachment, clear, store));
                }
                _ => {}
            }
        }
        let encoder = self.target.encoder();
        let mut render_pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(&view.pass.name),
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
        if let Some(port) = view.pass.viewport {
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
            // Exactly what was written: a resolve of anything else is put off and splits the command buffer.
            self.target.encoder().resolve_query_set(
                &set,
                0..issued,
                buffer,
                u64::from(chunk.range.start) * ANSWER,
            );
        }
        Ok(())
    }
}
