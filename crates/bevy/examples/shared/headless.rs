//! A Bevy app without a window: its cameras draw into images, and a frame is timed from the first system to the device's last command.

use std::time::{Duration, Instant};

use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_asset::RenderAssets;
use bevy::render::renderer::{RenderAdapterInfo, RenderDevice, RenderQueue};
use bevy::render::settings::{RenderCreation, WgpuSettings};
use bevy::render::texture::GpuImage;
use bevy::render::{RenderApp, RenderPlugin};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

/// An app that draws nothing yet. Frames run one by one, by [`frame`], on the calling thread.
pub fn app() -> App {
    let mut app = App::new();
    let window = WindowPlugin {
        primary_window: None,
        exit_condition: ExitCondition::DontExit,
        ..default()
    };
    let render = RenderPlugin {
        render_creation: render_creation(),
        synchronous_pipeline_compilation: true,
        ..default()
    };
    app.add_plugins(
        DefaultPlugins
            .set(window)
            .set(render)
            .disable::<LogPlugin>()
            .disable::<PipelinedRenderingPlugin>()
            .disable::<WinitPlugin>(),
    );
    app.insert_resource(ClearColor(Color::linear_rgb(0.02, 0.02, 0.03)));
    app
}

/// How the device is made.
pub fn render_creation() -> RenderCreation {
    // A debug build validates indirect draws, at a price that a release does not pay.
    let settings = WgpuSettings {
        instance_flags: wgpu::InstanceFlags::empty().with_env(),
        ..default()
    };
    RenderCreation::Automatic(Box::new(settings))
}

/// Brings an app to where frames can run.
pub fn finish(app: &mut App) {
    app.finish();
    app.cleanup();
}

/// An image that a camera can draw into.
pub fn target(app: &mut App, size: [u32; 2]) -> Handle<Image> {
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let mut image = Image::new_target_texture(size[0], size[1], format, None);
    image.texture_descriptor.usage |= wgpu::TextureUsages::COPY_SRC;
    app.world_mut().resource_mut::<Assets<Image>>().add(image)
}

/// Runs a frame, and waits until the device has done it. Returns the time from the first system to the device's last command.
pub fn frame(app: &mut App) -> Duration {
    let start = Instant::now();
    app.update();
    wait(app);
    start.elapsed()
}

/// The device's name.
pub fn device_name(app: &App) -> String {
    let info = app.world().resource::<RenderAdapterInfo>();
    format!("{} ({:?})", info.name, info.backend)
}

fn wait(app: &App) {
    let device = app.world().resource::<RenderDevice>();
    if let Err(error) = device.poll(wgpu::PollType::wait_indefinitely()) {
        panic!("the device does not finish its frame: {error}");
    }
}

/// The bytes of an image that was drawn, RGBA, top row first.
#[allow(dead_code, reason = "not all examples look at pictures")]
pub fn picture(app: &App, image: &Handle<Image>, size: [u32; 2]) -> Vec<u8> {
    let device = app.world().resource::<RenderDevice>().wgpu_device().clone();
    let render = app.sub_app(RenderApp).world();
    let images = render.resource::<RenderAssets<GpuImage>>();
    let queue = render.resource::<RenderQueue>();
    let Some(gpu_image) = images.get(image) else {
        panic!("an image that was not drawn");
    };
    let row = (size[0] * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(row) * u64::from(size[1]),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        gpu_image.texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(row),
                rows_per_image: None,
            },
        },
        wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
    );
    queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |mapped| {
        if let Err(error) = mapped {
            panic!("a picture cannot be read: {error}");
        }
    });
    wait(app);
    let Ok(bytes) = buffer.slice(..).get_mapped_range() else {
        panic!("a picture that is not mapped");
    };
    let rows = bytes.chunks(row as usize);
    rows.flat_map(|bytes| &bytes[..size[0] as usize * 4])
        .copied()
        .collect()
}
