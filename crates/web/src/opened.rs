//! Devices with WebGPU's default limits, and which shaders pipelines were made of.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use antumbra_cull::{DeviceError, Gpu, StageError};
use antumbra_shaders::jobs;

/// What a device is opened with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Offer {
    /// No feature at all.
    Bare,
    /// The features of browsers that plans make use of.
    Features,
}

impl Offer {
    pub const ALL: [Self; 2] = [Self::Bare, Self::Features];

    pub fn name(self) -> &'static str {
        match self {
            Self::Bare => "without features",
            Self::Features => "with features",
        }
    }

    fn features(self) -> wgpu::Features {
        match self {
            Self::Bare => wgpu::Features::empty(),
            Self::Features => {
                wgpu::Features::INDIRECT_FIRST_INSTANCE | wgpu::Features::TIMESTAMP_QUERY
            }
        }
    }
}

/// The names of the shaders that modules were made of for pipelines.
static USED: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

fn used() -> std::sync::MutexGuard<'static, BTreeSet<String>> {
    USED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Opens a device of default limits. From then on, shaders that pipelines are made of are noted.
pub(crate) async fn open(adapter: &wgpu::Adapter, offer: Offer) -> Result<Gpu, StageError> {
    let requested = adapter.request_device(&wgpu::DeviceDescriptor {
        label: Some("antumbra"),
        required_features: offer.features(),
        required_limits: wgpu::Limits::default(),
        ..Default::default()
    });
    let info = adapter.get_info();
    let (device, queue) = requested.await.map_err(|error| DeviceError::NoDevice {
        adapter: info.name.clone(),
        reason: error.to_string(),
    })?;
    let gpu = Gpu::adopt(device, queue, info, adapter.get_downlevel_capabilities());
    gpu.watch();
    used().clear();
    Ok(gpu.with_changed_shaders(|name, _| {
        used().insert(name.to_owned());
        None
    }))
}

/// The built-in shaders that need no feature beyond browsers' and that no pipeline was made of since a device was opened.
pub(crate) fn without_pipeline() -> Vec<String> {
    let used = used();
    let all = jobs::ALL.iter().filter(|job| job.features.is_empty());
    all.map(|job| job.name.to_string())
        .filter(|name| !used.contains(name))
        .collect()
}
