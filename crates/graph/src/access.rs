//! How a pass uses a resource, and what follows: wgpu usages, reads, writes.

use crate::handle::Raw;

/// One way of using a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Access {
    Colour,
    Resolve,
    Depth,
    DepthRead,
    Sample,
    StorageTextureRead,
    StorageTextureWrite,
    StorageRead,
    StorageWrite,
    StorageUpdate,
    Uniform,
    Vertex,
    Index,
    Indirect,
    Queries,
    CopySrc,
    CopyDst,
    HostRead,
    HostWrite,
    HostUpdate,
    Upload,
    UploadUpdate,
    /// Read back in the same frame: a sync point.
    ReadBack,
    /// Read back a frame or more later: copied at the end of the frame.
    Late,
    /// The host value that is copied along with a late read-back.
    LateTag,
}

impl Access {
    pub fn writes(self) -> bool {
        matches!(
            self,
            Self::Colour
                | Self::Resolve
                | Self::Depth
                | Self::StorageTextureWrite
                | Self::StorageWrite
                | Self::StorageUpdate
                | Self::Queries
                | Self::CopyDst
                | Self::HostWrite
                | Self::HostUpdate
                | Self::Upload
                | Self::UploadUpdate
        )
    }

    /// Whether it reads last frame's value and writes this frame's, in place.
    pub fn updates(self) -> bool {
        matches!(
            self,
            Self::StorageUpdate | Self::HostUpdate | Self::UploadUpdate
        )
    }

    /// Whether it reads at the end of the frame, so that it orders nothing.
    pub fn is_late(self) -> bool {
        matches!(self, Self::Late | Self::LateTag)
    }

    pub fn is_attachment(self) -> bool {
        matches!(
            self,
            Self::Colour | Self::Resolve | Self::Depth | Self::DepthRead
        )
    }

    pub fn texture_usages(self) -> wgpu::TextureUsages {
        match self {
            Self::Colour | Self::Resolve | Self::Depth | Self::DepthRead => {
                wgpu::TextureUsages::RENDER_ATTACHMENT
            }
            Self::Sample => wgpu::TextureUsages::TEXTURE_BINDING,
            Self::StorageTextureRead | Self::StorageTextureWrite => {
                wgpu::TextureUsages::STORAGE_BINDING
            }
            Self::CopySrc => wgpu::TextureUsages::COPY_SRC,
            Self::CopyDst => wgpu::TextureUsages::COPY_DST,
            _ => wgpu::TextureUsages::empty(),
        }
    }

    pub fn buffer_usages(self) -> wgpu::BufferUsages {
        match self {
            Self::StorageRead | Self::StorageWrite | Self::StorageUpdate => {
                wgpu::BufferUsages::STORAGE
            }
            Self::Uniform => wgpu::BufferUsages::UNIFORM,
            Self::Vertex => wgpu::BufferUsages::VERTEX,
            Self::Index => wgpu::BufferUsages::INDEX,
            Self::Indirect => wgpu::BufferUsages::INDIRECT,
            Self::Queries => wgpu::BufferUsages::QUERY_RESOLVE,
            Self::CopySrc | Self::ReadBack | Self::Late => wgpu::BufferUsages::COPY_SRC,
            Self::CopyDst | Self::Upload | Self::UploadUpdate => wgpu::BufferUsages::COPY_DST,
            _ => wgpu::BufferUsages::empty(),
        }
    }

    /// Its name in errors and exported graphs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Colour => "colour",
            Self::Resolve => "resolve",
            Self::Depth => "depth",
            Self::DepthRead => "depth (read)",
            Self::Sample => "sample",
            Self::StorageTextureRead => "storage texture (read)",
            Self::StorageTextureWrite => "storage texture (write)",
            Self::StorageRead => "storage (read)",
            Self::StorageWrite => "storage (write)",
            Self::StorageUpdate => "storage (update)",
            Self::Uniform => "uniform",
            Self::Vertex => "vertex",
            Self::Index => "index",
            Self::Indirect => "indirect",
            Self::Queries => "queries",
            Self::CopySrc => "copy from",
            Self::CopyDst => "copy to",
            Self::HostRead => "read",
            Self::HostWrite => "write",
            Self::HostUpdate => "update",
            Self::Upload => "upload",
            Self::UploadUpdate => "upload (update)",
            Self::ReadBack => "read back",
            Self::Late => "read back late",
            Self::LateTag => "tag",
        }
    }
}

/// One declared use of one resource.
pub(crate) struct Use {
    pub raw: Raw,
    pub access: Access,
    /// Mip level and layer of an attachment.
    pub mip: u32,
    pub layer: u32,
    /// The ring of a late read-back.
    pub ring: Option<u32>,
}

impl Use {
    pub fn new(raw: Raw, access: Access) -> Self {
        Self {
            raw,
            access,
            mip: 0,
            layer: 0,
            ring: None,
        }
    }

    pub fn resource(&self) -> usize {
        self.raw.resource()
    }

    /// Whether it reads a version of this frame.
    pub fn reads_now(&self) -> bool {
        !self.access.writes() && !self.access.is_late() && !self.raw.is_previous()
    }
}
