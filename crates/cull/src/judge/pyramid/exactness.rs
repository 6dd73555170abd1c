//! Every texel of a pyramid is the least of the pixels that it stands for, no pixel missed and none beside them read: at every width and at every height.
//!
//! In short runs sizes above 300 are taken in steps; PYRAMID_SIZES=whole in the environment takes them all.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use wgpu::util::DeviceExt;

use super::super::depth::{DepthRange, HostDepth};
use super::{FIRST_KEPT, GpuPyramid, MOST_LEVELS};
use crate::device::{AdapterChoice, Gpu};
use crate::read_back;
use antumbra_shaders::{Job, jobs};

/// The longest side, and the other one.
const LONG: u32 = 4096;
const SHORT: u32 = 37;

/// The pipelines of a pyramid, and random depths to make it of.
struct Maker<'a> {
    gpu: &'a Gpu,
    first: wgpu::ComputePipeline,
    rest: wgpu::ComputePipeline,
    depths: Vec<f32>,
    wide: u32,
    depth: wgpu::TextureView,
    texels: wgpu::Buffer,
}

impl<'a> Maker<'a> {
    fn new(gpu: &'a Gpu, [wide, high]: [u32; 2]) -> Self {
        let pipeline = |job: &Job, entry| {
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: None,
                    layout: None,
                    module: &antumbra_shaders::module(&gpu.device, job),
                    entry_point: Some(entry),
                    compilation_options: Default::default(),
                    cache: None,
                })
        };
        let mut random = Pcg32::seed_from_u64(11);
        let depths: Vec<f32> = (0..wide * high)
            .map(|_| random.random_range(0.0..1.0))
            .collect();
        // Bound as floats, as a depth is.
        let texture = gpu.device.create_texture_with_data(
            &gpu.queue,
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: wide,
                    height: high,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::R32Float,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            Default::default(),
            bytemuck::cast_slice(&depths),
        );
        let most = GpuPyramid::new([wide, high], HostDepth::default()).texels();
        Self {
            gpu,
            first: pipeline(&jobs::pyramid_one::JOB, "reduce"),
            rest: pipeline(&jobs::pyramid_rest::JOB, "rest"),
            depths,
            wide,
            depth: texture.create_view(&Default::default()),
            texels: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: most * 4,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        }
    }

    /// The texels of the pyramid of the upper left part of the depths.
    fn texels(&self, layout: &GpuPyramid) -> Vec<f32> {
        let device = &self.gpu.device;
        let levels = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::bytes_of(layout),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut dispatch = |pipeline: &wgpu::ComputePipeline, groups: [u32; 2], reads: bool| {
            let depth = wgpu::BindGroupEntry {
                binding: 7,
                resource: wgpu::BindingResource::TextureView(&self.depth),
            };
            let buffers =
                [(5, &levels), (6, &self.texels)].map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                });
            let entries: Vec<_> = buffers.into_iter().chain(reads.then_some(depth)).collect();
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(groups[0], groups[1], 1);
        };
        let groups = [layout.width, layout.height].map(|side| side.div_ceil(32));
        dispatch(&self.first, groups, true);
        if layout.count > 6 {
            dispatch(&self.rest, [1, 1], false);
        }
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = read_back::buffer(self.gpu, &self.texels).unwrap();
        let texels = bytes.chunks_exact(4).take(layout.texels() as usize);
        texels
            .map(|texel| f32::from_le_bytes(texel.try_into().unwrap()))
            .collect()
    }

    /// Holds the pyramid of a size against the depths: level by level, each from the depths' own pixels.
    fn check(&self, size: [u32; 2], range: DepthRange) {
        let host = HostDepth {
            range,
            ..HostDepth::default()
        };
        let layout = GpuPyramid::new(size, host);
        let texels = self.texels(&layout);
        // The least of each block of the level before, from the pixels on.
        let mut below: Vec<f32> = (0..size[1])
            .flat_map(|y| (0..size[0]).map(move |x| y * self.wide + x))
            .map(|place| range.towards() * self.depths[place as usize])
            .collect();
        let [mut wide, mut high] = size.map(|side| side as usize);
        for level in 1..layout.count.min(MOST_LEVELS as u32) {
            let (columns, rows) = (wide.div_ceil(2), high.div_ceil(2));
            let mut least = vec![f32::INFINITY; columns * rows];
            for (place, depth) in below.iter().enumerate() {
                let into = &mut least[place / wide / 2 * columns + place % wide / 2];
                *into = into.min(*depth);
            }
            (below, wide, high) = (least, columns, rows);
            if level >= FIRST_KEPT {
                let first = layout.levels[level as usize][0] as usize;
                let made = &texels[first..first + below.len()];
                assert_eq!(made, below, "{size:?}, level {level}");
            }
        }
        assert_eq!([wide, high], [1, 1]);
    }
}

#[test]
fn every_texel_is_the_least_of_its_pixels_at_every_width_and_height() {
    let whole = std::env::var("PYRAMID_SIZES").as_deref() == Ok("whole");
    for name in ["vulkan", "gl"] {
        let gpu = Gpu::open(&AdapterChoice::Named(name.to_owned())).unwrap();
        let sides =
            (1..=LONG).filter(|side| whole || *side <= 300 || side % 97 == 0 || *side == LONG);
        let maker = Maker::new(&gpu, [LONG, SHORT]);
        for side in sides.clone() {
            // The other side has an odd number of blocks, or an even one, on every level.
            maker.check([side, 1 + side % SHORT], DepthRange::Reversed);
        }
        let maker = Maker::new(&gpu, [SHORT, LONG]);
        for side in sides {
            maker.check([1 + side % SHORT, side], DepthRange::Forward);
        }
    }
}
