//! The order of passes: by data, by `after`, otherwise by declaration; with as few sync points as the data allows.

use std::sync::{Arc, Mutex};

use antumbra_graph::{Graph, LoopSyncPoints};
use proptest::prelude::*;

use crate::declare::{bytes, colour, compile, compute, draw, names, noop, wait};

#[test]
fn readers_run_between_the_writers_of_their_version() {
    let mut g = Graph::new("versions");
    let image = g.texture("image", colour());
    let copy = g.texture("copy", colour());
    let one = draw(&mut g, "write 1", image, &[]);
    let two = draw(&mut g, "write 2", one, &[]);
    let copy = draw(&mut g, "read 1", copy, &[one]);
    let copy = draw(&mut g, "read 2", copy, &[two]);
    g.output(copy);
    g.output(two);
    assert_eq!(
        names(&compile(g)),
        ["write 1", "read 1", "write 2", "read 2"]
    );
}

#[test]
fn after_orders_what_data_does_not() {
    let mut g = Graph::new("after");
    let (a, b) = (g.texture("a", colour()), g.texture("b", colour()));
    let b = draw(&mut g, "one", b, &[]);
    let mut node = g.raster("two");
    let a = node.colour(a);
    let two = node.run(|_| Ok(()));
    let mut node = g.raster("three");
    let b = node.colour(b);
    node.after(two).run(|_| Ok(()));
    g.output(a);
    g.output(b);
    assert_eq!(names(&compile(g)), ["one", "two", "three"]);
}

#[test]
fn two_writers_of_a_version_may_be_ordered_by_after() {
    let mut g = Graph::new("ordered writers");
    let image = g.texture("image", colour());
    let mut node = g.raster("first");
    let one = node.colour(image);
    let first = node.run(|_| Ok(()));
    let mut node = g.raster("second");
    let _ = node.colour(image);
    node.after(first).run(|_| Ok(()));
    let copy = g.texture("copy", colour());
    let copy = draw(&mut g, "reader", copy, &[one]);
    g.output(copy);
    assert_eq!(names(&compile(g)), ["first", "second", "reader"]);
}

#[test]
fn two_eyes_share_one_sync_point() {
    let mut g = Graph::new("eyes");
    let mut decided = Vec::new();
    for eye in ["left", "right"] {
        let counts = g.buffer(format!("{eye} counts"), bytes(64));
        let counts = compute(&mut g, &format!("{eye} queries"), counts, &[]);
        let verdict = g.host::<u32>(format!("{eye} verdict"));
        decided.push(wait(&mut g, &format!("{eye} reads"), &[counts], verdict));
    }
    decided.into_iter().for_each(|host| g.output(host));
    let plan = compile(g);
    assert_eq!(plan.sync_points(), 1);
    assert_eq!(
        names(&plan),
        ["left queries", "right queries", "left reads", "right reads"]
    );
}

#[test]
fn the_passes_of_a_loop_stand_together_after_what_they_need() {
    let mut g = Graph::new("loop");
    let data = g.buffer("data", bytes(4));
    let other = g.buffer("other", bytes(4));
    let data = compute(&mut g, "before", data, &[]);
    let mut grown = data;
    g.host_loop("loop", |g| {
        grown = compute(g, "inside", data, &[]);
        let done = g.host::<bool>("done");
        let mut node = g.host_node("look");
        node.read_back(grown);
        let done = node.write(done);
        node.run(|_| Ok(()));
        done
    });
    let unrelated = compute(&mut g, "unrelated", other, &[]);
    let after = compute(&mut g, "after", unrelated, &[grown]);
    g.output(after);
    let plan = compile(g);
    assert_eq!(
        names(&plan),
        ["before", "unrelated", "loop", "inside", "look", "after"]
    );
    assert_eq!(plan.passes()[3].depth, 1);
    let inside = LoopSyncPoints {
        name: "loop",
        sync_points: 1,
    };
    assert_eq!(plan.loop_sync_points(), [inside]);
}

/// A node of a random graph: on the GPU or on the host, and which earlier nodes it reads.
#[derive(Clone, Debug)]
struct Random {
    gpu: bool,
    reads: Vec<prop::sample::Index>,
}

fn random() -> impl Strategy<Value = Vec<Random>> {
    let node = (
        any::<bool>(),
        prop::collection::vec(any::<prop::sample::Index>(), 0..4),
    )
        .prop_map(|(gpu, reads)| Random { gpu, reads });
    prop::collection::vec(node, 1..24)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// A body runs after the bodies it reads from, and the number of sync points is the longest chain of waiting nodes, which is the minimum.
    #[test]
    fn order_follows_data_with_the_fewest_sync_points(nodes in random()) {
        let mut g = Graph::new("random");
        let ran = Arc::new(Mutex::new(Vec::new()));
        let mut values = Vec::new();
        let mut needs: Vec<Vec<usize>> = Vec::new();
        let mut chain: Vec<usize> = Vec::new();
        for (index, node) in nodes.iter().enumerate() {
            let mut reads: Vec<usize> = node.reads.iter().filter(|_| index > 0).map(|read| read.index(index)).collect();
            reads.sort_unstable();
            reads.dedup();
            let buffer = g.buffer(format!("buffer {index}"), bytes(4));
            let host = g.host::<u32>(format!("host {index}"));
            let note = Arc::clone(&ran);
            let before = reads.iter().map(|read| chain[*read]).max().unwrap_or(0);
            if node.gpu {
                let mut builder = g.compute(format!("node {index}"));
                for &read in &reads {
                    match values[read] {
                        (Some(buffer), _) => { builder.storage_read(buffer); }
                        (None, Some(host)) => { builder.read(host); }
                        _ => {}
                    }
                }
                let buffer = builder.storage_write(buffer);
                builder.run(move |_| { note.lock().unwrap().push(index); Ok(()) });
                g.output(buffer);
                values.push((Some(buffer), None));
                chain.push(before);
            } else {
                let mut builder = g.host_node(format!("node {index}"));
                let mut waits = false;
                for &read in &reads {
                    match values[read] {
                        (Some(buffer), _) => { builder.read_back(buffer); waits = true; }
                        (None, Some(host)) => { builder.read(host); }
                        _ => {}
                    }
                }
                let host = builder.write(host);
                builder.run(move |_| { note.lock().unwrap().push(index); Ok(()) });
                g.output(host);
                values.push((None, Some(host)));
                chain.push(before + usize::from(waits));
            }
            needs.push(reads);
        }
        let (device, queue) = noop();
        let mut plan = g.compile(&antumbra_graph::CompileOptions::owned(&device)).unwrap();
        prop_assert_eq!(plan.sync_points(), chain.iter().copied().max().unwrap_or(0));
        let report = plan.execute(&device, &queue).unwrap();
        prop_assert_eq!(report.sync_points as usize, plan.sync_points());
        let ran = ran.lock().unwrap().clone();
        prop_assert_eq!(ran.len(), nodes.len());
        let place = |node: usize| ran.iter().position(|at| *at == node).unwrap();
        for (node, reads) in needs.iter().enumerate() {
            for &read in reads {
                prop_assert!(place(read) < place(node), "{} before {}", read, node);
            }
        }
    }
}
