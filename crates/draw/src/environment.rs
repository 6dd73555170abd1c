//! The environment map of the shaded pass: an octahedral map whose mip levels are prefiltered for rough surfaces.
//!
//! The octahedral map is that of Praun and Hoppe, *Spherical Parametrization and Remeshing*, 2003. Unlike longitude and latitude it needs no
//! angles, and unlike a cube map it is one plain texture. All light is linear until it is stored, as its square root.

use std::f32::consts::TAU;

use antumbra_scene::{Image, Scene};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::pipeline::ENVIRONMENT_GROUP;
use crate::texture::{halved, to_linear};
use antumbra_cull::Gpu;

/// Width and height of level 0 in texels. A texel is 0.7 degrees wide.
const TEXELS: u32 = 256;
/// The exponents of the cosine lobes that blur the levels, from a mirror to a matt surface. For roughness r they are about those of a
/// microfacet lobe of width r squared around the mirrored direction of the eye.
const LOBES: [f32; 6] = [f32::INFINITY, 300.0, 20.0, 5.0, 2.0, 1.0];
/// The roughest level from which others are made.
const NARROW: usize = 2;
/// Samples of a lobe, for each texel.
const SAMPLES: u32 = 64;

/// The level that a surface of this roughness (0 to 1) reflects.
pub fn level(roughness: f32) -> u32 {
    (roughness * (LOBES.len() - 1) as f32).round() as u32
}

/// The distance of the outermost texels' centres from a level's middle, as a fraction of its width.
pub fn inset(level: u32) -> f32 {
    let texels = (TEXELS >> level) as f32;
    0.5 * (texels - 1.0) / texels
}

/// The bind group of a scene's environment, uploaded; `None` where it has none.
pub fn bind_group(gpu: &Gpu, scene: &Scene) -> Option<wgpu::BindGroup> {
    let image = scene.image(scene.environment()?.image)?;
    Some(upload(gpu, &levels(image)))
}

fn upload(gpu: &Gpu, levels: &[Level]) -> wgpu::BindGroup {
    let extent = |texels| wgpu::Extent3d {
        width: texels,
        height: texels,
        depth_or_array_layers: 1,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("environment"),
        size: extent(TEXELS),
        mip_level_count: LOBES.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, mip_level) in levels.iter().zip(0..) {
        let place = wgpu::TexelCopyTextureInfo {
            mip_level,
            ..texture.as_image_copy()
        };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(level.texels * 4),
            rows_per_image: None,
        };
        gpu.queue
            .write_texture(place, &level.stored(), layout, extent(level.texels));
    }
    // A surface reflects one level, so levels are not interpolated.
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("environment"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let job = &antumbra_shaders::jobs::shaded::JOB;
    let layout = gpu
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("environment"),
            entries: &job.layout_entries(ENVIRONMENT_GROUP),
        });
    let view = texture.create_view(&Default::default());
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("environment"),
        layout: &layout,
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&view),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::Sampler(&sampler),
            },
        ],
    })
}

/// A level: the sphere in linear light as an octahedral map. The centres of the outermost texels are on the map's edge.
#[derive(Debug, Clone, PartialEq)]
struct Level {
    texels: u32,
    light: Vec<Vec3>,
}

impl Level {
    /// Evaluates the light of every texel's direction.
    fn of(texels: u32, light: impl Fn(Vec3) -> Vec3 + Sync) -> Self {
        let last = (texels - 1) as f32;
        let at = |i: u32| Vec2::new((i % texels) as f32, (i / texels) as f32) / last;
        let all = (0..texels * texels).into_par_iter();
        Self {
            texels,
            light: all
                .map(|i| light(unfolded(at(i) * 2.0 - Vec2::ONE)))
                .collect(),
        }
    }

    /// The light that the shader samples in a direction.
    fn sample(&self, towards: Vec3) -> Vec3 {
        let last = self.texels - 1;
        let place = (folded(towards) * 0.5 + Vec2::splat(0.5)) * last as f32;
        bilinear(place, |x, y| {
            let at = y.min(last) * self.texels + x.min(last);
            self.light.get(at as usize).copied().unwrap_or_default()
        })
    }

    /// A level of some size, blurred so that lobes of exponent `from` become lobes of exponent `to`.
    fn blurred(&self, from: f32, to: f32, texels: u32) -> Self {
        // The widths of successive blurs add up, and a width is about one over the exponent.
        let exponent = 1.0 / (1.0 / to - 1.0 / from);
        let samples: Vec<Vec3> = (0..SAMPLES)
            .map(|sample| {
                // A Fibonacci spiral: evenly spread, and the same in every run.
                let part = (sample as f32 + 0.5) / SAMPLES as f32;
                let cosine = part.powf(1.0 / (exponent + 1.0));
                let (sin, cos) = (sample as f32 * TAU * 0.618_034).sin_cos();
                let side = (1.0 - cosine * cosine).max(0.0).sqrt();
                Vec3::new(side * cos, side * sin, cosine)
            })
            .collect();
        Self::of(texels, |towards| {
            let (right, up) = towards.any_orthonormal_pair();
            let light = samples.iter().map(|sample| {
                let direction = right * sample.x + up * sample.y + towards * sample.z;
                self.sample(direction)
            });
            light.sum::<Vec3>() / SAMPLES as f32
        })
    }

    /// The texture's bytes: square roots of the light.
    fn stored(&self) -> Vec<u8> {
        let byte = |light: f32| (light.clamp(0.0, 1.0).sqrt() * 255.0).round() as u8;
        let texels = self.light.iter();
        texels
            .flat_map(|light| [byte(light.x), byte(light.y), byte(light.z), 255])
            .collect()
    }
}

/// All levels of an equirectangular image, the sharpest first.
fn levels(image: &Image) -> Vec<Level> {
    let (mut width, mut height) = (image.width, image.height);
    let mut pixels = std::borrow::Cow::Borrowed(&image.rgba);
    // Pixels that are much smaller than texels would be skipped by the sampling below.
    while width >= 4 * TEXELS {
        let smaller = halved(width, height, &pixels);
        (width, height) = (smaller.width, smaller.height);
        pixels = std::borrow::Cow::Owned(smaller.rgba);
    }
    let linear: Vec<Vec3> = (pixels.chunks_exact(4))
        .map(|pixel| {
            Vec3::new(
                to_linear(pixel[0]),
                to_linear(pixel[1]),
                to_linear(pixel[2]),
            )
        })
        .collect();
    let sharp = Level::of(TEXELS, |towards| {
        let turn = towards.x.atan2(-towards.z) / TAU + 0.5;
        let down = towards.y.clamp(-1.0, 1.0).acos() / (TAU / 2.0);
        let place = Vec2::new(turn * width as f32, down * height as f32) - Vec2::splat(0.5);
        // Shifted by one row and one full width, so that coordinates are never below 0.
        bilinear(place + Vec2::new(width as f32, 1.0), |x, y| {
            let y = y.saturating_sub(1).min(height.saturating_sub(1));
            let at = y as usize * width as usize + (x % width.max(1)) as usize;
            linear.get(at).copied().unwrap_or_default()
        })
    });
    let mut all = vec![sharp];
    for (number, to) in LOBES.iter().enumerate().skip(1) {
        // The widths of wide lobes add up only roughly. So the widest are made from a level that is narrow, yet wide enough for this number of
        // samples.
        let source = (number - 1).min(NARROW);
        let next =
            (all.get(source)).map(|level| level.blurred(LOBES[source], *to, TEXELS >> number));
        all.extend(next);
    }
    all
}

/// Interpolates between four neighbours.
fn bilinear(place: Vec2, at: impl Fn(u32, u32) -> Vec3) -> Vec3 {
    let low = place.floor();
    let part = place - low;
    let (x, y) = (low.x as u32, low.y as u32);
    let upper = at(x, y).lerp(at(x + 1, y), part.x);
    upper.lerp(at(x, y + 1).lerp(at(x + 1, y + 1), part.x), part.y)
}

/// The octahedral map of a direction, -1 to 1. CPU twin of `shared/environment.wgsl`.
fn folded(towards: Vec3) -> Vec2 {
    let flat = Vec2::new(towards.x, towards.z) / towards.abs().element_sum();
    if towards.y >= 0.0 {
        flat
    } else {
        (Vec2::ONE - Vec2::new(flat.y, flat.x).abs()) * sign(flat)
    }
}

/// The unit direction of a point of the octahedral map, -1 to 1.
fn unfolded(place: Vec2) -> Vec3 {
    let up = 1.0 - place.abs().element_sum();
    let flat = if up >= 0.0 {
        place
    } else {
        (Vec2::ONE - Vec2::new(place.y, place.x).abs()) * sign(place)
    };
    Vec3::new(flat.x, up, flat.y).normalize()
}

/// 1 or -1; 1 for 0.
fn sign(place: Vec2) -> Vec2 {
    let of = |value: f32| if value >= 0.0 { 1.0 } else { -1.0 };
    Vec2::new(of(place.x), of(place.y))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn directions() -> impl Iterator<Item = Vec3> {
        (0..500).map(|i| {
            let up = (i as f32 + 0.5) / 250.0 - 1.0;
            let (sin, cos) = (i as f32 * 2.4).sin_cos();
            let side = (1.0 - up * up).sqrt();
            Vec3::new(side * cos, up, side * sin)
        })
    }

    fn image(width: u32, height: u32, at: impl Fn(u32, u32) -> [u8; 3]) -> Image {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Image {
            rgba: pixels
                .flat_map(|(x, y)| {
                    let [r, g, b] = at(x, y);
                    [r, g, b, 255]
                })
                .collect(),
            width,
            height,
            ..crate::texture::white()
        }
    }

    #[test]
    fn folding_and_unfolding_are_inverse() {
        for towards in directions() {
            let place = folded(towards * 3.0);
            assert!(place.abs().max_element() <= 1.0);
            assert!((unfolded(place) - towards).length() < 1e-5, "{towards}");
        }
    }

    #[test]
    fn the_shader_is_told_the_same_numbers() {
        let text = antumbra_shaders::jobs::shaded::JOB.source.as_ref();
        let last = LOBES.len() as u32 - 1;
        assert_eq!((level(0.0), level(1.0)), (0, last));
        let roughest = format!("ENVIRONMENT_ROUGHEST: f32 = {:?};", last as f32);
        let its_inset = format!("ENVIRONMENT_ROUGHEST_INSET: f32 = {:?};", inset(last));
        assert!(
            text.contains(&roughest) && text.contains(&its_inset),
            "{its_inset}"
        );
    }

    #[test]
    fn blurring_keeps_light_and_evens_it_out() {
        let levels = levels(&image(64, 32, |x, y| [(x * 4) as u8, 200, (y * 8) as u8]));
        let mut spread = f32::INFINITY;
        for level in &levels {
            let lights: Vec<Vec3> = directions().map(|towards| level.sample(towards)).collect();
            let mean = lights.iter().sum::<Vec3>() / lights.len() as f32;
            let first: Vec3 = directions().map(|towards| levels[0].sample(towards)).sum();
            let off = mean - first / lights.len() as f32;
            assert!(
                off.abs().max_element() < 0.02,
                "{} texels: {off}",
                level.texels
            );
            assert!(
                lights
                    .iter()
                    .all(|light| (light.y - to_linear(200)).abs() < 1e-4)
            );
            let now: f32 = lights.iter().map(|light| (light.x - mean.x).powi(2)).sum();
            assert!(now < spread * 1.001, "{} texels", level.texels);
            spread = now;
        }
    }

    #[test]
    fn nothing_jumps_at_the_fold_or_where_the_image_ends() {
        let levels = levels(&image(128, 64, |x, y| {
            let round = (x as f32 / 128.0 * TAU).cos() * 0.5 + 0.5;
            [(round * 255.0) as u8, (y * 4) as u8, 0]
        }));
        for level in &levels {
            for turn in 0..90 {
                let (sin, cos) = (turn as f32 * TAU / 90.0).sin_cos();
                // Either side of the horizon, of the lower half's seams, and of the image's ends.
                let pairs = [
                    [Vec3::new(sin, 1e-4, cos), Vec3::new(sin, -1e-4, cos)],
                    [
                        Vec3::new(1e-4, -1.0 - sin, cos),
                        Vec3::new(-1e-4, -1.0 - sin, cos),
                    ],
                    [Vec3::new(1e-4, sin, 1.0), Vec3::new(-1e-4, sin, 1.0)],
                ];
                for [a, b] in pairs {
                    let step = (level.sample(a) - level.sample(b)).abs().max_element();
                    assert!(step < 0.01, "{} texels, {a}: {step}", level.texels);
                }
            }
        }
    }

    #[test]
    fn large_and_empty_images_are_environments_too() {
        let large = levels(&image(2048, 8, |_, y| [255 * u8::from(y < 4), 0, 0]));
        assert!(large[0].sample(Vec3::Y).x > 0.99 && large[0].sample(Vec3::NEG_Y).x < 0.01);
        let none = levels(&image(0, 0, |_, _| [255; 3]));
        assert!(
            none.iter()
                .all(|level| level.light.iter().all(|light| *light == Vec3::ZERO))
        );
    }
}
