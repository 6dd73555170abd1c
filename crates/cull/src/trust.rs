//! What a stage knows of the driver while a strategy is declared: ways of counting that are found wrong are replaced by proven ones, and what a strategy relies on is noted.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::counting::Counting;
use crate::frame_graph::FrameGraph;
use crate::self_test::{Capability, SelfTestReport};

/// What is known of the driver, and what the strategy makes of it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Trust {
    /// What the self-test found; `None`: everything is believed.
    pub report: Option<Arc<SelfTestReport>>,
    /// What the declared nodes rely on.
    pub relied: BTreeSet<Capability>,
    /// Ways of counting that are wrong, and what is done instead.
    pub replaced: BTreeSet<Replaced>,
}

/// A way of counting that another replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Replaced {
    pub wrong: Counting,
    pub instead: Counting,
}

impl Trust {
    /// By this report.
    pub fn by(report: Option<Arc<SelfTestReport>>) -> Self {
        Self {
            report,
            ..Self::default()
        }
    }

    /// Whether a capability is known to be wrong.
    pub fn is_wrong(&self, capability: Capability) -> bool {
        let report = self.report.as_ref();
        report.is_some_and(|report| report.has_failed(capability))
    }

    /// What the nodes rely on although it is wrong.
    pub fn betrayed(&self) -> Vec<Capability> {
        let relied = self.relied.iter().copied();
        relied.filter(|relied| self.is_wrong(*relied)).collect()
    }
}

impl FrameGraph<'_> {
    /// Notes that what is declared relies on a capability.
    pub(crate) fn relies_on(&mut self, capability: Capability) {
        self.shared.trust.relied.insert(capability);
    }

    /// This way of counting, or the first of the others that is proven where this one is known to be wrong.
    pub(crate) fn believed(&mut self, way: Counting, others: &[Counting]) -> Counting {
        let trust = &mut self.shared.trust;
        let Some(report) = &trust.report else {
            return way;
        };
        if !report.has_failed(Capability::of(way)) {
            return way;
        }
        let mut others = others.iter().copied();
        let proven = others.find(|other| report.has_proven(Capability::of(*other)));
        let Some(instead) = proven else {
            return way;
        };
        trust.replaced.insert(Replaced {
            wrong: way,
            instead,
        });
        instead
    }

    /// Whether an audit of this view would be true.
    pub(crate) fn can_audit(&self) -> bool {
        let trust = &self.shared.trust;
        let fragments = [Capability::FragmentAtomics, Capability::FragmentCompare];
        !trust.is_wrong(Capability::IndirectFirstInstance)
            && !fragments.iter().all(|way| trust.is_wrong(*way))
    }
}
