//! Plans embedded in a host's frame: they record between the host's commands and submit nothing.

use antumbra_graph::{BufferDesc, CompileOptions, ExecuteError, Graph};

use crate::device::vulkan;
use crate::sync::step;

#[test]
fn commands_land_in_the_middle_of_a_foreign_encoder() {
    let gpu = vulkan();
    let mut g = Graph::new("embedded");
    let data = g.import_buffer("data", BufferDesc::new(8));
    let mut node = g.host_node("upload");
    let uploaded = node.upload(data);
    node.run(move |ctx| {
        let frame = ctx.frame() as u32 + 1;
        ctx.upload(uploaded, 4, &frame.to_le_bytes())?;
        Ok(())
    });
    let _ = step(
        &mut g,
        &gpu,
        "add",
        uploaded,
        "data[0] = data[0] * 10u + data[1];",
    );
    let options = CompileOptions::embedded(&gpu.device).timing(true);
    let mut plan = g.compile(&options).unwrap();
    assert!(matches!(
        plan.execute(&gpu.device, &gpu.queue),
        Err(ExecuteError::WrongMode { .. })
    ));
    let usage =
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let make = |size| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let (theirs, copies) = (make(8), make(16));
    plan.bind_buffer(data, &theirs).unwrap();
    for round in 0..3 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&theirs, 0, None);
        for frame in 0..2 {
            let report = plan.record(&gpu.device, &gpu.queue, &mut encoder).unwrap();
            assert_eq!(report.frame, round * 2 + frame);
            assert!(report.submission.is_none());
            encoder.copy_buffer_to_buffer(&theirs, 0, &copies, frame * 8, 8);
        }
        gpu.queue.submit([encoder.finish()]);
        let one = round as u32 * 2 + 1;
        assert_eq!(
            gpu.read_u32(&copies, 4),
            [one, one, one * 10 + one + 1, one + 1]
        );
    }
    let timings = plan.timings().expect("a submitted frame was measured");
    assert_eq!(timings.passes.len(), 2);
}
