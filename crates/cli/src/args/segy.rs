//! How SEG-Y files are read.

use antumbra::formats::Units;
use antumbra::subsurface::segy::{SegyOptions, TraceBytes};
use clap::Args as ClapArgs;

use super::value::Amplitudes;

/// How SEG-Y files are read.
#[derive(Debug, Clone, ClapArgs)]
pub struct SegyArgs {
    /// Where a SEG-Y file's trace headers have their line numbers and positions, in bytes from 1: inline=9,crossline=21,x=73,y=77. By
    /// default the standard's (189, 193, 181, 185), or what was usual before it
    #[arg(long, value_name = "KEY=BYTE,...")]
    pub trace_bytes: Option<TraceBytes>,
    /// The velocity that makes a SEG-Y file's two-way times depths. By default a millisecond is drawn as a metre
    #[arg(long, value_name = "METRES/SECOND", value_parser = velocity)]
    pub velocity: Option<f64>,
    /// The values of a SEG-Y file that its range of colours begins and ends with. By default all but the largest thousandth
    #[arg(long, value_name = "LOW..HIGH", allow_hyphen_values = true)]
    pub range: Option<Amplitudes>,
}

impl SegyArgs {
    /// The options, with the command line's units and memory.
    pub fn options(&self, units: Option<Units>, memory: Option<u64>) -> SegyOptions {
        SegyOptions {
            trace_bytes: self.trace_bytes,
            units: units.unwrap_or_default(),
            latitude: None,
            velocity: self.velocity,
            range: self.range.map(|range| range.0),
            max_memory: memory,
        }
    }
}

fn velocity(text: &str) -> Result<f64, String> {
    let velocity = text.parse().ok();
    let velocity = velocity.filter(|velocity| (1.0..=1e6).contains(velocity));
    velocity.ok_or_else(|| "it takes metres a second, 1 to 1000000".to_owned())
}
