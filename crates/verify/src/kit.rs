//! The conformance kit: what every strategy must get right, whoever wrote it, in one line of a test.
//!
//! ```no_run
//! use antumbra_strategies::ThreePass;
//!
//! # // In a #[test]:
//! antumbra_verify::kit::assert_conforms(|| Box::new(ThreePass::default()));
//! ```
//!
//! Each [`Case`] plays a small story to the strategy: scenes, cameras, entities that come and go. Every frame is held against the
//! [`Oracle`](crate::Oracle):
//!
//! - A strategy that claims to be [conservative](Strategy::conservative) draws every entity that owns a pixel, and its picture is that
//!   of drawing everything, to the bit.
//! - Any strategy's verdicts are true: its picture is that of drawing what they say.
//! - Any strategy draws what reaches over the near plane, and one that answers [late](antumbra_cull::Latency::FrameLate) draws what no answer
//!   covers: in the first frame, after a cut, new in its slot, or new in the frustum.
//! - The same input twice gives the same verdicts, and late answers settle while nothing moves.
//! - Nothing fails, panics, or is refused by the device.
//!
//! [`Kit::check_scene`] holds a strategy to the same on a scene of your own, from wherever you look at it.

mod case;
mod failure;
mod play;
mod props;
mod stories;

pub use case::Case;
pub use failure::{KitFailure, Violation, ViolationKind};

use std::panic::{AssertUnwindSafe, catch_unwind};

use antumbra_draw::{AdapterChoice, Gpu};
use antumbra_scene::{Camera, Scene};

use antumbra_cull::{Strategy, Verdicts};

/// What to check with; the default is all cases on the fastest adapter that is not GL.
#[derive(Debug, Clone)]
pub struct Kit {
    /// Which adapter, unless [`Kit::check_on`] is given a device.
    pub adapter: AdapterChoice,
    /// Width and height of the views in pixels.
    pub size: [u32; 2],
    /// What the random scenes follow from. Every failure names it.
    pub seed: u64,
    /// How many random scenes.
    pub random_scenes: u32,
    /// Entities in [`Case::Many`]; the default exceeds the 4,096 queries of one query set.
    pub many_entities: u32,
    /// The cases to play, in this order.
    pub cases: Vec<Case>,
    /// Whether late answers, once settled on a still scene, must cull nothing that owns a pixel. Ask it of a frame-late strategy
    /// whose only error is its lateness: full-resolution stand-ins, no threshold.
    pub exact_when_still: bool,
    /// Frames within which the verdicts of a still scene must settle.
    pub settle_frames: u32,
}

impl Default for Kit {
    fn default() -> Self {
        Self {
            adapter: AdapterChoice::Auto,
            size: [128, 96],
            seed: 1,
            random_scenes: 4,
            many_entities: 5000,
            cases: Case::ALL.to_vec(),
            exact_when_still: false,
            settle_frames: 5,
        }
    }
}

/// What was checked, when all held.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KitReport {
    /// The strategy with its settings, as the registry reads it: `name:key=value`.
    pub strategy: String,
    /// The adapter, as `name (backend)`.
    pub adapter: String,
    /// The seed.
    pub seed: u64,
    /// The cases, in the order they were played.
    pub cases: Vec<CaseReport>,
}

/// One case that passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaseReport {
    /// The case.
    pub case: Case,
    /// How many frames of it were compared with the oracle.
    pub frames: u32,
}

impl Kit {
    /// All cases on this adapter.
    pub fn on(adapter: AdapterChoice) -> Self {
        Self {
            adapter,
            ..Self::default()
        }
    }

    /// Checks a strategy; `make` makes a fresh one, always with the same settings.
    ///
    /// # Errors
    /// [`KitFailure::Device`] without an adapter, [`KitFailure::Violations`] with all that did not hold: at most one a case.
    pub fn check(&self, make: impl Fn() -> Box<dyn Strategy>) -> Result<KitReport, KitFailure> {
        let gpu = Gpu::open(&self.adapter).map_err(|error| KitFailure::Device {
            strategy: title(make().as_ref()),
            error,
        })?;
        self.check_on(&gpu, make)
    }

    /// The same on a device that is open already.
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
        for case in &self.cases {
            // The next case begins with a fresh strategy and a fresh scene, whatever this one left behind.
            let story = |bench: &mut play::Bench<'_>| {
                stories::play(*case, bench)?;
                Ok(bench.frames)
            };
            match self.attempt(gpu, &make, *case, story) {
                Ok(frames) => cases.push(CaseReport {
                    case: *case,
                    frames,
                }),
                Err(violation) => violations.push(violation),
            }
        }
        if violations.is_empty() {
            return Ok(KitReport {
                strategy: title(make().as_ref()),
                adapter: gpu.title(),
                seed: self.seed,
                cases,
            });
        }
        Err(self.failure(gpu, make().as_ref(), violations))
    }

    /// Plays a scene of your own, as [`Case::Custom`]: a camera a view and frame, as many views in each frame as in the first. Every frame is
    /// held against the oracle as those of the cases are. What it answers is each frame's verdicts, a view each, to compare with others.
    ///
    /// # Errors
    /// [`KitFailure::Violations`] with the first thing that did not hold.
    pub fn check_scene(
        &self,
        gpu: &Gpu,
        make: impl Fn() -> Box<dyn Strategy>,
        scene: &Scene,
        frames: &[Vec<Camera>],
    ) -> Result<Vec<Vec<Verdicts>>, KitFailure> {
        let story = |bench: &mut play::Bench<'_>| stories::own(bench, scene.clone(), frames);
        self.attempt(gpu, &make, Case::Custom, story)
            .map_err(|violation| self.failure(gpu, make().as_ref(), vec![violation]))
    }

    /// Plays a story; a panic in it is a breach like any other.
    fn attempt<'k, T>(
        &'k self,
        gpu: &'k Gpu,
        make: &'k dyn Fn() -> Box<dyn Strategy>,
        case: Case,
        story: impl FnOnce(&mut play::Bench<'k>) -> Result<T, ViolationKind>,
    ) -> Result<T, Violation> {
        let mut bench = play::Bench {
            kit: self,
            gpu,
            make,
            frame: 0,
            frames: 0,
        };
        let kind = match catch_unwind(AssertUnwindSafe(|| story(&mut bench))) {
            Ok(Ok(told)) => return Ok(told),
            Ok(Err(kind)) => kind,
            Err(payload) => ViolationKind::Panicked(said(payload.as_ref())),
        };
        Err(Violation {
            case,
            frame: bench.frame,
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

/// Checks a strategy with the default [`Kit`]: the one line a test needs.
///
/// # Panics
/// With the list of all that did not hold.
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

fn said(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "without a message".to_owned())
}
