//! Speed: blocks of consecutive poses with the strategies in rotation. First serialised frames, then frames with two in flight, or with as many as the comparison has.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Instant;

use antumbra_cull::{Gpu, Stage, ViewInput};
use antumbra_draw::GpuScene;

use super::accuracy::Owners;
use super::script::{PosedScene, ScriptedScene};
use super::{CompareOptions, CompareProgress};
use crate::MeasureError;
use crate::report::PassTime;
use crate::stats;

/// The times of all strategies.
pub struct Speed {
    /// By stage.
    pub runs: Vec<TimedRun>,
    /// Poses of a block.
    pub block: usize,
}

/// The times of one strategy.
#[derive(Default)]
pub struct TimedRun {
    /// Serialised frame times in milliseconds: by pose, then by repetition of the path.
    pub frame_ms: Vec<f64>,
    pub free_running_ms: Option<f64>,
    passes: Vec<PassSeries>,
    last_timed: Option<u64>,
    /// Frames whose passes were timed.
    timed: u32,
}

/// Times of one pass in milliseconds.
struct PassSeries {
    name: String,
    group: &'static str,
    cpu_ms: Vec<f64>,
    gpu_ms: Vec<f64>,
}

/// The most repetitions of the path.
const MAX_REPEATS: usize = 5;

/// Times all stages along the path.
pub fn measure(
    scripted: &mut ScriptedScene<'_>,
    stages: &mut [Stage],
    owners: &[Owners],
    options: &CompareOptions,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<Speed, MeasureError> {
    let poses = scripted.path.poses().len();
    let block = options
        .block
        .unwrap_or_else(|| usual_block(poses))
        .clamp(1, poses.max(1));
    let mut runs: Vec<TimedRun> = stages.iter().map(|_| TimedRun::default()).collect();
    let blocks: Vec<std::ops::Range<usize>> = (0..poses)
        .step_by(block)
        .map(|first| first..(first + block).min(poses))
        .collect();
    let begin = Instant::now();
    let total = (poses * stages.len()) as u64;
    let (mut repeats, mut turn) = (0, 0);
    while repeats < 1
        || (begin.elapsed().as_secs_f64() < options.least_seconds && repeats < MAX_REPEATS)
    {
        let mut done = 0;
        for range in &blocks {
            for offset in 0..stages.len() {
                let at = (offset + turn) % stages.len();
                let (stage, run) = (&mut stages[at], &mut runs[at]);
                if range.start == 0 {
                    warm_up(scripted, stage, owners)?;
                }
                for frame in range.clone() {
                    let StageInputs { scene, views } = inputs(scripted, frame, owners)?;
                    let start = Instant::now();
                    stage.frame(scene, &views)?;
                    scene.gpu().wait()?;
                    let time = start.elapsed().as_secs_f64() * 1e3;
                    stage.note_time(time);
                    run.frame_ms.push(time);
                    run.take_timings(stage);
                }
                done += range.len() as u64;
                progress(CompareProgress {
                    phase: "speed",
                    done,
                    total,
                });
            }
            turn += 1;
        }
        repeats += 1;
    }
    let most = options.in_flight.max(2) as usize;
    free_running(scripted, stages, owners, &mut runs, &blocks, most, progress)?;
    Ok(Speed { runs, block })
}

/// The default number of poses of a block: a sixth of the path, 20 at most.
pub fn usual_block(poses: usize) -> usize {
    poses.div_ceil(6).clamp(1, 20)
}

/// Brings a strategy to the path's first pose, so that no block includes a jump that is not part of the path.
fn warm_up(
    scripted: &mut ScriptedScene<'_>,
    stage: &mut Stage,
    owners: &[Owners],
) -> Result<(), MeasureError> {
    for cut in [true, false] {
        let StageInputs { scene, views } = inputs(scripted, 0, owners)?;
        stage.frame(scene, &with_cut(views, cut))?;
        scene.gpu().wait()?;
    }
    Ok(())
}

/// Times frames with `most` in flight. Only here a strategy that waits for the GPU loses time for it. Every fourth block is enough.
fn free_running(
    scripted: &mut ScriptedScene<'_>,
    stages: &mut [Stage],
    owners: &[Owners],
    runs: &mut [TimedRun],
    blocks: &[std::ops::Range<usize>],
    most: usize,
    progress: &mut dyn FnMut(CompareProgress),
) -> Result<(), MeasureError> {
    let chosen: Vec<_> = blocks.iter().step_by(4).collect();
    let mut means: Vec<Vec<f64>> = stages.iter().map(|_| Vec::new()).collect();
    let total = chosen.iter().map(|range| range.len() as u64).sum::<u64>() * stages.len() as u64;
    let mut done = 0;
    for (turn, range) in chosen.into_iter().enumerate() {
        for offset in 0..stages.len() {
            let at = (offset + turn) % stages.len();
            let stage = &mut stages[at];
            let StageInputs { scene, views } = inputs(scripted, range.start, owners)?;
            stage.frame(scene, &with_cut(views, true))?;
            scene.gpu().wait()?;
            let start = Instant::now();
            let mut in_flight = VecDeque::new();
            for frame in range.clone() {
                if in_flight.len() >= most {
                    wait_for(scripted.scene().gpu(), in_flight.pop_front())?;
                }
                let StageInputs { scene, views } = inputs(scripted, frame, owners)?;
                let report = stage.frame(scene, &views)?;
                in_flight.extend(report.plan.submission);
            }
            scripted.scene().gpu().wait()?;
            means[at].push(start.elapsed().as_secs_f64() * 1e3 / range.len() as f64);
            done += range.len() as u64;
            progress(CompareProgress {
                phase: "free running",
                done,
                total,
            });
        }
    }
    for (run, means) in runs.iter_mut().zip(means) {
        run.free_running_ms = Some(stats::median(&means)?);
    }
    Ok(())
}

fn wait_for(gpu: &Gpu, submission: Option<wgpu::SubmissionIndex>) -> Result<(), MeasureError> {
    gpu.device
        .poll(wgpu::PollType::Wait {
            submission_index: submission,
            timeout: None,
        })
        .map_err(|error| antumbra_cull::DeviceError::Lost(error.to_string()))?;
    Ok(gpu.check()?)
}

/// A stage's inputs at a pose.
struct StageInputs<'a> {
    scene: &'a GpuScene,
    views: Vec<ViewInput<'static>>,
}

/// Brings the scene to a pose and makes a stage's inputs there.
fn inputs<'a>(
    scripted: &'a mut ScriptedScene<'_>,
    frame: usize,
    owners: &[Owners],
) -> Result<StageInputs<'a>, MeasureError> {
    let cut = scripted
        .path
        .poses()
        .get(frame)
        .is_some_and(|pose| pose.cut);
    let PosedScene { scene, cameras } = scripted.at(frame)?;
    let owners = owners.get(frame);
    let input = |(view, camera)| ViewInput {
        cut,
        reference: owners.and_then(|owners| owners.get(view)).map(Arc::clone),
        ..ViewInput::new(camera)
    };
    Ok(StageInputs {
        scene,
        views: cameras.into_iter().enumerate().map(input).collect(),
    })
}

fn with_cut(mut inputs: Vec<ViewInput<'static>>, cut: bool) -> Vec<ViewInput<'static>> {
    for input in &mut inputs {
        input.cut = cut;
    }
    inputs
}

impl TimedRun {
    fn take_timings(&mut self, stage: &Stage) {
        let Some(timings) = stage.plan().timings() else {
            return;
        };
        if self.last_timed == Some(timings.frame) {
            return;
        }
        self.last_timed = Some(timings.frame);
        self.timed += 1;
        for pass in &timings.passes {
            // A budget may change the plan, so passes are matched by name.
            let known = self.passes.iter().position(|one| one.name == pass.name);
            let at = known.unwrap_or(self.passes.len());
            if known.is_none() {
                let (name, group) = (pass.name.clone(), pass.group.unwrap_or(""));
                self.passes.push(PassSeries {
                    name,
                    group,
                    cpu_ms: Vec::new(),
                    gpu_ms: Vec::new(),
                });
            }
            let series = &mut self.passes[at];
            series.cpu_ms.push(pass.cpu.as_secs_f64() * 1e3);
            series
                .gpu_ms
                .extend(pass.gpu.map(|time| time.as_secs_f64() * 1e3));
        }
    }

    /// The sum of the medians of a group's passes: GPU time where it was measured, else CPU time.
    pub fn group_median(&self, group: &str) -> Option<f64> {
        let mut passes = self
            .passes
            .iter()
            .filter(|pass| pass.group == group)
            .peekable();
        passes.peek()?;
        Some(
            passes
                .filter_map(|pass| {
                    stats::median(&pass.gpu_ms)
                        .or_else(|_| stats::median(&pass.cpu_ms))
                        .ok()
                })
                .sum(),
        )
    }

    /// The mean time of a group's passes in a frame, frames included in which some of them do not run: GPU time where it was measured, else
    /// CPU time.
    pub fn group_mean(&self, group: &str) -> Option<f64> {
        let passes = self.passes.iter().filter(|pass| pass.group == group);
        let all = passes.map(|pass| match pass.gpu_ms.is_empty() {
            true => pass.cpu_ms.iter().sum::<f64>(),
            false => pass.gpu_ms.iter().sum(),
        });
        let sum = all.reduce(|sum, more| sum + more)?;
        (self.timed > 0).then(|| sum / f64::from(self.timed))
    }

    /// The median times of each pass.
    pub fn pass_medians(&self) -> Vec<PassTime> {
        let times = |pass: &PassSeries| PassTime {
            name: pass.name.clone(),
            group: pass.group.to_owned(),
            cpu_ms: stats::median(&pass.cpu_ms).ok(),
            gpu_ms: stats::median(&pass.gpu_ms).ok(),
        };
        self.passes.iter().map(times).collect()
    }

    /// The frame time of each pose: the median over the repetitions of the path.
    pub fn by_pose(&self, poses: usize) -> Result<Vec<f64>, MeasureError> {
        let of = |pose: usize| {
            self.frame_ms
                .iter()
                .skip(pose)
                .step_by(poses.max(1))
                .copied()
                .collect::<Vec<_>>()
        };
        (0..poses).map(|pose| stats::median(&of(pose))).collect()
    }
}
