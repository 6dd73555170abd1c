//! The head of a SEG-Y file: text of 3200 bytes, a binary header of 400, further texts. Revision 0 (Barry, Cavers, Kneale, 1975), 1 (2002) and
//! 2.0 (2017).

use std::io::{Read, Seek, SeekFrom};

use super::samples::{ByteOrder, SampleFormat};

/// The bytes of a text header, of the binary header, and of a trace header.
const TEXT: u64 = 3200;
const BINARY: usize = 400;
pub(super) const TRACE_HEADER: usize = 240;

/// The most further texts that are looked through for their end.
const MOST_TEXTS: u64 = 1000;

/// What the head of a file says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FileHeader {
    pub(super) order: ByteOrder,
    pub(super) format: SampleFormat,
    /// Samples of a trace.
    pub(super) samples: u32,
    /// Microseconds, or thousandths of a unit of depth, between samples; 0 if unknown.
    pub(super) interval: f64,
    /// Whether lengths are feet.
    pub(super) is_feet: bool,
    /// The offset of the first trace.
    pub(super) start: u64,
    /// Further headers of each trace.
    pub(super) more_headers: u64,
}

impl FileHeader {
    /// Reads the head of a file.
    pub(super) fn read(file: &mut (impl Read + Seek)) -> Result<Self, String> {
        let mut at = 0;
        let mut label = [0; 9];
        take(file, 0, &mut label, "the text header")?;
        // A tape label of 128 bytes names the revision in bytes 5 to 9.
        if let [_, _, _, _, b'S', b'Y', major, b'.', minor] = label
            && major.is_ascii_digit()
            && minor.is_ascii_digit()
        {
            at = 128;
        }
        let mut binary = [0; BINARY];
        take(file, at + TEXT, &mut binary, "the binary header")?;
        let fields = Fields(&binary);
        let mut header = fields.header().ok_or_else(|| {
            format!(
                "its binary header names the sample format {}, which none of the revisions 0 to 2 has, in either order of bytes",
                fields.i16(ByteOrder::Big, 3225)
            )
        })?;
        let major = binary[300];
        let texts = fields.i16(header.order, 3505);
        header.start = at + TEXT + BINARY as u64;
        header.start += match (major, u64::try_from(texts)) {
            (0, _) => 0,
            (_, Ok(texts)) => texts * TEXT,
            // A negative number says that a text names the end of the texts.
            (_, Err(_)) => end_of_texts(file, header.start)?,
        };
        if major >= 2 {
            header.more_headers = u64::try_from(fields.i32(header.order, 3507)).unwrap_or_default();
            let first = fields.u64(header.order, 3521);
            if first > header.start {
                header.start = first;
            }
        }
        if header.samples == 0 {
            let mut count = [0; 2];
            take(
                file,
                header.start.saturating_add(114),
                &mut count,
                "the first trace",
            )?;
            header.samples = u32::from(header.order.i16(count) as u16);
        }
        if header.samples == 0 {
            return Err(
                "neither its binary header nor its first trace says how many samples a trace has"
                    .into(),
            );
        }
        Ok(header)
    }

    /// The bytes of a trace before its samples.
    pub(super) fn before_samples(&self) -> u64 {
        (self.more_headers.saturating_add(1)).saturating_mul(TRACE_HEADER as u64)
    }

    /// The bytes of a trace's samples.
    pub(super) fn sample_bytes(&self) -> u64 {
        u64::from(self.samples) * self.format.bytes() as u64
    }

    /// The bytes of a trace.
    pub(super) fn trace_bytes(&self) -> u64 {
        self.before_samples().saturating_add(self.sample_bytes())
    }
}

/// The binary header. Fields are named by their first byte in the file, counted from 1, as the standard does.
struct Fields<'a>(&'a [u8; BINARY]);

impl Fields<'_> {
    fn bytes<const N: usize>(&self, from: usize) -> [u8; N] {
        let at = from.saturating_sub(TEXT as usize + 1);
        let rest = self.0.get(at..).unwrap_or_default();
        rest.first_chunk().copied().unwrap_or([0; N])
    }

    fn i16(&self, order: ByteOrder, from: usize) -> i16 {
        order.i16(self.bytes(from))
    }

    fn i32(&self, order: ByteOrder, from: usize) -> i32 {
        order.i32(self.bytes(from))
    }

    fn u64(&self, order: ByteOrder, from: usize) -> u64 {
        order.u64(self.bytes(from))
    }

    fn header(&self) -> Option<FileHeader> {
        let order = match self.bytes(3297) {
            [1, 2, 3, 4] => ByteOrder::Big,
            [4, 3, 2, 1] => ByteOrder::Little,
            _ => {
                let mut orders = [ByteOrder::Big, ByteOrder::Little].into_iter();
                orders.find(|order| SampleFormat::of(self.i16(*order, 3225)).is_some())?
            }
        };
        let is_2 = self.0[300] >= 2;
        let samples = u32::from(self.i16(order, 3221) as u16);
        let interval = f64::from(self.i16(order, 3217) as u16);
        // Revision 2 has wider fields, which count where they are set.
        let wide = u32::try_from(self.i32(order, 3269)).ok();
        let wide = wide.filter(|wide| is_2 && *wide > 0);
        let exact = order.f64(self.bytes(3273));
        let exact = (is_2 && exact.is_finite() && exact > 0.0).then_some(exact);
        Some(FileHeader {
            order,
            format: SampleFormat::of(self.i16(order, 3225))?,
            samples: wide.unwrap_or(samples),
            interval: exact.unwrap_or(interval),
            is_feet: self.i16(order, 3255) == 2,
            start: 0,
            more_headers: 0,
        })
    }
}

/// The length of the texts up to the one that is their end, in ASCII or in EBCDIC (code page 37).
fn end_of_texts(file: &mut (impl Read + Seek), start: u64) -> Result<u64, String> {
    const ASCII: &[u8] = b"((SEG: EndText))";
    const EBCDIC: &[u8] = &[
        0x4d, 0x4d, 0xe2, 0xc5, 0xc7, 0x7a, 0x40, 0xc5, 0x95, 0x84, 0xe3, 0x85, 0xa7, 0xa3, 0x5d,
        0x5d,
    ];
    for text in 0..MOST_TEXTS {
        let mut begin = [0; 80];
        take(file, start + text * TEXT, &mut begin, "a further text")?;
        if [ASCII, EBCDIC].iter().any(|end| begin.starts_with(end)) {
            return Ok((text + 1) * TEXT);
        }
    }
    Err(format!(
        "none of its first {MOST_TEXTS} further texts is the last one"
    ))
}

/// Fills `bytes` from an offset of the file.
pub(super) fn take(
    file: &mut (impl Read + Seek),
    at: u64,
    bytes: &mut [u8],
    what: &str,
) -> Result<(), String> {
    let read = file
        .seek(SeekFrom::Start(at))
        .and_then(|_| file.read_exact(bytes));
    read.map_err(|error| format!("{what} at byte {at}: {error}"))
}
