//! A SEG-Y file written as a bricked volume, of any size in bounded memory.
//!
//! Traces are vertical and bricks are cubes, so that a trace is in many bricks. A column of bricks, all that stand on one another, is filled from
//! its traces, each of which is read once; its bricks are then put where they belong.

use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

use antumbra_files::{WholeFile, size};
use rayon::prelude::*;

use super::placement::BRICK;
use super::{Places, SegyFile, samples_in, shown};
use crate::error::SubsurfaceError;
use crate::progress::ProgressFn;
use crate::volume::{BrickSource, brick_offset, encode_header};

/// Traces that lie one after the other in the file are read together, up to this many bytes.
const RUN: u64 = 1 << 20;

/// A trace of a column of bricks.
struct Member {
    trace: u64,
    places: Places,
}

impl SegyFile {
    /// Writes all of the file as a volume to a temporary file beside `path`, and renames it to `path` when it is complete. Columns of bricks are
    /// made in parallel, as many at a time as the memory of [`SegyOptions`](super::SegyOptions) allows. `progress` receives the number of written
    /// columns and of all columns.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadLayout`] for a name above 1024 bytes; [`SubsurfaceError::File`] for an error of the system;
    /// [`SubsurfaceError::Format`] when the memory does not take one column. After an error the temporary file is removed, and a previous file
    /// at `path` is unchanged.
    pub fn write(
        &self,
        path: &Path,
        name: &str,
        progress: ProgressFn<'_>,
    ) -> Result<(), SubsurfaceError> {
        let layout = self.layout();
        let header = encode_header(layout, name)
            .map_err(|problem| SubsurfaceError::BadLayout { problem })?;
        let failed = |action| {
            move |source| SubsurfaceError::File {
                action,
                path: path.into(),
                source,
            }
        };
        let [across, along, deep] = layout.bricks();
        let brick = layout.brick_bytes();
        let column = deep as usize * brick;
        let together = self.together(column)?;
        let mut whole = WholeFile::create(path).map_err(failed("create"))?;
        let file = whole.file();
        file.write_all(&header).map_err(failed("write"))?;
        let columns = u64::from(across) * u64::from(along);
        let mut bricks = vec![0; column * together.min(columns as usize).max(1)];
        let mut done = 0;
        progress(0, columns);
        while done < columns {
            let count = (columns - done).min(together as u64);
            let made = bricks
                .get_mut(..column * count as usize)
                .unwrap_or_default();
            let place = |number: u64| {
                // Both are below the number of bricks along their axes.
                [number % u64::from(across), number / u64::from(across)].map(|at| at as u32)
            };
            made.par_chunks_exact_mut(column)
                .enumerate()
                .try_for_each(|(number, bricks)| {
                    self.column(place(done + number as u64), bricks)
                })?;
            for (number, column) in made.chunks_exact(column).enumerate() {
                let [inline, crossline] = place(done + number as u64);
                for (time, samples) in column.chunks_exact(brick).enumerate() {
                    let at = brick_offset(layout, [inline, crossline, time as u32])?;
                    file.seek(SeekFrom::Start(at)).map_err(failed("write"))?;
                    file.write_all(samples).map_err(failed("write"))?;
                }
            }
            done += count;
            progress(done, columns);
        }
        whole.finish().map_err(failed("finish"))
    }

    /// How many columns of `column` bytes are made at a time.
    fn together(&self, column: usize) -> Result<usize, SubsurfaceError> {
        let run = RUN.max(self.header.sample_bytes());
        let each = column as u64 + run + RUN;
        let most = self.memory / each;
        if most == 0 {
            return Err(SubsurfaceError::Format {
                path: self.path.clone(),
                format: "SEG-Y file",
                problem: format!(
                    "a column of its bricks takes {} of memory, and {} are left: allow more (the option max_memory, or --memory)",
                    size(each),
                    size(self.memory)
                ),
            });
        }
        let threads = rayon::current_num_threads() * 2;
        Ok(threads.min(usize::try_from(most).unwrap_or(threads)))
    }

    /// Fills a column of bricks.
    fn column(&self, [across, along]: [u32; 2], bricks: &mut [u8]) -> Result<(), SubsurfaceError> {
        bricks.fill(0);
        let [inlines, crosslines, times] = self.layout.size;
        let mut members = Vec::with_capacity((BRICK * BRICK) as usize);
        for crossline in samples_in(along, crosslines) {
            for inline in samples_in(across, inlines) {
                if let Some(trace) = self.trace(inline, crossline) {
                    let places = Places {
                        inlines: shown(inline, inlines),
                        crosslines: shown(crossline, crosslines),
                        times,
                    };
                    members.push(Member { trace, places });
                }
            }
        }
        members.sort_unstable_by_key(|member| member.trace);
        let (trace_bytes, sample_bytes) = (self.header.trace_bytes(), self.header.sample_bytes());
        let longest = (RUN / trace_bytes).max(1);
        let mut bytes = Vec::new();
        let mut rest = members.as_slice();
        while let Some(first) = rest.first().map(|first| first.trace) {
            let run = rest.iter().zip(first..).take(longest as usize);
            let count = run
                .take_while(|(member, trace)| member.trace == *trace)
                .count();
            let (run, later) = rest.split_at(count.max(1));
            rest = later;
            // From the first trace's samples to the last one's.
            let length = (run.len() as u64 - 1) * trace_bytes + sample_bytes;
            bytes.resize(length as usize, 0);
            self.fill(self.samples_at(first), &mut bytes)?;
            for (number, member) in run.iter().enumerate() {
                let from = number * trace_bytes as usize;
                let samples = bytes.get(from..from + sample_bytes as usize);
                self.put(samples.unwrap_or_default(), 0, &member.places, bricks);
            }
        }
        Ok(())
    }
}
