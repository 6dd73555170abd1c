//! A trial of a capability: where the driver's answers lie, and what they should be.

use std::fmt;
use std::ops::Range;

use super::report::{Failure, Outcome};

/// An answer that is known beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Answer {
    /// A number.
    Number(u32),
    /// A depth, to the bit.
    Depth(f32),
    /// The low and the high word of a query's result: whether it is zero.
    Samples(bool),
}

impl Answer {
    /// Words of an answer in a buffer.
    fn words(self) -> usize {
        match self {
            Self::Number(_) | Self::Depth(_) => 1,
            Self::Samples(_) => 2,
        }
    }

    /// What a buffer holds, as an answer of this kind; `None` where it ends before.
    fn found(self, words: &[u32]) -> Option<Self> {
        let words = words.get(..self.words())?;
        let first = *words.first()?;
        Some(match self {
            Self::Number(_) => Self::Number(first),
            Self::Depth(_) => Self::Depth(f32::from_bits(first)),
            Self::Samples(_) => Self::Samples(words.iter().any(|word| *word != 0)),
        })
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Depth(depth) => write!(f, "{depth}"),
            Self::Samples(true) => f.write_str("visible samples"),
            Self::Samples(false) => f.write_str("no visible sample"),
        }
    }
}

/// The words of an answer, and which answer it is.
pub(super) struct Expected {
    pub answer: Answer,
    pub place: String,
}

/// A trial whose commands are recorded. The answers lie in a range of what is read back.
pub(super) struct Trial {
    pub expected: Vec<Expected>,
    pub bytes: Range<usize>,
}

impl Trial {
    /// Compares what the driver answered with what is known.
    pub fn judged(&self, all: &[u8]) -> Outcome {
        let bytes = all.get(self.bytes.clone()).unwrap_or_default();
        let words: Vec<u32> = bytes
            .chunks_exact(4)
            .map(bytemuck::pod_read_unaligned)
            .collect();
        let answers = self.expected.len();
        let mut at = 0;
        let mut wrong = 0;
        let mut first = None;
        for Expected { answer, place } in &self.expected {
            let found = words.get(at..).and_then(|words| answer.found(words));
            at += answer.words();
            if found == Some(*answer) {
                continue;
            }
            wrong += 1;
            first.get_or_insert_with(|| Failure {
                place: place.clone(),
                expected: answer.to_string(),
                found: found.map_or_else(|| "nothing".to_owned(), |found| found.to_string()),
                wrong: 0,
                answers,
            });
        }
        match first {
            None => Outcome::Passed { answers },
            Some(failure) => Outcome::Failed(Failure { wrong, ..failure }),
        }
    }
}
