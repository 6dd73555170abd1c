//! One strategy before another: what the outer one leaves of the frustum is all that the inner one judges, draws and asks about.
//!
//! To the inner one nothing has changed: its [`FrameGraph::in_frustum`] is the narrower list, and who was taken out of it is outside as if
//! the frustum were narrower. What it remembers of them is worth what it is of any that leave the frustum and come back.

use antumbra_graph::{BodyError, Host, HostBuilder, HostContext};

use crate::candidates::Candidates;
use crate::frame_graph::FrameGraph;
use crate::strategy::{DeclareError, Strategy, VisibleSet};
use crate::verdict::{Verdict, Verdicts};
use crate::view_nodes::ViewNodes;

/// What one strategy handed on to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HandedOn {
    /// What lies in the frustum.
    pub inside: Host<Candidates>,
    /// What was left of it.
    pub left: Host<Candidates>,
}

impl HandedOn {
    /// Declares that a node wants to know who was taken away.
    pub fn read(&self, node: &mut HostBuilder<'_>) {
        node.read(self.inside).read(self.left);
    }

    /// Says of all who were taken away that they are occluded, whatever was said of them before.
    pub fn hide(&self, ctx: &HostContext<'_>, verdicts: &mut Verdicts) -> Result<(), BodyError> {
        hide(&*ctx.get(self.inside)?, &*ctx.get(self.left)?, verdicts);
        Ok(())
    }
}

/// The same with the lists at hand.
pub(crate) fn hide(inside: &Candidates, left: &Candidates, verdicts: &mut Verdicts) {
    for slot in inside.without(left) {
        verdicts.set(slot, Verdict::Occluded);
    }
}

impl FrameGraph<'_> {
    /// Has another strategy judge what is left of the candidates: `left` is [narrowed](Self::narrowed) from
    /// [`in_frustum`](Self::in_frustum) of this view, with all kept that no test may judge ([`Candidates::exempt`]). What was taken away is
    /// neither drawn nor asked about, and its verdict is [`Verdict::Occluded`].
    ///
    /// The combination is conservative where both are, waits where the inner one does, and needs a reference where the inner one does.
    ///
    /// # Errors
    /// As the inner strategy's [`declare`](Strategy::declare).
    pub fn hand_on(
        &mut self,
        view: &mut ViewNodes,
        left: Host<Candidates>,
        inner: &mut dyn Strategy,
    ) -> Result<VisibleSet, DeclareError> {
        let inside = match view.handed_on {
            Some(outer) => outer.inside,
            None => self.in_frustum(view),
        };
        let handed_on = HandedOn { inside, left };
        let before = (view.in_frustum, view.handed_on);
        (view.in_frustum, view.handed_on) = (Some(left), Some(handed_on));
        let declared = inner.declare(self, view);
        (view.in_frustum, view.handed_on) = before;
        let set = declared?;
        // Of several one after the other the innermost was left the least.
        Ok(VisibleSet {
            handed_on: set.handed_on.or(Some(handed_on)),
            ..set
        })
    }
}
