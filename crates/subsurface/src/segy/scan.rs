//! The first pass over a SEG-Y file: it finds the grid of lines, where it lies, and the trace at each of its positions.

use std::fs::File;

use antumbra_files::MemoryBudget;

use super::gather::gather;
use super::header::FileHeader;
use super::lines::Lines;
use super::numbering::numbering;
use super::options::SegyOptions;
use crate::progress::ProgressFn;
use crate::volume::VolumeLayout;

/// Bytes that a trace's line numbers take.
const NUMBERS: u64 = 12;

/// What the first pass finds.
pub(super) struct Survey {
    pub(super) traces: Vec<u32>,
    pub(super) layout: VolumeLayout,
    pub(super) notes: Vec<String>,
}
impl Survey {
    pub(super) fn scan(
        file: &mut File,
        header: &FileHeader,
        options: &SegyOptions,
        memory: &mut MemoryBudget,
        progress: ProgressFn<'_>,
    ) -> Result<Self, String> {
        let length = file.metadata().map_err(|error| error.to_string())?.len();
        let trace_bytes = header.trace_bytes();
        let rest = length.saturating_sub(header.start);
        let count = rest / trace_bytes;
        if count == 0 {
            return Err(format!(
                "it ends at byte {length}, before its first trace of {trace_bytes} bytes at byte {} does",
                header.start
            ));
        }
        if count >= u64::from(u32::MAX) {
            return Err(format!("it has {count} traces; cut it into parts"));
        }
        let mut notes = Vec::new();
        if !rest.is_multiple_of(trace_bytes) {
            notes.push(format!(
                "its last trace is cut off, or something else follows: the {} bytes after trace {count} are left out",
                rest % trace_bytes
            ));
        }
        // Never more than the file is long: a header and its numbers are shorter than a trace.
        let each = || format!("the line numbers of its {count} traces");
        (memory.take(count * NUMBERS, each)).map_err(|over| over.to_string())?;
        let samples = || format!("a trace of {} samples", header.samples);
        (memory.allow(trace_bytes, samples)).map_err(|over| over.to_string())?;
        let numbering = numbering(file, header, count, options, &mut notes)?;
        let gathered = gather(file, header, count, numbering, progress)?;
        let lines = Lines::of(&gathered, memory, numbering)?;
        let traces = lines.traces(&gathered, &mut notes);
        let layout = gathered.layout(header, &lines, options, &mut notes)?;
        if let Some(problem) = layout.problem() {
            return Err(problem);
        }
        Ok(Self {
            traces,
            layout,
            notes,
        })
    }
}
