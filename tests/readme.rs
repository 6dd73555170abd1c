//! The strategy in the README compiles as shown, and passes the kit.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra::cull::{
    Counting, DeclareError, FrameGraph, Latency, MeshDetail, Strategy, ViewNodes, VisibleSet,
};
use antumbra::verify::kit;

struct Sampled;

#[rustfmt::skip]
impl Strategy for Sampled {
    fn name(&self) -> &str { "sampled" }
    fn summary(&self) -> &str { "draws what has a visible sample" }
    fn conservative(&self) -> bool { false }
    fn latency(&self) -> Option<Latency> { Some(Latency::FrameLate) }
    fn declare(&mut self, g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Result<VisibleSet, DeclareError> {
        let candidates = g.in_frustum(view);
        let proxies = g.proxies(view, candidates, MeshDetail::Proxy, MeshDetail::Proxy);
        let counts = g.count_samples(view, proxies, Counting::Queries, view.size());
        Ok(g.visible_samples(view, candidates, counts, Latency::FrameLate, 0))
    }
}
// README: end

#[test]
fn the_readme_shows_a_strategy_that_passes_the_kit() {
    let here = include_str!("readme.rs");
    let (_, shown) = here.split_once("#[rustfmt::skip]\n").unwrap();
    let (shown, _) = shown.split_once("// README: end").unwrap();
    assert!(include_str!("../README.md").contains(shown), "{shown}");
    kit::assert_conforms(|| Box::new(Sampled));
}
