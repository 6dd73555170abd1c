//! Declares raster nodes: one render pass, with attachments, shader accesses and occlusion queries.

use crate::access::{Access, Use};
use crate::builder::{common_builder, shader_builder};
use crate::frame::HostReader;
use crate::graph::Graph;
use crate::handle::{Buffer, Texture};
use crate::pass::{PassKind, Viewport};

/// Declares a raster node. Methods that write return the next version; the others return the builder.
pub struct RasterBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(RasterBuilder, RasterContext, Raster);
shader_builder!(RasterBuilder);

impl Graph {
    /// A node that draws: one render pass.
    pub fn raster(&mut self, name: impl Into<String>) -> RasterBuilder<'_> {
        let pass = self.begin(name.into(), PassKind::Raster);
        RasterBuilder::new(self, pass)
    }
}

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

    /// Tests against mip 0, layer 0 of the depth texture without writing it. The pipelines must not write depth.
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

    /// Draws only into this rectangle of the target, in texels from its upper left corner; depth 0 to 1.
    pub fn viewport(&mut self, x: f32, y: f32, width: f32, height: f32) -> &mut Self {
        self.declared().viewport = Some(Viewport {
            x,
            y,
            width,
            height,
        });
        self
    }

    /// Issues occlusion queries and writes their results into the buffer, a u64 each: zero or not zero. The value has no other meaning.
    ///
    /// `count` returns the number of queries of the frame; more than the buffer holds fails the frame. A query set holds 4,096. For more
    /// queries the body runs several times, each time with its own [`query_range`](crate::RasterContext::query_range); only the first
    /// run clears. The body issues the queries of the range in ascending order without gaps. It may stop early; results of queries that
    /// are not issued keep what the buffer held.
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
