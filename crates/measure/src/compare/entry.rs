//! Makes a strategy's entry in the report from its measurements.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use antumbra_cull::{Budget, Role, Stage, Value, Verdict};
use antumbra_scene::Scene;
use image::RgbaImage;

use super::Contender;
use super::accuracy::{Accuracy, Record};
use super::errors::ImageErrors;
use super::speed::Speed;
use crate::MeasureError;
use crate::report::{Drawn, FrameSeries, Spread, StrategyReport, WorstFrame, WorstImages};
use crate::stats;

/// The measurements of all contenders.
pub struct Entries<'a> {
    pub accuracy: &'a Accuracy,
    pub speed: &'a Speed,
    pub contenders: &'a [Contender],
    pub scene: &'a Scene,
    /// Width and height of a view in pixels.
    pub size: [u32; 2],
}

/// The entries of a report and the pictures that they name.
pub struct ReportedEntries {
    pub strategies: Vec<StrategyReport>,
    pub pictures: Pictures,
}

/// Pictures by file name.
type Pictures = BTreeMap<String, RgbaImage>;

impl Entries<'_> {
    /// The entries of all contenders, with the pictures that they name.
    pub fn reports(&self, stages: &[Stage]) -> Result<ReportedEntries, MeasureError> {
        let mut pictures = Pictures::new();
        let strategies = self.contenders.iter().zip(stages).enumerate();
        let strategies = strategies
            .map(|(at, (contender, stage))| self.report(at, contender, stage, &mut pictures))
            .collect::<Result<_, _>>()?;
        Ok(ReportedEntries {
            strategies,
            pictures,
        })
    }

    fn report(
        &self,
        at: usize,
        contender: &Contender,
        stage: &Stage,
        pictures: &mut Pictures,
    ) -> Result<StrategyReport, MeasureError> {
        let strategy = stage.strategy();
        let (record, run) = (&self.accuracy.records[at], &self.speed.runs[at]);
        let settings = strategy
            .settings()
            .into_iter()
            .map(|setting| (setting.key.to_owned(), value(&setting.value)))
            .collect();
        let following = strategy.following(self.size).into_iter();
        let poses = self.accuracy.owners.len();
        let mean = |sum: u64| sum as f64 / poses.max(1) as f64;
        let title = match contender.label.as_str() {
            "" => strategy.name(),
            label => label,
        };
        let owned = &self.accuracy.owned_pixels;
        let of_views = ImageErrors::of_views(record, owned);
        let all = ImageErrors::together(&of_views, poses);
        let error = all.report()?;
        let of_views = of_views.iter().map(ImageErrors::report);
        let views = of_views.collect::<Result<Vec<_>, _>>()?;
        // Left out for a single view, which it would only repeat.
        let eyes = match record.views.as_slice() {
            [_] => &[],
            eyes => eyes,
        };
        let verdicts = Verdict::ALL
            .iter()
            .zip(record.tally)
            .map(|(verdict, sum)| (verdict.word().to_owned(), mean(sum)))
            .collect();
        Ok(StrategyReport {
            name: strategy.name().to_owned(),
            label: contender.label.clone(),
            role: Some(strategy.role().word().to_owned()),
            latency: strategy
                .latency()
                .map_or_else(|| "none".to_owned(), |latency| latency.to_string()),
            settings,
            follows_image: following
                .map(|(key, found)| (key.to_owned(), value(&found)))
                .collect(),
            conservative: match contender.budget {
                None | Some(Budget::WrongPixels(0.0)) => strategy.conservative(),
                // Its settings are those of the last frame. Earlier frames may have used others.
                Some(_) => false,
            },
            frame_ms: Spread {
                median: stats::median(&run.frame_ms)?,
                p95: stats::percentile(&run.frame_ms, 95.0)?,
            },
            free_running_ms: run.free_running_ms,
            cull_ms: run.group_median("cull"),
            draw_ms: run.group_median("draw"),
            audit_ms: run.group_mean(antumbra_cull::AUDIT),
            time_vs_none: self.against(at, Role::Everything)?,
            time_vs_frustum: self.against(at, Role::Frustum)?,
            time_vs_ideal: self.against(at, Role::Ideal)?,
            drawn: Drawn {
                entities: mean(record.drawn),
                triangles: mean(record.triangles),
            },
            queries: mean(record.queries()),
            queries_a_view: eyes.iter().map(|view| mean(view.queries)).collect(),
            sync_points: record.sync_points,
            answers: record.answers,
            overdrawn_entities: mean(record.overdrawn),
            error,
            views,
            lost: Some(record.fates.lost(self.scene)),
            frames: FrameSeries {
                frame_ms: run.by_pose(poses)?,
                drawn_triangles: record.poses.iter().map(|pose| pose.triangles).collect(),
                queries: record.poses.iter().map(|pose| pose.queries).collect(),
                sync_points: record.poses.iter().map(|pose| pose.sync_points).collect(),
                answer_age: match record.answers {
                    Some(_) => record.poses.iter().map(|pose| pose.answer_age).collect(),
                    None => Vec::new(),
                },
                wrong_of_owned_percent: all.wrong_of_owned_percent(),
                wrong_pixels_percent: all.wrong_percent,
                wrong_pixels_percent_a_view: eyes
                    .iter()
                    .map(|view| view.wrong_percent.clone())
                    .collect(),
            },
            passes: run.pass_medians(),
            verdicts,
            audited: contender.audit.is_some(),
            audit: record.audit.clone(),
            budget: record.audited.budget_report(contender.budget, &error),
            worst: worst(record, &file_base(title, at), pictures)?,
        })
    }

    /// A contender's time over that of a yardstick; `None` where the yardstick did not run.
    fn against(&self, at: usize, yardstick: Role) -> Result<Option<f64>, MeasureError> {
        let mut contenders = self.contenders.iter();
        let Some(other) = contenders.position(|other| other.role == yardstick) else {
            return Ok(None);
        };
        let (run, other) = (&self.speed.runs[at], &self.speed.runs[other]);
        let ratios = stats::block_ratios(&run.frame_ms, &other.frame_ms, self.speed.block)?;
        Ok(Some(stats::median(&ratios)?))
    }
}

/// The frame and the view with the most wrong pixels. Adds its pictures to `pictures`.
fn worst(
    record: &Record,
    base: &str,
    pictures: &mut Pictures,
) -> Result<Option<WorstFrame>, MeasureError> {
    let views = record.views.iter().zip(0u32..);
    let all = views.filter_map(|(record, view)| Some((record.worst.as_ref()?, view)));
    // In a tie, the left eye's.
    let most = all.max_by_key(|(worst, view)| (worst.wrong, Reverse(*view)));
    let Some((worst, view)) = most else {
        return Ok(None);
    };
    let [reference, strategy, marked] = PICTURES.map(|what| format!("{base}-{what}.png"));
    let images = WorstImages {
        reference,
        strategy,
        marked,
    };
    let marked = crate::image_error::mark_wrong(&worst.strategy, &worst.mask)?;
    pictures.insert(images.reference.clone(), worst.reference.clone());
    pictures.insert(images.strategy.clone(), worst.strategy.clone());
    pictures.insert(images.marked.clone(), marked);
    Ok(Some(WorstFrame {
        frame: worst.frame as u64,
        view,
        images,
    }))
}

/// A setting's value as JSON: a number if it is one, else a string.
fn value(value: &Value) -> serde_json::Value {
    let text = value.to_string();
    serde_json::from_str(&text)
        .ok()
        .filter(serde_json::Value::is_number)
        .unwrap_or_else(|| text.into())
}

/// The last parts of the names of a worst frame's pictures, after the base from [`file_base`].
const PICTURES: [&str; 3] = ["reference", "worst", "marked"];

/// Whether [`Comparison::save`](super::Comparison::save) may write a file of this name.
pub fn is_report_file(name: &str) -> bool {
    if ["report.json", "report.html", "trade.svg"].contains(&name) {
        return true;
    }
    let picture = name
        .strip_suffix(".png")
        .and_then(|name| name.rsplit_once('-'));
    picture.is_some_and(|(base, what)| {
        let number = base.split('-').next().unwrap_or_default();
        let numbered = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        let plain = base.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-');
        PICTURES.contains(&what) && numbered && plain
    })
}

/// The first part of a file name, valid on any file system.
fn file_base(title: &str, at: usize) -> String {
    let plain: String = title
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
        .collect();
    format!("{at}-{plain}")
}
