//! Frames that fail, and devices that are lost.

use std::sync::Arc;

use antumbra_graph::{BodyError, BufferDesc, ExecuteError, Graph};

use crate::device::vulkan;
use crate::sync::step;

#[test]
fn a_failed_frame_leaves_the_plan_usable_and_its_history_empty() {
    let gpu = vulkan();
    let mut g = Graph::new("failure");
    let fail = g.import_host::<bool>("fail");
    let data = g.buffer("data", BufferDesc::new(4));
    let mut node = g.compute("count");
    let data = node.updates(data);
    crate::sync::run_over(&mut node, gpu.compute("data[0] += 1u;"), data);
    let mut node = g.host_node("perhaps fail");
    node.read(fail).read_back(data).side_effect();
    node.run(move |ctx| {
        if *ctx.get(fail)? {
            return Err(BodyError::msg("asked to"));
        }
        assert_eq!(ctx.bytes(data)?.len(), 4);
        Ok(())
    });
    g.output(data);
    let mut plan = gpu.compile(g);
    let mut frame = |fail_now: bool| {
        plan.set(fail, fail_now).unwrap();
        let result = plan.execute(&gpu.device, &gpu.queue);
        (
            result.is_ok(),
            plan.buffer(data).map(|b| gpu.read_u32(b, 1)[0]),
        )
    };
    assert_eq!(frame(false), (true, Some(1)));
    assert_eq!(frame(false), (true, Some(2)));
    assert_eq!(frame(true), (false, None));
    assert_eq!(frame(false), (true, Some(1)));
}

#[test]
fn a_lost_device_is_named() {
    let gpu = vulkan();
    gpu.device.set_device_lost_callback(|_, _| {});
    gpu.device.on_uncaptured_error(Arc::new(|_| {}));
    let mut g = Graph::new("lost");
    let data = g.buffer("data", BufferDesc::new(4));
    let data = step(&mut g, &gpu, "write", data, "data[0] = 1u;");
    let mut node = g.host_node("read");
    node.read_back(data).side_effect();
    node.run(|_| Ok(()));
    let mut plan = gpu.compile(g);
    plan.execute(&gpu.device, &gpu.queue).unwrap();
    gpu.device.destroy();
    let error = plan.execute(&gpu.device, &gpu.queue).unwrap_err();
    assert!(matches!(error, ExecuteError::DeviceLost { .. }), "{error}");
}
