//! Strategies with one deliberate fault each; some also have a correct form.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use antumbra_cull::{
    CountLayout, Counting, DeclareError, FrameGraph, Latency, MeshDetail, Queried, Samples, Stamp,
    Strategy, Verdict, Verdicts, ViewNodes, VisibleSet,
};
use antumbra_strategies::ThreePass;

/// Culls every third entity, and claims to be conservative.
#[derive(Clone, Copy)]
pub struct Random;

impl Strategy for Random {
    fn name(&self) -> &str {
        "random"
    }

    fn summary(&self) -> &str {
        "culls every third entity"
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
        Ok(g.visible_by(view, inside, |_, _, slot| {
            if slot % 3 == 1 {
                Verdict::Occluded
            } else {
                Verdict::Visible
            }
        }))
    }
}

/// Hardware queries with late answers: correct, unless a field introduces a fault.
#[derive(Clone, Copy, Default)]
pub struct Late {
    /// Uses answers from before a camera cut.
    pub trusts_across_cuts: bool,
    /// Uses answers about the former occupant of a slot.
    pub trusts_across_births: bool,
    /// Culls each visible entity in a slot below this one as soon as an answer covers it: an error that persists.
    pub threshold: u32,
}

#[derive(Default)]
struct Latest {
    samples: Samples,
    asked: Option<Stamp>,
}

impl Strategy for Late {
    fn name(&self) -> &str {
        "late"
    }

    fn summary(&self) -> &str {
        "uses last frame's queries"
    }

    fn conservative(&self) -> bool {
        false
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::FrameLate)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let Self {
            trusts_across_cuts,
            trusts_across_births,
            threshold,
        } = *self;
        let inside = g.in_frustum(view);
        let proxies = g.proxies(view, inside, MeshDetail::Level(0), MeshDetail::Level(0));
        let counts = g.count_samples(view, proxies, Counting::Queries, view.size());
        let latest = g.graph().host::<Latest>(view.named("latest"));
        let mut node = g.graph().host_node(view.named("read previous results"));
        let answers = node.read_previous(counts.buffer, counts.queried);
        let latest = node.updates(latest);
        node.run(move |ctx| {
            if let Some(answer) = ctx.late(answers) {
                let asked: &Queried = answer.tag;
                let mut latest = ctx.get_mut(latest)?;
                latest.samples.take(asked, counts.layout, answer.bytes);
                latest.asked = Some(asked.stamp);
            }
            Ok(())
        });
        let chosen = g.choose(
            view,
            |node| {
                node.read(inside).read(latest);
            },
            move |ctx, table, _, verdicts| {
                let (inside, latest) = (ctx.get(inside)?, ctx.get(latest)?);
                let now = inside.stamp();
                let asked = latest
                    .asked
                    .filter(|asked| trusts_across_cuts || asked.cuts == now.cuts);
                for slot in inside.inside() {
                    let born = table.occupant(*slot).unwrap().added_epoch;
                    let known = asked.filter(|asked| trusts_across_births || born <= asked.epoch);
                    let verdict = match known.and(latest.samples.get(*slot)) {
                        _ if inside.is_near(*slot) => Verdict::Untested,
                        None => Verdict::Untested,
                        Some(0) => Verdict::Occluded,
                        Some(_) if *slot < threshold => Verdict::BelowThreshold,
                        Some(_) => Verdict::Visible,
                    };
                    verdicts.set(*slot, verdict);
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}

/// Tests boxes against the depth of all entities, with answers in the same frame.
#[derive(Clone, Copy)]
pub struct BoxTest {
    /// Whether entities that cross the near plane are drawn untested, as they must be.
    pub knows_near: bool,
}

impl Strategy for BoxTest {
    fn name(&self) -> &str {
        "box-test"
    }

    fn summary(&self) -> &str {
        "tests boxes within the frame"
    }

    fn conservative(&self) -> bool {
        false
    }

    fn latency(&self) -> Option<Latency> {
        Some(Latency::SameFrame)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let knows_near = self.knows_near;
        let inside = g.in_frustum(view);
        let proxies = g.proxies(view, inside, MeshDetail::Level(0), MeshDetail::Box);
        let counts = g.count_samples(view, proxies, Counting::Queries, view.size());
        let chosen = g.choose(
            view,
            |node| {
                node.read(inside)
                    .read(counts.queried)
                    .read_back(counts.buffer);
            },
            move |ctx, _, _, verdicts| {
                let mut samples = Samples::default();
                let bytes = ctx.bytes(counts.buffer)?;
                samples.take(&*ctx.get(counts.queried)?, CountLayout::ByQuery, bytes);
                let inside = ctx.get(inside)?;
                for slot in inside.inside() {
                    let verdict = match samples.get(*slot) {
                        _ if knows_near && inside.is_near(*slot) => Verdict::Untested,
                        Some(0) => Verdict::Occluded,
                        _ => Verdict::Visible,
                    };
                    verdicts.set(*slot, verdict);
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}

/// Culls every third entity, and reports all of them as drawn.
#[derive(Clone, Copy)]
pub struct Liar;

impl Strategy for Liar {
    fn name(&self) -> &str {
        "liar"
    }

    fn summary(&self) -> &str {
        "draws less than it says"
    }

    fn conservative(&self) -> bool {
        false
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        Random.declare(g, view)?;
        let inside = g.in_frustum(view);
        let scene = view.inputs().scene;
        let said = g.graph().host::<Verdicts>(view.named("said"));
        let mut node = g.graph().host_node(view.named("lie"));
        node.read(scene).read(inside);
        let said = node.write(said);
        node.run(move |ctx| {
            let mut said = ctx.get_mut(said)?;
            said.reset_outside(&ctx.get(scene)?.table);
            for slot in ctx.get(inside)?.inside() {
                said.set(*slot, Verdict::Untested);
            }
            Ok(())
        });
        Ok(VisibleSet::drawn(said))
    }
}

/// Alternates between two verdicts from frame to frame, across all its instances.
#[derive(Clone, Default)]
pub struct Moody {
    frames: Arc<AtomicU32>,
}

impl Strategy for Moody {
    fn name(&self) -> &str {
        "moody"
    }

    fn summary(&self) -> &str {
        "gives other verdicts each frame"
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
        let frames = Arc::clone(&self.frames);
        let chosen = g.choose(
            view,
            |node| {
                node.read(inside);
            },
            move |ctx, _, _, verdicts| {
                let frame = frames.fetch_add(1, Ordering::Relaxed);
                verdicts.add_tested(frame);
                let mood = match frame % 2 {
                    0 => Verdict::Untested,
                    _ => Verdict::New,
                };
                for slot in ctx.get(inside)?.inside() {
                    verdicts.set(*slot, mood);
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}

/// Panics when it declares its nodes.
#[derive(Clone, Copy)]
pub struct Panics;

impl Strategy for Panics {
    fn name(&self) -> &str {
        "panics"
    }

    fn summary(&self) -> &str {
        "panics"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        _: &mut FrameGraph<'_>,
        _: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        panic!("on purpose")
    }
}

/// Culls entities smaller than a millimetre, or than a ten-thousandth of a radian: correct for most scenes and cameras, but not for all.
#[derive(Clone)]
pub enum Small {
    Metres,
    Radians,
}

impl Strategy for Small {
    fn name(&self) -> &str {
        "small"
    }

    fn summary(&self) -> &str {
        "culls what seems too small to be seen"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let candidates = g.in_frustum(view);
        let by = self.clone();
        Ok(g.visible_by(view, candidates, move |table, view, slot| {
            let bounds = table.bounds(slot);
            let size = bounds.half_extents().length();
            let seen = match by {
                Self::Metres => size > 1e-3,
                Self::Radians => size > 1e-4 * bounds.centre().distance(view.camera.position),
            };
            match seen {
                true => Verdict::Visible,
                false => Verdict::BelowThreshold,
            }
        }))
    }
}

/// Claims to be conservative. With several samples a pixel it tests an image of half the size: that has as many samples, elsewhere.
#[derive(Clone, Copy)]
pub struct AsManySamples;

impl Strategy for AsManySamples {
    fn name(&self) -> &str {
        "as many samples"
    }

    fn summary(&self) -> &str {
        "tests an image of half the size with four samples a pixel"
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
        let full = MeshDetail::Level(0);
        let proxies = g.proxies(view, inside, full, full);
        let side = if g.samples() > 1 { 2 } else { 1 };
        let size = view.size().map(|pixels| pixels / side);
        let counts = g.count_samples(view, proxies, Counting::Identity, size);
        Ok(g.visible_samples(view, inside, counts, Latency::SameFrame, 0))
    }
}

/// Claims to be conservative at any `scale`, also where its test image has a quarter of the view's width and height.
#[derive(Clone)]
pub struct Coarse(pub ThreePass);

impl Strategy for Coarse {
    fn name(&self) -> &str {
        "coarse"
    }

    fn summary(&self) -> &str {
        "tests every fourth pixel"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        self.0.declare(g, view)
    }
}
