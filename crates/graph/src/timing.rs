//! Pass times: on the host always, on the GPU where the device has timestamps (by wgpu-profiler). Switched off it costs nothing.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::{Duration, Instant};

use wgpu_profiler::{GpuProfiler, GpuProfilerQuery, GpuProfilerSettings, GpuTimerQueryResult};

use crate::compile::Mode;
use crate::pass::Pass;

/// The times of one frame, the latest that has arrived.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timings {
    /// The frame measured.
    pub frame: u64,
    /// Each pass that was kept, in the order of its declaration; a pass run several times (loops, many queries) has the sum.
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
    /// Time of its body and its recording on the host.
    pub cpu: Duration,
    /// Time on the GPU, where it can be told.
    pub gpu: Option<Duration>,
}

/// The summed time of a group of passes.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupTiming {
    /// The group.
    pub group: &'static str,
    /// Host time.
    pub cpu: Duration,
    /// GPU time of those passes of which it can be told; `None` if of none.
    pub gpu: Option<Duration>,
}

/// Frames whose timestamps may be on their way.
const IN_FLIGHT: usize = 3;

const UNDER_WAY: u8 = 0;
const DONE: u8 = 1;
const DROPPED: u8 = 2;

/// In an embedded plan the host submits: says when that has happened, or never will.
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

pub(crate) struct Timing {
    enabled: bool,
    /// This frame is being measured.
    active: bool,
    profiler: Option<GpuProfiler>,
    current: Vec<Duration>,
    /// Frames the profiler has under way.
    waiting: VecDeque<Measured>,
    /// An embedded frame recorded, not yet known to be finished.
    unsubmitted: Option<(Arc<AtomicU8>, Measured)>,
    latest: Option<(u64, Vec<Duration>, Vec<Option<Duration>>)>,
}

/// One pass being measured.
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
                    // Its query results cannot be mapped yet: this frame goes unmeasured.
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
                self.latest = Some((measured.frame, measured.cpu, gpu));
            }
        }
        self.active = true;
        self.current.clear();
        self.current.resize(passes, Duration::ZERO);
    }

    /// Begins a pass; `on_encoder`: it records on the encoder itself, not in a pass of its own.
    pub fn begin(
        &self,
        pass: usize,
        encoder: Option<(&mut wgpu::CommandEncoder, bool)>,
    ) -> Option<Running> {
        if !self.active {
            return None;
        }
        let query = match (&self.profiler, encoder) {
            (Some(profiler), Some((encoder, true))) => {
                Some(profiler.begin_query(pass.to_string(), encoder))
            }
            (Some(profiler), Some((encoder, false))) => {
                Some(profiler.begin_pass_query(pass.to_string(), encoder))
            }
            _ => None,
        };
        Some(Running {
            started: Instant::now(),
            query,
        })
    }

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

    /// Before each submit: the timestamps written so far go to their buffers.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let (true, Some(profiler)) = (self.active, &mut self.profiler) {
            profiler.resolve_queries(encoder);
        }
    }

    /// In an embedded plan, at the end of recording.
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
            self.latest = Some((frame, cpu, gpu));
        } else if mode == Mode::Owned {
            let cpu = std::mem::take(&mut self.current);
            self.end_profiler_frame(Measured { frame, cpu });
        }
        self.active = false;
    }

    /// A frame failed: what it began cannot be finished.
    pub fn abandon(&mut self) {
        *self = Self {
            latest: self.latest.take(),
            ..Self::new(self.enabled)
        };
    }

    pub fn latest(&self, passes: &[Pass], kept: &[bool]) -> Option<Timings> {
        let (frame, cpu, gpu) = self.latest.as_ref()?;
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
        // As the profiler does: when too many are under way, the newest of them gives way.
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

/// The profiler's labels are the numbers of the passes.
fn by_pass(results: &[GpuTimerQueryResult], passes: usize) -> Vec<Option<Duration>> {
    let mut times = vec![None; passes];
    for result in results {
        let (Ok(pass), Some(time)) = (result.label.parse::<usize>(), &result.time) else {
            continue;
        };
        // Some drivers write the end before the beginning; a time is never negative.
        let seconds = (time.end - time.start).max(0.0);
        if let (Some(sum), Ok(time)) = (times.get_mut(pass), Duration::try_from_secs_f64(seconds)) {
            *sum = Some(sum.unwrap_or(Duration::ZERO) + time);
        }
    }
    times
}
