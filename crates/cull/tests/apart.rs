//! Occluders and occludees may be different candidates. An entity that is not tested is drawn, at every latency.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_cull::{
    Counting, DeclareError, FrameGraph, Latency, MeshDetail, ProxySource, Strategy, ViewNodes,
    VisibleSet,
};
use antumbra_verify::kit::{Case, Kit};

/// Every third candidate is an occluder, every second is tested.
struct Apart {
    latency: Latency,
    counting: Counting,
}

impl Strategy for Apart {
    fn name(&self) -> &str {
        "apart"
    }

    fn summary(&self) -> &str {
        "tests some against others"
    }

    fn conservative(&self) -> bool {
        true
    }

    fn latency(&self) -> Option<Latency> {
        Some(self.latency)
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let candidates = g.in_frustum(view);
        // Added slots are dropped, and a slot that occurs twice counts once.
        let occluders = g.narrowed(view, "occluders", candidates, |_, _, slots| {
            slots.retain(|slot| slot % 3 == 0);
            slots.extend([u32::MAX, 0, 0]);
            slots.reverse();
        });
        let occludees = g.narrowed(view, "occludees", candidates, |_, _, slots| {
            slots.retain(|slot| slot % 2 == 0);
        });
        let proxies = g.proxies_of(
            view,
            ProxySource {
                candidates: occluders,
                detail: MeshDetail::Level(0),
            },
            ProxySource {
                candidates: occludees,
                detail: MeshDetail::Level(0),
            },
        );
        let counts = g.count_samples(view, proxies, self.counting, view.size());
        Ok(g.visible_samples(view, candidates, counts, self.latency, 0))
    }
}

#[test]
fn what_nobody_asks_about_is_drawn() {
    let kit = Kit {
        cases: vec![Case::RandomScenes],
        random_scenes: 2,
        ..Kit::default()
    };
    for latency in [Latency::SameFrame, Latency::OnGpu] {
        for counting in [Counting::Queries, Counting::Compare, Counting::Identity] {
            kit.check(|| Box::new(Apart { latency, counting }))
                .unwrap_or_else(|failure| panic!("{counting}: {failure}"));
        }
    }
}
