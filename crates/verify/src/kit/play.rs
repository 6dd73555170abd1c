//! A play: a scene, the strategy under test, and the oracle beside it. Every frame is judged before the next begins.

use std::collections::HashSet;
use std::sync::Arc;

use antumbra_draw::{Gpu, GpuScene, ViewFrame, read_back};
use antumbra_scene::{Camera, EntityKey, Scene};

use super::Kit;
use super::failure::ViolationKind;
use crate::oracle::{EntitySet, IdBuffer, Oracle};
use antumbra_cull::{
    Candidates, Ideal, Latency, Stage, StageOptions, Strategy, Verdict, Verdicts, ViewInput,
    ViewSpec,
};

/// What a case works with, and how far it has come.
pub(super) struct Bench<'k> {
    pub kit: &'k Kit,
    pub gpu: &'k Gpu,
    pub make: &'k dyn Fn() -> Box<dyn Strategy>,
    /// The present frame of the present play.
    pub frame: u32,
    /// Frames judged in all.
    pub frames: u32,
}

/// A strategy at play on a scene.
pub(super) struct Play<'b, 'k> {
    bench: &'b mut Bench<'k>,
    /// Change it between frames.
    pub scene: Scene,
    gpu_scene: GpuScene,
    stage: Stage,
    /// Draws what it is told to.
    told: Stage,
    oracle: Oracle,
    claims: Claims,
    /// A view: who has been in its frustum since the last cut.
    seen: Vec<HashSet<(u32, EntityKey)>>,
    next: u32,
    /// Frames since something changed, and the verdicts of the last one.
    still: u32,
    last: Vec<Verdicts>,
    /// The verdicts of all frames and views.
    pub history: Vec<Verdicts>,
}

#[derive(Debug, Clone, Copy)]
struct Claims {
    conservative: bool,
    late: bool,
    needs_reference: bool,
}

/// What was seen of one view before the strategy had its turn.
struct Reference {
    image: IdBuffer,
    owners: Arc<Vec<u32>>,
    candidates: Candidates,
}

impl<'b, 'k> Play<'b, 'k> {
    /// Opens a scene with one view.
    pub fn new(bench: &'b mut Bench<'k>, scene: Scene) -> Result<Self, ViolationKind> {
        Self::with_views(bench, scene, &["main"])
    }

    /// Opens a scene with views of these names.
    pub fn with_views(
        bench: &'b mut Bench<'k>,
        mut scene: Scene,
        names: &[&str],
    ) -> Result<Self, ViolationKind> {
        let gpu_scene = GpuScene::new(bench.gpu, &mut scene)?;
        let specs: Vec<ViewSpec> = names
            .iter()
            .map(|name| ViewSpec {
                name: (*name).to_owned(),
                size: bench.kit.size,
            })
            .collect();
        let strategy = (bench.make)();
        let claims = Claims {
            conservative: strategy.conservative(),
            late: strategy.latency() == Some(Latency::FrameLate),
            needs_reference: strategy.needs_reference(),
        };
        let options = StageOptions::default();
        bench.frame = 0;
        Ok(Self {
            stage: Stage::new(&gpu_scene, strategy, specs.clone(), options.clone())?,
            told: Stage::new(&gpu_scene, Box::new(Ideal), specs, options)?,
            oracle: Oracle::new(&gpu_scene, bench.kit.size),
            seen: vec![HashSet::new(); names.len()],
            next: 0,
            still: 0,
            last: Vec::new(),
            history: Vec::new(),
            bench,
            scene,
            gpu_scene,
            claims,
        })
    }

    /// Plays a frame of one view.
    pub fn frame(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        self.frames(&[(*camera, false)])
    }

    /// Plays a frame of one view right after the camera jumped.
    pub fn cut(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        self.frames(&[(*camera, true)])
    }

    /// Plays a frame in which nothing changed since the last, which may be one too few for late answers to settle.
    pub fn still(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        let before = std::mem::take(&mut self.last);
        let still = self.still + 1;
        self.frame(camera)?;
        self.still = still;
        let agree = before.iter().zip(&self.last).all(|(a, b)| a.agree(b));
        if still > self.bench.kit.settle_frames && !agree {
            return Err(ViolationKind::Unsettled { frames: still });
        }
        let slots = self.history.len();
        if still >= self.bench.kit.settle_frames && self.bench.kit.exact_when_still && slots > 0 {
            let reference = self
                .oracle
                .render(&self.gpu_scene, camera, EntitySet::InFrustum)?;
            let slots = undrawn(&self.last, &reference.owners());
            if !slots.is_empty() {
                return Err(ViolationKind::StillFalseCull {
                    frames: still,
                    slots,
                });
            }
        }
        Ok(())
    }

    /// Plays a frame of all views: each a camera, and whether it jumped.
    pub fn frames(&mut self, views: &[(Camera, bool)]) -> Result<(), ViolationKind> {
        self.bench.frame = self.next;
        self.next += 1;
        self.still = 0;
        self.gpu_scene.sync(&mut self.scene)?;
        let references = views
            .iter()
            .map(|(camera, _)| self.look(camera))
            .collect::<Result<Vec<_>, _>>()?;
        let inputs: Vec<ViewInput<'_>> = views
            .iter()
            .zip(&references)
            .map(|((camera, cut), reference)| ViewInput {
                cut: *cut,
                reference: self
                    .claims
                    .needs_reference
                    .then(|| Arc::clone(&reference.owners)),
                ..ViewInput::new(*camera)
            })
            .collect();
        self.stage.frame(&self.gpu_scene, &inputs)?;
        // Answers have arrived when the next frame asks for them: plays come out the same each time.
        self.bench.gpu.wait()?;
        self.last = (0..views.len())
            .map(|view| self.stage.verdicts(view, &self.gpu_scene))
            .collect::<Result<_, _>>()?;
        self.history.extend(self.last.iter().cloned());
        for (view, ((camera, cut), reference)) in views.iter().zip(&references).enumerate() {
            if *cut && let Some(seen) = self.seen.get_mut(view) {
                seen.clear();
            }
            self.judge(view, camera, reference)?;
        }
        self.compare_pictures(views, &references)?;
        self.bench.frames += 1;
        Ok(())
    }

    fn look(&mut self, camera: &Camera) -> Result<Reference, ViolationKind> {
        let image = self
            .oracle
            .render(&self.gpu_scene, camera, EntitySet::InFrustum)?;
        let mut candidates = Candidates::default();
        let frame = ViewFrame::new(*camera, self.bench.kit.size, 0);
        candidates.find(self.gpu_scene.table(), &frame);
        Ok(Reference {
            owners: Arc::new(image.owners()),
            image,
            candidates,
        })
    }

    fn judge(
        &mut self,
        view: usize,
        camera: &Camera,
        reference: &Reference,
    ) -> Result<(), ViolationKind> {
        let Some(verdicts) = self.last.get(view) else {
            return Ok(());
        };
        let missed = undrawn(std::slice::from_ref(verdicts), &reference.owners);
        let near: Vec<u32> = missed
            .iter()
            .copied()
            .filter(|slot| reference.candidates.is_near(*slot))
            .collect();
        if !near.is_empty() {
            return Err(ViolationKind::NearPlane { slots: near });
        }
        if self.claims.late {
            self.judge_coverage(view, verdicts, reference, &missed)?;
        }
        if self.claims.conservative && !missed.is_empty() {
            let image = self
                .oracle
                .render(&self.gpu_scene, camera, EntitySet::Drawn(verdicts))?;
            return Err(ViolationKind::FalseCull {
                slots: missed,
                pixels: image.wrong_pixels(&reference.image),
            });
        }
        self.contradictions(verdicts, reference)?;
        if let Some(seen) = self.seen.get_mut(view) {
            let table = self.gpu_scene.table();
            let inside = reference.candidates.inside().iter();
            seen.extend(inside.filter_map(|slot| Some((*slot, table.occupant(*slot)?.key))));
        }
        Ok(())
    }

    /// No answer can be about what has not been in the frustum before, in this slot, since the cut.
    fn judge_coverage(
        &self,
        view: usize,
        verdicts: &Verdicts,
        reference: &Reference,
        missed: &[u32],
    ) -> Result<(), ViolationKind> {
        let table = self.gpu_scene.table();
        let covered = |slot: &u32| {
            let who = table.occupant(*slot).map(|occupant| (*slot, occupant.key));
            who.is_some_and(|who| self.seen.get(view).is_some_and(|seen| seen.contains(&who)))
        };
        let slots: Vec<u32> = missed.iter().copied().filter(|s| !covered(s)).collect();
        if !slots.is_empty() {
            return Err(ViolationKind::CulledWithoutAnswer { slots });
        }
        let inside = reference.candidates.inside().iter().copied();
        let slots: Vec<u32> = inside
            .filter(|slot| !covered(slot) && verdicts.get(*slot) == Verdict::Visible)
            .collect();
        if slots.is_empty() {
            Ok(())
        } else {
            Err(ViolationKind::VisibleWithoutAnswer { slots })
        }
    }

    fn contradictions(
        &self,
        verdicts: &Verdicts,
        reference: &Reference,
    ) -> Result<(), ViolationKind> {
        let table = self.gpu_scene.table();
        let inside = |slot: u32| reference.candidates.inside().binary_search(&slot).is_ok();
        let owns = |slot: u32| reference.owners.binary_search(&slot).is_ok();
        for slot in 0..table.slots() {
            let verdict = verdicts.get(slot);
            let live = table.occupant(slot).is_some();
            let fact = match verdict {
                Verdict::Absent if live => "an entity lives in it",
                Verdict::Absent => continue,
                _ if !live => "nobody lives in it",
                Verdict::OutsideFrustum if owns(slot) => "it owns a pixel",
                Verdict::Visible if !inside(slot) => "it lies outside the frustum",
                _ => continue,
            };
            return Err(ViolationKind::Contradiction {
                slot,
                verdict: verdict.word(),
                fact,
            });
        }
        Ok(())
    }

    /// The strategy's picture against that of drawing everything, or of drawing what it says it drew.
    fn compare_pictures(
        &mut self,
        views: &[(Camera, bool)],
        references: &[Reference],
    ) -> Result<(), ViolationKind> {
        let conservative = self.claims.conservative;
        let inputs: Vec<ViewInput<'_>> = views
            .iter()
            .zip(references)
            .zip(&self.last)
            .map(|(((camera, _), reference), verdicts)| ViewInput {
                reference: Some(Arc::new(if conservative {
                    reference.candidates.inside().to_vec()
                } else {
                    verdicts.drawn().collect()
                })),
                ..ViewInput::new(*camera)
            })
            .collect();
        self.told.frame(&self.gpu_scene, &inputs)?;
        for view in 0..views.len() {
            let (Some(theirs), Some(ours)) = (self.stage.colour(view), self.told.colour(view))
            else {
                return Err(ViolationKind::Failed(format!("view {view} has no picture")));
            };
            let theirs = read_back::texture(self.bench.gpu, theirs)?;
            let ours = read_back::texture(self.bench.gpu, ours)?;
            let texels = theirs
                .as_chunks::<4>()
                .0
                .iter()
                .zip(ours.as_chunks::<4>().0);
            let mut differing = texels.enumerate().filter(|(_, (a, b))| a != b);
            if let Some((at, _)) = differing.next() {
                let at = at as u32;
                let width = self.bench.kit.size[0].max(1);
                let (pixels, first) = (1 + differing.count(), [at % width, at / width]);
                return Err(if conservative {
                    ViolationKind::WrongImage { pixels, first }
                } else {
                    ViolationKind::FalseVerdicts { pixels, first }
                });
            }
        }
        Ok(())
    }
}

/// Those of the slots that one of these verdicts does not draw.
fn undrawn(verdicts: &[Verdicts], slots: &[u32]) -> Vec<u32> {
    let drawn = |slot: &u32| verdicts.iter().all(|v| v.get(*slot).draws());
    slots.iter().copied().filter(|slot| !drawn(slot)).collect()
}
