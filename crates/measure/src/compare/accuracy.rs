//! Accuracy: every pose against the reference, all strategies in step, view by view.
//!
//! A strategy's visible set is drawn in the reference's own order, so that what differs are missing
//! entities, entities drawn coarser, and nothing else; a set that holds every owner of a pixel in full
//! therefore has no wrong pixel, and is not drawn again.

use std::sync::Arc;
use std::time::Instant;

use antumbra_cull::Frustum;
use antumbra_cull::{Stage, StageOptions, Verdicts, ViewInput, ViewSpec};
use antumbra_draw::{GpuScene, MeshDetail, read_back};
use antumbra_scene::Camera;
use antumbra_verify::{EntitySet, IdBuffer, Oracle};
use image::RgbaImage;

use super::audited::Audited;
use super::script::Set;
use super::{CompareOptions, CompareProgress};
use crate::MeasureError;
use crate::image_error::flip;
use crate::report::{AuditReport, MeanMax};

/// What all strategies got wrong.
pub struct Accuracy {
    /// One a contender.
    pub records: Vec<Record>,
    /// One a pose.
    pub owners: Vec<Owners>,
}

/// The slots that own a pixel, a view.
pub type Owners = Vec<Arc<Vec<u32>>>;

/// What one strategy got wrong, and what it drew: sums over all poses and views.
#[derive(Default)]
pub struct Record {
    pub views: Vec<ViewRecord>,
    pub drawn: u64,
    pub triangles: u64,
    pub overdrawn: u64,
    pub tally: [u64; 6],
    /// The most of any pose.
    pub sync_points: u32,
    /// One a pose.
    pub poses: Vec<PoseCounts>,
    /// What it said of itself.
    pub audited: Audited,
    /// The same, for the report.
    pub audit: Option<AuditReport>,
}

/// What one pose took, all views together.
pub struct PoseCounts {
    pub triangles: u64,
    pub asked: u64,
    pub sync_points: u32,
}

/// What it got wrong in one view, a value a pose, and what it asked.
#[derive(Default)]
pub struct ViewRecord {
    pub wrong_percent: Vec<f64>,
    pub false_culls: Vec<u64>,
    pub asked: u64,
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

/// One view of a pose as it should be.
struct Look {
    camera: Camera,
    reference: IdBuffer,
    owners: Arc<Vec<u32>>,
    /// Drawn when the first strategy gets something wrong.
    colour: Option<RgbaImage>,
}

/// Where a judgement stands: the pose, and whether its FLIP is wanted.
#[derive(Clone, Copy)]
struct At {
    frame: usize,
    sampled: bool,
}

pub fn measure(
    set: &mut Set<'_>,
    stages: &mut [Stage],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Accuracy, MeasureError> {
    let path = set.path;
    let mut judge = Judge::new(set.scene(), options.size)?;
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
        let at = At {
            frame,
            sampled: frame.is_multiple_of(every),
        };
        let (scene, cameras) = set.at(frame)?;
        let mut looks = cameras
            .into_iter()
            .map(|camera| judge.look(scene, camera))
            .collect::<Result<Vec<_>, _>>()?;
        for (stage, record) in stages.iter_mut().zip(&mut records) {
            let inputs: Vec<ViewInput<'_>> = looks
                .iter()
                .map(|look| ViewInput {
                    cut: pose.cut || frame == 0,
                    reference: Some(Arc::clone(&look.owners)),
                    ..ViewInput::new(look.camera)
                })
                .collect();
            let start = Instant::now();
            let report = stage.frame(scene, &inputs)?;
            scene.gpu().wait()?;
            stage.note_time(start.elapsed().as_secs_f64() * 1e3);
            record.sync_points = record.sync_points.max(report.sync_points);
            record.views.resize_with(looks.len(), ViewRecord::default);
            let before = (record.triangles, record.asked());
            for (view, look) in looks.iter_mut().enumerate() {
                judge.judge(scene, stage, view, look, at, record)?;
            }
            let Record { views, audited, .. } = record;
            let truth = |view: usize, frame: usize| {
                let view: &ViewRecord = views.get(view)?;
                view.wrong_percent.get(frame).copied()
            };
            audited.take(stage, looks.len(), truth);
            record.poses.push(PoseCounts {
                triangles: record.triangles - before.0,
                asked: record.asked() - before.1,
                sync_points: report.sync_points,
            });
        }
        owners.push(looks.into_iter().map(|look| look.owners).collect());
    }
    for (record, stage) in records.iter_mut().zip(&*stages) {
        record.audit = record.audited.report(stage, record.views.len());
        for view in &mut record.views {
            view.finish()?;
        }
    }
    Ok(Accuracy { records, owners })
}

/// Draws what should have been drawn, and counts what was not.
struct Judge {
    oracle: Oracle,
    /// Draws the reference's picture, one view at a time.
    painter: Stage,
    size: [u32; 2],
}

impl Judge {
    fn new(scene: &GpuScene, size: [u32; 2]) -> Result<Self, MeasureError> {
        let [width, height] = size;
        let views = vec![ViewSpec::main(width, height)];
        Ok(Self {
            oracle: Oracle::new(scene, size),
            painter: Stage::new(scene, Box::new(Frustum), views, StageOptions::default())?,
            size,
        })
    }

    fn look(&mut self, scene: &GpuScene, camera: Camera) -> Result<Look, MeasureError> {
        let reference = self.oracle.render(scene, &camera, EntitySet::InFrustum)?;
        Ok(Look {
            camera,
            owners: Arc::new(reference.owners()),
            reference,
            colour: None,
        })
    }

    /// Holds a stage's last frame against the reference, in one of its views.
    fn judge(
        &mut self,
        scene: &GpuScene,
        stage: &Stage,
        view: usize,
        look: &mut Look,
        At { frame, sampled }: At,
        record: &mut Record,
    ) -> Result<(), MeasureError> {
        let verdicts = stage.verdicts(view, scene)?;
        let drawn: Vec<u32> = verdicts.drawn().collect();
        let missing = missing(&look.owners, &drawn);
        record.count(scene, &drawn, &verdicts, look.owners.len() - missing);
        let Some(record) = record.views.get_mut(view) else {
            return Ok(());
        };
        record.asked += u64::from(verdicts.tested());
        record.false_culls.push(missing as u64);
        let wrong = match missing {
            0 if verdicts.levels() == 1 => None,
            _ => {
                let drawn = EntitySet::Drawn(&verdicts);
                let seen = self.oracle.render(scene, &look.camera, drawn)?;
                Some(look.reference.wrong_pixel_mask(&seen))
            }
        };
        let count = wrong.iter().flatten().filter(|wrong| **wrong).count();
        let [width, height] = self.size;
        let pixels = f64::from(width * height).max(1.0);
        record.wrong_percent.push(100.0 * count as f64 / pixels);
        let worse = count > record.worst.as_ref().map_or(0, |worst| worst.wrong);
        if let Some(mask) = wrong.filter(|_| count > 0 && (sampled || worse)) {
            let painted = look.colour.take();
            let painted = painted.map_or_else(|| self.paint(scene, look.camera), Ok)?;
            let reference = look.colour.insert(painted);
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
            // Every owner drawn: the pictures are the same.
            record.flips.push(0.0);
        }
        Ok(())
    }

    fn paint(&mut self, scene: &GpuScene, camera: Camera) -> Result<RgbaImage, MeasureError> {
        self.painter.frame(scene, &[ViewInput::new(camera)])?;
        picture(&self.painter, 0, scene, self.size)
    }
}

/// How many owners were not drawn; both lists ascend.
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
    /// How many questions were asked so far, in all views.
    pub fn asked(&self) -> u64 {
        self.views.iter().map(|view| view.asked).sum()
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
