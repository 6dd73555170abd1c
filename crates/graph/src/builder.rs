//! What the builders of all kinds of nodes have in common, written once.

/// The methods every builder has. `$Builder` has the fields `graph` and `pass`.
macro_rules! common_builder {
    ($Builder:ident, $Context:ident, $variant:ident) => {
        impl<'g> $Builder<'g> {
            pub(crate) fn new(graph: &'g mut crate::Graph, pass: usize) -> Self {
                Self { graph, pass }
            }

            fn declared(&mut self) -> &mut crate::pass::Pass {
                &mut self.graph.passes[self.pass]
            }

            /// Reads a host value in the body.
            pub fn read<T: 'static>(&mut self, value: crate::Host<T>) -> &mut Self {
                self.graph
                    .read(self.pass, value, crate::access::Access::HostRead);
                self
            }

            /// The label its time is summed under, such as "cull" or "draw".
            pub fn group(&mut self, group: &'static str) -> &mut Self {
                self.declared().group = Some(group);
                self
            }

            /// Runs after that pass, beyond what the data says. It does not keep the other pass alive.
            pub fn after(&mut self, pass: crate::PassId) -> &mut Self {
                if pass.graph == self.graph.id {
                    self.declared().after.push(pass);
                } else {
                    self.graph.foreign(self.pass);
                }
                self
            }

            /// Keeps the pass even if nobody reads what it writes.
            pub fn side_effect(&mut self) -> &mut Self {
                self.declared().side_effect = true;
                self
            }

            /// Features the body makes use of; compiling fails where the device lacks one.
            pub fn requires(&mut self, features: wgpu::Features) -> &mut Self {
                self.declared().requires |= features;
                self
            }

            /// The pass being built, to name it in another's `after`.
            #[must_use]
            pub fn id(&self) -> crate::PassId {
                self.graph.pass_id(self.pass)
            }

            /// Gives the node its body and finishes it.
            pub fn run(
                &mut self,
                body: impl FnMut(&mut $Context<'_>) -> Result<(), crate::BodyError> + Send + 'static,
            ) -> crate::PassId {
                self.graph
                    .finish(self.pass, crate::pass::Body::$variant(Box::new(body)))
            }
        }
    };
}

/// The shader accesses raster and compute nodes share.
macro_rules! shader_builder {
    ($Builder:ident) => {
        impl $Builder<'_> {
            /// Samples or loads the texture in a shader.
            pub fn sample(&mut self, texture: crate::Texture) -> &mut Self {
                self.graph
                    .read(self.pass, texture, crate::access::Access::Sample);
                self
            }

            /// Writes the texture from a shader as a storage texture.
            pub fn storage_texture_write(&mut self, texture: crate::Texture) -> crate::Texture {
                self.graph.write(
                    self.pass,
                    texture,
                    crate::access::Access::StorageTextureWrite,
                )
            }

            /// Reads the buffer in a shader as read-only storage.
            pub fn storage_read(&mut self, buffer: crate::Buffer) -> &mut Self {
                self.graph
                    .read(self.pass, buffer, crate::access::Access::StorageRead);
                self
            }

            /// Writes (and may read) the buffer in a shader as storage.
            pub fn storage_write(&mut self, buffer: crate::Buffer) -> crate::Buffer {
                self.graph
                    .write(self.pass, buffer, crate::access::Access::StorageWrite)
            }

            /// Reads last frame's contents and writes this frame's, in place, as storage. The handle is the declared one (version 0); one pass updates it.
            pub fn updates(&mut self, buffer: crate::Buffer) -> crate::Buffer {
                self.graph
                    .write(self.pass, buffer, crate::access::Access::StorageUpdate)
            }

            /// Reads the buffer in a shader as a uniform.
            pub fn uniform(&mut self, buffer: crate::Buffer) -> &mut Self {
                self.graph
                    .read(self.pass, buffer, crate::access::Access::Uniform);
                self
            }

            /// Leaves the pass out of the frames, and of the turns of a loop, in which `condition` is false: an empty draw list, say.
            /// What it would have written keeps what it holds; where the pass is the first to write what is cleared or zeroed each frame, that is
            /// done all the same. The function may read the host values this node declares.
            pub fn only_if(
                &mut self,
                condition: impl Fn(&crate::host::HostReader<'_>) -> bool + Send + 'static,
            ) -> &mut Self {
                self.declared().condition = Some(Box::new(condition));
                self
            }

            /// Draws or dispatches with arguments from the buffer.
            pub fn indirect(&mut self, buffer: crate::Buffer) -> &mut Self {
                self.graph
                    .read(self.pass, buffer, crate::access::Access::Indirect);
                self
            }
        }
    };
}

/// The reach of every context into the frame. `$Context` has the field `view: PassView<'a>`.
macro_rules! common_context {
    ($Context:ident) => {
        impl<'a> $Context<'a> {
            /// The device the frame is recorded on.
            #[must_use]
            pub fn device(&self) -> &'a wgpu::Device {
                self.view.frame.device
            }

            /// Its queue. What is written through it takes effect before all commands of the frame that are not yet submitted.
            #[must_use]
            pub fn queue(&self) -> &'a wgpu::Queue {
                self.view.frame.queue
            }

            /// The frame's number, from 0.
            #[must_use]
            pub fn frame(&self) -> u64 {
                self.view.frame.number
            }

            /// Whether previous values are those of a finished frame, not zero or `Default`.
            #[must_use]
            pub fn has_previous(&self) -> bool {
                self.view.frame.has_previous
            }

            /// The turn of the innermost host loop, from 0; 0 outside of loops.
            #[must_use]
            pub fn turn(&self) -> u32 {
                self.view.turn
            }

            /// A declared host value.
            ///
            /// # Errors
            /// It was not declared, holds nothing, or is being written.
            pub fn get<T: 'static>(
                &self,
                value: crate::Host<T>,
            ) -> Result<crate::HostRef<'a, T>, crate::AccessError> {
                self.view.get(value)
            }

            /// The physical buffer behind a declared one. It may be larger than declared, and another one next frame.
            ///
            /// # Errors
            /// It was not declared by this pass.
            pub fn buffer(
                &self,
                buffer: crate::Buffer,
            ) -> Result<&'a wgpu::Buffer, crate::AccessError> {
                self.view.buffer(buffer)
            }

            /// The size of a buffer as declared, in bytes, rounded up to a multiple of 4.
            ///
            /// # Errors
            /// It was not declared by this pass.
            pub fn size(&self, buffer: crate::Buffer) -> Result<u64, crate::AccessError> {
                self.view.size(buffer)
            }

            /// A view of all mips and layers of a declared texture (its depth aspect, if it has depth).
            ///
            /// # Errors
            /// It was not declared by this pass.
            pub fn view(
                &self,
                texture: crate::Texture,
            ) -> Result<&'a wgpu::TextureView, crate::AccessError> {
                self.view.sample_view(texture)
            }

            /// A view of one mip and one layer of a declared texture.
            ///
            /// # Errors
            /// It was not declared by this pass, or has no such mip and layer.
            pub fn mip_view(
                &self,
                texture: crate::Texture,
                mip: u32,
                layer: u32,
            ) -> Result<&'a wgpu::TextureView, crate::AccessError> {
                self.view.mip_view(texture, mip, layer)
            }

            /// The physical texture behind a declared one.
            ///
            /// # Errors
            /// It was not declared by this pass.
            pub fn texture(
                &self,
                texture: crate::Texture,
            ) -> Result<&'a wgpu::Texture, crate::AccessError> {
                self.view.texture(texture)
            }

            /// A bind group of declared resources, made anew only when one of the objects behind them has changed.
            /// The cache is this pass's own, one entry a `slot` (and frame parity): use one slot for each group the body binds.
            ///
            /// # Errors
            /// A resource was not declared by this pass, or a range does not fit.
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

pub(crate) use {common_builder, common_context, shader_builder};
