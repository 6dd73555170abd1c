//! The conformance kit: checks that a strategy keeps its promises, in one line of a test.
//!
//! ```no_run
//! use antumbra_strategies::ThreePass;
//!
//! # // In a #[test]:
//! antumbra_verify::kit::assert_conforms(|| Box::new(ThreePass::default()));
//! ```
//!
//! Each [`Case`] plays a short story to the strategy: a scene, a camera path, entities that are added, moved and removed. Every frame is
//! compared with the [`Oracle`](crate::Oracle):
//!
//! - A strategy that claims to be [conservative](Strategy::conservative) draws every entity that owns a sample. Its image equals, bit by
//!   bit, the image of drawing everything.
//! - The verdicts of any strategy are true: its image equals the image of drawing what they say.
//! - Any strategy draws the visible entities that cross the near plane. One that answers [late](antumbra_cull::Latency::FrameLate) also
//!   draws those that no answer covers: in the first frame, after a cut, new in their slot, or new in the frustum.
//! - The same input gives the same verdicts twice, and late answers settle while nothing moves.
//! - No call fails or panics, and the device refuses none.
//!
//! All of it is played on a stage by itself. A [part](Case::BRIEF) is played in other [setups](Setup) besides: in a host's frame, as answers alone, with four
//! samples a pixel, and under a renderer that is not the built-in one.
//!
//! [`Kit::check_scene`] checks the same on a scene and a camera path of the caller.

mod case;
mod failure;
mod host_frame;
mod host_renderer;
mod replay;
mod run;
mod settings;
mod setup;
mod stories;
mod test_scene;

pub use case::Case;
pub use failure::{KitFailure, Violation, ViolationKind};
pub use replay::{Replay, ReplayFrame};
pub use settings::{Kit, OtherSetups};
pub use setup::{Setup, Shading};

use std::panic::{AssertUnwindSafe, catch_unwind};

use antumbra_cull::{Gpu, Strategy, Verdicts};
use antumbra_scene::{Camera, Scene};

use run::CaseContext;

/// What was checked, if nothing failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KitReport {
    /// The strategy with its settings, as the registry reads it: `name:key=value`.
    pub strategy: String,
    /// The adapter, as `name (backend)`.
    pub adapter: String,
    /// The seed.
    pub seed: u64,
    /// The cases, in the order in which they were played.
    pub cases: Vec<CaseReport>,
    /// What was not played: a strategy that waits cannot be recorded into a host's frame, and a device may lack what several samples need.
    pub left_out: Vec<LeftOut>,
}

/// A setup that was not played.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// The setup.
    pub setup: Setup,
    /// Why the strategy cannot be run so on this device.
    pub why: String,
}

/// One case that passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaseReport {
    /// The case.
    pub case: Case,
    /// How the stage was run.
    pub setup: Setup,
    /// Number of its frames that were compared with the oracle.
    pub frames: u32,
}

impl Kit {
    /// Checks a strategy. `make` returns a fresh one, each time with the same settings.
    ///
    /// # Errors
    /// [`KitFailure::Device`] without an adapter, [`KitFailure::Violations`] with the first violation of each case that has one.
    pub fn check(&self, make: impl Fn() -> Box<dyn Strategy>) -> Result<KitReport, KitFailure> {
        let gpu = Gpu::open(&self.adapter).map_err(|error| KitFailure::Device {
            strategy: title(make().as_ref()),
            error,
        })?;
        self.check_on(&gpu, make)
    }

    /// Checks a strategy on a device that is already open.
    ///
    /// # Errors
    /// As for [`Self::check`].
    pub fn check_on(
        &self,
        gpu: &Gpu,
        make: impl Fn() -> Box<dyn Strategy>,
    ) -> Result<KitReport, KitFailure> {
        let mut cases = Vec::with_capacity(self.cases.len());
        let mut violations = Vec::new();
        let mut left_out = Vec::new();
        for kit in self.programme() {
            let setup = kit.setup;
            // The kit's own setup was asked for: what it lacks there is a failure.
            if setup != self.setup
                && let Ok(Some(why)) = setup.refusal(gpu, make())
            {
                left_out.push(LeftOut { setup, why });
                continue;
            }
            for case in kit.cases.iter().copied() {
                // A violation ends its own case only: each case starts with a fresh strategy and a fresh scene.
                let story = |context: &mut CaseContext<'_>| {
                    stories::play(case, context)?;
                    Ok(context.compared_frames)
                };
                match kit.attempt(gpu, &make, case, story) {
                    Ok(frames) => cases.push(CaseReport {
                        case,
                        setup,
                        frames,
                    }),
                    Err(violation) => violations.push(violation),
                }
            }
        }
        if violations.is_empty() {
            return Ok(KitReport {
                strategy: title(make().as_ref()),
                adapter: gpu.title(),
                seed: self.seed,
                cases,
                left_out,
            });
        }
        Err(self.failure(gpu, make().as_ref(), violations))
    }

    /// Checks a strategy on a scene of the caller, as [`Case::Custom`]. `frames` holds one camera a view for each frame; all frames have as
    /// many views as the first. Every frame is compared with the oracle, as in the other cases. Returns the verdicts by frame, then by
    /// view, to compare them with those of other strategies.
    ///
    /// # Errors
    /// [`KitFailure::Violations`] with the first violation.
    pub fn check_scene(
        &self,
        gpu: &Gpu,
        make: impl Fn() -> Box<dyn Strategy>,
        scene: &Scene,
        frames: &[Vec<Camera>],
    ) -> Result<Vec<Vec<Verdicts>>, KitFailure> {
        let story = |context: &mut CaseContext<'_>| stories::custom(context, scene.clone(), frames);
        self.attempt(gpu, &make, Case::Custom, story)
            .map_err(|violation| self.failure(gpu, make().as_ref(), vec![violation]))
    }

    /// Plays one case again, with the kit's seed, size and setup, and keeps what there is to see: to look at a failure. The names of cases in messages are those of
    /// [`Case::named`].
    ///
    /// ```no_run
    /// use antumbra_cull::{FrustumOnly, Gpu};
    /// use antumbra_verify::kit::{Case, Kit};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let gpu = Gpu::open(&Default::default())?;
    /// let case = Case::named("slot reuse").ok_or("no such case")?;
    /// let replay = Kit { seed: 7, ..Kit::default() }.replay(&gpu, || Box::new(FrustumOnly), case);
    /// if let (Some(violation), Some(last)) = (&replay.violation, replay.frames.last()) {
    ///     println!("frame {}: {violation:?}", last.frame);
    ///     // `last.rgba()` is an image of `last.size` with the wrong pixels in red.
    /// }
    /// # Ok(())
    /// # }
    /// ```
    pub fn replay(&self, gpu: &Gpu, make: impl Fn() -> Box<dyn Strategy>, case: Case) -> Replay {
        let mut frames = Some(Vec::new());
        let story = |context: &mut CaseContext<'_>| stories::play(case, context);
        let outcome = self.attempt_keeping(gpu, &make, case, &mut frames, story);
        Replay {
            frames: frames.unwrap_or_default(),
            violation: outcome.err(),
        }
    }

    /// Plays a story. A panic in it becomes a violation.
    fn attempt<'k, T>(
        &'k self,
        gpu: &'k Gpu,
        make: &'k dyn Fn() -> Box<dyn Strategy>,
        case: Case,
        story: impl FnOnce(&mut CaseContext<'k>) -> Result<T, ViolationKind>,
    ) -> Result<T, Violation> {
        self.attempt_keeping(gpu, make, case, &mut None, story)
    }

    /// The same; what is seen is added to `replay` if there is one, also in a story that panics.
    fn attempt_keeping<'k, T>(
        &'k self,
        gpu: &'k Gpu,
        make: &'k dyn Fn() -> Box<dyn Strategy>,
        case: Case,
        replay: &mut Option<Vec<ReplayFrame>>,
        story: impl FnOnce(&mut CaseContext<'k>) -> Result<T, ViolationKind>,
    ) -> Result<T, Violation> {
        let mut context = CaseContext {
            kit: self,
            gpu,
            make,
            frame: 0,
            compared_frames: 0,
            runs: 0,
            replay: replay.take(),
        };
        let played = catch_unwind(AssertUnwindSafe(|| story(&mut context)));
        *replay = context.replay.take();
        let kind = match played {
            Ok(Ok(result)) => return Ok(result),
            Ok(Err(kind)) => kind,
            Err(payload) => ViolationKind::Panicked(panic_message(payload.as_ref())),
        };
        Err(Violation {
            case,
            setup: self.setup,
            frame: context.frame,
            kind,
        })
    }

    fn failure(
        &self,
        gpu: &Gpu,
        strategy: &dyn Strategy,
        violations: Vec<Violation>,
    ) -> KitFailure {
        KitFailure::Violations {
            strategy: title(strategy),
            adapter: gpu.title(),
            seed: self.seed,
            size: self.size,
            violations,
        }
    }
}

/// Checks a strategy with the default [`Kit`].
///
/// # Errors
/// As for [`Kit::check`].
pub fn check(make: impl Fn() -> Box<dyn Strategy>) -> Result<KitReport, KitFailure> {
    Kit::default().check(make)
}

/// Checks a strategy with the default [`Kit`]: the one line that a test needs.
///
/// # Panics
/// If the strategy does not conform or there is no adapter. The message lists every violation.
#[allow(
    clippy::panic,
    reason = "this is an assertion for tests: panicking is what it is for"
)]
#[track_caller]
pub fn assert_conforms(make: impl Fn() -> Box<dyn Strategy>) {
    if let Err(failure) = check(make) {
        panic!("{failure}");
    }
}

/// A strategy with its settings, as the registry reads it.
fn title(strategy: &dyn Strategy) -> String {
    let settings = strategy.settings().into_iter();
    let settings = settings.map(|setting| format!(":{}={}", setting.key, setting.value));
    std::iter::once(strategy.name().to_owned())
        .chain(settings)
        .collect()
}

fn panic_message(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "without a message".to_owned())
}
