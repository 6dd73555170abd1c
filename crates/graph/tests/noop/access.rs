//! What a node's body may access, and which errors of it fail a frame.

use std::error::Error;

use antumbra_graph::{
    AccessError, BodyError, CompileOptions, ExecuteError, Graph, HostContext, Plan,
};

use crate::declare::{bytes, compute, noop};

/// The access error of the one body that fails.
fn failure(mut plan: Plan, device: &wgpu::Device, queue: &wgpu::Queue) -> AccessError {
    let error = plan.execute(device, queue).unwrap_err();
    assert!(matches!(error, ExecuteError::Body { .. }), "{error}");
    let source = error.source().unwrap().downcast_ref::<AccessError>();
    source.unwrap().clone()
}

fn one(
    declare: impl FnOnce(&mut Graph),
    body: impl FnMut(&mut HostContext<'_>) -> Result<(), BodyError> + Send + 'static,
) -> AccessError {
    let (device, queue) = noop();
    let mut g = Graph::new("access");
    declare(&mut g);
    g.host_node("body").side_effect().run(body);
    let plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    failure(plan, &device, &queue)
}

#[test]
fn only_declared_resources_can_be_reached() {
    let mut g = Graph::new("undeclared");
    let secret = g.host::<u32>("secret");
    let data = g.buffer("data", bytes(4));
    let written = compute(&mut g, "write", data, &[]);
    g.output(written);
    let mut node = g.host_node("write secret");
    let value = node.write(secret);
    node.run(|_| Ok(()));
    g.output(value);
    let mut node = g.host_node("prying");
    node.read(value).side_effect();
    node.run(move |ctx| {
        assert!(ctx.get(value).is_ok());
        assert!(ctx.buffer(written).is_err());
        assert!(ctx.bytes(written).is_err());
        assert!(ctx.upload(written, 0, &[]).is_err());
        assert!(ctx.get(value.previous()).is_err());
        *ctx.get_mut(value)? += 1;
        Ok(())
    });
    let (device, queue) = noop();
    let plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    assert_eq!(
        failure(plan, &device, &queue),
        AccessError::Undeclared {
            pass: "prying".into(),
            resource: "secret".into(),
            verb: "writes"
        }
    );
}

#[test]
fn a_foreign_handle_or_read_back_fails_the_frame() {
    let mut other = Graph::new("other");
    let foreign = other.host::<u32>("foreign");
    let data = other.buffer("data", bytes(4));
    let read_back = other.host_node("reader").read_previous(data, foreign);
    let error = one(
        |_| (),
        move |ctx| {
            ctx.get(foreign)?;
            Ok(())
        },
    );
    assert!(matches!(error, AccessError::Foreign { .. }));
    let error = one(
        |_| (),
        move |ctx| {
            assert!(ctx.late(read_back).is_none());
            Ok(())
        },
    );
    assert!(matches!(error, AccessError::Foreign { .. }));
}

#[test]
fn a_value_cannot_be_read_and_written_at_once_but_several_can_be_held() {
    let (device, queue) = noop();
    let mut g = Graph::new("borrows");
    let (a, b) = (g.host::<Vec<u32>>("a"), g.host::<Vec<u32>>("b"));
    let mut node = g.host_node("two at once");
    let (a, b) = (node.write(a), node.write(b));
    node.run(move |ctx| {
        let (mut a, mut b) = (ctx.get_mut(a)?, ctx.get_mut(b)?);
        a.push(1);
        b.push(2);
        Ok(())
    });
    let mut node = g.host_node("both ways");
    node.read(a);
    let c = node.write(a);
    node.side_effect().run(move |ctx| {
        let held = ctx.get(a)?;
        let refused = ctx.get_mut(c).err();
        assert!(matches!(refused, Some(AccessError::Borrowed { .. })));
        drop(held);
        ctx.get_mut(c)?.push(3);
        Ok(())
    });
    g.output(b);
    g.output(c);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    for frame in 1..=3 {
        plan.execute(&device, &queue).unwrap();
        assert_eq!(
            plan.get(c).map(Vec::len),
            Some(2 * frame),
            "kept between frames"
        );
        assert_eq!(plan.get(b), Some(&vec![2; frame]));
    }
    assert_eq!(plan.get(a), plan.get(c), "one resource, one value");
}

#[test]
fn previous_host_values_lag_by_a_frame_and_updates_go_on() {
    let (device, queue) = noop();
    let mut g = Graph::new("history");
    let input = g.import_host::<u32>("input");
    let value = g.host::<u32>("value");
    let sum = g.host::<u32>("sum");
    let seen = g.host::<(u32, u32, bool)>("seen");
    let mut node = g.host_node("write");
    node.read(input);
    let now = node.write(value);
    node.run(move |ctx| {
        *ctx.get_mut(now)? = *ctx.get(input)?;
        Ok(())
    });
    let mut node = g.host_node("add up");
    node.read(now);
    let sum = node.updates(sum);
    node.run(move |ctx| {
        *ctx.get_mut(sum)? += *ctx.get(now)?;
        Ok(())
    });
    let mut node = g.host_node("see");
    node.read(now).read(now.previous());
    let seen = node.write(seen);
    node.run(move |ctx| {
        *ctx.get_mut(seen)? = (
            *ctx.get(now)?,
            *ctx.get(now.previous())?,
            ctx.has_previous(),
        );
        Ok(())
    });
    g.output(sum);
    g.output(seen);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    for (input_value, expected, total) in [
        (3, (3, 0, false), 3),
        (4, (4, 3, true), 7),
        (5, (5, 4, true), 12),
    ] {
        plan.set(input, input_value).unwrap();
        plan.execute(&device, &queue).unwrap();
        assert_eq!(plan.get(seen), Some(&expected));
        assert_eq!(plan.get(sum), Some(&total));
    }
    plan.reset_history(&device);
    plan.set(input, 6).unwrap();
    plan.execute(&device, &queue).unwrap();
    assert_eq!(plan.get(seen), Some(&(6, 0, false)));
    assert_eq!(plan.get(sum), Some(&6));
}

#[test]
fn a_plan_can_move_to_another_thread() {
    let (device, queue) = noop();
    let mut g = Graph::new("thread");
    let value = g.host::<u32>("value");
    let mut node = g.host_node("write");
    let value = node.write(value);
    node.run(move |ctx| {
        *ctx.get_mut(value)? = 7;
        Ok(())
    });
    g.output(value);
    let mut plan = g.compile(&CompileOptions::owned(&device)).unwrap();
    let plan = std::thread::spawn(move || plan.execute(&device, &queue).map(|_| plan))
        .join()
        .unwrap()
        .unwrap();
    assert_eq!(plan.get(value), Some(&7));
}
