//! One run of a strategy on one scene, with the oracle beside it. Every frame is checked before the next one starts.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use antumbra_cull::{
    Candidates, Gpu, Ideal, Latency, Renderer, Stage, StageOutput, StageScene, Strategy, Verdict,
    Verdicts, ViewFrame, ViewInput, ViewSpec, WithRenderer, read_back,
};
use antumbra_draw::{BuiltinRenderer, GpuScene};
use antumbra_scene::{Camera, EntityKey, Scene};
use rand::SeedableRng;
use rand_pcg::Pcg32;

use super::failure::ViolationKind;
use super::host_frame::{HostFrame, listed};
use super::host_renderer::HostRenderer;
use super::replay::ReplayFrame;
use super::settings::Kit;
use super::setup::{Setup, Shading};
use crate::oracle::{EntitySet, IdBuffer, Oracle};

/// What a case works with, and how far it has come.
pub(super) struct CaseContext<'k> {
    pub kit: &'k Kit,
    pub gpu: &'k Gpu,
    pub make: &'k dyn Fn() -> Box<dyn Strategy>,
    /// Index of the current frame in the current run.
    pub frame: u32,
    /// Number of frames compared with the oracle, in all runs of the case.
    pub compared_frames: u32,
    /// Number of runs that were started.
    pub runs: u32,
    /// What was seen so far, for a replay.
    pub replay: Option<Vec<ReplayFrame>>,
}

impl CaseContext<'_> {
    /// A random stream that depends on the kit's seed and on this number of a scene alone.
    pub fn random(&self, scene: u32) -> Pcg32 {
        let seed = self.kit.seed.wrapping_mul(1009);
        Pcg32::seed_from_u64(seed.wrapping_add(u64::from(scene)))
    }
}

/// The camera of one view in one frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViewCamera {
    camera: Camera,
    /// Whether the camera jumped, and the view's answers are void.
    cut: bool,
}

impl ViewCamera {
    /// A camera that moved on from the last frame.
    pub fn continuous(camera: Camera) -> Self {
        Self { camera, cut: false }
    }

    /// A camera that jumped.
    pub fn cut(camera: Camera) -> Self {
        Self { camera, cut: true }
    }
}

/// A strategy on a scene.
pub(super) struct Run<'b, 'k> {
    context: &'b mut CaseContext<'k>,
    /// Stories change it between frames.
    pub scene: Scene,
    gpu_scene: WithRenderer<GpuScene>,
    /// Width and height of the views in pixels.
    size: [u32; 2],
    /// Draws what the strategy chooses.
    stage: Stage,
    /// Runs that stage.
    host: HostFrame,
    /// Draws the slots that it is given: the image to compare with.
    expected: Stage,
    oracle: Oracle,
    claims: Claims,
    /// One set a view: what has been in its frustum since the last cut.
    seen: Vec<HashSet<Occupancy>>,
    next_frame: u32,
    /// Number of frames since something changed.
    still_frames: u32,
    /// The verdicts of the last frame, one a view.
    last: Vec<Verdicts>,
    /// The verdicts of all frames and views, in this order.
    pub history: Vec<Verdicts>,
}

/// What the strategy says about itself.
#[derive(Debug, Clone, Copy)]
struct Claims {
    conservative: bool,
    /// It uses answers of earlier frames.
    late: bool,
    needs_reference: bool,
}

/// An entity in a slot. Answers are about such a pair, since slots are reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Occupancy {
    slot: u32,
    entity: EntityKey,
}

/// What the oracle knows of one view before the strategy draws it.
struct Reference {
    image: IdBuffer,
    owners: Arc<Vec<u32>>,
    candidates: Candidates,
}

impl<'b, 'k> Run<'b, 'k> {
    /// Starts a run with one view.
    pub fn new(context: &'b mut CaseContext<'k>, scene: Scene) -> Result<Self, ViolationKind> {
        Self::with_views(context, scene, &["main"])
    }

    /// Starts a run with one view for each of these names.
    pub fn with_views(
        context: &'b mut CaseContext<'k>,
        mut scene: Scene,
        names: &[&str],
    ) -> Result<Self, ViolationKind> {
        let setup = context.kit.setup;
        let gpu_scene = GpuScene::new(context.gpu, &mut scene)?;
        let gpu_scene = WithRenderer::new(gpu_scene, move |scene| renderer(scene, setup));
        let specs: Vec<ViewSpec> = names
            .iter()
            .map(|name| ViewSpec {
                name: (*name).to_owned(),
                size: context.kit.size,
            })
            .collect();
        let strategy = (context.make)();
        let claims = Claims {
            conservative: strategy.conservative(),
            late: strategy.latency() == Some(Latency::FrameLate),
            needs_reference: strategy.needs_reference(),
        };
        let size = context.kit.size;
        // What to compare with has an image in any case.
        let plain = Setup {
            samples: setup.samples,
            ..Setup::PLAIN
        };
        context.frame = 0;
        context.runs += 1;
        Ok(Self {
            stage: Stage::new(&gpu_scene, strategy, specs.clone(), setup.options())?,
            host: HostFrame::new(context.gpu, setup, names.len(), size),
            expected: Stage::new(&gpu_scene, Box::new(Ideal), specs, plain.options())?,
            oracle: oracle(&gpu_scene, setup, size),
            seen: vec![HashSet::new(); names.len()],
            next_frame: 0,
            still_frames: 0,
            last: Vec::new(),
            history: Vec::new(),
            size,
            context,
            scene,
            gpu_scene,
            claims,
        })
    }

    /// Gives all views another size, from the next frame on.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), ViolationKind> {
        for view in 0..self.seen.len() {
            self.stage.resize(view, size)?;
            self.expected.resize(view, size)?;
        }
        let setup = self.context.kit.setup;
        self.oracle = oracle(&self.gpu_scene, setup, size);
        self.host = HostFrame::new(self.context.gpu, setup, self.seen.len(), size);
        self.size = size;
        Ok(())
    }

    /// Runs a frame of one view.
    pub fn frame(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        self.frame_of_views(&[ViewCamera::continuous(*camera)])
    }

    /// Runs a frame of one view right after its camera jumped.
    pub fn cut(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        self.frame_of_views(&[ViewCamera::cut(*camera)])
    }

    /// Runs a frame of one view in which nothing changed since the last, and checks that the verdicts settle in time.
    pub fn still(&mut self, camera: &Camera) -> Result<(), ViolationKind> {
        let before = std::mem::take(&mut self.last);
        let frames = self.still_frames + 1;
        self.frame(camera)?;
        self.still_frames = frames;
        let kit = self.context.kit;
        let agree = before.iter().zip(&self.last).all(|(a, b)| a.agree(b));
        if frames > kit.settle_frames && !agree {
            return Err(ViolationKind::Unsettled { frames });
        }
        if frames >= kit.settle_frames && kit.exact_when_still {
            let reference = self
                .oracle
                .render(&self.gpu_scene, camera, EntitySet::InFrustum)?;
            let slots = undrawn(&self.last, &reference.owners());
            if !slots.is_empty() {
                return Err(ViolationKind::StillFalseCull { frames, slots });
            }
        }
        Ok(())
    }

    /// Runs a frame of all views, one camera each.
    pub fn frame_of_views(&mut self, views: &[ViewCamera]) -> Result<(), ViolationKind> {
        self.context.frame = self.next_frame;
        self.next_frame += 1;
        self.still_frames = 0;
        self.gpu_scene.scene_mut().sync(&mut self.scene)?;
        let references = views
            .iter()
            .map(|view| self.reference(&view.camera))
            .collect::<Result<Vec<_>, _>>()?;
        let inputs: Vec<ViewInput<'_>> = views
            .iter()
            .zip(&references)
            .map(|(view, reference)| ViewInput {
                cut: view.cut,
                reference: self
                    .claims
                    .needs_reference
                    .then(|| Arc::clone(&reference.owners)),
                ..ViewInput::new(view.camera)
            })
            .collect();
        self.host.play(&mut self.stage, &self.gpu_scene, &inputs)?;
        // Late answers have arrived before the next frame reads them, so that a run is the same each time.
        self.context.gpu.wait()?;
        self.last = (0..views.len())
            .map(|view| self.stage.verdicts(view, &self.gpu_scene))
            .collect::<Result<_, _>>()?;
        self.history.extend(self.last.iter().cloned());
        for (index, (view, reference)) in views.iter().zip(&references).enumerate() {
            if view.cut
                && let Some(seen) = self.seen.get_mut(index)
            {
                seen.clear();
            }
            self.keep(index, &view.camera, reference)?;
            self.check_view(index, &view.camera, reference)?;
        }
        self.compare_images(views, &references)?;
        self.context.compared_frames += 1;
        Ok(())
    }

    /// Keeps what there is to see of a view, where a replay asks for it.
    fn keep(
        &mut self,
        view: usize,
        camera: &Camera,
        reference: &Reference,
    ) -> Result<(), ViolationKind> {
        let Some(verdicts) = self
            .last
            .get(view)
            .filter(|_| self.context.replay.is_some())
        else {
            return Ok(());
        };
        let drawn = EntitySet::Drawn(verdicts);
        let drawn = self.oracle.render(&self.gpu_scene, camera, drawn)?;
        let frame = ReplayFrame {
            run: self.context.runs.saturating_sub(1),
            frame: self.context.frame,
            view,
            size: self.size,
            verdicts: verdicts.clone(),
            reference: reference.image.clone(),
            drawn,
        };
        if let Some(replay) = &mut self.context.replay {
            replay.push(frame);
        }
        Ok(())
    }

    fn reference(&mut self, camera: &Camera) -> Result<Reference, ViolationKind> {
        let image = self
            .oracle
            .render(&self.gpu_scene, camera, EntitySet::InFrustum)?;
        let mut candidates = Candidates::default();
        let frame = ViewFrame::new(*camera, self.size, 0);
        candidates.find(self.gpu_scene.table(), &frame);
        Ok(Reference {
            owners: Arc::new(image.owners()),
            image,
            candidates,
        })
    }

    /// Checks the verdicts of one view against the reference.
    fn check_view(
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
            self.check_coverage(view, verdicts, reference, &missed)?;
        }
        if self.claims.conservative && !missed.is_empty() {
            let drawn = EntitySet::Drawn(verdicts);
            let image = self.oracle.render(&self.gpu_scene, camera, drawn)?;
            return Err(ViolationKind::FalseCull {
                slots: missed,
                pixels: image.wrong_pixels(&reference.image),
            });
        }
        self.check_contradictions(verdicts, reference)?;
        if let Some(seen) = self.seen.get_mut(view) {
            let inside = reference.candidates.inside().iter();
            seen.extend(inside.filter_map(|slot| occupancy(self.gpu_scene.scene(), *slot)));
        }
        Ok(())
    }

    /// Checks what is drawn without an answer: no late answer covers an entity that has not been in the frustum, in its slot, since the
    /// last cut.
    fn check_coverage(
        &self,
        view: usize,
        verdicts: &Verdicts,
        reference: &Reference,
        missed: &[u32],
    ) -> Result<(), ViolationKind> {
        let seen = self.seen.get(view);
        let covered = |slot: u32| {
            occupancy(self.gpu_scene.scene(), slot)
                .is_some_and(|occupancy| seen.is_some_and(|seen| seen.contains(&occupancy)))
        };
        let slots: Vec<u32> = missed.iter().copied().filter(|s| !covered(*s)).collect();
        if !slots.is_empty() {
            return Err(ViolationKind::CulledWithoutAnswer { slots });
        }
        let inside = reference.candidates.inside().iter().copied();
        let slots: Vec<u32> = inside
            .filter(|slot| !covered(*slot) && verdicts.get(*slot) == Verdict::Visible)
            .collect();
        if slots.is_empty() {
            Ok(())
        } else {
            Err(ViolationKind::VisibleWithoutAnswer { slots })
        }
    }

    /// Checks each slot's verdict against what is in the slot and where it is.
    fn check_contradictions(
        &self,
        verdicts: &Verdicts,
        reference: &Reference,
    ) -> Result<(), ViolationKind> {
        let table = self.gpu_scene.table();
        let inside = |slot: u32| reference.candidates.contains(slot);
        let owns = |slot: u32| reference.owners.binary_search(&slot).is_ok();
        for slot in 0..table.slots() {
            let verdict = verdicts.get(slot);
            let live = table.occupant(slot).is_some();
            let fact = match verdict {
                Verdict::Absent if live => "it holds an entity",
                Verdict::Absent => continue,
                _ if !live => "it is free",
                Verdict::OutsideFrustum if owns(slot) => "it owns a pixel",
                Verdict::Visible if !inside(slot) => "it is outside the frustum",
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

    /// Compares what the answers draw with what the verdicts say.
    fn compare_answers(&self) -> Result<(), ViolationKind> {
        for (view, verdicts) in self.last.iter().enumerate() {
            let listed: BTreeSet<u32> = listed(self.context.gpu, &self.stage, view)?
                .into_iter()
                .collect();
            let drawn: BTreeSet<u32> = verdicts.drawn().collect();
            let slots: Vec<u32> = listed.symmetric_difference(&drawn).copied().collect();
            if !slots.is_empty() {
                return Err(ViolationKind::FalseAnswers { slots });
            }
        }
        Ok(())
    }

    /// Compares the strategy's image with that of drawing everything, or, if it does not claim to be conservative, of drawing what its
    /// verdicts say.
    fn compare_images(
        &mut self,
        views: &[ViewCamera],
        references: &[Reference],
    ) -> Result<(), ViolationKind> {
        if self.context.kit.setup.output == StageOutput::Answers {
            return self.compare_answers();
        }
        let conservative = self.claims.conservative;
        let inputs: Vec<ViewInput<'_>> = views
            .iter()
            .zip(references)
            .zip(&self.last)
            .map(|((view, reference), verdicts)| ViewInput {
                reference: Some(Arc::new(if conservative {
                    reference.candidates.inside().to_vec()
                } else {
                    verdicts.drawn().collect()
                })),
                ..ViewInput::new(view.camera)
            })
            .collect();
        self.expected.frame(&self.gpu_scene, &inputs)?;
        for view in 0..views.len() {
            let Some(expected) = self.expected.colour(view) else {
                return Err(ViolationKind::Failed(format!("view {view} has no image")));
            };
            let drawn = self.host.image(self.context.gpu, &self.stage, view)?;
            let expected = read_back::texture(self.context.gpu, expected)?;
            let pixels = drawn.as_chunks::<4>().0.iter();
            let pixels = pixels.zip(expected.as_chunks::<4>().0);
            let mut differing = pixels.enumerate().filter(|(_, (a, b))| a != b);
            if let Some((index, _)) = differing.next() {
                let index = index as u32;
                let width = self.size[0].max(1);
                let first = [index % width, index / width];
                let pixels = 1 + differing.count();
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

/// Who shades a scene.
fn renderer(scene: &GpuScene, setup: Setup) -> Box<dyn Renderer> {
    match setup.shading {
        Shading::Builtin => scene.renderer(),
        Shading::Host => Box::new(HostRenderer(BuiltinRenderer::new(scene.gpu()))),
    }
}

fn oracle(scene: &dyn StageScene, setup: Setup, size: [u32; 2]) -> Oracle {
    Oracle::new(scene, size).with_samples(setup.samples)
}

fn occupancy(scene: &GpuScene, slot: u32) -> Option<Occupancy> {
    let entity = scene.table().occupant(slot)?.key;
    Some(Occupancy { slot, entity })
}

/// Those of the slots that at least one of the verdicts does not draw.
fn undrawn(verdicts: &[Verdicts], slots: &[u32]) -> Vec<u32> {
    let drawn = |slot: &u32| verdicts.iter().all(|v| v.get(*slot).draws());
    slots.iter().copied().filter(|slot| !drawn(slot)).collect()
}
