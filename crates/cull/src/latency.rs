//! When a query's answer is used: the three edges of the graph.

use std::fmt;
use std::str::FromStr;

/// When a query's answer is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Latency {
    /// In a later frame: no stall, and the answer is as many frames old as the host has in flight, at least one.
    #[default]
    FrameLate,
    /// In the same frame on the host, by a sync point.
    SameFrame,
    /// In the same frame on the GPU: a compute node writes indirect draws. Neither a stall nor a delay.
    OnGpu,
}

impl Latency {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::FrameLate, Self::SameFrame, Self::OnGpu];
    /// Their words, in the order of [`Self::ALL`].
    pub const WORDS: &[&str] = &["frame-late", "same-frame", "on-gpu"];

    /// Its word on the command line and in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::FrameLate => "frame-late",
            Self::SameFrame => "same-frame",
            Self::OnGpu => "on-gpu",
        }
    }
}

impl fmt::Display for Latency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Latency {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut all = Self::ALL.into_iter();
        all.find(|latency| latency.word() == text).ok_or(())
    }
}
