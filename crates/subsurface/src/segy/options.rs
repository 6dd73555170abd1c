//! How a SEG-Y file is read where it says nothing, or something else than it means.

use std::fmt;
use std::str::FromStr;

use antumbra_formats::Units;

/// The first bytes of numbers in a trace header, counted from 1 as the standard counts them. Each number has four bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceBytes {
    /// The inline number.
    pub inline: u16,
    /// The crossline number.
    pub crossline: u16,
    /// The position's x.
    pub x: u16,
    /// The position's y.
    pub y: u16,
}

impl TraceBytes {
    /// Those of the standard since revision 1.
    pub const STANDARD: Self = Self {
        inline: 189,
        crossline: 193,
        x: 181,
        y: 185,
    };

    /// The last byte at which a number can begin.
    const LAST: u16 = 237;
}

impl fmt::Display for TraceBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            inline,
            crossline,
            x,
            y,
        } = self;
        write!(f, "inline={inline},crossline={crossline},x={x},y={y}")
    }
}

impl FromStr for TraceBytes {
    type Err = String;

    /// Reads `inline=9,crossline=21,x=73,y=77`; what is not named is the standard's.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut bytes = Self::STANDARD;
        for part in text.split(',') {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            let at = value.trim().parse().ok();
            let at = at.filter(|at| (1..=Self::LAST).contains(at));
            let at = at.ok_or_else(|| {
                format!(
                    "`{part}` names no byte from 1 to {}: write inline=189,crossline=193,x=181,y=185",
                    Self::LAST
                )
            })?;
            match key.trim() {
                "inline" => bytes.inline = at,
                "crossline" => bytes.crossline = at,
                "x" => bytes.x = at,
                "y" => bytes.y = at,
                _ => {
                    return Err(format!("`{key}` is none of inline, crossline, x and y"));
                }
            }
        }
        Ok(bytes)
    }
}

/// How a SEG-Y file is read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SegyOptions {
    /// Where a trace header has its line numbers and its position. `None` tries the standard's bytes and, where those hold the same numbers in
    /// all traces, bytes that were usual before the standard.
    pub trace_bytes: Option<TraceBytes>,
    /// Units that replace those of the file. A unit of heights makes the samples depths, unless there is a velocity.
    pub units: Units,
    /// The latitude, in degrees, about which degrees are taken to metres. `None` means the middle of the file's own; a volume that shall lie among
    /// other files needs one.
    pub latitude: Option<f64>,
    /// The velocity in metres a second with which two-way times become depths. `None` draws a millisecond as a metre.
    pub velocity: Option<f64>,
    /// The values that become the least and the greatest sample; those beyond are clamped. `None` finds them: all but the largest thousandth.
    pub range: Option<[f32; 2]>,
    /// Bytes of memory that reading and writing may take; `None` for half of what the machine has free.
    pub max_memory: Option<u64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_named_and_the_rest_is_standard() {
        let read: TraceBytes = "inline=9, crossline=21".parse().unwrap();
        assert_eq!((read.inline, read.crossline, read.x), (9, 21, 181));
        assert_eq!(read.to_string().parse(), Ok(read));
        for wrong in ["", "inline", "inline=0", "inline=238", "cdp=21", "x=1,,"] {
            assert!(wrong.parse::<TraceBytes>().is_err(), "{wrong}");
        }
    }
}
