//! The nouns of `report.json`: everything a comparison measured, and the only thing that tables,
//! plots and the page are drawn from.
//!
//! The schema is documented field by field in `docs/report.md`. A field once published keeps its
//! name; fields of later versions are skipped when read. What was not measured is absent, never
//! NaN.

use std::collections::BTreeMap;

use antumbra_scene::Stereo;
use serde::{Deserialize, Serialize};

mod audit;
mod file;
mod sweep;

pub use audit::{AuditReport, BudgetReport};
pub use file::MAX_REPORT_BYTES;
pub use sweep::{Aggregate, Choice, ErrorMeasure, LimitChoices, RunnerUp, Sweep, VariedSetting};

/// Smaller differences in speed are not spoken of, however quiet the machine was.
const LEAST_RATIO: f64 = 1.005;

/// One comparison: what ran, on what, how noisy the machine was, and what each strategy cost and
/// got wrong.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The version of Antumbra that measured.
    pub antumbra: String,
    /// The command line that made this report, as one would type it again; empty when a library
    /// made it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub command: String,
    /// The adapter that drew.
    pub adapter: Adapter,
    /// The scene and how it was looked at.
    pub scene: SceneFacts,
    /// How much two runs of the same strategy differ.
    pub noise: Noise,
    /// Free words about the run (driver version, machine, ...), by their name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub labels: BTreeMap<String, String>,
    /// The seeds of everything random, by what they seeded (`scene`, `path`, `rotation`, ...).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub seeds: BTreeMap<String, u64>,
    /// The poses of the path in their order; empty when they were not recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseRecord>,
    /// The strategies in the order they were asked for.
    pub strategies: Vec<StrategyReport>,
    /// What was varied and what follows from it; absent for a comparison that is no sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<Sweep>,
}

/// The adapter that drew.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Adapter {
    /// The name the driver gives.
    pub name: String,
    /// The backend: `vulkan`, `metal`, `dx12`, `gl`, ...
    pub backend: String,
    /// The kind of adapter: `discrete-gpu`, `integrated-gpu`, `cpu`, ...
    #[serde(rename = "type")]
    pub kind: String,
}

/// The scene and how it was looked at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneFacts {
    /// The built-in's name or the file's.
    pub name: String,
    /// The camera path: `orbit`, `flight` or the path's file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub path: String,
    /// Drawable entities.
    pub entities: u64,
    /// Triangles of all drawable entities at full detail.
    pub triangles: u64,
    /// Views a frame: 1, or 2 for stereo.
    pub views: u32,
    /// The two eyes of stereo; absent for one view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stereo: Option<StereoFacts>,
    /// Width and height of one view in pixels.
    pub size: [u32; 2],
    /// Poses of the path; each is one frame.
    pub frames: u64,
}

/// Two eyes: parallel, their windows coinciding at a distance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StereoFacts {
    /// Metres between the eyes.
    pub interocular: f64,
    /// Metres from the eyes to where they see the same rectangle.
    pub convergence: f64,
}

impl From<Stereo> for StereoFacts {
    fn from(stereo: Stereo) -> Self {
        Self {
            interocular: stereo.interocular,
            convergence: stereo.convergence,
        }
    }
}

/// How much two runs of the same strategy differ.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// The 95th percentile of the block ratios (larger over smaller) of an A/A run: 1.02 means that
    /// below 2 % nothing was shown. Absent when no A/A run was made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_time_ratio_p95: Option<f64>,
    /// Poses a block of all ratios of times; absent in reports of before it was written down.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block_frames: Option<u64>,
}

/// One pose of the path, enough to stand there again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PoseRecord {
    /// The eye in world metres.
    pub position: [f64; 3],
    /// The camera's rotation, a unit quaternion x, y, z, w; it looks down its -Z with +Y up.
    pub rotation: [f64; 4],
    /// Whether the camera jumped here.
    #[serde(default)]
    pub cut: bool,
}

/// What one strategy cost and got wrong.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StrategyReport {
    /// The strategy's registered name.
    pub name: String,
    /// What tables and plots call it when the name alone is not enough (the same strategy with
    /// other settings); empty: the name.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub label: String,
    /// How answers come back: `frame-late`, `same-frame`, `on-gpu`, or `none` for a strategy that
    /// asks nothing.
    pub latency: String,
    /// The settings it ran with, all of them, defaults included.
    pub settings: BTreeMap<String, serde_json::Value>,
    /// Whether it claims, with these settings, never to cull what is seen.
    pub conservative: bool,
    /// Serialised frame time in milliseconds.
    pub frame_ms: Spread,
    /// Median frame time with two frames in flight, milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free_running_ms: Option<f64>,
    /// Median time of all passes that decide what to draw, milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cull_ms: Option<f64>,
    /// Median time of the shaded and transparent passes, milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub draw_ms: Option<f64>,
    /// What the audit's passes take of a frame on average, milliseconds; absent where there was no audit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub audit_ms: Option<f64>,
    /// Frame time over that of `none`, the median of the block ratios: 0.5 takes half the time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_none: Option<f64>,
    /// Frame time over that of `frustum`, likewise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_frustum: Option<f64>,
    /// Frame time over that of `ideal`, likewise: its inverse is the efficiency.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_ideal: Option<f64>,
    /// What it drew, mean a frame over all views.
    pub drawn: Drawn,
    /// Occlusion queries or counts a frame over all views, mean.
    pub queries: f64,
    /// The same of each eye, left first; empty for a single view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub queries_a_view: Vec<f64>,
    /// Points of the plan where a frame waits for its own results.
    pub sync_points: u32,
    /// Entities drawn that own no pixel of the reference, mean a frame, summed over all views.
    pub overdrawn_entities: f64,
    /// What it got wrong, all views together.
    pub error: ErrorReport,
    /// What it got wrong an eye, left first; empty or one for a single view.
    #[serde(default)]
    pub views: Vec<ErrorReport>,
    /// The series behind the numbers, one value a pose.
    #[serde(default, skip_serializing_if = "FrameSeries::is_empty")]
    pub frames: FrameSeries,
    /// Median times of its passes, in plan order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<PassTime>,
    /// Mean number of entities a frame with each verdict, summed over all views, by the verdict's name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub verdicts: BTreeMap<String, f64>,
    /// Whether it was asked to audit itself; false in reports of before this was written down.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub audited: bool,
    /// What it said of its own wrong pixels; absent where there was no audit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub audit: Option<AuditReport>,
    /// What it was to keep in place of settings; absent where settings stood. `settings` are those of the last frame then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget: Option<BudgetReport>,
    /// The frame with the most wrong pixels, with its pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<WorstFrame>,
}

/// The middle of a series and its upper end.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

/// The mean and the largest value of a series.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct MeanMax {
    /// The mean over all poses.
    pub mean: f64,
    /// The largest of all poses.
    pub max: f64,
}

/// What was drawn, mean a frame.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Entities.
    pub entities: f64,
    /// Triangles.
    pub triangles: f64,
}

/// What was got wrong against the reference.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorReport {
    /// Wrong pixels in percent of the view.
    pub wrong_pixels_percent: MeanMax,
    /// False culls.
    pub false_culls: FalseCulls,
    /// The FLIP difference of the shaded images, 0 (alike) to 1.
    pub flip: MeanMax,
}

/// Entities that own pixels of the reference and were not drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FalseCulls {
    /// False culls summed over all poses: an entity missed in three frames counts three times.
    pub entities: u64,
    /// The pose with the most of them; absent when there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst_frame: Option<u64>,
    /// The longest run of consecutive frames with a false cull in each.
    pub longest_run_frames: u64,
}

/// Values a pose, in path order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameSeries {
    /// Serialised frame time in milliseconds, the median of the repetitions of that pose.
    #[serde(default)]
    pub frame_ms: Vec<f64>,
    /// Triangles drawn, all views together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drawn_triangles: Vec<u64>,
    /// Questions asked, all views together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub queries: Vec<u64>,
    /// Sync points waited at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sync_points: Vec<u32>,
    /// Wrong pixels in percent of the pixels of all views.
    #[serde(default)]
    pub wrong_pixels_percent: Vec<f64>,
    /// Wrong pixels in percent of an eye's pixels: a series an eye, left first; empty for a single view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_pixels_percent_a_view: Vec<Vec<f64>>,
}

/// Median times of one pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassTime {
    /// The pass as the plan names it.
    pub name: String,
    /// What it serves: `cull`, `draw`, or another word.
    pub group: String,
    /// Time to record or run it on the CPU, milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_ms: Option<f64>,
    /// Time on the GPU from timestamps, milliseconds; absent where the device has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu_ms: Option<f64>,
}

/// The frame with the most wrong pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorstFrame {
    /// The pose, the first is 0.
    pub frame: u64,
    /// The view: 0, or 1 for the right eye.
    pub view: u32,
    /// Its pictures.
    pub images: WorstImages,
}

/// File names relative to the report's folder, PNG or JPEG.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorstImages {
    /// Everything in the frustum drawn.
    pub reference: String,
    /// What the strategy drew.
    pub strategy: String,
    /// What it drew, in grey, the wrong pixels in magenta.
    pub marked: String,
}

impl Noise {
    /// The ratio of times that a difference in speed must exceed to show anything: that of the A/A
    /// run, and half a percent at least, which is all there is without one.
    pub fn least_ratio(&self) -> f64 {
        self.frame_time_ratio_p95.unwrap_or(1.0).max(LEAST_RATIO)
    }
}

impl Report {
    /// The first strategy registered under `name`.
    pub fn strategy(&self, name: &str) -> Option<&StrategyReport> {
        self.strategies.iter().find(|s| s.name == name)
    }

    /// The entry of the same strategy, latency and settings as an audited one, without audit and without budget; `None` for an entry that
    /// was not audited, that had a budget, or that ran alone.
    pub fn without_audit(&self, audited: &StrategyReport) -> Option<&StrategyReport> {
        let is_audited = |one: &StrategyReport| one.audited || one.audit.is_some();
        if !is_audited(audited) || audited.budget.is_some() {
            return None;
        }
        self.strategies.iter().find(|one| {
            !is_audited(one)
                && one.budget.is_none()
                && (&one.name, &one.latency) == (&audited.name, &audited.latency)
                && one.settings == audited.settings
        })
    }

    /// What the tables and plots of this report call a strategy: its title, less what the settings
    /// of a single swept strategy have in common.
    pub fn title_of<'a>(&self, strategy: &'a StrategyReport) -> &'a str {
        let swept = self.sweep.as_ref().map(|sweep| sweep.strategies.as_slice());
        let shorter = match swept {
            Some([only]) => strategy.title().strip_prefix(only.as_str()),
            _ => None,
        };
        let shorter = shorter.and_then(|rest| rest.strip_prefix(' '));
        shorter.unwrap_or(strategy.title())
    }
}

impl StrategyReport {
    /// What tables and plots call it: the label, or the name where there is none.
    pub fn title(&self) -> &str {
        if self.label.is_empty() {
            &self.name
        } else {
            &self.label
        }
    }

    /// Time of ideal over its own time: 1 is perfect. None where `ideal` was not measured.
    pub fn efficiency(&self) -> Option<f64> {
        self.time_vs_ideal
            .filter(|ratio| *ratio > 0.0)
            .map(f64::recip)
    }

    /// Whether it is one of the three yardsticks (`none`, `frustum`, `ideal`) that the others are
    /// held against.
    pub fn is_yardstick(&self) -> bool {
        matches!(self.name.as_str(), "none" | "frustum" | "ideal")
    }

    /// Whether it claims to be conservative and yet missed something: a defect of the strategy, to
    /// be said loudly.
    pub fn breaks_its_promise(&self) -> bool {
        self.conservative
            && (self.error.false_culls.entities > 0 || self.error.wrong_pixels_percent.max > 0.0)
    }
}

impl FrameSeries {
    /// Whether no series was recorded.
    pub fn is_empty(&self) -> bool {
        self.frame_ms.is_empty()
            && self.drawn_triangles.is_empty()
            && self.queries.is_empty()
            && self.sync_points.is_empty()
            && self.wrong_pixels_percent.is_empty()
            && self.wrong_pixels_percent_a_view.is_empty()
    }
}
