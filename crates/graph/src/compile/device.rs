//! Checks against the device: formats, features, limits and downlevel capabilities. Only kept passes are checked.

use wgpu::{DownlevelFlags, Features, TextureFormatFeatureFlags, TextureUsages};

use crate::access::{Access, Use};
use crate::error::CompileError;
use crate::graph::Graph;
use crate::pass::{Pass, PassKind};
use crate::resource::{Kind, Resource, TextureDesc};

/// What the device can do.
pub(crate) struct Capabilities<'a> {
    features: Features,
    limits: wgpu::Limits,
    downlevel: DownlevelFlags,
    adapter: Option<&'a wgpu::Adapter>,
    reads_drawn_samples: bool,
    /// Whether a shader can sample one mip of a texture while it writes another. On OpenGL a texture has only the mips that it was last sampled with, and writes of others are
    /// dropped in silence (WebGPU's compatibility mode forbids it, too: gpuweb/gpuweb#5224).
    samples_beside_writes: bool,
}

/// Whether shaders on this device can read a texture of several samples a texel that was drawn into. wgpu draws nothing into such a texture on OpenGL
/// (gfx-rs/wgpu#6084); `compile` refuses a plan that would.
pub fn reads_drawn_samples(device: &wgpu::Device) -> bool {
    device.adapter_info().backend != wgpu::Backend::Gl
}

impl<'a> Capabilities<'a> {
    /// Without the adapter, its downlevel capabilities are assumed from the backend, conservatively.
    pub fn new(device: &wgpu::Device, adapter: Option<&'a wgpu::Adapter>) -> Self {
        let downlevel = match adapter {
            Some(adapter) => adapter.get_downlevel_capabilities().flags,
            None if device.adapter_info().backend == wgpu::Backend::Gl => {
                DownlevelFlags::all()
                    - DownlevelFlags::READ_ONLY_DEPTH_STENCIL
                    - DownlevelFlags::DEPTH_TEXTURE_AND_BUFFER_COPIES
            }
            None => DownlevelFlags::all(),
        };
        Self {
            features: device.features(),
            limits: device.limits(),
            downlevel,
            adapter,
            reads_drawn_samples: reads_drawn_samples(device),
            samples_beside_writes: device.adapter_info().backend != wgpu::Backend::Gl,
        }
    }

    /// Whether a depth attachment may be read-only and sampled in the same pass.
    pub fn read_only_depth(&self) -> bool {
        self.downlevel
            .contains(DownlevelFlags::READ_ONLY_DEPTH_STENCIL)
    }

    /// As wgpu decides it: what WebGPU guarantees; what the adapter reports, where that feature is on or the adapter is below WebGPU.
    fn format(&self, format: wgpu::TextureFormat) -> wgpu::TextureFormatFeatures {
        let adapter_specific = self
            .features
            .contains(Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
            || !self
                .downlevel
                .contains(DownlevelFlags::WEBGPU_TEXTURE_FORMAT_SUPPORT);
        match self.adapter {
            Some(adapter) if adapter_specific => adapter.get_texture_format_features(format),
            _ => format.guaranteed_format_features(self.features),
        }
    }

    /// Whether a format allows all of these usages.
    pub fn format_allows(&self, format: wgpu::TextureFormat, usages: TextureUsages) -> bool {
        self.format(format).allowed_usages.contains(usages)
    }
}

/// Finds everything that the device refuses about the kept passes and the resources that they use.
pub(crate) fn device(
    graph: &Graph,
    kept: &[bool],
    capabilities: &Capabilities<'_>,
    errors: &mut Vec<CompileError>,
) {
    let mut touched = vec![false; graph.resources.len()];
    for (index, pass) in graph.passes.iter().enumerate() {
        if !kept[index] {
            continue;
        }
        pass_needs(pass, capabilities, errors);
        for used in &pass.uses {
            touched[used.resource()] = true;
            use_needs(graph, pass, used, capabilities, errors);
        }
    }
    for (index, resource) in graph.resources.iter().enumerate() {
        if !touched[index] {
            continue;
        }
        match resource.kind {
            Kind::Texture(desc) => texture_needs(resource, desc, capabilities, errors),
            Kind::Buffer(desc) => limit(
                &resource.name,
                "bytes",
                desc.rounded(),
                capabilities.limits.max_buffer_size,
                errors,
            ),
            Kind::Host(_) => {}
        }
    }
}

fn pass_needs(pass: &Pass, capabilities: &Capabilities<'_>, errors: &mut Vec<CompileError>) {
    let missing = pass.requires - capabilities.features;
    if !missing.is_empty() {
        errors.push(CompileError::MissingFeature {
            item: format!("pass `{}`", pass.name),
            feature: missing
                .iter_names()
                .map(|(name, _)| name)
                .collect::<Vec<_>>()
                .join(" and "),
        });
    }
    let mut wanted = DownlevelFlags::empty();
    if pass.kind == PassKind::Compute {
        wanted |= DownlevelFlags::COMPUTE_SHADERS;
    }
    for used in &pass.uses {
        match used.access {
            Access::Indirect => wanted |= DownlevelFlags::INDIRECT_EXECUTION,
            Access::StorageWrite | Access::StorageUpdate if pass.kind == PassKind::Raster => {
                wanted |= DownlevelFlags::FRAGMENT_WRITABLE_STORAGE;
            }
            Access::DepthRead => {
                let sampled = pass.uses.iter().any(|other| {
                    other.access == Access::Sample && other.raw.index == used.raw.index
                });
                if sampled {
                    wanted |= DownlevelFlags::READ_ONLY_DEPTH_STENCIL;
                }
            }
            _ => {}
        }
    }
    for (name, _) in (wanted - capabilities.downlevel).iter_names() {
        errors.push(CompileError::MissingCapability {
            pass: pass.name.clone(),
            capability: String::from(name),
        });
    }
    let colours = pass
        .uses
        .iter()
        .filter(|used| used.access == Access::Colour)
        .count() as u64;
    limit(
        &pass.name,
        "colour attachments",
        colours,
        u64::from(
            capabilities
                .limits
                .max_color_attachments
                .min(MAX_COLOURS as u32),
        ),
        errors,
    );
}

/// The most colour attachments a raster node may have, on any device.
pub(crate) const MAX_COLOURS: usize = 8;

fn use_needs(
    graph: &Graph,
    pass: &Pass,
    used: &Use,
    capabilities: &Capabilities<'_>,
    errors: &mut Vec<CompileError>,
) {
    let resource = &graph.resources[used.resource()];
    match resource.kind {
        Kind::Texture(desc) => {
            if !texture_use_allowed(desc, used.access, capabilities) {
                errors.push(CompileError::Usage {
                    pass: pass.name.clone(),
                    resource: resource.name.clone(),
                    access: used.access.word(),
                    format: desc.format,
                });
            }
            let reads_samples = used.access == Access::Sample && desc.samples > 1;
            if reads_samples && !capabilities.reads_drawn_samples {
                errors.push(CompileError::MissingCapability {
                    pass: pass.name.clone(),
                    capability: format!("samples of `{}` in a shader", resource.name),
                });
            }
            let written = |other: &Use| {
                other.access == Access::StorageTextureWrite && other.raw.index == used.raw.index
            };
            // The last frame's value is another texture.
            if used.access == Access::Sample
                && !used.raw.is_previous()
                && !capabilities.samples_beside_writes
                && pass.uses.iter().any(written)
            {
                errors.push(CompileError::SampledBesideWrite {
                    pass: pass.name.clone(),
                    resource: resource.name.clone(),
                });
            }
        }
        Kind::Buffer(desc) => {
            let usages = used.access.buffer_usages();
            if usages.contains(wgpu::BufferUsages::STORAGE) {
                let most = capabilities.limits.max_storage_buffer_binding_size;
                limit(
                    &resource.name,
                    "bytes of storage",
                    desc.rounded(),
                    most,
                    errors,
                );
            }
            if usages.contains(wgpu::BufferUsages::UNIFORM) {
                let most = capabilities.limits.max_uniform_buffer_binding_size;
                limit(
                    &resource.name,
                    "bytes of uniforms",
                    desc.rounded(),
                    most,
                    errors,
                );
            }
        }
        Kind::Host(_) => {}
    }
}

fn texture_use_allowed(desc: TextureDesc, access: Access, capabilities: &Capabilities<'_>) -> bool {
    let features = capabilities.format(desc.format);
    let is_depth = desc.format.is_depth_stencil_format();
    let usages = access.texture_usages();
    let mut allowed = features.allowed_usages.contains(usages);
    match access {
        Access::Colour => allowed &= !is_depth,
        Access::Resolve => {
            allowed &= !is_depth
                && desc.samples == 1
                && features
                    .flags
                    .contains(TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE);
        }
        Access::Depth | Access::DepthRead => allowed &= desc.format.has_depth_aspect(),
        Access::StorageTextureRead => {
            allowed &= desc.samples == 1
                && features.flags.intersects(
                    TextureFormatFeatureFlags::STORAGE_READ_ONLY
                        | TextureFormatFeatureFlags::STORAGE_READ_WRITE,
                );
        }
        Access::StorageTextureWrite => {
            allowed &= desc.samples == 1
                && features.flags.intersects(
                    TextureFormatFeatureFlags::STORAGE_WRITE_ONLY
                        | TextureFormatFeatureFlags::STORAGE_READ_WRITE,
                );
        }
        _ => {}
    }
    allowed
}

fn texture_needs(
    resource: &Resource,
    desc: TextureDesc,
    capabilities: &Capabilities<'_>,
    errors: &mut Vec<CompileError>,
) {
    let name = resource.name.as_str();
    let missing = desc.format.required_features() - capabilities.features;
    if !missing.is_empty() {
        errors.push(CompileError::MissingFeature {
            item: format!("texture `{name}`"),
            feature: missing
                .iter_names()
                .map(|(name, _)| name)
                .collect::<Vec<_>>()
                .join(" and "),
        });
    }
    let side = u64::from(desc.width.max(desc.height));
    let limits = &capabilities.limits;
    let most = u64::from(limits.max_texture_dimension_2d);
    limit(name, "texels a side", side, most, errors);
    let most = u64::from(limits.max_texture_array_layers);
    limit(name, "layers", u64::from(desc.layers), most, errors);
    let flags = capabilities.format(desc.format).flags;
    let possible = match resource.import {
        // The texture will be there, so that the device has made it: it may allow more than every device does.
        true => matches!(desc.samples, 2 | 4 | 8 | 16),
        false => flags.sample_count_supported(desc.samples),
    };
    if desc.samples > 1 && !possible {
        errors.push(CompileError::SampleCount {
            resource: String::from(name),
            samples: desc.samples,
            format: desc.format,
            allowed: flags.supported_sample_counts(),
        });
    }
}

fn limit(
    resource: &str,
    what: &'static str,
    asked: u64,
    limit: u64,
    errors: &mut Vec<CompileError>,
) {
    if asked > limit {
        errors.push(CompileError::Limit {
            resource: String::from(resource),
            what,
            asked,
            limit,
        });
    }
}
