//! The formats of samples in SEG-Y files, by their code in the binary header: revision 1 (2002) and revision 2.0 (2017). Code 4, numbers with a
//! gain, was obsolete in revision 1, and is not read.

/// The order of a file's bytes. SEG-Y is big-endian; revision 2 allows both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ByteOrder {
    Big,
    Little,
}

impl ByteOrder {
    /// A copy of some bytes with the most significant first.
    fn big<const N: usize>(self, bytes: [u8; N]) -> [u8; N] {
        let mut bytes = bytes;
        if self == Self::Little {
            bytes.reverse();
        }
        bytes
    }

    pub(super) fn i16(self, bytes: [u8; 2]) -> i16 {
        i16::from_be_bytes(self.big(bytes))
    }

    pub(super) fn i32(self, bytes: [u8; 4]) -> i32 {
        i32::from_be_bytes(self.big(bytes))
    }

    pub(super) fn u64(self, bytes: [u8; 8]) -> u64 {
        u64::from_be_bytes(self.big(bytes))
    }

    pub(super) fn f64(self, bytes: [u8; 8]) -> f64 {
        f64::from_be_bytes(self.big(bytes))
    }
}

/// A format of samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SampleFormat {
    IbmFloat,
    I32,
    I16,
    F32,
    F64,
    I24,
    I8,
    I64,
    U32,
    U16,
    U64,
    U24,
    U8,
}

impl SampleFormat {
    /// The format with this code.
    pub(super) fn of(code: i16) -> Option<Self> {
        Some(match code {
            1 => Self::IbmFloat,
            2 => Self::I32,
            3 => Self::I16,
            5 => Self::F32,
            6 => Self::F64,
            7 => Self::I24,
            8 => Self::I8,
            9 => Self::I64,
            10 => Self::U32,
            11 => Self::U16,
            12 => Self::U64,
            15 => Self::U24,
            16 => Self::U8,
            _ => return None,
        })
    }

    /// The bytes of a sample.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::F64 | Self::I64 | Self::U64 => 8,
            Self::IbmFloat | Self::I32 | Self::F32 | Self::U32 => 4,
            Self::I24 | Self::U24 => 3,
            Self::I16 | Self::U16 => 2,
            Self::I8 | Self::U8 => 1,
        }
    }

    /// Calls `sink` with the value of every whole sample in `bytes`. What is no number is NaN or infinite.
    pub(super) fn decode(self, order: ByteOrder, bytes: &[u8], sink: impl FnMut(f32)) {
        match self {
            Self::IbmFloat => each(order, bytes, |bytes| ibm(u32::from_be_bytes(bytes)), sink),
            Self::I32 => each(order, bytes, |bytes| i32::from_be_bytes(bytes) as f32, sink),
            Self::I16 => each(order, bytes, |bytes| i16::from_be_bytes(bytes).into(), sink),
            Self::F32 => each(order, bytes, f32::from_be_bytes, sink),
            Self::F64 => each(order, bytes, |bytes| f64::from_be_bytes(bytes) as f32, sink),
            Self::I24 => {
                let number = |[a, b, c]: [u8; 3]| i32::from_be_bytes([a, b, c, 0]) >> 8;
                each(order, bytes, |bytes| number(bytes) as f32, sink);
            }
            Self::I8 => each(order, bytes, |bytes| i8::from_be_bytes(bytes).into(), sink),
            Self::I64 => each(order, bytes, |bytes| i64::from_be_bytes(bytes) as f32, sink),
            Self::U32 => each(order, bytes, |bytes| u32::from_be_bytes(bytes) as f32, sink),
            Self::U16 => each(order, bytes, |bytes| u16::from_be_bytes(bytes).into(), sink),
            Self::U64 => each(order, bytes, |bytes| u64::from_be_bytes(bytes) as f32, sink),
            Self::U24 => {
                let number = |[a, b, c]: [u8; 3]| u32::from_be_bytes([0, a, b, c]);
                each(order, bytes, |bytes| number(bytes) as f32, sink);
            }
            Self::U8 => each(order, bytes, |[byte]: [u8; 1]| byte.into(), sink),
        }
    }
}

fn each<const N: usize>(
    order: ByteOrder,
    bytes: &[u8],
    value: impl Fn([u8; N]) -> f32,
    mut sink: impl FnMut(f32),
) {
    for sample in bytes.as_chunks::<N>().0 {
        sink(value(order.big(*sample)));
    }
}

/// IBM's hexadecimal floating point of 32 bits (System/360 Principles of Operation): a sign, a power of 16 above 64, and a fraction of 24 bits. The
/// largest are beyond an f32, and infinite.
fn ibm(bits: u32) -> f32 {
    let fraction = f64::from(bits & 0x00ff_ffff);
    let power = 4 * ((bits >> 24 & 0x7f) as i32 - 64) - 24;
    // The power is -280 to 228, which an f64 has.
    let scale = f64::from_bits(((power + 1023) as u64) << 52);
    let magnitude = (fraction * scale) as f32;
    if bits >> 31 == 1 {
        -magnitude
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(format: SampleFormat, order: ByteOrder, bytes: &[u8]) -> Vec<f32> {
        let mut values = Vec::new();
        format.decode(order, bytes, |value| values.push(value));
        values
    }

    #[test]
    fn ibm_floats_are_those_of_the_manual() {
        // -118.625 is the manual's example; 0.15625 and the largest number follow from the format.
        let known = [
            (0xc276_a000_u32, -118.625),
            (0x4010_0000, 0.0625),
            (0x4110_0000, 1.0),
            (0x0000_0000, 0.0),
            (0x4028_0000, 0.156_25),
        ];
        for (bits, value) in known {
            assert_eq!(ibm(bits), value, "{bits:x}");
        }
        assert_eq!(ibm(0x7fff_ffff), f32::INFINITY);
        assert_eq!(ibm(0x0000_0001), 0.0, "smaller than an f32 has");
    }

    #[test]
    fn every_format_reads_both_orders() {
        let cases: [(i16, &[u8], f32); 13] = [
            (1, &[0x41, 0x20, 0, 0], 2.0),
            (2, &[0xff, 0xff, 0xff, 0xfe], -2.0),
            (3, &[0xff, 0xfe], -2.0),
            (5, &[0xc0, 0, 0, 0], -2.0),
            (6, &[0xc0, 0, 0, 0, 0, 0, 0, 0], -2.0),
            (7, &[0xff, 0xff, 0xfe], -2.0),
            (8, &[0xfe], -2.0),
            (9, &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xfe], -2.0),
            (10, &[0, 0, 1, 0], 256.0),
            (11, &[1, 0], 256.0),
            (12, &[0, 0, 0, 0, 0, 0, 1, 0], 256.0),
            (15, &[0, 1, 0], 256.0),
            (16, &[200], 200.0),
        ];
        for (code, big, value) in cases {
            let format = SampleFormat::of(code).unwrap();
            assert_eq!(format.bytes(), big.len());
            assert_eq!(decoded(format, ByteOrder::Big, big), [value], "{code}");
            let little: Vec<u8> = big.iter().rev().copied().collect();
            let twice = [little.clone(), little].concat();
            let read = decoded(format, ByteOrder::Little, &twice);
            assert_eq!(read, [value, value], "{code}");
        }
        assert_eq!([4, 13].map(SampleFormat::of), [None, None]);
    }
}
