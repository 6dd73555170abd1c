//! The first pass over a SEG-Y file: every trace's header, and the amplitudes of some traces. It finds the grid of lines, where it lies, and the
//! trace at each of its positions.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

use antumbra_files::MemoryBudget;
use antumbra_formats::{LengthUnit, PlanUnit, Units};
use glam::{DVec2, DVec3};

use super::amplitude::Amplitudes;
use super::header::{FileHeader, TRACE_HEADER, take};
use super::options::{SegyOptions, TraceBytes};
use super::trace::{PositionUnit, TraceHeader};
use crate::progress::ProgressFn;
use crate::survey::{GridFit, LineNumbers, PlanGrid};
use crate::volume::VolumeLayout;

/// Bytes that a trace's line numbers take.
const NUMBERS: u64 = 12;
/// The traces whose amplitudes are counted, at most.
const COUNTED: u64 = 16_384;
/// The traces that are tried for their line numbers.
const TRIED: u64 = 512;
/// The most positions of the grid for each trace.
const SPARSE: u64 = 64;
/// The step between traces of a file without positions, in metres.
const PLAIN_STEP: f64 = 25.0;
/// Milliseconds between samples of a file that does not say.
const PLAIN_INTERVAL: f64 = 4.0;

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

/// What the first pass finds.
pub(super) struct Survey {
    pub(super) traces: Vec<u32>,
    pub(super) layout: VolumeLayout,
    pub(super) notes: Vec<String>,
}

/// Where line numbers are from.
#[derive(Clone, Copy)]
enum Numbering {
    Bytes(TraceBytes),
    /// One line, its traces in the file's order.
    Order,
}

impl Numbering {
    fn of(self, trace: u64, header: &TraceHeader<'_>) -> [i32; 2] {
        match self {
            Self::Bytes(bytes) => [header.i32(bytes.inline), header.i32(bytes.crossline)],
            Self::Order => [0, i32::try_from(trace).unwrap_or(i32::MAX)],
        }
    }

    fn position_bytes(self) -> TraceBytes {
        match self {
            Self::Bytes(bytes) => bytes,
            Self::Order => TraceBytes::STANDARD,
        }
    }
}

/// What is gathered from the headers.
struct Gathered {
    numbers: Vec<[i32; 2]>,
    /// Whether each trace is live.
    live: Vec<bool>,
    fit: GridFit,
    amplitudes: Amplitudes,
    unit: PositionUnit,
    interval: f64,
    delay: Option<f64>,
    delays_differ: bool,
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

/// The bytes whose numbers differ between traces.
fn numbering(
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
        for (bytes, numbers) in TRIED_BYTES.iter().zip(&mut numbers) {
            numbers.push([read.i32(bytes.inline), read.i32(bytes.crossline)]);
        }
    }
    let distinct = numbers.map(|mut numbers| {
        numbers.sort_unstable();
        numbers.dedup();
        numbers.len() as u64
    });
    // All positions differ, or, in a file of several traces a position, most do.
    let mut order = TRIED_BYTES.iter().zip(distinct);
    let found = order
        .clone()
        .find(|(_, distinct)| *distinct == tried)
        .or_else(|| order.find(|(_, distinct)| *distinct > 1));
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

/// Reads all headers, and the samples of some traces, from the first byte to the last.
fn gather(
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
        unit: PositionUnit::Length,
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
        if trace % 4096 == 0 {
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
        if let Some(place) = header.position(&numbering.position_bytes()) {
            self.fit.add(inline.into(), crossline.into(), place);
        }
        let is_live = header.is_live();
        self.numbers.push([inline, crossline]);
        self.live.push(is_live);
        if trace == 0 {
            self.unit = header.position_unit();
            self.interval = header.interval();
        }
        if is_live {
            let delay = header.delay();
            self.delays_differ |= *self.delay.get_or_insert(delay) != delay;
        }
    }

    /// Where the volume lies, and what its samples mean.
    fn layout(
        &self,
        header: &FileHeader,
        lines: &Lines,
        options: &SegyOptions,
        notes: &mut Vec<String>,
    ) -> Result<VolumeLayout, String> {
        let fitted = self.fit.grid();
        let grid = fitted.unwrap_or_else(|| PlanGrid::plain(PLAIN_STEP));
        let corner = grid.place(lines.inline.first.into(), lines.crossline.first.into());
        let scale = match fitted {
            Some(_) => self.plan_scale(header, options, corner, notes)?,
            None => {
                notes.push(format!(
                    "its traces have no positions that span a plan: lines and traces are taken {PLAIN_STEP} m apart"
                ));
                DVec2::ONE
            }
        };
        let steps = [
            (grid.inline, lines.inline.step),
            (grid.crossline, lines.crossline.step),
        ];
        let [inline, crossline] = steps.map(|(step, numbers)| step * scale * f64::from(numbers));
        let off = grid.off * scale.max_element();
        if off > 0.1 * inline.length().min(crossline.length()) {
            notes.push(format!(
                "its positions lie {off:.1} m beside a regular grid on average: drawn on the grid that fits best"
            ));
        }
        let depth = self.depths(header, options, notes);
        let range = match options.range {
            Some(range) => range,
            None => {
                let found = self.amplitudes.range();
                let found = found.ok_or("none of its live traces has a sample that is a number")?;
                let [low, high] = found.range;
                if found.is_clipped {
                    notes.push(format!(
                        "the largest thousandth of its samples is beyond {low} to {high}, and drawn as these (--range)"
                    ));
                }
                found.range
            }
        };
        let world = |plan: DVec2| DVec3::new(plan.x, 0.0, -plan.y);
        let size = [lines.inline.count, lines.crossline.count];
        let [inlines, crosslines] = size.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
        Ok(VolumeLayout {
            size: [inlines, crosslines, header.samples],
            brick: super::BRICK,
            origin: world(corner * scale) - DVec3::Y * depth.first,
            steps: [world(inline), world(crossline), DVec3::NEG_Y * depth.step],
            range,
        })
    }

    /// Metres of a unit of positions.
    fn plan_scale(
        &self,
        header: &FileHeader,
        options: &SegyOptions,
        corner: DVec2,
        notes: &mut Vec<String>,
    ) -> Result<DVec2, String> {
        let said = match (self.unit, header.is_feet) {
            (PositionUnit::ArcSeconds, _) => PlanUnit::Angle(1.0 / 3600.0),
            (PositionUnit::Degrees, _) => PlanUnit::DEGREES,
            (PositionUnit::Length, true) => PlanUnit::Length(LengthUnit::FOOT),
            (PositionUnit::Length, false) => PlanUnit::Length(LengthUnit::METRE),
        };
        let plan = options.units.plan.unwrap_or(said);
        let latitude = match plan {
            PlanUnit::Length(unit) => {
                if unit != LengthUnit::METRE {
                    notes.push(format!("its places are {unit}, taken to metres"));
                }
                0.0
            }
            PlanUnit::Angle(degrees) => {
                let latitude = corner.y * degrees;
                if latitude.abs() > 91.0 {
                    return Err(format!(
                        "its places are degrees, but have a latitude of {latitude}: name their unit (--units m)"
                    ));
                }
                notes.push(format!(
                    "its places are degrees: taken to metres about latitude {latitude:.4} (--units overrides)"
                ));
                latitude
            }
        };
        Ok(DVec2::from_array(plan.metres(latitude)))
    }

    fn depths(
        &self,
        header: &FileHeader,
        options: &SegyOptions,
        notes: &mut Vec<String>,
    ) -> Depths {
        let intervals = [header.interval, self.interval];
        let interval = intervals.into_iter().find(|interval| *interval > 0.0);
        let interval = interval.map_or_else(
            || {
                notes.push(format!(
                    "it does not say how far its samples are apart: taken as {PLAIN_INTERVAL} ms"
                ));
                PLAIN_INTERVAL
            },
            |microseconds| microseconds / 1000.0,
        );
        if self.delays_differ {
            notes.push(
                "its traces begin at different times: all are drawn as the first begins".to_owned(),
            );
        }
        let metres = match (options.units, options.velocity) {
            (
                Units {
                    height: Some(unit), ..
                },
                _,
            ) => unit.metres(),
            // There and back again.
            (_, Some(velocity)) => velocity / 2000.0,
            (_, None) => {
                notes.push(
                    "a millisecond of its traces is drawn as a metre, as is right for depths in metres (--velocity, --units)"
                        .to_owned(),
                );
                1.0
            }
        };
        Depths {
            first: self.delay.unwrap_or_default() * metres,
            step: interval * metres,
        }
    }
}

/// The depth of the first sample, and the distance of samples, in metres.
struct Depths {
    first: f64,
    step: f64,
}

/// The lines of both directions.
struct Lines {
    inline: LineNumbers,
    crossline: LineNumbers,
}

impl Lines {
    fn of(
        gathered: &Gathered,
        memory: &mut MemoryBudget,
        numbering: Numbering,
    ) -> Result<Self, String> {
        let numbers = |axis: usize| {
            let all = gathered.numbers.iter();
            LineNumbers::of(all.map(move |numbers| numbers[axis]))
        };
        let [Some(inline), Some(crossline)] = [numbers(0), numbers(1)] else {
            return Err("it has no trace".to_owned());
        };
        let cells = inline.count.saturating_mul(crossline.count);
        let traces = gathered.numbers.len() as u64;
        if cells > traces.saturating_mul(SPARSE).saturating_add(1024) {
            return Err(format!(
                "its {traces} traces lie on a grid of {} inlines and {} crosslines, almost all of it empty: the line numbers are elsewhere than in bytes {} (--trace-bytes)",
                inline.count,
                crossline.count,
                numbering.position_bytes()
            ));
        }
        let grid = || format!("its {} x {} positions", inline.count, crossline.count);
        (memory.take(cells * 4, grid)).map_err(|over| over.to_string())?;
        Ok(Self { inline, crossline })
    }

    /// The trace of each position, counted from 1. Of several, the first live one is taken.
    fn traces(&self, gathered: &Gathered, notes: &mut Vec<String>) -> Vec<u32> {
        let cells = (self.inline.count * self.crossline.count) as usize;
        let mut traces = vec![0; cells];
        let (mut dead, mut further) = (0_u64, 0_u64);
        let all = gathered.numbers.iter().zip(&gathered.live);
        for (trace, (&[inline, crossline], is_live)) in (1..).zip(all) {
            let place = self
                .inline
                .index(inline)
                .zip(self.crossline.index(crossline));
            let slot = place.and_then(|(inline, crossline)| {
                traces.get_mut((crossline * self.inline.count + inline) as usize)
            });
            match slot {
                _ if !is_live => dead += 1,
                Some(slot) if *slot == 0 => *slot = trace,
                _ => further += 1,
            }
        }
        let missing = cells as u64 - (gathered.numbers.len() as u64 - further).min(cells as u64);
        for (count, what) in [
            (dead, "traces are dead and have no value"),
            (missing, "positions of the grid have no trace and no value"),
            (
                further,
                "traces share their line numbers with another, of which the first is taken",
            ),
        ] {
            if count > 0 {
                notes.push(format!("{count} {what}"));
            }
        }
        traces
    }
}
