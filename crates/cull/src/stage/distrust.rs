//! What a stage does when the driver is wrong: which capability or which frame gave it away, and what is done instead.

use std::fmt;

use crate::audit::Estimate;
use crate::counting::Counting;
use crate::self_test::{Capability, Failure};

/// What a stage does to find out whether the driver can be believed. Either may be turned off by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DistrustOptions {
    /// Whether what the strategy relies on is [tried](crate::Gpu::self_test) when a stage is made, which submits and waits; what was tried on the device before is known. What is found
    /// wrong is not used. A stage with a budget tries everything. Yardsticks rely on nothing.
    pub self_test: bool,
    /// Whether a stage that audits itself ([`StageOptions::audit`](crate::StageOptions::audit)) goes over to `frustum` when an audit finds a wrong pixel although the strategy
    /// [is conservative](crate::Strategy::conservative). Aggressive settings and answers that are a frame late may be wrong, and trip nothing.
    pub trip_wire: bool,
}

impl DistrustOptions {
    /// The driver is believed: for what measures strategies as they are.
    pub const OFF: Self = Self {
        self_test: false,
        trip_wire: false,
    };
}

impl Default for DistrustOptions {
    /// Both.
    fn default() -> Self {
        Self {
            self_test: true,
            trip_wire: true,
        }
    }
}

/// The driver was found wrong, and the stage does something else.
#[derive(Debug, Clone, PartialEq)]
pub struct Distrust {
    /// The strategy that relied on the driver.
    pub strategy: String,
    /// The first frame, as the stage counts them, that is drawn otherwise.
    pub from_frame: u64,
    /// What was found.
    pub cause: DistrustCause,
    /// What is done instead.
    pub instead: Instead,
}

/// How a driver was found wrong.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum DistrustCause {
    /// The self-test found a capability wrong that the strategy relies on.
    SelfTest {
        /// The capability.
        capability: Capability,
        /// The first wrong answer.
        failure: Failure,
    },
    /// An audit found pixels wrong in a frame of a conservative strategy, which has none.
    Audit {
        /// The view.
        view: String,
        /// The frame, as the stage counts them.
        frame: u64,
        /// How many pixels are wrong, in percent of the view's.
        wrong_pixels_percent: Estimate,
    },
}

/// What is done instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Instead {
    /// The strategy stays, and samples are counted in another way.
    Counting(Counting),
    /// [`FrustumOnly`](crate::FrustumOnly) draws, which culls nothing that is in the view. A budget has no more steps.
    Frustum,
}

impl fmt::Display for DistrustCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SelfTest {
                capability,
                failure,
            } => write!(f, "the driver gets {capability} wrong: {failure}"),
            Self::Audit {
                view,
                frame,
                wrong_pixels_percent,
            } => write!(
                f,
                "an audit of frame {frame} of view '{view}' found wrong pixels, about {:.3} % of the image, and the strategy is conservative",
                wrong_pixels_percent.percent
            ),
        }
    }
}

impl fmt::Display for Distrust {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            strategy,
            from_frame,
            cause,
            instead,
        } = self;
        match instead {
            Instead::Counting(way) => write!(
                f,
                "strategy '{strategy}' counts by {way} from frame {from_frame} on: {cause}"
            ),
            Instead::Frustum => write!(
                f,
                "'frustum' replaces strategy '{strategy}' from frame {from_frame} on: {cause}"
            ),
        }
    }
}
