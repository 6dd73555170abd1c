//! A comparison: several strategies along one camera path over one scene, first for accuracy, then
//! for speed.
//!
//! Accuracy: every pose is held against the reference, all strategies in step, each a frame a pose.
//! Speed: blocks of consecutive poses, the strategies in rotation, so that heat, clocks and
//! neighbours strike all alike; a twin of one strategy says what the noise is.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use antumbra_cull::{AuditOptions, Budget, Registry, RegistryError, Stage, StageOptions, Strategy};
use antumbra_draw::{Gpu, GpuScene};
use antumbra_scene::{Scene, Stereo};
use image::RgbaImage;

use crate::files::write_beside;
use crate::path::CameraPath;
use crate::report::{Adapter, Noise, PoseRecord, Report, SceneFacts};
use crate::{MeasureError, plots, stats, views};

mod accuracy;
mod audited;
mod entry;
mod script;
mod speed;

use entry::Entries;
pub use entry::is_report_file;
pub use script::Script;
use script::Set;
pub(crate) use speed::usual_block;

/// One entry of a comparison.
pub struct Contender {
    label: String,
    name: String,
    make: Box<dyn Fn() -> Result<Box<dyn Strategy>, RegistryError>>,
    audit: Option<AuditOptions>,
    budget: Option<Budget>,
}

impl Contender {
    /// A strategy by how it is made; the label is what tables call it, empty for its name.
    pub fn new(label: impl Into<String>, make: impl Fn() -> Box<dyn Strategy> + 'static) -> Self {
        Self {
            label: label.into(),
            name: make().name().to_owned(),
            make: Box::new(move || Ok(make())),
            audit: None,
            budget: None,
        }
    }

    /// The same, auditing itself each frame.
    #[must_use]
    pub fn audited(mut self, audit: AuditOptions) -> Self {
        self.audit = Some(audit);
        self
    }

    /// The same with a budget in place of settings. One of wrong pixels audits itself.
    #[must_use]
    pub fn within(mut self, budget: Budget) -> Self {
        self.budget = Some(budget);
        self
    }

    /// A registered strategy by what [`Registry::parse`] takes: `name:key=value`.
    ///
    /// # Errors
    /// [`RegistryError`]: what is unknown, with what is known instead.
    pub fn of(
        label: impl Into<String>,
        registry: &Arc<Registry>,
        spec: &str,
    ) -> Result<Self, RegistryError> {
        let (registry, spec) = (Arc::clone(registry), spec.to_owned());
        Ok(Self {
            label: label.into(),
            name: registry.parse(&spec)?.name().to_owned(),
            make: Box::new(move || registry.parse(&spec)),
            audit: None,
            budget: None,
        })
    }

    fn is_yardstick(&self) -> bool {
        matches!(self.name.as_str(), "none" | "frustum" | "ideal")
    }
}

/// How to compare.
#[derive(Debug, Clone)]
pub struct CompareOptions {
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
    /// Two eyes for each pose's camera, drawn in one frame; `None` for the camera alone.
    pub stereo: Option<Stereo>,
    /// Poses a block; `None` takes a sixth of the path, 20 at most.
    pub block: Option<usize>,
    /// The path is flown again for speed until this many seconds are over, five times at most.
    pub least_seconds: f64,
    /// Poses, evenly spaced, at which FLIP is computed where any pixel is wrong; the worst frame's
    /// is always.
    pub flip_poses: usize,
    /// The command line, for the report.
    pub command: String,
    /// The scene's name, for the report.
    pub scene_name: String,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self {
            size: [1280, 1024],
            stereo: None,
            block: None,
            least_seconds: 2.0,
            flip_poses: 8,
            command: String::new(),
            scene_name: String::new(),
        }
    }
}

/// How far a comparison has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CompareProgress {
    /// What is being done: `accuracy`, `speed`, `free running`.
    pub phase: &'static str,
    /// Frames done in this phase.
    pub done: u64,
    /// Frames of this phase; the path may be flown again for short ones.
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

impl Comparison {
    /// Writes `report.json`, its pictures and `report.html` into a folder, which is made if need
    /// be; of a sweep also `trade.svg`, its plot of speed against error.
    ///
    /// # Errors
    /// When a file cannot be written; what is there was written whole.
    pub fn save(&self, dir: &Path) -> Result<(), MeasureError> {
        let failed = |source| MeasureError::File {
            action: "create",
            path: dir.to_owned(),
            source,
        };
        std::fs::create_dir_all(dir).map_err(failed)?;
        for (name, picture) in &self.pictures {
            crate::image_error::save_png(picture, &dir.join(name))?;
        }
        self.report.save(dir.join("report.json"))?;
        crate::html::write_html(&self.report, dir)?;
        if self.report.sweep.is_some()
            && let Some(svg) = plots::speed_against_error(&self.report)?
        {
            write_beside(&dir.join("trade.svg"), plots::on_paper(&svg).as_bytes())?;
        }
        Ok(())
    }
}

/// Compares strategies on a scene along a path.
///
/// # Errors
/// When a strategy cannot be declared or a frame fails, or the path's cameras have no two eyes that were asked for; nothing is
/// half done then.
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

/// The same over a scene that a script changes between the poses. What the script takes counts in no serialised frame,
/// though it does where frames run free.
///
/// # Errors
/// As for [`compare`]; whatever stops the script.
pub fn compare_scripted(
    gpu: &Gpu,
    scene: &mut Scene,
    script: &mut dyn Script,
    path: &CameraPath,
    contenders: &[Contender],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Comparison, MeasureError> {
    let mut set = Set::new(gpu, scene, script, path, options.stereo)?;
    let mut stages = contenders
        .iter()
        .map(|contender| stage(set.scene(), contender, options))
        .collect::<Result<Vec<_>, _>>()?;
    let accuracy = accuracy::measure(&mut set, &mut stages, options, progress)?;
    let twin = twin(contenders);
    if let Some(contender) = twin.and_then(|at| contenders.get(at)) {
        stages.push(stage(set.scene(), contender, options)?);
    }
    let speed = speed::measure(&mut set, &mut stages, &accuracy.owners, options, progress)?;
    let noise = match twin.zip(speed.runs.last()) {
        Some((at, last)) => Some(stats::noise_p95(&stats::block_ratios(
            &last.frame_ms,
            &speed.runs[at].frame_ms,
            speed.block,
        )?)?),
        None => None,
    };
    let (strategies, pictures) = Entries {
        accuracy: &accuracy,
        speed: &speed,
        contenders,
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
            frames: path.poses().len() as u64,
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
        audit: contender.audit,
        budget: contender.budget,
        ..StageOptions::default()
    };
    Ok(Stage::new(
        scene,
        (contender.make)()?,
        views::specs(options.stereo.as_ref(), options.size),
        stage_options,
    )?)
}

/// Whose twin measures the noise: the first that is no yardstick, else the first.
fn twin(contenders: &[Contender]) -> Option<usize> {
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
