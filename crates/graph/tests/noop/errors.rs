//! Declarations that `compile` refuses; it reports all errors at once.

use antumbra_graph::{CompileError, CompileOptions, Graph};

use crate::declare::{bytes, colour, compute, depth, draw, errors, noop, wait};

/// Asserts that there is exactly one error, of this shape.
macro_rules! assert_refused {
    ($graph:expr, $pattern:pat $(if $guard:expr)?) => {{
        let errors = errors($graph);
        assert!(
            matches!(errors.as_slice(), [$pattern] $(if $guard)?),
            "{errors:#?}"
        );
    }};
}

#[test]
fn a_cycle_names_its_passes_in_order() {
    let mut g = Graph::new("cycle");
    let (t, u) = (
        g.import_texture("t", colour()),
        g.import_texture("u", colour()),
    );
    let first = draw(&mut g, "a", t, &[]);
    let second = draw(&mut g, "b", u, &[first]);
    let own = g.texture("own", colour());
    // Reads t before `a` writes it, and u after `b` has written it.
    let _ = draw(&mut g, "c", own, &[t, second]);
    assert_refused!(g, CompileError::Cycle { passes } if passes == &["a", "b", "c"]);
}

#[test]
fn a_value_updated_in_place_cannot_be_looked_back_at_after_the_update() {
    let mut g = Graph::new("cycle");
    let state = g.buffer("state", bytes(4));
    let mut node = g.compute("update");
    let now = node.updates(state);
    node.run(|_| Ok(()));
    let out = g.import_buffer("out", bytes(4));
    let _ = compute(&mut g, "both", out, &[now, state.previous()]);
    assert_refused!(g, CompileError::Cycle { passes } if passes.len() == 2);
}

#[test]
fn reading_what_nobody_wrote() {
    let mut g = Graph::new("unwritten");
    let (a, b) = (g.texture("a", colour()), g.texture("b", colour()));
    let _ = draw(&mut g, "draw", a, &[b]);
    assert_refused!(g, CompileError::ReadBeforeWrite { pass, resource, version: 0 } if pass == "draw" && resource == "b");
    for late in [false, true] {
        let mut g = Graph::new("unwritten");
        let data = g.buffer("data", bytes(4));
        let tag = g.import_host::<u32>("tag");
        let mut node = g.host_node("reader");
        if late {
            let _ = node.read_previous(data, tag);
        } else {
            node.read_back(data.previous());
        }
        node.run(|_| Ok(()));
        assert_refused!(g, CompileError::ReadBeforeWrite { resource, .. } if resource == "data");
    }
    let mut g = Graph::new("unwritten output");
    let data = g.buffer("data", bytes(4));
    g.output(data);
    assert_refused!(g, CompileError::ReadBeforeWrite { .. });
}

#[test]
fn two_writers_without_an_order() {
    let mut g = Graph::new("writers");
    let image = g.texture("image", colour());
    let _ = draw(&mut g, "one", image, &[]);
    let _ = draw(&mut g, "two", image, &[]);
    assert_refused!(g, CompileError::TwoWriters { first, second, resource, version: 0 }
        if first == "one" && second == "two" && resource == "image");
}

#[test]
fn attachments_that_do_not_fit() {
    let mut g = Graph::new("sizes");
    let image = g.texture("image", colour());
    let small = g.texture(
        "small",
        antumbra_graph::TextureDesc {
            width: 32,
            ..depth()
        },
    );
    let mut node = g.raster("draw");
    let _ = (node.colour(image), node.depth(small));
    node.run(|_| Ok(()));
    assert_refused!(g, CompileError::AttachmentMismatch { pass, .. } if pass == "draw");

    let mut g = Graph::new("samples");
    let image = g.texture("image", colour().samples(4));
    let plain = g.texture("plain", depth());
    let mut node = g.raster("draw");
    let _ = (node.colour(image), node.depth(plain));
    node.run(|_| Ok(()));
    assert_refused!(g, CompileError::AttachmentMismatch { second, .. } if second == "plain");

    let mut g = Graph::new("none");
    let mut node = g.raster("draw");
    node.side_effect().run(|_| Ok(()));
    assert_refused!(g, CompileError::NoAttachment { .. });

    let mut g = Graph::new("mip");
    let image = g.texture("image", colour().mips(2));
    let mut node = g.raster("draw");
    let _ = node.colour_at(image, 2, 0);
    node.run(|_| Ok(()));
    let errors = errors(g);
    assert!(
        matches!(
            &errors[0],
            CompileError::NoSuchSubresource {
                mip: 2,
                mips: 2,
                ..
            }
        ),
        "{errors:?}"
    );
}

#[test]
fn handles_of_another_graph() {
    let mut other = Graph::new("other");
    let foreign = other.texture("foreign", colour());
    let foreign_host = other.host::<bool>("foreign");
    let foreign_pass = other.host_node("foreign").run(|_| Ok(()));
    let mut g = Graph::new("foreign");
    let mut node = g.raster("draw");
    let _ = node.colour(foreign);
    node.after(foreign_pass).run(|_| Ok(()));
    g.output(foreign);
    g.host_loop("loop", |_| foreign_host);
    let errors = errors(g);
    let foreigners = errors
        .iter()
        .filter(|error| matches!(error, CompileError::ForeignHandle { .. }));
    assert_eq!(foreigners.count(), 4, "{errors:#?}");
}

#[test]
fn bodies_missing_or_given_twice() {
    let mut g = Graph::new("none");
    let _ = g.host_node("unfinished");
    assert_refused!(g, CompileError::NoBody { pass } if pass == "unfinished");
    let mut g = Graph::new("two");
    let mut node = g.host_node("twice");
    node.run(|_| Ok(()));
    node.run(|_| Ok(()));
    assert_refused!(g, CompileError::TwoBodies { pass } if pass == "twice");
}

#[test]
fn uses_that_exclude_each_other_in_one_pass() {
    let mut g = Graph::new("texture");
    let image = g.import_texture("image", colour());
    let _ = draw(&mut g, "draw", image, &[image]);
    assert_refused!(
        g,
        CompileError::Conflict {
            first: "colour",
            second: "sample",
            ..
        }
    );

    let mut g = Graph::new("buffer");
    let data = g.import_buffer("data", bytes(64));
    let image = g.texture("image", colour());
    let mut node = g.raster("draw");
    let _ = node.colour(image);
    node.vertex(data);
    let _ = node.storage_write(data);
    node.run(|_| Ok(()));
    assert_refused!(
        g,
        CompileError::Conflict {
            first: "vertex",
            ..
        }
    );

    let mut g = Graph::new("two depths");
    let (a, b) = (g.texture("a", depth()), g.texture("b", depth()));
    let mut node = g.raster("draw");
    let _ = (node.depth(a), node.depth(b));
    node.run(|_| Ok(()));
    assert_refused!(g, CompileError::Conflict { .. });
}

#[test]
fn history_misused() {
    let mut g = Graph::new("write");
    let data = g.buffer("data", bytes(4));
    let _ = compute(&mut g, "write", data.previous(), &[]);
    assert_refused!(g, CompileError::WritesPrevious { .. });

    let mut g = Graph::new("import");
    let data = g.import_buffer("data", bytes(4));
    let out = g.buffer("out", bytes(4));
    let _ = compute(&mut g, "look back", out, &[data.previous()]);
    assert_refused!(g, CompileError::PreviousOfImport { .. });
}

#[test]
fn updates_misused() {
    let update = |g: &mut Graph, name: &str, data| {
        let mut node = g.compute(name);
        let data = node.updates(data);
        node.run(|_| Ok(()));
        data
    };
    let mut g = Graph::new("import");
    let data = g.import_buffer("data", bytes(4));
    update(&mut g, "update", data);
    assert_refused!(g, CompileError::BadUpdate { .. });

    let mut g = Graph::new("late");
    let data = g.buffer("data", bytes(4));
    let data = compute(&mut g, "write", data, &[]);
    update(&mut g, "update", data);
    assert_refused!(g, CompileError::BadUpdate { why, .. } if why.contains("written before"));

    let mut g = Graph::new("twice");
    let data = g.buffer("data", bytes(4));
    let data = update(&mut g, "one", data);
    update(&mut g, "two", data);
    assert!(errors(g).iter().any(
        |error| matches!(error, CompileError::BadUpdate { why, .. } if why.contains("`one`"))
    ));
}

#[test]
fn an_output_that_is_overwritten() {
    let mut g = Graph::new("output");
    let data = g.buffer("data", bytes(4));
    let one = compute(&mut g, "one", data, &[]);
    let _ = compute(&mut g, "two", one, &[]);
    g.output(one);
    assert_refused!(g, CompileError::OutputOverwritten { pass, version: 1, .. } if pass == "two");
}

#[test]
fn embedded_plans_neither_wait_nor_loop() {
    let mut g = Graph::new("embedded");
    let data = g.buffer("data", bytes(4));
    let data = compute(&mut g, "write", data, &[]);
    let value = g.host::<u32>("value");
    let value = wait(&mut g, "reads", &[data], value);
    g.output(value);
    let mut decided = None;
    g.host_loop("loop", |g| {
        let done = g.host::<bool>("done");
        let mut node = g.host_node("decide");
        let done = node.write(done);
        node.side_effect().run(|_| Ok(()));
        decided = Some(done);
        done
    });
    let pruned = g.host::<u32>("pruned");
    let _ = wait(&mut g, "pruned", &[data], pruned);
    let refused = g
        .compile(&CompileOptions::embedded(&noop().0))
        .err()
        .unwrap();
    let mut found = refused.errors.iter();
    assert_eq!(
        found.next(),
        Some(&CompileError::SyncInEmbedded {
            pass: "reads".into(),
            resource: "data".into()
        })
    );
    assert_eq!(
        found.next(),
        Some(&CompileError::LoopInEmbedded {
            pass: "loop".into()
        })
    );
    assert_eq!(found.next(), None, "pruned passes do not matter");
    assert!(refused.to_string().contains("`reads` reads `data` back"));
}

#[test]
fn a_loop_that_nothing_inside_can_end() {
    let mut g = Graph::new("loop");
    let done = g.host::<bool>("done");
    let mut node = g.host_node("outside");
    let done = node.write(done);
    node.run(|_| Ok(()));
    g.host_loop("loop", |g| {
        g.host_node("inside").side_effect().run(|_| Ok(()));
        done
    });
    assert_refused!(g, CompileError::LoopCondition { pass, resource } if pass == "loop" && resource == "done");
}

#[test]
fn descriptions_of_nothing() {
    for desc in [
        antumbra_graph::TextureDesc {
            width: 0,
            ..colour()
        },
        colour().layers(0),
        colour().mips(8),
        colour().samples(0),
        colour().samples(4).mips(2),
    ] {
        let mut g = Graph::new("texture");
        g.texture("nothing", desc);
        assert_refused!(g, CompileError::BadDescription { resource, .. } if resource == "nothing");
    }
    let mut g = Graph::new("buffer");
    g.buffer("nothing", bytes(0));
    assert_refused!(g, CompileError::BadDescription { .. });
}

#[test]
fn all_errors_come_at_once() {
    let mut g = Graph::new("many");
    let (a, b) = (g.texture("a", colour()), g.texture("b", colour()));
    let _ = draw(&mut g, "one", a, &[b]);
    let _ = draw(&mut g, "two", a, &[b]);
    g.buffer("nothing", bytes(0));
    let errors = errors(g);
    assert_eq!(errors.len(), 4, "{errors:#?}");
}
