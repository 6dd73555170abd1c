//! Waiting for the device: by blocking where the host can, and by futures everywhere.

use crate::arrival::arrival;
use crate::device::{DeviceError, Gpu};

impl Gpu {
    /// Whether the host can wait for the GPU. In a browser it cannot: what was submitted goes on when the page's own code has returned.
    pub fn can_wait(&self) -> bool {
        self.info.backend != wgpu::Backend::BrowserWebGpu
    }

    /// Blocks until all submitted work is done.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] after a loss, and as for [`Self::check`]; [`DeviceError::CannotWait`] in a browser.
    pub fn wait(&self) -> Result<(), DeviceError> {
        if !self.can_wait() {
            return Err(DeviceError::CannotWait {
                what: "`Gpu::wait`",
                instead: "`Gpu::wait_async`",
            });
        }
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| DeviceError::Lost(error.to_string()))?;
        self.check()
    }

    /// [`Self::wait`], to be awaited. What the submitted work reads back has arrived then.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] after a loss, and as for [`Self::check`].
    pub async fn wait_async(&self) -> Result<(), DeviceError> {
        if self.can_wait() {
            return self.wait();
        }
        let (bringer, done) = arrival();
        self.queue.on_submitted_work_done(move || bringer.bring(()));
        match done.await {
            Some(()) => self.check(),
            None => Err(DeviceError::Lost("submitted work was not done".to_owned())),
        }
    }

    /// The value of a future that waits for nothing but this device. In a browser an error, which says what to call instead.
    #[doc(hidden)]
    pub fn block_on<T, E: From<DeviceError>>(
        &self,
        what: &'static str,
        instead: &'static str,
        future: impl Future<Output = Result<T, E>>,
    ) -> Result<T, E> {
        match self.can_wait() {
            true => pollster::block_on(future),
            false => Err(DeviceError::CannotWait { what, instead }.into()),
        }
    }
}
