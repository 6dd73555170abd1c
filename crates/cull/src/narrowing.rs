//! One strategy before another: what the first one leaves of the frustum is all that the next one judges, draws and queries.
//!
//! The next strategy does not notice: its [`FrameGraph::in_frustum`] is the narrower list, as if the frustum were narrower. What it remembers of the entities
//! that were taken out is treated like its memory of entities that leave the frustum and come back.

use antumbra_graph::{BodyError, Host, HostBuilder, HostContext};

use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::strategy::{DeclareError, Strategy, VisibleSet};
use crate::verdict::{Verdict, Verdicts};
use crate::view_nodes::ViewNodes;

/// The candidates of a view before and after an outer strategy narrowed them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Narrowing {
    /// All in the frustum.
    pub inside: Host<Candidates>,
    /// Those left to the next strategy.
    pub left: Host<Candidates>,
}

impl Narrowing {
    /// Declares that a node reads both lists.
    pub fn read(&self, node: &mut HostBuilder<'_>) {
        node.read(self.inside).read(self.left);
    }

    /// Gives the entities that were taken out the verdict occluded.
    pub fn hide(&self, ctx: &HostContext<'_>, verdicts: &mut Verdicts) -> Result<(), BodyError> {
        hide(&*ctx.get(self.inside)?, &*ctx.get(self.left)?, verdicts);
        Ok(())
    }
}

/// The same for two lists.
pub(crate) fn hide(inside: &Candidates, left: &Candidates, verdicts: &mut Verdicts) {
    for slot in inside.without(left) {
        verdicts.set(slot, Verdict::Occluded);
    }
}

impl FrameGraph<'_> {
    /// Lets the next strategy judge the candidates that this one leaves. `left` is [narrowed](Self::narrowed) from [`in_frustum`](Self::in_frustum) of this view
    /// and keeps all candidates that no test may judge ([`Candidates::exempt`]). Entities that were taken out are neither drawn nor queried; their verdict is
    /// [`Verdict::Occluded`].
    ///
    /// The chain is conservative if both strategies are. It has sync points, and needs a reference, if the next strategy does.
    ///
    /// # Errors
    /// As the next strategy's [`declare`](Strategy::declare).
    pub fn chain(
        &mut self,
        view: &mut ViewNodes,
        left: Host<Candidates>,
        next: &mut dyn Strategy,
    ) -> Result<VisibleSet, DeclareError> {
        let inside = match view.narrowing {
            Some(outer) => outer.inside,
            None => self.in_frustum(view),
        };
        let narrowing = Narrowing { inside, left };
        let before = (view.in_frustum, view.narrowing);
        (view.in_frustum, view.narrowing) = (Some(left), Some(narrowing));
        let declared = next.declare(self, view);
        (view.in_frustum, view.narrowing) = before;
        let set = declared?;
        // In a chain of several the innermost list is the narrowest.
        Ok(VisibleSet {
            narrowing: set.narrowing.or(Some(narrowing)),
            ..set
        })
    }
}
