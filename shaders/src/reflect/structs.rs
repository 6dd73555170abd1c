//! Struct layouts: byte offsets in uniform, storage and immediate variables, and in packed vertex inputs.

use std::borrow::Cow;

use naga::{AddressSpace, ArraySize, Handle, ShaderStage, StructMember, Type, TypeInner};

use super::vertex;
use crate::job::{FieldLayout, LayoutKind, StructLayout, TailLayout};

/// All structs of the module that the host writes or reads, by name.
pub(super) fn reflect(module: &naga::Module) -> Vec<StructLayout> {
    let mut layouter = naga::proc::Layouter::default();
    if layouter.update(module.to_ctx()).is_err() {
        // Cannot fail for a validated module, since the validator makes the same call.
        return Vec::new();
    }
    let mut in_memory = Vec::new();
    for (_, variable) in module.global_variables.iter() {
        if let AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate =
            variable.space
        {
            collect(module, variable.ty, &mut in_memory);
        }
    }
    let mut layouts: Vec<StructLayout> = in_memory
        .iter()
        .filter_map(|handle| memory(module, *handle, layouter[*handle].alignment.round_up(1)))
        .collect();
    for entry in &module.entry_points {
        if entry.stage != ShaderStage::Vertex {
            continue;
        }
        for argument in &entry.function.arguments {
            let known = in_memory.contains(&argument.ty);
            if argument.binding.is_none() && !known {
                layouts.extend(packed(module, argument.ty));
            }
        }
    }
    layouts.sort_by(|a, b| a.name.cmp(&b.name));
    layouts.dedup_by(|a, b| a.name == b.name);
    layouts
}

fn collect(module: &naga::Module, handle: Handle<Type>, found: &mut Vec<Handle<Type>>) {
    match &module.types[handle].inner {
        TypeInner::Struct { members, .. } if !found.contains(&handle) => {
            found.push(handle);
            for member in members {
                collect(module, member.ty, found);
            }
        }
        TypeInner::Array { base, .. } | TypeInner::BindingArray { base, .. } => {
            collect(module, *base, found);
        }
        _ => {}
    }
}

fn memory(module: &naga::Module, handle: Handle<Type>, align: u32) -> Option<StructLayout> {
    let ty = &module.types[handle];
    let TypeInner::Struct { members, span } = &ty.inner else {
        return None;
    };
    let tail = members.last().and_then(|last| tail(module, last));
    let sized = if tail.is_some() {
        members.split_last().map_or(&[][..], |(_, sized)| sized)
    } else {
        members
    };
    let fields = sized
        .iter()
        .map(|member| FieldLayout {
            name: Cow::Owned(member.name.clone().unwrap_or_default()),
            offset: member.offset,
            size: module.types[member.ty]
                .inner
                .try_size(module.to_ctx())
                .unwrap_or(0),
        })
        .collect();
    Some(StructLayout {
        name: Cow::Owned(ty.name.clone()?),
        kind: LayoutKind::Memory,
        size: tail.as_ref().map_or(*span, |tail| tail.offset),
        align,
        fields: Cow::Owned(fields),
        tail,
    })
}

fn tail(module: &naga::Module, member: &StructMember) -> Option<TailLayout> {
    match module.types[member.ty].inner {
        TypeInner::Array {
            size: ArraySize::Dynamic,
            stride,
            ..
        } => Some(TailLayout {
            name: Cow::Owned(member.name.clone().unwrap_or_default()),
            offset: member.offset,
            stride,
        }),
        _ => None,
    }
}

fn packed(module: &naga::Module, handle: Handle<Type>) -> Option<StructLayout> {
    let ty = &module.types[handle];
    let TypeInner::Struct { members, .. } = &ty.inner else {
        return None;
    };
    let mut inputs = vertex::of_members(module, members);
    inputs.sort_by_key(|input| input.location);
    if inputs.is_empty() {
        return None;
    }
    let mut size = 0;
    let fields = inputs
        .into_iter()
        .map(|input| {
            let bytes = u32::try_from(input.format.size()).unwrap_or(0);
            let offset = size;
            size += bytes;
            FieldLayout {
                name: input.name,
                offset,
                size: bytes,
            }
        })
        .collect();
    Some(StructLayout {
        name: Cow::Owned(ty.name.clone()?),
        kind: LayoutKind::Vertex,
        size,
        align: 4,
        fields: Cow::Owned(fields),
        tail: None,
    })
}
