//! Opening a device: which adapter, which features, and what to say when there is none.
//!
//! Adapters are asked for by backend on purpose: where Vulkan is missing, wgpu would fall back to a GL driver without
//! a word, and every timing would be another machine's.

use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex};

use thiserror::Error;

/// Which adapter to open.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum AdapterChoice {
    /// The fastest kind there is: discrete, integrated, virtual, then software; never GL.
    #[default]
    Auto,
    /// A software adapter.
    Cpu,
    /// A hardware adapter.
    Gpu,
    /// The first adapter whose `name (backend)` contains this text, whatever its case: `llvmpipe`, `H200`, `gl`.
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

/// Why no device could be opened, or what became of it.
#[derive(Debug, Clone, Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// No adapter answers to the choice.
    #[error(
        "no adapter found for '{choice}' (found: {}). A software Vulkan driver comes with the packages \
         libvulkan1 and mesa-vulkan-drivers on Debian and Ubuntu; `antumbra doctor` lists what is there",
        if found.is_empty() { "none".to_owned() } else { found.join(", ") }
    )]
    NoAdapter {
        /// What was asked for.
        choice: AdapterChoice,
        /// The adapters that exist, as `name (backend)`.
        found: Vec<String>,
    },
    /// The adapter exists, yet gives no device.
    #[error("adapter '{adapter}' gives no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// wgpu's words.
        reason: String,
    },
    /// The adapter lacks something that drawing here cannot do without.
    #[error("adapter '{adapter}' cannot be used: it lacks {what}")]
    Lacking {
        /// The adapter's name.
        adapter: String,
        /// The missing capability.
        what: String,
    },
    /// The device went away; whatever was being made is incomplete and was not written.
    #[error(
        "the device was lost ({0}); nothing was half-written. Restart the program, or choose another adapter with --adapter"
    )]
    Lost(String),
    /// wgpu refused a call: a defect of this program or of its driver.
    #[error("the device reported an error: {0}")]
    Refused(String),
}

/// An open device with what is worth knowing about it.
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
    troubles: Arc<Mutex<Troubles>>,
}

#[derive(Debug, Default)]
struct Troubles {
    lost: Option<String>,
    refused: Option<String>,
}

/// Features taken whenever the adapter has them; nothing needs all of them.
pub const WANTED_FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY
    .union(wgpu::Features::SHADER_EARLY_DEPTH_TEST)
    .union(wgpu::Features::INDIRECT_FIRST_INSTANCE);

impl Gpu {
    /// Opens a device on the chosen adapter.
    ///
    /// # Errors
    /// [`DeviceError::NoAdapter`] with the adapters there are, or what the chosen one lacks.
    pub fn open(choice: &AdapterChoice) -> Result<Self, DeviceError> {
        pollster::block_on(Self::open_async(choice))
    }

    async fn open_async(choice: &AdapterChoice) -> Result<Self, DeviceError> {
        let native = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
        let backends = match choice {
            AdapterChoice::Named(_) => native | wgpu::Backends::GL,
            _ => native,
        };
        let mut adapters = adapters(backends).await;
        let position = pick(&adapters, choice);
        let Some(position) = position else {
            let found = adapters.iter().map(|a| title(&a.get_info())).collect();
            return Err(DeviceError::NoAdapter {
                choice: choice.clone(),
                found,
            });
        };
        Self::from_adapter(&adapters.swap_remove(position)).await
    }

    /// Opens a device on a given adapter with every feature of [`WANTED_FEATURES`] and every limit it has.
    ///
    /// # Errors
    /// When the adapter gives no device, or cannot read storage buffers in vertex shaders.
    pub async fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, DeviceError> {
        let info = adapter.get_info();
        let downlevel = adapter.get_downlevel_capabilities();
        if !downlevel
            .flags
            .contains(wgpu::DownlevelFlags::VERTEX_STORAGE)
        {
            let what = "storage buffers in vertex shaders".to_owned();
            return Err(DeviceError::Lacking {
                adapter: title(&info),
                what,
            });
        }
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("antumbra"),
                required_features: adapter.features() & WANTED_FEATURES,
                required_limits: adapter.limits(),
                ..Default::default()
            })
            .await
            .map_err(|error| DeviceError::NoDevice {
                adapter: title(&info),
                reason: error.to_string(),
            })?;
        Ok(Self::adopt(device, queue, info, downlevel))
    }

    /// Takes a device that the caller opened. Its error and loss callbacks are set to be asked for by [`Gpu::check`].
    pub fn adopt(
        device: wgpu::Device,
        queue: wgpu::Queue,
        info: wgpu::AdapterInfo,
        downlevel: wgpu::DownlevelCapabilities,
    ) -> Self {
        let troubles = Arc::new(Mutex::new(Troubles::default()));
        let on_loss = Arc::clone(&troubles);
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                note(&on_loss, |t| t.lost = Some(message));
            }
        });
        let on_error = Arc::clone(&troubles);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            tracing::error!(%error, "wgpu");
            note(&on_error, |t| {
                t.refused.get_or_insert_with(|| error.to_string());
            });
        }));
        Self {
            device,
            queue,
            info,
            downlevel,
            troubles,
        }
    }

    /// The adapter as `name (backend)`.
    pub fn title(&self) -> String {
        title(&self.info)
    }

    /// Whether the adapter is a software one.
    pub fn is_cpu(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Says whether the device was lost or refused something since it was opened. Cheap; call it once a frame.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] for ever after a loss; [`DeviceError::Refused`] once for the first refusal.
    pub fn check(&self) -> Result<(), DeviceError> {
        let mut troubles = self
            .troubles
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        if let Some(message) = &troubles.lost {
            return Err(DeviceError::Lost(message.clone()));
        }
        troubles
            .refused
            .take()
            .map_or(Ok(()), |message| Err(DeviceError::Refused(message)))
    }

    /// Blocks until all submitted work is done.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when it never will be.
    pub fn wait(&self) -> Result<(), DeviceError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| DeviceError::Lost(error.to_string()))?;
        self.check()
    }
}

/// All adapters of some backends, in wgpu's order.
pub async fn adapters(backends: wgpu::Backends) -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    wgpu::Instance::new(descriptor)
        .enumerate_adapters(backends)
        .await
}

/// An adapter as `name (backend)`.
pub fn title(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({})", info.name, info.backend)
}

fn note(troubles: &Mutex<Troubles>, write: impl FnOnce(&mut Troubles)) {
    write(
        &mut troubles
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
                title(&adapters[*i].get_info())
                    .to_lowercase()
                    .contains(&wanted)
            })
        }
    }
}
