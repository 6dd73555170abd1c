//! A comparison: several strategies along one camera path in one scene, first for accuracy, then for speed.
//!
//! Accuracy: at every pose, each strategy draws a frame, which is compared with the reference.
//! Speed: blocks of consecutive poses, with the strategies in rotation, so that temperature, clock rates and other load affect all alike. One
//! strategy is measured twice; the difference of the two is the noise.

use std::collections::BTreeMap;
use std::sync::Arc;

use antumbra_cull::{
    AuditOptions, Budget, DistrustOptions, Gpu, Registry, RegistryError, Role, Stage, StageOptions,
    Strategy,
};
use antumbra_draw::GpuScene;
use antumbra_graph::LateResults;
use antumbra_scene::{Scene, Stereo};
use image::RgbaImage;

use crate::path::CameraPath;
use crate::report::{Adapter, MotionFacts, Noise, PoseRecord, Report, SceneFacts};
use crate::{MeasureError, stats, views};

mod accuracy;
mod audited;
mod entry;
mod errors;
mod fates;
mod playback;
mod save;
mod script;
mod speed;

pub use entry::is_report_file;
use entry::{Entries, ReportedEntries};
pub use playback::{Playback, Timing};
pub use script::Script;
use script::ScriptedScene;
pub(crate) use speed::usual_block;

/// One entry of a comparison.
pub struct Contender {
    label: String,
    role: Role,
    make: Box<dyn Fn() -> Result<Box<dyn Strategy>, RegistryError>>,
    audit: Option<AuditOptions>,
    budget: Option<Budget>,
}

impl Contender {
    /// A strategy from a function that makes it. Tables use the label; an empty one means the strategy's name.
    pub fn new(label: impl Into<String>, make: impl Fn() -> Box<dyn Strategy> + 'static) -> Self {
        Self {
            label: label.into(),
            role: make().role(),
            make: Box::new(move || Ok(make())),
            audit: None,
            budget: None,
        }
    }

    /// The same, with a self-audit in each frame. The report marks it ([`StrategyReport::audited`](crate::report::StrategyReport::audited)).
    #[must_use]
    pub fn audited(mut self, audit: AuditOptions) -> Self {
        self.audit = Some(audit);
        self
    }

    /// The same with a budget in place of settings. A budget of wrong pixels audits itself.
    #[must_use]
    pub fn within(mut self, budget: Budget) -> Self {
        self.budget = Some(budget);
        self
    }

    /// A registered strategy by its specification, as for [`Registry::parse`]: `name:key=value`.
    ///
    /// # Errors
    /// [`RegistryError`] for an unknown name, key or value; it lists the known ones.
    pub fn of(
        label: impl Into<String>,
        registry: &Arc<Registry>,
        spec: &str,
    ) -> Result<Self, RegistryError> {
        let (registry, spec) = (Arc::clone(registry), spec.to_owned());
        Ok(Self {
            label: label.into(),
            role: registry.parse(&spec)?.role(),
            make: Box::new(move || registry.parse(&spec)),
            audit: None,
            budget: None,
        })
    }

    fn is_yardstick(&self) -> bool {
        self.role.is_yardstick()
    }
}

/// Options of a comparison.
#[derive(Debug, Clone)]
pub struct CompareOptions {
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// Samples a pixel: 1, 4, or what else the device has. A pixel is wrong if the owner of any of its samples is.
    pub samples: u32,
    /// Frames in flight, at least 1. A frame uses the late answers of exactly so many frames ago, as a host does that records so many frames before the first of them is done; which frame's is no
    /// affair of the device's speed, so that the same input gives the same errors.
    pub in_flight: u32,
    /// Two eyes for each pose's camera, drawn in one frame; `None` for a single view.
    pub stereo: Option<Stereo>,
    /// Poses of a block; `None` means a sixth of the path, 20 at most.
    pub block: Option<usize>,
    /// The path is repeated for speed until this many seconds have passed, five times at most.
    pub least_seconds: f64,
    /// The number of evenly spaced poses at which FLIP is computed, from the shaded images. It is always computed for the worst frame.
    pub flip_poses: usize,
    /// The command line, for the report.
    pub command: String,
    /// The scene's name, for the report.
    pub scene_name: String,
    /// What the script plays, for the report.
    pub motion: Option<MotionFacts>,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self {
            size: [1280, 1024],
            samples: 1,
            in_flight: 1,
            stereo: None,
            block: None,
            least_seconds: 2.0,
            flip_poses: 8,
            command: String::new(),
            scene_name: String::new(),
            motion: None,
        }
    }
}

/// The progress of a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CompareProgress {
    /// The phase: `accuracy`, `speed`, `free running`.
    pub phase: &'static str,
    /// Frames done in this phase.
    pub done: u64,
    /// Frames of this phase. A short path may be repeated.
    pub total: u64,
}

/// A report and the pictures it names.
#[derive(Debug)]
pub struct Comparison {
    /// The report.
    pub report: Report,
    /// Pictures by file name.
    pub pictures: BTreeMap<String, RgbaImage>,
}

/// Compares strategies in a scene along a path.
///
/// # Errors
/// [`MeasureError`] where a strategy cannot be declared, a frame fails, or the stereo parameters do not fit the path's cameras. Nothing is
/// returned or written then.
pub fn compare(
    gpu: &Gpu,
    scene: &mut Scene,
    path: &CameraPath,
    contenders: &[Contender],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Comparison, MeasureError> {
    compare_scripted(gpu, scene, &mut (), path, contenders, options, progress)
}

/// [`compare`] in a scene that a script changes between the poses. The script's time does not count in serialised frames; it does count in
/// free-running ones.
///
/// # Errors
/// As for [`compare`], and [`MeasureError::Script`] where the script fails.
pub fn compare_scripted(
    gpu: &Gpu,
    scene: &mut Scene,
    script: &mut dyn Script,
    path: &CameraPath,
    contenders: &[Contender],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Comparison, MeasureError> {
    let mut scripted = ScriptedScene::new(gpu, scene, script, path, options.stereo)?;
    let mut stages = contenders
        .iter()
        .map(|contender| stage(scripted.scene(), contender, options))
        .collect::<Result<Vec<_>, _>>()?;
    let accuracy = accuracy::measure(&mut scripted, &mut stages, options, progress)?;
    let twin = measured_twice(contenders);
    if let Some(contender) = twin.and_then(|at| contenders.get(at)) {
        stages.push(stage(scripted.scene(), contender, options)?);
    }
    let speed = speed::measure(
        &mut scripted,
        &mut stages,
        &accuracy.owners,
        options,
        progress,
    )?;
    let noise = match twin.zip(speed.runs.last()) {
        Some((at, last)) => Some(stats::noise_p95(&stats::block_ratios(
            &last.frame_ms,
            &speed.runs[at].frame_ms,
            speed.block,
        )?)?),
        None => None,
    };
    let ReportedEntries {
        strategies,
        pictures,
    } = Entries {
        accuracy: &accuracy,
        speed: &speed,
        contenders,
        scene,
        size: options.size,
    }
    .reports(&stages)?;
    let report = Report {
        antumbra: env!("CARGO_PKG_VERSION").to_owned(),
        command: options.command.clone(),
        adapter: Adapter {
            name: gpu.info.name.clone(),
            backend: gpu.info.backend.to_string(),
            kind: adapter_kind(gpu.info.device_type).to_owned(),
        },
        scene: SceneFacts {
            name: options.scene_name.clone(),
            path: path.name().to_owned(),
            entities: scene.drawable_count() as u64,
            triangles: scene.triangle_count(),
            views: views::specs(options.stereo.as_ref(), options.size).len() as u32,
            stereo: options.stereo.map(Into::into),
            size: options.size,
            samples: options.samples,
            in_flight: Some(options.in_flight.max(1)),
            frames: path.poses().len() as u64,
            owned_percent: accuracy.owned_percent(options.size),
            motion: options.motion.clone(),
            left_out: Vec::new(),
        },
        noise: Noise {
            frame_time_ratio_p95: noise,
            block_frames: Some(speed.block as u64),
        },
        labels: BTreeMap::new(),
        seeds: BTreeMap::new(),
        poses: path.poses().iter().map(pose_record).collect(),
        strategies,
        sweep: None,
    };
    Ok(Comparison { report, pictures })
}

fn stage(
    scene: &GpuScene,
    contender: &Contender,
    options: &CompareOptions,
) -> Result<Stage, MeasureError> {
    let stage_options = StageOptions {
        timing: true,
        samples: options.samples,
        frames_in_flight: options.in_flight.max(1),
        // Which frame's answers are used must not follow from how fast the device is.
        late_results: LateResults::OfFramesInFlight,
        audit: contender.audit,
        budget: contender.budget,
        // What is measured is the contender, not what replaces it. Its errors are counted.
        distrust: DistrustOptions::OFF,
        ..StageOptions::default()
    };
    Ok(Stage::new(
        scene,
        (contender.make)()?,
        views::specs(options.stereo.as_ref(), options.size),
        stage_options,
    )?)
}

/// The contender that is measured twice, for the noise: the first that is no yardstick, else the first.
fn measured_twice(contenders: &[Contender]) -> Option<usize> {
    contenders
        .iter()
        .position(|contender| !contender.is_yardstick())
        .or((!contenders.is_empty()).then_some(0))
}

fn pose_record(pose: &crate::path::Pose) -> PoseRecord {
    PoseRecord {
        position: pose.position.to_array(),
        rotation: pose.rotation.to_array(),
        cut: pose.cut,
    }
}

fn adapter_kind(kind: wgpu::DeviceType) -> &'static str {
    match kind {
        wgpu::DeviceType::DiscreteGpu => "discrete-gpu",
        wgpu::DeviceType::IntegratedGpu => "integrated-gpu",
        wgpu::DeviceType::VirtualGpu => "virtual-gpu",
        wgpu::DeviceType::Cpu => "cpu",
        wgpu::DeviceType::Other => "other",
    }
}
