//! Declares host nodes: steps on the host while the frame is recorded, with uploads and the two kinds of read-back.

use crate::access::{Access, Use};
use crate::builder::common_builder;
use crate::frame::HostReader;
use crate::graph::Graph;
use crate::handle::{Buffer, Handle, Host, ReadBack};
use crate::pass::PassKind;
use crate::read_back::RingDecl;

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

impl Graph {
    /// A node that runs on the host while the frame is recorded.
    pub fn host_node(&mut self, name: impl Into<String>) -> HostBuilder<'_> {
        let pass = self.begin(name.into(), PassKind::Host);
        HostBuilder::new(self, pass)
    }
}

impl HostBuilder<'_> {
    /// Writes a host value. For version 0, the body finds what an earlier frame left and must set all of it.
    pub fn write<T: 'static>(&mut self, value: Host<T>) -> Host<T> {
        self.graph.write(self.pass, value, Access::HostWrite)
    }

    /// Reads last frame's value and writes this frame's, in place. The handle must be the declared one (version 0), and only one pass may
    /// update it. A buffer is updated by uploads: bytes that are not uploaded keep last frame's contents.
    pub fn updates<H: HostUpdatable>(&mut self, handle: H) -> H {
        self.graph.write(self.pass, handle, H::ACCESS)
    }

    /// Fills the buffer, or parts of it, with [`HostContext::upload`](crate::HostContext::upload), in order with the frame's commands.
    pub fn upload(&mut self, buffer: Buffer) -> Buffer {
        self.graph.write(self.pass, buffer, Access::Upload)
    }

    /// Reads the buffer's contents of the same frame. This is a sync point: the frame's commands so far are submitted and waited for.
    pub fn read_back(&mut self, buffer: Buffer) -> &mut Self {
        self.graph.read(self.pass, buffer, Access::ReadBack);
        self
    }

    /// Reads the buffer's final contents of an earlier frame, without waiting. After its last write of each frame the buffer is copied
    /// to a ring of staging buffers, together with a clone of `tag`'s final value of that frame. The versions of both handles do not
    /// matter: the read may be declared before or after the writes.
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

    /// Limits the last declared read-back, of either kind, to so many bytes (rounded up to a multiple of 4, at most the buffer's size).
    /// The function may read the host values that this node declares.
    pub fn bytes(&mut self, bytes: impl Fn(&HostReader<'_>) -> u64 + Send + 'static) -> &mut Self {
        let pass = self.declared();
        let reads_back = |access| matches!(access, Access::ReadBack | Access::Late);
        let last = pass.uses.iter().rposition(|used| reads_back(used.access));
        if let Some(last) = last {
            pass.byte_limits.insert(last, Box::new(bytes));
        }
        self
    }
}
