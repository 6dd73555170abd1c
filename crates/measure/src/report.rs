//! The types of `report.json`: all that a comparison measured. Tables, plots and the page are made from it alone.
//!
//! `docs/report.md` documents each field. A published field keeps its name. Unknown fields, of later versions, are skipped when read. What was
//! not measured is absent, never NaN.

use antumbra_cull::Role;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

mod audit;
mod errors;
mod file;
mod motion;
mod scene_facts;
mod sweep;

pub use audit::{AuditReport, BudgetReport};
pub use errors::{ErrorBasis, ErrorReport, FalseCulls, LostEntities, Ties};
pub use file::MAX_REPORT_BYTES;
pub use motion::MotionFacts;
pub use scene_facts::{MissingParts, SceneFacts, StereoFacts};
pub use sweep::{Aggregate, Choice, ErrorMeasure, LimitChoices, RunnerUp, Sweep, VariedSetting};

/// Smaller ratios of times are never significant, however little noise there was.
const LEAST_RATIO: f64 = 1.005;

/// A comparison: what ran, on what, the noise, and the times and errors of each strategy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The version of Antumbra.
    pub antumbra: String,
    /// The command line that made this report; empty when a library made it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub command: String,
    /// The adapter.
    pub adapter: Adapter,
    /// The scene, the path and the views.
    pub scene: SceneFacts,
    /// The difference between two runs of the same strategy.
    pub noise: Noise,
    /// Free text about the run (driver version, machine, ...), by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub labels: BTreeMap<String, String>,
    /// All random seeds, by what they seed (`scene`, `path`, `rotation`, ...).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub seeds: BTreeMap<String, u64>,
    /// The poses of the path in order; empty when they were not recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<PoseRecord>,
    /// The strategies in the order of the request.
    pub strategies: Vec<StrategyReport>,
    /// What a sweep varied, and its results; absent for other comparisons.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<Sweep>,
}

/// An adapter.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Adapter {
    /// The name that the driver reports.
    pub name: String,
    /// The backend: `vulkan`, `metal`, `dx12`, `gl`, ...
    pub backend: String,
    /// The kind of adapter: `discrete-gpu`, `integrated-gpu`, `cpu`, ...
    #[serde(rename = "type")]
    pub kind: String,
}

/// The difference between two runs of the same strategy.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// The 95th percentile of the block ratios (larger over smaller) of an A/A run: with 1.02, differences below 2 % are not significant.
    /// Absent when there was no A/A run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_time_ratio_p95: Option<f64>,
    /// Poses of a block, for all ratios of times; absent in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block_frames: Option<u64>,
}

/// One pose of the path.
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

/// The times and errors of one strategy.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StrategyReport {
    /// The strategy's registered name.
    pub name: String,
    /// Its name in tables and plots, where the registered name is not enough (the same strategy with other settings); else empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub label: String,
    /// What it is for in the comparison: `everything`, `frustum`, `ideal` or `contender`; absent in reports of earlier versions, where the name says it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<String>,
    /// When query results are used: `frame-late`, `same-frame`, `on-gpu`, or `none` for a strategy without queries.
    pub latency: String,
    /// All of its settings, defaults included.
    pub settings: BTreeMap<String, serde_json::Value>,
    /// Settings of these that follow the image, with their values at this report's size; their value in `settings` is a word.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub follows_image: BTreeMap<String, serde_json::Value>,
    /// Whether it claims to be conservative with these settings: to cull no visible entity.
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
    /// Mean time of the audit's passes in a frame, milliseconds; absent where there was no audit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub audit_ms: Option<f64>,
    /// Frame time over that of `none`, the median of the block ratios: 0.5 means half the time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_none: Option<f64>,
    /// Frame time over that of `frustum`, likewise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_frustum: Option<f64>,
    /// Frame time over that of `ideal`, likewise: its inverse is the efficiency.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_vs_ideal: Option<f64>,
    /// What it drew: means over the frames, all views together.
    pub drawn: Drawn,
    /// Occlusion queries or sample counts: mean over the frames, all views together.
    pub queries: f64,
    /// The same of each eye, left first; empty for a single view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub queries_a_view: Vec<f64>,
    /// Sync points: places where a frame waits for its own results.
    pub sync_points: u32,
    /// The late answers that its frames used; absent for a strategy that used none, and in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub answers: Option<AnswerReport>,
    /// Drawn entities that own no pixel of the reference: mean over the frames, summed over all views.
    pub overdrawn_entities: f64,
    /// Its errors, all views together.
    pub error: ErrorReport,
    /// Its errors by eye, left first; empty or one block for a single view.
    #[serde(default)]
    pub views: Vec<ErrorReport>,
    /// Entities that it never drew where they were visible; absent in old reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<LostEntities>,
    /// The series behind the numbers, with one value for each pose.
    #[serde(default, skip_serializing_if = "FrameSeries::is_empty")]
    pub frames: FrameSeries,
    /// Median times of its passes, in plan order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<PassTime>,
    /// Entities with each verdict, by the verdict's name: mean over the frames, summed over all views.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub verdicts: BTreeMap<String, f64>,
    /// Whether a self-audit was requested for it; false in old reports.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub audited: bool,
    /// Its own estimate of its wrong pixels; absent where there was no audit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub audit: Option<AuditReport>,
    /// The budget that it had in place of settings; absent where there was none. With a budget, `settings` are those of the last frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget: Option<BudgetReport>,
    /// The frame with the most wrong pixels, with its pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<WorstFrame>,
}

/// The median and the 95th percentile of a series.
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

/// What was drawn: means over the frames.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Entities.
    pub entities: f64,
    /// Triangles.
    pub triangles: f64,
}

/// The answers of earlier frames that a strategy's nodes used. An audit's own answers are none of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AnswerReport {
    /// Age of the youngest in frames: 1 is the last frame.
    pub youngest: u64,
    /// Age of the oldest.
    pub oldest: u64,
    /// Answers that were never read back since there was no memory for them, over the whole path.
    pub skipped: u64,
}

/// Series with one value for each pose, in path order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameSeries {
    /// Serialised frame time in milliseconds, the median of the repetitions of that pose.
    #[serde(default)]
    pub frame_ms: Vec<f64>,
    /// Triangles drawn, all views together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drawn_triangles: Vec<u64>,
    /// Queries, all views together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub queries: Vec<u64>,
    /// Sync points at which the frame waited.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sync_points: Vec<u32>,
    /// Age in frames of the oldest late answer that the frame was given; 0 where it was given none. Empty for a strategy without late answers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub answer_age: Vec<u64>,
    /// Wrong pixels in percent of the pixels of all views.
    #[serde(default)]
    pub wrong_pixels_percent: Vec<f64>,
    /// Wrong pixels in percent of an eye's pixels: a series for each eye, left first; empty for a single view.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_pixels_percent_a_view: Vec<Vec<f64>>,
    /// Wrong pixels in percent of the pixels that entities own, of all views; empty in old reports.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wrong_of_owned_percent: Vec<f64>,
}

/// Median times of one pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassTime {
    /// The pass's name in the plan.
    pub name: String,
    /// Its timing group: `cull`, `draw`, or another.
    pub group: String,
    /// CPU time of recording or running it, milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_ms: Option<f64>,
    /// GPU time from timestamps, milliseconds; absent where the device has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gpu_ms: Option<f64>,
}

/// The frame with the most wrong pixels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorstFrame {
    /// The pose; the first is 0.
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
    /// What the strategy drew in grey, with the wrong pixels in magenta.
    pub marked: String,
}

impl Noise {
    /// The ratio of times above which a difference in speed is significant: that of the A/A run, and at least half a percent.
    pub fn least_ratio(&self) -> f64 {
        self.frame_time_ratio_p95.unwrap_or(1.0).max(LEAST_RATIO)
    }
}

impl Report {
    /// The first strategy registered under `name`.
    pub fn strategy(&self, name: &str) -> Option<&StrategyReport> {
        self.strategies.iter().find(|s| s.name == name)
    }

    /// The yardstick of this role, where it was measured.
    pub fn yardstick(&self, role: Role) -> Option<&StrategyReport> {
        self.strategies.iter().find(|s| s.role() == role)
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

    /// A strategy's name in the tables and plots of this report: its title, without the part that all settings of a single swept strategy
    /// share.
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
    /// The label, or the name where there is none.
    pub fn title(&self) -> &str {
        if self.label.is_empty() {
            &self.name
        } else {
            &self.label
        }
    }

    /// The sum of the passes' GPU times, milliseconds, where it exceeds the serialised frame by more than a tenth, as a sum of medians may: passes overlap on this GPU, as they do on tiled ones, and each time says how long its pass was
    /// under way and not what it costs.
    pub fn overlapping_passes_ms(&self) -> Option<f64> {
        let sum: f64 = self.passes.iter().filter_map(|pass| pass.gpu_ms).sum();
        (sum > 1.1 * self.frame_ms.median).then_some(sum)
    }

    /// Time of `ideal` over its own time: 1 is perfect. `None` where `ideal` was not measured.
    pub fn efficiency(&self) -> Option<f64> {
        self.time_vs_ideal
            .filter(|ratio| *ratio > 0.0)
            .map(f64::recip)
    }

    /// Whether it is one of the three yardsticks (`none`, `frustum`, `ideal`) with which the others are compared.
    pub fn is_yardstick(&self) -> bool {
        self.role().is_yardstick()
    }

    /// What it is for in the comparison.
    pub fn role(&self) -> Role {
        // Reports of earlier versions have names alone, and there the yardsticks were the built-in ones.
        let word = self.role.as_deref().unwrap_or(match self.name.as_str() {
            "none" => "everything",
            name => name,
        });
        let mut all = Role::ALL.into_iter();
        all.find(|role| role.word() == word)
            .unwrap_or(Role::Contender)
    }

    /// Whether it claims to be conservative and has an error: a defect of the strategy. To cull an entity that ties is one, since ties count as visible.
    pub fn breaks_its_promise(&self) -> bool {
        self.conservative
            && (self.error.false_culls.entities > 0
                || self.error.wrong_pixels_percent.max > 0.0
                || self.error.culls_ties())
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
            && self.wrong_of_owned_percent.is_empty()
    }
}
