//! Accuracy: compares every view of every pose with the reference.
//!
//! A strategy's visible set is drawn in the reference's order, so differences come only from missing entities and from entities drawn at a
//! coarser level. A set that contains every owner of a sample at full detail therefore has no wrong pixel, and is not drawn again.

use std::sync::Arc;
use std::time::Instant;

use antumbra_cull::{
    FrustumOnly, MeshDetail, Stage, StageOptions, Verdicts, ViewInput, ViewSpec, read_back,
};
use antumbra_draw::GpuScene;
use antumbra_scene::Camera;
use antumbra_verify::{EntitySet, IdBuffer, Oracle};
use image::RgbaImage;

use super::audited::Audited;
use super::script::{PosedScene, ScriptedScene};
use super::{CompareOptions, CompareProgress};
use crate::MeasureError;
use crate::image_error::flip;
use crate::report::{AuditReport, MeanMax};

/// The errors of all strategies.
pub struct Accuracy {
    /// By contender.
    pub records: Vec<Record>,
    /// By pose.
    pub owners: Vec<Owners>,
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
    /// By pose.
    pub poses: Vec<PoseCounts>,
    /// Its audits and budget.
    pub audited: Audited,
    /// The audits' part of the report.
    pub audit: Option<AuditReport>,
}

/// Counts of one pose, all views together.
pub struct PoseCounts {
    pub triangles: u64,
    pub queries: u64,
    pub sync_points: u32,
}

/// The errors of one strategy in one view, with one value for each pose, and its queries.
#[derive(Default)]
pub struct ViewRecord {
    pub wrong_percent: Vec<f64>,
    pub false_culls: Vec<u64>,
    pub queries: u64,
    pub flip: MeanMax,
    pub worst: Option<Worst>,
    flips: Vec<f64>,
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
    /// The shaded image, drawn when the first strategy has a wrong pixel.
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
            record.poses.push(PoseCounts {
                triangles: record.triangles - triangles,
                queries: record.queries() - queries,
                sync_points: report.plan.sync_points,
            });
        }
        let of_views = references.into_iter().map(|reference| reference.owners);
        owners.push(of_views.collect());
    }
    for (record, stage) in records.iter_mut().zip(&*stages) {
        record.audit = record.audited.report(stage, record.views.len());
        for view in &mut record.views {
            view.finish()?;
        }
    }
    Ok(Accuracy { records, owners })
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
        let missing = missing(&reference.owners, &drawn);
        let owners_drawn = reference.owners.len() - missing;
        record.count(scene, &drawn, &verdicts, owners_drawn);
        let Some(record) = record.views.get_mut(view) else {
            return Ok(());
        };
        record.queries += u64::from(verdicts.tested());
        record.false_culls.push(missing as u64);
        let wrong = match missing {
            0 if verdicts.levels() == 1 => None,
            _ => {
                let drawn = EntitySet::Drawn(&verdicts);
                let seen = self.oracle.render(scene, &reference.camera, drawn)?;
                Some(reference.ids.wrong_pixel_mask(&seen))
            }
        };
        let count = wrong.iter().flatten().filter(|wrong| **wrong).count();
        let [width, height] = self.size;
        let pixels = f64::from(width * height).max(1.0);
        record.wrong_percent.push(100.0 * count as f64 / pixels);
        let worse = count > record.worst.as_ref().map_or(0, |worst| worst.wrong);
        if let Some(mask) = wrong.filter(|_| count > 0 && (sampled || worse)) {
            let painted = reference.colour.take();
            let painted = painted.map_or_else(|| self.paint(scene, reference.camera), Ok)?;
            let reference = reference.colour.insert(painted);
            let strategy = picture(stage, view, scene, self.size)?;
            if sampled {
                record.flips.push(flip(reference, &strategy)?.mean);
            }
            if worse {
                record.worst = Some(Worst {
                    frame,
                    wrong: count,
                    reference: reference.clone(),
                    strategy,
                    mask,
                });
            }
        } else if sampled {
            // All owners are drawn, so the images are equal.
            record.flips.push(0.0);
        }
        Ok(())
    }

    fn paint(&mut self, scene: &GpuScene, camera: Camera) -> Result<RgbaImage, MeasureError> {
        self.painter.frame(scene, &[ViewInput::new(camera)])?;
        picture(&self.painter, 0, scene, self.size)
    }
}

/// The number of owners that were not drawn. Both lists ascend.
fn missing(owners: &[u32], drawn: &[u32]) -> usize {
    owners
        .iter()
        .filter(|slot| drawn.binary_search(slot).is_err())
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
        let count = self.flips.len().max(1) as f64;
        let mean = self.flips.iter().sum::<f64>() / count;
        let mut max = self.flips.iter().copied().fold(0.0, f64::max);
        if let Some(worst) = &self.worst {
            max = max.max(flip(&worst.reference, &worst.strategy)?.mean);
        }
        self.flip = MeanMax { mean, max };
        Ok(())
    }
}
