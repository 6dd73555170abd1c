//! All that the headers of a SEG-Y file's traces say, and the amplitudes of some traces: one pass from the first byte to the last.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

use super::amplitude::Amplitudes;
use super::header::{FileHeader, TRACE_HEADER};
use super::numbering::Numbering;
use super::trace::{PositionUnit, TraceHeader};
use crate::progress::ProgressFn;
use crate::survey::GridFit;

/// The traces whose amplitudes are counted, at most.
const COUNTED: u64 = 16_384;

/// What is gathered from the headers.
pub(super) struct Gathered {
    pub(super) numbers: Vec<[i32; 2]>,
    /// Whether each trace is live.
    pub(super) live: Vec<bool>,
    pub(super) fit: GridFit,
    pub(super) amplitudes: Amplitudes,
    pub(super) unit: PositionUnit,
    pub(super) interval: f64,
    pub(super) delay: Option<f64>,
    pub(super) delays_differ: bool,
}

/// Reads all headers, and the samples of some traces, from the first byte to the last.
pub(super) fn gather(
    file: &mut File,
    header: &FileHeader,
    count: u64,
    numbering: Numbering,
    progress: ProgressFn<'_>,
) -> Result<Gathered, String> {
    // Where the length is no multiple of a trace's, other traces may be longer or shorter.
    let length = file.metadata().map_err(|error| error.to_string())?.len();
    let is_whole = (length - header.start).is_multiple_of(header.trace_bytes());
    let mut gathered = Gathered {
        numbers: Vec::with_capacity(count as usize),
        live: Vec::with_capacity(count as usize),
        fit: GridFit::default(),
        amplitudes: Amplitudes::new(),
        unit: PositionUnit::Unsaid,
        interval: 0.0,
        delay: None,
        delays_differ: false,
    };
    let at = |error: std::io::Error| format!("its traces: {error}");
    file.seek(SeekFrom::Start(header.start)).map_err(at)?;
    let mut reader = BufReader::with_capacity(1 << 20, file);
    let stride = count.div_ceil(COUNTED);
    let total = count * header.trace_bytes();
    let mut bytes = [0; TRACE_HEADER];
    let mut samples = vec![0; header.sample_bytes() as usize];
    let more = i64::try_from(header.before_samples() - TRACE_HEADER as u64);
    let more = more.map_err(|_| "its traces have too many headers".to_owned())?;
    for trace in 0..count {
        if trace.is_multiple_of(4096) {
            progress(trace * header.trace_bytes(), total);
        }
        reader.read_exact(&mut bytes).map_err(at)?;
        let read = TraceHeader::new(&bytes, header.order);
        let own = read.samples();
        if !is_whole && own != 0 && own != header.samples && header.samples <= 0xffff {
            return Err(format!(
                "trace {} has {own} samples, and the head of the file says {}: traces of different lengths are not read",
                trace + 1,
                header.samples
            ));
        }
        gathered.note(trace, &read, numbering);
        reader.seek_relative(more).map_err(at)?;
        if trace.is_multiple_of(stride) && read.is_live() {
            reader.read_exact(&mut samples).map_err(at)?;
            let count = |value| gathered.amplitudes.add(value);
            header.format.decode(header.order, &samples, count);
        } else {
            let skipped = i64::try_from(samples.len()).unwrap_or(i64::MAX);
            reader.seek_relative(skipped).map_err(at)?;
        }
    }
    progress(total, total);
    Ok(gathered)
}

impl Gathered {
    fn note(&mut self, trace: u64, header: &TraceHeader<'_>, numbering: Numbering) {
        let [inline, crossline] = numbering.of(trace, header);
        let is_live = header.is_live();
        self.numbers.push([inline, crossline]);
        self.live.push(is_live);
        if !is_live {
            return;
        }
        if let Some(place) = header.position(&numbering.position_bytes()) {
            self.fit.add(inline.into(), crossline.into(), place);
        }
        let delay = header.delay();
        match self.delay {
            Some(first) => self.delays_differ |= first != delay,
            // The first live trace speaks for all.
            None => {
                self.delay = Some(delay);
                self.unit = header.position_unit();
                self.interval = header.interval();
            }
        }
    }
}
