//! What pages show of strategies is real: the one in the README compiles and passes the kit, and excerpts are from the example. (Whole programs of the page on strategies are
//! documentation tests of the facade.)
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

/// Lines without what indents them.
fn lines(text: &str) -> String {
    text.lines().flat_map(|line| [line.trim(), "\n"]).collect()
}

#[test]
fn excerpts_on_the_page_on_strategies_are_from_the_example() {
    let page = include_str!("../docs/writing-a-strategy.md");
    let mut found = 0;
    for (fence, example) in [
        (
            "```rust,ignore\n",
            include_str!("../examples/gpu_strategy.rs"),
        ),
        ("```wgsl\n", include_str!("../examples/gpu_strategy.wgsl")),
    ] {
        let example = lines(example);
        for block in page.split(fence).skip(1) {
            let (excerpt, _) = block.split_once("```").unwrap();
            assert!(example.contains(&lines(excerpt)), "{excerpt}");
            found += 1;
        }
    }
    assert_eq!(found, 4);
}
