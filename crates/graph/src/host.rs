//! Host nodes: steps on the host while the frame is recorded, with uploads and the two kinds of read-back.

use std::any::Any;

use crate::access::{Access, Use};
use crate::builder::{common_builder, common_context};
use crate::error::AccessError;
use crate::frame::{HostMut, HostRef, PassView};
use crate::handle::Handle;
use crate::read_back::{Late, RingDecl};
use crate::sync::Staging;
use crate::{Buffer, Graph, Host, ReadBack};

/// What a host node can update in place: a [`Host`] value or, by uploads, a [`Buffer`].
pub trait HostUpdatable: Handle + sealed::Updatable {}

impl<T: 'static> HostUpdatable for Host<T> {}
impl HostUpdatable for Buffer {}

mod sealed {
    use crate::access::Access;

    pub trait Updatable {
        #[doc(hidden)]
        #[allow(private_interfaces, reason = "the trait cannot be named outside")]
        const ACCESS: Access;
    }

    #[allow(private_interfaces, reason = "the trait cannot be named outside")]
    impl<T> Updatable for crate::Host<T> {
        const ACCESS: Access = Access::HostUpdate;
    }

    #[allow(private_interfaces, reason = "the trait cannot be named outside")]
    impl Updatable for crate::Buffer {
        const ACCESS: Access = Access::UploadUpdate;
    }
}

/// Declares a host node. Methods that write return the next version; the others return the builder.
pub struct HostBuilder<'g> {
    graph: &'g mut Graph,
    pass: usize,
}

common_builder!(HostBuilder, HostContext, Host);

impl HostBuilder<'_> {
    /// Writes a host value. Its body finds in version 0 what an earlier frame left, and must set all of it.
    pub fn write<T: 'static>(&mut self, value: Host<T>) -> Host<T> {
        self.graph.write(self.pass, value, Access::HostWrite)
    }

    /// Reads last frame's value and writes this frame's, in place. The handle is the declared one (version 0); one pass updates it.
    /// A buffer is updated by uploads: what is not uploaded keeps last frame's bytes.
    pub fn updates<H: HostUpdatable>(&mut self, handle: H) -> H {
        self.graph.write(self.pass, handle, H::ACCESS)
    }

    /// Fills the buffer, or parts of it, with [`HostContext::upload`]; ordered with the frame's commands.
    pub fn upload(&mut self, buffer: Buffer) -> Buffer {
        self.graph.write(self.pass, buffer, Access::Upload)
    }

    /// Reads the buffer's contents of this same frame: a sync point, at which the frame's commands so far are submitted and waited for.
    pub fn read_back(&mut self, buffer: Buffer) -> &mut Self {
        self.graph.read(self.pass, buffer, Access::ReadBack);
        self
    }

    /// Reads the buffer's final contents of an earlier frame, without waiting. After its last write of each frame the buffer is copied
    /// to a ring of mapped buffers, together with a clone of `tag`'s final value of that frame. Of both handles only the resource counts:
    /// they may be declared before or after their writers.
    pub fn read_previous<Tag: Clone + Send + 'static>(
        &mut self,
        buffer: Buffer,
        tag: Host<Tag>,
    ) -> ReadBack<Tag> {
        let ring = self.graph.rings.len() as u32;
        let pass = self.pass;
        self.graph.rings.push(RingDecl::new::<Tag>(
            pass,
            buffer.0.resource(),
            tag.raw.resource(),
        ));
        for (raw, access) in [(buffer.0, Access::Late), (tag.raw, Access::LateTag)] {
            self.graph.touch(
                pass,
                Use {
                    ring: Some(ring),
                    ..Use::new(raw, access)
                },
            );
        }
        ReadBack::new(self.graph.id, ring)
    }

    /// Limits the last declared read-back, of either kind, to so many bytes (rounded up to 4, at most the buffer's size).
    /// The function may read the host values this node declares.
    pub fn bytes(&mut self, bytes: impl Fn(&HostReader<'_>) -> u64 + Send + 'static) -> &mut Self {
        let used = self
            .declared()
            .uses
            .iter_mut()
            .rfind(|used| matches!(used.access, Access::ReadBack | Access::Late));
        if let Some(used) = used {
            used.bytes = Some(Box::new(bytes));
        }
        self
    }
}

/// Reads the host values a node declares, where the executor needs a number before the body runs.
pub struct HostReader<'a> {
    pub(crate) view: PassView<'a>,
}

impl<'a> HostReader<'a> {
    /// A declared host value.
    ///
    /// # Errors
    /// It was not declared by the node, or holds nothing.
    pub fn get<T: 'static>(&self, value: Host<T>) -> Result<HostRef<'a, T>, AccessError> {
        self.view.get(value)
    }

    /// The frame's number, from 0.
    #[must_use]
    pub fn frame(&self) -> u64 {
        self.view.frame.number
    }
}

/// What the body of a host node works with.
pub struct HostContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
    pub(crate) belt: &'a mut wgpu::util::StagingBelt,
    pub(crate) staging: &'a [Staging],
}

common_context!(HostContext);

impl<'a> HostContext<'a> {
    /// A host value this node writes or updates.
    ///
    /// # Errors
    /// The node did not declare that it writes it, it holds nothing, or it is borrowed.
    pub fn get_mut<T: 'static>(&self, value: Host<T>) -> Result<HostMut<'a, T>, AccessError> {
        self.view.get_mut(value)
    }

    /// Writes `bytes` into the buffer from byte `offset` on, after all commands recorded so far and before all later ones.
    ///
    /// # Errors
    /// The node did not declare the upload, the range does not fit, or offset or length are no multiple of 4.
    pub fn upload(&mut self, buffer: Buffer, offset: u64, bytes: &[u8]) -> Result<(), AccessError> {
        let (target, size) = self.view.upload_target(buffer)?;
        let length = bytes.len() as u64;
        let end = offset.saturating_add(length);
        if end > size || !offset.is_multiple_of(4) || !length.is_multiple_of(4) {
            return Err(self.view.range_error(buffer, offset, end, size));
        }
        let Some(length) = wgpu::BufferSize::new(length) else {
            return Ok(());
        };
        self.belt
            .write_buffer(self.encoder, target, offset, length)
            .copy_from_slice(bytes);
        Ok(())
    }

    /// The bytes of a buffer read back within this frame.
    ///
    /// # Errors
    /// The node did not declare `read_back` of it.
    pub fn bytes(&self, buffer: Buffer) -> Result<&'a [u8], AccessError> {
        self.view
            .check(buffer.0, "reads back", |access| access == Access::ReadBack)?;
        let pass = self.view.index;
        Ok(self
            .staging
            .iter()
            .find(|staging| staging.serves(pass, buffer.0))
            .map_or(&[], Staging::bytes))
    }

    /// The newest answer of a frame-late read-back that has arrived and was not delivered before; `None` if there is none.
    /// Within a frame it may be asked for again. A handle that this node did not declare fails the frame.
    pub fn late<Tag: Any + Clone + Send>(&self, read_back: ReadBack<Tag>) -> Option<Late<'a, Tag>> {
        self.view.late(read_back)
    }
}
