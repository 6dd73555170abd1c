//! Puts every shader, every pipeline and every strategy through a device with WebGPU's default limits, and says what came out. In a page it runs on the browser's own WebGPU, which reads
//! WGSL with another compiler than wgpu's; without a browser it is the same program on the same rasteriser, so that both must say the same.
//!
//! [`run`] does all of it. The page writes its [`Report`] into the document, the program prints it, and `scripts/web.sh` compares them.

mod cases;
mod frames;
mod judged;
mod opened;
mod report;
mod scenes;
mod scope;
mod shaders;

pub use report::{Case, DeviceReport, Report};

use antumbra_cull::{Gpu, StageError, adapter_title};
use opened::Offer;
use thiserror::Error;

/// How much is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Shader modules and the self-test of the driver.
    Shaders,
    /// That, and frames with every strategy.
    All,
}

/// Why there is no report.
#[derive(Debug, Error)]
pub enum WebError {
    /// No adapter of the wanted name.
    #[error("no adapter whose name contains '{wanted}' (found: {found:?})")]
    NoAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is.
        found: Vec<String>,
    },
    /// The device, or a frame.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// A scene could not be made.
    #[error("the scene '{scene}': {reason}")]
    Scene {
        /// Its name.
        scene: &'static str,
        /// Why.
        reason: String,
    },
}

/// Does so much on the first adapter whose name contains `wanted`, ignoring case, and tells `progress` what is done.
///
/// # Errors
/// [`WebError`] where it cannot be done at all. What the device refuses is part of the report.
pub async fn run(
    wanted: &str,
    extent: Extent,
    progress: &dyn Fn(&str),
) -> Result<Report, WebError> {
    let mut devices = Vec::new();
    let mut title = String::new();
    for offer in Offer::ALL {
        // An adapter of WebGPU opens one device.
        let adapter = adapter(wanted).await?;
        title = adapter_title(&adapter.get_info());
        let gpu = opened::open(&adapter, offer).await?;
        devices.push(on_device(&gpu, offer, extent, progress).await?);
    }
    Ok(Report {
        adapter: title,
        devices,
    })
}

/// The first adapter whose name contains `wanted`.
async fn adapter(wanted: &str) -> Result<wgpu::Adapter, WebError> {
    let adapters = antumbra_cull::adapters(wgpu::Backends::PRIMARY).await;
    let title = |adapter: &wgpu::Adapter| adapter_title(&adapter.get_info());
    let found = adapters.iter().map(title).collect();
    let mut adapters = adapters.into_iter();
    let matches = |adapter: &wgpu::Adapter| {
        let title = title(adapter).to_lowercase();
        title.contains(&wanted.to_lowercase())
    };
    adapters.find(matches).ok_or_else(|| WebError::NoAdapter {
        wanted: wanted.to_owned(),
        found,
    })
}

/// Does so much on a device.
async fn on_device(
    gpu: &Gpu,
    offer: Offer,
    extent: Extent,
    progress: &dyn Fn(&str),
) -> Result<DeviceReport, WebError> {
    let name = offer.name();
    progress(&format!("{name}: shaders"));
    let shaders = shaders::cases(gpu).await;
    let mut self_test = Vec::new();
    for samples in [1, 4] {
        progress(&format!("{name}: self-test with {samples} samples a pixel"));
        let report = gpu.self_test_async(samples).await;
        let report = report.map_err(StageError::from)?;
        let lines = report.to_string();
        let lines = lines.lines().map(|line| line.split_once(": "));
        self_test.extend(lines.flatten().map(|(what, outcome)| Case {
            name: format!("{what}, {samples} samples"),
            outcome: outcome.to_owned(),
        }));
    }
    let mut frames = Vec::new();
    if extent == Extent::All {
        frames = frames::cases(gpu, offer, progress).await?;
        progress(&format!("{name}: the judge"));
        frames.extend(judged::cases(gpu).await?);
    }
    Ok(DeviceReport {
        device: name.to_owned(),
        shaders,
        self_test,
        without_pipeline: opened::without_pipeline(),
        frames,
    })
}
