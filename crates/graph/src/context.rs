//! What the bodies of nodes work with: the resources that the node declared, and the place to record commands.

mod host;
mod raster;

use crate::frame::PassView;

pub use host::HostContext;
pub(crate) use raster::QueryCursor;
pub use raster::RasterContext;

/// The methods that the contexts of all kinds of nodes share. `$Context` has the field `view: PassView<'a>`.
macro_rules! common_context {
    ($Context:ident) => {
        impl<'a> $Context<'a> {
            /// The device.
            #[must_use]
            pub fn device(&self) -> &'a wgpu::Device {
                self.view.frame.device
            }

            /// The device's queue. Writes through it take effect before all commands of the frame that are not submitted yet.
            #[must_use]
            pub fn queue(&self) -> &'a wgpu::Queue {
                self.view.frame.queue
            }

            /// The frame's number, from 0.
            #[must_use]
            pub fn frame(&self) -> u64 {
                self.view.frame.number
            }

            /// Whether previous values come from a finished frame of this plan. If not, textures and buffers are zero, and host values are `Default` or
            /// [inherited](crate::Plan::inherit).
            #[must_use]
            pub fn has_previous(&self) -> bool {
                self.view.frame.has_previous
            }

            /// The iteration of the innermost host loop, from 0; 0 outside of loops.
            #[must_use]
            pub fn iteration(&self) -> u32 {
                self.view.iteration
            }

            /// A declared host value.
            ///
            /// # Errors
            /// The node did not declare it, it holds nothing, or the body holds it for writing.
            pub fn get<T: 'static>(
                &self,
                value: crate::Host<T>,
            ) -> Result<crate::HostRef<'a, T>, crate::AccessError> {
                self.view.get(value)
            }

            /// The wgpu buffer of a declared buffer. It may be larger than declared, and may be another one next frame.
            ///
            /// # Errors
            /// The node did not declare it.
            pub fn buffer(
                &self,
                buffer: crate::Buffer,
            ) -> Result<&'a wgpu::Buffer, crate::AccessError> {
                self.view.buffer(buffer)
            }

            /// The declared size of a buffer in bytes, rounded up to a multiple of 4.
            ///
            /// # Errors
            /// The node did not declare it.
            pub fn size(&self, buffer: crate::Buffer) -> Result<u64, crate::AccessError> {
                self.view.size(buffer)
            }

            /// A view of all mips and layers of a declared texture; of its depth aspect, if it has depth.
            ///
            /// # Errors
            /// The node did not declare it.
            pub fn view(
                &self,
                texture: crate::Texture,
            ) -> Result<&'a wgpu::TextureView, crate::AccessError> {
                self.view.sample_view(texture)
            }

            /// A view of one mip and one layer of a declared texture.
            ///
            /// # Errors
            /// The node did not declare it, or it has no such mip and layer.
            pub fn mip_view(
                &self,
                texture: crate::Texture,
                mip: u32,
                layer: u32,
            ) -> Result<&'a wgpu::TextureView, crate::AccessError> {
                self.view.mip_view(texture, mip, layer)
            }

            /// The wgpu texture of a declared texture.
            ///
            /// # Errors
            /// The node did not declare it.
            pub fn texture(
                &self,
                texture: crate::Texture,
            ) -> Result<&'a wgpu::Texture, crate::AccessError> {
                self.view.texture(texture)
            }

            /// A bind group of declared resources. It is cached and made anew only when one of their wgpu objects has changed.
            /// Each pass has a cache of its own with one entry for each `slot` (and frame parity): use one slot for each group that
            /// the body binds.
            ///
            /// # Errors
            /// The node did not declare a resource, or a range does not fit its buffer.
            pub fn bind_group(
                &self,
                slot: u32,
                layout: &wgpu::BindGroupLayout,
                binds: &[crate::Bind],
            ) -> Result<wgpu::BindGroup, crate::AccessError> {
                self.view.bind_group(slot, layout, binds)
            }
        }
    };
}

pub(crate) use common_context;

/// What the body of a compute node works with.
pub struct ComputeContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) pass: wgpu::ComputePass<'static>,
}

common_context!(ComputeContext);

impl ComputeContext<'_> {
    /// The compute pass, open.
    pub fn pass(&mut self) -> &mut wgpu::ComputePass<'static> {
        &mut self.pass
    }
}

/// What the body of a copy node works with.
pub struct CopyContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
}

common_context!(CopyContext);

impl CopyContext<'_> {
    /// The frame's command encoder. The body must leave no pass open on it.
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        self.encoder
    }
}
