//! What a plan is compiled for.

/// Whether the plan submits its frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// It does: [`Plan::execute`](crate::Plan::execute) submits, and may wait for the GPU.
    Owned,
    /// The caller does: [`Plan::record`](crate::Plan::record) records into the caller's encoder and never waits.
    Embedded,
}

/// Which results of earlier frames the nodes of a frame are given ([`HostBuilder::read_previous`](crate::HostBuilder::read_previous)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LateResults {
    /// The newest that have arrived. How old they are is the device's affair, and the host's.
    #[default]
    Newest,
    /// Those of the frame that lies [`CompileOptions::frames_in_flight`] before, also where newer ones have arrived: what a host that always has as many frames in flight is given, and the same
    /// in every run. For measurements: the caller waits until that frame is done, or its results are missing.
    OfFramesInFlight,
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
    /// Frames that are recorded before the first of them is done, at least 1. The ring of each frame-late read-back has two slots more, so that a host with no more frames than this in flight
    /// loses no result.
    pub frames_in_flight: u32,
    /// Which results of earlier frames nodes are given.
    pub late_results: LateResults,
}

/// Slots of a ring beyond one for each frame in flight: the result that the present frame reads, and that of the present frame.
const SLOTS_BESIDES: usize = 2;

impl<'a> CompileOptions<'a> {
    /// A plan that submits, no timing, two frames in flight, the newest results.
    #[must_use]
    pub fn owned(device: &'a wgpu::Device) -> Self {
        Self {
            device,
            adapter: None,
            mode: Mode::Owned,
            timing: false,
            frames_in_flight: 2,
            late_results: LateResults::Newest,
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

    /// Slots of a ring of read-backs.
    pub(crate) fn ring_slots(&self) -> usize {
        self.frames_in_flight.max(1) as usize + SLOTS_BESIDES
    }

    /// With or without measured pass times.
    #[must_use]
    pub fn timing(mut self, timing: bool) -> Self {
        self.timing = timing;
        self
    }
}
