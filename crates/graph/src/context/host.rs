//! The context of host nodes: host values, uploads, and the two kinds of read-back.

use std::any::Any;

use super::common_context;
use crate::access::Access;
use crate::error::AccessError;
use crate::frame::{HostMut, PassView};
use crate::handle::{Buffer, Host, ReadBack};
use crate::read_back::Late;
use crate::sync::Staging;

/// What the body of a host node works with.
pub struct HostContext<'a> {
    pub(crate) view: PassView<'a>,
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
    pub(crate) belt: &'a mut wgpu::util::StagingBelt,
    pub(crate) staging: &'a [Staging],
}

common_context!(HostContext);

impl<'a> HostContext<'a> {
    /// A host value that this node writes or updates.
    ///
    /// # Errors
    /// The node did not declare the write, the value holds nothing, or the body holds it already.
    pub fn get_mut<T: 'static>(&self, value: Host<T>) -> Result<HostMut<'a, T>, AccessError> {
        self.view.get_mut(value)
    }

    /// Writes `bytes` into the buffer from byte `offset` on, after all commands recorded so far and before all later ones.
    ///
    /// # Errors
    /// The node did not declare the upload, the range does not fit, or offset or length is not a multiple of 4.
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

    /// The newest result of a frame-late read-back that has arrived and was not delivered in an earlier frame; `None` if there is none.
    /// Further calls in the same frame return the same result. A handle that this node did not declare fails the frame.
    pub fn late<Tag: Any + Clone + Send>(&self, read_back: ReadBack<Tag>) -> Option<Late<'a, Tag>> {
        self.view.late(read_back)
    }
}
