//! Chooses the patches of a frame, and lists the culled entities that may show through each of them.

use antumbra_graph::{BodyError, Host, HostBuilder, HostContext, HostRef};
use rand_pcg::Pcg64Mcg;

use super::patch_frustum;
use super::sample_plan::{PlanInputs, SamplePlan, overhead};
use super::screen_box::ScreenProjector;
use super::strata::Patches;
use super::uncertain::UncertainEntities;
use super::{Audit, AuditOptions, Experience};
use crate::candidates::{Candidates, Queried};
use crate::draw_source::patches::{PatchList, PatchMember};
use crate::entities::{MeshDetail, SceneTable};
use crate::indirect::untested;
use crate::strategy::VerdictSource;
use crate::tree::Tree;
use crate::verdict::{Verdict, Verdicts};
use crate::view::ViewFrame;

/// The triangles a view draws are added up again after this many frames.
const RECOUNT_AFTER: u64 = 16;
/// The part of the candidates' triangles that is assumed to be drawn where that is decided on the GPU and no count is known.
const DRAWN_ON_GPU: f64 = 0.25;

/// The culled entities, as far as the host knows them.
pub(super) enum Culled<'a> {
    Host(HostRef<'a, Verdicts>),
    /// All entities but those that are drawn for certain; the GPU drops the others that are drawn.
    Gpu {
        candidates: HostRef<'a, Candidates>,
        untested: Vec<u32>,
        uncertain: Option<HostRef<'a, UncertainEntities>>,
    },
}

impl Culled<'_> {
    /// Declares that a node reads what was culled.
    pub fn declare(
        node: &mut HostBuilder<'_>,
        source: VerdictSource,
        uncertain: Option<Host<UncertainEntities>>,
    ) {
        if let Some(uncertain) = uncertain {
            node.read(uncertain);
        }
        match source {
            VerdictSource::Host(verdicts) => node.read(verdicts),
            VerdictSource::Gpu {
                candidates,
                queried,
                adapted,
                ..
            } => {
                if let Some(adapted) = adapted {
                    node.read(adapted.allowed);
                }
                node.read(candidates).read(queried)
            }
        };
    }
}

impl<'a> Culled<'a> {
    pub fn of(
        ctx: &HostContext<'a>,
        source: VerdictSource,
        uncertain: Option<Host<UncertainEntities>>,
    ) -> Result<Self, BodyError> {
        Ok(match source {
            VerdictSource::Host(verdicts) => Self::Host(ctx.get(verdicts)?),
            VerdictSource::Gpu {
                candidates,
                queried,
                ..
            } => {
                let candidates = ctx.get(candidates)?;
                let queried: &Queried = &*ctx.get(queried)?;
                let untested = untested(&candidates, queried);
                Self::Gpu {
                    candidates,
                    untested,
                    uncertain: uncertain.map(|uncertain| ctx.get(uncertain)).transpose()?,
                }
            }
        })
    }

    /// Whether an entity may have been culled.
    fn has(&self, slot: u32) -> bool {
        match self {
            Self::Host(verdicts) => !verdicts.get(slot).draws(),
            Self::Gpu {
                candidates,
                untested,
                ..
            } => !candidates.is_exempt(slot) && untested.binary_search(&slot).is_err(),
        }
    }

    /// What the frame left out by its own count, in percent of the image, where the host knows it.
    pub fn left_out(&self) -> Option<f64> {
        match self {
            Self::Host(verdicts) => verdicts.left_out_percent(),
            Self::Gpu { .. } => None,
        }
    }

    /// Entities that are left out although samples of them are visible, as far as the host knows.
    fn uncertain(&self) -> Vec<u32> {
        match self {
            Self::Host(verdicts) => verdicts.of_kind(Verdict::BelowThreshold).collect(),
            Self::Gpu {
                candidates,
                uncertain,
                ..
            } => {
                let left_out = uncertain
                    .iter()
                    .flat_map(|uncertain| uncertain.may_be_left_out(candidates));
                left_out.collect()
            }
        }
    }

    /// Triangles that the view draws.
    fn triangles_drawn(&self, table: &SceneTable) -> f64 {
        let of = |slot: u32, level| f64::from(table.primitives_of(slot, MeshDetail::Level(level)));
        match self {
            Self::Host(verdicts) => {
                let drawn = verdicts.drawn();
                drawn.map(|slot| of(slot, verdicts.level(slot))).sum()
            }
            Self::Gpu {
                candidates,
                uncertain,
                ..
            } => {
                let known = uncertain
                    .as_ref()
                    .and_then(|uncertain| uncertain.drawn(candidates, |slot| of(slot, 0)));
                known.unwrap_or_else(|| {
                    let all = candidates.inside().iter();
                    all.map(|slot| of(*slot, 0)).sum::<f64>() * DRAWN_ON_GPU
                })
            }
        }
    }
}

/// The frame that patches are chosen for.
pub(super) struct ChooserInput<'a> {
    pub table: &'a SceneTable,
    pub view: &'a ViewFrame,
    pub projector: ScreenProjector,
    pub tree: &'a Tree,
    pub culled: &'a Culled<'a>,
    /// The plan's number of the frame.
    pub number: u64,
}

/// Chooses patches; keeps its buffers from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Chooser {
    patches: Patches,
    triangles: Option<f64>,
    stack: Vec<u32>,
    found: Vec<u32>,
    members: Vec<PatchMember>,
}

impl Chooser {
    /// Chooses the patches of a frame.
    pub fn choose(
        &mut self,
        at: &ChooserInput<'_>,
        options: AuditOptions,
        audit: &Audit,
        random: &mut Pcg64Mcg,
    ) -> SamplePlan {
        self.patches.reset(at.view.size);
        if options.census {
            return SamplePlan::all(&self.patches);
        }
        self.patches
            .mark_uncertain(at.table, &at.projector, at.culled.uncertain().into_iter());
        let triangles = match self.triangles {
            Some(known) if !at.number.is_multiple_of(RECOUNT_AFTER) => known,
            _ => at.culled.triangles_drawn(at.table),
        };
        self.triangles = Some(triangles);
        let budget = triangles * options.share;
        let Experience { costs, moments } = audit.experience();
        let known = PlanInputs {
            budget,
            frame_share: options.frame_share_in_range(),
            costs,
            moments,
        };
        SamplePlan::draw(&self.patches, &known, random)
    }

    /// Lists the culled entities that may show in each patch. Returns the cost of finding them, a patch, in triangles.
    pub fn list(
        &mut self,
        at: &ChooserInput<'_>,
        plan: &SamplePlan,
        list: &mut PatchList,
    ) -> Vec<f64> {
        list.clear();
        let mut work = Vec::with_capacity(plan.drawn.len());
        for (patch, _) in &plan.drawn {
            let place = self.patches.place(*patch);
            let frustum = patch_frustum::frustum(at.view, place);
            self.found.clear();
            let nodes = patch_frustum::visit(at.tree, &frustum, &mut self.stack, &mut self.found);
            let culled = self.found.iter().filter(|slot| at.culled.has(**slot));
            let members = culled.filter_map(|slot| {
                let screen_box = at.projector.project(at.table, *slot);
                Some(PatchMember {
                    slot: *slot,
                    cover: at.projector.cover(&screen_box, place)?,
                })
            });
            self.members.clear();
            self.members.extend(members);
            let draws = list.push(at.table, place, &mut self.members);
            work.push(overhead(nodes, self.members.len(), draws));
        }
        work
    }
}
