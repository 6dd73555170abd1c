//! Accuracy: every pose against the reference, all strategies in step.
//!
//! A strategy's visible set is drawn in the reference's own order, so that what differs are missing
//! entities, entities drawn coarser, and nothing else; a set that holds every owner of a pixel in full
//! therefore has no wrong pixel, and is not drawn again.

use std::sync::Arc;

use antumbra_cull::strategies::Frustum;
use antumbra_cull::{Members, Oracle, Stage, StageOptions, ViewInput, ViewSpec};
use antumbra_draw::{Detail, GpuScene, read_back};
use antumbra_scene::Camera;
use image::RgbaImage;

use super::script::Set;
use super::{CompareOptions, Progress};
use crate::MeasureError;
use crate::image_error::flip;
use crate::path::Path;
use crate::report::MeanMax;

/// What all strategies got wrong.
pub struct Accuracy {
    /// One a contender.
    pub records: Vec<Record>,
    /// The slots that own a pixel, a pose.
    pub owners: Vec<Arc<Vec<u32>>>,
}

/// What one strategy got wrong, and what it drew: sums over all poses.
#[derive(Default)]
pub struct Record {
    pub view: ViewError,
    pub flip: MeanMax,
    pub drawn: u64,
    pub triangles: u64,
    pub asked: u64,
    pub overdrawn: u64,
    pub tally: [u64; 6],
    pub sync_points: u32,
    pub worst: Option<Worst>,
    flips: Vec<(f64, f64)>,
}

/// One view's errors, a pose.
#[derive(Default)]
pub struct ViewError {
    pub wrong_percent: Vec<f64>,
    pub false_culls: Vec<u64>,
}

/// The frame with the most wrong pixels.
pub struct Worst {
    pub frame: usize,
    pub wrong: usize,
    pub reference: RgbaImage,
    pub strategy: RgbaImage,
    pub mask: Vec<bool>,
}

pub fn measure(
    set: &mut Set<'_>,
    stages: &mut [Stage],
    options: &CompareOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<Accuracy, MeasureError> {
    let (path, gpu) = (set.path, set.scene().gpu().clone());
    let gpu = &gpu;
    let [width, height] = options.size;
    let mut oracle = Oracle::new(set.scene(), options.size);
    let mut painter = Stage::new(
        set.scene(),
        Box::new(Frustum),
        vec![ViewSpec::main(width, height)],
        StageOptions::default(),
    )?;
    let mut records: Vec<Record> = stages.iter().map(|_| Record::default()).collect();
    let mut owners = Vec::with_capacity(path.poses().len());
    let total = path.poses().len() as u64;
    let every = path
        .poses()
        .len()
        .div_ceil(options.flip_poses.max(1))
        .max(1);
    for (frame, pose) in path.poses().iter().enumerate() {
        progress(Progress {
            phase: "accuracy",
            done: frame as u64,
            total,
        });
        let (scene, camera) = set.at(frame)?;
        let reference = oracle.look(scene, &camera, Members::Frustum)?;
        let owning = Arc::new(reference.owners());
        let mut reference_colour = None;
        for (stage, record) in stages.iter_mut().zip(&mut records) {
            let input = ViewInput {
                cut: pose.cut || frame == 0,
                reference: Some(Arc::clone(&owning)),
                ..ViewInput::new(camera)
            };
            let report = stage.frame(scene, &[input])?;
            gpu.wait()?;
            record.sync_points = record.sync_points.max(report.sync_points);
            let verdicts = stage.verdicts(0, scene)?;
            let drawn: Vec<u32> = verdicts.drawn().collect();
            let missing = missing(&owning, &drawn);
            record.count(scene, &drawn, &verdicts, owning.len() - missing);
            record.view.false_culls.push(missing as u64);
            let wrong = match missing {
                0 if verdicts.levels() == 1 => None,
                _ => Some(reference.wrong_pixel_mask(&oracle.look(
                    scene,
                    &camera,
                    Members::Drawn(&verdicts),
                )?)),
            };
            let count = wrong.iter().flatten().filter(|wrong| **wrong).count();
            record
                .view
                .wrong_percent
                .push(100.0 * count as f64 / f64::from(width * height).max(1.0));
            let sampled = frame % every == 0;
            let worse = count > record.worst.as_ref().map_or(0, |worst| worst.wrong);
            if let Some(mask) = wrong.filter(|_| count > 0 && (sampled || worse)) {
                if reference_colour.is_none() {
                    painter.frame(scene, &[ViewInput::new(camera)])?;
                    reference_colour = Some(picture(&painter, gpu, options.size)?);
                }
                let Some(reference) = &reference_colour else {
                    continue;
                };
                let strategy = picture(stage, gpu, options.size)?;
                if sampled {
                    let error = flip(reference, &strategy)?;
                    record.flips.push((error.mean, error.max));
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
                record.flips.push((0.0, 0.0));
            }
        }
        owners.push(owning);
    }
    for record in &mut records {
        record.finish()?;
    }
    Ok(Accuracy { records, owners })
}

/// The camera of a path's pose.
pub fn camera(path: &Path, frame: usize) -> Result<Camera, MeasureError> {
    let missing = || MeasureError::Path {
        name: path.name().to_owned(),
        problem: format!("it has no pose {frame}"),
    };
    let pose = path.poses().get(frame).ok_or_else(missing)?;
    Ok(pose.camera(path.projection()))
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
    gpu: &antumbra_draw::Gpu,
    [width, height]: [u32; 2],
) -> Result<RgbaImage, MeasureError> {
    let gone = || MeasureError::SizeMismatch {
        what: "colour target",
        got: "none".to_owned(),
        expected: format!("{width} x {height}"),
    };
    let texture = stage.colour(0).ok_or_else(gone)?;
    RgbaImage::from_raw(width, height, read_back::texture(gpu, texture)?).ok_or_else(gone)
}

impl Record {
    fn count(
        &mut self,
        scene: &GpuScene,
        drawn: &[u32],
        verdicts: &antumbra_cull::Verdicts,
        owners_drawn: usize,
    ) {
        let table = scene.table();
        self.drawn += drawn.len() as u64;
        self.triangles += drawn
            .iter()
            .map(|slot| {
                let detail = Detail::Level(verdicts.level(*slot));
                u64::from(table.primitives_of(*slot, detail))
            })
            .sum::<u64>();
        self.asked += u64::from(verdicts.asked());
        self.overdrawn += (drawn.len() - owners_drawn) as u64;
        for (sum, count) in self.tally.iter_mut().zip(verdicts.tally()) {
            *sum += u64::from(count);
        }
    }

    fn finish(&mut self) -> Result<(), MeasureError> {
        let count = self.flips.len().max(1) as f64;
        let mean = self.flips.iter().map(|(mean, _)| mean).sum::<f64>() / count;
        let mut max = self.flips.iter().map(|(mean, _)| *mean).fold(0.0, f64::max);
        if let Some(worst) = &self.worst {
            max = max.max(flip(&worst.reference, &worst.strategy)?.mean);
        }
        self.flip = MeanMax { mean, max };
        Ok(())
    }
}
