//! Same-frame read-back and the order of uploads.

use antumbra_graph::{Bind, Buffer, BufferDesc, Graph};

use crate::device::{Gpu, vulkan};

/// Adds a compute node that runs `body` over `data`.
pub fn step(g: &mut Graph, gpu: &Gpu, name: &str, data: Buffer, body: &str) -> Buffer {
    let pipeline = gpu.compute(body);
    let mut node = g.compute(name);
    let data = node.storage_write(data);
    run_over(&mut node, pipeline, data);
    data
}

pub fn run_over(
    node: &mut antumbra_graph::ComputeBuilder<'_>,
    pipeline: wgpu::ComputePipeline,
    data: Buffer,
) {
    node.run(move |ctx| {
        let layout = pipeline.get_bind_group_layout(0);
        let group = ctx.bind_group(0, &layout, &[Bind::Buffer(0, data)])?;
        ctx.pass().set_pipeline(&pipeline);
        ctx.pass().set_bind_group(0, &group, &[]);
        ctx.pass().dispatch_workgroups(1, 1, 1);
        Ok(())
    });
}

#[test]
fn a_host_node_reads_what_the_gpu_wrote_this_frame() {
    let gpu = vulkan();
    let mut g = Graph::new("sync");
    let start = g.import_host::<u32>("start");
    let data = g.buffer("data", BufferDesc::new(8));
    let mut node = g.host_node("upload");
    node.read(start);
    let data = node.upload(data);
    node.run(move |ctx| {
        let start = *ctx.get(start)?;
        ctx.upload(data, 0, bytemuck::cast_slice(&[start, 0]))?;
        Ok(())
    });
    let data = step(&mut g, &gpu, "double", data, "data[1] = data[0] * 2u;");
    let sum = g.host::<u32>("sum");
    let mut node = g.host_node("read");
    node.read_back(data);
    let sum = node.write(sum);
    node.run(move |ctx| {
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(ctx.bytes(data)?);
        *ctx.get_mut(sum)? = words.iter().sum();
        Ok(())
    });
    g.output(sum);
    let mut plan = gpu.compile(g);
    assert_eq!(plan.sync_points(), 1);
    for start_value in [5, 6, 7] {
        plan.set(start, start_value).unwrap();
        let report = plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(report.sync_points, 1);
        assert_eq!(plan.get(sum), Some(&(start_value * 3)));
    }
}

/// A thread that polls a device may run another thread's callbacks, and run them after that thread's wait has returned.
#[test]
fn a_wait_ends_with_the_answer_though_other_threads_poll_the_device() {
    let gpu = vulkan();
    let done = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                while !done.load(std::sync::atomic::Ordering::Relaxed) {
                    let _ = gpu.device.poll(wgpu::PollType::Poll);
                }
            });
        }
        let mut g = Graph::new("polled");
        let data = g.buffer("data", BufferDesc::new(4).zeroed());
        let data = step(&mut g, &gpu, "count", data, "data[0] += 1u;");
        let found = g.host::<u32>("found");
        let mut node = g.host_node("read");
        node.read_back(data);
        let found = node.write(found);
        node.run(move |ctx| {
            *ctx.get_mut(found)? = bytemuck::pod_read_unaligned(ctx.bytes(data)?);
            Ok(())
        });
        g.output(found);
        let mut plan = gpu.compile(g);
        let failed = (0..2000).find_map(|frame| {
            let outcome = plan.execute(&gpu.device, &gpu.queue);
            outcome.err().map(|error| format!("frame {frame}: {error}"))
        });
        done.store(true, std::sync::atomic::Ordering::Relaxed);
        assert_eq!(failed, None);
        assert_eq!(plan.get(found), Some(&1));
    });
}

#[test]
fn uploads_take_their_place_among_the_commands() {
    let gpu = vulkan();
    let mut g = Graph::new("uploads");
    let data = g.buffer("data", BufferDesc::new(12).zeroed());
    let upload = |g: &mut Graph, name: &str, data: Buffer, value: u32| {
        let mut node = g.host_node(name);
        let data = node.upload(data);
        node.run(move |ctx| {
            assert!(ctx.upload(data, 8, &[0; 8]).is_err(), "beyond the end");
            assert!(ctx.upload(data, 2, &[0; 4]).is_err(), "not aligned");
            ctx.upload(data, 0, &value.to_le_bytes())?;
            Ok(())
        });
        data
    };
    let data = upload(&mut g, "first", data, 10);
    let data = step(&mut g, &gpu, "keep it", data, "data[1] += data[0];");
    let data = upload(&mut g, "second", data, 1);
    let data = step(&mut g, &gpu, "add it", data, "data[1] += data[0];");
    g.output(data);
    let mut plan = gpu.compile(g);
    for _ in 0..3 {
        plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(gpu.read_u32(plan.buffer(data).unwrap(), 3), [1, 11, 0]);
    }
}

#[test]
fn nothing_read_is_nothing_waited_for() {
    let gpu = vulkan();
    let mut g = Graph::new("sometimes");
    let wanted = g.import_host::<u64>("wanted");
    let data = g.buffer("data", BufferDesc::new(8).zeroed());
    let data = step(&mut g, &gpu, "count", data, "data[0] += 7u;");
    let read = g.host::<usize>("read");
    let mut node = g.host_node("read");
    node.read(wanted)
        .read_back(data)
        .bytes(move |host| host.get(wanted).map_or(0, |bytes| *bytes));
    let read = node.write(read);
    node.run(move |ctx| {
        *ctx.get_mut(read)? = ctx.bytes(data)?.len();
        Ok(())
    });
    g.output(read);
    g.output(data);
    let mut plan = gpu.compile(g);
    for bytes in [4_usize, 0, 8, 0, 0, 4] {
        plan.set(wanted, bytes as u64).unwrap();
        let report = plan.execute(&gpu.device, &gpu.queue).unwrap();
        assert_eq!(report.sync_points, u32::from(bytes > 0));
        assert_eq!(plan.get(read), Some(&bytes));
        assert_eq!(gpu.read_u32(plan.buffer(data).unwrap(), 1), [7]);
    }
}
