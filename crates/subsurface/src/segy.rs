//! Seismic volumes in SEG-Y files, revisions 0 to 2: Society of Exploration Geophysicists, *SEG-Y_r2.0: SEG-Y revision 2.0 Data Exchange format*,
//! 2017, and its predecessors of 2002 and 1975.
//!
//! [`SegyFile`] reads the headers of all traces once, and keeps four bytes for each position of the survey. Bricks are then read straight from the
//! file, or all of it is written as a bricked volume ([`SegyFile::write`]); neither holds more than a few columns of bricks in memory, whatever the
//! file's size. Positions without a trace, dead traces and samples that are no number have no value.
//!
//! A trace's place follows from its line numbers, by the plane grid that fits all positions best: a volume is regular. Files are treated as hostile:
//! every count is compared with the file's length, and every allocation is taken from a budget.

mod amplitude;
mod gather;
mod header;
mod lines;
mod numbering;
mod options;
mod placement;
mod samples;
mod scan;
mod trace;
mod write;

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use antumbra_files::{MemoryBudget, default_memory, words};

use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::volume::{BrickSource, VolumeLayout};
use header::FileHeader;
use placement::BRICK;
use scan::Survey;

pub use options::{SegyOptions, TraceBytes};

/// A SEG-Y file as a volume.
#[derive(Debug)]
pub struct SegyFile {
    path: PathBuf,
    /// Readers take turns.
    file: Mutex<File>,
    header: FileHeader,
    /// The number of the trace at each position, counted from 1; 0 where there is none. The inline axis is fastest.
    traces: Vec<u32>,
    layout: VolumeLayout,
    notes: Vec<String>,
    /// What is left of the memory.
    memory: u64,
}

impl SegyFile {
    /// The known file name extensions, in lower case.
    pub const EXTENSIONS: &'static [&'static str] = &["segy", "sgy", "seg"];

    /// Whether a file's name says that it is a SEG-Y file.
    #[must_use]
    pub fn is_named(path: &Path) -> bool {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let is = |ending: &str| {
            let mut known = Self::EXTENSIONS.iter();
            known.any(|known| known.eq_ignore_ascii_case(ending))
        };
        ending.is_some_and(is)
    }

    /// Opens a file, and reads its headers. `progress` receives the number of bytes read and of all bytes.
    ///
    /// # Errors
    /// [`SubsurfaceError::File`] for an error of the system; [`SubsurfaceError::Format`] for what is no SEG-Y file, for traces whose line numbers
    /// make no grid, and for more than the memory allows.
    pub fn open(
        path: &Path,
        options: &SegyOptions,
        progress: ProgressFn<'_>,
    ) -> Result<Self, SubsurfaceError> {
        let mut file = antumbra_files::open(path).map_err(|source| SubsurfaceError::File {
            action: "open",
            path: path.into(),
            source,
        })?;
        let mut memory = MemoryBudget::new(options.max_memory.unwrap_or_else(default_memory));
        let bad = |problem: String| SubsurfaceError::Format {
            path: path.into(),
            format: "SEG-Y file",
            problem: words::short(&problem, 400),
        };
        let header = FileHeader::read(&mut file).map_err(bad)?;
        let survey =
            Survey::scan(&mut file, &header, options, &mut memory, progress).map_err(bad)?;
        Ok(Self {
            path: path.into(),
            file: Mutex::new(file),
            header,
            traces: survey.traces,
            layout: survey.layout,
            notes: survey.notes,
            memory: memory.left(),
        })
    }

    /// What was found, assumed or left out, a line each.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The number of positions that have a live trace.
    #[must_use]
    pub fn live_positions(&self) -> usize {
        self.traces.iter().filter(|trace| **trace != 0).count()
    }

    /// The trace at a position of the survey, counted from 0.
    fn trace(&self, inline: u32, crossline: u32) -> Option<u64> {
        let index = u64::from(crossline) * u64::from(self.layout.size[0]) + u64::from(inline);
        let trace = self.traces.get(usize::try_from(index).ok()?)?;
        trace.checked_sub(1).map(u64::from)
    }

    /// The offset of a trace's samples.
    fn samples_at(&self, trace: u64) -> u64 {
        self.header.start + trace * self.header.trace_bytes() + self.header.before_samples()
    }

    /// Fills a buffer from an offset of the file.
    fn fill(&self, at: u64, bytes: &mut [u8]) -> Result<(), SubsurfaceError> {
        // A reader that panicked left nothing half-done but the position, which every reader sets.
        let mut file = self
            .file
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        header::take(&mut *file, at, bytes, "its samples").map_err(|problem| {
            SubsurfaceError::Format {
                path: self.path.clone(),
                format: "SEG-Y file",
                problem: format!("{problem}; it changed while it was read"),
            }
        })
    }

    /// The byte for a value: 0 for what is no number.
    fn byte(&self, value: f32) -> u8 {
        if !value.is_finite() {
            return 0;
        }
        let [low, high] = self.layout.range;
        let share = (value - low) / (high - low);
        1 + (share * 254.0).round().clamp(0.0, 254.0) as u8
    }
}

/// The positions in a brick, along one axis, that show a sample: its own, and behind the last sample all others.
fn shown(sample: u32, size: u32) -> std::ops::Range<usize> {
    let own = (sample % BRICK) as usize;
    match sample + 1 == size {
        true => own..BRICK as usize,
        false => own..own + 1,
    }
}

/// The samples of an axis that are in a brick.
fn samples_in(brick: u32, size: u32) -> std::ops::Range<u32> {
    let first = brick * BRICK;
    first..size.min(first + BRICK)
}

impl BrickSource for SegyFile {
    fn layout(&self) -> &VolumeLayout {
        &self.layout
    }

    fn read(&self, brick: [u32; 3], samples: &mut [u8]) -> Result<(), SubsurfaceError> {
        self.layout.check_read(brick, samples)?;
        samples.fill(0);
        let [inlines, crosslines, times] = self.layout.size;
        let width = self.header.format.bytes();
        let times_here = samples_in(brick[2], times);
        let mut bytes = vec![0; times_here.len() * width];
        for crossline in samples_in(brick[1], crosslines) {
            for inline in samples_in(brick[0], inlines) {
                let Some(trace) = self.trace(inline, crossline) else {
                    continue;
                };
                let from = u64::from(times_here.start) * width as u64;
                self.fill(self.samples_at(trace) + from, &mut bytes)?;
                let places = Places {
                    inlines: shown(inline, inlines),
                    crosslines: shown(crossline, crosslines),
                    times,
                };
                self.put(&bytes, times_here.start, &places, samples);
            }
        }
        Ok(())
    }
}

/// Where a trace is shown in a column of bricks.
struct Places {
    inlines: std::ops::Range<usize>,
    crosslines: std::ops::Range<usize>,
    /// The number of samples of the time axis.
    times: u32,
}

impl SegyFile {
    /// Puts the samples of a trace, from sample `first` on, into bricks one below the other, the first of which has sample `first`.
    fn put(&self, bytes: &[u8], first: u32, places: &Places, bricks: &mut [u8]) {
        let edge = BRICK as usize;
        let mut time = first;
        self.header
            .format
            .decode(self.header.order, bytes, |value| {
                let byte = self.byte(value);
                let brick = ((time / BRICK) - (first / BRICK)) as usize;
                for depth in shown(time, places.times) {
                    for row in places.crosslines.clone() {
                        let start = ((brick * edge + depth) * edge + row) * edge;
                        let row = bricks.get_mut(start..start + edge).unwrap_or_default();
                        if let Some(row) = row.get_mut(places.inlines.clone()) {
                            row.fill(byte);
                        }
                    }
                }
                time += 1;
            });
    }
}
