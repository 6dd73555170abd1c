//! What a plan is compiled for.

/// Whether the plan submits its frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// It does: [`Plan::execute`](crate::Plan::execute) submits, and may wait for the GPU.
    Owned,
    /// The caller does: [`Plan::record`](crate::Plan::record) records into the caller's encoder and never waits.
    Embedded,
}

/// What a plan is compiled for.
#[derive(Clone, Copy, Debug)]
pub struct CompileOptions<'a> {
    /// The device the plan will run on.
    pub device: &'a wgpu::Device,
    /// The adapter of the device, if at hand. With it the adapter's own capabilities are known; without it those of the backend are
    /// assumed.
    pub adapter: Option<&'a wgpu::Adapter>,
    /// Whether the plan submits its frames.
    pub mode: Mode,
    /// Measures pass times from the first frame; see [`Plan::set_timing`](crate::Plan::set_timing).
    pub timing: bool,
    /// Slots in the ring of each frame-late read-back, at least 1.
    pub read_back_slots: usize,
}

impl<'a> CompileOptions<'a> {
    /// A plan that submits, no timing, rings of three slots.
    #[must_use]
    pub fn owned(device: &'a wgpu::Device) -> Self {
        Self {
            device,
            adapter: None,
            mode: Mode::Owned,
            timing: false,
            read_back_slots: 3,
        }
    }

    /// The same for a plan that records into the caller's encoder.
    #[must_use]
    pub fn embedded(device: &'a wgpu::Device) -> Self {
        Self {
            mode: Mode::Embedded,
            ..Self::owned(device)
        }
    }

    /// With the adapter of the device.
    #[must_use]
    pub fn adapter(mut self, adapter: &'a wgpu::Adapter) -> Self {
        self.adapter = Some(adapter);
        self
    }

    /// With or without measured pass times.
    #[must_use]
    pub fn timing(mut self, timing: bool) -> Self {
        self.timing = timing;
        self
    }
}
