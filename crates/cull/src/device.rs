//! Opens a device: chooses an adapter and features, and explains failures.
//!
//! Adapters are chosen by backend on purpose. Where Vulkan is missing, wgpu would silently fall back to a GL driver, and timings would not be
//! comparable.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex};

use antumbra_graph::CompileOptions;
use antumbra_shaders::Job;
use thiserror::Error;

use crate::pipelines::Pipelines;
use crate::renderer::{DEPTH_FORMAT, IDENTITY_FORMAT};
use crate::self_test::SelfTests;

/// The choice of an adapter.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum AdapterChoice {
    /// The first available of discrete, integrated, virtual, software; never GL.
    #[default]
    Auto,
    /// A software adapter.
    Cpu,
    /// A hardware adapter.
    Gpu,
    /// The first adapter whose `name (backend)` contains this text, ignoring case: `llvmpipe`, `H200`, `gl`.
    Named(String),
}

impl FromStr for AdapterChoice {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text {
            "auto" => Self::Auto,
            "cpu" => Self::Cpu,
            "gpu" => Self::Gpu,
            name => Self::Named(name.to_owned()),
        })
    }
}

impl fmt::Display for AdapterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Cpu => f.write_str("cpu"),
            Self::Gpu => f.write_str("gpu"),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// Why a device could not be opened, or why it failed.
#[derive(Debug, Clone, Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// wgpu was compiled without a backend for this platform.
    #[error(
        "no backend of wgpu is compiled in for this platform: switch on `vulkan`, `gles`, `metal`, `dx12` or, for browsers, `webgpu`, of `antumbra` or of your own `wgpu`"
    )]
    NoBackend,
    /// No adapter matches the choice.
    #[error(
        "no adapter found for '{choice}' (found: {}). A software Vulkan driver comes with the packages \
         libvulkan1 and mesa-vulkan-drivers on Debian and Ubuntu; `antumbra doctor` lists what is there",
        if found.is_empty() { "none".to_owned() } else { found.join(", ") }
    )]
    NoAdapter {
        /// The choice.
        choice: AdapterChoice,
        /// The adapters that exist, as `name (backend)`.
        found: Vec<String>,
    },
    /// The adapter exists but provides no device.
    #[error("adapter '{adapter}' gives no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// wgpu's message.
        reason: String,
    },
    /// The adapter lacks a capability that drawing needs.
    #[error("adapter '{adapter}' cannot be used: it lacks {what}")]
    Lacking {
        /// The adapter's name.
        adapter: String,
        /// The missing capability.
        what: String,
    },
    /// The device does not draw with so many samples a pixel.
    #[error("{samples} samples a pixel: this device draws with {allowed:?}")]
    Samples {
        /// What was asked for.
        samples: u32,
        /// What it has.
        allowed: Vec<u32>,
    },
    /// Something waits for the GPU, and this is a browser.
    #[error("{what} waits for the GPU, which a browser does not do: use {instead} there")]
    CannotWait {
        /// What waits.
        what: &'static str,
        /// What to call or to set instead.
        instead: &'static str,
    },
    /// The device was lost. Unfinished output was not written.
    #[error(
        "the device was lost ({0}); nothing was half-written. Restart the program, or choose another adapter with --adapter"
    )]
    Lost(String),
    /// wgpu reported an error: a defect of this program or of the driver.
    #[error("the device reported an error: {0}")]
    Refused(String),
}

/// An open device with its queue and adapter facts.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// The adapter's name, backend and kind.
    pub info: wgpu::AdapterInfo,
    /// What the adapter can do beyond or below WebGPU.
    pub downlevel: wgpu::DownlevelCapabilities,
    adapter: Option<wgpu::Adapter>,
    failures: Arc<Mutex<Failures>>,
    /// What self-tests found, for all stages on this device.
    pub(crate) self_tests: Arc<SelfTests>,
    pub(crate) pipelines: Arc<Pipelines>,
    /// Replaces the text of shaders; see [`Self::with_changed_shaders`].
    change: Option<ShaderChange>,
}

/// What a shader's text is replaced by, from its name and its text; `None`: nothing.
#[doc(hidden)]
pub type ShaderChange = fn(name: &str, source: &str) -> Option<String>;

/// Failures that wgpu's callbacks have reported.
#[derive(Debug, Default)]
struct Failures {
    lost: Option<String>,
    refused: Option<String>,
}

/// Features that are enabled where the adapter has them. None is required.
pub const WANTED_FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY
    .union(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
    .union(wgpu::Features::INDIRECT_FIRST_INSTANCE)
    // Other numbers of samples than 1 and 4.
    .union(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);

impl Gpu {
    /// Opens a device on the chosen adapter.
    ///
    /// # Errors
    /// As [`Self::open_async`]; [`DeviceError::CannotWait`] in a browser.
    pub fn open(choice: &AdapterChoice) -> Result<Self, DeviceError> {
        if cfg!(target_family = "wasm") {
            return Err(DeviceError::CannotWait {
                what: "`Gpu::open`",
                instead: "`Gpu::open_async`",
            });
        }
        pollster::block_on(Self::open_async(choice))
    }

    /// [`Self::open`], to be awaited: the one way in a browser, which offers one adapter.
    ///
    /// # Errors
    /// [`DeviceError::NoBackend`]; [`DeviceError::NoAdapter`] with the available adapters; or an error about what the chosen one lacks.
    pub async fn open_async(choice: &AdapterChoice) -> Result<Self, DeviceError> {
        if wgpu::Instance::enabled_backend_features().is_empty() {
            return Err(DeviceError::NoBackend);
        }
        let first = wgpu::Backends::PRIMARY;
        let backends = match choice {
            AdapterChoice::Named(_) => first | wgpu::Backends::GL,
            _ => first,
        };
        let mut adapters = adapters(backends).await;
        let position = pick(&adapters, choice);
        let Some(position) = position else {
            let found = adapters
                .iter()
                .map(|a| adapter_title(&a.get_info()))
                .collect();
            return Err(DeviceError::NoAdapter {
                choice: choice.clone(),
                found,
            });
        };
        Self::from_adapter(&adapters.swap_remove(position)).await
    }

    /// Opens a device on an adapter, with its features among [`WANTED_FEATURES`] and all of its limits.
    ///
    /// # Errors
    /// [`DeviceError::NoDevice`], or [`DeviceError::Lacking`] where the adapter cannot read storage buffers in vertex shaders.
    pub async fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, DeviceError> {
        let info = adapter.get_info();
        let downlevel = adapter.get_downlevel_capabilities();
        check_capabilities(&info, &downlevel)?;
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("antumbra"),
                required_features: adapter.features() & WANTED_FEATURES,
                required_limits: adapter.limits(),
                ..Default::default()
            })
            .await
            .map_err(|error| DeviceError::NoDevice {
                adapter: adapter_title(&info),
                reason: error.to_string(),
            })?;
        let mut opened = Self::adopt(device, queue, info, downlevel);
        opened.adapter = Some(adapter.clone());
        opened.watch();
        Ok(opened)
    }

    /// Takes a device that the caller opened, and changes nothing of it: its error and loss callbacks stay the caller's. [`Gpu::check`] then has nothing to report,
    /// unless the caller asks for it with [`Gpu::watch`].
    pub fn adopt(
        device: wgpu::Device,
        queue: wgpu::Queue,
        info: wgpu::AdapterInfo,
        downlevel: wgpu::DownlevelCapabilities,
    ) -> Self {
        Self {
            device,
            queue,
            info,
            downlevel,
            adapter: None,
            failures: Arc::default(),
            self_tests: Arc::default(),
            pipelines: Arc::default(),
            change: None,
        }
    }

    /// The module of a shader, to make pipelines with.
    pub fn shader_module(&self, job: &Job) -> wgpu::ShaderModule {
        let source = self.shader_text(job);
        antumbra_shaders::module(
            &self.device,
            &Job {
                source,
                ..job.clone()
            },
        )
    }

    /// The text that a shader is compiled from.
    pub(crate) fn shader_text(&self, job: &Job) -> Cow<'static, str> {
        let changed = self
            .change
            .and_then(|change| change(&job.name, &job.source));
        changed.map_or_else(|| job.source.clone(), Cow::Owned)
    }

    /// This device with a fault, for tests of what finds faults: all pipelines that are made with it have the changed shaders. Nothing is known of its self-tests.
    #[doc(hidden)]
    #[must_use]
    pub fn with_changed_shaders(&self, change: ShaderChange) -> Self {
        Self {
            change: Some(change),
            self_tests: Arc::default(),
            ..self.clone()
        }
    }

    /// Replaces the device's error and loss callbacks, so that [`Gpu::check`] reports errors and a loss. A device that [`Gpu::open`] opened is watched.
    pub fn watch(&self) {
        let on_loss = Arc::clone(&self.failures);
        self.device
            .set_device_lost_callback(move |reason, message| {
                if reason != wgpu::DeviceLostReason::Destroyed {
                    note(&on_loss, |t| t.lost = Some(message));
                }
            });
        let on_error = Arc::clone(&self.failures);
        self.device
            .on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
                tracing::error!(%error, "wgpu");
                note(&on_error, |t| {
                    t.refused.get_or_insert_with(|| error.to_string());
                });
            }));
    }

    /// Refuses an adapter without storage buffers in vertex shaders, which all passes need: an adopted device was not checked before.
    pub(crate) fn check_capabilities(&self) -> Result<(), DeviceError> {
        check_capabilities(&self.info, &self.downlevel)
    }

    /// Whether this is the same device as another. wgpu compares devices of one instance alone; those of another backend or adapter are told apart by these.
    pub(crate) fn is(&self, other: &Self) -> bool {
        let adapter = |gpu: &Self| (gpu.info.backend, gpu.info.name.clone());
        self.device == other.device && adapter(self) == adapter(other)
    }

    /// How a plan that runs on its own is compiled for this device.
    pub fn compile_options(&self) -> CompileOptions<'_> {
        let options = CompileOptions::owned(&self.device);
        match &self.adapter {
            Some(adapter) => options.adapter(adapter),
            None => options,
        }
    }

    /// The samples a pixel that a stage may draw with: 1 and 4 on every device. Others are known of devices that [`Self::open`] and [`Self::from_adapter`] opened.
    pub fn sample_counts(&self) -> Vec<u32> {
        let features = self.device.features();
        let adapter = self.adapter.as_ref().filter(|_| {
            features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
        });
        let counts = |format: wgpu::TextureFormat| match adapter {
            Some(adapter) => adapter.get_texture_format_features(format).flags,
            None => format.guaranteed_format_features(features).flags,
        };
        let ids = counts(IDENTITY_FORMAT);
        let mut both = counts(DEPTH_FORMAT).supported_sample_counts();
        both.retain(|samples| *samples == 1 || ids.sample_count_supported(*samples));
        both
    }

    /// Refuses so many samples a pixel where the device does not draw with them. Pipelines are made before a graph is compiled, and would fail without saying where.
    ///
    /// # Errors
    /// [`DeviceError::Samples`], with what the device has.
    pub fn check_samples(&self, samples: u32) -> Result<(), DeviceError> {
        let allowed = self.sample_counts();
        match allowed.contains(&samples) {
            true => Ok(()),
            false => Err(DeviceError::Samples { samples, allowed }),
        }
    }

    /// Whether shaders can read a texture of several samples a pixel that was drawn into: [`antumbra_graph::reads_drawn_samples`].
    pub fn reads_drawn_samples(&self) -> bool {
        antumbra_graph::reads_drawn_samples(&self.device)
    }

    /// The adapter as `name (backend)`.
    pub fn title(&self) -> String {
        adapter_title(&self.info)
    }

    /// Whether the adapter is a software adapter.
    pub fn is_cpu(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Returns the failures that were reported since the device was opened. Cheap; call it once a frame.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] on every call after a loss; [`DeviceError::Refused`] once, for the first wgpu error since the last call.
    pub fn check(&self) -> Result<(), DeviceError> {
        let mut failures = self
            .failures
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(message) = &failures.lost {
            return Err(DeviceError::Lost(message.clone()));
        }
        failures
            .refused
            .take()
            .map_or(Ok(()), |message| Err(DeviceError::Refused(message)))
    }
}

fn check_capabilities(
    info: &wgpu::AdapterInfo,
    downlevel: &wgpu::DownlevelCapabilities,
) -> Result<(), DeviceError> {
    let needed = wgpu::DownlevelFlags::VERTEX_STORAGE;
    match downlevel.flags.contains(needed) {
        true => Ok(()),
        false => Err(DeviceError::Lacking {
            adapter: adapter_title(info),
            what: "storage buffers in vertex shaders".to_owned(),
        }),
    }
}

/// All adapters of some backends, in wgpu's order; none where no backend is compiled in.
pub async fn adapters(backends: wgpu::Backends) -> Vec<wgpu::Adapter> {
    // wgpu panics without one.
    if wgpu::Instance::enabled_backend_features().is_empty() {
        return Vec::new();
    }
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    wgpu::Instance::new(descriptor)
        .enumerate_adapters(backends)
        .await
}

/// An adapter as `name (backend)`.
pub fn adapter_title(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({})", info.name, info.backend)
}

fn note(failures: &Mutex<Failures>, write: impl FnOnce(&mut Failures)) {
    write(
        &mut failures
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner),
    );
}

fn pick(adapters: &[wgpu::Adapter], choice: &AdapterChoice) -> Option<usize> {
    let kind = |i: usize| adapters[i].get_info().device_type;
    let rank = |i: &usize| match kind(*i) {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    let all = 0..adapters.len();
    match choice {
        AdapterChoice::Auto => all.min_by_key(rank),
        AdapterChoice::Cpu => all.clone().find(|i| kind(*i) == wgpu::DeviceType::Cpu),
        AdapterChoice::Gpu => all
            .filter(|i| kind(*i) != wgpu::DeviceType::Cpu)
            .min_by_key(rank),
        AdapterChoice::Named(name) => {
            let wanted = name.to_lowercase();
            all.clone().find(|i| {
                adapter_title(&adapters[*i].get_info())
                    .to_lowercase()
                    .contains(&wanted)
            })
        }
    }
}
