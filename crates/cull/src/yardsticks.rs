//! The yardsticks that every strategy is measured against: everything, the frustum, and the ideal that no strategy can beat. They cull nothing by
//! occlusion and are always right, so that a stage can fall back to [`FrustumOnly`], and the kit and the harness need no other crate to measure by.

use crate::frame_graph::FrameGraph;
use crate::strategy::{DeclareError, Role, Strategy, VisibleSet};
use crate::verdict::Verdict;
use crate::view_nodes::ViewNodes;

/// Draws everything, in the frustum or not: what culling has to beat.
#[derive(Debug, Clone, Copy, Default)]
pub struct Everything;

impl Strategy for Everything {
    fn name(&self) -> &str {
        "none"
    }

    fn summary(&self) -> &str {
        "draws every entity"
    }

    fn role(&self) -> Role {
        Role::Everything
    }

    fn conservative(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let all = g.everything(view);
        Ok(g.visible_by(view, all, |_, _, _| Verdict::Untested))
    }
}

/// Draws what touches the frustum.
#[derive(Debug, Clone, Copy, Default)]
pub struct FrustumOnly;

impl Strategy for FrustumOnly {
    fn name(&self) -> &str {
        "frustum"
    }

    fn summary(&self) -> &str {
        "draws what touches the frustum"
    }

    fn role(&self) -> Role {
        Role::Frustum
    }

    fn conservative(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let inside = g.in_frustum(view);
        Ok(g.visible_by(view, inside, |_, _, _| Verdict::Untested))
    }
}

/// Draws exactly the entities that own a pixel, known beforehand and for free: the limit of every strategy, to measure by.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ideal;

impl Strategy for Ideal {
    fn name(&self) -> &str {
        "ideal"
    }

    fn summary(&self) -> &str {
        "draws what is known to own a pixel, for free"
    }

    fn role(&self) -> Role {
        Role::Ideal
    }

    fn conservative(&self) -> bool {
        true
    }

    fn needs_reference(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let Some(reference) = view.reference() else {
            return Err(DeclareError::Settings {
                strategy: "ideal".to_owned(),
                conflict: "it must be told which entities own a pixel; run it in a comparison"
                    .to_owned(),
            });
        };
        let chosen = g.choose(
            view,
            |node| {
                node.read(reference);
            },
            move |ctx, table, _, verdicts| {
                // Whether an entity is outside or hidden it is not told; no sample of it is visible either way.
                for slot in table.live_slots() {
                    verdicts.set(slot, Verdict::Occluded);
                }
                for slot in ctx
                    .get(reference)?
                    .iter()
                    .filter(|slot| table.occupant(**slot).is_some())
                {
                    verdicts.set(*slot, Verdict::Visible);
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}
