//! Host loops: iterations with sync points, values kept between iterations, limits.

use antumbra_graph::{BufferDesc, ExecuteError, Graph, Host, LoopOptions, LoopSyncPoints};

use crate::device::{Gpu, vulkan};
use crate::sync::step;

/// A loop that doubles `data[0]` in each iteration, counts iterations in `data[1]`, and ends when `data[0]` has reached 100.
fn doubling(gpu: &Gpu, limit: u32) -> (Graph, antumbra_graph::Buffer, Host<u32>) {
    let mut g = Graph::new("loop");
    let data = g.buffer("data", BufferDesc::new(8).zeroed());
    let turns = g.host::<u32>("turns");
    let mut node = g.host_node("begin");
    let turns = node.write(turns);
    node.run(move |ctx| {
        *ctx.get_mut(turns)? = 0;
        Ok(())
    });
    let mut grown = data;
    let mut counted = turns;
    g.host_loop_with("grow", LoopOptions { limit }, |g| {
        grown = step(
            g,
            gpu,
            "double",
            data,
            "data[0] = max(data[0] * 2u, 1u); data[1] += 1u;",
        );
        let done = g.host::<bool>("done");
        let mut node = g.host_node("look");
        node.read_back(grown);
        let done = node.write(done);
        let (before, after) = (counted, node.write(counted));
        counted = after;
        node.run(move |ctx| {
            let words: Vec<u32> = bytemuck::pod_collect_to_vec(ctx.bytes(grown)?);
            assert_eq!(ctx.iteration() + 1, words[1]);
            *ctx.get_mut(before)? += 1;
            *ctx.get_mut(done)? = words[0] >= 100;
            Ok(())
        });
        done
    });
    g.output(grown);
    g.output(counted);
    (g, grown, counted)
}

#[test]
fn turns_go_on_until_the_condition_holds_and_start_anew_each_frame() {
    let gpu = vulkan();
    let (g, data, turns) = doubling(&gpu, 50);
    let mut plan = gpu.compile(g);
    assert_eq!(
        (plan.sync_points(), plan.loop_sync_points()),
        (
            0,
            vec![LoopSyncPoints {
                name: "grow",
                sync_points: 1
            }]
        )
    );
    for _ in 0..2 {
        let report = plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!((report.loop_iterations, report.sync_points), (8, 8));
        assert_eq!(gpu.read_u32(plan.buffer(data).unwrap(), 2), [128, 8]);
        assert_eq!(plan.get(turns), Some(&8));
    }
}

#[test]
fn a_loop_that_does_not_end_fails_the_frame_by_name() {
    let gpu = vulkan();
    let (g, _, turns) = doubling(&gpu, 5);
    let mut plan = gpu.compile(g);
    let error = plan.execute(&gpu.device, &gpu.queue).unwrap_err();
    assert!(
        matches!(&error, ExecuteError::LoopLimit { pass, limit: 5 } if pass == "grow"),
        "{error}"
    );
    assert_eq!(plan.get(turns), None, "a failed frame has no outputs");
    assert_eq!(plan.frame(), 0);
}
