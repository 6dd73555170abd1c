//! Bind group layout entries of global variables, derived as wgpu-core derives them for automatic layouts, which are not public.

use std::{
    borrow::Cow,
    num::{NonZeroU32, NonZeroU64},
};

use naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, ScalarKind, StorageAccess,
    TypeInner,
    valid::{FunctionInfo, ModuleInfo},
};

use super::users;
use crate::{
    error::ShaderError,
    job::{Binding, BindingUse},
};

/// No wgpu backend has more than eight bind groups (`wgpu_hal::MAX_BIND_GROUPS`).
const LAST_GROUP: u32 = 7;

/// The bindings that entry points use, by group and number.
pub(super) fn reflect(
    file: &str,
    module: &naga::Module,
    info: &ModuleInfo,
) -> Result<Vec<Binding>, ShaderError> {
    let mut bindings: Vec<Binding> = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let Some(place) = variable.binding else {
            continue;
        };
        let uses: Vec<BindingUse> = users(module, info, handle)
            .map(|(entry, info)| BindingUse {
                entry_point: Cow::Owned(entry.name.clone()),
                stage: wgpu_naga_bridge::map_naga_stage(entry.stage),
                filters: filters(module, info, handle),
            })
            .collect();
        if uses.is_empty() {
            continue;
        }
        let name = variable.name.clone().unwrap_or_default();
        if place.group > LAST_GROUP {
            return Err(ShaderError::GroupNumber {
                file: file.to_owned(),
                variable: name,
                group: place.group,
                last: LAST_GROUP,
            });
        }
        let taken =
            |other: &&Binding| other.group == place.group && other.entry.binding == place.binding;
        if let Some(other) = bindings.iter().find(taken) {
            return Err(ShaderError::SharedBinding {
                file: file.to_owned(),
                group: place.group,
                binding: place.binding,
                first: other.name.to_string(),
                second: name,
            });
        }
        let filterable = uses.iter().any(|by| by.filters);
        let Some((ty, count)) = binding_type(module, variable, filterable) else {
            return Err(ShaderError::Unbindable {
                file: file.to_owned(),
                variable: name,
            });
        };
        let visibility = uses.iter().map(|by| by.stage).collect();
        bindings.push(Binding {
            group: place.group,
            name: Cow::Owned(name),
            entry: wgpu::BindGroupLayoutEntry {
                binding: place.binding,
                visibility,
                ty,
                count,
            },
            uses: Cow::Owned(uses),
        });
    }
    bindings.sort_by_key(|binding| (binding.group, binding.entry.binding));
    Ok(bindings)
}

/// Whether the entry point samples this image with a filtering sampler. Comparison samplers read depth textures.
fn filters(module: &naga::Module, info: &FunctionInfo, image: Handle<GlobalVariable>) -> bool {
    info.sampling_set.iter().any(|pair| {
        let sampler = &module.types[module.global_variables[pair.sampler].ty].inner;
        pair.image == image && !matches!(sampler, TypeInner::Sampler { comparison: true })
    })
}

type Typed = (wgpu::BindingType, Option<NonZeroU32>);

fn binding_type(
    module: &naga::Module,
    variable: &GlobalVariable,
    filterable: bool,
) -> Option<Typed> {
    let (inner, count) = match module.types[variable.ty].inner {
        TypeInner::BindingArray { base, size } => {
            let count = match size {
                naga::ArraySize::Constant(count) => count,
                // The length of an unsized binding array is set in the layout.
                naga::ArraySize::Pending(_) | naga::ArraySize::Dynamic => NonZeroU32::MIN,
            };
            (&module.types[base].inner, Some(count))
        }
        ref inner => (inner, None),
    };
    let ty = match *inner {
        TypeInner::Sampler { comparison } => wgpu::BindingType::Sampler(if comparison {
            wgpu::SamplerBindingType::Comparison
        } else {
            wgpu::SamplerBindingType::Filtering
        }),
        TypeInner::Image {
            dim,
            arrayed,
            class,
        } => image(view_dimension(dim, arrayed), class, filterable)?,
        TypeInner::AccelerationStructure { vertex_return } => {
            wgpu::BindingType::AccelerationStructure { vertex_return }
        }
        ref data => wgpu::BindingType::Buffer {
            ty: match variable.space {
                AddressSpace::Uniform => wgpu::BufferBindingType::Uniform,
                AddressSpace::Storage { access } => wgpu::BufferBindingType::Storage {
                    read_only: access == StorageAccess::LOAD,
                },
                _ => return None,
            },
            has_dynamic_offset: false,
            min_binding_size: data
                .try_size(module.to_ctx())
                .and_then(|size| NonZeroU64::new(size.into())),
        },
    };
    Some((ty, count))
}

fn view_dimension(dim: ImageDimension, arrayed: bool) -> wgpu::TextureViewDimension {
    match (dim, arrayed) {
        (ImageDimension::D1, _) => wgpu::TextureViewDimension::D1,
        (ImageDimension::D2, false) => wgpu::TextureViewDimension::D2,
        (ImageDimension::D2, true) => wgpu::TextureViewDimension::D2Array,
        (ImageDimension::D3, _) => wgpu::TextureViewDimension::D3,
        (ImageDimension::Cube, false) => wgpu::TextureViewDimension::Cube,
        (ImageDimension::Cube, true) => wgpu::TextureViewDimension::CubeArray,
    }
}

fn image(
    view_dimension: wgpu::TextureViewDimension,
    class: ImageClass,
    filterable: bool,
) -> Option<wgpu::BindingType> {
    Some(match class {
        ImageClass::Sampled { kind, multi } => wgpu::BindingType::Texture {
            sample_type: match kind {
                ScalarKind::Float => wgpu::TextureSampleType::Float { filterable },
                ScalarKind::Sint => wgpu::TextureSampleType::Sint,
                ScalarKind::Uint => wgpu::TextureSampleType::Uint,
                ScalarKind::AbstractInt | ScalarKind::AbstractFloat | ScalarKind::Bool => {
                    return None;
                }
            },
            view_dimension,
            multisampled: multi,
        },
        ImageClass::Depth { multi } => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension,
            multisampled: multi,
        },
        ImageClass::Storage { format, access } => wgpu::BindingType::StorageTexture {
            access: storage_access(access)?,
            format: wgpu_naga_bridge::map_storage_format_from_naga(format),
            view_dimension,
        },
        ImageClass::External => wgpu::BindingType::ExternalTexture,
    })
}

fn storage_access(access: StorageAccess) -> Option<wgpu::StorageTextureAccess> {
    if access.contains(StorageAccess::ATOMIC) {
        Some(wgpu::StorageTextureAccess::Atomic)
    } else if access.contains(StorageAccess::LOAD | StorageAccess::STORE) {
        Some(wgpu::StorageTextureAccess::ReadWrite)
    } else if access.contains(StorageAccess::LOAD) {
        Some(wgpu::StorageTextureAccess::ReadOnly)
    } else if access.contains(StorageAccess::STORE) {
        Some(wgpu::StorageTextureAccess::WriteOnly)
    } else {
        None
    }
}
