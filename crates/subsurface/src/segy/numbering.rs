//! Where a SEG-Y file has the line numbers of its traces.

use std::fs::File;

use super::header::{FileHeader, TRACE_HEADER, take};
use super::options::{SegyOptions, TraceBytes};
use super::trace::TraceHeader;

/// The traces that are tried for their line numbers.
const TRIED: u64 = 512;

/// Bytes that hold line numbers, in the order in which they are tried: the standard's, then what was usual before it.
const TRIED_BYTES: [TraceBytes; 3] = [
    TraceBytes::STANDARD,
    TraceBytes {
        inline: 9,
        crossline: 21,
        ..TraceBytes::STANDARD
    },
    TraceBytes {
        inline: 5,
        crossline: 21,
        ..TraceBytes::STANDARD
    },
];
/// Where line numbers are from.
#[derive(Clone, Copy)]
pub(super) enum Numbering {
    Bytes(TraceBytes),
    /// One line, its traces in the file's order.
    Order,
}

impl Numbering {
    pub(super) fn of(self, trace: u64, header: &TraceHeader<'_>) -> [i32; 2] {
        match self {
            Self::Bytes(bytes) => [header.i32(bytes.inline), header.i32(bytes.crossline)],
            Self::Order => [0, i32::try_from(trace).unwrap_or(i32::MAX)],
        }
    }

    pub(super) fn position_bytes(self) -> TraceBytes {
        match self {
            Self::Bytes(bytes) => bytes,
            Self::Order => TraceBytes::STANDARD,
        }
    }
}
/// The bytes whose numbers differ between traces.
pub(super) fn numbering(
    file: &mut File,
    header: &FileHeader,
    count: u64,
    options: &SegyOptions,
    notes: &mut Vec<String>,
) -> Result<Numbering, String> {
    if let Some(bytes) = options.trace_bytes {
        return Ok(Numbering::Bytes(bytes));
    }
    let tried = count.min(TRIED);
    let mut numbers = TRIED_BYTES.map(|_| Vec::new());
    for number in 0..tried {
        // Evenly among all, so that a first line alone does not decide.
        let trace = number * count / tried;
        let mut bytes = [0; TRACE_HEADER];
        let at = header.start + trace * header.trace_bytes();
        take(file, at, &mut bytes, "a trace header")?;
        let read = TraceHeader::new(&bytes, header.order);
        // The numbers of a dummy are often none.
        if !read.is_live() {
            continue;
        }
        for (bytes, numbers) in TRIED_BYTES.iter().zip(&mut numbers) {
            numbers.push([read.i32(bytes.inline), read.i32(bytes.crossline)]);
        }
    }
    if numbers.iter().all(Vec::is_empty) {
        return Ok(Numbering::Bytes(TraceBytes::STANDARD));
    }
    let distinct = numbers.map(|mut numbers| {
        numbers.sort_unstable();
        numbers.dedup();
        numbers.len()
    });
    // Not those that differ most: bytes 5 to 8 are often a mere count, which differs more than the numbers of traces that share a position.
    let mut order = TRIED_BYTES.iter().zip(distinct);
    let found = order.find(|(_, distinct)| *distinct > 1);
    match found {
        Some((bytes, _)) if *bytes == TraceBytes::STANDARD => Ok(Numbering::Bytes(*bytes)),
        Some((bytes, _)) => {
            notes.push(format!(
                "its trace headers have no line numbers where the standard says: taken from bytes {} and {} (--trace-bytes {bytes})",
                bytes.inline, bytes.crossline
            ));
            Ok(Numbering::Bytes(*bytes))
        }
        None if count > 1 => {
            notes.push(
                "its trace headers have no line numbers: taken as one line, its traces in their order (--trace-bytes)"
                    .to_owned(),
            );
            Ok(Numbering::Order)
        }
        None => Ok(Numbering::Bytes(TraceBytes::STANDARD)),
    }
}
