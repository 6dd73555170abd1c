//! Pass times: measured on request, summed by group, absent otherwise.

use antumbra_graph::{BufferDesc, CompileOptions, Graph};

use crate::device::vulkan;
use crate::sync::step;

#[test]
fn passes_and_groups_have_times_when_asked() {
    let gpu = vulkan();
    let mut g = Graph::new("timing");
    let data = g.buffer("data", BufferDesc::new(8).zeroed());
    let data = step(&mut g, &gpu, "one", data, "data[0] += 1u;");
    let other = g.buffer("other", BufferDesc::new(8));
    let mut node = g.copy("two");
    node.group("draw").copy_src(data);
    let other = node.copy_dst(other);
    node.run(move |ctx| {
        let (from, to) = (ctx.buffer(data)?, ctx.buffer(other)?);
        ctx.encoder().copy_buffer_to_buffer(from, 0, to, 0, 8);
        Ok(())
    });
    let sum = g.host::<u32>("sum");
    let mut node = g.host_node("three");
    node.group("draw").read_back(other);
    let sum = node.write(sum);
    node.run(move |ctx| {
        *ctx.get_mut(sum)? = ctx.bytes(other)?.len() as u32;
        Ok(())
    });
    g.output(sum);
    let mut plan = g
        .compile(&CompileOptions::owned(&gpu.device).timing(true))
        .unwrap();
    for _ in 0..8 {
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        gpu.wait();
    }
    let timings = plan.timings().unwrap();
    assert!(timings.frame >= 4, "{timings:?}");
    let names: Vec<_> = timings
        .passes
        .iter()
        .map(|pass| pass.name.as_str())
        .collect();
    assert_eq!(names, ["one", "two", "three"]);
    let timestamps = gpu
        .device
        .features()
        .contains(wgpu::Features::TIMESTAMP_QUERY);
    assert_eq!(timings.passes[0].gpu.is_some(), timestamps);
    assert!(
        timings.passes[2].gpu.is_none(),
        "a host node takes no GPU time"
    );
    assert_eq!(timings.groups.len(), 1);
    assert_eq!(
        timings.groups[0].cpu,
        timings.passes[1].cpu + timings.passes[2].cpu
    );
    plan.set_timing(false);
    plan.execute(&gpu.device, &gpu.queue).unwrap();
    assert_eq!(plan.timings().unwrap().frame, timings.frame);
}
