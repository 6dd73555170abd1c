//! Access to the previous frame: textures, buffers and host values, and updates in place.

use antumbra_graph::{BufferDesc, Clear, Graph, TextureDesc};

use crate::device::vulkan;
use crate::sync::{run_over, step};

#[test]
fn a_previous_buffer_is_last_frames_and_zero_at_first() {
    let gpu = vulkan();
    let mut g = Graph::new("previous buffer");
    let number = g.import_host::<u32>("number");
    let data = g.buffer("data", BufferDesc::new(4));
    let kept = g.buffer("kept", BufferDesc::new(4));
    let mut node = g.host_node("upload");
    node.read(number);
    let written = node.upload(data);
    node.run(move |ctx| {
        let number = *ctx.get(number)?;
        ctx.upload(written, 0, &number.to_le_bytes())?;
        Ok(())
    });
    let mut node = g.copy("look back");
    node.copy_src(data.previous());
    let kept = node.copy_dst(kept);
    node.run(move |ctx| {
        assert_eq!(ctx.has_previous(), ctx.frame() > 0);
        let (from, to) = (ctx.buffer(data.previous())?, ctx.buffer(kept)?);
        ctx.encoder().copy_buffer_to_buffer(from, 0, to, 0, 4);
        Ok(())
    });
    g.output(kept);
    let mut plan = gpu.compile(g);
    let mut seen = Vec::new();
    for number_value in [7, 8, 9, 10] {
        plan.set(number, number_value).unwrap();
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        seen.extend(gpu.read_u32(plan.buffer(kept).unwrap(), 1));
    }
    assert_eq!(seen, [0, 7, 8, 9]);
}

#[test]
fn a_previous_texture_keeps_last_frames_depth() {
    let gpu = vulkan();
    let mut g = Graph::new("previous texture");
    let depth = g.texture(
        "depth",
        TextureDesc::new(64, 64, wgpu::TextureFormat::Depth32Float).cleared(Clear::Depth(0.0)),
    );
    let image = g.texture(
        "image",
        TextureDesc::new(64, 64, wgpu::TextureFormat::Rgba8Unorm)
            .cleared(Clear::Colour(wgpu::Color::BLACK)),
    );
    let mut node = g.raster("plate, nearer in odd frames");
    let _ = node.depth(depth);
    let plate = gpu.fill(None, Some(true));
    node.run(move |ctx| {
        let instance = if ctx.frame() % 2 == 1 { 6000 } else { 2000 };
        ctx.pass().set_pipeline(&plate);
        ctx.pass().draw(0..3, instance..instance + 1);
        Ok(())
    });
    let mut node = g.raster("test against last frame");
    let image = node.colour(image);
    node.depth_read(depth.previous());
    let red = gpu.fill(Some("vec4f(1.0, 0.0, 0.0, 1.0)"), Some(false));
    node.run(move |ctx| {
        ctx.pass().set_pipeline(&red);
        ctx.pass().draw(0..3, 4000..4001);
        Ok(())
    });
    g.output(image);
    let mut plan = gpu.compile(g);
    let mut seen = Vec::new();
    for _ in 0..4 {
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        seen.push(gpu.middle(plan.texture(image).unwrap())[0] > 0);
    }
    assert_eq!(seen, [true, true, false, true]);
}

#[test]
fn an_update_goes_on_from_last_frame_and_previous_readers_come_before_it() {
    let gpu = vulkan();
    let mut g = Graph::new("update");
    let data = g.buffer("data", BufferDesc::new(4));
    let before = g.buffer("before", BufferDesc::new(4));
    let mut node = g.compute("count");
    let counted = node.updates(data);
    run_over(&mut node, gpu.compute("data[0] += 1u;"), counted);
    let counted = step(&mut g, &gpu, "and ten", counted, "data[0] += 10u;");
    let mut node = g.copy("look back, declared later");
    node.copy_src(data.previous());
    let before = node.copy_dst(before);
    node.run(move |ctx| {
        let (from, to) = (ctx.buffer(data.previous())?, ctx.buffer(before)?);
        ctx.encoder().copy_buffer_to_buffer(from, 0, to, 0, 4);
        Ok(())
    });
    g.output(before);
    g.output(counted);
    let mut plan = gpu.compile(g);
    assert_eq!(plan.physical_buffers(), 2);
    let mut seen = Vec::new();
    for frame in 0..5 {
        if frame == 3 {
            plan.reset_history(&gpu.device);
        }
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        seen.push((
            gpu.read_u32(plan.buffer(before).unwrap(), 1)[0],
            gpu.read_u32(plan.buffer(counted).unwrap(), 1)[0],
        ));
    }
    assert_eq!(seen, [(0, 11), (11, 22), (22, 33), (0, 11), (11, 22)]);
}
