//! The device requirements of a job, found by removing capabilities as long as the module validates. So they are always those of naga.

use wgpu::{BindingType, BufferBindingType, DownlevelFlags, Features, ShaderStages};

use crate::{job::Binding, report};

/// What a job needs of a device.
pub(super) struct Requirements {
    pub features: Features,
    pub downlevel: DownlevelFlags,
}

/// The smallest sets of features and downlevel flags that the job needs.
pub(super) fn reflect(module: &naga::Module, bindings: &[Binding]) -> Requirements {
    let Requirements {
        mut features,
        mut downlevel,
    } = validated(module);
    if module
        .entry_points
        .iter()
        .any(|entry| entry.stage == naga::ShaderStage::Compute)
    {
        downlevel |= DownlevelFlags::COMPUTE_SHADERS;
    }
    for binding in bindings {
        let stages = binding.entry.visibility;
        let Some(writes) = storage(&binding.entry.ty) else {
            continue;
        };
        if stages.contains(ShaderStages::VERTEX) {
            downlevel |= DownlevelFlags::VERTEX_STORAGE;
            if writes {
                features |= Features::VERTEX_WRITABLE_STORAGE;
            }
        }
        if stages.contains(ShaderStages::FRAGMENT) {
            downlevel |= DownlevelFlags::FRAGMENT_STORAGE;
            if writes {
                downlevel |= DownlevelFlags::FRAGMENT_WRITABLE_STORAGE;
            }
        }
    }
    Requirements {
        features,
        downlevel,
    }
}

/// For storage buffers and textures, whether they are written; else `None`.
fn storage(ty: &BindingType) -> Option<bool> {
    match ty {
        BindingType::Buffer {
            ty: BufferBindingType::Storage { read_only },
            ..
        } => Some(!read_only),
        BindingType::StorageTexture { access, .. } => {
            Some(*access != wgpu::StorageTextureAccess::ReadOnly)
        }
        _ => None,
    }
}

/// The smallest sets with which naga validates the module.
fn validated(module: &naga::Module) -> Requirements {
    let passes = |features, downlevel| {
        let capabilities = wgpu_naga_bridge::features_to_naga_capabilities(features, downlevel);
        report::validate(module, capabilities).is_ok()
    };
    if passes(Features::empty(), DownlevelFlags::empty()) {
        return Requirements {
            features: Features::empty(),
            downlevel: DownlevelFlags::empty(),
        };
    }
    let mut downlevel = DownlevelFlags::all();
    for flag in DownlevelFlags::all().iter() {
        if passes(Features::all(), downlevel - flag) {
            downlevel -= flag;
        }
    }
    let mut features = Features::all();
    // From the last flag to the first: where either of two flags is enough, the stronger one comes later, so it is removed.
    let flags: Vec<Features> = Features::all().iter().collect();
    for flag in flags.into_iter().rev() {
        if passes(features - flag, downlevel) {
            features.remove(flag);
        }
    }
    Requirements {
        features,
        downlevel,
    }
}
