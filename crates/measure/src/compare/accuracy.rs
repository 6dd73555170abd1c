//! Accuracy: compares every view of every pose with the reference.
//!
//! A strategy's visible set is drawn in the reference's order, so wrong pixels come only from missing entities and from entities drawn at a
//! coarser level. A set that contains every owner of a sample at full detail therefore has no wrong pixel, and is not drawn again. FLIP compares the shaded images
//! themselves: entities at equal depth may be shown in another order although no pixel is wrong.

use std::sync::Arc;
use std::time::Instant;

use antumbra_cull::{
    AUDIT, FrustumOnly, MeshDetail, ResidentScene, Stage, StageOptions, Verdicts, ViewInput,
    ViewSpec, read_back,
};
use antumbra_draw::GpuScene;
use antumbra_graph::FrameReport;
use antumbra_scene::Camera;
use antumbra_verify::{Differences, EntitySet, IdBuffer, Oracle};
use image::RgbaImage;

use super::audited::Audited;
use super::fates::{Fates, SeenEntity};
use super::script::{PosedScene, ScriptedScene};
use super::{CompareOptions, CompareProgress};
use crate::MeasureError;
use crate::image_error::flip;
use crate::report::{AnswerReport, AuditReport, MeanMax};

/// The errors of all strategies.
pub struct Accuracy {
    /// By contender.
    pub records: Vec<Record>,
    /// By pose.
    pub owners: Vec<Owners>,
    /// By pose, by view: the pixels that entities own.
    pub owned_pixels: Vec<Vec<u64>>,
}

impl Accuracy {
    /// The pixels that entities own, in percent of all pixels of views of this size; `None` without poses.
    pub fn owned_percent(&self, [width, height]: [u32; 2]) -> Option<f64> {
        let views = self.owned_pixels.iter().map(Vec::len).sum::<usize>();
        let pixels = views as f64 * f64::from(width) * f64::from(height);
        let owned = self.owned_pixels.iter().flatten().sum::<u64>();
        (pixels > 0.0).then(|| 100.0 * owned as f64 / pixels)
    }
}

/// By view: the slots that own a sample.
pub type Owners = Vec<Arc<Vec<u32>>>;

/// The errors of one strategy and what it drew: sums over all poses and views.
#[derive(Default)]
pub struct Record {
    pub views: Vec<ViewRecord>,
    pub drawn: u64,
    pub triangles: u64,
    pub overdrawn: u64,
    /// Entities by verdict.
    pub tally: [u64; 6],
    /// The most of any pose.
    pub sync_points: u32,
    /// The late answers of all poses.
    pub answers: Option<AnswerReport>,
    /// By pose.
    pub poses: Vec<PoseCounts>,
    /// Its audits and budget.
    pub audited: Audited,
    /// The audits' part of the report.
    pub audit: Option<AuditReport>,
    /// Which entities it drew where they were visible.
    pub fates: Fates,
}

/// Counts of one pose, all views together.
pub struct PoseCounts {
    pub triangles: u64,
    pub queries: u64,
    pub sync_points: u32,
    /// Age of the oldest late answer in frames; 0: there was none.
    pub answer_age: u64,
}

/// The errors of one strategy in one view, with one value for each pose, and its queries.
#[derive(Default)]
pub struct ViewRecord {
    pub wrong_percent: Vec<f64>,
    pub wrong: Vec<u64>,
    pub false_culls: Vec<u64>,
    /// Pixels that show another entity of equal depth, since their owner was culled.
    pub tie_percent: Vec<f64>,
    /// Culled entities that lost only such pixels, summed over the poses.
    pub tied_culls: u64,
    /// Pixels that have another colour although their owner was drawn.
    pub shown: MeanMax,
    pub queries: u64,
    pub flip: MeanMax,
    pub worst: Option<Worst>,
    /// By pose at which FLIP is computed.
    flips: Vec<f64>,
    shown_percent: Vec<f64>,
}

/// The frame with the most wrong pixels.
pub struct Worst {
    pub frame: usize,
    pub wrong: usize,
    pub reference: RgbaImage,
    pub strategy: RgbaImage,
    pub mask: Vec<bool>,
}

/// The reference of one view of a pose.
struct ReferenceView {
    camera: Camera,
    ids: IdBuffer,
    owners: Arc<Vec<u32>>,
    seen: Vec<SeenEntity>,
    /// The shaded image, drawn when it is first compared.
    colour: Option<RgbaImage>,
}

/// The pose that is compared.
#[derive(Clone, Copy)]
struct ComparedPose {
    frame: usize,
    /// Whether FLIP is computed at this pose.
    sampled: bool,
}

/// Runs all stages along the path and compares their frames with the reference.
pub fn measure(
    scripted: &mut ScriptedScene<'_>,
    stages: &mut [Stage],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Accuracy, MeasureError> {
    let path = scripted.path;
    let mut comparer = Comparer::new(scripted.scene(), options)?;
    let mut records: Vec<Record> = stages.iter().map(|_| Record::default()).collect();
    let mut owners = Vec::with_capacity(path.poses().len());
    let mut owned_pixels = Vec::with_capacity(path.poses().len());
    let total = path.poses().len() as u64;
    let every = path
        .poses()
        .len()
        .div_ceil(options.flip_poses.max(1))
        .max(1);
    for (frame, pose) in path.poses().iter().enumerate() {
        progress(CompareProgress {
            phase: "accuracy",
            done: frame as u64,
            total,
        });
        let at = ComparedPose {
            frame,
            sampled: frame.is_multiple_of(every),
        };
        let PosedScene { scene, cameras } = scripted.at(frame)?;
        let mut references = cameras
            .into_iter()
            .map(|camera| comparer.reference(scene, camera))
            .collect::<Result<Vec<_>, _>>()?;
        for (stage, record) in stages.iter_mut().zip(&mut records) {
            let inputs: Vec<ViewInput<'_>> = references
                .iter()
                .map(|reference| ViewInput {
                    cut: pose.cut || frame == 0,
                    reference: Some(Arc::clone(&reference.owners)),
                    ..ViewInput::new(reference.camera)
                })
                .collect();
            let start = Instant::now();
            let report = stage.frame(scene, &inputs)?;
            scene.gpu().wait()?;
            stage.note_time(start.elapsed().as_secs_f64() * 1e3);
            record.sync_points = record.sync_points.max(report.plan.sync_points);
            record
                .views
                .resize_with(references.len(), ViewRecord::default);
            let (triangles, queries) = (record.triangles, record.queries());
            for (view, reference) in references.iter_mut().enumerate() {
                comparer.compare(scene, stage, view, reference, at, record)?;
            }
            let Record { views, audited, .. } = record;
            let truth = |view: usize, frame: usize| {
                let view: &ViewRecord = views.get(view)?;
                view.wrong_percent.get(frame).copied()
            };
            audited.take(stage, references.len(), truth);
            let answer_age = record.note_answers(stage, &report.plan);
            record.poses.push(PoseCounts {
                triangles: record.triangles - triangles,
                queries: record.queries() - queries,
                sync_points: report.plan.sync_points,
                answer_age,
            });
        }
        let owned = |reference: &ReferenceView| reference.ids.owned_pixels() as u64;
        owned_pixels.push(references.iter().map(owned).collect());
        let of_views = references.into_iter().map(|reference| reference.owners);
        owners.push(of_views.collect());
    }
    for (record, stage) in records.iter_mut().zip(&*stages) {
        record.audit = record.audited.report(stage, record.views.len());
        for view in &mut record.views {
            view.finish()?;
        }
    }
    Ok(Accuracy {
        records,
        owners,
        owned_pixels,
    })
}

/// Draws references and compares frames with them.
struct Comparer {
    oracle: Oracle,
    /// Draws the reference's shaded image, one view at a time.
    painter: Stage,
    size: [u32; 2],
}

impl Comparer {
    fn new(scene: &GpuScene, options: &CompareOptions) -> Result<Self, MeasureError> {
        let CompareOptions { size, samples, .. } = *options;
        let [width, height] = size;
        let views = vec![ViewSpec::main(width, height)];
        let painted = StageOptions {
            samples,
            ..StageOptions::default()
        };
        Ok(Self {
            oracle: Oracle::new(scene, size).with_samples(samples),
            painter: Stage::new(scene, Box::new(FrustumOnly), views, painted)?,
            size,
        })
    }

    fn reference(
        &mut self,
        scene: &GpuScene,
        camera: Camera,
    ) -> Result<ReferenceView, MeasureError> {
        let ids = self.oracle.render(scene, &camera, EntitySet::InFrustum)?;
        Ok(ReferenceView {
            camera,
            owners: Arc::new(ids.owners()),
            seen: SeenEntity::all(scene.table(), &ids),
            ids,
            colour: None,
        })
    }

    /// Compares one view of a stage's last frame with the reference.
    fn compare(
        &mut self,
        scene: &GpuScene,
        stage: &Stage,
        view: usize,
        reference: &mut ReferenceView,
        ComparedPose { frame, sampled }: ComparedPose,
        record: &mut Record,
    ) -> Result<(), MeasureError> {
        let verdicts = stage.verdicts(view, scene)?;
        let drawn: Vec<u32> = verdicts.drawn().collect();
        let found = self
            .oracle
            .differences(scene, &reference.camera, &reference.ids, &verdicts)?;
        let owners_drawn = reference.owners.len() - found.undrawn.len();
        record.count(scene, &drawn, &verdicts, owners_drawn);
        record.fates.note(&reference.seen, &found);
        let Some(record) = record.views.get_mut(view) else {
            return Ok(());
        };
        record.queries += u64::from(verdicts.tested());
        let wrong = found.wrong_pixels();
        record.wrong.push(wrong as u64);
        record.wrong_percent.push(self.percent(wrong));
        record.false_culls.push(found.false_culls() as u64);
        record.tie_percent.push(self.percent(found.tie_pixels()));
        record.tied_culls += found.tied.len() as u64;
        let worse = wrong > record.worst.as_ref().map_or(0, |worst| worst.wrong);
        if !sampled && !worse {
            return Ok(());
        }
        let painted = reference.colour.take();
        let painted = painted.map_or_else(|| self.paint(scene, reference.camera), Ok)?;
        let painted = reference.colour.insert(painted);
        let strategy = picture(stage, view, scene, self.size)?;
        if sampled {
            record.flips.push(flip(painted, &strategy)?.mean);
            // A coarser level shows other colours of its own.
            let shown = match verdicts.levels() {
                1 => shown_otherwise(&reference.ids, &found, painted, &strategy),
                _ => 0,
            };
            record.shown_percent.push(self.percent(shown));
        }
        if worse {
            record.worst = Some(Worst {
                frame,
                wrong,
                reference: painted.clone(),
                strategy,
                mask: found.wrong,
            });
        }
        Ok(())
    }

    /// A number of pixels in percent of a view's.
    fn percent(&self, pixels: usize) -> f64 {
        let [width, height] = self.size.map(f64::from);
        100.0 * pixels as f64 / (width * height).max(1.0)
    }

    fn paint(&mut self, scene: &GpuScene, camera: Camera) -> Result<RgbaImage, MeasureError> {
        self.painter.frame(scene, &[ViewInput::new(camera)])?;
        picture(&self.painter, 0, scene, self.size)
    }
}

/// The number of pixels whose colour differs although their owner was drawn: entities of equal depth, shown in another order. Pixels behind a transparent
/// entity are left out; their colours blend.
fn shown_otherwise(
    ids: &IdBuffer,
    found: &Differences,
    reference: &RgbaImage,
    strategy: &RgbaImage,
) -> usize {
    let marked = |mask: &[bool], pixel: usize| mask.get(pixel).copied().unwrap_or(false);
    let pairs = reference.pixels().zip(strategy.pixels()).enumerate();
    let differing = pairs.filter(|(_, (was, is))| was != is);
    differing
        .filter(|(pixel, _)| !marked(&found.wrong, *pixel) && !marked(&found.tie, *pixel))
        .filter(|(pixel, _)| ids.signature(*pixel) == 0)
        .count()
}

fn picture(
    stage: &Stage,
    view: usize,
    scene: &GpuScene,
    [width, height]: [u32; 2],
) -> Result<RgbaImage, MeasureError> {
    let gone = || MeasureError::SizeMismatch {
        what: "colour target",
        got: "none".to_owned(),
        expected: format!("{width} x {height}"),
    };
    let texture = stage.colour(view).ok_or_else(gone)?;
    let texels = read_back::texture(scene.gpu(), texture)?;
    RgbaImage::from_raw(width, height, texels).ok_or_else(gone)
}

impl Record {
    /// Queries so far, in all views.
    pub fn queries(&self) -> u64 {
        self.views.iter().map(|view| view.queries).sum()
    }

    /// Notes the late answers that a strategy's nodes were given in a frame, and returns the age of the oldest; 0 without any.
    fn note_answers(&mut self, stage: &Stage, frame: &FrameReport) -> u64 {
        let passes = stage.plan().passes();
        let of_strategy = |node: &str| {
            let pass = passes.iter().find(|pass| pass.name == node);
            node != ResidentScene::UPLOAD && pass.is_some_and(|pass| pass.group != Some(AUDIT))
        };
        let late = frame.late.iter().filter(|late| of_strategy(&late.node));
        let mut oldest = 0;
        for late in late {
            oldest = oldest.max(late.age);
            let all = self.answers.get_or_insert(AnswerReport {
                youngest: late.age,
                ..AnswerReport::default()
            });
            all.youngest = all.youngest.min(late.age);
            all.oldest = all.oldest.max(late.age);
        }
        if let Some(all) = &mut self.answers {
            all.skipped += u64::from(frame.skipped_read_backs);
        }
        oldest
    }

    fn count(&mut self, scene: &GpuScene, drawn: &[u32], verdicts: &Verdicts, owners_drawn: usize) {
        let table = scene.table();
        self.drawn += drawn.len() as u64;
        self.triangles += drawn
            .iter()
            .map(|slot| {
                let detail = MeshDetail::Level(verdicts.level(*slot));
                u64::from(table.primitives_of(*slot, detail))
            })
            .sum::<u64>();
        self.overdrawn += (drawn.len() - owners_drawn) as u64;
        for (sum, count) in self.tally.iter_mut().zip(verdicts.tally()) {
            *sum += u64::from(count);
        }
    }
}

impl ViewRecord {
    fn finish(&mut self) -> Result<(), MeasureError> {
        self.shown = mean_max(&self.shown_percent);
        self.flip = mean_max(&self.flips);
        if let Some(worst) = &self.worst {
            let max = flip(&worst.reference, &worst.strategy)?.mean;
            self.flip.max = self.flip.max.max(max);
        }
        Ok(())
    }
}

/// Of an empty series both are 0.
fn mean_max(series: &[f64]) -> MeanMax {
    MeanMax {
        mean: series.iter().sum::<f64>() / series.len().max(1) as f64,
        max: series.iter().copied().fold(0.0, f64::max),
    }
}
