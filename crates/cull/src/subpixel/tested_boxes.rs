//! What owns a sample of an image that our own rasteriser makes, of four bits below a pixel or of eight, is never hidden by the test of its box on the GPU.

use antumbra_shaders::{Job, jobs};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use wgpu::util::DeviceExt;

use super::rasteriser::Faces;
use super::world::{BITS, clip_position, mesh_in, place_box, rasteriser, view};
use crate::device::{AdapterChoice, Gpu};
use crate::entities::OrientedBox;
use crate::judge::{
    AT_MIDDLES, BOXES_ALONE, Eye, GpuJudgedView, GpuPyramid, HostDepth, JudgedInstance, Part,
};
use crate::read_back;
use crate::view::ViewFrame;

/// Boxes of a view, tested together.
const BOXES: usize = 256;
/// `SLOT_HIDDEN` of `shared/slot_states.wgsl`.
const HIDDEN: u32 = 2;

/// Views that are tried on each driver: more of them with the variable `SNAPPING_VIEWS`.
fn views() -> u64 {
    std::env::var("SNAPPING_VIEWS").map_or(60, |text| text.parse().unwrap())
}

/// An image: depths, and the number of the box whose contents own each pixel.
struct Image {
    depths: Vec<f32>,
    owners: Vec<Option<usize>>,
}

/// The test of slots and the pyramid that it looks at.
struct Tester<'a> {
    gpu: &'a Gpu,
    first: wgpu::ComputePipeline,
    rest: wgpu::ComputePipeline,
    test: wgpu::ComputePipeline,
}

impl<'a> Tester<'a> {
    fn new(gpu: &'a Gpu) -> Self {
        let pipeline = |job: &Job, entry| {
            let module = antumbra_shaders::module(&gpu.device, job);
            gpu.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: None,
                    layout: None,
                    module: &module,
                    entry_point: Some(entry),
                    compilation_options: Default::default(),
                    cache: None,
                })
        };
        Self {
            gpu,
            first: pipeline(&jobs::pyramid_one::JOB, "reduce"),
            rest: pipeline(&jobs::pyramid_rest::JOB, "rest"),
            test: pipeline(&jobs::test_slots_one::JOB, "test_slots"),
        }
    }

    /// What the test finds about each box.
    fn states(&self, view: &ViewFrame, depths: &[f32], boxes: &[JudgedInstance]) -> Vec<u32> {
        let device = &self.gpu.device;
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage,
            })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let host = HostDepth::default();
        let layout = GpuPyramid::new(view.size, host);
        let eye = Eye::of(&view.camera, view.size);
        let flags = AT_MIDDLES | BOXES_ALONE;
        let uniform = GpuJudgedView::new(&eye, view.size, host, boxes.len() as u32, flags);
        let uniform = buffer(bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let instances = buffer(bytemuck::cast_slice(boxes), storage);
        let levels = buffer(bytemuck::bytes_of(&layout), storage);
        let texels = buffer(&vec![0; layout.texels() as usize * 4], storage);
        let words = vec![0; boxes.len() * 4];
        let [first, rest, drawn] = [(); 3].map(|()| buffer(&words, storage));
        let states = buffer(&words, storage | wgpu::BufferUsages::COPY_SRC);
        let parts = buffer(&[0; 64], storage);
        let depth = self.texture(view.size, depths);

        let depth = wgpu::BindingResource::TextureView(&depth);
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut dispatch = |pipeline: &wgpu::ComputePipeline,
                            binds: &[(u32, wgpu::BindingResource<'_>)],
                            groups: [u32; 2]| {
            let entries: Vec<_> = binds
                .iter()
                .map(|(binding, resource)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: resource.clone(),
                })
                .collect();
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
        let pyramid = [
            (5, levels.as_entire_binding()),
            (6, texels.as_entire_binding()),
        ];
        let with_depth = [pyramid[0].clone(), pyramid[1].clone(), (7, depth.clone())];
        dispatch(
            &self.first,
            &with_depth,
            view.size.map(|side| side.div_ceil(32)),
        );
        dispatch(&self.rest, &pyramid, [1, 1]);
        let binds = [
            (0, uniform.as_entire_binding()),
            (1, instances.as_entire_binding()),
            (2, first.as_entire_binding()),
            (3, states.as_entire_binding()),
            (4, rest.as_entire_binding()),
            (5, levels.as_entire_binding()),
            (6, texels.as_entire_binding()),
            (7, depth),
            (8, drawn.as_entire_binding()),
            (9, parts.as_entire_binding()),
        ];
        dispatch(&self.test, &binds, [(boxes.len() as u32).div_ceil(64), 1]);
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = read_back::buffer(self.gpu, &states).unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }

    /// Depths as a texture of floats, as a depth is bound.
    fn texture(&self, [width, height]: [u32; 2], depths: &[f32]) -> wgpu::TextureView {
        let texture = self.gpu.device.create_texture_with_data(
            &self.gpu.queue,
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width,
                    height,
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
            bytemuck::cast_slice(depths),
        );
        texture.create_view(&Default::default())
    }
}

/// Draws what is in the boxes.
fn draw(random: &mut Pcg32, view: &ViewFrame, boxes: &[OrientedBox], bits: u32) -> Image {
    let rasteriser = rasteriser(view, bits, random);
    let pixels = (view.size[0] * view.size[1]) as usize;
    let mut image = Image {
        depths: vec![0.0; pixels],
        owners: vec![None; pixels],
    };
    for (number, place) in boxes.iter().enumerate() {
        for corners in mesh_in(random, view, place) {
            let corners = corners.map(|corner| clip_position(view, corner));
            rasteriser.triangle(corners, Faces::Both, |fragment| {
                let at = (fragment.pixel[1] * view.size[0] + fragment.pixel[0]) as usize;
                let depth = fragment.depth as f32;
                if depth >= image.depths[at] {
                    image.depths[at] = depth;
                    image.owners[at] = Some(number);
                }
            });
        }
    }
    image
}

fn play(name: &str) {
    let gpu = Gpu::open(&AdapterChoice::Named(name.to_owned())).unwrap();
    let tester = Tester::new(&gpu);
    let [mut owners, mut hidden] = [0, 0];
    for seed in 0..views() {
        let mut random = Pcg32::seed_from_u64(seed);
        let view = view(&mut random);
        let wanted = random.random_range(8..=BOXES);
        let boxes: Vec<_> = (0..wanted)
            .filter_map(|_| place_box(&mut random, &view))
            .collect();
        let judged: Vec<_> = boxes
            .iter()
            .map(|place| JudgedInstance::oriented(place, Part::Both))
            .collect();
        for bits in BITS {
            let image = draw(&mut random, &view, &boxes, bits);
            let states = tester.states(&view, &image.depths, &judged);
            for (pixel, owner) in image.owners.iter().enumerate() {
                let Some(owner) = *owner else { continue };
                owners += 1;
                assert_ne!(
                    states[owner], HIDDEN,
                    "seed {seed}, {bits} bits, on {name}: box {owner} owns pixel {pixel} of {:?} and is hidden; {:?}",
                    view.size, boxes[owner]
                );
            }
            hidden += states.iter().filter(|state| **state == HIDDEN).count();
        }
    }
    assert!(
        owners > 1_000 && hidden > 500,
        "{owners} pixels with an owner, {hidden} hidden boxes"
    );
}

#[test]
fn what_owns_a_sample_is_not_hidden_on_vulkan() {
    play("vulkan");
}

#[test]
fn what_owns_a_sample_is_not_hidden_on_gl() {
    play("gl");
}
