//! The cost of the graph itself, on wgpu's noop device: compiling, recording a frame, and the same commands recorded by hand.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::hint::black_box;

use antumbra_graph::{BufferDesc, Clear, CompileOptions, Graph, TextureDesc};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

const TARGET: TextureDesc = TextureDesc::new(64, 64, wgpu::TextureFormat::Rgba8Unorm);

/// A chain of raster, compute and host passes. Each reads the one before, and all are kept.
fn chain(passes: usize) -> Graph {
    let mut g = Graph::new("chain");
    let mut image = g.texture("image", TARGET.cleared(Clear::Colour(wgpu::Color::BLACK)));
    let mut data = g.buffer("data", BufferDesc::new(256));
    let mut value = g.host::<u32>("value");
    for pass in 0..passes {
        match pass % 3 {
            0 => {
                let mut node = g.raster(format!("raster {pass}"));
                image = node.colour(image);
                if pass > 0 {
                    node.read(value);
                }
                node.run(|_| Ok(()));
            }
            1 => {
                let mut node = g.compute(format!("compute {pass}"));
                node.sample(image);
                data = node.storage_write(data);
                node.run(|_| Ok(()));
            }
            _ => {
                let mut node = g.host_node(format!("host {pass}"));
                value = node.write(value);
                let value = value;
                node.run(move |ctx| {
                    *ctx.get_mut(value)? += 1;
                    Ok(())
                });
            }
        }
    }
    g.output(image);
    if passes > 1 {
        g.output(data);
    }
    g
}

/// The same passes without the graph.
fn by_hand(passes: usize, encoder: &mut wgpu::CommandEncoder, view: &wgpu::TextureView) {
    let mut value = 0_u32;
    for pass in 0..passes {
        match pass % 3 {
            0 => {
                let load = if pass == 0 {
                    wgpu::LoadOp::Clear(wgpu::Color::BLACK)
                } else {
                    wgpu::LoadOp::Load
                };
                drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("raster"),
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load,
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                }));
            }
            1 => drop(encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("compute"),
                timestamp_writes: None,
            })),
            _ => value = black_box(value + 1),
        }
    }
}

fn benches(criterion: &mut Criterion) {
    let (device, queue) = wgpu::Device::noop(&wgpu::DeviceDescriptor::default());
    let options = CompileOptions::embedded(&device);
    let encoder = || device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 64,
            height: 64,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: TARGET.format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    for passes in [20, 40, 1_000] {
        criterion.bench_function(&format!("compile/{passes}"), |bench| {
            bench.iter_batched(
                || chain(passes),
                |graph| graph.compile(&options).expect("the chain is sound"),
                BatchSize::SmallInput,
            );
        });
        let mut plan = chain(passes).compile(&options).expect("the chain is sound");
        criterion.bench_function(&format!("record/{passes}"), |bench| {
            bench.iter_batched_ref(
                encoder,
                |encoder| plan.record(&device, &queue, encoder).expect("it records"),
                BatchSize::SmallInput,
            );
        });
        criterion.bench_function(&format!("by hand/{passes}"), |bench| {
            bench.iter_batched_ref(
                encoder,
                |encoder| by_hand(passes, encoder, &view),
                BatchSize::SmallInput,
            );
        });
    }
}

criterion_group! {
    name = all;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(500)).measurement_time(std::time::Duration::from_secs(2));
    targets = benches
}
criterion_main!(all);
