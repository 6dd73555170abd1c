//! Host loops without a GPU: what later iterations see, nested loops, and how loops end.

use antumbra_graph::{CompileOptions, ExecuteError, Graph, Host, LoopOptions};

use crate::declare::noop;

/// A host node that writes `target` from `source`.
fn map<A: 'static, B: Default + Send + 'static>(
    g: &mut Graph,
    name: &str,
    source: Host<A>,
    target: Host<B>,
    mut map: impl FnMut(&A, &mut B) + Send + 'static,
) -> Host<B> {
    let mut node = g.host_node(name);
    node.read(source);
    let target = node.write(target);
    node.run(move |ctx| {
        map(&*ctx.get(source)?, &mut *ctx.get_mut(target)?);
        Ok(())
    });
    target
}

#[test]
fn a_version_from_before_the_loop_is_on_later_turns_what_the_loop_wrote_last() {
    let (device, queue) = noop();
    let mut g = Graph::new("carried");
    let start = g.import_host::<u32>("start");
    let state = g.host::<u32>("state");
    let before = map(&mut g, "begin", start, state, |start, state| {
        *state = *start
    });
    let (seen, next, done) = (
        g.host::<Vec<u32>>("seen"),
        g.host::<u32>("next"),
        g.host::<bool>("done"),
    );
    let seen = map(&mut g, "nothing seen", start, seen, |_, seen| seen.clear());
    let (mut all, mut last) = (seen, before);
    g.host_loop("loop", |g| {
        all = map(g, "see", before, seen, |state, seen: &mut Vec<u32>| {
            seen.push(*state);
        });
        let next = map(g, "next", before, next, |state, next| *next = *state + 1);
        last = map(g, "write back", next, before, |next, state| *state = *next);
        map(g, "decide", last, done, |state, done| *done = *state >= 5)
    });
    let after = g.host::<u32>("after");
    let after = map(&mut g, "outside", last, after, |state, after| {
        *after = *state
    });
    g.output(all);
    g.output(after);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    for (from, expected) in [(2, vec![2, 3, 4]), (4, vec![4]), (9, vec![9])] {
        plan.set(start, from).unwrap();
        let report = plan.execute(&device, &queue).unwrap();
        assert_eq!(plan.get(all), Some(&expected));
        assert_eq!(plan.get(after), Some(&(expected.last().unwrap() + 1)));
        assert_eq!(report.loop_iterations as usize, expected.len());
    }
}

#[test]
fn loops_in_loops_turn_on_their_own() {
    let (device, queue) = noop();
    let mut g = Graph::new("nested");
    let turns = g.host::<Vec<u32>>("turns");
    let begin = g.import_host::<()>("begin");
    let mut log = map(&mut g, "begin", begin, turns, |(), turns| turns.clear());
    g.host_loop("outer", |g| {
        let inner_done = g.host::<bool>("inner done");
        let mut inner = None;
        g.host_loop("inner", |g| {
            let mut node = g.host_node("log");
            log = node.write(log);
            let (log, done) = (log, node.write(inner_done));
            inner = Some(done);
            node.run(move |ctx| {
                ctx.get_mut(log)?.push(ctx.iteration());
                *ctx.get_mut(done)? = ctx.iteration() == 2;
                Ok(())
            });
            done
        });
        let outer_done = g.host::<bool>("outer done");
        let mut node = g.host_node("outer turn");
        node.read(inner.unwrap());
        let done = node.write(outer_done);
        node.run(move |ctx| {
            *ctx.get_mut(done)? = ctx.iteration() == 1;
            Ok(())
        });
        done
    });
    g.output(log);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    for _ in 0..2 {
        plan.set(begin, ()).unwrap();
        let report = plan.execute(&device, &queue).unwrap();
        assert_eq!(plan.get(log), Some(&vec![0, 1, 2, 0, 1, 2]));
        assert_eq!(report.loop_iterations, 8);
    }
}

#[test]
fn the_limit_is_an_error_with_the_loops_name() {
    let (device, queue) = noop();
    let mut g = Graph::new("endless");
    g.host_loop_with("endless", LoopOptions { limit: 3 }, |g| {
        let done = g.host::<bool>("done");
        let mut node = g.host_node("never");
        let done = node.write(done);
        node.side_effect().run(|_| Ok(()));
        done
    });
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    assert!(matches!(
        plan.execute(&device, &queue),
        Err(ExecuteError::LoopLimit { pass, limit: 3 }) if pass == "endless"
    ));
}
