//! The methods that the builders of all kinds of nodes share.

/// The methods of every builder. `$Builder` has the fields `graph` and `pass`.
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

            /// The label under which the pass's time is summed, such as "cull" or "draw".
            pub fn group(&mut self, group: &'static str) -> &mut Self {
                self.declared().group = Some(group);
                self
            }

            /// Runs after another pass, in addition to the order that follows from the data. It does not keep the other pass alive.
            pub fn after(&mut self, pass: crate::PassId) -> &mut Self {
                if pass.graph == self.graph.id {
                    self.declared().after.push(pass);
                } else {
                    self.graph.foreign(self.pass);
                }
                self
            }

            /// Keeps the pass even if nothing reads what it writes.
            pub fn side_effect(&mut self) -> &mut Self {
                self.declared().side_effect = true;
                self
            }

            /// Device features that the body needs. Compiling fails where the device lacks one.
            pub fn requires(&mut self, features: wgpu::Features) -> &mut Self {
                self.declared().requires |= features;
                self
            }

            /// The pass's id, for the `after` of other passes.
            #[must_use]
            pub fn id(&self) -> crate::PassId {
                self.graph.pass_id(self.pass)
            }

            /// Gives the node its body and finishes it.
            pub fn run(
                &mut self,
                body: impl FnMut(&mut crate::context::$Context<'_>) -> Result<(), crate::BodyError>
                + Send
                + 'static,
            ) -> crate::PassId {
                self.graph
                    .finish(self.pass, crate::body::Body::$variant(Box::new(body)))
            }
        }
    };
}

/// The shader accesses that raster and compute nodes share.
macro_rules! shader_builder {
    ($Builder:ident) => {
        impl $Builder<'_> {
            /// Samples or loads the texture in a shader.
            pub fn sample(&mut self, texture: crate::Texture) -> &mut Self {
                self.graph
                    .read(self.pass, texture, crate::access::Access::Sample);
                self
            }

            /// Reads the texture in a shader as a storage texture. So a node may read one mip and write the next on every device: OpenGL cannot sample one mip of a
            /// texture while it writes another.
            pub fn storage_texture_read(&mut self, texture: crate::Texture) -> &mut Self {
                self.graph.read(
                    self.pass,
                    texture,
                    crate::access::Access::StorageTextureRead,
                );
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

            /// Reads last frame's contents and writes this frame's, in place, as storage. The handle must be the declared one (version
            /// 0), and only one pass may update it.
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

            /// Skips the pass in frames (and loop iterations) in which `condition` is false, as for an empty draw list. Resources that it
            /// would have written keep their contents. Clears and zeroing for which the pass is the first writer still happen. The
            /// function may read the host values that this node declares.
            pub fn only_if(
                &mut self,
                condition: impl Fn(&crate::frame::HostReader<'_>) -> bool + Send + 'static,
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

pub(crate) use {common_builder, shader_builder};
