//! What a device must offer, found by taking capabilities away until the module no longer validates. So the list is
//! naga's own, and stays right when naga learns more.

use wgpu::{BindingType, BufferBindingType, DownlevelFlags, Features, ShaderStages};

use crate::{job::Binding, report};

/// The smallest set of features and downlevel flags that the job needs.
pub(super) fn reflect(module: &naga::Module, bindings: &[Binding]) -> (Features, DownlevelFlags) {
    let (mut features, mut downlevel) = validated(module);
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
    (features, downlevel)
}

/// `Some(whether written)` for storage buffers and textures.
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

fn validated(module: &naga::Module) -> (Features, DownlevelFlags) {
    let passes = |features, downlevel| {
        let capabilities = wgpu_naga_bridge::features_to_naga_capabilities(features, downlevel);
        report::validate(module, capabilities).is_ok()
    };
    if passes(Features::empty(), DownlevelFlags::empty()) {
        return (Features::empty(), DownlevelFlags::empty());
    }
    let mut downlevel = DownlevelFlags::all();
    for flag in DownlevelFlags::all().iter() {
        if passes(Features::all(), downlevel - flag) {
            downlevel -= flag;
        }
    }
    let mut features = Features::all();
    // From the last flag to the first: where two would do, the stronger one stands later and goes first.
    let flags: Vec<Features> = Features::all().iter().collect();
    for flag in flags.into_iter().rev() {
        if passes(features - flag, downlevel) {
            features.remove(flag);
        }
    }
    (features, downlevel)
}
