//! Base-colour textures: uploaded once with their mip levels, one bind group each.
//!
//! Bind group 0 is a single white pixel, for materials without an image.

use antumbra_scene::{Filter, Image, Sampler, Wrap};

use crate::error::DrawError;
use antumbra_cull::Gpu;

/// One white pixel, for materials without an image.
pub fn white() -> Image {
    Image {
        name: String::new(),
        width: 1,
        height: 1,
        rgba: vec![255; 4],
        sampler: Sampler::default(),
    }
}

/// Uploads an image with its mip levels and makes its bind group. `number` is the image's, for the error.
///
/// # Errors
/// [`DrawError::Image`] where the image exceeds the device's texture size.
pub fn upload(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    image: &Image,
    number: usize,
) -> Result<wgpu::BindGroup, DrawError> {
    let most = gpu.device.limits().max_texture_dimension_2d;
    if image.width.max(image.height) > most {
        return Err(DrawError::Image {
            image: number,
            width: image.width,
            height: image.height,
            most,
        });
    }
    let levels = match image.sampler.mipmaps {
        Some(_) => image.width.max(image.height).max(1).ilog2() + 1,
        None => 1,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("base colour"),
        size: extent(image.width, image.height),
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut mip = Mip {
        width: image.width,
        height: image.height,
        rgba: image.rgba.clone(),
    };
    for level in 0..levels {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                mip_level: level,
                ..texture.as_image_copy()
            },
            &mip.rgba,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(mip.width * 4),
                rows_per_image: None,
            },
            extent(mip.width, mip.height),
        );
        if level + 1 < levels {
            mip = halved(mip.width, mip.height, &mip.rgba);
        }
    }
    let sampler = gpu.device.create_sampler(&sampler(&image.sampler));
    Ok(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("base colour"),
        layout,
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(
                    &texture.create_view(&Default::default()),
                ),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::Sampler(&sampler),
            },
        ],
    }))
}

fn extent(width: u32, height: u32) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    }
}

fn sampler(sampler: &Sampler) -> wgpu::SamplerDescriptor<'static> {
    let wrap = |wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    let filter = |filter| match filter {
        Filter::Linear => wgpu::FilterMode::Linear,
        Filter::Nearest => wgpu::FilterMode::Nearest,
    };
    wgpu::SamplerDescriptor {
        address_mode_u: wrap(sampler.wrap_u),
        address_mode_v: wrap(sampler.wrap_v),
        mag_filter: filter(sampler.magnify),
        min_filter: filter(sampler.minify),
        mipmap_filter: match sampler.mipmaps {
            Some(Filter::Linear) => wgpu::MipmapFilterMode::Linear,
            Some(Filter::Nearest) | None => wgpu::MipmapFilterMode::Nearest,
        },
        ..Default::default()
    }
}

/// A mip level.
pub struct Mip {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// sRGB colour and linear alpha, row by row.
    pub rgba: Vec<u8>,
}

/// The next mip level of sRGB pixels: each pixel is the mean of up to four, in linear light.
pub fn halved(width: u32, height: u32, pixels: &[u8]) -> Mip {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let mut out = Vec::with_capacity(w as usize * h as usize * 4);
    let at = |x: u32, y: u32, channel: usize| {
        let place =
            (y.min(height - 1) as usize * width as usize + x.min(width - 1) as usize) * 4 + channel;
        pixels.get(place).copied().unwrap_or(0)
    };
    for y in 0..h {
        for x in 0..w {
            for channel in 0..4 {
                let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
                    .map(|(dx, dy)| at(x * 2 + dx, y * 2 + dy, channel));
                out.push(if channel == 3 {
                    (four.iter().map(|v| u32::from(*v)).sum::<u32>() / 4) as u8
                } else {
                    from_linear(four.iter().map(|v| to_linear(*v)).sum::<f32>() / 4.0)
                });
            }
        }
    }
    Mip {
        width: w,
        height: h,
        rgba: out,
    }
}

/// Linear light of an sRGB byte, 0 to 1.
pub fn to_linear(value: u8) -> f32 {
    let v = f32::from(value) / 255.0;
    if v <= 0.04045 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

fn from_linear(value: f32) -> u8 {
    let v = if value <= 0.003_130_8 {
        value * 12.92
    } else {
        1.055 * value.powf(1.0 / 2.4) - 0.055
    };
    (v * 255.0).round() as u8
}
