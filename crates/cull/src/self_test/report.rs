//! What a self-test found, capability by capability, in words that a person understands.

use std::fmt;

use crate::counting::Counting;

/// Something that strategies need of a driver, and that a self-test tries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Capability {
    /// Fragments that pass a forced early depth test are counted by atomics: [`Counting::Atomics`].
    FragmentAtomics,
    /// Fragments that compare their depth in the shader are counted: [`Counting::Compare`].
    FragmentCompare,
    /// Entity ids are drawn, and a histogram counts the samples of each: [`Counting::Identity`].
    IdHistogram,
    /// Hardware occlusion queries: [`Counting::Queries`].
    OcclusionQueries,
    /// The depth pyramid: each level is made of this frame's depth, at its place.
    DepthPyramid,
    /// Boxes are tested against the depth and its pyramid.
    BoxTest,
    /// Visible entities are compacted into lists, and indirect draws are written for them.
    Compaction,
    /// Indirect draws that begin at other instances than the first.
    IndirectFirstInstance,
}

impl Capability {
    /// All of them, in the order of a report.
    pub const ALL: [Self; 8] = [
        Self::FragmentAtomics,
        Self::FragmentCompare,
        Self::IdHistogram,
        Self::OcclusionQueries,
        Self::DepthPyramid,
        Self::BoxTest,
        Self::Compaction,
        Self::IndirectFirstInstance,
    ];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::FragmentAtomics => "counting by atomics",
            Self::FragmentCompare => "counting by compare",
            Self::IdHistogram => "counting by identity",
            Self::OcclusionQueries => "occlusion queries",
            Self::DepthPyramid => "depth pyramid",
            Self::BoxTest => "box tests",
            Self::Compaction => "compaction",
            Self::IndirectFirstInstance => "indirect draws with first instance",
        }
    }

    /// What a way of counting needs.
    pub fn of(way: Counting) -> Self {
        match way {
            Counting::Queries => Self::OcclusionQueries,
            Counting::Atomics => Self::FragmentAtomics,
            Counting::Compare => Self::FragmentCompare,
            Counting::Identity => Self::IdHistogram,
        }
    }
}

impl fmt::Display for Capability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a self-test found about a capability.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// Every answer was right.
    Passed {
        /// The number of answers.
        answers: usize,
    },
    /// The driver answers wrongly.
    Failed(Failure),
    /// The device does not offer it; what it lacks.
    NotAvailable(String),
}

/// A wrong answer of a driver.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Which answer: the first wrong one.
    pub place: String,
    /// What it should have been.
    pub expected: String,
    /// What the driver said.
    pub found: String,
    /// The number of wrong answers.
    pub wrong: usize,
    /// Out of so many.
    pub answers: usize,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            place,
            expected,
            found,
            wrong,
            answers,
        } = self;
        write!(
            f,
            "{place}: expected {expected}, found {found} ({wrong} of {answers} answers are wrong)"
        )
    }
}

/// What a self-test of a device found: one outcome a capability.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SelfTestReport {
    /// The samples a pixel that it tested with.
    pub samples: u32,
    /// The outcomes, in the order of [`Capability::ALL`].
    pub outcomes: Vec<(Capability, Outcome)>,
}

impl SelfTestReport {
    /// What was found about a capability.
    pub fn outcome(&self, capability: Capability) -> Option<&Outcome> {
        let mut outcomes = self.outcomes.iter();
        outcomes
            .find(|(tested, _)| *tested == capability)
            .map(|(_, outcome)| outcome)
    }

    /// The capabilities that the driver gets wrong, with the first wrong answer of each.
    pub fn failures(&self) -> impl Iterator<Item = (Capability, &Failure)> {
        self.outcomes.iter().filter_map(|(capability, outcome)| {
            let Outcome::Failed(failure) = outcome else {
                return None;
            };
            Some((*capability, failure))
        })
    }

    /// Whether every answer was right.
    pub fn passed(&self) -> bool {
        self.failures().next().is_none()
    }

    /// Whether the driver gets a capability wrong.
    pub(crate) fn has_failed(&self, capability: Capability) -> bool {
        matches!(self.outcome(capability), Some(Outcome::Failed(_)))
    }

    /// Whether every answer of a capability was right.
    pub(crate) fn has_proven(&self, capability: Capability) -> bool {
        matches!(self.outcome(capability), Some(Outcome::Passed { .. }))
    }
}

impl fmt::Display for SelfTestReport {
    /// A line a capability.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, (capability, outcome)) in self.outcomes.iter().enumerate() {
            if number > 0 {
                writeln!(f)?;
            }
            match outcome {
                Outcome::Passed { answers } => {
                    write!(f, "{capability}: passed ({answers} answers)")?;
                }
                Outcome::Failed(failure) => write!(f, "{capability}: FAILED. {failure}")?,
                Outcome::NotAvailable(lacking) => {
                    write!(f, "{capability}: not available, it lacks {lacking}")?;
                }
            }
        }
        Ok(())
    }
}
