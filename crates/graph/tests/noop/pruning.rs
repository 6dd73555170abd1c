//! Pruning keeps passes with outputs, imports or side effects, and what these need: in this frame, from the previous one, in loops and by
//! read-back.

use antumbra_graph::Graph;

use crate::declare::{bytes, colour, compile, compute, draw, names};

#[test]
fn what_nobody_sees_is_pruned_and_listed() {
    let mut g = Graph::new("pruning");
    let (a, b, c) = (
        g.texture("a", colour()),
        g.texture("b", colour()),
        g.texture("c", colour()),
    );
    let a = draw(&mut g, "needed by b", a, &[]);
    let b = draw(&mut g, "output", b, &[a]);
    let c = draw(&mut g, "unseen", c, &[a]);
    let _ = draw(&mut g, "unseen too", c, &[]);
    g.output(b);
    let plan = compile(g);
    assert_eq!(names(&plan), ["needed by b", "output"]);
    assert_eq!(plan.pruned(), ["unseen", "unseen too"]);
    assert_eq!(plan.physical_textures(), 2);
}

#[test]
fn side_effects_and_written_imports_are_kept() {
    let mut g = Graph::new("effects");
    let import = g.import_buffer("import", bytes(4));
    let scratch = g.buffer("scratch", bytes(4));
    let _ = compute(&mut g, "into an import", import, &[]);
    let mut node = g.host_node("side effect");
    node.side_effect().run(|_| Ok(()));
    let _ = compute(&mut g, "into nothing", scratch, &[]);
    let plan = compile(g);
    assert_eq!(names(&plan), ["into an import", "side effect"]);
    assert_eq!(plan.pruned(), ["into nothing"]);
}

#[test]
fn history_keeps_its_writers() {
    let mut g = Graph::new("history");
    let past = g.buffer("past", bytes(4));
    let now = g.buffer("now", bytes(4));
    let now = compute(&mut g, "look back", now, &[past.previous()]);
    let past = compute(&mut g, "first", past, &[]);
    let _ = compute(&mut g, "final", past, &[]);
    g.output(now);
    let plan = compile(g);
    assert_eq!(names(&plan), ["look back", "first", "final"]);
    assert_eq!(plan.physical_buffers(), 3, "the past lies in two places");
}

#[test]
fn an_update_keeps_later_writers_for_the_next_frame() {
    let mut g = Graph::new("update");
    let state = g.buffer("state", bytes(4));
    let seen = g.buffer("seen", bytes(4));
    let mut node = g.compute("update");
    let state = node.updates(state);
    node.run(|_| Ok(()));
    let seen = compute(&mut g, "see", seen, &[state]);
    let _ = compute(&mut g, "change for next frame", state, &[]);
    g.output(seen);
    let plan = compile(g);
    assert_eq!(names(&plan), ["update", "see", "change for next frame"]);
}

#[test]
fn a_late_read_back_keeps_the_writers_of_its_buffer_and_tag() {
    let mut g = Graph::new("late");
    let data = g.buffer("data", bytes(4));
    let tag = g.host::<u32>("tag");
    let mut node = g.host_node("reader");
    let _ = node.read_previous(data, tag);
    node.side_effect().run(|_| Ok(()));
    let _ = compute(&mut g, "write data", data, &[]);
    let mut node = g.host_node("write tag");
    let _ = node.write(tag);
    node.run(|_| Ok(()));
    assert_eq!(names(&compile(g)), ["reader", "write data", "write tag"]);
}

#[test]
fn in_a_loop_the_carried_writer_is_kept() {
    let mut g = Graph::new("carried");
    let state = g.buffer("state", bytes(4));
    let state = compute(&mut g, "begin", state, &[]);
    let mut out = None;
    g.host_loop("loop", |g| {
        let seen = g.buffer("seen", bytes(4));
        let seen = compute(g, "reads what the last turn wrote", seen, &[state]);
        let _ = compute(g, "writes for the next turn", state, &[]);
        let scratch = g.buffer("scratch", bytes(4));
        let _ = compute(g, "unseen", scratch, &[state]);
        let done = g.host::<bool>("done");
        let mut node = g.host_node("decide");
        let done = node.write(done);
        node.run(|_| Ok(()));
        out = Some(seen);
        done
    });
    g.output(out.unwrap());
    let plan = compile(g);
    assert_eq!(plan.pruned(), ["unseen"]);
    assert_eq!(
        names(&plan),
        [
            "begin",
            "loop",
            "reads what the last turn wrote",
            "writes for the next turn",
            "decide"
        ]
    );
}
