//! A comparison: several strategies along one camera path over one scene, first for accuracy, then
//! for speed.
//!
//! Accuracy: every pose is held against the reference, all strategies in step, each a frame a pose.
//! Speed: blocks of consecutive poses, the strategies in rotation, so that heat, clocks and
//! neighbours strike all alike; a twin of one strategy says what the noise is.

use std::collections::BTreeMap;
use std::path::Path as FilePath;
use std::sync::Arc;

use antumbra_cull::{Registry, RegistryError, Stage, StageOptions, Strategy, Verdict, ViewSpec};
use antumbra_draw::{Gpu, GpuScene};
use antumbra_scene::Scene;
use image::RgbaImage;

use crate::MeasureError;
use crate::path::Path;
use crate::report::{
    Adapter, Drawn, ErrorReport, FrameSeries, MeanMax, Noise, PoseRecord, Report, SceneFacts,
    Spread, StrategyReport, WorstFrame, WorstImages,
};
use crate::stats;

mod accuracy;
mod script;
mod speed;

pub use accuracy::camera;
use accuracy::{Accuracy, ViewError};
pub use script::Script;
use script::Set;
use speed::Speed;

/// One entry of a comparison.
pub struct Contender {
    label: String,
    name: String,
    make: Box<dyn Fn() -> Result<Box<dyn Strategy>, RegistryError>>,
}

impl Contender {
    /// A strategy by how it is made; the label is what tables call it, empty for its name.
    pub fn new(label: impl Into<String>, make: impl Fn() -> Box<dyn Strategy> + 'static) -> Self {
        Self {
            label: label.into(),
            name: make().name().to_owned(),
            make: Box::new(move || Ok(make())),
        }
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
pub struct Progress {
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
    /// be.
    ///
    /// # Errors
    /// When a file cannot be written; what is there was written whole.
    pub fn save(&self, dir: &FilePath) -> Result<(), MeasureError> {
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
        Ok(())
    }
}

/// Compares strategies on a scene along a path.
///
/// # Errors
/// When a strategy cannot be declared or a frame fails; nothing is half done then.
pub fn compare(
    gpu: &Gpu,
    scene: &mut Scene,
    path: &Path,
    contenders: &[Contender],
    options: &CompareOptions,
    progress: &mut dyn FnMut(Progress),
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
    path: &Path,
    contenders: &[Contender],
    options: &CompareOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<Comparison, MeasureError> {
    let mut set = Set::new(gpu, scene, script, path)?;
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
    let mut pictures = BTreeMap::new();
    let mut strategies = Vec::with_capacity(contenders.len());
    for (at, contender) in contenders.iter().enumerate() {
        let report = strategy_report(
            &stages[at],
            contender,
            &accuracy,
            at,
            &speed,
            contenders,
            &mut pictures,
        )?;
        strategies.push(report);
    }
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
            views: 1,
            size: options.size,
            frames: path.poses().len() as u64,
        },
        noise: Noise {
            frame_time_ratio_p95: noise,
        },
        labels: BTreeMap::new(),
        seeds: BTreeMap::new(),
        poses: path.poses().iter().map(pose_record).collect(),
        strategies,
    };
    Ok(Comparison { report, pictures })
}

fn stage(
    scene: &GpuScene,
    contender: &Contender,
    options: &CompareOptions,
) -> Result<Stage, MeasureError> {
    let [width, height] = options.size;
    let stage_options = StageOptions {
        timing: true,
        ..StageOptions::default()
    };
    Ok(Stage::new(
        scene,
        (contender.make)()?,
        vec![ViewSpec::main(width, height)],
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

fn strategy_report(
    stage: &Stage,
    contender: &Contender,
    accuracy: &Accuracy,
    at: usize,
    speed: &Speed,
    contenders: &[Contender],
    pictures: &mut BTreeMap<String, RgbaImage>,
) -> Result<StrategyReport, MeasureError> {
    let strategy = stage.strategy();
    let (record, run) = (&accuracy.records[at], &speed.runs[at]);
    let against = |name: &str| -> Result<Option<f64>, MeasureError> {
        let Some(other) = contenders
            .iter()
            .position(|contender| contender.name == name)
        else {
            return Ok(None);
        };
        let ratios = stats::block_ratios(&run.frame_ms, &speed.runs[other].frame_ms, speed.block)?;
        Ok(Some(stats::median(&ratios)?))
    };
    let settings = strategy
        .settings()
        .into_iter()
        .map(|setting| (setting.key.to_owned(), value(&setting.value)))
        .collect();
    let poses = accuracy.owners.len();
    let mean = |sum: u64| sum as f64 / poses.max(1) as f64;
    let worst = match &record.worst {
        Some(worst) => {
            let base = file_base(
                if contender.label.is_empty() {
                    strategy.name()
                } else {
                    &contender.label
                },
                at,
            );
            let images = WorstImages {
                reference: format!("{base}-reference.png"),
                strategy: format!("{base}-worst.png"),
                marked: format!("{base}-marked.png"),
            };
            let marked = crate::image_error::mark_wrong(&worst.strategy, &worst.mask)?;
            pictures.insert(images.reference.clone(), worst.reference.clone());
            pictures.insert(images.strategy.clone(), worst.strategy.clone());
            pictures.insert(images.marked.clone(), marked);
            Some(WorstFrame {
                frame: worst.frame as u64,
                view: 0,
                images,
            })
        }
        None => None,
    };
    let views = vec![error_report(&record.view, record.flip)?];
    let verdicts = Verdict::ALL
        .iter()
        .zip(record.tally)
        .map(|(verdict, sum)| (verdict.word().to_owned(), mean(sum)))
        .collect();
    Ok(StrategyReport {
        name: strategy.name().to_owned(),
        label: contender.label.clone(),
        latency: strategy
            .latency()
            .map_or_else(|| "none".to_owned(), |latency| latency.to_string()),
        settings,
        conservative: strategy.conservative(),
        frame_ms: Spread {
            median: stats::median(&run.frame_ms)?,
            p95: stats::percentile(&run.frame_ms, 95.0)?,
        },
        free_running_ms: run.free_running_ms,
        cull_ms: run.group_median("cull"),
        draw_ms: run.group_median("draw"),
        time_vs_none: against("none")?,
        time_vs_frustum: against("frustum")?,
        time_vs_ideal: against("ideal")?,
        drawn: Drawn {
            entities: mean(record.drawn),
            triangles: mean(record.triangles),
        },
        queries: mean(record.asked),
        sync_points: record.sync_points,
        overdrawn_entities: mean(record.overdrawn),
        error: views[0],
        views,
        frames: FrameSeries {
            frame_ms: run.by_pose(poses)?,
            wrong_pixels_percent: record.view.wrong_percent.clone(),
        },
        passes: run.pass_medians(),
        verdicts,
        worst,
    })
}

fn error_report(view: &ViewError, flip: MeanMax) -> Result<ErrorReport, MeasureError> {
    let most = view
        .false_culls
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.cmp(b.1).then(b.0.cmp(&a.0)));
    Ok(ErrorReport {
        wrong_pixels_percent: MeanMax {
            mean: stats::mean(&view.wrong_percent)?,
            max: view.wrong_percent.iter().copied().fold(0.0, f64::max),
        },
        false_culls: crate::report::FalseCulls {
            entities: view.false_culls.iter().sum(),
            worst_frame: most
                .filter(|(_, culls)| **culls > 0)
                .map(|(frame, _)| frame as u64),
            longest_run_frames: stats::longest_run(view.false_culls.iter().map(|culls| *culls > 0)),
        },
        flip,
    })
}

fn pose_record(pose: &crate::path::Pose) -> PoseRecord {
    PoseRecord {
        position: pose.position.to_array(),
        rotation: pose.rotation.to_array(),
        cut: pose.cut,
    }
}

/// A setting's value as JSON: a number where it is one.
fn value(text: &str) -> serde_json::Value {
    serde_json::from_str(text)
        .ok()
        .filter(serde_json::Value::is_number)
        .unwrap_or_else(|| text.into())
}

/// A file name's beginning that any file system takes.
fn file_base(title: &str, at: usize) -> String {
    let plain: String = title
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
        .collect();
    format!("{at}-{plain}")
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
