//! The header of a trace: 240 bytes.

use glam::DVec2;

use super::header::TRACE_HEADER;
use super::options::TraceBytes;
use super::samples::ByteOrder;

/// A trace header.
pub(super) struct TraceHeader<'a> {
    bytes: &'a [u8],
    order: ByteOrder,
}

/// The unit of a trace's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PositionUnit {
    /// It says nothing, or nothing that the standard knows.
    Unsaid,
    Length,
    ArcSeconds,
    Degrees,
    /// Degrees, minutes and seconds in one number: DDDMMSS.
    Sexagesimal,
}

impl<'a> TraceHeader<'a> {
    /// The header at the beginning of a trace's bytes.
    pub(super) fn new(trace: &'a [u8], order: ByteOrder) -> Self {
        Self {
            bytes: trace.get(..TRACE_HEADER).unwrap_or_default(),
            order,
        }
    }

    fn field<const N: usize>(&self, from: u16) -> [u8; N] {
        let at = usize::from(from.saturating_sub(1));
        let rest = self.bytes.get(at..).unwrap_or_default();
        rest.first_chunk().copied().unwrap_or([0; N])
    }

    fn i16(&self, from: u16) -> i16 {
        self.order.i16(self.field(from))
    }

    /// The number of four bytes from this byte on.
    pub(super) fn i32(&self, from: u16) -> i32 {
        self.order.i32(self.field(from))
    }

    /// Whether it has samples that mean something: neither dead nor a dummy.
    pub(super) fn is_live(&self) -> bool {
        !matches!(self.i16(29), 2 | 3)
    }

    /// The number of its samples; 0 if it says nothing.
    pub(super) fn samples(&self) -> u32 {
        u32::from(self.i16(115) as u16)
    }

    /// Microseconds between samples; 0 if it says nothing.
    pub(super) fn interval(&self) -> f64 {
        f64::from(self.i16(117) as u16)
    }

    /// The time of its first sample in milliseconds.
    pub(super) fn delay(&self) -> f64 {
        scaled(f64::from(self.i16(109)), self.i16(215))
    }

    /// Its position; where there is none, that of its source.
    pub(super) fn position(&self, at: &TraceBytes) -> Option<DVec2> {
        let pair = |x: u16, y: u16| (self.i32(x), self.i32(y));
        let own = Some(pair(at.x, at.y)).filter(|pair| *pair != (0, 0));
        let (x, y) = own.or_else(|| Some(pair(73, 77)).filter(|pair| *pair != (0, 0)))?;
        let scaled = |value: i32| scaled(value.into(), self.i16(71));
        Some(DVec2::new(scaled(x), scaled(y)))
    }

    /// The unit of its position.
    pub(super) fn position_unit(&self) -> PositionUnit {
        match self.i16(89) {
            1 => PositionUnit::Length,
            2 => PositionUnit::ArcSeconds,
            3 => PositionUnit::Degrees,
            4 => PositionUnit::Sexagesimal,
            _ => PositionUnit::Unsaid,
        }
    }
}

/// A number with the standard's scalar: a positive one multiplies, a negative one divides.
fn scaled(value: f64, scalar: i16) -> f64 {
    match scalar {
        0 => value,
        1.. => value * f64::from(scalar),
        _ => value / f64::from(scalar.unsigned_abs()),
    }
}
