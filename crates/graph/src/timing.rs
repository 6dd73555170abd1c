//! Pass times: host times always, GPU times where the device has timestamps (by wgpu-profiler). Switched off, it costs nothing.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

use web_time::Instant;
use wgpu_profiler::{GpuProfiler, GpuProfilerQuery, GpuProfilerSettings, GpuTimerQueryResult};

use crate::options::Mode;
use crate::pass::Pass;

/// The times of one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timings {
    /// The frame's number.
    pub frame: u64,
    /// Each kept pass, in the order of declaration. A pass that runs several times (in loops, for many queries) has the sum.
    pub passes: Vec<PassTiming>,
    /// Sums by group, in order of first appearance.
    pub groups: Vec<GroupTiming>,
}

/// The time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    /// Its name.
    pub name: String,
    /// Its group, if it has one.
    pub group: Option<&'static str>,
    /// Host time of its body and of recording it.
    pub cpu: Duration,
    /// GPU time; `None` where it is not measured.
    pub gpu: Option<Duration>,
}

/// The summed time of a group of passes.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupTiming {
    /// The group.
    pub group: &'static str,
    /// Host time.
    pub cpu: Duration,
    /// GPU time of the passes for which it is measured; `None` where it is measured for none.
    pub gpu: Option<Duration>,
}

/// Frames whose timestamps may be pending.
const IN_FLIGHT: usize = 3;

const UNDER_WAY: u8 = 0;
const DONE: u8 = 1;
const DROPPED: u8 = 2;

/// Tells whether the encoder of an embedded plan has been submitted and its work is done, or was dropped.
struct Ticket(Arc<AtomicU8>);

impl Drop for Ticket {
    fn drop(&mut self) {
        let _ = self
            .0
            .compare_exchange(UNDER_WAY, DROPPED, Ordering::AcqRel, Ordering::Acquire);
    }
}

/// Host times of a frame, by pass.
struct Measured {
    frame: u64,
    cpu: Vec<Duration>,
}

/// The times of a frame, by pass.
struct FrameTimes {
    frame: u64,
    cpu: Vec<Duration>,
    gpu: Vec<Option<Duration>>,
}

/// Measures the passes of frames.
pub(crate) struct Timing {
    enabled: bool,
    /// The current frame is measured.
    active: bool,
    profiler: Option<GpuProfiler>,
    current: Vec<Duration>,
    /// Frames whose results the profiler has not delivered yet.
    waiting: VecDeque<Measured>,
    /// An embedded frame that was recorded and is not known to be finished.
    unsubmitted: Option<(Arc<AtomicU8>, Measured)>,
    latest: Option<FrameTimes>,
}

/// What a pass records, which decides how its GPU time is measured.
pub(crate) enum Recorded<'e> {
    /// A render or compute pass on this encoder.
    Pass(&'e mut wgpu::CommandEncoder),
    /// Commands on the encoder itself.
    Commands(&'e mut wgpu::CommandEncoder),
    /// Nothing that is timed on the GPU.
    Nothing,
}

/// A pass under measurement.
pub(crate) struct Running {
    started: Instant,
    pub query: Option<GpuProfilerQuery>,
}

impl Timing {
    pub fn new(enabled: bool) -> Self {
        Self {
            enabled,
            active: false,
            profiler: None,
            current: Vec::new(),
            waiting: VecDeque::new(),
            unsubmitted: None,
            latest: None,
        }
    }

    pub fn set_enabled(&mut self, enabled: bool) {
        if !enabled {
            *self = Self {
                latest: self.latest.take(),
                ..Self::new(false)
            };
        }
        self.enabled = enabled;
    }

    pub fn begin_frame(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, passes: usize) {
        self.active = false;
        if !self.enabled {
            return;
        }
        let has_timestamps = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        if self.profiler.is_none() && has_timestamps {
            let settings = GpuProfilerSettings {
                enable_timer_queries: true,
                enable_debug_groups: false,
                max_num_pending_frames: IN_FLIGHT,
            };
            self.profiler = GpuProfiler::new(device, settings).ok();
        }
        if let Some((status, measured)) = self.unsubmitted.take() {
            match status.load(Ordering::Acquire) {
                UNDER_WAY => {
                    // Its query results cannot be mapped yet, so this frame is not measured.
                    self.unsubmitted = Some((status, measured));
                    return;
                }
                DONE => self.end_profiler_frame(measured),
                _ => {
                    self.abandon();
                    return;
                }
            }
        }
        while let Some(profiler) = &mut self.profiler {
            let Some(results) = profiler.process_finished_frame(queue.get_timestamp_period())
            else {
                break;
            };
            if let Some(measured) = self.waiting.pop_front() {
                let gpu = by_pass(&results, passes);
                self.latest = Some(FrameTimes {
                    frame: measured.frame,
                    cpu: measured.cpu,
                    gpu,
                });
            }
        }
        self.active = true;
        self.current.clear();
        self.current.resize(passes, Duration::ZERO);
    }

    /// Begins measuring a pass; `None` where this frame is not measured.
    pub fn begin(&self, pass: usize, recorded: Recorded<'_>) -> Option<Running> {
        if !self.active {
            return None;
        }
        let query = match (&self.profiler, recorded) {
            (Some(profiler), Recorded::Commands(encoder)) => {
                Some(profiler.begin_query(pass.to_string(), encoder))
            }
            (Some(profiler), Recorded::Pass(encoder)) => {
                Some(profiler.begin_pass_query(pass.to_string(), encoder))
            }
            _ => None,
        };
        Some(Running {
            started: Instant::now(),
            query,
        })
    }

    /// Ends measuring a pass.
    pub fn end(
        &mut self,
        pass: usize,
        running: Option<Running>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(running) = running else {
            return;
        };
        if let (Some(profiler), Some(query)) = (&self.profiler, running.query) {
            profiler.end_query(encoder, query);
        }
        if let Some(time) = self.current.get_mut(pass) {
            *time += running.started.elapsed();
        }
    }

    /// Before each submit: resolves the timestamps that were written so far.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let (true, Some(profiler)) = (self.active, &mut self.profiler) {
            profiler.resolve_queries(encoder);
        }
    }

    /// At the end of recording an embedded frame: watches for its submission.
    pub fn watch(&mut self, frame: u64, encoder: &wgpu::CommandEncoder) {
        if !self.active || self.profiler.is_none() {
            return;
        }
        let status = Arc::new(AtomicU8::new(UNDER_WAY));
        let ticket = Ticket(Arc::clone(&status));
        encoder.on_submitted_work_done(move || ticket.0.store(DONE, Ordering::Release));
        let cpu = std::mem::take(&mut self.current);
        self.unsubmitted = Some((status, Measured { frame, cpu }));
    }

    /// After the frame was submitted, or recorded.
    pub fn end_frame(&mut self, frame: u64, mode: Mode) {
        if !self.active {
            return;
        }
        if self.profiler.is_none() {
            let cpu = std::mem::take(&mut self.current);
            let gpu = vec![None; cpu.len()];
            self.latest = Some(FrameTimes { frame, cpu, gpu });
        } else if mode == Mode::Owned {
            let cpu = std::mem::take(&mut self.current);
            self.end_profiler_frame(Measured { frame, cpu });
        }
        self.active = false;
    }

    /// Drops all pending measurements, since a frame failed and cannot be finished.
    pub fn abandon(&mut self) {
        *self = Self {
            latest: self.latest.take(),
            ..Self::new(self.enabled)
        };
    }

    /// The latest times, with the passes' names and groups.
    pub fn latest(&self, passes: &[Pass], kept: &[bool]) -> Option<Timings> {
        let FrameTimes { frame, cpu, gpu } = self.latest.as_ref()?;
        let mut timings = Timings {
            frame: *frame,
            ..Timings::default()
        };
        for (index, pass) in passes.iter().enumerate() {
            let (true, Some(cpu), Some(gpu)) = (kept[index], cpu.get(index), gpu.get(index)) else {
                continue;
            };
            timings.passes.push(PassTiming {
                name: pass.name.clone(),
                group: pass.group,
                cpu: *cpu,
                gpu: *gpu,
            });
            if let Some(group) = pass.group {
                add_to_group(&mut timings.groups, group, *cpu, *gpu);
            }
        }
        Some(timings)
    }

    fn end_profiler_frame(&mut self, measured: Measured) {
        let Some(profiler) = &mut self.profiler else {
            return;
        };
        // As the profiler does: when too many frames are pending, the newest of them is dropped.
        if self.waiting.len() == IN_FLIGHT {
            self.waiting.pop_back();
        }
        if profiler.end_frame().is_ok() {
            self.waiting.push_back(measured);
        } else {
            self.abandon();
        }
    }
}

fn add_to_group(
    groups: &mut Vec<GroupTiming>,
    group: &'static str,
    cpu: Duration,
    gpu: Option<Duration>,
) {
    match groups.iter_mut().find(|sum| sum.group == group) {
        Some(sum) => {
            sum.cpu += cpu;
            sum.gpu = match (sum.gpu, gpu) {
                (Some(a), Some(b)) => Some(a + b),
                (a, b) => a.or(b),
            };
        }
        None => groups.push(GroupTiming { group, cpu, gpu }),
    }
}

/// GPU times by pass. The profiler's labels are the passes' indices.
fn by_pass(results: &[GpuTimerQueryResult], passes: usize) -> Vec<Option<Duration>> {
    let mut times = vec![None; passes];
    for result in results {
        let (Ok(pass), Some(time)) = (result.label.parse::<usize>(), &result.time) else {
            continue;
        };
        // Some drivers report an end before the start; a time is never negative.
        let seconds = (time.end - time.start).max(0.0);
        if let (Some(sum), Ok(time)) = (times.get_mut(pass), Duration::try_from_secs_f64(seconds)) {
            *sum = Some(sum.unwrap_or(Duration::ZERO) + time);
        }
    }
    times
}
