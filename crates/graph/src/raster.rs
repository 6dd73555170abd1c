//! Raster nodes: one render pass, with attachments, shader accesses and occlusion queries.

use std::ops::Range;

use crate::access::{Access, Use};
use crate::builder::{common_builder, common_context, shader_builder};
use crate::error::AccessError;
use crate::frame::PassView;
use crate::host::HostReader;
use crate::pass::Viewport;
use crate::{Buffer, Graph, Texture};

/// Declares a raster node. Methods that write return the next version; the others return the builder.
pub struct RasterBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(RasterBuilder, RasterContext, Raster);
shader_builder!(RasterBuilder);

impl RasterBuilder<'_> {
    /// Draws into mip 0, layer 0 of the texture. Attachments are numbered in the order of these calls.
    pub fn colour(&mut self, texture: Texture) -> Texture {
        self.colour_at(texture, 0, 0)
    }

    /// Draws into one mip and layer of the texture.
    pub fn colour_at(&mut self, texture: Texture, mip: u32, layer: u32) -> Texture {
        self.attach(texture, Access::Colour, mip, layer)
    }

    /// Resolves the samples of the last colour attachment into mip 0, layer 0 of the texture.
    pub fn resolve(&mut self, texture: Texture) -> Texture {
        self.attach(texture, Access::Resolve, 0, 0)
    }

    /// Tests against and writes mip 0, layer 0 of the depth texture.
    pub fn depth(&mut self, texture: Texture) -> Texture {
        self.depth_at(texture, 0, 0)
    }

    /// Tests against and writes one mip and layer of the depth texture.
    pub fn depth_at(&mut self, texture: Texture, mip: u32, layer: u32) -> Texture {
        self.attach(texture, Access::Depth, mip, layer)
    }

    /// Tests against mip 0, layer 0 of the depth texture without writing it. Pipelines must not write depth.
    pub fn depth_read(&mut self, texture: Texture) -> &mut Self {
        self.depth_read_at(texture, 0, 0)
    }

    /// Tests against one mip and layer of the depth texture without writing it.
    pub fn depth_read_at(&mut self, texture: Texture, mip: u32, layer: u32) -> &mut Self {
        self.attach(texture, Access::DepthRead, mip, layer);
        self
    }

    /// Draws with vertices from the buffer.
    pub fn vertex(&mut self, buffer: Buffer) -> &mut Self {
        self.graph.read(self.pass, buffer, Access::Vertex);
        self
    }

    /// Draws with indices from the buffer.
    pub fn index(&mut self, buffer: Buffer) -> &mut Self {
        self.graph.read(self.pass, buffer, Access::Index);
        self
    }

    /// Draws only into that rectangle of the target, in texels from its upper left corner; depth 0 to 1.
    pub fn viewport(&mut self, x: f32, y: f32, width: f32, height: f32) -> &mut Self {
        self.declared().viewport = Some(Viewport {
            x,
            y,
            width,
            height,
        });
        self
    }

    /// Issues occlusion queries, whose answers (u64, zero or not zero, nothing more) land in the buffer, 8 bytes a query.
    ///
    /// `count` says how many this frame; more than the buffer holds fails the frame. A query set holds 4,096:
    /// for more the body runs several times, each with its own [`RasterContext::query_range`]; only the first run clears.
    /// The body issues the range in ascending order without holes; it may stop early, and the answers of queries not issued are left as they were.
    pub fn queries(
        &mut self,
        buffer: Buffer,
        count: impl Fn(&HostReader<'_>) -> u32 + Send + 'static,
    ) -> Buffer {
        self.declared().query_count = Some(Box::new(count));
        self.graph.write(self.pass, buffer, Access::Queries)
    }

    fn attach(&mut self, texture: Texture, access: Access, mip: u32, layer: u32) -> Texture {
        self.graph.touch(
            self.pass,
            Use {
                mip,
                layer,
                ..Use::new(texture.0, access)
            },
        );
        Texture(texture.0.next())
    }
}

/// What the body of a raster node works with.
pub struct RasterContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) pass: wgpu::RenderPass<'static>,
    pub(crate) queries: QueryCursor,
}

common_context!(RasterContext);

/// The queries of one run of a body: absolute numbers, and the first one's place in its set.
#[derive(Clone, Debug, Default)]
pub(crate) struct QueryCursor {
    pub range: Range<u32>,
    pub next: u32,
}

impl RasterContext<'_> {
    /// The render pass, open, its viewport set.
    pub fn pass(&mut self) -> &mut wgpu::RenderPass<'static> {
        &mut self.pass
    }

    /// The queries this run of the body is to issue; empty for a node without queries.
    #[must_use]
    pub fn query_range(&self) -> Range<u32> {
        self.queries.range.clone()
    }

    /// Issues query `index` around what `draw` draws.
    ///
    /// # Errors
    /// The query is not the next one of [`RasterContext::query_range`].
    pub fn query(
        &mut self,
        index: u32,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<(), AccessError> {
        if index != self.queries.next || index >= self.queries.range.end {
            return Err(AccessError::QueryOrder {
                pass: self.view.pass.name.clone(),
                query: index,
                expected: self.queries.next,
                end: self.queries.range.end,
            });
        }
        self.pass
            .begin_occlusion_query(index - self.queries.range.start);
        draw(&mut self.pass);
        self.pass.end_occlusion_query();
        self.queries.next += 1;
        Ok(())
    }
}
