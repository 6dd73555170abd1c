//! What the kit checks with: the cases, the adapter, the image size and the seed.

use antumbra_cull::AdapterChoice;

use super::case::Case;
use super::setup::Setup;

/// The settings of the kit. The default plays all cases on the fastest adapter that is not OpenGL.
#[derive(Debug, Clone)]
pub struct Kit {
    /// The adapter, unless [`Kit::check_on`] gets a device.
    pub adapter: AdapterChoice,
    /// Width and height of the views in pixels.
    pub size: [u32; 2],
    /// The seed of the random scenes. Every failure names it.
    pub seed: u64,
    /// Number of scenes in [`Case::RandomScenes`].
    pub random_scenes: u32,
    /// Number of entities in [`Case::Many`]; the default exceeds the 4,096 queries of one query set.
    pub many_entities: u32,
    /// The cases to play, in this order.
    pub cases: Vec<Case>,
    /// How the stages of all cases are run.
    pub setup: Setup,
    /// How much is played in [the other setups](Setup::OTHERS) besides.
    pub other_setups: OtherSetups,
    /// Whether late answers must cull no visible entity once they have settled on a still scene. Set it for a frame-late strategy
    /// whose only error is its latency: full-resolution proxies, no threshold.
    pub exact_when_still: bool,
    /// Number of frames within which the verdicts of a still scene must settle.
    pub settle_frames: u32,
}

/// How much the kit plays in setups that are not its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherSetups {
    /// Nothing.
    LeftOut,
    /// Those of its cases that are among [`Case::BRIEF`], with one random scene.
    Brief,
    /// All of its cases.
    Whole,
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
            setup: Setup::PLAIN,
            other_setups: OtherSetups::Brief,
            exact_when_still: false,
            settle_frames: 5,
        }
    }
}

impl Kit {
    /// The default kit on this adapter.
    pub fn on(adapter: AdapterChoice) -> Self {
        Self {
            adapter,
            ..Self::default()
        }
    }

    /// The setups that it plays, its own first, each with the kit that plays it.
    pub(super) fn programme(&self) -> Vec<Self> {
        let others = Setup::OTHERS
            .into_iter()
            .filter(|setup| *setup != self.setup);
        let in_other = |setup| match self.other_setups {
            OtherSetups::LeftOut => None,
            OtherSetups::Whole => Some(Self {
                setup,
                ..self.clone()
            }),
            OtherSetups::Brief => {
                let cases = self.cases.iter().copied();
                Some(Self {
                    setup,
                    cases: cases.filter(|case| Case::BRIEF.contains(case)).collect(),
                    random_scenes: self.random_scenes.min(1),
                    ..self.clone()
                })
            }
        };
        std::iter::once(self.clone())
            .chain(others.filter_map(in_other))
            .filter(|kit| !kit.cases.is_empty())
            .collect()
    }
}
