//! Reuse of transient resources: memory is shared where lifetimes allow, never where they overlap.

use antumbra_graph::{Graph, PlanFormat};
use proptest::prelude::*;

use crate::declare::{bytes, colour, compile, compute, draw};

#[test]
fn a_chain_of_equal_textures_needs_two() {
    let mut g = Graph::new("chain");
    let mut last = g.texture("0", colour());
    last = draw(&mut g, "draw 0", last, &[]);
    for n in 1..6 {
        let next = g.texture(format!("{n}"), colour());
        last = draw(&mut g, &format!("draw {n}"), next, &[last]);
    }
    let import = g.import_texture("screen", colour());
    let _ = draw(&mut g, "present", import, &[last]);
    let plan = compile(g);
    assert_eq!(plan.physical_textures(), 2);
    let memory = plan.describe_memory();
    assert_eq!(memory.textures, 2 * 64 * 64 * 4);
    assert_eq!(memory.saved, 4 * 64 * 64 * 4);
}

#[test]
fn other_shapes_outputs_and_histories_do_not_share() {
    let mut g = Graph::new("unshared");
    let a = g.texture("a", colour());
    let a = draw(&mut g, "a", a, &[]);
    let b = g.texture("b", colour().layers(2));
    let b = draw(&mut g, "b", b, &[a]);
    let c = g.texture("c", colour());
    let c = draw(&mut g, "c, an output", c, &[b]);
    let d = g.texture("d", colour());
    let d = draw(&mut g, "d", d, &[c]);
    let e = g.texture("e", colour());
    let past = g.texture("past", colour());
    let past_now = draw(&mut g, "past", past, &[]);
    let e = draw(&mut g, "e", e, &[d, past_now, past.previous()]);
    g.output(c);
    g.output(e);
    // a and d share one texture; b has layers; c and e are outputs; `past` has two copies.
    assert_eq!(compile(g).physical_textures(), 1 + 1 + 2 + 2);
}

#[test]
fn buffers_of_a_like_size_share() {
    let mut g = Graph::new("buffers");
    let sizes = [100, 120, 70, 1000, 64];
    let mut last = None;
    for (n, size) in sizes.into_iter().enumerate() {
        let buffer = g.buffer(format!("{n}"), bytes(size));
        let reads: Vec<_> = last.into_iter().collect();
        last = Some(compute(&mut g, &format!("step {n}"), buffer, &reads));
    }
    let import = g.import_buffer("out", bytes(4));
    let _ = compute(&mut g, "end", import, &[last.unwrap()]);
    let plan = compile(g);
    // The buffers of 100 and 70 bytes share one of 100; those of 120 and 64 share one of 120.
    assert_eq!(plan.physical_buffers(), 3);
    assert_eq!(plan.describe_memory().buffers, 100 + 120 + 1000);
}

#[test]
fn what_a_loop_touches_lives_as_long_as_the_loop() {
    let mut g = Graph::new("loop");
    let mut out = None;
    g.host_loop("loop", |g| {
        let (a, b) = (g.buffer("a", bytes(64)), g.buffer("b", bytes(64)));
        let (c, d) = (g.buffer("c", bytes(64)), g.buffer("d", bytes(64)));
        let a = compute(g, "a", a, &[]);
        let b = compute(g, "b", b, &[a]);
        let c = compute(g, "c", c, &[b]);
        let d = compute(g, "d", d, &[c]);
        let done = g.host::<bool>("done");
        let mut node = g.host_node("decide");
        let done = node.write(done);
        node.run(|_| Ok(()));
        out = Some(d);
        done
    });
    g.output(out.unwrap());
    assert_eq!(compile(g).physical_buffers(), 4);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Resources that share an object are never alive at the same time, judged by the JSON export alone.
    #[test]
    fn sharers_never_overlap(reads in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..3u64), 2..30)) {
        let mut g = Graph::new("random");
        let mut written = Vec::new();
        for (n, (one, two, size)) in reads.into_iter().enumerate() {
            let buffer = g.buffer(format!("{n}"), bytes(64 << size));
            let inputs = if n == 0 { vec![] } else {
                let mut inputs = vec![written[one.index(n)], written[two.index(n)]];
                inputs.dedup();
                inputs
            };
            written.push(compute(&mut g, &format!("node {n}"), buffer, &inputs));
        }
        let import = g.import_buffer("out", bytes(4));
        let last = *written.last().unwrap();
        let _ = compute(&mut g, "end", import, &[last]);
        let plan = compile(g);
        let picture: serde_json::Value = serde_json::from_str(&plan.export(PlanFormat::Json)).unwrap();
        let order = |pass: &serde_json::Value| picture["passes"][pass.as_u64().unwrap() as usize]["order"].as_u64();
        let mut lives = std::collections::BTreeMap::<u64, Vec<(u64, u64)>>::new();
        for (index, resource) in picture["resources"].as_array().unwrap().iter().enumerate() {
            if resource["imported"] == true {
                continue;
            }
            let uses: Vec<u64> = picture["edges"].as_array().unwrap().iter()
                .filter(|edge| edge["resource"] == index)
                .filter_map(|edge| order(&edge["pass"]))
                .collect();
            if let (Some(first), Some(last)) = (uses.iter().min(), uses.iter().max()) {
                lives.entry(resource["objects"][0].as_u64().unwrap()).or_default().push((*first, *last));
            }
        }
        for alive in lives.values_mut() {
            alive.sort_unstable();
            for pair in alive.windows(2) {
                prop_assert!(pair[0].1 < pair[1].0, "{:?} overlaps", pair);
            }
        }
    }
}
